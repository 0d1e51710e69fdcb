/* Checks for the programs of this directory: each failure is printed, the rest goes on. */

#ifndef CHECK_H
#define CHECK_H

#include "everything.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static int checks_done, checks_failed;

/* More failures than these are only counted. */
enum { MOST_PRINTED = 20 };

/* Counts; whether there is nothing to print about it. */
static inline int check_result(const char *file, int line, int passed)
{
    checks_done++;
    if (passed) return 1;
    checks_failed++;
    if (checks_failed > MOST_PRINTED) return 1;
    printf("%s:%d: failed: ", file, line);
    return 0;
}

/* The condition holds. */
#define CHECK(condition)                                                                          \
    do {                                                                                          \
        if (!check_result(__FILE__, __LINE__, (condition) != 0))                                  \
            printf("%s\n", #condition);                                                           \
    } while (0)

/* A call returns this status; evaluated once. The library's sentence is printed if not. */
#define CHECK_STATUS(call, expected)                                                              \
    do {                                                                                          \
        const int check_got = (int)(call), check_want = (int)(expected);                          \
        if (!check_result(__FILE__, __LINE__, check_got == check_want))                           \
            printf("status %d, not %d (%s)\n", check_got, check_want, signorini_last_error());     \
    } while (0)

/* Two numbers agree to 1e-9, relative to the larger of the expected one and 1. */
#define CHECK_NEAR(value, expected)                                                               \
    do {                                                                                          \
        const double check_got = (value), check_want = (expected);                                \
        const double check_scale = fabs(check_want) > 1 ? fabs(check_want) : 1;                   \
        if (!check_result(__FILE__, __LINE__, fabs(check_got - check_want) <= 1e-9 * check_scale)) \
            printf("%s is %.17g, not %.17g\n", #value, check_got, check_want);                    \
    } while (0)

/* A text contains a part. */
#define CHECK_TEXT(text, part)                                                                    \
    do {                                                                                          \
        const char *check_text = (text), *check_part = (part);                                    \
        if (!check_result(__FILE__, __LINE__, strstr(check_text, check_part) != NULL))            \
            printf("\"%s\" does not contain \"%s\"\n", check_text, check_part);                   \
    } while (0)

/* The last line of main: what was checked, and the exit status. */
static inline int check_summary(const char *program)
{
    if (checks_failed > MOST_PRINTED) printf("... and %d more\n", checks_failed - MOST_PRINTED);
    printf("%s: %d checks, %d failed\n", program, checks_done, checks_failed);
    return checks_failed != 0;
}

#endif
