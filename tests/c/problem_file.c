/*
 * Problem files from C: every kind comes back with its bits and is solved as before; bad arguments,
 * bad paths and bad files get a status and a sentence, and leave nothing behind.
 */

#define _POSIX_C_SOURCE 200809L /* mkdtemp, directories, limits of file size */
#define _DARWIN_C_SOURCE         /* mkdtemp, which macOS hides from POSIX */

#include "check.h"

#include <dirent.h>
#include <locale.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>
#ifdef _WIN32
#include <direct.h>
#define mkdir(name, mode) _mkdir(name)
#else
#include <sys/resource.h>
#endif

/* A folder of our own where the test is run. */
static char folder[4096], path[8192];

static const double K[16] = {4, 1, -1, 0, 1, 4, 0, -1, -1, 0, 4, 1, 0, -1, 1, 4};
static const double f[4] = {2, 1.5, 3, 1.0 / 3};
static const double mu[2] = {0.3, 5e-324}, slip0[2] = {-0.0, 1e-300};
static double gap[2]; /* 0 and infinity */

enum {
    FRICTIONLESS = SIGNORINI_LAW_FRICTIONLESS,
    COULOMB = SIGNORINI_LAW_COULOMB,
    TRESCA = SIGNORINI_LAW_TRESCA
};

static const char *in_folder(const char *name)
{
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

static void write_file(const char *name, const char *content)
{
    FILE *file = fopen(in_folder(name), "wb");
    CHECK(file != NULL && fputs(content, file) >= 0 && fclose(file) == 0);
}

/* Files of the folder, the directory "inner" aside. */
static int files(void)
{
    DIR *directory = opendir(folder);
    int count = 0;
    for (struct dirent *entry; directory != NULL && (entry = readdir(directory)) != NULL;)
        count += strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0 &&
                 strcmp(entry->d_name, "inner") != 0;
    if (directory != NULL) closedir(directory);
    return count;
}

static int32_t write_problem(const char *name, const char *remark)
{
    return signorini_problem_write(in_folder(name), 2, 2, K, 4, f, gap, COULOMB, mu, slip0, remark);
}

static int same(const double *a, const double *b, size_t count)
{
    return a != NULL && memcmp(a, b, count * sizeof *a) == 0;
}

static void kinds(void)
{
    signorini_problem *problem;
    const double cover[4] = {1, 2, 3, 4};

    CHECK_STATUS(write_problem("coulomb", "M\xC3\xBCller's crane"), 0);
    CHECK_STATUS(signorini_problem_read(path, &problem), 0);
    CHECK(problem_data(problem).kind == SIGNORINI_PROBLEM_CONTACT);
    CHECK(problem_data(problem).law == COULOMB);
    CHECK(problem_data(problem).dim == 2 && problem_data(problem).pairs == 2);
    CHECK(problem_data(problem).size == 4);
    CHECK(same(problem_data(problem).matrix, K, 16));
    CHECK(same(problem_data(problem).rhs, f, 4));
    CHECK(same(problem_data(problem).gap, gap, 2));
    CHECK(same(problem_data(problem).friction, mu, 2));
    CHECK(same(problem_data(problem).slip0, slip0, 2));
    CHECK(problem_data(problem).cover == NULL);
    CHECK(strcmp(problem_data(problem).remark, "M\xC3\xBCller's crane") == 0);
    signorini_problem_free(problem);

    CHECK_STATUS(signorini_problem_write(in_folder("tresca"), 2, 2, K, 4, f, gap, TRESCA, mu, NULL,
                                         NULL), 0);
    CHECK_STATUS(signorini_problem_read(path, &problem), 0);
    CHECK(problem_data(problem).kind == SIGNORINI_PROBLEM_CONTACT);
    CHECK(problem_data(problem).law == TRESCA);
    CHECK(same(problem_data(problem).friction, mu, 2));
    CHECK(problem_data(problem).slip0[0] == 0 && problem_data(problem).slip0[1] == 0);
    CHECK(problem_data(problem).remark[0] == '\0');
    signorini_problem_free(problem);

    const double three[6] = {0.5, 2, 1, 0.25, 1, 0};
    CHECK_STATUS(signorini_problem_write(in_folder("cohesive"), 2, 2, K, 4, f, gap,
                                         SIGNORINI_LAW_COHESIVE, three, NULL, NULL), 0);
    CHECK_STATUS(signorini_problem_read(path, &problem), 0);
    CHECK(problem_data(problem).law == SIGNORINI_LAW_COHESIVE);
    CHECK(same(problem_data(problem).friction, three, 6));
    signorini_problem_free(problem);

    CHECK_STATUS(signorini_problem_write(in_folder("frictionless"), 2, 2, K, 4, f, gap,
                                         FRICTIONLESS, NULL, slip0, NULL),
                 0);
    CHECK_STATUS(signorini_problem_read(path, &problem), 0);
    CHECK(problem_data(problem).kind == SIGNORINI_PROBLEM_CONTACT);
    CHECK(problem_data(problem).law == FRICTIONLESS);
    CHECK(problem_data(problem).friction == NULL);
    CHECK(same(problem_data(problem).slip0, slip0, 2));
    signorini_problem_free(problem);

    CHECK_STATUS(signorini_lcp_write(in_folder("lcp"), 4, K, 4, f, cover, "bare"), 0);
    CHECK_STATUS(signorini_problem_read(path, &problem), 0);
    CHECK(problem_data(problem).kind == SIGNORINI_PROBLEM_LCP);
    CHECK(problem_data(problem).law == -1);
    CHECK(problem_data(problem).dim == 0 && problem_data(problem).pairs == 0);
    CHECK(problem_data(problem).size == 4);
    CHECK(same(problem_data(problem).matrix, K, 16));
    CHECK(same(problem_data(problem).rhs, f, 4));
    CHECK(same(problem_data(problem).cover, cover, 4));
    CHECK(problem_data(problem).gap == NULL && problem_data(problem).slip0 == NULL);
    signorini_problem_free(problem);

    CHECK_STATUS(signorini_problem_write(in_folder("empty"), 3, 0, NULL, 1, NULL, NULL, COULOMB,
                                         NULL, NULL, ""), 0);
    CHECK_STATUS(signorini_problem_read(path, &problem), 0);
    CHECK(problem_data(problem).dim == 3 && problem_data(problem).size == 0);
    CHECK(problem_data(problem).matrix == NULL);
    signorini_problem_free(problem);
}

/* Files have points in their numbers, whatever the host's own numbers look like. */
static void decimal_commas(void)
{
    const char *names[] = {"de_DE.UTF-8", "de_DE", "fr_FR.UTF-8", "German_Germany.1252", "de-DE"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (setlocale(LC_NUMERIC, names[i]) && localeconv()->decimal_point[0] == ',') {
            kinds();
            char text[4096] = "";
            FILE *file = fopen(in_folder("coulomb"), "r");
            CHECK(file != NULL && fread(text, 1, sizeof text - 1, file) > 0 && fclose(file) == 0);
            CHECK(strstr(text, "1,5") == NULL && strstr(text, "1.5") != NULL);
            printf("with decimal commas: %s\n", names[i]);
            break;
        }
    setlocale(LC_NUMERIC, "C");
}

/* A load case of a model, replayed by the call on plain arrays: the same bits. */
static void model_case(void)
{
    signorini_model *model;
    signorini_problem *problem;
    double d[4], F[4], d_again[4], F_again[4];

    CHECK_STATUS(signorini_model_new_condensed(2, 2, K, 4, NULL, &model), 0);
    CHECK_STATUS(signorini_model_solve(model, 1, f, NULL, gap, COULOMB, mu, slip0, NULL, d, F, NULL,
                                       NULL, NULL, NULL), 0);
    CHECK_STATUS(signorini_model_write(model, in_folder("case"), f, NULL, gap, COULOMB, mu, slip0,
                                       "step 1"), 0);
    CHECK_STATUS(signorini_problem_read(path, &problem), 0);
    CHECK_STATUS(signorini_solve(problem_data(problem).dim, problem_data(problem).pairs,
                                 problem_data(problem).matrix, 4,
                                 problem_data(problem).rhs, problem_data(problem).gap,
                                 COULOMB, problem_data(problem).friction,
                                 problem_data(problem).slip0, NULL, d_again, F_again, NULL,
                                 NULL, NULL), 0);
    CHECK(same(d_again, d, 4) && same(F_again, F, 4));
    signorini_problem_free(problem);

    CHECK_STATUS(signorini_model_write(NULL, path, f, NULL, gap, COULOMB, mu, NULL, NULL), -1);
    CHECK_STATUS(signorini_model_write(model, NULL, f, NULL, gap, COULOMB, mu, NULL, NULL), -2);
    CHECK_STATUS(signorini_model_write(model, path, NULL, NULL, gap, COULOMB, mu, NULL, NULL), -3);
    CHECK_STATUS(signorini_model_write(model, path, f, NULL, NULL, COULOMB, mu, NULL, NULL), -5);
    CHECK_STATUS(signorini_model_write(model, path, f, NULL, gap, COULOMB, NULL, NULL, NULL), -7);
    CHECK_STATUS(signorini_model_write(model, path, f, NULL, gap, COULOMB, mu, NULL, "\xFF"), -9);
    signorini_model_free(model);
}

static void bad_arguments(void)
{
    const int before = files();
    const double nan[16] = {4, 1, -1, 0, 1, NAN};
    const char *p = in_folder("unwritten");
    signorini_problem *problem = (signorini_problem *)folder;

#define BAD(status, part, call)                                                                   \
    do {                                                                                          \
        CHECK_STATUS(call, status);                                                               \
        CHECK_TEXT(signorini_last_error(), part);                                                 \
    } while (0)
    BAD(-1, "path is NULL",
        signorini_problem_write(NULL, 2, 2, K, 4, f, gap, COULOMB, mu, slip0, NULL));
    BAD(-1, "path is empty",
        signorini_problem_write("", 2, 2, K, 4, f, gap, COULOMB, mu, slip0, NULL));
    BAD(-2, "dim is 4", signorini_problem_write(p, 4, 2, K, 4, f, gap, COULOMB, mu, slip0, NULL));
    BAD(-3, "pairs is -1",
        signorini_problem_write(p, 2, -1, K, 4, f, gap, COULOMB, mu, slip0, NULL));
    BAD(-4, "K is NULL",
        signorini_problem_write(p, 2, 2, NULL, 4, f, gap, COULOMB, mu, slip0, NULL));
    BAD(-4, "K[1,1] is not finite",
        signorini_problem_write(p, 2, 2, nan, 4, f, gap, COULOMB, mu, slip0, NULL));
    BAD(-5, "leading dimension",
        signorini_problem_write(p, 2, 2, K, 3, f, gap, COULOMB, mu, slip0, NULL));
    BAD(-6, "f is NULL",
        signorini_problem_write(p, 2, 2, K, 4, NULL, gap, COULOMB, mu, slip0, NULL));
    BAD(-7, "gap is NULL",
        signorini_problem_write(p, 2, 2, K, 4, f, NULL, COULOMB, mu, slip0, NULL));
    BAD(-8, "law is 8", signorini_problem_write(p, 2, 2, K, 4, f, gap, 8, mu, slip0, NULL));
    BAD(-9, "friction is NULL",
        signorini_problem_write(p, 2, 2, K, 4, f, gap, COULOMB, NULL, slip0, NULL));
    BAD(-9, "g of each pair",
        signorini_problem_write(p, 2, 2, K, 4, f, gap, TRESCA, NULL, slip0, NULL));
    BAD(-10, "slip0[0] is not finite",
        signorini_problem_write(p, 2, 2, K, 4, f, gap, COULOMB, mu, nan + 5, NULL));
    BAD(-11, "control character",
        signorini_problem_write(p, 2, 2, K, 4, f, gap, COULOMB, mu, slip0, "two\nlines"));
    BAD(-11, "not UTF-8",
        signorini_problem_write(p, 2, 2, K, 4, f, gap, COULOMB, mu, slip0, "M\xFCller"));
    BAD(-1, "path is NULL", signorini_lcp_write(NULL, 4, K, 4, f, NULL, NULL));
    BAD(-2, "n is -1", signorini_lcp_write(p, -1, K, 4, f, NULL, NULL));
    BAD(-3, "M is NULL", signorini_lcp_write(p, 4, NULL, 4, f, NULL, NULL));
    BAD(-4, "leading dimension", signorini_lcp_write(p, 4, K, 3, f, NULL, NULL));
    BAD(-5, "q is NULL", signorini_lcp_write(p, 4, K, 4, NULL, NULL, NULL));
    BAD(-6, "cover[2] is -1", signorini_lcp_write(p, 4, K, 4, f, K, NULL));
    BAD(-7, "remark", signorini_lcp_write(p, 4, K, 4, f, NULL, " "));
    BAD(-2, "problem is NULL", signorini_problem_read(p, NULL));
    BAD(-1, "path is NULL", signorini_problem_read(NULL, &problem));
    CHECK(problem == NULL);

    signorini_problem_free(NULL);
    signorini_problem_data data = {.struct_size = sizeof data};
    BAD(-1, "problem is NULL", signorini_problem_view(NULL, &data));
    CHECK(data.matrix == NULL && data.remark == NULL && data.size == 0);
    CHECK(files() == before);
}

static void bad_paths(void)
{
    const int before = files();
    signorini_problem *problem;

    CHECK(mkdir(in_folder("inner"), 0700) == 0);
    BAD(SIGNORINI_STATUS_FILE, "inner: cannot be written: it is not a file",
        write_problem("inner", NULL));
    BAD(SIGNORINI_STATUS_FILE, "inner: cannot be read: it is a dir",
        signorini_problem_read(path, &problem));
    BAD(SIGNORINI_STATUS_FILE, "absent/p: cannot be written: ", write_problem("absent/p", NULL));
    BAD(SIGNORINI_STATUS_FILE, "absent/p: cannot be read: ",
        signorini_problem_read(path, &problem));
    BAD(SIGNORINI_STATUS_FILE, "cannot be written: ", write_problem("coulomb/p", NULL));
    CHECK(problem == NULL && files() == before);

    /* Names are bytes, as for fopen; a relative one is meant. Windows and macOS want UTF-8. */
    CHECK(chdir(folder) == 0);
#ifdef _WIN32
    BAD(-1, "path is not UTF-8", write_problem("\xFF\xFE.mtx", NULL));
    CHECK_STATUS(signorini_problem_write("M\xC3\xBCller.mtx", 2, 2, K, 4, f, gap, COULOMB, mu, slip0,
                                         NULL), 0);
    FILE *file = _wfopen(L"M\u00FCller.mtx", L"rb");
    CHECK(file != NULL && fclose(file) == 0);
    CHECK_STATUS(signorini_problem_read("M\xC3\xBCller.mtx", &problem), 0);
    CHECK(same(problem_data(problem).matrix, K, 16));
    signorini_problem_free(problem);
    CHECK(_wremove(L"M\u00FCller.mtx") == 0 && files() == before);
#elif !defined __APPLE__
    CHECK_STATUS(signorini_problem_write("\xFF\xFE.mtx", 2, 2, K, 4, f, gap, COULOMB, mu, slip0,
                                         NULL), 0);
    CHECK_STATUS(signorini_problem_read("\xFF\xFE.mtx", &problem), 0);
    CHECK(same(problem_data(problem).matrix, K, 16));
    signorini_problem_free(problem);
    CHECK(remove("\xFF\xFE.mtx") == 0 && files() == before);
#endif
}

#ifndef _WIN32
/* A disk that is full, as a limit of 200 bytes a file: the old file stays as it was, no part. */
static void full_disk(void)
{
    const int before = files();
    struct rlimit limit, small;
    signorini_problem *problem;

    CHECK(getrlimit(RLIMIT_FSIZE, &limit) == 0);
    small = limit;
    small.rlim_cur = 200;
    signal(SIGXFSZ, SIG_IGN);
    CHECK(setrlimit(RLIMIT_FSIZE, &small) == 0);
    const int32_t old = write_problem("coulomb", "new"), new = write_problem("unwritten", NULL);
    CHECK(setrlimit(RLIMIT_FSIZE, &limit) == 0);
    CHECK_STATUS(old, SIGNORINI_STATUS_FILE);
    CHECK_STATUS(new, SIGNORINI_STATUS_FILE);
    CHECK_TEXT(signorini_last_error(), "unwritten: cannot be written: ");
    CHECK(files() == before);
    CHECK_STATUS(signorini_problem_read(in_folder("coulomb"), &problem), 0);
    CHECK_TEXT(problem_data(problem).remark, "crane");
    signorini_problem_free(problem);
}

#endif

static void bad_files(void)
{
    static const struct {
        const char *content, *part;
    } bad[] = {
        {"", "bad: line 1: the file ends"},
        {"\x7F" "ELF", "bad: line 1: the file ends before the line does"},
        {"%%MatrixMarket matrix coordinate real general\n", "bad: line 1: not a problem file"},
        {"%%MatrixMarket matrix array real general\n2 2\n1\n0\n0\n1\n", "bad: line 2: some other"},
        {"%%MatrixMarket matrix array real general\n% signorini problem 1\n% kind: lcp\n1 2\n1\n",
         "bad: line 6: the file ends, q, row 0 is missing"},
        {"%%MatrixMarket matrix array real general\n% signorini problem 1\n% kind: lcp\n1 2\nnan\n",
         "bad: line 5: M, row 0: 'nan' must be finite"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        signorini_problem *problem = (signorini_problem *)folder;
        write_file("bad", bad[i].content);
        BAD(SIGNORINI_STATUS_FILE, bad[i].part, signorini_problem_read(in_folder("bad"), &problem));
        CHECK(problem == NULL);
    }
    CHECK_TEXT(signorini_status_string(SIGNORINI_STATUS_FILE), "file");
}

static void clean(void)
{
    const char *names[] = {"coulomb", "tresca", "cohesive", "frictionless", "lcp",
                           "empty",   "case",   "bad",      "inner"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) remove(in_folder(names[i]));
#ifdef _WIN32
    /* It removes no folder, and none that is used. */
    rmdir(in_folder("inner"));
    CHECK(chdir("..") == 0);
#endif
    CHECK(rmdir(folder) == 0);
}

/* Makes the folder of this name, with letters in the place of each X. */
static int made(char *name)
{
#ifdef _WIN32
    return _mktemp(name) != NULL && mkdir(name, 0700) == 0;
#else
    return mkdtemp(name) != NULL;
#endif
}

int main(void)
{
    const char *const name = "/problem file XXXXXX";
    if (getcwd(folder, sizeof folder - strlen(name)) == NULL || !made(strcat(folder, name))) {
        perror(folder);
        return 1;
    }
    gap[1] = INFINITY;
    kinds();
    decimal_commas();
    model_case();
    bad_arguments();
    bad_paths();
#ifndef _WIN32
    full_disk();
#endif
    bad_files();
    clean();
    return check_summary("problem_file");
}
