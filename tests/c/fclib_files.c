/*
 * Writes FCLIB files whose solutions are known, for c_examples/fclib/solve_fclib.c.
 *
 *     fclib_files DIRECTORY
 *
 * In space: reactions r and velocities u are chosen so that FCLIB's law holds, one contact sticks,
 * one slips, one is open; q is then u - W r. All numbers have few binary digits: q is exact. W is
 * strictly diagonally dominant, and so is positive definite. In the plane: W is diagonal, so each
 * contact is solved by hand from its data.
 */

#include <fclib.h>

#include <stdio.h>

enum { CONTACTS = 3, SIZE = 3 * CONTACTS, FREEDOMS = SIZE + 1 };

/* mu = 1/2. Stick: |(1, -1)| < 2. Slip: |(3, -4)| = 5 = 10 / 2, u_T = -(3, -4) / 4. */
static double mu[CONTACTS] = {0.5, 0.5, 0.5};
static double r[SIZE] = {4, 1, -1, 10, 3, -4, 0, 0, 0};
static double u[SIZE] = {0, 0, 0, 0, -0.75, 1, 0.5, 2, -1};

/* Symmetric, the diagonal larger than the rest of its row: the rest is at most 9 / 8. */
static double entry(int i, int j)
{
    if (i == j)
        return 2.0 + i % 3;
    return (i + j) % 2 == 0 ? 0.125 : -0.125;
}

/* The entries of a full matrix, in whatever storage. */
static void fill(struct fclib_matrix *matrix, int rows, int columns, int nz, int *p, int *i,
                 double *x, double (*of)(int, int))
{
    const int outer = nz == -2 ? rows : columns, inner = nz == -2 ? columns : rows;
    int count = 0;
    *matrix = (struct fclib_matrix){.m = rows, .n = columns, .p = p, .i = i, .x = x};
    for (int a = 0; a < outer; a++) {
        if (nz < 0)
            p[a] = count;
        for (int b = 0; b < inner; b++) {
            const double value = nz == -2 ? of(a, b) : of(b, a);
            if (value == 0.0)
                continue;
            if (nz >= 0)
                p[count] = a;
            i[count] = b;
            x[count++] = value;
        }
    }
    if (nz < 0)
        p[outer] = count;
    matrix->nzmax = count;
    matrix->nz = nz >= 0 ? count : nz;
}

static const char *place(const char *directory, const char *name)
{
    static char path[4096];
    snprintf(path, sizeof path, "%s/%s.hdf5", directory, name);
    remove(path);
    return path;
}

static int finish(const char *path, double *v, double *velocity, double *reaction)
{
    struct fclib_solution solution = {.v = v, .u = velocity, .r = reaction};
    return fclib_write_solution(&solution, path);
}

static int write_local(const char *path, int nz, double (*of)(int, int))
{
    int p[SIZE * SIZE], i[SIZE * SIZE];
    double x[SIZE * SIZE], q[SIZE];
    struct fclib_matrix W;
    struct fclib_local problem = {.W = &W, .mu = mu, .q = q, .spacedim = 3};
    fill(&W, SIZE, SIZE, nz, p, i, x, of);
    for (int a = 0; a < SIZE; a++) {
        q[a] = u[a];
        for (int b = 0; b < SIZE; b++)
            q[a] -= of(a, b) * r[b];
    }
    return fclib_write_local(&problem, path) && finish(path, NULL, u, r);
}

/* Each component of a contact has a degree of freedom, in reverse order; the first has none. */
static double lever(int row, int column)
{
    return row == SIZE - column ? 1.0 : 0.0;
}

/* The half of a symmetric matrix that stands for the whole. */
static double upper(int i, int j)
{
    return i <= j ? entry(i, j) : 0.0;
}

/* M is stored as the matrix that is given. */
static int write_global(const char *path, int nz, double (*stored)(int, int))
{
    int p[2][FREEDOMS * FREEDOMS], i[2][FREEDOMS * FREEDOMS];
    double x[2][FREEDOMS * FREEDOMS], f[FREEDOMS], w[SIZE], v[FREEDOMS] = {1.0};
    struct fclib_matrix M, H;
    struct fclib_global problem = {
        .M = &M, .H = &H, .mu = mu, .f = f, .w = w, .spacedim = 3};
    fill(&M, FREEDOMS, FREEDOMS, nz, p[0], i[0], x[0], stored);
    fill(&H, FREEDOMS, SIZE, nz, p[1], i[1], x[1], lever);
    /* u = H' v + w and M v = H r + f. */
    for (int a = 0; a < SIZE; a++) {
        w[a] = 0.25 * a;
        v[SIZE - a] = u[a] - w[a];
    }
    for (int a = 0; a < FREEDOMS; a++) {
        f[a] = a == 0 ? 0.0 : -r[SIZE - a];
        for (int b = 0; b < FREEDOMS; b++)
            f[a] += entry(a, b) * v[b];
    }
    return fclib_write_global(&problem, path) && finish(path, v, u, r);
}

static double plane(int i, int j)
{
    return i != j ? 0.0 : i % 2 == 0 ? 2.0 : 4.0;
}

/* r_N = 8 / 2 = 4, mu r_N = 2. Stick: r_T = -2 / 4. Slip: to stick takes -12 / 4, friction has -2,
 * and u_T = 12 - 4 * 2. Open: u_N = 3 without a reaction. */
static int write_plane(const char *path)
{
    double q[] = {-8, 2, -8, 12, 3, -1};
    double reaction[] = {4, -0.5, 4, -2, 0, 0}, velocity[] = {0, 0, 0, 4, 3, -1};
    int p[2 * CONTACTS + 1], i[2 * CONTACTS];
    double x[2 * CONTACTS];
    struct fclib_matrix W;
    struct fclib_local problem = {.W = &W, .mu = mu, .q = q, .spacedim = 2};
    fill(&W, 2 * CONTACTS, 2 * CONTACTS, -1, p, i, x, plane);
    return fclib_write_local(&problem, path) && finish(path, NULL, velocity, reaction);
}

/* The second contact moves as the first does: W has rank 6. */
static double twice(int i, int j)
{
    return entry(i >= 3 && i < 6 ? i - 3 : i, j >= 3 && j < 6 ? j - 3 : j);
}

static double lopsided(int i, int j)
{
    return entry(i, j) + (i < j ? 0.0625 : 0.0);
}

int main(int argc, char **argv)
{
    if (argc != 2) {
        fprintf(stderr, "usage: %s DIRECTORY\n", argv[0]);
        return 2;
    }
    const char *in = argv[1];
    const int written = write_local(place(in, "triplets"), 0, entry) &&
        write_local(place(in, "columns"), -1, entry) && write_local(place(in, "rows"), -2, entry) &&
        write_global(place(in, "global_triplets"), 0, entry) &&
        write_global(place(in, "global_columns"), -1, entry) &&
        write_global(place(in, "global_rows"), -2, entry) &&
        write_global(place(in, "global_half"), 0, upper) && write_plane(place(in, "plane")) &&
        write_local(place(in, "singular"), -1, twice) &&
        write_local(place(in, "lopsided"), -1, lopsided);
    return written ? 0 : 1;
}
