#include "body.h"

#include "../../3d/brick_element.h"

static const struct material material = {1.0, 0.3};

/* A node's displacement in unknowns: itself, or, of a slave, those of its row. */
struct terms {
    PetscInt count, *nodes;
    double (*block)[3][3];
};

/* Of a slave u = (R d - sum w u_other) / D. */
static PetscErrorCode terms_of(const struct body *body, PetscInt node, int64_t pair,
                               struct terms *terms)
{
    const signorini_pairs *rows = body->pairs.rows;
    const int64_t first = pair < 0 ? 0 : rows->row_start[pair];
    const int64_t end = pair < 0 ? 1 : rows->row_start[pair + 1];
    double R[3][3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}, D = 1.0;

    PetscFunctionBeginUser;
    PetscCall(PetscMalloc2(end - first, &terms->nodes, end - first, &terms->block));
    terms->count = 1;
    if (pair >= 0)
        body_frame(body, pair, R);
    for (int64_t at = first; pair >= 0 && at < end; at++)
        if (rows->row_nodes[3 * at] == 3 * node)
            D = rows->row_weights[at];
    terms->nodes[0] = node;
    for (int axis = 0; axis < 3; axis++)
        for (int c = 0; c < 3; c++)
            terms->block[0][axis][c] = R[c][axis] / D;
    for (int64_t at = first; pair >= 0 && at < end; at++) {
        if (rows->row_nodes[3 * at] == 3 * node)
            continue;
        for (int axis = 0; axis < 3; axis++)
            for (int c = 0; c < 3; c++)
                terms->block[terms->count][axis][c] = axis == c ? -rows->row_weights[at] / D : 0.0;
        terms->nodes[terms->count++] = (PetscInt)rows->row_nodes[3 * at] / 3;
    }
    PetscFunctionReturn(0);
}

/* product = left' k right, 3 x 3. */
static void transform(double left[3][3], double k[3][3], double right[3][3], double product[3][3])
{
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            product[i][j] = 0.0;
            for (int a = 0; a < 3; a++)
                for (int b = 0; b < 3; b++)
                    product[i][j] += left[a][i] * k[a][b] * right[b][j];
        }
    }
}

/* Adds a brick at the contact: T' k T, block by block. */
static PetscErrorCode add_at_contact(struct body *body, const PetscInt nodes[8],
                                     const int64_t *pair_of, double k[24][24])
{
    struct terms terms[8];
    double block[3][3], product[3][3];

    PetscFunctionBeginUser;
    for (int c = 0; c < 8; c++)
        PetscCall(terms_of(body, nodes[c], pair_of[nodes[c]], &terms[c]));
    for (int i = 0; i < 64; i++) {
        const struct terms *left = &terms[i / 8], *right = &terms[i % 8];
        for (int a = 0; a < 9; a++)
            block[a / 3][a % 3] = k[3 * (i / 8) + a / 3][3 * (i % 8) + a % 3];
        for (PetscInt row = 0; row < left->count; row++) {
            for (PetscInt column = 0; column < right->count; column++) {
                transform(left->block[row], block, right->block[column], product);
                PetscCall(MatSetValuesBlocked(body->A, 1, &left->nodes[row], 1,
                                              &right->nodes[column], product[0], ADD_VALUES));
            }
        }
    }
    for (int c = 0; c < 8; c++)
        PetscCall(PetscFree2(terms[c].nodes, terms[c].block));
    PetscFunctionReturn(0);
}

/* A process adds the bricks whose first node is its own. */
static PetscErrorCode add_box(struct body *body, PetscInt box, const int64_t *pair_of)
{
    static const int corner[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                     {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    const PetscInt n = body->edge[box];
    double at[8][3], k[24][24];
    PetscInt begin, end, nodes[8];

    PetscFunctionBeginUser;
    for (int c = 0; c < 8; c++)
        for (int axis = 0; axis < 3; axis++)
            at[c][axis] = body_line(body, box, axis, corner[c][axis]);
    brick_stiffness(at, material, k);
    PetscCall(MatGetOwnershipRange(body->A, &begin, &end));
    for (PetscInt brick = 0; brick < (n - 1) * (n - 1) * (body->layers[box] - 1); brick++) {
        const PetscInt i = brick % (n - 1), j = brick / (n - 1) % (n - 1),
                       layer = brick / (n - 1) / (n - 1);
        int at_contact = 0;
        for (int c = 0; c < 8; c++) {
            nodes[c] = body_node(body, box, i + corner[c][0], j + corner[c][1], layer + corner[c][2]);
            at_contact |= pair_of[nodes[c]] >= 0;
        }
        if (3 * nodes[0] < begin || 3 * nodes[0] >= end)
            continue;
        if (at_contact)
            PetscCall(add_at_contact(body, nodes, pair_of, k));
        else
            PetscCall(MatSetValuesBlocked(body->A, 8, nodes, 8, nodes, k[0], ADD_VALUES));
    }
    PetscFunctionReturn(0);
}

/* Rows have 81 entries, and more where they couple both sides. */
static PetscErrorCode reserve(struct body *body)
{
    PetscInt local = PETSC_DECIDE, nodes = body->nodes, first = 0, *entries;

    PetscFunctionBeginUser;
    PetscCall(PetscSplitOwnership(PETSC_COMM_WORLD, &local, &nodes));
    PetscCallMPI(MPI_Exscan(&local, &first, 1, MPIU_INT, MPI_SUM, PETSC_COMM_WORLD));
    PetscCall(PetscMalloc1(3 * local, &entries));
    for (PetscInt i = 0; i < 3 * local; i++) {
        const PetscInt node = first + i / 3, box = node >= body->first[1], n = body->edge[box];
        const PetscInt layer = (node - body->first[box]) / (n * n);
        const int couples = body->boxes > 1 && (box == 0 ? layer < 2 : layer == body->layers[box] - 1);
        entries[i] = couples ? 300 : 81;
    }
    PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, 3 * local, 3 * local, body->unknowns, body->unknowns,
                           0, entries, 0, entries, &body->A));
    PetscCall(MatSetBlockSize(body->A, 3));
    PetscCall(MatSetOption(body->A, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_FALSE));
    PetscCall(PetscFree(entries));
    PetscFunctionReturn(0);
}

PetscErrorCode body_assemble(struct body *body)
{
    int64_t *pair_of;

    PetscFunctionBeginUser;
    PetscCall(reserve(body));
    PetscCall(PetscMalloc1(body->nodes, &pair_of));
    for (PetscInt node = 0; node < body->nodes; node++)
        pair_of[node] = -1;
    for (int64_t pair = 0; pair < body->pairs.pairs; pair++)
        pair_of[body->pairs.nodes[pair]] = pair;
    for (PetscInt box = 0; box < body->boxes; box++)
        PetscCall(add_box(body, box, pair_of));
    PetscCall(MatAssemblyBegin(body->A, MAT_FINAL_ASSEMBLY));
    PetscCall(MatAssemblyEnd(body->A, MAT_FINAL_ASSEMBLY));
    PetscCall(PetscFree(pair_of));
    PetscFunctionReturn(0);
}
