/*
 * signorini_problem_read of any bytes. What it accepts it writes again with the same bits; and a problem that it
 * writes it reads.
 */

#include "fuzz.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

static char path_of_input[64], path_again[64];

static void remove_files(void)
{
    remove(path_of_input);
    remove(path_again);
}

/* In memory where there is such a directory, else where the program runs. */
static void choose_paths(void)
{
    const char *folder = access("/dev/shm", W_OK) == 0 ? "/dev/shm" : ".";
    const long id = (long)getpid();
    snprintf(path_of_input, sizeof path_of_input, "%s/signorini_fuzz_%ld.in", folder, id);
    snprintf(path_again, sizeof path_again, "%s/signorini_fuzz_%ld.out", folder, id);
    atexit(remove_files);
}

static void put(const uint8_t *bytes, size_t size)
{
    FILE *file = fopen(path_of_input, "wb");
    if (!file || fwrite(bytes, 1, size, file) != size || fclose(file)) complain("cannot write");
}

/* Words of the format, so that random bytes come past the first line. */
static size_t spell(char *text, size_t room)
{
    static const char *const words[] = {
        "%%MatrixMarket matrix array real general\n", "% signorini problem 2\n",
        "% signorini problem 1\n", "% kind: contact\n", "% kind: lcp\n", "% law: coulomb\n",
        "% law: tresca\n", "% law: cohesive\n", "% law: frictionless\n", "% law: orthotropic\n",
        "% dim: 2\n", "% dim: 3\n", "% pairs: 1\n", "% pairs: 2\n", "% pairs: 99999999999\n",
        "% remark: a remark\n", "% size: 2\n", "% cover: yes\n", "2 6\n", "3 8\n", "2 4\n", "2 3\n",
        "4294967296 4294967296\n", "1e0\n", "0e0\n", "4\n", "-1\n", "inf\n", "nan\n", "1e400\n",
        "3e-1\n", "%\n", "\n", " ", "\r\n", "1e0\n1e0\n1e0\n1e0\n", "0x1p3\n"};
    const size_t count = sizeof words / sizeof *words;
    size_t used = 0, left;
    if (!rarely(3)) {
        /* The head of a problem of one pair. */
        static const char head[] = "%%MatrixMarket matrix array real general\n% signorini problem 2\n"
                                   "% kind: contact\n% law: coulomb\n% dim: 2\n% pairs: 1\n2 6\n";
        memcpy(text, head, used = sizeof head - 1);
        for (int cut = rarely(4) ? (int)between(1, 90) : 0; cut > 0; cut--) used--;
    }
    for (;;) {
        rest(&left);
        if (left == 0) return used;
        const uint8_t choice = byte();
        if (choice < 200) {
            const char *word = words[choice % count];
            const size_t length = strlen(word);
            if (used + length > room) return used;
            memcpy(text + used, word, length);
            used += length;
        } else {
            if (used == room) return used;
            text[used++] = (char)byte();
        }
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static char text[1 << 14];
    begin(data, size);
    if (!path_again[0]) choose_paths();
    signorini_problem *problem = NULL, *again = NULL;
    put((const uint8_t *)text, spell(text, sizeof text));
    int32_t status = signorini_problem_read(path_of_input, &problem);
    check_status(status, 2);
    REQUIRE((status == 0) == (problem != NULL));
    REQUIRE(status == 0 || status == SIGNORINI_STATUS_FILE);
    if (!problem) return 0;
    const int64_t n = problem_data(problem).size, pairs = problem_data(problem).pairs;
    const double *K = problem_data(problem).matrix, *f = problem_data(problem).rhs;
    const int lcp = problem_data(problem).kind == SIGNORINI_PROBLEM_LCP;
    const char *remark = problem_data(problem).remark;
    if (lcp)
        status = signorini_lcp_write(path_again, n, K, n > 1 ? n : 1, f,
                                     problem_data(problem).cover, remark);
    else
        status = signorini_problem_write(path_again, problem_data(problem).dim, pairs, K,
                                         n > 1 ? n : 1, f, problem_data(problem).gap,
                                         problem_data(problem).law,
                                         problem_data(problem).friction,
                                         problem_data(problem).slip0, remark);
    check_status(status, 11);
    /* A file may hold data that a problem may not: they are refused here. */
    if (status == 0) {
        REQUIRE(signorini_problem_read(path_again, &again) == 0);
        REQUIRE(problem_data(again).size == n);
        REQUIRE(n == 0 || memcmp(problem_data(again).matrix, K, (size_t)(n * n) * sizeof *K) == 0);
        REQUIRE(n == 0 || memcmp(problem_data(again).rhs, f, (size_t)n * sizeof *f) == 0);
        signorini_problem_free(again);
    }
    signorini_problem_free(problem);
    return 0;
}
