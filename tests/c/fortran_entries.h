/* Checks of the entries of Fortran 77 in one width: `integer` is the number, ENTRY(name) the entry. */

void ENTRY(sgsolv)(const integer *, const integer *, const double *, const integer *, const double *,
                   const double *, const integer *, const double *, const double *, const integer *,
                   const double *, const integer *, double *, double *, integer *, double *, integer *,
                   integer *);
void ENTRY(sglcps)(const integer *, const double *, const integer *, const double *, const integer *,
                   const double *, const integer *, double *, double *, double *, integer *, integer *);
void ENTRY(sgspar)(const integer *, const integer *, const integer *, const integer *, const double *,
                   const integer *, const integer *, const integer *, const integer *, const integer *,
                   const integer *, const integer *, const integer *, const integer *, const double *,
                   const double *, const integer *, const double *, int64_t *, integer *);
void ENTRY(sgcase)(const int64_t *, const double *, const double *, const double *, const integer *,
                   const double *, const double *, const integer *, const double *, const integer *,
                   double *, double *, integer *, double *, integer *, integer *);
void ENTRY(sgrecv)(const int64_t *, const double *, const double *, const double *, double *, integer *);
void ENTRY(sgfree)(int64_t *, integer *);
void ENTRY(sgmesg)(char *, const integer *);

/* One pair pressed by 10 on its obstacle and pushed by 8 against 5 of friction: it slips by 1. */
static void ENTRY(one_call)(void)
{
    const integer two = 2, one = 1, none = 0, law = SIGNORINI_LAW_COULOMB, sweeps = SIGNORINI_METHOD_SOR_NESTED;
    const double standard = 0;
    double d[2], r[2], eta = 7;
    integer state = 7, iterations = 7, info = 7;
    ENTRY(sgsolv)(&two, &one, K, &two, f, gap, &law, mu, slip0, &none, &standard, &none, d, r, &state,
                  &eta, &iterations, &info);
    CHECK(info == 0 && state == SIGNORINI_STATE_SLIP && eta >= 0 && eta <= 1e-10 && iterations > 0);
    CHECK_NEAR(d[0], 0);
    CHECK_NEAR(d[1], 1);
    CHECK_NEAR(r[0], -10);
    CHECK_NEAR(r[1], -5);
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

/* The model of two springs of stiffness 2 on the degrees of freedom of one node, before a rigid floor below it. */
static integer ENTRY(make_model)(const integer *n, int64_t *handle)
{
    static const integer start[3] = {1, 2, 3}, row[2] = {1, 2}, slave[2] = {1, 2};
    static const double springs[2] = {2, 2}, up[2] = {0, -1};
    const integer two = 2, one = 1, none = 0;
    integer info = 7;
    ENTRY(sgspar)(n, &two, start, row, springs, &none, &none, NULL, &two, &one, slave, &none, NULL, NULL, NULL, up,
                  &none, NULL, handle, &info);
    return info;
}

/* The node, 1/4 above the floor, is pressed by 3: the spring takes 2 of 1/4 and the floor the rest. */
static void ENTRY(models)(void)
{
    const integer two = 2, one = 1, none = 0, law = SIGNORINI_LAW_FRICTIONLESS;
    const double load[2] = {0, -3}, above[1] = {0.25}, standard = 0;
    double d[2], r[2], eta, u[2];
    integer state[2] = {7, 77}, iterations, info = 7;
    int64_t handle = 0, released, nobody = 0;
    CHECK(ENTRY(make_model)(&two, &handle) == 0 && handle != 0);
    ENTRY(sgcase)(&handle, load, NULL, above, &law, NULL, slip0, &none, &standard, &none, d, r, state, &eta,
                  &iterations, &info);
    CHECK(info == 0 && state[0] == SIGNORINI_STATE_SLIP && state[1] == 77);
    CHECK_NEAR(d[0], 0.25);
    CHECK_NEAR(r[0], -2.5);
    ENTRY(sgrecv)(&handle, load, NULL, d, u, &info);
    CHECK(info == 0);
    CHECK_NEAR(u[0], 0);
    CHECK_NEAR(u[1], -0.25);
    released = handle;
    ENTRY(sgfree)(&handle, &info);
    CHECK(info == 0 && handle == 0);
    /* 0 is no model: it may be released, and not be used. */
    ENTRY(sgfree)(&nobody, &info);
    CHECK(info == 0);
    ENTRY(sgrecv)(&nobody, load, NULL, d, u, &info);
    CHECK(info == -1);
    ENTRY(sgrecv)(&released, load, NULL, d, u, &info);
    CHECK(info == -1);
    CHECK_TEXT(signorini_last_error(), "there is no such model");
    handle = 7;
    CHECK(ENTRY(make_model)(&one, &handle) == -2 && handle == 0);
    CHECK(ENTRY(make_model)(&two, NULL) == -19);
    CHECK_TEXT(signorini_last_error(), "HANDLE is NULL");
    ENTRY(sgfree)(NULL, &info);
    CHECK(info == -1);
}

/* The sentence goes into as many characters as there are, with blanks behind it; into none without a length. */
static void ENTRY(sentences)(void)
{
    const integer two = 2, one = 1, none = 0, wrong = 5, long_enough = 80, negative = -1, nine = 9;
    const double standard = 0;
    char text[81];
    double d[2], r[2], eta;
    integer state, iterations, info;
    ENTRY(sgsolv)(&wrong, &one, K, &two, f, gap, &none, mu, slip0, &none, &standard, &none, d, r, &state, &eta,
                  &iterations, &info);
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
    ENTRY(models)();
    ENTRY(sentences)();
}
