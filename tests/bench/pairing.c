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

/* Nodes of a square grid of the size 1 with `lines` lines each way, turned about its middle by `turn` and lifted. */
static void place(int64_t lines, double turn, double lift, double *x)
{
    const double c = cos(turn), s = sin(turn);
    for (int64_t k = 0; k < lines * lines; k++) {
        const double a = (double)(k % lines) / (double)(lines - 1) - 0.5;
        const double b = (double)(k / lines) / (double)(lines - 1) - 0.5;
        x[3 * k] = c * a - s * b;
        x[3 * k + 1] = s * a + c * b;
        x[3 * k + 2] = 0.02 * sin(6.0 * x[3 * k]) * cos(5.0 * x[3 * k + 1]) + lift;
    }
}

/*
 * Faces of the grid whose first node is `first`, seen from above or from below: nodes of a cell by their places along and
 * across, in halves of it.
 */
static struct side faces(int64_t cells, int kind, int64_t first, int from_below)
{
    static const int quad[9][2] = {{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 0}, {2, 1}, {1, 2}, {0, 1}, {1, 1}};
    static const int triangles[2][6][2] = {{{0, 0}, {2, 0}, {2, 2}, {1, 0}, {2, 1}, {1, 1}},
                                           {{0, 0}, {2, 2}, {0, 2}, {1, 1}, {1, 2}, {0, 1}}};
    const int corners = kind % 3 == 0 && kind != 9 ? 3 : 4, pieces = corners == 3 ? 2 : 1;
    const int64_t step = kind > 4 ? 2 : 1, lines = step * cells + 1;
    struct side side = {0, malloc(sizeof(int64_t) * (size_t)(12 * cells * cells))};
    int64_t at = 0;
    if (side.nodes == NULL)
        exit(EXIT_FAILURE);
    for (int64_t k = 0; k < pieces * cells * cells; k++, side.faces++) {
        const int64_t cell = k / pieces;
        const int(*places)[2] = corners == 3 ? triangles[k % pieces] : quad;
        for (int i = 0; i < kind; i++) {
            /* Turned over, the corners run back, and the mid nodes between them from the last but one. */
            const int turned = i < corners          ? corners - 1 - i
                               : i < 2 * corners - 1 ? 3 * corners - 2 - i
                                                     : i;
            const int *place = places[from_below ? turned : i];
            const int64_t along = step * (cell % cells) + place[0] * step / 2;
            const int64_t across = step * (cell / cells) + place[1] * step / 2;
            side.nodes[at++] = first + along + lines * across;
        }
    }
    return side;
}

int main(int argc, char **argv)
{
    const int64_t cells = argc > 1 ? atol(argv[1]) : 0;
    const int kind = argc > 2 ? atoi(argv[2]) : 4;
    const int64_t lines = (kind > 4 ? 2 : 1) * cells + 1, grid = lines * lines;
    double *x = malloc(sizeof(double) * (size_t)(6 * grid));
    signorini_surface_pairs *contact;
    signorini_surface_settings settings;

    if (cells < 1 || (kind != 3 && kind != 4 && kind != 6 && kind != 8 && kind != 9) || x == NULL) {
        fprintf(stderr, "usage: pairing CELLS 3|4|6|8|9\n");
        return EXIT_FAILURE;
    }
    place(lines, 0.0, 0.01 / (double)cells, x);
    place(lines, 0.1, 0.0, x + 3 * grid);
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
    const double bytes = megabytes() - memory;
    /* The cost of a check after a solution: nothing has moved. */
    double *still = calloc((size_t)(6 * grid), sizeof *still);
    signorini_penetration through = {.struct_size = sizeof through};
    const double checked = seconds();
    if (still == NULL || signorini_surface_penetration(contact, still, &through) != 0 || through.points != 0) {
        fprintf(stderr, "pairing: the check found something: %s\n", signorini_last_error());
        return EXIT_FAILURE;
    }
    const double check = seconds() - checked;
    printf("| %d | %lld | %lld | %.2f | %.2f | %.0f | %.2f | %.3f | %.1f %% |\n", kind, (long long)above.faces,
           (long long)surface_data(contact).pairs, took, 1e6 * took / (double)above.faces, bytes,
           1024.0 * bytes / (double)above.faces, check, 100 * check / took);
    free(still);
    signorini_surface_free(contact);
    free(above.nodes);
    free(below.nodes);
    free(x);
    return EXIT_SUCCESS;
}
