/* Models of Fortran 77: SGSPAR, then SGCASE, SGRECV and SGFREE. */

#include "fortran.h"

/* A chain of springs along each axis, its first node held, its last ones on an obstacle or on each other. */
static integer sparse(int32_t dim, int64_t nodes, int64_t pairs, int64_t *handle)
{
    enum { MOST = 16 };
    integer start[MOST + 1], row[2 * MOST], info = 77;
    double values[2 * MOST];
    const int64_t n = dim * nodes;
    int64_t nnz = 0;
    for (int64_t j = 0; j < n; j++) {
        start[j] = (integer)(nnz + 1);
        row[nnz] = (integer)(j + 1);
        values[nnz++] = 2 + between(0, 8);
        if (j + dim < n && !rarely(8)) {
            row[nnz] = (integer)(j + dim + 1);
            values[nnz++] = sane() ? -1 : number();
        }
    }
    start[n] = (integer)(nnz + 1);
    if (!sane() && rarely(4)) start[between(0, n)] += (integer)between(-2, 2);
    if (!sane() && rarely(4)) row[between(0, nnz - 1)] += (integer)between(-3, 3);
    integer *colptr = input((size_t)n + 1, sizeof *colptr), *rowind = input((size_t)nnz, sizeof *rowind);
    double *entries = input((size_t)nnz, sizeof *entries);
    memcpy(colptr, start, (size_t)(n + 1) * sizeof *colptr);
    memcpy(rowind, row, (size_t)nnz * sizeof *rowind);
    memcpy(entries, values, (size_t)nnz * sizeof *entries);
    const int64_t masters = rarely(2) ? pairs : 0;
    integer *slave = input((size_t)(dim * pairs), sizeof *slave);
    for (int64_t i = 0; i < dim * pairs; i++)
        slave[i] = sane() ? (integer)(n - dim * pairs + i + 1) : (integer)between(-1, n + 1);
    integer *mstart = input(masters ? (size_t)pairs + 1 : 0, sizeof *mstart);
    for (int64_t i = 0; masters && i <= pairs; i++) mstart[i] = (integer)(i + 1);
    const integer *master = some(dim * masters, 1, sane() ? n : n + 1);
    double *weight = input((size_t)masters, sizeof *weight);
    for (int64_t i = 0; i < masters; i++) weight[i] = sane() ? 1 : number();
    double *normal = input((size_t)(dim * pairs), sizeof *normal);
    for (int64_t i = 0; i < dim * pairs; i++) normal[i] = sane() ? i % dim == 0 : number();
    const integer *fixed = some(dim, 1, sane() ? dim : n + 1);
    integer *size = number_of(n), *entry_count = number_of(nnz), *tri = number_of(0);
    const integer *nfix = number_of(dim), *ndim = number_of(dim), *npair = number_of(pairs);
    const integer *nmast = number_of(masters), *ntan = number_of(0);
    const double *tangnt = real_of(0);
    arm();
    ENTRY(sgspar)(size, entry_count, colptr, rowind, entries, tri, nfix, fixed, ndim, npair, slave,
                  nmast, mstart, master, weight, normal, ntan, tangnt, handle, &info);
    check_arrays((int32_t)info);
    return info;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    begin(data, size);
    int64_t handle = 99;
    problem p = {.dim = (int32_t)between(2, 3), .pairs = between(1, 2)};
    p.law = a_law(p.dim);
    p.n = p.dim * p.pairs;
    p.ld = p.n;
    const int64_t nodes = between(p.pairs, 5), host = p.dim * nodes;
    integer info = sparse(p.dim, nodes, p.pairs, &handle);
    check_sentence(info);
    REQUIRE(info <= 0 && (info == 0) == (handle != 0));
    if (info != 0) return 0;
    const int64_t made = handle;

    const double *f = numbers(host), *gap = numbers(p.pairs), *friction;
    friction = friction_numbers(p.dim, p.law, p.pairs);
    const double *slip0 = input((size_t)(p.n - p.pairs), sizeof *slip0);
    const double *presc = input((size_t)p.dim, sizeof *presc);
    const integer *law = number_of(p.law), *method = number_of(rarely(4) ? between(0, 6) : 0);
    const integer *maxit = number_of(200);
    const double *tol = real_of(0);
    double *d = outputs(p.n), *r = outputs(p.n), *eta = outputs(1), *u = outputs(host);
    integer *state = integers(p.pairs), *iter = integers(1);
    arm();
    info = 77;
    ENTRY(sgcase)(&handle, f, presc, gap, law, friction, slip0, method, tol, maxit, d, r, state, eta,
                  iter, &info);
    check_arrays(0);
    check_sentence(info);
    if (info == 0) {
        p.gap = (double *)gap;
        p.friction = (double *)friction;
        judge_law(&p, r, narrow(state, p.pairs));
        ENTRY(sgrecv)(&handle, f, presc, d, u, &info);
        check_recovered((int32_t)info, u, host);
    }
    ENTRY(sgfree)(&handle, &info);
    REQUIRE(info == 0 && handle == 0);
    /* A handle that was freed is refused. */
    handle = made;
    ENTRY(sgrecv)(&handle, f, presc, d, u, &info);
    REQUIRE(info == -1);
    return 0;
}
