#include <signorini.h>
#include <stdio.h>

int main(void)
{
    /* Two pairs (n, t): N = 4. Column-major; symmetric, so rows will do as well. */
    const double K[16] = {4, 1, -1, 0,   1, 4, 0, -1,   -1, 0, 4, 1,   0, -1, 1, 4};
    const double f[4] = {2, 1.5, 3, 0.5}; /* loads: > 0 in n presses on the obstacle */
    const double gap[2] = {0, 0};
    const double mu[2] = {0.3, 0.3};
    double d[4], F[4];
    int32_t state[2];

    signorini_settings settings;
    signorini_settings_default(&settings, sizeof settings);
    settings.tolerance = 1e-12;
    signorini_report report = {.struct_size = sizeof report};

    int32_t status = signorini_solve(2, 2, K, 4, f, gap, mu, NULL, &settings, d, F, state, &report);
    if (status != SIGNORINI_SOLVED) {
        fprintf(stderr, "status %d: %s\n", (int)status, signorini_last_error());
        return 1;
    }
    const char *name[] = {"open", "slip", "stick"};
    for (int i = 0; i < 2; i++)
        printf("pair %d %-5s d_n %.4f d_t %.4f  F_n %.4f F_t %.4f\n", i + 1, name[state[i]],
               d[2 * i], d[2 * i + 1], F[2 * i], F[2 * i + 1]);
    return 0;
}
