/* Models of one and of two condensed bodies: solve, recover, certify. */

#include "fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    begin(data, size);
    problem p = a_problem();
    const int two = rarely(2);
    int definite = 1;
    const double *K_B = two ? matrix(p.n, p.ld, &definite) : NULL;
    const int64_t cases = between(1, 2), host = (two + 1) * p.n;
    const double *f = numbers(host * cases), *gap = numbers(p.pairs * cases);
    const double *friction = friction_numbers(p.dim, p.law, p.pairs * cases);
    const double *slip0 = rarely(2) ? numbers((p.n - p.pairs) * cases) : NULL;
    const signorini_settings *settings = a_settings();
    signorini_model *model = NULL;
    arm();
    int32_t status =
        two ? signorini_model_new_two_body(p.dim, p.pairs, p.K, p.ld, K_B, p.ld, settings, &model)
            : signorini_model_new_condensed(p.dim, p.pairs, p.K, p.ld, settings, &model);
    check_arrays(status);
    check_status(status, 8);
    REQUIRE((status == 0) == (model != NULL));
    if (p.definite && definite && sane()) REQUIRE(status == 0);
    if (!model) return 0;
    REQUIRE(model_data(model).dim == p.dim && model_data(model).pairs == p.pairs);
    REQUIRE(model_data(model).host_size == host);

    double *K = outputs(p.n * p.n), *load = outputs(p.n);
    arm();
    REQUIRE(copy_stiffness(model, K) == 0);
    status = signorini_model_condensed_load(model, f, NULL, load);
    check_arrays(0);
    check_status(status, 4);
    const int loaded = status == 0;
    as_input(K);
    as_input(load);

    double *d = outputs(p.n * cases), *F = outputs(p.n * cases);
    int32_t *state = states(p.pairs * cases), *each = states(cases);
    const signorini_extra *extra = an_extra(p.n, p.pairs, cases);
    arm();
    status = signorini_model_solve(model, size_or_wrong(cases), f, NULL, gap, p.law, friction, slip0,
                                   settings, d, F, state, each, NULL, extra);
    check_arrays(0);
    check_status(status, 15);
    if (status >= 0 && each[0] == 0 && loaded) {
        problem reduced = p;
        reduced.K = K;
        reduced.ld = p.n;
        reduced.f = load;
        reduced.gap = (double *)gap;
        reduced.friction = (double *)friction;
        reduced.slip0 = (double *)slip0;
        judge_solution(&reduced, tolerance_of(settings), d, F, state, NULL);
        double *u = outputs(host), *nodal = outputs(host);
        as_input(d);
        as_input(F);
        check_recovered(signorini_model_recover(model, 1, f, NULL, d, u), u, host);
        check_recovered(signorini_model_nodal_forces(model, F, nodal), nodal, host);
        double *force = outputs(p.n);
        status = signorini_model_certify(model, f, NULL, gap, p.law, friction, slip0, 0.1, d, force,
                                         NULL, NULL);
        check_status(status, 13);
        REQUIRE(status == 0 || status == SIGNORINI_STATUS_NOT_A_SOLUTION);
    }
    signorini_model_free(model);
    return 0;
}
