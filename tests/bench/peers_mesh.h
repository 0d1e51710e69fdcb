/*
 * Contact problems of any size in the plane, from two meshes, condensed by the library.
 *
 *   bar                                    two blocks
 *      held from above, pushed down           held from above, pushed down and sideways
 *      +-----------------------+|             +-----------------------+
 *   -->|                       |o|            |   E = 20000           |
 *   -->|   E = 13000           |o|            1=======================n
 *   -->|                       |o|            |   E = 13000           |
 *      1=======================n|             +-----------------------+
 *      //////////////////////////             ///////////////////////// held
 *
 * Unlike the bar of the paper these bodies are held from above: the peers need the flexibility, the
 * inverse of the stiffness, which a body on nothing but contact does not have.
 */

#ifndef PEERS_MESH_H
#define PEERS_MESH_H

#include <stddef.h>

enum geometry {
    BAR,
    TWO_BLOCKS,
    /* In space, see peers_block.h: the loads of the block, and columns by their slenderness. */
    BLOCK_SHIFT,
    BLOCK_TWIST,
    BLOCK_TILT,
    BLOCK_WAVES,
    BLOCK_RIM,
    COLUMN_10,
    COLUMN_20,
    COLUMN_40,
    HELD_OUT /* and after it, see peers_held.h */
};

/* K d = f + F, pairs (n, t) or (n, t1, t2), a gap for each: what signorini_solve takes. */
struct contact {
    size_t dim, pairs;
    double *K; /* dim pairs columns of as many entries */
    double *f;
    double *gap;
};

/* Meshes, assembles and condenses; `wave` is the depth of the waves of the gap. Returns NULL, or
 * what went wrong. */
const char *contact_new(enum geometry geometry, size_t pairs, double wave, struct contact *contact);
void contact_free(struct contact *contact);

/* Memory that is there, or the end of the program. */
void *need(size_t count, size_t size);

#endif
