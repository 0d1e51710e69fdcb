/*
 * Runs an entry without libFuzzer: the files that are named, then inputs of a random generator with a fixed seed,
 * half of them new, half of them changed copies of earlier ones.
 *
 *     ENTRY -seconds=5 -executions=20000 -seed=1 -found=FILE [CORPUS_FILE...]
 *
 * The last line tells the number of executions. An input that stops the program is left in FILE.
 */

#include "fuzz.h"

#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

enum {
    MOST_BYTES = 1024,
    /* Inputs that are kept to be changed. */
    POOL = 256,
    /* Executions between two looks at the clock. */
    BATCH = 256
};

typedef struct bytes {
    uint8_t data[MOST_BYTES];
    size_t size;
} bytes;

static bytes pool[POOL], current;
static const char *found = "found";
static uint64_t state;

/* Marsaglia's xorshift with Vigna's multiplier. */
static uint64_t random_bits(void)
{
    state ^= state >> 12;
    state ^= state << 25;
    state ^= state >> 27;
    return state * UINT64_C(2685821657736338717);
}

static size_t below(size_t limit)
{
    return (size_t)((random_bits() >> 16) % limit);
}

/* Only what a handler may call. */
static void keep(int signal_number)
{
    const int file = open(found, O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (file >= 0 && write(file, current.data, current.size) >= 0) close(file);
    signal(signal_number, SIG_DFL);
    raise(signal_number);
}

static void make_new(bytes *b)
{
    b->size = below(below(4) ? 160 : MOST_BYTES);
    for (size_t i = 0; i < b->size; i++) b->data[i] = (uint8_t)random_bits();
    /* Zeros are the ordinary choice nearly everywhere. */
    if (below(2)) {
        for (size_t i = 0; i < b->size; i++) {
            if (below(3) == 0) b->data[i] = 0;
        }
    }
}

static void change(bytes *b)
{
    for (size_t times = 1 + below(4); times > 0; times--) {
        const size_t place = b->size ? below(b->size) : 0;
        switch (below(5)) {
        case 0:
            if (b->size) b->data[place] = (uint8_t)random_bits();
            break;
        case 1:
            if (b->size) b->data[place] ^= (uint8_t)(1u << below(8));
            break;
        case 2:
            if (b->size < MOST_BYTES) {
                memmove(b->data + place + 1, b->data + place, b->size - place);
                b->data[place] = (uint8_t)random_bits();
                b->size++;
            }
            break;
        case 3:
            if (b->size) {
                b->size--;
                memmove(b->data + place, b->data + place + 1, b->size - place);
            }
            break;
        default: {
            const bytes *other = &pool[below(POOL)];
            const size_t count = other->size < b->size ? other->size : b->size;
            const size_t from = count ? below(count) : 0;
            memcpy(b->data + from, other->data + from, count - from);
        }
        }
    }
}

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + (double)now.tv_nsec * 1e-9;
}

static void run(void)
{
    /* A copy of exact size: the entry must not read behind it. */
    uint8_t *copy = malloc(current.size + !current.size);
    if (!copy) abort();
    memcpy(copy, current.data, current.size);
    if (LLVMFuzzerTestOneInput(copy, current.size) != 0) abort();
    free(copy);
}

int main(int argc, char **argv)
{
    double limit = 0;
    uint64_t seed = 1, runs = 0, most = UINT64_MAX;
    int files = 0;
    for (int i = 1; i < argc; i++) {
        if (strncmp(argv[i], "-seconds=", 9) == 0) limit = atof(argv[i] + 9);
        else if (strncmp(argv[i], "-executions=", 12) == 0) most = strtoull(argv[i] + 12, NULL, 10);
        else if (strncmp(argv[i], "-seed=", 6) == 0) seed = strtoull(argv[i] + 6, NULL, 10);
        else if (strncmp(argv[i], "-found=", 7) == 0) found = argv[i] + 7;
    }
    const int signals[] = {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGALRM};
    for (size_t i = 0; i < sizeof signals / sizeof *signals; i++) signal(signals[i], keep);
    state = seed * UINT64_C(0x9E3779B97F4A7C15) + 1;
    for (int i = 0; i < POOL; i++) make_new(&pool[i]);
    for (int i = 1; i < argc; i++) {
        if (argv[i][0] == '-') continue;
        FILE *file = fopen(argv[i], "rb");
        if (!file) {
            fprintf(stderr, "cannot read %s\n", argv[i]);
            return 2;
        }
        current.size = fread(current.data, 1, MOST_BYTES, file);
        fclose(file);
        pool[files++ % POOL] = current;
        run();
    }
    const double began = seconds();
    double slowest = 0;
    while (runs < most && seconds() - began < limit) {
        for (int i = 0; i < BATCH; i++, runs++) {
            current = pool[below(POOL)];
            if (below(2)) make_new(&current);
            else change(&current);
            /* An execution that takes this long is a finding too. */
            alarm(60);
            const double start = seconds();
            run();
            const double took = seconds() - start;
            if (took > slowest) slowest = took;
            if (below(64) == 0) pool[below(POOL)] = current;
        }
    }
    printf("%s: %d files, %llu executions in %.0f s, the slowest %.3f s\n", argv[0], files,
           (unsigned long long)runs, seconds() - began, slowest);
    return 0;
}
