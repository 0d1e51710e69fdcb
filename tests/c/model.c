/*
 * Models: what a call returns, what it writes, and every malformed input.
 *
 * The sparse model is two springs in a row: node A (components 0, 1) on node B (2, 3), each held to
 * the ground by springs, with one pair between them. Node C (4, 5) is on its own.
 */

#include "check.h"

#include <stddef.h>
#include <stdlib.h>

enum { SIZE = 6, MOST = 16 };

/* One pair: n = (0, -1), t = (1, 0). */
static struct input {
    signorini_sparse K;
    signorini_pairs pairs;
    int64_t n_fixed;
    int64_t starts[SIZE + 1], rows[MOST];
    int32_t narrow_starts[SIZE + 1], narrow_rows[MOST];
    double values[MOST];
    int64_t fixed[4];
    int64_t slaves[4], master_start[3], masters[4];
    double weights[2], normals[4], tangents[4];
    signorini_sparse *K_pointer;
    signorini_pairs *pairs_pointer;
    int64_t *fixed_pointer;
} in;

/* Lower triangle: 3 on the diagonal, A.x with A.y by 1, C.x with C.y by -1. C.y is fixed. */
static void prepare(void)
{
    memset(&in, 0, sizeof in);
    const int64_t starts[] = {0, 2, 3, 4, 5, 7, 8};
    const int64_t rows[] = {0, 1, 1, 2, 3, 4, 5, 5};
    const double values[] = {3, 1, 3, 3, 3, 3, -1, 3};
    memcpy(in.starts, starts, sizeof starts);
    memcpy(in.rows, rows, sizeof rows);
    memcpy(in.values, values, sizeof values);
    in.K = (signorini_sparse){.struct_size = sizeof in.K,
                              .index_bytes = 8,
                              .index_base = 0,
                              .triangle = SIGNORINI_TRIANGLE_LOWER,
                              .size = SIZE,
                              .nnz = 8,
                              .col_start = in.starts,
                              .row = in.rows,
                              .values = in.values};
    in.n_fixed = 1;
    in.fixed[0] = 5;
    in.slaves[0] = 0;
    in.slaves[1] = 1;
    in.master_start[1] = 1;
    in.masters[0] = 2;
    in.masters[1] = 3;
    in.weights[0] = 1;
    in.normals[1] = -1;
    in.tangents[0] = 1;
    in.pairs = (signorini_pairs){.struct_size = sizeof in.pairs,
                                 .dim = 2,
                                 .count = 1,
                                 .slaves = in.slaves,
                                 .master_start = in.master_start,
                                 .masters = in.masters,
                                 .weights = in.weights,
                                 .normals = in.normals,
                                 .tangents = in.tangents};
    in.K_pointer = &in.K;
    in.pairs_pointer = &in.pairs;
    in.fixed_pointer = in.fixed;
}

static int32_t make(signorini_model **model)
{
    return signorini_model_new_sparse(in.K_pointer, in.n_fixed, in.fixed_pointer, in.pairs_pointer, NULL,
                                      model);
}

static signorini_model *made(void)
{
    signorini_model *model = NULL;
    CHECK_STATUS(make(&model), 0);
    CHECK(model != NULL);
    return model;
}

/* Expects the status, the part of the sentence, and NULL in the place of the model. */
static void expect(int line, const char *name, int32_t status, const char *part)
{
    signorini_model *const poison = (signorini_model *)(void *)&in;
    signorini_model *model = poison;
    const int32_t got = make(&model);
    const char *sentence = signorini_last_error();
    if (!check_result(__FILE__, line, got == status))
        printf("%s: %d, not %d (%s)\n", name, (int)got, (int)status, sentence);
    if (!check_result(__FILE__, line, strstr(sentence, part) != NULL))
        printf("%s: \"%s\" does not contain \"%s\"\n", name, sentence, part);
    if (!check_result(__FILE__, line, model == NULL)) printf("%s: there is a model\n", name);
    if (model != poison) signorini_model_free(model);
}

#define BAD(name, status, part, ...)                                                              \
    do {                                                                                          \
        prepare();                                                                                \
        __VA_ARGS__;                                                                              \
        expect(__LINE__, name, status, part);                                                     \
    } while (0)
#define BAD_K(name, part, ...) BAD(name, -1, part, __VA_ARGS__)
#define BAD_FIXED(name, part, ...) BAD(name, -3, part, __VA_ARGS__)
#define BAD_PAIRS(name, part, ...) BAD(name, -4, part, __VA_ARGS__)

static void bad_matrix(void)
{
    BAD_K("K is NULL", "K is NULL", in.K_pointer = NULL);
    BAD_K("K is misaligned", "not aligned",
          in.K_pointer = (signorini_sparse *)(void *)((char *)&in.K + 4));
    BAD_K("struct_size is 0", "struct_size is 0", in.K.struct_size = 0);
    BAD_K("struct_size is too small", "struct_size", in.K.struct_size -= 16);
    BAD_K("struct_size is too large", "struct_size", in.K.struct_size += 8);
    BAD_K("index_bytes is 3", "index_bytes is 3", in.K.index_bytes = 3);
    BAD_K("index_bytes is 0", "index_bytes is 0", in.K.index_bytes = 0);
    BAD_K("index_base is 2", "index_base is 2", in.K.index_base = 2);
    BAD_K("index_base is -1", "index_base is -1", in.K.index_base = -1);
    BAD_K("triangle is 7", "triangle 7", in.K.triangle = 7);
    BAD_K("triangle is -1", "triangle -1", in.K.triangle = -1);
    BAD_K("size is negative", "size is -1", in.K.size = -1);
    BAD_K("size is the largest number", "", in.K.size = INT64_MAX);
    BAD_K("nnz is negative", "nnz is -1", in.K.nnz = -1);
    BAD_K("nnz is the largest number", "", in.K.nnz = INT64_MAX);
    BAD_K("col_start is NULL", "col_start is NULL", in.K.col_start = NULL);
    BAD_K("row is NULL", "row is NULL", in.K.row = NULL);
    BAD_K("values is NULL", "values is NULL", in.K.values = NULL);
    BAD_K("col_start is misaligned", "col_start is not aligned",
          in.K.col_start = (char *)in.starts + 4);
    BAD_K("row is misaligned", "row is not aligned", in.K.row = (char *)in.rows + 4);
    BAD_K("col_start does not begin at 0", "col_start[0] is 1, but index_base is 0",
          in.starts[0] = 1);
    BAD_K("col_start descends", "col_start[3] is 4, less than col_start[2], which is 5",
          in.starts[2] = 5);
    BAD_K("a start is negative", "col_start[2] is -1", in.starts[2] = -1);
    BAD_K("a start is beyond the entries", "col_start[2] is 9, beyond", in.starts[2] = 9);
    BAD_K("col_start ends before the entries", "the columns hold 7 entries",
          in.starts[SIZE] = 7);
    BAD_K("col_start ends beyond the entries", "the columns hold 9 entries",
          in.starts[SIZE] = 9);
    BAD_K("col_start counts from 1", "set index_base to 1",
          for (int i = 0; i <= SIZE; i++) in.starts[i]++);
    BAD_K("a row is out of range", "column 4", in.rows[6] = 6);
    BAD_K("a row is negative", "column 0", in.rows[0] = -1);
    BAD_K("a row is the least number", "column 0", in.rows[0] = INT64_MIN; in.K.index_base = 1;
          for (int i = 0; i <= SIZE; i++) in.starts[i]++; in.fixed[0]++; in.slaves[0]++;
          in.slaves[1]++; in.masters[0]++; in.masters[1]++; in.master_start[0]++;
          in.master_start[1]++);
    BAD_K("rows do not ascend", "ascend", in.rows[5] = 5, in.rows[6] = 4);
    BAD_K("a row stands twice", "row 4 is listed twice", in.rows[6] = 4);
    BAD_K("an entry is in the upper triangle", "K[0,1] is not in the triangle", in.rows[2] = 0);
    BAD_K("an entry is in the lower triangle", "K[1,0] is not in the triangle",
          in.K.triangle = SIGNORINI_TRIANGLE_UPPER);
    BAD_K("a value is NaN", "K[5,4] is not finite", in.values[6] = NAN);
    BAD_K("a value is infinite", "K[5,4] is not finite", in.values[6] = -INFINITY);
    BAD_K("a diagonal entry is missing", "K[1,1] is missing", in.rows[2] = 2);
    BAD_K("a diagonal entry is zero", "K[1,1] is 0", in.values[2] = 0);
    BAD_K("a diagonal entry is negative", "K[1,1] is -3", in.values[2] = -3);
    BAD_K("index_bytes is 8 of int32_t", "are these integers of 4 bytes, and index_bytes 8?",
          in.narrow_starts[1] = 2, in.K.col_start = in.narrow_starts);
    BAD_K("size is the number of nodes", "size, here 3, must be the number of degrees of freedom",
          in.K.size = 3);
    BAD_K("nnz is one short", "the columns hold 8 entries", in.K.nnz = 7);
    BAD_K("a column is empty", "K[5,5] is missing", in.starts[6] = 7, in.K.nnz = 7);
    BAD_K("half of an off-diagonal pair", "not symmetric", in.K.triangle = SIGNORINI_TRIANGLE_FULL);
    const int64_t starts[] = {0, 2, 4, 5, 6, 8, 10}, rows[] = {0, 1, 0, 1, 2, 3, 4, 5, 4, 5};
    const double values[] = {3, 1, 1.001, 3, 3, 3, 3, -1, -1, 3};
    BAD_K("full and not symmetric", "K[1,0] is 1, K[0,1] is 1.001",
          in.K.triangle = SIGNORINI_TRIANGLE_FULL, in.K.nnz = 10,
          memcpy(in.starts, starts, sizeof starts), memcpy(in.rows, rows, sizeof rows),
          memcpy(in.values, values, sizeof values));
    BAD_K("indefinite", "degree of freedom 5", in.values[5] = 1, in.values[6] = -2,
          in.values[7] = 1, in.n_fixed = 0);
    BAD_K("a motion that nothing holds", "no support and no pair holds", in.values[6] = -3,
          in.n_fixed = 0);
}

static void bad_fixed(void)
{
    BAD("n_fixed is negative", -2, "n_fixed is -1", in.n_fixed = -1);
    BAD_FIXED("fixed is NULL", "fixed is NULL", in.fixed_pointer = NULL);
    BAD_FIXED("fixed is misaligned", "fixed is not aligned",
             in.fixed_pointer = (int64_t *)(void *)((char *)in.fixed + 4));
    BAD_FIXED("fixed too high", "no degree of freedom 6", in.fixed[0] = 6);
    BAD_FIXED("fixed negative", "fixed[0] is -1", in.fixed[0] = -1);
    BAD_FIXED("fixed the least number", "fixed[0]", in.fixed[0] = INT64_MIN);
    BAD_FIXED("fixed twice", "5 is listed twice", in.fixed[1] = 5, in.n_fixed = 2);
}

static void bad_pairs(void)
{
    BAD_PAIRS("pairs is NULL", "pairs is NULL", in.pairs_pointer = NULL);
    BAD_PAIRS("struct_size is 0", "struct_size is 0", in.pairs.struct_size = 0);
    BAD_PAIRS("struct_size is too small", "struct_size", in.pairs.struct_size -= 8);
    BAD_PAIRS("struct_size is too large", "struct_size", in.pairs.struct_size += 8);
    BAD_PAIRS("dim is 1", "dim is 1", in.pairs.dim = 1);
    BAD_PAIRS("dim is 4", "dim is 4", in.pairs.dim = 4);
    BAD_PAIRS("count is negative", "count is -1", in.pairs.count = -1);
    BAD_PAIRS("count is the largest number", "", in.pairs.count = INT64_MAX);
    BAD_PAIRS("slaves is NULL", "slaves is NULL", in.pairs.slaves = NULL);
    BAD_PAIRS("masters is NULL", "masters is NULL", in.pairs.masters = NULL);
    BAD_PAIRS("weights is NULL", "weights is NULL", in.pairs.weights = NULL);
    BAD_PAIRS("master_start is NULL", "master_start is NULL, but masters or weights is not",
              in.pairs.master_start = NULL);
    BAD_PAIRS("master_start and masters are NULL", "master_start is NULL",
              in.pairs.master_start = in.pairs.masters = NULL);
    BAD_PAIRS("master_start and weights are NULL", "master_start is NULL",
              in.pairs.master_start = NULL, in.pairs.weights = NULL);
    BAD_PAIRS("normals is NULL", "normals is NULL", in.pairs.normals = NULL);
    BAD_PAIRS("slave out of range", "degree of freedom 6", in.slaves[1] = 6);
    BAD_PAIRS("slave negative", "slaves[0] is -1", in.slaves[0] = -1);
    BAD_PAIRS("slave on one component twice", "its slave has degree of freedom 0 twice",
              in.slaves[1] = 0);
    BAD_PAIRS("master out of range", "degree of freedom 6", in.masters[1] = 6);
    BAD_PAIRS("master negative", "masters[1] is -1", in.masters[1] = -1);
    BAD_PAIRS("master that is its own slave", "pair 0: its weights cancel, so that no node moves it",
              in.masters[0] = 0, in.masters[1] = 1);
    BAD_PAIRS("master begins do not begin at 0", "begin", in.master_start[0] = 1);
    BAD_PAIRS("master begins are negative", "master_start[0]", in.master_start[0] = -1);
    BAD_PAIRS("master begins descend", "begin", in.pairs.count = 2, in.slaves[2] = 4,
              in.slaves[3] = 5, in.master_start[1] = 2, in.master_start[2] = 1,
              in.normals[3] = -1);
    BAD_PAIRS("weights sum to less", "weights sum to 0.5", in.weights[0] = 0.5);
    BAD_PAIRS("weights sum to more", "weights sum to 1.00001", in.weights[0] = 1.00001);
    BAD_PAIRS("a weight is NaN", "weights sum to NaN", in.weights[0] = NAN);
    BAD_PAIRS("a weight is infinite", "weights sum to inf", in.weights[0] = INFINITY);
    BAD_PAIRS("normal is zero", "normal is zero", in.normals[1] = 0);
    BAD_PAIRS("normal is NaN", "normal is zero or not finite", in.normals[0] = NAN);
    BAD_PAIRS("normal is infinite", "not finite", in.normals[1] = INFINITY);
    BAD_PAIRS("tangent is zero", "tangent is zero", in.tangents[0] = 0);
    BAD_PAIRS("tangent along the normal", "pair 0: its tangent is not orthogonal to its normal",
              in.tangents[0] = 0, in.tangents[1] = 2);
    BAD_PAIRS("tangent that is oblique", "(cosine -1.00e-3)", in.tangents[0] = 1,
              in.tangents[1] = 1e-3);
    BAD_PAIRS("tangent is NaN", "tangent", in.tangents[1] = NAN);

    prepare();
    CHECK_STATUS(signorini_model_new_sparse(&in.K, in.n_fixed, in.fixed, &in.pairs, NULL, NULL), -6);
}

static int32_t count_and_cancel(void *user, const signorini_progress *now)
{
    int *calls = user;
    ++*calls;
    return now->memory > 0;
}

static int32_t make_within(const signorini_settings *settings, signorini_model **model)
{
    return signorini_model_new_sparse(in.K_pointer, in.n_fixed, in.fixed_pointer,
                                             in.pairs_pointer, settings, model);
}

/* An order of the host, limits, a callback: nothing remains of a model that was not made. */
static void within(void)
{
    static const int64_t backwards[] = {5, 4, 3, 2, 1, 0};
    static const int64_t twice[] = {0, 1, 2, 2, 4, 5};
    static const int32_t narrow[] = {2, 3, 0, 1, 5, 4};
    signorini_model *model;
    double chosen[4], given[4];
    signorini_settings settings;
    CHECK_STATUS(signorini_settings_default(&settings, sizeof settings), 0);

    model = made();
    CHECK_STATUS(copy_stiffness(model, chosen), 0);
    signorini_model_free(model);
    /* The structure as it was before it had an order. */
    prepare();
    in.K.order = twice;
    in.K.struct_size = offsetof(signorini_sparse, order);
    CHECK_STATUS(make(&model), 0);
    signorini_model_free(model);
    in.K.struct_size = sizeof in.K;
    CHECK_STATUS(make(&model), -1);
    CHECK(model == NULL);
    CHECK_TEXT(signorini_last_error(), "order[3] is 2, as order[2] is");
    in.K.order = backwards;
    CHECK_STATUS(make_within(NULL, &model), 0);
    CHECK_STATUS(copy_stiffness(model, given), 0);
    for (int i = 0; i < 4; i++)
        CHECK_NEAR(given[i], chosen[i]);
    signorini_model_free(model);
    for (int i = 0; i <= SIZE; i++)
        in.narrow_starts[i] = (int32_t)in.starts[i];
    for (int i = 0; i < 8; i++)
        in.narrow_rows[i] = (int32_t)in.rows[i];
    in.K.index_bytes = 4;
    in.K.col_start = in.narrow_starts;
    in.K.row = in.narrow_rows;
    in.K.order = narrow;
    CHECK_STATUS(make(&model), 0);
    signorini_model_free(model);

    prepare();
    settings.memory_limit = 1;
    CHECK_STATUS(make_within(&settings, &model), SIGNORINI_STATUS_MEMORY_LIMIT);
    CHECK(model == NULL);
    CHECK_TEXT(signorini_last_error(), "memory_limit");
    settings.memory_limit = -1;
    CHECK_STATUS(make_within(&settings, &model), -5);
    settings.memory_limit = 0;
    int calls = 0;
    settings.progress = count_and_cancel;
    settings.user = &calls;
    CHECK_STATUS(make_within(&settings, &model), SIGNORINI_STATUS_CANCELLED);
    CHECK(model == NULL && calls > 1);
    settings.progress = NULL;
    CHECK_STATUS(make_within(&settings, &model), 0);
    signorini_model_free(model);
}

/* Both bodies' matrices and the condensed one. */
static void bad_dense(void)
{
    const double good[4] = {2, 1, 1, 2}, unsymmetric[4] = {2, 1, 1.5, 2}, nan[4] = {2, 1, 1, NAN};
    const double loose[4] = {1, 1, 1, 1}, empty[4] = {0, 0, 0, 2}, indefinite[4] = {1, 3, 3, 1};
    signorini_model *model;
#define TWO(status, part, ...)                                                                    \
    do {                                                                                          \
        model = (signorini_model *)(void *)&in;                                                   \
        CHECK_STATUS(signorini_model_new_two_body(__VA_ARGS__, NULL, &model), status);            \
        CHECK_TEXT(signorini_last_error(), part);                                                 \
        CHECK(model == NULL);                                                                     \
    } while (0)
    TWO(-1, "dim is 1", 1, 1, good, 2, good, 2);
    TWO(-2, "pairs is -1", 2, -1, good, 2, good, 2);
    TWO(-2, "pairs", 2, INT64_MAX, good, 2, good, 2);
    TWO(-3, "K_A is NULL", 2, 1, NULL, 2, good, 2);
    TWO(-4, "K_A", 2, 1, good, 1, good, 2);
    TWO(-4, "lda is -2", 2, 1, good, -2, good, 2);
    TWO(-5, "K_B is NULL", 2, 1, good, 2, NULL, 2);
    TWO(-6, "K_B", 2, 1, good, 2, good, 1);
    TWO(-6, "ldb is -2", 2, 1, good, 2, good, -2);
    TWO(-3, "K_A is not symmetric", 2, 1, unsymmetric, 2, good, 2);
    TWO(-5, "K_B is not symmetric", 2, 1, good, 2, unsymmetric, 2);
    TWO(-3, "K_A[1,1]", 2, 1, nan, 2, good, 2);
    TWO(-5, "K_B[1,1]", 2, 1, good, 2, nan, 2);
    TWO(-3, "neither body resists", 2, 1, loose, 2, loose, 2);
    TWO(-3, "not positive semi-definite", 2, 1, indefinite, 2, loose, 2);
    CHECK_STATUS(signorini_model_new_two_body(2, 1, good, 2, good, 2, NULL, NULL), -8);

#define ONE(status, part, ...)                                                                    \
    do {                                                                                          \
        model = (signorini_model *)(void *)&in;                                                   \
        CHECK_STATUS(signorini_model_new_condensed(__VA_ARGS__, NULL, &model), status);           \
        CHECK_TEXT(signorini_last_error(), part);                                                 \
        CHECK(model == NULL);                                                                     \
    } while (0)
    ONE(-1, "dim is 4", 4, 1, good, 2);
    ONE(-2, "pairs is -1", 2, -1, good, 2);
    ONE(-3, "K is NULL", 2, 1, NULL, 2);
    ONE(-4, "leading dimension of K is 1", 2, 1, good, 1);
    ONE(-3, "K is not symmetric", 2, 1, unsymmetric, 2);
    ONE(-3, "K[1,1] is not finite", 2, 1, nan, 2);
    /* A row of zeros is a component that nothing resists. */
    CHECK_STATUS(signorini_model_new_condensed(2, 1, empty, 2, NULL, &model), 0);
    signorini_model_free(model);
    CHECK_STATUS(signorini_model_new_two_body(2, 1, empty, 2, good, 2, NULL, &model), 0);
    signorini_model_free(model);
    CHECK_STATUS(signorini_model_new_condensed(2, 1, good, 2, NULL, NULL), -6);
}

static int32_t counting_to(void *user, const signorini_progress *progress)
{
    int *left = user;
    CHECK(progress->reduced >= 0 && progress->reduced <= 1);
    return (*left)-- <= 0;
}

/* Limits and callback of the settings, for one body and for two. */
static void settings_of_dense_models(void)
{
    const double K[4] = {2, 1, 1, 2};
    for (int two = 0; two < 2; two++) {
        signorini_model *model;
        signorini_settings settings;
        int left = 0;
#define MAKE(status)                                                                              \
    do {                                                                                          \
        model = (signorini_model *)(void *)&in;                                                   \
        CHECK_STATUS(two ? signorini_model_new_two_body(2, 1, K, 2, K, 2, &settings, &model)      \
                         : signorini_model_new_condensed(2, 1, K, 2, &settings, &model), status); \
        CHECK((model == NULL) == ((status) != 0));                                                \
    } while (0)
        CHECK_STATUS(signorini_settings_default(&settings, sizeof settings), 0);
        MAKE(0);
        signorini_model_free(model);
        settings.tolerance = 1;
        MAKE(two ? -7 : -5);
        CHECK_TEXT(signorini_last_error(), "settings: tolerance");
        settings.tolerance = 1e-10;
        settings.memory_limit = 1000;
        MAKE(SIGNORINI_STATUS_MEMORY_LIMIT);
        CHECK_TEXT(signorini_last_error(), "memory_limit allows");
        settings.memory_limit = 0;
        settings.time_limit = 1e-12;
        MAKE(SIGNORINI_STATUS_TIME_LIMIT);
        settings.time_limit = 0;
        settings.progress = counting_to;
        settings.user = &left;
        MAKE(SIGNORINI_STATUS_CANCELLED);
        CHECK_TEXT(signorini_last_error(), "cancelled");
        left = 1000;
        MAKE(0);
        CHECK(left < 1000);
        signorini_model_free(model);
    }
}

static void no_model(void)
{
    double x[8] = {0};
    signorini_model_free(NULL);
    signorini_model_data data = {.struct_size = sizeof data};
    CHECK_STATUS(signorini_model_view(NULL, &data), -1);
    CHECK_TEXT(signorini_last_error(), "model is NULL");
    CHECK(data.host_size == 0 && !data.K && !data.frames);
    CHECK_STATUS(signorini_model_condensed_load(NULL, x, NULL, x + 4), -1);
    CHECK_STATUS(signorini_model_certify(NULL, x, NULL, x, SIGNORINI_LAW_FRICTIONLESS, NULL, NULL,
                                         1e-10, x, NULL, NULL, NULL),
                 -1);
    CHECK_STATUS(signorini_model_recover(NULL, 1, NULL, NULL, x, x + 4), -1);
    CHECK_STATUS(signorini_model_nodal_forces(NULL, x, x + 4), -1);
    CHECK_STATUS(
        signorini_model_solve(NULL, 0, x, NULL, x, SIGNORINI_LAW_COULOMB, x, NULL, NULL, x, x, NULL,
                              NULL, NULL, NULL), -1);
}

/*
 * By hand: u_A = u_B + d_n (0, -1) + d_t (1, 0), C eliminated. With B eliminated of [K_A + 3 I] the
 * relative stiffness in (x, y) is the parallel sum of K_A = [3 1; 1 3] and 3 I; both have the
 * eigenvectors (1, 1) and (1, -1), with eigenvalues 4, 2 and 3, 3: 12/7 and 6/5. So its entries are
 * (12/7 + 6/5) / 2 = 51/35 and (12/7 - 6/5) / 2 = 9/35; (n, t) = (-y, x) turns the sign.
 */
static void sizes_and_stiffness(void)
{
    prepare();
    for (int narrow = 0; narrow < 2; narrow++) {
        for (int base = 0; base < 2; base++) {
            prepare();
            for (int i = 0; i <= SIZE; i++) in.starts[i] += base;
            for (int i = 0; i < 8; i++) in.rows[i] += base;
            for (int i = 0; i <= SIZE; i++) in.narrow_starts[i] = (int32_t)in.starts[i];
            for (int i = 0; i < 8; i++) in.narrow_rows[i] = (int32_t)in.rows[i];
            for (int i = 0; i < 2; i++) {
                in.slaves[i] += base;
                in.masters[i] += base;
                in.master_start[i] += base;
            }
            in.fixed[0] += base;
            in.K.index_base = base;
            if (narrow) {
                in.K.index_bytes = 4;
                in.K.col_start = in.narrow_starts;
                in.K.row = in.narrow_rows;
            }
            signorini_model *model = made();
            CHECK(model_data(model).host_size == SIZE);
            double K[4];
            CHECK_STATUS(copy_stiffness(model, K), 0);
            CHECK_NEAR(K[0], 51. / 35);
            CHECK_NEAR(K[1], -9. / 35);
            CHECK_NEAR(K[2], -9. / 35);
            CHECK_NEAR(K[3], 51. / 35);
            CHECK_STATUS(signorini_model_view(model, NULL), -2);
            signorini_model_free(model);
        }
    }
    const double one[4] = {2, 1, 1, 2};
    signorini_model *model;
    CHECK_STATUS(signorini_model_new_condensed(2, 1, one, 2, NULL, &model), 0);
    CHECK(model_data(model).host_size == 2);
    signorini_model_free(model);
    CHECK_STATUS(signorini_model_new_two_body(2, 1, one, 2, one, 2, NULL, &model), 0);
    CHECK(model_data(model).host_size == 4);
    double K[4];
    CHECK_STATUS(copy_stiffness(model, K), 0);
    for (int i = 0; i < 4; i++) CHECK_NEAR(K[i], one[i] / 2);
    signorini_model_free(model);
}

/* The arguments of signorini_model_solve for up to three cases. */
enum { CASES = 3 };
static struct world {
    double f[CASES][SIZE], prescribed[CASES], gap[CASES], mu[CASES], slip0[CASES];
    double d[CASES][2], F[CASES][2];
    int32_t state[CASES];
    signorini_report report[CASES];
    int32_t status[CASES];
} w;

/*
 * Case c presses A on B by 1 + c, without friction: with d_n = 0 and F_t = 0, in (n, t),
 * K d = f_rel + F. f_rel is that of A's load through the springs.
 */
static void prepare_cases(void)
{
    memset(&w, 0, sizeof w);
    for (int c = 0; c < CASES; c++) {
        w.f[c][1] = -(1. + c);
        w.report[c].struct_size = sizeof w.report[c];
        w.d[c][0] = w.d[c][1] = w.F[c][0] = w.F[c][1] = 77;
        w.state[c] = w.status[c] = 77;
    }
}

static int32_t solve_all(const signorini_model *model)
{
    return signorini_model_solve(model, CASES, w.f[0], w.prescribed, w.gap, SIGNORINI_LAW_COULOMB,
                                 w.mu, w.slip0, NULL, w.d[0], w.F[0], w.state, w.status, w.report,
                                 NULL);
}

/*
 * Case c by hand: closed, so that A.y = B.y = y; A.x = x alone, as F_t = 0; B.x = 0.
 * 3 x + y = 0 and x + 3 y + 3 y = -(1 + c): y = -3 (1 + c) / 17, x = (1 + c) / 17. The spring of B
 * is pressed by -3 y, d_t = A.x.
 */
static void check_case(int c)
{
    CHECK_STATUS(w.status[c], 0);
    CHECK_NEAR(w.d[c][0], 0);
    CHECK_NEAR(w.d[c][1], (1. + c) / 17);
    CHECK_NEAR(w.F[c][0], -9. * (1 + c) / 17);
    CHECK_NEAR(w.F[c][1], 0);
    CHECK(w.state[c] == SIGNORINI_STATE_SLIP);
}

static void cases(void)
{
    prepare();
    signorini_model *model = made();
    prepare_cases();
    CHECK_STATUS(solve_all(model), 0);
    CHECK_TEXT(signorini_last_error(), "");
    CHECK(signorini_last_error()[0] == 0);
    for (int c = 0; c < CASES; c++) {
        check_case(c);
        CHECK(w.report[c].status == 0 && w.report[c].pairs_slipping == 1);
        CHECK(w.report[c].eta <= 1e-10 && w.report[c].struct_size == sizeof w.report[c]);
    }

    /* A case that is wrong does not stop the others. */
    prepare_cases();
    w.f[1][3] = NAN;
    CHECK_STATUS(solve_all(model), -3);
    CHECK_TEXT(signorini_last_error(), "case 1: f[3] is not finite");
    check_case(0);
    check_case(2);
    CHECK(w.status[1] == -3);
    CHECK(w.d[1][0] == 77 && w.d[1][1] == 77 && w.F[1][0] == 77 && w.F[1][1] == 77);
    CHECK(w.state[1] == 77);
    prepare_cases();
    w.prescribed[0] = INFINITY;
    w.gap[1] = NAN;
    w.mu[2] = -1;
    CHECK_STATUS(solve_all(model), -4);
    CHECK_TEXT(signorini_last_error(), "case 0: prescribed[0] is not finite");
    CHECK(w.status[0] == -4 && w.status[1] == -5 && w.status[2] == -7);
    prepare_cases();
    w.slip0[2] = NAN;
    CHECK_STATUS(solve_all(model), -8);
    CHECK_TEXT(signorini_last_error(), "case 2: slip0[0] is not finite");
    CHECK(w.status[0] == 0 && w.status[1] == 0 && w.status[2] == -8);

    /* The first case that is not solved is told, though later ones are worse. */
    prepare_cases();
    signorini_settings settings;
    CHECK_STATUS(signorini_settings_default(&settings, sizeof settings), 0);
    settings.method = SIGNORINI_METHOD_BLOCK_PIVOTING;
    w.mu[1] = 0.1;
    w.f[2][0] = NAN;
    CHECK_STATUS(signorini_model_solve(model, CASES, w.f[0], NULL, w.gap, SIGNORINI_LAW_COULOMB,
                                       w.mu, NULL, &settings, w.d[0], w.F[0], w.state, w.status,
                                       w.report, NULL),
                 -9);
    CHECK_TEXT(signorini_last_error(), "case 1: settings");
    CHECK(w.status[0] == 0 && w.status[1] == -9 && w.status[2] == -3);
    check_case(0);

    /* Arrays that are not wanted are NULL; without status the rest goes on too. */
    prepare_cases();
    w.f[0][0] = NAN;
    CHECK_STATUS(signorini_model_solve(model, CASES, w.f[0], NULL, w.gap, SIGNORINI_LAW_COULOMB,
                                       w.mu, NULL, NULL, w.d[0], w.F[0], NULL, NULL, NULL, NULL),
                 -3);
    CHECK_TEXT(signorini_last_error(), "case 0: f[0] is not finite");
    CHECK_NEAR(w.d[1][1], 2. / 17);
    CHECK_NEAR(w.d[2][1], 3. / 17);
    CHECK(w.status[0] == 77 && w.state[0] == 77);

    /* No cases: no array is looked at. */
    CHECK_STATUS(signorini_model_solve(model, 0, NULL, NULL, NULL, SIGNORINI_LAW_COULOMB, NULL,
                                       NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL),
                 0);
    signorini_model_free(model);
}

/* Reports of an older, smaller structure: each has the caller's size and stands at its multiple. */
static void smaller_reports(void)
{
    prepare();
    signorini_model *model = made();
    enum { SMALL = 40 };
    unsigned char *bytes = malloc(CASES * SMALL);
    CHECK(bytes != NULL);
    if (!bytes) return;
    prepare_cases();
    CHECK_STATUS(solve_all(model), 0);
    int64_t sweeps[CASES];
    for (int c = 0; c < CASES; c++) sweeps[c] = w.report[c].iterations;
    prepare_cases();
    memset(bytes, 0xA5, CASES * SMALL);
    const uint32_t small = SMALL;
    for (int c = 0; c < CASES; c++) memcpy(bytes + c * SMALL, &small, sizeof small);
    CHECK_STATUS(signorini_model_solve(model, CASES, w.f[0], NULL, w.gap, SIGNORINI_LAW_COULOMB,
                                       w.mu, NULL, NULL, w.d[0], w.F[0], w.state, w.status,
                                       (signorini_report *)(void *)bytes, NULL),
                 0);
    for (int c = 0; c < CASES; c++) {
        uint32_t size;
        int32_t status, method;
        int64_t iterations;
        const unsigned char *report = bytes + c * SMALL;
        memcpy(&size, report, sizeof size);
        memcpy(&status, report + offsetof(signorini_report, status), sizeof status);
        memcpy(&method, report + offsetof(signorini_report, method), sizeof method);
        memcpy(&iterations, report + offsetof(signorini_report, iterations), sizeof iterations);
        CHECK(size == SMALL && status == 0 && method > SIGNORINI_METHOD_AUTO);
        CHECK(iterations == sweeps[c]);
        check_case(c);
    }
    /* Not all of one size. */
    const uint32_t other = SMALL - 8;
    memcpy(bytes + SMALL, &other, sizeof other);
    prepare_cases();
    CHECK_STATUS(signorini_model_solve(model, CASES, w.f[0], NULL, w.gap, SIGNORINI_LAW_COULOMB,
                                       w.mu, NULL, NULL, w.d[0], w.F[0], w.state, w.status,
                                       (signorini_report *)(void *)bytes, NULL),
                 -14);
    CHECK_TEXT(signorini_last_error(), "report 1: struct_size is 32, not 40");
    CHECK(w.status[0] == 77 && w.d[0][0] == 77);
    free(bytes);
    signorini_model_free(model);
}

/* Faults of the call itself: nothing is written. */
static void bad_calls(void)
{
    prepare();
    signorini_model *model = made();
    signorini_settings settings;
    CHECK_STATUS(signorini_settings_default(&settings, sizeof settings), 0);
    struct world before;
#define CALL(result, part, ...)                                                                   \
    do {                                                                                          \
        memcpy(&before, &w, sizeof w);                                                            \
        CHECK_STATUS(signorini_model_solve(model, __VA_ARGS__), result);                          \
        CHECK_TEXT(signorini_last_error(), part);                                                 \
        CHECK(memcmp(&before, &w, sizeof w) == 0);                                                \
    } while (0)
#define ARRAYS w.d[0], w.F[0], w.state, w.status, w.report, NULL
    prepare_cases();
    double *const f = w.f[0], *const d = w.d[0];
    const int32_t law = SIGNORINI_LAW_COULOMB;
#define DATA f, NULL, w.gap, law, w.mu, NULL
    CALL(-2, "cases is -1", -1, DATA, NULL, ARRAYS);
    CALL(-2, "too many", INT64_MAX, DATA, NULL, ARRAYS);
    CALL(-3, "f is NULL", 3, NULL, NULL, w.gap, law, w.mu, NULL, NULL, ARRAYS);
    CALL(-5, "gap is NULL", 3, f, NULL, NULL, law, w.mu, NULL, NULL, ARRAYS);
    CALL(-6, "law is 9", 3, f, NULL, w.gap, 9, w.mu, NULL, NULL, ARRAYS);
    CALL(-7, "friction is NULL", 3, f, NULL, w.gap, law, NULL, NULL, NULL, ARRAYS);
    CALL(-10, "d is NULL", 3, DATA, NULL, NULL, w.F[0], NULL, NULL, NULL, NULL);
    CALL(-11, "F is NULL", 3, DATA, NULL, d, NULL, NULL, NULL, NULL, NULL);
    settings.tolerance = 1;
    CALL(-9, "tolerance is 1", 3, DATA, &settings, ARRAYS);
    settings.struct_size = 3;
    CALL(-9, "struct_size is 3", 3, DATA, &settings, ARRAYS);
    w.report[2].struct_size = 12;
    CALL(-14, "struct_size is 12", 3, DATA, NULL, ARRAYS);
    prepare_cases();
    signorini_extra extra = {.struct_size = 24};
    extra.motion = w.f[1];
    CALL(-15, "motion overlaps f", 3, DATA, NULL, d, w.F[0], NULL, NULL, NULL, &extra);
    CALL(-10, "d overlaps f", 3, DATA, NULL, w.f[2], w.F[0], NULL, NULL, NULL, NULL);
    CALL(-11, "F overlaps d", 3, DATA, NULL, d, w.d[2], NULL, NULL, NULL, NULL);
    CALL(-13, "status overlaps state", 3, DATA, NULL, d, w.F[0], w.state, w.state + 2, NULL, NULL);
    CALL(-14, "report overlaps status", 3, DATA, NULL, d, w.F[0], NULL,
         (int32_t *)(void *)&w.report[2], w.report, NULL);
    /* Inputs may share memory. */
    CHECK_STATUS(signorini_model_solve(model, 3, f, NULL, w.gap, law, w.gap, w.gap, NULL, ARRAYS),
                 0);
    for (int c = 0; c < CASES; c++) check_case(c);

    double u[SIZE], two[SIZE] = {0};
    CHECK_STATUS(signorini_model_recover(model, 1, NULL, NULL, NULL, u), -5);
    CHECK_STATUS(signorini_model_recover(model, 1, NULL, NULL, two, NULL), -6);
    CHECK_STATUS(signorini_model_recover(model, 1, NULL, NULL, u, u), -6);
    two[1] = NAN;
    CHECK_STATUS(signorini_model_recover(model, 1, two, NULL, w.d[0], u), -3);
    CHECK_TEXT(signorini_last_error(), "f[1] is not finite");
    CHECK_STATUS(signorini_model_recover(model, 1, NULL, two + 1, w.d[0], u), -4);
    CHECK_TEXT(signorini_last_error(), "prescribed[0] is not finite");
    CHECK_STATUS(signorini_model_recover(model, 1, NULL, NULL, two, u), -5);
    CHECK_TEXT(signorini_last_error(), "d[1] is not finite");
    CHECK_STATUS(signorini_model_nodal_forces(model, NULL, u), -2);
    CHECK_STATUS(signorini_model_nodal_forces(model, w.F[0], NULL), -3);
    CHECK_STATUS(signorini_model_nodal_forces(model, u, u), -3);
    CHECK_STATUS(signorini_model_nodal_forces(model, two, u), -2);
    CHECK_TEXT(signorini_last_error(), "F[1] is not finite");
    signorini_model_free(model);
}

/* Displacements of all nodes and nodal forces of case 0; C moves by what is prescribed. */
static void recovered(void)
{
    prepare();
    signorini_model *model = made();
    prepare_cases();
    w.prescribed[0] = 0.3;
    CHECK_STATUS(solve_all(model), 0);
    double u[SIZE], nodal[SIZE];
    CHECK_STATUS(signorini_model_recover(model, 1, w.f[0], w.prescribed, w.d[0], u), 0);
    const double expected[SIZE] = {1. / 17, -3. / 17, 0, -3. / 17, 0.1, 0.3};
    for (int i = 0; i < SIZE; i++) CHECK_NEAR(u[i], expected[i]);
    CHECK_STATUS(signorini_model_nodal_forces(model, w.F[0], nodal), 0);
    /* The contact lifts A, F_n n = -9/17 (0, -1), and presses B. */
    const double forces[SIZE] = {0, 9. / 17, 0, -9. / 17, 0, 0};
    for (int i = 0; i < SIZE; i++) CHECK_NEAR(nodal[i], forces[i]);
    signorini_model_free(model);
}

/* Nothing at all is allowed: no pairs, nothing fixed or everything, no degrees of freedom. */
static void nothing(void)
{
    double u[SIZE], f[SIZE] = {3, 1, 6, 9, 3, -1};
    prepare();
    in.pairs.count = 0;
    signorini_model *model = made();
    CHECK_STATUS(signorini_model_solve(model, 1, f, NULL, NULL, SIGNORINI_LAW_COULOMB, NULL, NULL,
                                       NULL, NULL, NULL, NULL, NULL, NULL, NULL),
                 0);
    CHECK_STATUS(signorini_model_recover(model, 1, f, NULL, NULL, u), 0);
    const double expected[SIZE] = {1, 0, 2, 3, 1, 0};
    for (int i = 0; i < SIZE; i++) CHECK_NEAR(u[i], expected[i]);
    signorini_model_free(model);

    /* All that is not a slave is fixed: B and C, or all without pairs. */
    prepare();
    in.n_fixed = 4;
    for (int i = 0; i < 4; i++) in.fixed[i] = 2 + i;
    model = made();
    double K[4];
    CHECK_STATUS(copy_stiffness(model, K), 0);
    CHECK_NEAR(K[0], 3);
    CHECK_NEAR(K[1], -1);
    signorini_model_free(model);
    prepare();
    in.pairs.count = 0;
    int64_t all[SIZE] = {0, 1, 2, 3, 4, 5};
    in.n_fixed = SIZE;
    in.fixed_pointer = all;
    model = made();
    const double values[SIZE] = {1, 2, 3, 4, 5, 6};
    CHECK_STATUS(signorini_model_recover(model, 1, f, values, NULL, u), 0);
    for (int i = 0; i < SIZE; i++) CHECK_NEAR(u[i], values[i]);
    signorini_model_free(model);
    prepare();
    in.pairs.count = 0;
    in.n_fixed = 0;
    in.K.size = in.K.nnz = 0;
    model = made();
    CHECK(model_data(model).host_size == 0);
    signorini_model_free(model);
}

int main(void)
{
    no_model();
    bad_matrix();
    bad_fixed();
    bad_pairs();
    bad_dense();
    settings_of_dense_models();
    sizes_and_stiffness();
    cases();
    smaller_reports();
    bad_calls();
    recovered();
    within();
    nothing();
    return check_summary("model");
}
