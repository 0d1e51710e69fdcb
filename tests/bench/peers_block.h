/*
 * Contact problems in space: a body of 8-node bricks on a rigid plane, condensed by the library.
 *
 *      top: held, moved as a rigid plate
 *      +-----------------+        block: as high as wide, layers that grow upwards
 *      |   E = 13000     |        column: 5 x 5 nodes, 10, 20 or 40 times as high as wide
 *      |                 |
 *      1=================n        n = side x side pairs (n, t1, t2) = (-z, x, -y)
 *      ///////////////////
 */

#ifndef PEERS_BLOCK_H
#define PEERS_BLOCK_H

#include "peers_mesh.h"

/* The data that all loads of a body share. */
struct block;

/* `slenderness`: 0 for a block, or the height of a column in widths. Fills pairs, dim and K of the
 * contact. Returns NULL and leaves the reason in signorini_last_error(), if it fails. */
struct block *block_new(size_t side, size_t slenderness, struct contact *contact);
void block_free(struct block *block);

/* Fills f and gap. Motions along the plane grow with mu, so that every mu has pairs that slip and
 * pairs that stick. Returns 0, or the library's status. */
int block_load(const struct block *block, enum geometry geometry, double mu,
               struct contact *contact);

#endif
