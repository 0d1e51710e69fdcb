#include "checks.h"
#include "signorini.h"

#include <stdio.h>
#include <stdlib.h>

void judge(struct checks *checks, int passed)
{
    checks->made += 1;
    checks->failed += !passed;
    fputs(passed ? "  PASS  " : "  FAIL  ", stdout);
}

int conclude(const struct checks *checks)
{
    if (checks->failed != 0)
        printf("\nFAILED: %d of %d checks\n", checks->failed, checks->made);
    else
        printf("\nAll %d checks passed\n", checks->made);
    return checks->failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

const char *state_name(int32_t state)
{
    switch (state) {
    case SIGNORINI_OPEN: return "open";
    case SIGNORINI_SLIP: return "slip";
    case SIGNORINI_STICK: return "stick";
    default: return "?";
    }
}
