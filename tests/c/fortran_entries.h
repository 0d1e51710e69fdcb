/* Checks of the entries of Fortran 77 in one width: `integer` is the number, ENTRY(name) the entry. */

void ENTRY(sgsolv)(const integer *, const integer *, const double *, const integer *, const double *,
                   const double *, const integer *, const double *, const double *, const integer *,
                   const double *, const integer *, double *, double *, integer *, double *, integer *,
                   integer *);
void ENTRY(sgcert)(const integer *, const integer *, const double *, const integer *, const double *,
                   const double *, const integer *, const double *, const double *, const double *,
                   const double *, double *, integer *, double *, integer *);
void ENTRY(sgprov)(const integer *, const integer *, const double *, const integer *, const double *,
                   const double *, const integer *, const double *, const double *, const double *,
                   const integer *, double *, double *, double *, integer *);
void ENTRY(sglcps)(const integer *, const double *, const integer *, const double *, const integer *,
                   const double *, const integer *, double *, double *, double *, integer *, integer *);
void ENTRY(sgmodl)(const integer *, const integer *, const double *, const integer *, int64_t *,
                   integer *);
void ENTRY(sgtwob)(const integer *, const integer *, const double *, const integer *, const double *,
                   const integer *, int64_t *, integer *);
void ENTRY(sgcase)(const int64_t *, const double *, const double *, const double *, const integer *,
                   const double *, const double *, const integer *, const double *, const integer *,
                   double *, double *, integer *, double *, integer *, integer *);
void ENTRY(sgrecv)(const int64_t *, const double *, const double *, const double *, double *, integer *);
void ENTRY(sgnodf)(const int64_t *, const double *, double *, integer *);
void ENTRY(sgfree)(int64_t *, integer *);
void ENTRY(sgmesg)(char *, const integer *);

/* One pair pressed by 10 on its obstacle and pushed by 8 against 5 of friction: it slips by 1. */
static void ENTRY(one_call)(void)
{
    const integer two = 2, one = 1, none = 0, law = SIGNORINI_LAW_COULOMB, sweeps = SIGNORINI_METHOD_SOR_NESTED;
    const double standard = 0, loose = 1e-6, wrong[2] = {0, 2};
    double d[2], r[2], eta = 7, about_d[2] = {7, 7}, about_r[2] = {7, 7};
    integer state = 7, iterations = 7, info = 7;
    ENTRY(sgsolv)(&two, &one, K, &two, f, gap, &law, mu, slip0, &none, &standard, &none, d, r, &state,
                  &eta, &iterations, &info);
    CHECK(info == 0 && state == SIGNORINI_STATE_SLIP && eta >= 0 && eta <= 1e-10 && iterations > 0);
    CHECK_NEAR(d[0], 0);
    CHECK_NEAR(d[1], 1);
    CHECK_NEAR(r[0], -10);
    CHECK_NEAR(r[1], -5);
    ENTRY(sgcert)(&two, &one, K, &two, f, gap, &law, mu, slip0, &loose, d, r, &state, &eta, &info);
    CHECK(info == 0 && state == SIGNORINI_STATE_SLIP);
    ENTRY(sgcert)(&two, &one, K, &two, f, gap, &law, mu, slip0, &standard, wrong, r, &state, &eta, &info);
    CHECK(info == SIGNORINI_STATUS_NOT_A_SOLUTION && eta > 0.1);
    state = SIGNORINI_STATE_SLIP;
    ENTRY(sgprov)(&two, &one, K, &two, f, gap, &law, mu, slip0, d, &state, r, about_d, about_r, &info);
    CHECK(info == 0 && about_d[1] >= 0 && about_d[1] < 1e-9 && about_r[1] < 1e-9);
    CHECK_NEAR(r[1], -5);
    state = SIGNORINI_STATE_STICK;
    ENTRY(sgprov)(&two, &one, K, &two, f, gap, &law, mu, slip0, d, &state, r, about_d, about_r, &info);
    CHECK(info == SIGNORINI_STATUS_NOT_PROVED);
    state = 9;
    ENTRY(sgprov)(&two, &one, K, &two, f, gap, &law, mu, slip0, d, &state, r, about_d, about_r, &info);
    CHECK(info == -11);
    ENTRY(sgprov)(&two, &one, K, &two, f, gap, &law, mu, slip0, d, NULL, r, about_d, about_r, &info);
    CHECK(info == -11);
    /* A single sweep, which is not enough for two pairs that are coupled. */
    const integer four = 4;
    integer states[2];
    double d2[4], r2[4];
    ENTRY(sgsolv)(&two, &two, coupled, &four, loads, gaps, &law, mus, slips, &sweeps, &standard, &one,
                  d2, r2, states, &eta, &iterations, &info);
    CHECK(info == SIGNORINI_STATUS_ITERATION_LIMIT && iterations == 1);
    /* The LCP 2 z - 4 >= 0: z = 2. */
    const double m[1] = {2}, q[1] = {-4};
    double w = 7, z = 7;
    ENTRY(sglcps)(&one, m, &one, q, &none, &standard, &none, &w, &z, &eta, NULL, &info);
    CHECK(info == 0);
    CHECK_NEAR(z, 2);
    CHECK_NEAR(w, 0);
}

/*
 * Two bodies of the stiffness 2, pressed on each other by 3 and 1: with u_A + u_B = 0 and 2 u = f + F for both,
 * F = -2 and u = 1/2 and -1/2.
 */
static void ENTRY(two_bodies)(void)
{
    const integer two = 2, one = 1, none = 0, law = SIGNORINI_LAW_FRICTIONLESS;
    const double springs[4] = {2, 0, 0, 2}, load[4] = {3, 0, 1, 0}, standard = 0;
    double d[2], r[2], eta, u[4], p[4];
    integer state, iterations, info = 7;
    int64_t handle = 0, nobody = 0;
    ENTRY(sgtwob)(&two, &one, springs, &two, springs, &two, &handle, &info);
    CHECK(info == 0 && handle != 0);
    ENTRY(sgcase)(&handle, load, NULL, gap, &law, NULL, slip0, &none, &standard, &none, d, r, &state,
                  &eta, &iterations, &info);
    CHECK(info == 0);
    CHECK_NEAR(r[0], -2);
    ENTRY(sgrecv)(&handle, load, NULL, d, u, &info);
    CHECK(info == 0);
    CHECK_NEAR(u[0], 0.5);
    CHECK_NEAR(u[2], -0.5);
    ENTRY(sgnodf)(&handle, r, p, &info);
    CHECK(info == 0);
    CHECK_NEAR(p[0], -2);
    CHECK_NEAR(p[2], -2);
    ENTRY(sgfree)(&handle, &info);
    CHECK(info == 0 && handle == 0);
    /* 0 is no model: it may be released, and not be used. */
    ENTRY(sgfree)(&nobody, &info);
    CHECK(info == 0);
    ENTRY(sgrecv)(&nobody, load, NULL, d, u, &info);
    CHECK(info == -1);
    ENTRY(sgtwob)(&two, &one, springs, &two, springs, &one, &handle, &info);
    CHECK(info == -6);
    ENTRY(sgmodl)(&two, &one, K, &two, NULL, &info);
    CHECK(info == -5);
    CHECK_TEXT(signorini_last_error(), "HANDLE is NULL");
    ENTRY(sgfree)(NULL, &info);
    CHECK(info == -1);
}

/* The sentence goes into as many characters as there are, with blanks behind it; into none without a length. */
static void ENTRY(sentences)(void)
{
    const integer two = 2, one = 1, wrong = 5, long_enough = 80, negative = -1, nine = 9;
    char text[81];
    int64_t handle;
    integer info;
    ENTRY(sgmodl)(&wrong, &one, K, &two, &handle, &info);
    CHECK(info == -1);
    memset(text, '#', sizeof text);
    ENTRY(sgmesg)(text, &long_enough);
    CHECK(memcmp(text, "NDIM is 5, it must be 2 or 3    ", 32) == 0 && text[79] == ' ' && text[80] == '#');
    memset(text, '#', sizeof text);
    ENTRY(sgmesg)(text, &nine);
    CHECK(memcmp(text, "NDIM is 5#", 10) == 0);
    ENTRY(sgmesg)(text, &negative);
    ENTRY(sgmesg)(text, NULL);
    CHECK(memcmp(text, "NDIM is 5#", 10) == 0);
    ENTRY(sgmesg)(NULL, &nine);
}

static void ENTRY(all)(void)
{
    ENTRY(one_call)();
    ENTRY(two_bodies)();
    ENTRY(sentences)();
}
