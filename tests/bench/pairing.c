/*
 * The cost of pairing two surfaces in space: `pairing CELLS KIND` pairs a slave side of CELLS x CELLS faces
 * with a master side of as many that do not match, and prints a row of a table.
 *
 * The sides are wavy, 1 % of an element apart, and turned against each other, so that faces lie over each
 * other in all ways. KIND is the number of nodes of a face, 4 or 3 (two triangles in a cell). Both sides lie
 * within 1 x 1; memory is the peak of the process, less what it has before the call.
 */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <time.h>

#include "../c/everything.h"

struct side {
    int64_t faces, *nodes;
};

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static double megabytes(void)
{
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return (double)usage.ru_maxrss / 1024.0;
}

/* Nodes of a square grid of the size 1, turned about its middle by `turn` and lifted. */
static void place(int64_t cells, double turn, double lift, double *x)
{
    const double c = cos(turn), s = sin(turn);
    for (int64_t k = 0; k < (cells + 1) * (cells + 1); k++) {
        const double a = (double)(k % (cells + 1)) / (double)cells - 0.5;
        const double b = (double)(k / (cells + 1)) / (double)cells - 0.5;
        x[3 * k] = c * a - s * b;
        x[3 * k + 1] = s * a + c * b;
        x[3 * k + 2] = 0.02 * sin(6.0 * x[3 * k]) * cos(5.0 * x[3 * k + 1]) + lift;
    }
}

/* Faces of the grid whose first node is `first`, seen from above or from below. */
static struct side faces(int64_t cells, int kind, int64_t first, int from_below)
{
    struct side side = {0, malloc(sizeof(int64_t) * (size_t)(6 * cells * cells))};
    int64_t at = 0;
    if (side.nodes == NULL)
        exit(EXIT_FAILURE);
    for (int64_t k = 0; k < cells * cells; k++) {
        const int64_t a = first + k % cells + (cells + 1) * (k / cells), d = a + cells + 1;
        const int64_t quad[4] = {a, a + 1, d + 1, d}, triangles[6] = {a, a + 1, d + 1, a, d + 1, d};
        const int64_t *corners = kind == 4 ? quad : triangles;
        for (int piece = 0; piece < (kind == 4 ? 1 : 2); piece++, side.faces++)
            for (int i = 0; i < kind; i++)
                side.nodes[at++] = corners[kind * piece + (from_below ? kind - 1 - i : i)];
    }
    return side;
}

int main(int argc, char **argv)
{
    const int64_t cells = argc > 1 ? atol(argv[1]) : 0;
    const int kind = argc > 2 ? atoi(argv[2]) : 4;
    const int64_t grid = (cells + 1) * (cells + 1);
    double *x = malloc(sizeof(double) * (size_t)(6 * grid));
    signorini_surface_pairs *contact;
    signorini_surface_settings settings;

    if (cells < 1 || (kind != 3 && kind != 4) || x == NULL) {
        fprintf(stderr, "usage: pairing CELLS 3|4\n");
        return EXIT_FAILURE;
    }
    place(cells, 0.0, 0.01 / (double)cells, x);
    place(cells, 0.1, 0.0, x + 3 * grid);
    const struct side above = faces(cells, kind, 0, 1), below = faces(cells, kind, grid, 0);
    const signorini_faces slave = {.struct_size = sizeof slave, .face_nodes = kind,
                                   .count = above.faces, .nodes = above.nodes};
    const signorini_faces master = {.struct_size = sizeof master, .face_nodes = kind,
                                    .count = below.faces, .nodes = below.nodes};
    signorini_surface_settings_default(&settings, sizeof settings);
    settings.search_distance = 1.0 / (double)cells;

    const double memory = megabytes(), begin = seconds();
    const int32_t status =
        signorini_surface_pair(3, 2 * grid, x, &slave, &master, &settings, &contact);
    const double took = seconds() - begin;
    if (status != 0) {
        fprintf(stderr, "pairing: %s\n", signorini_last_error());
        return EXIT_FAILURE;
    }
    printf("| %d | %lld | %lld | %.2f | %.2f | %.0f | %.2f |\n", kind, (long long)above.faces,
           (long long)surface_data(contact).pairs, took, 1e6 * took / (double)above.faces, megabytes() - memory,
           1024.0 * (megabytes() - memory) / (double)above.faces);
    signorini_surface_free(contact);
    free(above.nodes);
    free(below.nodes);
    free(x);
    return EXIT_SUCCESS;
}
