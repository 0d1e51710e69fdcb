/* The entries of Fortran 77 in both widths of integers, called as a compiler would, on problems in closed form. */

#include "check.h"

#include <stdlib.h>

static const double K[4] = {5, 0, 0, 3}, f[2] = {10, 8}, gap[1] = {0}, mu[1] = {0.5}, slip0[1] = {0};
static const double coupled[16] = {4, 1, -1, 0, 1, 4, 0, -1, -1, 0, 4, 1, 0, -1, 1, 4};
static const double loads[4] = {2, 1.5, 3, 0.5}, gaps[2] = {0, 0}, mus[2] = {0.3, 0.3}, slips[2] = {0, 0};

#define integer int32_t
#define ENTRY(name) name##_
#include "fortran_entries.h"
#undef integer
#undef ENTRY

#define integer int64_t
#define ENTRY(name) name##_64_
#include "fortran_entries.h"

/* Integers of 4 bytes given to the entries for 8 bytes, two of which are one large number: refused. */
static void the_other_width(void)
{
    const int32_t dim[2] = {2, 2}, pairs[2] = {1, 1}, ld[2] = {2, 2};
    const int64_t two = 2, none = 0;
    const double standard = 0;
    double d[2], r[2], eta;
    int64_t wide[3], state, iterations, info = 7;
    memcpy(wide, dim, sizeof dim);
    memcpy(wide + 1, pairs, sizeof pairs);
    memcpy(wide + 2, ld, sizeof ld);
    sgsolv_64_(wide, wide + 1, K, wide + 2, f, gap, &none, mu, slip0, &none, &standard, &none, d, r, &state, &eta,
               &iterations, &info);
    CHECK(info == -1);
    CHECK_TEXT(signorini_last_error(), "this entry takes integers of 8 bytes");
    sgsolv_64_(&two, wide + 1, K, wide + 2, f, gap, &none, mu, slip0, &none, &standard, &none, d, r, &state, &eta,
               &iterations, &info);
    CHECK(info == -2);
}

int main(void)
{
    all_();
    all_64_();
    the_other_width();
    return check_summary("fortran_entries");
}
