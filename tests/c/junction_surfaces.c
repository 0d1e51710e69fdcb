/*
 * The bolted junction of c_examples/junction from its three meshes by pairing alone: with nodes that
 * match, the numbers of its pairs of nodes; with one part meshed twice as fine, forces of the three
 * zones within 1 % of them, in all load steps, without friction and with it.
 */

#include "check.h"

#include "../../c_examples/junction/junction_element.h"
#include "../../c_examples/junction/junction_mesh.h"

#include <stdlib.h>

enum {
    STEPS = 6,
    FRICTIONS = 2,
    MOST_NODES = 6000,
    MOST_ELEMENTS = 6000,
    MOST_EDGES = 200,
    MOST_PAIRS = 200,
    NONE = PARTS, /* the part that is fine */
    /* Places on a grid of half the pitch. */
    COLUMNS = 2 * GRID_R,
    ROWS = 2 * GRID_Z
};

static const double half = ELEMENT_SIDE / 2, closing = 60.0;
static const double inner[STEPS] = {0, 10, 20, 30, 40, 0};
static const double friction[FRICTIONS] = {0.0, 0.3};

struct entry {
    int64_t column, row;
    double value;
};

/* The three parts, one of them fine, with all that the library is given. */
struct meshes {
    int fine;
    int32_t nodes, node_at[PARTS][ROWS][COLUMNS];
    double places[MOST_NODES][2];
    struct entry *entries;
    int64_t count, starts[2 * MOST_NODES + 1], *rows, fixed[2 * MOST_NODES], n_fixed;
    double *values;
    int64_t slave[MOST_EDGES][2], master[MOST_EDGES][2], n_slave, n_master;
};

static int by_place(const void *a, const void *b)
{
    const struct entry *p = a, *q = b;
    if (p->column != q->column) return p->column < q->column ? -1 : 1;
    return (p->row > q->row) - (p->row < q->row);
}

/* Elements of a part are so many halves of the pitch long. */
static int step_of(const struct meshes *m, int part)
{
    return part == m->fine ? 1 : 2;
}

static int32_t node(struct meshes *m, int part, int column, int row)
{
    int32_t *at = &m->node_at[part][row][column];
    if (*at < 0) {
        *at = m->nodes++;
        m->places[*at][0] = half * column;
        m->places[*at][1] = half * row;
        if (column == 0) m->fixed[m->n_fixed++] = 2 * *at;
        if (row == 0) m->fixed[m->n_fixed++] = 2 * *at + 1;
    }
    return *at;
}

/* An element: that of the pitch, scaled. A body of revolution that is half as large is half as stiff. */
static void add_element(struct meshes *m, int part, int column, int row)
{
    const int step = step_of(m, part);
    const double scale = step / 2.0;
    const int32_t corners[4] = {node(m, part, column, row), node(m, part, column + step, row),
                                node(m, part, column + step, row + step),
                                node(m, part, column, row + step)};
    double k[8][8];
    element_stiffness(part, half * column / scale, k);
    for (int a = 0; a < 8; a++)
        for (int b = 0; b < 8; b++) {
            const int64_t i = 2 * corners[a / 2] + a % 2, j = 2 * corners[b / 2] + b % 2;
            if (i >= j)
                m->entries[m->count++] = (struct entry){j, i, scale * k[a][b]};
        }
}

/* The lower triangle in compressed columns. */
static void compress(struct meshes *m)
{
    int64_t entries = 0;
    qsort(m->entries, (size_t)m->count, sizeof *m->entries, by_place);
    for (int64_t k = 0; k < m->count; k++) {
        const struct entry *e = &m->entries[k];
        if (k > 0 && e->column == e[-1].column && e->row == e[-1].row) {
            m->values[entries - 1] += e->value;
            continue;
        }
        m->rows[entries] = e->row;
        m->values[entries++] = e->value;
        m->starts[e->column + 1] = entries;
    }
}

/* The edges of an interface between two of its nodes, on a part; its body lies to the left. */
static void add_edges(struct meshes *m, const struct junction *j, int32_t from, int32_t to, int lower)
{
    const int part = j->part[from], step = step_of(m, part);
    const int row = (int)lround(j->z[from] / half);
    for (int at = (int)lround(j->r[from] / half); at < (int)lround(j->r[to] / half); at += step) {
        const int64_t ends[2] = {node(m, part, at, row), node(m, part, at + step, row)};
        int64_t *edge = lower ? m->slave[m->n_slave++] : m->master[m->n_master++];
        edge[0] = ends[lower];
        edge[1] = ends[!lower];
    }
}

static struct meshes *meshes_new(const struct junction *j, int fine)
{
    struct meshes *m = calloc(1, sizeof *m);
    m->fine = fine;
    m->entries = malloc(64 * MOST_ELEMENTS * sizeof *m->entries);
    m->rows = malloc(64 * MOST_ELEMENTS * sizeof *m->rows);
    m->values = malloc(64 * MOST_ELEMENTS * sizeof *m->values);
    memset(m->node_at, -1, sizeof m->node_at);
    for (int e = 0; e < ELEMENTS; e++) {
        const int32_t corner = j->corners[e][0];
        const int part = j->part[corner], step = step_of(m, part);
        for (int up = 0; up < 2; up += step)
            for (int out = 0; out < 2; out += step)
                add_element(m, part, (int)lround(j->r[corner] / half) + out,
                            (int)lround(j->z[corner] / half) + up);
    }
    compress(m);
    for (int pair = 0; pair + 1 < PAIRS; pair++) {
        if (j->zone[pair] != j->zone[pair + 1])
            continue;
        add_edges(m, j, j->lower[pair], j->lower[pair + 1], 1);
        add_edges(m, j, j->upper[pair], j->upper[pair + 1], 0);
    }
    return m;
}

static void meshes_free(struct meshes *m)
{
    free(m->entries);
    free(m->rows);
    free(m->values);
    free(m);
}

/* ---- Loads --------------------------------------------------------------------------------- */

/* Adds a pressure on an edge of a part along the grid: integrals of its functions by two Gauss points. */
static void press(struct meshes *m, int part, const int from[2], const int to[2], int direction,
                  double pressure, double *f)
{
    const double pi = 3.14159265358979323846;
    const int step = step_of(m, part), across = from[0] != to[0];
    for (int at = from[!across]; at < to[!across]; at += step) {
        const int32_t ends[2] = {
            across ? node(m, part, at, from[1]) : node(m, part, from[0], at),
            across ? node(m, part, at + step, from[1]) : node(m, part, from[0], at + step)};
        for (int point = 0; point < 2; point++) {
            const double share[2] = {0.5 * (1 + (point ? -1 : 1) / sqrt(3.0)),
                                     0.5 * (1 - (point ? -1 : 1) / sqrt(3.0))};
            const double radius =
                share[0] * m->places[ends[0]][0] + share[1] * m->places[ends[1]][0];
            for (int end = 0; end < 2; end++)
                f[2 * ends[end] + direction] += share[end] * pressure * pi * radius * half * step;
        }
    }
}

/* As junction_loads has them: places are counted in halves of the pitch. */
static void loads(struct meshes *m, double inside, double *f)
{
    enum { A, B, C };
    const int ring[2][2] = {{64, 132}, {80, 132}}, flange[2][2] = {{64, 64}, {80, 64}};
    const int bore[2][2] = {{32, 0}, {32, 96}}, cover[2][2] = {{0, 96}, {32, 96}};
    memset(f, 0, sizeof(double) * (size_t)(2 * m->nodes));
    press(m, C, ring[0], ring[1], 1, -closing, f);
    press(m, A, flange[0], flange[1], 1, closing, f);
    press(m, A, bore[0], bore[1], 0, inside, f);
    press(m, B, cover[0], cover[1], 1, inside, f);
}

/* ---- Solutions ----------------------------------------------------------------------------- */

/* Normal forces of each pair in all steps, and what a zone carries. */
struct answer {
    int64_t pairs;
    double force[FRICTIONS][STEPS][2 * MOST_PAIRS], zone[FRICTIONS][STEPS][ZONES];
};

static void solve(struct meshes *m, const signorini_pairs *rows, const double *gaps, const int *zone,
                  struct answer *answer)
{
    static double f[2 * MOST_NODES], d[2 * MOST_PAIRS];
    const signorini_sparse K = {.struct_size = sizeof K, .index_bytes = 8,
                                .triangle = SIGNORINI_TRIANGLE_LOWER, .size = 2 * m->nodes,
                                .nnz = m->starts[2 * m->nodes], .col_start = m->starts,
                                .row = m->rows, .values = m->values};
    signorini_settings settings;
    signorini_model *model = NULL;
    signorini_settings_default(&settings, sizeof settings);
    settings.tolerance = 1e-12;
    answer->pairs = rows->count;
    CHECK_STATUS(signorini_model_new_sparse(&K, m->n_fixed, m->fixed, rows, NULL, &model), 0);
    for (int i = 0; i < FRICTIONS && model != NULL; i++) {
        double mu[MOST_PAIRS], slip[MOST_PAIRS] = {0};
        for (int64_t pair = 0; pair < rows->count; pair++) mu[pair] = friction[i];
        for (int s = 0; s < STEPS; s++) {
            double *F = answer->force[i][s];
            loads(m, inner[s], f);
            CHECK_STATUS(signorini_model_solve(model, 1, f, NULL, gaps, SIGNORINI_LAW_COULOMB, mu,
                                               slip, &settings, d, F, NULL, NULL, NULL, NULL), 0);
            for (int64_t pair = 0; pair < rows->count; pair++) {
                slip[pair] = d[2 * pair + 1];
                answer->zone[i][s][zone[pair] - 1] -= F[2 * pair];
            }
        }
    }
    signorini_model_free(model);
}

/* By pairs of nodes, as the example has them. */
static void by_nodes(struct meshes *m, const struct junction *j, struct answer *answer)
{
    int64_t slaves[PAIRS][2], masters[PAIRS][2], starts[PAIRS + 1];
    double weights[PAIRS], normals[PAIRS][2], tangents[PAIRS][2], gaps[PAIRS] = {0};
    const signorini_pairs rows = {.struct_size = sizeof rows, .dim = 2, .count = PAIRS,
                                  .slaves = slaves[0], .master_start = starts,
                                  .masters = masters[0], .weights = weights,
                                  .normals = normals[0], .tangents = tangents[0]};
    for (int i = 0; i <= PAIRS; i++) {
        starts[i] = i;
        if (i == PAIRS) break;
        for (int axis = 0; axis < 2; axis++) {
            const int row = (int)lround(j->z[j->lower[i]] / half);
            const int column = (int)lround(j->r[j->lower[i]] / half);
            slaves[i][axis] = 2 * node(m, j->part[j->lower[i]], column, row) + axis;
            masters[i][axis] = 2 * node(m, j->part[j->upper[i]], column, row) + axis;
            normals[i][axis] = axis;
            tangents[i][axis] = !axis;
        }
        weights[i] = 1;
    }
    solve(m, &rows, gaps, j->zone, answer);
}

/* By surfaces: the three zones in one call. Tells the place of each pair's slave. */
static signorini_surface_pairs *by_surfaces(struct meshes *m, struct answer *answer)
{
    const signorini_faces slave = {.struct_size = sizeof slave, .face_nodes = 2,
                                   .count = m->n_slave, .nodes = m->slave[0]};
    const signorini_faces master = {.struct_size = sizeof master, .face_nodes = 2,
                                    .count = m->n_master, .nodes = m->master[0]};
    signorini_surface_pairs *contact;
    int zone[MOST_PAIRS] = {0};
    signorini_surface_settings settings;
    signorini_surface_settings_default(&settings, sizeof settings);
    settings.axisymmetric = 1;
    CHECK_STATUS(signorini_surface_pair(2, m->nodes, m->places[0], &slave, &master, &settings, &contact), 0);
    const double *points = surface_data(contact).points;
    for (int64_t pair = 0; pair < surface_data(contact).pairs; pair++)
        zone[pair] = points[2 * pair + 1] < 135 ? 1 : points[2 * pair] < 95 ? 2 : 3;
    solve(m, surface_data(contact).rows, surface_data(contact).gaps, zone, answer);
    return contact;
}

int main(void)
{
    static struct answer wanted, found;
    struct junction *junction = junction_new();
    struct meshes *m = meshes_new(junction, NONE);
    CHECK(m->nodes == NODES && m->n_fixed == FIXED);
    by_nodes(m, junction, &wanted);
    signorini_surface_pairs *contact = by_surfaces(m, &found);
    CHECK(found.pairs == PAIRS);

    /* Rows that are the same but for rounding; the tangent of the library points inwards, that of the
     * example outwards. */
    double off = 0, most = 0;
    for (int pair = 0; pair < PAIRS; pair++) {
        int64_t other = 0;
        const double *at = junction->r, *point = &surface_data(contact).points[2 * pair];
        while (other < PAIRS && (fabs(at[junction->lower[other]] - point[0]) > 1e-9 ||
                                 fabs(junction->z[junction->lower[other]] - point[1]) > 1e-9))
            other++;
        CHECK(other < PAIRS);
        for (int i = 0; i < FRICTIONS && other < PAIRS; i++)
            for (int s = 0; s < STEPS; s++) {
                const double *a = &found.force[i][s][2 * pair];
                const double *b = &wanted.force[i][s][2 * other];
                off = fmax(off, fmax(fabs(a[0] - b[0]), fabs(a[1] + b[1])));
                most = fmax(most, fabs(b[0]));
            }
    }
    signorini_surface_free(contact);
    meshes_free(m);
    printf("matching: forces off by %.0e of the largest\n", off / most);
    CHECK(off <= 1e-9 * most);

    /* The finer part bends more, and the weights of its rows know the radius up to the element. */

    for (int fine = 0; fine < PARTS; fine++) {
        memset(&found, 0, sizeof found);
        m = meshes_new(junction, fine);
        signorini_surface_free(by_surfaces(m, &found));
        double part = 0;
        for (int i = 0; i < FRICTIONS; i++)
            for (int s = 0; s < STEPS; s++)
                for (int zone = 0; zone < ZONES; zone++)
                    part = fmax(part, fabs(found.zone[i][s][zone] / wanted.zone[i][s][zone] - 1));
        printf("part %c fine: %lld pairs, forces of zones off by %.2f %% at most\n", "ABC"[fine],
               (long long)found.pairs, 100 * part);
        CHECK(part <= 0.01);
        meshes_free(m);
    }
    free(junction);
    return check_summary("junction_surfaces");
}
