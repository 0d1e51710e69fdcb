/*
 * Gain of threads in the reduction, on a matrix that large_rows.rs has written:
 *
 *     large_threads MATRIX CASE DIM THREADS ...
 *
 * Prints for each number of threads
 *
 *     case,dim,unknowns,contact_dofs,threads,wall_s,cpu_s,caller_cpu_s,bits
 *
 * each time the least of RUNS runs in turn: of the clock on the wall, of all threads, and of the calling thread, which
 * is what a machine without other work would need; and whether every condensed matrix has the same bits. The file is
 * that of large_problem.rs.
 */

#include "../c/everything.h"

#include <string.h>

#define PROGRAM "large_threads"
#include "large_problem.h"

enum { RUNS = 3, MOST = 16, CLOCKS = 3 };

int main(int argc, char **argv)
{
    if (argc < 5 || argc - 4 > MOST) die("usage: large_threads MATRIX CASE DIM THREADS ...");
    const int dim = atoi(argv[3]), counts = argc - 4;
    const struct problem p = read_problem(argv[1], dim);
    const int64_t size = p.size, contact = p.contact, pairs = contact / dim;
    signorini_sparse K = {.struct_size = sizeof K, .size = size, .nnz = p.entries, .index_bytes = 8};
    K.triangle = SIGNORINI_TRIANGLE_LOWER;
    K.col_start = p.starts;
    K.row = p.rows;
    K.values = p.values;

    int64_t *slave = memory((size_t)contact, sizeof *slave);
    int64_t *start = memory((size_t)pairs + 1, sizeof *start);
    double *normal = memory((size_t)contact, sizeof *normal);
    for (int64_t i = 0; i < contact; i++) slave[i] = size - contact + i;
    for (int64_t i = 0; i < pairs; i++) normal[dim * i + dim - 1] = -1;
    signorini_pairs rows = {.struct_size = sizeof rows, .dim = dim, .count = pairs};
    rows.slaves = slave;
    rows.master_start = start;
    rows.normals = normal;

    const size_t entries = (size_t)(contact * contact), bytes = entries * sizeof(double);
    double *first = memory(entries, sizeof *first), *other = memory(entries, sizeof *other);
    const clockid_t clocks[CLOCKS] = {CLOCK_MONOTONIC, CLOCK_PROCESS_CPUTIME_ID,
                                      CLOCK_THREAD_CPUTIME_ID};
    double least[MOST][CLOCKS];
    int same[MOST];
    for (int run = 0; run < RUNS; run++)
        for (int k = 0; k < counts; k++) {
            signorini_settings settings;
            signorini_model *model = NULL;
            signorini_settings_default(&settings, sizeof settings);
            settings.threads = atoi(argv[4 + k]);
            double begin[CLOCKS];
            for (int c = 0; c < CLOCKS; c++) begin[c] = seconds(clocks[c]);
            if (signorini_model_new_sparse(&K, 0, NULL, &rows, &settings, &model) != 0)
                die(signorini_last_error());
            for (int c = 0; c < CLOCKS; c++) {
                const double took = seconds(clocks[c]) - begin[c];
                if (run == 0 || took < least[k][c]) least[k][c] = took;
            }
            if (copy_stiffness(model, run + k ? other : first) != 0)
                die(signorini_last_error());
            same[k] = (run == 0 || same[k]) && (run + k == 0 || memcmp(first, other, bytes) == 0);
            signorini_model_free(model);
        }
    for (int k = 0; k < counts; k++)
        printf("%s,%d,%lld,%lld,%s,%.3f,%.3f,%.3f,%s\n", argv[2], dim, (long long)size,
               (long long)contact, argv[4 + k], least[k][0], least[k][1], least[k][2],
               same[k] ? "same" : "other");
    return 0;
}
