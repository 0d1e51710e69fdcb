/*
 * Siconos' own text files (.dat) of friction problems: local form M, q, mu, or global form M, H, q,
 * b, mu, with M v = H r + q, u = H' v + b. A matrix is dense, in blocks, or sparse.
 */

#ifndef FCLIB_DAT_H
#define FCLIB_DAT_H

#include "local_form.h"

/* Reads the problem of a file. Returns NULL, or a sentence on what is wrong. */
const char *dat_read(const char *path, struct local_form *form);

#endif
