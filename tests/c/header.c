/* The header alone, first in the file and included twice, in each dialect of C it is meant for. */

#include "signorini.h"
#include "signorini.h"

#include <stdio.h>

static int32_t on_progress(void *user, const signorini_progress *progress)
{
    (void)user;
    return progress->iterations < 0;
}

int main(void)
{
    const double K[4] = {5, 0, 0, 3}, f[2] = {10, 8}, gap[1] = {0}, mu[1] = {0.5};
    double d[2], F[2];
    int32_t state[1];
    signorini_settings settings;
    struct signorini_report report;
    signorini_progress_fn progress = on_progress;
    int32_t status;

    report.struct_size = sizeof report;
    if (signorini_settings_default(&settings, sizeof settings) != 0) return 1;
    settings.progress = progress;
    status = signorini_solve(2, 1, K, 2, f, gap, SIGNORINI_LAW_COULOMB, mu, 0, &settings, d, F,
                             state, &report, NULL);
    printf("header: signorini %s, %s, d_t = %g\n", signorini_version(),
           signorini_status_string(status), d[1]);
    return !(status == SIGNORINI_STATUS_SOLVED && state[0] == SIGNORINI_STATE_SLIP &&
             report.pairs_slipping == 1);
}
