/* A program that loads the library at run time, uses it and unloads it, three times. */

#include "signorini.h"

#include <stdio.h>
#include <string.h>
#ifdef _WIN32
#include <windows.h>
#define dlopen(path, mode) ((void *)LoadLibraryA(path))
#define dlsym(library, name) (GetProcAddress((HMODULE)(library), name))
#define dlclose(library) (!FreeLibrary((HMODULE)(library)))
#define dlerror() "Windows refuses it"
typedef FARPROC address;
#else
#include <dlfcn.h>
typedef void *address;
#endif

/* ISO C has no conversion from an object pointer to a function pointer; POSIX promises this one. */
#define FUNCTION(library, name)                                                                   \
    do {                                                                                          \
        const address symbol = dlsym(library, "signorini_" #name);                                \
        if (!symbol) return fail("signorini_" #name, dlerror());                                  \
        memcpy(&name, &symbol, sizeof name);                                                      \
    } while (0)

static int fail(const char *what, const char *why)
{
    printf("dlopen: %s: %s\n", what, why ? why : "failed");
    return 1;
}

static int use(const char *path)
{
    int32_t (*abi_version)(void);
    const char *(*last_error)(void);
    int32_t (*settings_default)(signorini_settings *, uint32_t);
    int32_t (*solve)(int32_t, int64_t, const double *, int64_t, const double *, const double *,
                     int32_t, const double *, const double *, const signorini_settings *, double *,
                     double *, int32_t *, signorini_report *, const signorini_extra *);

    void *const library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!library) return fail(path, dlerror());
    FUNCTION(library, abi_version);
    FUNCTION(library, last_error);
    FUNCTION(library, settings_default);
    FUNCTION(library, solve);
    if (abi_version() != SIGNORINI_ABI_VERSION) return fail("signorini_abi_version", "another");

    const double K[4] = {5, 0, 0, 3}, f[2] = {10, 8}, gap[1] = {0}, mu[1] = {0.5};
    double d[2], F[2];
    signorini_settings settings;
    signorini_report report = {.struct_size = sizeof report};
    if (settings_default(&settings, sizeof settings)) return fail("settings", last_error());
    settings.tolerance = 1e-12;
    if (solve(2, 1, K, 2, f, gap, SIGNORINI_LAW_COULOMB, mu, NULL, &settings, d, F, NULL, &report,
              NULL) != SIGNORINI_STATUS_SOLVED)
        return fail("signorini_solve", last_error());
    if (d[0] != 0 || d[1] < 0.999999999 || d[1] > 1.000000001 || report.pairs_slipping != 1)
        return fail("signorini_solve", "a wrong answer");
    if (solve(2, 1, K, 1, f, gap, SIGNORINI_LAW_COULOMB, mu, NULL, &settings, d, F, NULL, NULL,
              NULL) != -4)
        return fail("signorini_solve", "a wrong argument was accepted");
    if (!strstr(last_error(), "leading dimension")) return fail("last_error", last_error());
    if (dlclose(library)) return fail("dlclose", dlerror());
    return 0;
}

int main(int argc, char **argv)
{
    if (argc != 2) return fail("usage", "dlopen PATH_OF_THE_LIBRARY");
    for (int round = 1; round <= 3; round++)
        if (use(argv[1])) return 1;
    printf("dlopen: loaded, used and unloaded 3 times\n");
    return 0;
}
