/*
 * How a host program stays in touch with its user during a long call: a line of progress on a
 * terminal, and a clean end on Ctrl-C. Both go through the library's progress callback. The library
 * itself installs no handler and prints nothing.
 */

#ifndef WATCH_H
#define WATCH_H

#include "signorini.h"

/* A shell takes this for "ended by Ctrl-C". */
enum { EXIT_INTERRUPTED = 130 };

/* From now on Ctrl-C (SIGINT) ends nothing by itself, it only makes `watch_interrupted` true. */
void watch_begin(void);

/* Has the calls with these settings watched: a line on stderr if that is a terminal, and they are
 * cancelled on Ctrl-C. */
void watch_calls(struct signorini_settings *settings);

/* Erases the line of progress; to be called after each call and before anything is printed. */
void watch_erase(void);

int watch_interrupted(void);

/* The last words of a program that was interrupted; what `main` returns then. */
int watch_end(void);

#endif
