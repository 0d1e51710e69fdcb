/*
 * Every kind of bad input, one line each: the status is -k for the k-th argument, the sentence of
 * signorini_last_error() names what is wrong, and not one byte of the caller's is written.
 */

#include "check.h"

#include <stddef.h>

enum { MOST = 6, LEADING = 7 };

/* All memory of the caller, compared as a whole before and after. */
static struct world {
    double K[MOST * LEADING], f[MOST], gap[2], friction[2], slip0[4];
    signorini_settings settings;
    /* Read by structures that say they are one word larger. */
    uint64_t beyond_settings;
    double d[MOST], F[MOST];
    int32_t state[2];
    signorini_report report;
    signorini_extra extra;
    uint64_t beyond_extra;
    double motion[MOST], second_d[MOST], second_F[MOST];
    int32_t second_state[2];
    double M[9], q[3], cover[3], w[3], z[3], y[3];
    double spare[2];
} world, before;

/* The arguments of signorini_solve and, on a model of them, of signorini_model_certify. */
static struct contact_call {
    int32_t dim;
    int64_t pairs;
    double *K;
    int64_t ldk;
    double *f, *gap;
    int32_t law;
    double *friction, *slip0;
    signorini_settings *settings;
    double *d, *F;
    int32_t *state;
    signorini_report *report;
    signorini_extra *extra;
    double tolerance;
} c;

/* The arguments of signorini_lcp_solve. */
static struct lcp_call {
    int64_t n;
    double *M;
    int64_t ldm;
    double *q, *cover;
    signorini_settings *settings;
    double *w, *z, *y;
    signorini_report *report;
} l;

static double *column(int j)
{
    return world.K + LEADING * j;
}

/* Two pairs that a change of one argument turns into bad input. */
static void prepare(int32_t dim)
{
    const int n = 2 * dim;
    memset(&world, 0xA5, sizeof world);
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) column(j)[i] = i == j ? 4 : i + j == n - 1 ? 1 : 0;
    for (int i = 0; i < n; i++) world.f[i] = 1 + i;
    for (int i = 0; i < 2 * (dim - 1); i++) world.slip0[i] = 0;
    for (int i = 0; i < 2; i++) {
        world.gap[i] = 0;
        world.friction[i] = 0.5;
    }
    for (int i = 0; i < 9; i++) world.M[i] = i % 4 == 0 ? 2 : 1;
    for (int i = 0; i < 3; i++) {
        world.q[i] = -1;
        world.cover[i] = 1;
    }
    CHECK_STATUS(signorini_settings_default(&world.settings, sizeof world.settings), 0);
    world.report.struct_size = sizeof world.report;
    CHECK_STATUS(signorini_extra_default(&world.extra, sizeof world.extra), 0);
    world.extra.motion = world.motion;
    world.extra.second_d = world.second_d;
    world.extra.second_F = world.second_F;
    world.extra.second_state = world.second_state;
    c = (struct contact_call){.dim = dim,
                              .pairs = 2,
                              .K = world.K,
                              .ldk = LEADING,
                              .f = world.f,
                              .gap = world.gap,
                              .law = SIGNORINI_LAW_COULOMB,
                              .friction = world.friction,
                              .slip0 = world.slip0,
                              .settings = &world.settings,
                              .d = world.d,
                              .F = world.F,
                              .state = world.state,
                              .report = &world.report,
                              .extra = &world.extra,
                              .tolerance = 1e-10};
    l = (struct lcp_call){3,       world.M, 3,       world.q,       world.cover, &world.settings,
                          world.w, world.z, world.y, &world.report};
}

static int32_t call_solve(void)
{
    return signorini_solve(c.dim, c.pairs, c.K, c.ldk, c.f, c.gap, c.law, c.friction, c.slip0,
                           c.settings, c.d, c.F, c.state, c.report, c.extra);
}

static int32_t call_tresca(void)
{
    if (c.law == SIGNORINI_LAW_COULOMB) c.law = SIGNORINI_LAW_TRESCA;
    return call_solve();
}

/* The status counts arguments as signorini_solve does, with the tolerance in the place of the settings. */
static int32_t call_certify(void)
{
    static const int32_t place[] = {0, 0, 5, 0, 6, 7, 8, 9, 10, 11, 12, 13, 14};
    signorini_model *model = NULL;
    int32_t status = signorini_model_new_condensed(c.dim, c.pairs, c.K, c.ldk, NULL, &model);
    if (status != 0) return status;
    status = signorini_model_certify(model, c.f, NULL, c.gap, c.law, c.friction, c.slip0, c.tolerance, c.d, c.F,
                                     c.state, c.report);
    signorini_model_free(model);
    return status <= -1 && status >= -12 ? -place[-status] : status;
}

static int32_t call_lcp_solve(void)
{
    return signorini_lcp_solve(l.n, l.M, l.ldm, l.q, NULL, l.settings, l.w, l.z, l.y, l.report);
}

static int32_t call_lcp(void)
{
    return signorini_lcp_solve(l.n, l.M, l.ldm, l.q, l.cover, l.settings, l.w, l.z, l.y, l.report);
}

/* Calls, expects the status and the part of the sentence, and that nothing was written. */
static void expect(int line, const char *function, int32_t (*call)(void), const char *name,
                   int32_t status, const char *part)
{
    memcpy(&before, &world, sizeof world);
    const int32_t got = call();
    const char *sentence = signorini_last_error();
    if (!check_result(__FILE__, line, got == status))
        printf("%s: %s: %d, not %d (%s)\n", function, name, (int)got, (int)status, sentence);
    if (!check_result(__FILE__, line, strstr(sentence, part) != NULL))
        printf("%s: %s: \"%s\" does not contain \"%s\"\n", function, name, sentence, part);
    if (!check_result(__FILE__, line, memcmp(&before, &world, sizeof world) == 0))
        printf("%s: %s: something was written\n", function, name);
}

#define SOLVE "signorini_solve", call_solve
#define TRESCA "signorini_solve with Tresca's law", call_tresca
#define CERTIFY "signorini_model_certify", call_certify
#define LCP "signorini_lcp_solve with a covering vector", call_lcp
#define LCP_SOLVE "signorini_lcp_solve", call_lcp_solve

/* One fault, as statements, in one call: (name, status, part of the sentence, statements). */
#define BAD(dim, call, name, status, part, ...)                                                   \
    do {                                                                                          \
        prepare(dim);                                                                             \
        __VA_ARGS__;                                                                              \
        expect(__LINE__, call, name, status, part);                                               \
    } while (0)

/* One fault under both laws of friction, and in the certificate too. */
#define BOTH_IN(dim, name, status, part, ...)                                                     \
    do {                                                                                          \
        BAD(dim, SOLVE, name, status, part, __VA_ARGS__);                                         \
        BAD(dim, TRESCA, name, status, part, __VA_ARGS__);                                        \
    } while (0)
#define BOTH(name, status, part, ...) BOTH_IN(2, name, status, part, __VA_ARGS__)
#define ALL_IN(dim, name, status, part, ...)                                                      \
    do {                                                                                          \
        BOTH_IN(dim, name, status, part, __VA_ARGS__);                                            \
        BAD(dim, CERTIFY, name, status, part, __VA_ARGS__);                                       \
    } while (0)
#define ALL(name, status, part, ...) ALL_IN(2, name, status, part, __VA_ARGS__)
#define FRICTION(name, part, ...)                                                                 \
    do {                                                                                          \
        BAD(2, SOLVE, name, -8, "mu" part, __VA_ARGS__);                                          \
        BAD(2, CERTIFY, name, -8, "mu" part, __VA_ARGS__);                                        \
        BAD(2, TRESCA, name, -8, "g" part, __VA_ARGS__);                                          \
    } while (0)

/* One fault with and without a covering vector. */
#define BARE(name, status, part, ...)                                                             \
    do {                                                                                          \
        BAD(2, LCP, name, status, part, __VA_ARGS__);                                             \
        BAD(2, LCP_SOLVE, name, status, part, __VA_ARGS__);                                       \
    } while (0)
#define COVER(name, status, part, ...) BAD(2, LCP, name, status, part, __VA_ARGS__)

/* Faults of settings: the tenth argument of the contact calls, the sixth of the LCP's. */
#define SETTINGS(name, part, ...)                                                                 \
    do {                                                                                          \
        BOTH(name, -10, part, __VA_ARGS__);                                                        \
        BARE(name, -6, part, __VA_ARGS__);                                                       \
    } while (0)

static void *shifted(void *pointer, int bytes)
{
    return (char *)pointer + bytes;
}

static void sizes(void)
{
    ALL("dim is 0", -1, "dim is 0", c.dim = 0);
    ALL("dim is 1", -1, "dim is 1", c.dim = 1);
    ALL("dim is 4", -1, "dim is 4", c.dim = 4);
    ALL("dim is negative", -1, "dim is -1", c.dim = -1);
    ALL("dim is 0 without pairs", -1, "dim is 0", c.dim = 0, c.pairs = 0);

    ALL("pairs is negative", -2, "pairs is -1", c.pairs = -1);
    ALL("pairs is the least number", -2, "pairs is -9223372036854775808", c.pairs = INT64_MIN);
    ALL("dim * pairs overflows", -2, "pairs is 9223372036854775807", c.pairs = INT64_MAX);
    ALL("dim * pairs fits no memory", -2, "pairs is 4611686018427387903", c.pairs = INT64_MAX / 2);
    ALL_IN(3, "dim * pairs overflows, 3D", -2, "pairs is", c.pairs = INT64_MAX / 2);

    ALL("ldk is too small", -4, "leading dimension of K is 3", c.ldk = 3);
    ALL("ldk is 0", -4, "leading dimension of K is 0", c.ldk = 0);
    ALL("ldk is negative", -4, "ldk is -4", c.ldk = -4);
    ALL("ldk is 0 without pairs", -4, "must be at least 1", c.pairs = 0, c.ldk = 0);
    ALL("no K has this ldk", -4, "leading dimension of K is 9223372036854775807",
         c.ldk = INT64_MAX);
    ALL_IN(3, "ldk is too small, 3D", -4, "must be at least 6", c.ldk = 5);

    BARE("n is negative", -1, "n is -1", l.n = -1);
    BARE("n is the least number", -1, "n is -9223372036854775808", l.n = INT64_MIN);
    BARE("ldm is too small", -3, "leading dimension of M is 2", l.ldm = 2);
    BARE("ldm is 0 without unknowns", -3, "must be at least 1", l.n = 0, l.ldm = 0);
    BARE("ldm is negative", -3, "ldm is -3", l.ldm = -3);
    BARE("no M has this ldm", -3, "leading dimension of M is 9223372036854775807",
          l.ldm = INT64_MAX);
}

static void pointers(void)
{
    ALL("K is NULL", -3, "K is NULL", c.K = NULL);
    ALL("f is NULL", -5, "f is NULL", c.f = NULL);
    ALL("gap is NULL", -6, "gap is NULL", c.gap = NULL);
    ALL("friction is NULL", -8, "friction is NULL, it must hold the parameters of",
        c.friction = NULL);
    ALL("d is NULL", -11, "d is NULL", c.d = NULL);
    BOTH("F is NULL", -12, "F is NULL", c.F = NULL);
    BARE("M is NULL", -2, "M is NULL", l.M = NULL);
    BARE("q is NULL", -4, "q is NULL", l.q = NULL);
    BARE("w is NULL", -7, "w is NULL", l.w = NULL);
    BARE("z is NULL", -8, "z is NULL", l.z = NULL);

    ALL("K is misaligned", -3, "K is not aligned", c.K = shifted(c.K, 4));
    ALL("f is misaligned", -5, "f is not aligned", c.f = shifted(c.f, 1));
    ALL("gap is misaligned", -6, "gap is not aligned", c.gap = shifted(c.gap, 2));
    ALL("friction is misaligned", -8, "friction is not aligned",
        c.friction = shifted(c.friction, 4));
    ALL("slip0 is misaligned", -9, "slip0 is not aligned", c.slip0 = shifted(c.slip0, 4));
    BOTH("settings is misaligned", -10, "settings is not aligned",
         c.settings = shifted(c.settings, 4));
    ALL("d is misaligned", -11, "d is not aligned", c.d = shifted(c.d, 4));
    ALL("F is misaligned", -12, "F is not aligned", c.F = shifted(c.F, 4));
    ALL("state is misaligned", -13, "state is not aligned", c.state = shifted(c.state, 2));
    ALL("report is misaligned", -14, "report is not aligned", c.report = shifted(c.report, 4));
    BARE("M is misaligned", -2, "M is not aligned", l.M = shifted(l.M, 4));
    BARE("q is misaligned", -4, "q is not aligned", l.q = shifted(l.q, 4));
    COVER("cover is misaligned", -5, "cover is not aligned", l.cover = shifted(l.cover, 4));
    BARE("settings is misaligned", -6, "settings is not aligned",
          l.settings = shifted(l.settings, 4));
    BARE("w is misaligned", -7, "w is not aligned", l.w = shifted(l.w, 4));
    BARE("z is misaligned", -8, "z is not aligned", l.z = shifted(l.z, 4));
    BARE("y is misaligned", -9, "y is not aligned", l.y = shifted(l.y, 4));
    BARE("report is misaligned", -10, "report is not aligned", l.report = shifted(l.report, 4));

    ALL("d is F", -12, "F overlaps d", c.F = c.d);
    ALL("the end of d is the beginning of F", -12, "F overlaps d", c.F = c.d + 3);
    BOTH("d lies in K", -11, "d overlaps K", c.d = c.K + 8);
    BOTH("d lies in the padding of K", -11, "d overlaps K", c.d = c.K + 4);
    ALL("F is f", -12, "F overlaps f", c.F = c.f);
    ALL("F is gap", -12, "F overlaps gap", c.F = c.gap);
    BAD(2, SOLVE, "d is mu", -11, "d overlaps friction", c.d = c.friction);
    BAD(2, TRESCA, "d is g", -11, "d overlaps friction", c.d = c.friction);
    BOTH("d is slip0", -11, "d overlaps slip0", c.d = c.slip0);
    ALL("state lies in d", -13, "state overlaps d", c.state = shifted(c.d, 8));
    BOTH("state lies in K", -13, "state overlaps K", c.state = shifted(c.K, 12));
    BARE("w is z", -8, "z overlaps w", l.z = l.w);
    BARE("w is q", -7, "w overlaps q", l.w = l.q);
    BARE("y is z", -9, "y overlaps z", l.y = l.z);
    BARE("w lies in M", -7, "w overlaps M", l.w = l.M + 6);
    COVER("z is cover", -8, "z overlaps cover", l.z = l.cover);
}

static void numbers(void)
{
    /* Indices count from 0: K[row,column]. */
    ALL("NaN in K", -3, "K[3,1] is not finite", column(1)[3] = NAN);
    ALL("NaN in the upper triangle of K", -3, "K[1,3] is not finite", column(3)[1] = NAN);
    ALL("+inf in K", -3, "K[2,0] is not finite", column(0)[2] = INFINITY);
    ALL("-inf in K", -3, "K[0,2] is not finite", column(2)[0] = -INFINITY);
    ALL("NaN on the diagonal of K", -3, "K[2,2] is not finite", column(2)[2] = NAN);
    ALL("+inf on the diagonal of K", -3, "K[3,3] is not finite", column(3)[3] = INFINITY);
    ALL_IN(3, "NaN in K, 3D", -3, "K[5,2] is not finite", column(2)[5] = NAN);
    ALL("K is not symmetric", -3, "K is not symmetric", column(0)[3] += 1e-6);
    ALL("K has one triangle only", -3, "K is not symmetric", column(0)[3] = column(1)[2] = 0);
    ALL("the asymmetric entry is named", -3, "K[2,1] is 1.5, K[1,2] is 1", column(1)[2] = 1.5);
    ALL("zero on the diagonal of K", -3, "K[1,1] is 0", column(1)[1] = 0);
    ALL("negative on the diagonal of K", -3, "K[0,0] is -2", column(0)[0] = -2);
    ALL("K is clearly indefinite", -3, "K is not positive semi-definite",
         column(0)[3] = column(3)[0] = 4.001);

    ALL("NaN in f", -5, "f[2] is not finite", c.f[2] = NAN);
    ALL("+inf in f", -5, "f[0] is not finite", c.f[0] = INFINITY);
    ALL("-inf in f", -5, "f[3] is not finite", c.f[3] = -INFINITY);
    ALL_IN(3, "NaN in f, 3D", -5, "f[5] is not finite", c.f[5] = NAN);

    ALL("NaN in gap", -6, "gap[1] is NaN", c.gap[1] = NAN);
    ALL("-inf in gap", -6, "gap[0] is -inf", c.gap[0] = -INFINITY);

    FRICTION("NaN", "[1] is not finite", c.friction[1] = NAN);
    FRICTION("+inf", "[0] is not finite", c.friction[0] = INFINITY);
    FRICTION("-inf", "[0] is not finite", c.friction[0] = -INFINITY);
    FRICTION("negative", "[1] is -0.25", c.friction[1] = -0.25);

    ALL("NaN in slip0", -9, "slip0[1] is not finite", c.slip0[1] = NAN);
    ALL("+inf in slip0", -9, "slip0[0] is not finite", c.slip0[0] = INFINITY);
    ALL("-inf in slip0", -9, "slip0[0] is not finite", c.slip0[0] = -INFINITY);
    ALL_IN(3, "NaN in slip0, 3D", -9, "slip0[3] is not finite", c.slip0[3] = NAN);

    BOTH("NaN in a warm start", -11, "d[1] is not finite",
         memset(c.d, 0, sizeof world.d), c.d[1] = NAN, c.settings->warm_start = 1);
    BOTH("+inf in a warm start", -11, "d[3] is not finite",
         memset(c.d, 0, sizeof world.d), c.d[3] = INFINITY, c.settings->warm_start = 1);
    BOTH("-inf in a warm start", -11, "d[0] is not finite",
         memset(c.d, 0, sizeof world.d), c.d[0] = -INFINITY, c.settings->warm_start = -1);

    BARE("NaN in M", -2, "M[2,1] is not finite", l.M[5] = NAN);
    BARE("+inf in M", -2, "M[0,0] is not finite", l.M[0] = INFINITY);
    BARE("-inf in M", -2, "M[1,2] is not finite", l.M[7] = -INFINITY);
    BARE("NaN in q", -4, "q[2] is not finite", l.q[2] = NAN);
    BARE("+inf in q", -4, "q[0] is not finite", l.q[0] = INFINITY);
    BARE("-inf in q", -4, "q[1] is not finite", l.q[1] = -INFINITY);
    COVER("NaN in cover", -5, "cover[0] is NaN", l.cover[0] = NAN);
    COVER("+inf in cover", -5, "cover[1] is inf", l.cover[1] = INFINITY);
    COVER("-inf in cover", -5, "cover[1] is -inf", l.cover[1] = -INFINITY);
    COVER("zero in cover", -5, "cover[2] is 0", l.cover[2] = 0);
    COVER("negative cover", -5, "cover[1] is -1", l.cover[1] = -1);

    BAD(2, CERTIFY, "NaN in d", -11, "d[1] is not finite", c.d[1] = NAN);
    BAD(2, CERTIFY, "+inf in d", -11, "d[3] is not finite", c.d[3] = INFINITY);
    BAD(3, CERTIFY, "-inf in d, 3D", -11, "d[5] is not finite", c.d[5] = -INFINITY);
    BAD(2, CERTIFY, "tolerance is 0", -10, "tolerance is 0", c.tolerance = 0);
    BAD(2, CERTIFY, "tolerance is negative", -10, "tolerance is -1", c.tolerance = -1);
    BAD(2, CERTIFY, "tolerance is NaN", -10, "tolerance is NaN", c.tolerance = NAN);
    BAD(2, CERTIFY, "tolerance is 1", -10, "tolerance is 1", c.tolerance = 1);
    BAD(2, CERTIFY, "tolerance is infinite", -10, "tolerance is inf", c.tolerance = INFINITY);
    BAD(2, CERTIFY, "bad tolerance without pairs", -10, "tolerance", c.pairs = 0, c.tolerance = 0);
}

/* A wrong parameter of a law that has three or four for each of the two pairs. */
#define LAW(dim, name_of_law, name, part, ...)                                                    \
    do {                                                                                          \
        static double three[8] = {__VA_ARGS__};                                             \
        BAD(dim, SOLVE, name, -8, part, c.law = SIGNORINI_LAW_##name_of_law, c.friction = three); \
        BAD(dim, CERTIFY, name, -8, part, c.law = SIGNORINI_LAW_##name_of_law,                    \
            c.friction = three);                                                                  \
    } while (0)

/* The friction law, and the results that not every call wants. */
static void laws(void)
{
    ALL("law is -1", -7, "law is -1, it must be", c.law = -1);
    ALL("law is 66", -7, "law is 66, it must be", c.law = 66);
    ALL("law is 66 without pairs", -7, "law is 66", c.law = 66, c.pairs = 0);
    BAD(2, SOLVE, "a NULL says what it must hold", -8, "mu of each pair", c.friction = NULL);
    BAD(2, TRESCA, "a NULL says what it must hold", -8, "g of each pair", c.friction = NULL);
    BAD(2, SOLVE, "a NULL says what it must hold", -8, "mu, b, a of each pair", c.friction = NULL,
        c.law = SIGNORINI_LAW_COHESIVE);
    LAW(2, COHESIVE, "b is below mu a", "friction[4] (b of pair 1) is 0.2, it must be at least",
        0.3, 1, 1, 0.5, 0.2, 1);
    LAW(2, COHESIVE, "a < 0", "friction[2] (a of pair 0) is -1, it must not be negative", 0.3, 1,
        -1, 0.5, 1, 1);
    LAW(2, COHESIVE, "b < 0", "friction[1] (b of pair 0) is -1, it must not", 0.3, -1, 0, 0.5, 1, 1);
    LAW(2, COHESIVE, "mu < 0", "friction[3] (mu of pair 1) is -0.5", 0.3, 1, 0, -0.5, 1, 1);
    LAW(3, COHESIVE, "b is NaN", "friction[1] (b of pair 0) is not finite", 0.3, NAN, 0, 0.5, 1, 1);
    LAW(3, ORTHOTROPIC, "mu1 is 0", "friction[0] (mu1 of pair 0) is 0, it must be positive", 0, 1,
        0, 0.5, 1, 1);
    LAW(3, ORTHOTROPIC_COLLINEAR, "mu2 < 0", "friction[4] (mu2 of pair 1) is -1", 1, 1, 0, 0.5, -1,
        1);
    LAW(3, ORTHOTROPIC, "mu2 is no friction beside mu1",
        "friction[1] (mu2 of pair 0) is 1e-10, and the other coefficient 3e-1", 0.3, 1e-10, 0, 1, 1, 0);
    LAW(3, ORTHOTROPIC, "angle is infinite", "friction[5] (angle of pair 1) is not finite", 1, 1,
        0, 0.5, 1, INFINITY);
    BAD(2, SOLVE, "a NULL says what it must hold", -8, "law, p1, p2, p3 of each pair",
        c.friction = NULL, c.law = SIGNORINI_LAW_BY_PAIR);
    LAW(2, BY_PAIR, "a law that no pair has", "friction[4] (law of pair 1) is 6, it must be the number",
        0, 0, 0, 0, SIGNORINI_LAW_BY_PAIR, 0, 0, 0);
    LAW(3, BY_PAIR, "g < 0 of one pair", "friction[5] (g of pair 1) is -1", 1, 0.3, 0, 0,
        SIGNORINI_LAW_TRESCA, -1, 0, 0);
    LAW(2, BY_PAIR, "one pair is orthotropic in the plane", "friction[0] (law of pair 0) is orthotropic",
        SIGNORINI_LAW_ORTHOTROPIC, 0.3, 0.4, 0, 0, 0, 0, 0);
    BAD(2, SOLVE, "orthotropic in the plane", -7, "dim is 2", c.law = SIGNORINI_LAW_ORTHOTROPIC,
        c.friction = world.K);
    BAD(2, CERTIFY, "orthotropic in the plane", -7, "use Coulomb's law",
        c.law = SIGNORINI_LAW_ORTHOTROPIC_COLLINEAR, c.friction = world.K);

    BOTH("extra: struct_size is 0", -15, "extra: struct_size is 0", world.extra.struct_size = 0);
    BOTH("there is something behind extra", -15, "this version of the library knows",
         world.extra.struct_size += 8);
    BOTH("extra is misaligned", -15, "extra is not aligned", c.extra = shifted(c.extra, 4));
    BOTH("extra: reserved is 1", -15, "reserved is 1, it must be 0", world.extra.reserved = 1);
    BOTH("motion is misaligned", -15, "extra: motion is not aligned",
         world.extra.motion = shifted(world.motion, 4));
    BOTH("motion is d", -15, "extra: motion overlaps d", world.extra.motion = world.d);
    BOTH("second_d is f", -15, "extra: second_d overlaps f", world.extra.second_d = world.f);
    BOTH("second_F is second_d", -15, "extra: second_F overlaps extra: second_d",
         world.extra.second_F = world.second_d);
    BOTH("second_state is state", -15, "extra: second_state overlaps state",
         world.extra.second_state = world.state);
}

static void settings(void)
{
    SETTINGS("tolerance is 0", "tolerance is 0", world.settings.tolerance = 0);
    SETTINGS("tolerance is negative", "tolerance is -1", world.settings.tolerance = -1);
    SETTINGS("tolerance is NaN", "tolerance is NaN", world.settings.tolerance = NAN);
    SETTINGS("tolerance is 1", "tolerance is 1", world.settings.tolerance = 1);
    SETTINGS("tolerance is infinite", "tolerance is inf", world.settings.tolerance = INFINITY);
    SETTINGS("max_iterations is 0", "max_iterations is 0", world.settings.max_iterations = 0);
    SETTINGS("max_iterations is negative", "max_iterations is -1",
             world.settings.max_iterations = -1);
    SETTINGS("time_limit is negative", "time_limit is -1", world.settings.time_limit = -1);
    SETTINGS("time_limit is NaN", "time_limit is NaN", world.settings.time_limit = NAN);
    SETTINGS("there is no search 2", "no search 2", world.settings.search = 2);
    SETTINGS("there is no search -1", "no search -1", world.settings.search = -1);
    SETTINGS("there is no method 60", "no method 60", world.settings.method = 60);
    SETTINGS("there is no method -1", "no method -1", world.settings.method = -1);
    SETTINGS("there is no method 1000", "no method 1000", world.settings.method = 1000);
    SETTINGS("struct_size is 0", "struct_size is 0", world.settings.struct_size = 0);
    SETTINGS("struct_size is 4", "struct_size is 4", world.settings.struct_size = 4);
    SETTINGS("struct_size is 13", "struct_size is 13", world.settings.struct_size = 13);
    SETTINGS("there is something behind the settings", "is not zero: leave the fields of a later version",
             world.settings.struct_size = sizeof(signorini_settings) + 8);
    SETTINGS("struct_size is garbage", "struct_size is 4294967288",
             world.settings.struct_size = UINT32_MAX - 7);

    SETTINGS("omega is 2", "omega is 2", world.settings.omega = 2);
    SETTINGS("omega is negative", "omega is -1", world.settings.omega = -1);
    SETTINGS("omega is NaN", "omega is NaN", world.settings.omega = NAN);
    SETTINGS("damping is above 1", "damping is 1.5", world.settings.damping = 1.5);
    SETTINGS("damping is negative", "damping is -0.5", world.settings.damping = -0.5);
    SETTINGS("damping is NaN", "damping is NaN", world.settings.damping = NAN);

    /* Settings are checked even where nothing is to be solved. */
    BOTH("bad settings without pairs", -10, "tolerance", c.pairs = 0, c.settings->tolerance = 0);
    BARE("bad settings without unknowns", -6, "tolerance", l.n = 0, l.settings->tolerance = 0);
}

/* Methods that exist and do not fit: the sentence says what they are for. */
static void methods(void)
{
    const int32_t contact_only[] = {SIGNORINI_METHOD_SOR_NESTED, SIGNORINI_METHOD_SOR_DIAGONAL,
                                    SIGNORINI_METHOD_NEWTON};
    BOTH_IN(3, "Lemke with friction in 3D", -10, "Lemke's method is for frictionless contact",
            c.settings->method = SIGNORINI_METHOD_LEMKE);
    BOTH_IN(3, "Lemke with friction in 3D", -10, "friction in 2D",
            c.settings->method = SIGNORINI_METHOD_LEMKE);
    BAD(2, SOLVE, "block pivoting with friction", -10, "every mu must be 0",
        c.settings->method = SIGNORINI_METHOD_BLOCK_PIVOTING);
    BAD(2, TRESCA, "block pivoting with a threshold", -10, "every g must be 0",
        c.settings->method = SIGNORINI_METHOD_BLOCK_PIVOTING);
    BAD(2, TRESCA, "the diagonal method with thresholds", -10, "diagonal",
        c.settings->method = SIGNORINI_METHOD_SOR_DIAGONAL);
    for (int i = 0; i < 3; i++)
        BAD(2, LCP_SOLVE, "a method of contact problems", -6, "auto, block pivoting and Lemke",
            l.settings->method = contact_only[i]);
}

static void report_sizes(void)
{
    const uint32_t bad[] = {0, 4, 13, 4104, UINT32_MAX - 7};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        ALL("struct_size of the report", -14, "report: struct_size is",
             c.report->struct_size = bad[i]);
        BARE("struct_size of the report", -10, "report: struct_size is",
              l.report->struct_size = bad[i]);
    }
}

static void defaults(void)
{
    signorini_settings settings, untouched;
    memset(&settings, 0xA5, sizeof settings);
    memcpy(&untouched, &settings, sizeof settings);
    const uint32_t size = sizeof settings, bad[] = {0, 4, 13, 4104, UINT32_MAX - 7};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        CHECK_STATUS(signorini_settings_default(&settings, bad[i]), -2);
        CHECK_TEXT(signorini_last_error(), "struct_size is");
    }
    CHECK_STATUS(signorini_settings_default(NULL, size), -1);
    CHECK_TEXT(signorini_last_error(), "settings is NULL");
    CHECK_STATUS(signorini_settings_default(shifted(&settings, 4), 16), -1);
    CHECK_TEXT(signorini_last_error(), "settings is not aligned");
    CHECK(memcmp(&settings, &untouched, sizeof settings) == 0);

    signorini_report report;
    CHECK_STATUS(signorini_report_default(NULL, sizeof report), -1);
    CHECK_TEXT(signorini_last_error(), "report is NULL");
    CHECK_STATUS(signorini_report_default(&report, 4104), -2);
    CHECK_TEXT(signorini_last_error(), "set it to sizeof");
    signorini_extra extra;
    CHECK_STATUS(signorini_extra_default(NULL, sizeof extra), -1);
    CHECK_TEXT(signorini_last_error(), "extra is NULL");
    CHECK_STATUS(signorini_extra_default(&extra, 0), -2);
    CHECK_TEXT(signorini_last_error(), "extra: struct_size is 0");
}

/* The calls that all of the above spoil are good. */
static void after_all_of_it(void)
{
    for (int32_t dim = 2; dim <= 3; dim++) {
        prepare(dim);
        CHECK_STATUS(call_solve(), SIGNORINI_STATUS_SOLVED);
        CHECK_STATUS(call_tresca(), SIGNORINI_STATUS_SOLVED);
    }
    CHECK_STATUS(call_lcp(), SIGNORINI_STATUS_SOLVED);
    CHECK_STATUS(call_lcp_solve(), SIGNORINI_STATUS_SOLVED);
    prepare(2);
    CHECK_STATUS(call_solve(), SIGNORINI_STATUS_SOLVED);
    CHECK_STATUS(call_certify(), SIGNORINI_STATUS_SOLVED);
    CHECK(signorini_last_error()[0] == '\0');
}

int main(void)
{
    sizes();
    pointers();
    numbers();
    laws();
    settings();
    methods();
    report_sizes();
    defaults();
    after_all_of_it();
    return check_summary("bad_input");
}
