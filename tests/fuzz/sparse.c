/* Sparse models: any columns, fixed degrees of freedom and pairs, in both widths and bases of indices. */

#include "fuzz.h"

/* Degrees of freedom of the matrix at most. */
enum { MOST = 14 };

/* A chain of springs, or any entries. */
static signorini_sparse *a_matrix(int64_t n, int base)
{
    int64_t start[MOST + 1], row[MOST * MOST];
    double values[MOST * MOST], dense[MOST * MOST] = {0};
    const int triangle = (int)between(0, sane() ? 2 : 3), bytes = rarely(2) ? 4 : 8;
    for (int64_t i = 0; i < n; i++) dense[i * n + i] = 1 + between(0, 8) / 4.0;
    for (int64_t springs = between(0, 20), s = 0; s < springs && n > 1; s++) {
        const int64_t i = between(0, n - 1), j = between(0, n - 1);
        const double k = sane() ? between(1, 32) / 8.0 : number();
        dense[i * n + i] += k;
        dense[j * n + j] += k;
        dense[i * n + j] -= k;
        dense[j * n + i] -= k;
    }
    /* Degrees of freedom that only others hold. */
    for (int64_t loose = between(0, 3); loose > 0 && n > 0; loose--) {
        const int64_t i = between(0, n - 1);
        dense[i * n + i] -= 1;
    }
    int64_t nnz = 0;
    for (int64_t j = 0; j < n; j++) {
        start[j] = base + nnz;
        for (int64_t i = 0; i < n; i++) {
            if ((triangle == 0 && i < j) || (triangle == 1 && i > j)) continue;
            if (dense[i * n + j] == 0 && rarely(2)) continue;
            row[nnz] = base + i;
            values[nnz++] = dense[i * n + j];
        }
    }
    start[n] = base + nnz;
    if (!sane() && rarely(4)) start[between(0, n)] += between(-2, 2);
    if (!sane() && rarely(4) && nnz > 0) row[between(0, nnz - 1)] += between(-3, 3);
    signorini_sparse *K = input(1, sizeof *K);
    K->struct_size = sizeof *K;
    K->index_bytes = sane() || !rarely(16) ? bytes : (int32_t)between(0, 9);
    if (K->index_bytes != bytes) K->index_bytes = 2;
    K->index_base = base;
    K->triangle = triangle;
    K->size = n;
    K->nnz = nnz;
    K->col_start = indices(n + 1, bytes, start);
    K->row = indices(nnz, bytes, row);
    double *entries = input((size_t)nnz, sizeof *entries);
    if (nnz > 0) memcpy(entries, values, (size_t)nnz * sizeof *entries);
    K->values = entries;
    if (rarely(4)) {
        int64_t order[MOST];
        for (int64_t i = 0; i < n; i++) order[i] = base + (i + 3) % n;
        if (!sane()) order[0] = between(-1, n);
        K->order = indices(n, bytes, order);
    }
    return K;
}

/* A degree of freedom, rarely one that is not there. */
static int64_t freedom(int64_t n, int base)
{
    return base + (!sane() && rarely(16) ? between(-2, n + 1) : between(0, n - 1));
}

static signorini_pairs *some_pairs(int64_t n, int base, int32_t dim, int64_t count)
{
    signorini_pairs *pairs = input(1, sizeof *pairs);
    pairs->struct_size = sizeof *pairs;
    pairs->dim = dim;
    pairs->count = count;
    const int general = rarely(3), masters = general || rarely(2);
    int64_t *slaves = general ? NULL : input((size_t)(dim * count), sizeof *slaves);
    const int64_t nodes = n / dim;
    for (int64_t i = 0; slaves && i < count; i++) {
        const int64_t node = between(0, nodes - 1);
        for (int c = 0; c < dim; c++)
            slaves[dim * i + c] = sane() ? base + dim * node + c : freedom(n, base);
    }
    pairs->slaves = slaves;
    if (masters) {
        int64_t *start = input((size_t)count + 1, sizeof *start);
        int64_t each[8] = {0}, all = 0;
        for (int64_t i = 0; i < count; i++) {
            each[i] = between(general, 3);
            start[i] = base + all;
            all += each[i];
        }
        start[count] = base + all;
        /* Not the last, which tells how long the arrays are. */
        if (!sane() && rarely(8) && count > 0) start[between(0, count - 1)] += between(-2, 2);
        int64_t *of = input((size_t)(dim * all), sizeof *of);
        double *weights = input((size_t)all, sizeof *weights);
        for (int64_t i = 0, k = 0; i < count; i++) {
            for (int64_t j = 0; j < each[i]; j++, k++) {
                const int64_t node = between(0, nodes - 1);
                for (int c = 0; c < dim; c++)
                    of[dim * k + c] = sane() ? base + dim * node + c : freedom(n, base);
                weights[k] = general && each[i] == 2 ? (j == 0 ? 1 : -1) : 1.0 / (double)each[i];
                if (!sane() && rarely(8)) weights[k] = number();
            }
        }
        if (general) {
            pairs->row_start = start;
            pairs->row_nodes = of;
            pairs->row_weights = weights;
            if (rarely(3)) {
                pairs->row_weights = NULL;
                pairs->row_vectors = numbers(dim * all);
            }
        } else {
            pairs->master_start = start;
            pairs->masters = of;
            pairs->weights = weights;
        }
    }
    double *normals = input((size_t)(dim * count), sizeof *normals);
    for (int64_t i = 0; i < dim * count; i++) normals[i] = sane() ? i % dim == 1 : number();
    if (rarely(2)) {
        for (int64_t i = 0; i < dim * count; i++) normals[i] = number();
    }
    pairs->normals = normals;
    if (rarely(8)) pairs->tangents = numbers(dim * count);
    return pairs;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    begin(data, size);
    const int32_t dim = (int32_t)between(2, 3);
    const int64_t n = dim * between(1, MOST / dim), count = between(0, 3);
    const int base = rarely(2);
    const signorini_sparse *K = a_matrix(n, base);
    const int64_t n_fixed = between(0, 3);
    int64_t *fixed = n_fixed ? input((size_t)n_fixed, sizeof *fixed) : NULL;
    for (int64_t i = 0; i < n_fixed; i++) fixed[i] = freedom(n, base);
    const signorini_pairs *pairs = some_pairs(n, base, dim, count);
    const double *f = numbers(n), *prescribed = rarely(2) ? numbers(n_fixed) : NULL;
    const double *gap = numbers(count);
    const int32_t law = a_law(dim);
    const double *friction = friction_numbers(dim, law, count);
    const signorini_settings *settings = a_settings();
    const int within = rarely(4);
    signorini_model *model = NULL;
    arm();
    int32_t status =
        within ? signorini_model_new_sparse(K, n_fixed, fixed, pairs, settings, &model)
               : signorini_model_new_sparse(K, n_fixed, fixed, pairs, NULL, &model);
    check_arrays(status);
    check_status(status, 6);
    REQUIRE((status == 0) == (model != NULL));
    if (!model) return 0;
    const int64_t N = dim * count;
    double *d = outputs(N), *F = outputs(N), *u = outputs(n), *nodal = outputs(n);
    double *stiffness = outputs(N * N), *load = outputs(N), *frames = outputs(dim * N);
    int32_t *state = states(count);
    signorini_report *report = a_report();
    arm();
    REQUIRE(model_data(model).host_size == n);
    REQUIRE(copy_frames(model, frames) == 0);
    status = signorini_model_solve(model, 1, f, prescribed, gap, law, friction, NULL, settings, d, F,
                                   state, NULL, report, NULL);
    check_arrays(0);
    check_status(status, 15);
    if (status >= 0) {
        const int solved = status == 0;
        problem p = {.dim = dim, .law = law, .pairs = count, .n = N, .ld = N};
        p.gap = (double *)gap;
        p.friction = (double *)friction;
        if (solved || sane()) judge_law(&p, F, state);
        const int dense = copy_stiffness(model, stiffness) == 0 &&
                          signorini_model_condensed_load(model, f, prescribed, load) == 0;
        p.K = stiffness;
        p.f = load;
        if (solved && dense) judge_solution(&p, tolerance_of(settings), d, F, state, report);
        status = signorini_model_recover(model, 1, f, prescribed, d, u);
        check_status(status, 5);
        if (solved) {
            check_recovered(status, u, n);
            check_recovered(signorini_model_nodal_forces(model, F, nodal), nodal, n);
        }
    }
    signorini_model_free(model);
    return 0;
}
