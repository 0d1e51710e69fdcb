/*
 * Families of bodies that no solver was tuned for, most of their pairs open: one table of parameters in peers_held.c.
 */

#ifndef PEERS_HELD_H
#define PEERS_HELD_H

#include "peers_mesh.h"

extern const size_t held_count;

const char *held_name(size_t family);
size_t held_dim(size_t family);

/* About `pairs` pairs of a family with friction; gaps are chosen so that the part of the table stays open. Returns NULL, or
 * what went wrong. */
const char *held_new(size_t family, size_t pairs, double mu, struct contact *contact);

#endif
