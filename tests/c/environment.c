/*
 * A call leaves the process as it found it, whatever the host has set: floating-point traps,
 * rounding mode, sticky flags, flush-to-zero, signal handlers. It prints nothing.
 */

#define _GNU_SOURCE

#include "chains.h"
#include "check.h"

#include <fcntl.h>
#include <fenv.h>
#include <signal.h>
#include <unistd.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#if defined __x86_64__
#include <xmmintrin.h>
enum { FLUSH_TO_ZERO = 0x8000, DENORMALS_ARE_ZERO = 0x0040 };
#endif

enum { TRAPS = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW };

static volatile double tiny = 1e-300;

/* Traps are an extension of glibc; elsewhere they are bits of the processor's register. */
#if !defined __GLIBC__ && defined __x86_64__
enum { FIRST_TRAP = 7 };

static int fegetexcept(void)
{
    return (int)(~_mm_getcsr() >> FIRST_TRAP) & FE_ALL_EXCEPT;
}

static int feenableexcept(int traps)
{
    const int before = fegetexcept();
    _mm_setcsr(_mm_getcsr() & ~((unsigned)traps << FIRST_TRAP));
    return before;
}
#endif

/* The floating-point environment as a host sees it. */
typedef struct seen {
    int traps, rounding, flags;
#if defined __x86_64__
    unsigned control;
#endif
} seen;

static seen look(void)
{
    seen now = {.traps = fegetexcept(), .rounding = fegetround()};
    now.flags = fetestexcept(FE_ALL_EXCEPT);
#if defined __x86_64__
    now.control = _mm_getcsr();
#endif
    return now;
}

static void check_same(const char *when, seen before, seen after)
{
    const int failed_before = checks_failed;
    CHECK(after.traps == before.traps);
    CHECK(after.rounding == before.rounding);
    CHECK(after.flags == before.flags);
#if defined __x86_64__
    CHECK(after.control == before.control);
#endif
    if (checks_failed > failed_before && checks_failed <= MOST_PRINTED)
        printf("... after %s\n", when);
}

static int32_t solve(chain *c, const signorini_settings *settings)
{
    return signorini_solve(c->dim, c->pairs, c->K, c->n, c->f, c->gap, SIGNORINI_LAW_COULOMB, c->mu,
                           NULL, settings, c->d, c->F, c->state, NULL, NULL);
}

/* Looks at the environment from inside of a call, and spoils it. */
static int32_t inside(void *user, const signorini_progress *progress)
{
    (void)progress;
    *(seen *)user = look();
    feraiseexcept(FE_ALL_EXCEPT);
    return 0;
}

/* Every entry with every kind of ending, in the environment that the caller has set. */
static void all_calls(const char *when)
{
    chain c = chain_new(2, 6, 0.5, 7);
    const seen before = look();
    CHECK_STATUS(solve(&c, NULL), SIGNORINI_STATUS_SOLVED);
    check_same(when, before, look());

    const double finite = c.K[3];
    c.K[3] = NAN;
    CHECK_STATUS(solve(&c, NULL), -3);
    check_same(when, before, look());
    c.K[3] = finite;

    c.gap[2] = INFINITY;
    CHECK_STATUS(solve(&c, NULL), SIGNORINI_STATUS_SOLVED);
    CHECK_STATUS(signorini_solve(2, c.pairs, c.K, c.n, c.f, c.gap, SIGNORINI_LAW_TRESCA, c.mu, NULL,
                                 NULL, c.d, c.F, c.state, NULL, NULL),
                 SIGNORINI_STATUS_SOLVED);
    check_same(when, before, look());

    CHECK_STATUS(signorini_solve(2, -1, NULL, 0, NULL, NULL, SIGNORINI_LAW_COULOMB, NULL, NULL,
                                 NULL, NULL, NULL, NULL, NULL, NULL),
                 -2);
    check_same(when, before, look());

    signorini_settings settings;
    seen during = before;
    CHECK_STATUS(signorini_settings_default(&settings, sizeof settings), 0);
    settings.progress = inside;
    settings.user = &during;
    CHECK_STATUS(solve(&c, &settings), SIGNORINI_STATUS_SOLVED);
    check_same(when, before, look());
    CHECK(during.traps == 0 && during.rounding == FE_TONEAREST);
#if defined __x86_64__
    CHECK((during.control & (FLUSH_TO_ZERO | DENORMALS_ARE_ZERO)) == 0);
#endif
    settings.tolerance = NAN;
    CHECK_STATUS(solve(&c, &settings), -10);

    /* An overflow inside that the library must notice by itself. */
    const double stiff[] = {1.7e308, 0, 0, 1.7e308}, load[] = {1.7e308, 1.7e308}, gap[] = {-3};
    const double mu[] = {0.5};
    double d[2], F[2];
    CHECK(signorini_solve(2, 1, stiff, 2, load, gap, SIGNORINI_LAW_COULOMB, mu, NULL, NULL, d, F,
                          NULL, NULL, NULL) >= 0);

    const double M[] = {2, 1, 1, 2}, q[] = {-5, -6}, infinite[] = {-INFINITY, 0}, none[] = {0};
    double w[2], z[2];
    CHECK_STATUS(lemke(2, M, 2, q, NULL, NULL, w, z, NULL, NULL),
                 SIGNORINI_STATUS_SOLVED);
    CHECK_STATUS(lemke(2, M, 2, infinite, NULL, NULL, w, z, NULL, NULL), -4);
    CHECK_STATUS(lemke(1, none, 1, q, NULL, NULL, w, z, NULL, NULL),
                 SIGNORINI_STATUS_NO_EQUILIBRIUM);
    check_same(when, before, look());
    chain_free(&c);
}

static void traps_are_off_inside_and_back_on_return(void)
{
    fenv_t host;
    fegetenv(&host);
    /* Most processors of ARM have no traps. */
    feenableexcept(TRAPS);
    const int traps = fegetexcept();
#if defined __x86_64__
    CHECK(traps == TRAPS);
#endif
    all_calls("traps");
    CHECK(fegetexcept() == traps);
    fesetenv(&host);
}

static void the_rounding_mode_is_kept(void)
{
    const int modes[] = {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
    for (int i = 0; i < 3; i++) {
        CHECK(fesetround(modes[i]) == 0);
        all_calls("a rounding mode");
        CHECK(fegetround() == modes[i]);
        fesetround(FE_TONEAREST);
    }
}

static void sticky_flags_are_kept(void)
{
    feclearexcept(FE_ALL_EXCEPT);
    all_calls("clear flags");
    feclearexcept(FE_ALL_EXCEPT);
    feraiseexcept(FE_DIVBYZERO | FE_INEXACT);
    all_calls("raised flags");
    CHECK(fetestexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW) == FE_DIVBYZERO);
    feclearexcept(FE_ALL_EXCEPT);
}

#if defined __x86_64__
static void flush_to_zero_is_kept(void)
{
    const unsigned host = _mm_getcsr();
    _mm_setcsr(host | FLUSH_TO_ZERO | DENORMALS_ARE_ZERO);
    all_calls("flush-to-zero");
    CHECK((_mm_getcsr() & (FLUSH_TO_ZERO | DENORMALS_ARE_ZERO)) ==
          (FLUSH_TO_ZERO | DENORMALS_ARE_ZERO));
    CHECK(tiny * 1e-10 == 0);
    _mm_setcsr(host);
}
#endif

/* The bits of an answer do not depend on what the host has set. */
static void results_do_not_depend_on_the_environment(void)
{
    const int32_t last = SIGNORINI_METHOD_BLOCK_PIVOTING;
    for (int32_t method = SIGNORINI_METHOD_AUTO; method <= last; method++) {
        /* Loads so small that flushing to zero would show. */
        chain plain = chain_new(3, 12, 0.3, 8), other = chain_new(3, 12, 0.3, 8);
        for (int64_t i = 0; i < plain.n; i++) plain.f[i] = other.f[i] = plain.f[i] * 1e-306;
        for (int64_t i = 0; i < plain.pairs; i++) {
            plain.gap[i] = other.gap[i] = plain.gap[i] * 1e-306;
            if (method >= SIGNORINI_METHOD_LEMKE) plain.mu[i] = other.mu[i] = 0;
        }
        signorini_settings settings;
        CHECK_STATUS(signorini_settings_default(&settings, sizeof settings), 0);
        settings.method = method;
        const int32_t status = solve(&plain, &settings);
        CHECK(status == SIGNORINI_STATUS_SOLVED || status == SIGNORINI_STATUS_STALLED);
        for (int setting = 0; setting < 3; setting++) {
            fenv_t host;
            fegetenv(&host);
            if (setting == 0) fesetround(FE_UPWARD);
            if (setting == 1) feenableexcept(TRAPS);
#if defined __x86_64__
            if (setting == 2) _mm_setcsr(_mm_getcsr() | FLUSH_TO_ZERO | DENORMALS_ARE_ZERO);
#endif
            const int32_t again = solve(&other, &settings);
            fesetenv(&host);
            CHECK_STATUS(again, status);
            CHECK(memcmp(plain.d, other.d, (size_t)plain.n * sizeof *plain.d) == 0);
            CHECK(memcmp(plain.F, other.F, (size_t)plain.n * sizeof *plain.F) == 0);
            CHECK(memcmp(plain.state, other.state, (size_t)plain.pairs * sizeof *plain.state) == 0);
        }
        chain_free(&plain);
        chain_free(&other);
    }
}

#ifndef _WIN32
static void signal_handlers_are_left_alone(void)
{
    struct sigaction before[65], after[65];
    stack_t stack_before, stack_after;
    sigset_t mask_before, mask_after;
    memset(before, 0, sizeof before);
    memset(after, 0, sizeof after);
    for (int number = 1; number < 65; number++) sigaction(number, NULL, &before[number]);
    sigaltstack(NULL, &stack_before);
    sigprocmask(SIG_BLOCK, NULL, &mask_before);
    all_calls("nothing");
    for (int number = 1; number < 65; number++) {
        sigaction(number, NULL, &after[number]);
        CHECK(after[number].sa_handler == before[number].sa_handler);
        CHECK(after[number].sa_flags == before[number].sa_flags);
    }
    sigaltstack(NULL, &stack_after);
    sigprocmask(SIG_BLOCK, NULL, &mask_after);
    CHECK(stack_after.ss_sp == stack_before.ss_sp && stack_after.ss_flags == stack_before.ss_flags);
    for (int number = 1; number < 65; number++)
        CHECK(sigismember(&mask_after, number) == sigismember(&mask_before, number));
}
#endif

#ifdef _WIN32
#define LINE_END "\r\n"
#else
#define LINE_END "\n"
#endif

static void prints(const char *when)
{
    printf("(%s)\n", when);
}

/* Runs `what` with standard output and error going to a file: how many bytes it printed. */
static long printed_by(void (*what)(const char *), const char *when)
{
#ifdef _WIN32
    /* Its own temporary files want a folder that users may not write to. */
    const char *const name = "environment.out";
    FILE *file = fopen(name, "w+");
#else
    FILE *file = tmpfile();
#endif
    const int output = dup(STDOUT_FILENO), error = dup(STDERR_FILENO);
    if (!file || output < 0 || error < 0) return -1;
    fflush(stdout);
    fflush(stderr);
    dup2(fileno(file), STDOUT_FILENO);
    dup2(fileno(file), STDERR_FILENO);
    what(when);
    fflush(stdout);
    fflush(stderr);
    dup2(output, STDOUT_FILENO);
    dup2(error, STDERR_FILENO);
    const long bytes = (long)lseek(fileno(file), 0, SEEK_END);
    rewind(file);
    for (int c; what != prints && (c = fgetc(file)) != EOF;) putchar(c);
    close(output);
    close(error);
    fclose(file);
#ifdef _WIN32
    remove(name);
#endif
    return bytes;
}

static void nothing_is_printed(void)
{
    CHECK(printed_by(all_calls, "nothing") == 0);
    /* Windows ends a line by two characters. */
    const long line_end = sizeof LINE_END - 1;
    CHECK(printed_by(prints, "seen") == 6 + line_end);
}

#ifdef __GLIBC__
/*
 * Columns of a factor end on a full vector, and what lies between them is read without a meaning: memcheck takes the path
 * through 60 pairs to depend on it. Its bits are the same with zeros there, with large numbers of either sign, and with
 * a small one. glibc fills new memory with the complement of a byte.
 */
static void unused_memory_decides_nothing(void)
{
    const int bytes[] = {0xff, 0x80, 0x01, 0xc0};
    for (int64_t pairs = 20; pairs <= 140; pairs += 40)
        for (uint64_t seed = 1; seed <= 6; seed++) {
            chain first = {0};
            for (size_t i = 0; i < sizeof bytes / sizeof *bytes; i++) {
                chain c = chain_new(2, pairs, 0.02, seed);
                signorini_settings settings;
                CHECK_STATUS(signorini_settings_default(&settings, sizeof settings), 0);
                settings.method = SIGNORINI_METHOD_PATH;
                settings.warm_start = 1;
                for (int64_t k = 0; k < c.n; k++) c.d[k] = k % 3 ? -5 : 7;
                CHECK(mallopt(M_PERTURB, bytes[i]) == 1);
                CHECK_STATUS(solve(&c, &settings), SIGNORINI_STATUS_SOLVED);
                CHECK(mallopt(M_PERTURB, 0) == 1);
                if (i == 0) {
                    first = c;
                    continue;
                }
                const size_t size = (size_t)c.n * sizeof *c.d;
                CHECK(memcmp(c.d, first.d, size) == 0 && memcmp(c.F, first.F, size) == 0);
                chain_free(&c);
            }
            chain_free(&first);
        }
}
#endif

int main(void)
{
#ifndef _WIN32
    signal_handlers_are_left_alone();
#endif
    nothing_is_printed();
    traps_are_off_inside_and_back_on_return();
    the_rounding_mode_is_kept();
    sticky_flags_are_kept();
#if defined __x86_64__
    flush_to_zero_is_kept();
#endif
    results_do_not_depend_on_the_environment();
#ifdef __GLIBC__
    unused_memory_decides_nothing();
#endif
    return check_summary("environment");
}
