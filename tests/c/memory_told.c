/*
 * settings.memory_limit is held against the bytes that the library says a call may need: a call is made with a
 * limit of just so many bytes, and refused before anything is done with one less.
 */

#include "chains.h"
#include "check.h"

static int32_t solve(chain *c, int64_t limit)
{
    signorini_settings settings;
    CHECK_STATUS(signorini_settings_default(&settings, sizeof settings), 0);
    settings.memory_limit = limit;
    return signorini_solve(c->dim, c->pairs, c->K, c->n, c->f, c->gap, SIGNORINI_LAW_COULOMB, c->mu,
                           NULL, &settings, c->d, c->F, c->state, NULL, NULL);
}

static int32_t solve_case(const signorini_model *model, chain *c, int64_t limit)
{
    signorini_settings settings;
    CHECK_STATUS(signorini_settings_default(&settings, sizeof settings), 0);
    settings.memory_limit = limit;
    return signorini_model_solve(model, 1, c->f, NULL, c->gap, SIGNORINI_LAW_COULOMB, c->mu, NULL,
                                 &settings, c->d, c->F, c->state, NULL, NULL, NULL);
}

static int32_t solve_lcp(chain *c, int64_t limit)
{
    signorini_settings settings;
    CHECK_STATUS(signorini_settings_default(&settings, sizeof settings), 0);
    settings.memory_limit = limit;
    return signorini_lcp_solve(c->n, c->K, c->n, c->f, NULL, &settings, c->F, c->d, NULL, NULL);
}

static void limits(int64_t pairs)
{
    chain c = chain_new(2, pairs, 0.1, 3);
    const int64_t bytes = signorini_solve_memory(c.n);
    signorini_model *model = NULL;
    /* A copy of the matrix, at least. */
    CHECK(bytes >= 8 * c.n * c.n);
    CHECK_STATUS(solve(&c, bytes), SIGNORINI_STATUS_SOLVED);
    c.d[0] = 77;
    /* Megabytes in the place of bytes are seen. */
    CHECK_STATUS(solve(&c, 8), SIGNORINI_STATUS_MEMORY_LIMIT);
    CHECK_TEXT(signorini_last_error(), "memory_limit allows 8 bytes");
    CHECK_STATUS(solve(&c, bytes - 1), SIGNORINI_STATUS_MEMORY_LIMIT);
    CHECK(c.d[0] == 77);
    CHECK_TEXT(signorini_last_error(), "memory_limit allows");
    CHECK_STATUS(solve_lcp(&c, bytes), SIGNORINI_STATUS_SOLVED);
    CHECK_STATUS(solve_lcp(&c, bytes - 1), SIGNORINI_STATUS_MEMORY_LIMIT);
    CHECK_STATUS(signorini_model_new_condensed(2, c.pairs, c.K, c.n, NULL, &model), 0);
    const int64_t of_case = model_data(model).memory;
    CHECK_STATUS(solve_case(model, &c, of_case), SIGNORINI_STATUS_SOLVED);
    CHECK_STATUS(solve_case(model, &c, of_case - 1), SIGNORINI_STATUS_MEMORY_LIMIT);
    signorini_model_free(model);
    chain_free(&c);
}

int main(void)
{
    CHECK(signorini_solve_memory(-1) == -1 && signorini_solve_memory(INT64_MIN) == -1);
    CHECK_STATUS(signorini_model_view(NULL, &(signorini_model_data){.struct_size = sizeof(signorini_model_data)}), -1);
    CHECK(signorini_solve_memory(0) > 0);
    for (int64_t n = 1; n < INT64_MAX / 4; n *= 3)
        CHECK(signorini_solve_memory(n) >= signorini_solve_memory(n / 3));
    CHECK(signorini_solve_memory(INT64_MAX) == INT64_MAX);
    limits(2);
    limits(40);
    CHECK_TEXT(signorini_status_string(SIGNORINI_STATUS_MEMORY_LIMIT), "memory limit");
    return check_summary("memory_told");
}
