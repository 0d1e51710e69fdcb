/* A load case of a model in flexibility form, dense or with some of the inputs sparse. */

#include "fuzz.h"

/* Unknowns of a problem at most. */
enum { MOST = 12 };

/* The matrix of the problem by columns, or one that no call takes. A triangle stands for both; of a matrix in
 * islands entries between pairs of even and odd number are zero. What the judge reads follows. */
static signorini_sparse *a_sparse(problem *p)
{
    const int triangle = (int)between(0, 2), bytes = rarely(2) ? 4 : 8, base = rarely(2), islands = rarely(2);
    int64_t start[MOST + 1], row[MOST * MOST], nnz = 0;
    double values[MOST * MOST];
    for (int64_t j = 0; j < p->n; j++) {
        for (int64_t i = 0; i < p->n; i++) {
            double *own = &p->K[i + p->ld * j];
            if (islands && (i / p->dim + j / p->dim) % 2) *own = 0;
            if (i > j && triangle == 0) p->K[j + p->ld * i] = *own;
            if (i < j && triangle == 1) p->K[j + p->ld * i] = *own;
        }
    }
    for (int64_t j = 0; j < p->n; j++) {
        start[j] = base + nnz;
        for (int64_t i = 0; i < p->n; i++) {
            if ((triangle == 0 && i < j) || (triangle == 1 && i > j)) continue;
            if (p->K[i + p->ld * j] == 0 && !rarely(4)) continue;
            row[nnz] = base + i;
            values[nnz++] = p->K[i + p->ld * j];
        }
    }
    start[p->n] = base + nnz;
    if (!sane() && rarely(8)) start[between(0, p->n)] += between(-2, 2);
    if (!sane() && rarely(8) && nnz > 0) row[between(0, nnz - 1)] += between(-3, 3);
    signorini_sparse *W = input(1, sizeof *W);
    W->struct_size = sizeof *W;
    W->index_bytes = sane() || !rarely(16) ? bytes : 2;
    W->index_base = base;
    W->triangle = sane() || !rarely(16) ? triangle : 3;
    W->size = size_or_wrong(p->n);
    W->nnz = nnz;
    W->col_start = indices(p->n + 1, bytes, start);
    W->row = indices(nnz, bytes, row);
    double *entries = input((size_t)nnz, sizeof *entries);
    if (nnz > 0) memcpy(entries, values, (size_t)nnz * sizeof *entries);
    W->values = entries;
    return W;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    begin(data, size);
    problem p = a_problem();
    const signorini_settings *settings = a_settings();
    const int64_t pairs = size_or_wrong(p.pairs), ld = size_or_wrong(p.ld);
    double *d = outputs(p.n), *F = outputs(p.n), *gap = or_null(p.gap, 4);
    int32_t *state = or_null(states(p.pairs), 8);
    signorini_report *report = or_null(a_report(), 8);
    const signorini_extra *extra = an_extra(p.n, p.pairs, 1);
    const int is_sparse = rarely(2);
    const signorini_sparse *W = is_sparse ? a_sparse(&p) : NULL;
    arm();
    const int32_t status =
        is_sparse ? solve_flexibility_sparse(p.dim, pairs, W, p.f, gap, p.law, p.friction,
                                                       p.slip0, settings, d, F, state, report, extra)
                  : solve_flexibility(p.dim, pairs, p.K, ld, p.f, gap, p.law, p.friction,
                                                p.slip0, settings, d, F, state, report, extra);
    check_arrays(status);
    check_status(status, 15);
    if (status < 0 || pairs != p.pairs || (!is_sparse && ld != p.ld)) return 0;
    p.gap = gap;
    if (status == SIGNORINI_STATUS_SOLVED)
        judge_flexibility(&p, tolerance_of(settings), d, F, state);
    return 0;
}
