#define _POSIX_C_SOURCE 200809L /* sigaction, isatty, fileno */

#include "watch.h"

#include <signal.h>
#include <stdio.h>
#ifdef _WIN32
#include <io.h>
#define isatty _isatty
#define fileno _fileno
#else
#include <unistd.h>
#endif

static volatile sig_atomic_t interrupted;

/* When the line was last written, in seconds of the call; -1: there is no line. */
static double shown = -1.0;

/* All that a handler may do safely. The program goes on and sees to its end itself, so that a file
 * that it is writing becomes complete. */
static void on_interrupt(int number)
{
    (void)number;
    interrupted = 1;
}

void watch_begin(void)
{
#ifdef _WIN32
    signal(SIGINT, on_interrupt);
#else
    struct sigaction action = {0};
    action.sa_handler = on_interrupt;
    action.sa_flags = SA_RESTART; /* reading and writing go on as if nothing had happened */
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
#endif
}

int watch_interrupted(void)
{
    return interrupted != 0;
}

/* The library calls this before each iteration and stops if it returns nonzero. Ten lines a second
 * are enough for the eye; a call that begins anew counts its time from 0. */
static int32_t on_progress(void *user, const struct signorini_progress *progress)
{
    const int *terminal = user;
    const double elapsed = progress->elapsed;

    if (*terminal && (shown < 0.0 || elapsed < shown || elapsed - shown >= 0.1)) {
        shown = elapsed;
        fprintf(stderr, "\r%lld iterations, eta %.1e, %.1f s \033[K",
                (long long)progress->iterations, progress->eta, elapsed);
        fflush(stderr);
    }
    return interrupted != 0;
}

void watch_calls(struct signorini_settings *settings)
{
    static int terminal;
    terminal = isatty(fileno(stderr));
    settings->progress = on_progress;
    settings->user = &terminal;
}

void watch_erase(void)
{
    if (shown >= 0.0)
        fputs("\r\033[K", stderr);
    shown = -1.0;
}

int watch_end(void)
{
    fflush(stdout);
    fputs("interrupted by Ctrl-C: files that were begun are complete\n", stderr);
    return EXIT_INTERRUPTED;
}
