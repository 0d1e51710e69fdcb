/* A host program of an installed library: solves a problem, and lets the library of somebody else,
 * also in Rust, do its work in the same process if there is one. */

#include <signorini.h>
#include <stdio.h>

#ifdef OTHER
double other_work(int32_t n);
#endif

int main(void)
{
    const double K[16] = {4, 1, -1, 0, 1, 4, 0, -1, -1, 0, 4, 1, 0, -1, 1, 4};
    const double f[4] = {2, 1.5, 3, 0.5}, gap[2] = {0, 0}, mu[2] = {0.3, 0.3};
    double d[4], F[4];
    int32_t state[2];

    int32_t status = signorini_solve(2, 2, K, 4, f, gap, SIGNORINI_LAW_COULOMB, mu, NULL, NULL, d,
                                     F, state, NULL, NULL);
    if (status != SIGNORINI_STATUS_SOLVED || state[0] != SIGNORINI_STATE_SLIP ||
        state[1] != SIGNORINI_STATE_STICK) {
        fprintf(stderr, "host: status %d: %s\n", (int)status, signorini_last_error());
        return 1;
    }
#ifdef OTHER
    if (other_work(10) != 285 || other_work(-1) != -1) {
        fprintf(stderr, "host: the other library is wrong\n");
        return 1;
    }
#endif
    printf("host: signorini %s\n", signorini_version());
    return 0;
}
