// The header alone, first in the file and included twice, in C++.

#include "signorini.h"
#include "signorini.h"

#include <cstdio>
#include <vector>

static int32_t on_progress(void *user, const signorini_progress *progress)
{
    *static_cast<int64_t *>(user) = progress->iterations;
    return 0;
}

int main()
{
    const std::vector<double> K{5, 0, 0, 3}, f{10, 8}, gap{0}, mu{0.5};
    std::vector<double> d(2), F(2);
    std::vector<int32_t> state(1);
    int64_t iterations = -1;
    signorini_settings settings;
    signorini_report report{};
    report.struct_size = sizeof report;
    if (signorini_settings_default(&settings, sizeof settings) != 0) return 1;
    settings.progress = on_progress;
    settings.user = &iterations;
    const int32_t status =
        signorini_solve(2, 1, K.data(), 2, f.data(), gap.data(), SIGNORINI_LAW_COULOMB, mu.data(),
                        nullptr, &settings, d.data(), F.data(), state.data(), &report, NULL);
    std::printf("header: signorini %s, %s, d_t = %g\n", signorini_version(),
                signorini_status_string(status), d[1]);
    return !(status == SIGNORINI_STATUS_SOLVED && state[0] == SIGNORINI_STATE_SLIP &&
             iterations >= 0);
}
