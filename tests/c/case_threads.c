/*
 * settings.threads: load cases of a call on several threads have the results of one, and the same bits each
 * time. Helgrind does not watch this program, as it does not know the atomic numbers by which Rust's threads wait
 * for each other; ThreadSanitizer does: tests/thread_sanitizer.sh.
 */

#include "chains.h"
#include "check.h"

enum { CASES = 75, PAIRS = 30, N = 3 * PAIRS };

/* Load cases of a model, all in one call. */
typedef struct block {
    double f[CASES][N], gap[CASES][PAIRS], mu[CASES][PAIRS], d[CASES][N], F[CASES][N];
    int32_t state[CASES][PAIRS], status[CASES];
} block;

static int32_t solve_block(const signorini_model *model, block *b, int32_t threads)
{
    signorini_settings settings;
    CHECK_STATUS(signorini_settings_default(&settings, sizeof settings), 0);
    settings.tolerance = 1e-13;
    settings.threads = threads;
    memset(b->d, 0, sizeof b->d);
    return signorini_model_solve(model, CASES, b->f[0], NULL, b->gap[0], SIGNORINI_LAW_COULOMB,
                                 b->mu[0], NULL, &settings, b->d[0], b->F[0], b->state[0],
                                 b->status, NULL, NULL);
}

static void calls_on_several_threads(void)
{
    static block b, one, before;
    chain c = chain_new(3, PAIRS, 0.5, 3);
    signorini_model *model = NULL;
    CHECK_STATUS(signorini_model_new_condensed(3, PAIRS, c.K, N, NULL, &model), 0);
    for (int k = 0; k < CASES; k++) {
        for (int i = 0; i < N; i++) b.f[k][i] = (0.5 + 0.01 * k) * c.f[(i + 3 * k) % N];
        memcpy(b.gap[k], c.gap, sizeof b.gap[k]);
        for (int i = 0; i < PAIRS; i++) b.mu[k][i] = 0.3;
    }
    CHECK_STATUS(solve_block(model, &b, 1), 0);
    one = b;
    CHECK_STATUS(solve_block(model, &b, 0), 0);
    CHECK(memcmp(&one, &b, sizeof b) == 0);
    const int32_t counts[] = {2, 3, 8, CASES, 1000};
    for (int i = 0; i < 5; i++) {
        CHECK_STATUS(solve_block(model, &b, counts[i]), 0);
        for (int k = 0; k < CASES; k++) {
            CHECK_STATUS(b.status[k], 0);
            CHECK(memcmp(b.state[k], one.state[k], sizeof b.state[k]) == 0);
            for (int j = 0; j < N; j++) {
                CHECK_NEAR(b.d[k][j], one.d[k][j]);
                CHECK_NEAR(b.F[k][j], one.F[k][j]);
            }
        }
        before = b;
        CHECK_STATUS(solve_block(model, &b, counts[i]), 0);
        CHECK(memcmp(&before, &b, sizeof b) == 0);
    }
    /* Wrong cases on both of two threads: the first one is named, and the others are solved. */
    b.f[70][2] = b.f[20][5] = NAN;
    CHECK_STATUS(solve_block(model, &b, 2), -3);
    CHECK_TEXT(signorini_last_error(), "case 20: f[5] is not finite");
    for (int k = 0; k < CASES; k++) CHECK_STATUS(b.status[k], k == 20 || k == 70 ? -3 : 0);
    CHECK_STATUS(solve_block(model, &b, -1), -9);
    CHECK_TEXT(signorini_last_error(), "threads is -1, it must be 0 (one thread) or more");
    signorini_model_free(model);
    chain_free(&c);
}

int main(void)
{
    calls_on_several_threads();
    return check_summary("case_threads");
}
