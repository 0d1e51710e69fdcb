#include "body.h"

#include <stdlib.h>

static const double low[2][3] = {{0.0, 0.0, 0.0}, {-0.3, -0.3, -0.8}};
static const double size[2][3] = {{1.0, 1.0, 1.0}, {1.6, 1.6, 0.8}};
static const double press = 0.02, shift = 0.006, tilt = 0.015; /* of the height */

/* ---- Mesh ---------------------------------------------------------------------------------- */

PetscInt body_node(const struct body *body, PetscInt box, PetscInt i, PetscInt j, PetscInt k)
{
    const PetscInt n = body->edge[box];
    return body->first[box] + i + n * (j + n * k);
}

double body_line(const struct body *body, PetscInt box, int axis, PetscInt node)
{
    const PetscInt last = axis < 2 ? body->edge[box] - 1 : body->layers[box] - 1;
    const double length = axis < 2 || box > 0 ? size[box][axis] : body->height;
    return low[box][axis] + length * (double)node / (double)last;
}

static PetscErrorCode place_nodes(struct body *body)
{
    PetscFunctionBeginUser;
    PetscCall(PetscMalloc1(3 * body->nodes, &body->at));
    for (PetscInt box = 0; box < body->boxes; box++) {
        const PetscInt n = body->edge[box];
        for (PetscInt node = 0; node < n * n * body->layers[box]; node++) {
            const PetscInt line[3] = {node % n, node / n % n, node / n / n};
            for (int axis = 0; axis < 3; axis++)
                body->at[3 * (body->first[box] + node) + axis] =
                    body_line(body, box, axis, line[axis]);
        }
    }
    PetscFunctionReturn(0);
}

int body_held(const struct body *body, PetscInt node, double u[3])
{
    const PetscInt box = node >= body->first[1], n = body->edge[box];
    const PetscInt layer = (node - body->first[box]) / (n * n);
    const double *at = body->at + 3 * node;

    u[0] = box == 0 ? shift * body->height : 0.0;
    u[1] = 0.5 * u[0] * at[0];
    u[2] = box == 0 ? -(press + tilt * (at[0] - 0.5)) * body->height : 0.0;
    return layer == (box == 0 ? body->layers[0] - 1 : 0);
}

/* ---- Contact --------------------------------------------------------------------------------- */

/* Faces of a box at its bottom or at its top, anticlockwise as seen from outside. */
static int64_t *faces_of(const struct body *body, PetscInt box, int top)
{
    const PetscInt n = body->edge[box], k = top ? body->layers[box] - 1 : 0;
    int64_t *faces = malloc((size_t)(4 * (n - 1) * (n - 1)) * sizeof *faces), *face = faces;

    for (PetscInt j = 0; faces != NULL && j + 1 < n; j++) {
        for (PetscInt i = 0; i + 1 < n; i++, face += 4) {
            face[0] = body_node(body, box, i, j, k);
            face[1] = body_node(body, box, i + top, j + !top, k);
            face[2] = body_node(body, box, i + 1, j + 1, k);
            face[3] = body_node(body, box, i + !top, j + top, k);
        }
    }
    return faces;
}

static signorini_faces side(const struct body *body, PetscInt box, const int64_t *nodes)
{
    const PetscInt n = body->edge[box];
    return (signorini_faces){.struct_size = sizeof(signorini_faces), .face_nodes = 4,
                             .count = (n - 1) * (n - 1), .nodes = nodes};
}

/* Each process makes all pairs: they are few, and the same everywhere. */
static PetscErrorCode make_pairs(struct body *body)
{
    const double radius = 4.0 / body->height;
    const signorini_obstacle ball = {.struct_size = sizeof ball, .kind = SIGNORINI_OBSTACLE_SPHERE,
                                     .point = {0.5, 0.5, -radius}, .radius = radius};
    int64_t *bottom = faces_of(body, 0, 0), *top = body->boxes > 1 ? faces_of(body, 1, 1) : NULL;
    const signorini_faces slave = side(body, 0, bottom);
    signorini_surface_settings settings;
    int32_t status;

    PetscFunctionBeginUser;
    signorini_surface_settings_default(&settings, sizeof settings);
    settings.search_distance = 0.5;
    if (top == NULL) {
        status = signorini_surface_pair_obstacle(3, body->nodes, body->at, &slave, &ball, &settings,
                                                 &body->contact);
    } else {
        const signorini_faces master = side(body, 1, top);
        status = signorini_surface_pair(3, body->nodes, body->at, &slave, &master, &settings,
                                        &body->contact);
    }
    free(bottom);
    free(top);
    PetscCheck(status == 0, PETSC_COMM_SELF, PETSC_ERR_LIB, "%s", signorini_last_error());
    body->pairs.struct_size = sizeof body->pairs;
    signorini_surface_view(body->contact, &body->pairs);
    PetscCall(PetscMalloc1(3 * body->pairs.pairs, &body->place));
    for (int64_t i = 0; i < 3 * body->pairs.pairs; i++)
        body->place[i] = 3 * body->pairs.nodes[i / 3] + i % 3;
    PetscFunctionReturn(0);
}

/* R of a pair: its normal and tangents. */
void body_frame(const struct body *body, int64_t pair, double R[3][3])
{
    const double *n = body->pairs.normals + 3 * pair, *t = body->pairs.tangents + 3 * pair;

    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        R[0][a] = n[a];
        R[1][a] = t[a];
        R[2][a] = n[b] * t[c] - n[c] * t[b];
    }
}

/* ---- Supports -------------------------------------------------------------------------------- */

/* Fixed unknowns become rows of their own, and load the others. */
static PetscErrorCode support(struct body *body)
{
    PetscInt begin, end, count = 0, *fixed;
    double u[3], diagonal;
    Vec moved;

    PetscFunctionBeginUser;
    PetscCall(MatCreateVecs(body->A, &moved, &body->load));
    PetscCall(MatGetOwnershipRange(body->A, &begin, &end));
    PetscCall(PetscMalloc1(end - begin, &fixed));
    for (PetscInt i = begin; i < end; i++) {
        if (!body_held(body, i / 3, u))
            continue;
        fixed[count++] = i;
        PetscCall(VecSetValue(moved, i, u[i % 3], INSERT_VALUES));
    }
    PetscCall(VecAssemblyBegin(moved));
    PetscCall(VecAssemblyEnd(moved));
    diagonal = 1.0 / (double)(body->edge[0] - 1);
    PetscCall(MatZeroRowsColumns(body->A, count, fixed, diagonal, moved, body->load));
    PetscCall(PetscFree(fixed));
    PetscCall(VecDestroy(&moved));
    PetscFunctionReturn(0);
}

/* ---- Rigid motions --------------------------------------------------------------------------- */

/* Motion 0 to 2: along an axis; 3 to 5: about it. */
static double rigid_motion(int motion, const double at[3], int axis)
{
    const int b = (motion + 1) % 3, c = (motion + 2) % 3;
    if (motion < 3)
        return axis == motion;
    return axis == b ? -at[c] : axis == c ? at[b] : 0.0;
}

/* d of a rigid motion, axis by axis: D u_slave + sum w u_other. */
static void relative_motion(const struct body *body, int64_t pair, int motion, double d[3])
{
    const signorini_pairs *rows = body->pairs.rows;
    double R[3][3], sum[3] = {0.0, 0.0, 0.0};

    body_frame(body, pair, R);
    for (int64_t at = rows->row_start[pair]; at < rows->row_start[pair + 1]; at++)
        for (int axis = 0; axis < 3; axis++)
            sum[axis] += rows->row_weights[at] *
                         rigid_motion(motion, body->at + rows->row_nodes[3 * at], axis);
    for (int c = 0; c < 3; c++)
        d[c] = R[c][0] * sum[0] + R[c][1] * sum[1] + R[c][2] * sum[2];
}

static PetscErrorCode rigid_motions(struct body *body)
{
    Vec motions[6];
    PetscInt begin, end;
    PetscScalar shares[6];

    PetscFunctionBeginUser;
    PetscCall(VecGetOwnershipRange(body->load, &begin, &end));
    for (int motion = 0; motion < 6; motion++) {
        double *x, d[3];
        PetscCall(VecDuplicate(body->load, &motions[motion]));
        PetscCall(VecGetArray(motions[motion], &x));
        for (PetscInt i = begin; i < end; i++)
            x[i - begin] = rigid_motion(motion, body->at + i / 3 * 3, (int)(i % 3));
        for (int64_t i = 0; i < 3 * body->pairs.pairs; i++) {
            if (body->place[i] < begin || body->place[i] >= end)
                continue;
            relative_motion(body, i / 3, motion, d);
            x[body->place[i] - begin] = d[i % 3];
        }
        PetscCall(VecRestoreArray(motions[motion], &x));
        PetscCall(VecMDot(motions[motion], motion, motions, shares));
        for (int other = 0; other < motion; other++)
            PetscCall(VecAXPY(motions[motion], -shares[other], motions[other]));
        PetscCall(VecNormalize(motions[motion], NULL));
    }
    PetscCall(MatNullSpaceCreate(PETSC_COMM_WORLD, PETSC_FALSE, 6, motions, &body->rigid));
    for (int motion = 0; motion < 6; motion++)
        PetscCall(VecDestroy(&motions[motion]));
    PetscFunctionReturn(0);
}

/* ---- The whole ------------------------------------------------------------------------------- */

PetscErrorCode body_new(PetscInt edge, PetscInt layers, PetscInt of_foundation, struct body *body)
{
    PetscFunctionBeginUser;
    *body = (struct body){.boxes = of_foundation > 0 ? 2 : 1, .edge = {edge, of_foundation},
                          .layers = {layers, of_foundation},
                          .height = (double)(layers - 1) / (double)(edge - 1)};
    for (PetscInt box = 0; box < MOST_BOXES_OF_BODY; box++)
        body->first[box + 1] =
            body->first[box] + body->edge[box] * body->edge[box] * body->layers[box];
    body->nodes = body->first[MOST_BOXES_OF_BODY];
    body->unknowns = 3 * body->nodes;
    PetscCall(place_nodes(body));
    PetscCall(make_pairs(body));
    PetscCall(body_assemble(body));
    PetscCall(support(body));
    PetscCall(rigid_motions(body));
    PetscFunctionReturn(0);
}

PetscErrorCode body_free(struct body *body)
{
    PetscFunctionBeginUser;
    PetscCall(MatDestroy(&body->A));
    PetscCall(VecDestroy(&body->load));
    PetscCall(MatNullSpaceDestroy(&body->rigid));
    PetscCall(PetscFree(body->at));
    PetscCall(PetscFree(body->place));
    signorini_surface_free(body->contact);
    PetscFunctionReturn(0);
}
