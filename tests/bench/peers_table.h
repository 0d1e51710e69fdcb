/*
 * The findings of a run, as CSV and as a Markdown document.
 */

#ifndef PEERS_TABLE_H
#define PEERS_TABLE_H

#include <stdio.h>

#include "peers_judge.h"

const char *family_name(enum family family);
const char *geometry_name(enum geometry geometry);

void write_csv(FILE *file, const struct row *rows, size_t count);
/* `versions`: a line on the libraries and compilers. */
void write_markdown(FILE *file, const struct row *rows, size_t count, const char *versions,
                    double limit);

#endif
