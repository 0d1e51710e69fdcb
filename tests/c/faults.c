/*
 * Faults around a call, and how the call ends: a table of fault and outcome, each row tried
 * here. Other programs try more of some rows: out_of_memory.c, processes.c, older_structures.c, problem_file.c,
 * environment.c. Linux with glibc.
 *
 *     faults
 */

#define _GNU_SOURCE

#include "failing_malloc.h"

#include "memory_scenarios.h"

#include <dirent.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <fenv.h>
#include <pthread.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

/* A row of the table: the outcome if it holds. */
static void row(const char *fault, const char *outcome, int holds)
{
    if (!check_result(__FILE__, __LINE__, holds)) printf("this outcome is not seen\n");
    printf("| %-66s | %-70s |\n", fault, holds ? outcome : "NOT SEEN");
    fflush(stdout);
}

/* The answer of `body` in a child process; -1 if the child is ended by a signal, or does not end in 20 s. */
static int in_child(int (*body)(void *), void *argument)
{
    fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
        alarm(20);
        _exit(body(argument));
    }
    int status = 0;
    if (child < 0 || waitpid(child, &status, 0) != child) return -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/* ---- The system's calls for files, watched and refused on demand ----------------------------- */

enum { NONE, WRITE, FSYNC, RENAME };

static struct {
    /* Which call fails. */
    int fails;
    /* The order of what was done with files: letters w, s, r. */
    char order[8192];
    int count, watching;
} disk;

static int disk_fails(int which, char letter, int error)
{
    if (disk.watching && disk.count < (int)sizeof disk.order - 1) disk.order[disk.count++] = letter;
    if (!disk.watching || disk.fails != which) return 0;
    errno = error;
    return 1;
}

ssize_t write(int file, const void *bytes, size_t count)
{
    static ssize_t (*next)(int, const void *, size_t);
    if (!next) *(void **)&next = dlsym(RTLD_NEXT, "write");
    return file > 2 && disk_fails(WRITE, 'w', ENOSPC) ? -1 : next(file, bytes, count);
}

int fsync(int file)
{
    static int (*next)(int);
    if (!next) *(void **)&next = dlsym(RTLD_NEXT, "fsync");
    return disk_fails(FSYNC, 's', EIO) ? -1 : next(file);
}

int rename(const char *from, const char *to)
{
    static int (*next)(const char *, const char *);
    if (!next) *(void **)&next = dlsym(RTLD_NEXT, "rename");
    return disk_fails(RENAME, 'r', EACCES) ? -1 : next(from, to);
}

static void disk_watch(int fails)
{
    memset(&disk, 0, sizeof disk);
    disk.fails = fails;
    disk.watching = 1;
}

/* ---- Files ----------------------------------------------------------------------------------- */

static const double K[4] = {5, 0, 0, 3}, f[2] = {10, 8}, gap[1] = {0}, mu[1] = {0.5};

static int32_t save(const char *path, const char *remark)
{
    return signorini_problem_write(path, 2, 1, K, 2, f, gap, SIGNORINI_LAW_COULOMB, mu, NULL, remark);
}

/* The remark of the file at `path`. */
static int has_remark(const char *path, const char *remark)
{
    signorini_problem *problem = NULL;
    const int32_t status = signorini_problem_read(path, &problem);
    const int same = status == 0 && strcmp(problem_data(problem).remark, remark) == 0;
    signorini_problem_free(problem);
    return same;
}

static int entries(void)
{
    DIR *folder = opendir(".");
    int count = 0;
    while (folder && readdir(folder)) count++;
    if (folder) closedir(folder);
    return count;
}

/* 0 if the file is refused for reading, with `part` in the sentence. */
struct refused {
    const char *path, *part;
};

static int reads_it(void *argument)
{
    const struct refused *refused = argument;
    signorini_problem *problem = NULL;
    const int32_t status = signorini_problem_read(refused->path, &problem);
    return !(status == SIGNORINI_STATUS_FILE && problem == NULL &&
             strstr(signorini_last_error(), refused->part));
}

static int writes_it(void *argument)
{
    const struct refused *refused = argument;
    return !(save(refused->path, NULL) == SIGNORINI_STATUS_FILE &&
             strstr(signorini_last_error(), refused->part));
}

static void special_files(void)
{
    /* A chroot without /dev/pts has no terminals. */
    const int terminal = posix_openpt(O_RDWR | O_NOCTTY);
    char name[128] = "";
    if (terminal >= 0) {
        CHECK(grantpt(terminal) == 0 && unlockpt(terminal) == 0);
        CHECK(ptsname_r(terminal, name, sizeof name) == 0);
    }
    CHECK(mkfifo("fifo", 0600) == 0 && mkdir("folder", 0700) == 0);
    const struct {
        const char *fault, *path;
    } kinds[] = {{"a FIFO", "fifo"}, {"a terminal", name}, {"a device", "/dev/zero"},
                 {"a directory", "folder"}};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        struct refused reading = {kinds[i].path, "cannot be read"};
        struct refused writing = {kinds[i].path, "cannot be written: it is not a file"};
        char fault[80];
        snprintf(fault, sizeof fault, "%s in the place of a problem file", kinds[i].fault);
        if (kinds[i].path[0] == '\0') {
            printf("| %-66s | %-70s |\n", fault, "not tried: this system has none");
            continue;
        }
        row(fault, "refused at once, reading and writing",
            in_child(reads_it, &reading) == 0 && in_child(writes_it, &writing) == 0);
    }
    if (terminal >= 0) close(terminal);
    CHECK(remove("fifo") == 0 && rmdir("folder") == 0);
}

static void places_of_files(void)
{
    struct stat seen;
    CHECK_STATUS(save("private", "old"), 0);
    CHECK(chmod("private", 0600) == 0);
    row("writing over a file of mode 0600", "the mode stays",
        save("private", "new") == 0 && stat("private", &seen) == 0 &&
            (seen.st_mode & 0777) == 0600 && has_remark("private", "new"));
    CHECK(symlink("private", "link") == 0 && symlink("nothing", "dangling") == 0);
    row("writing to a symbolic link", "the file that it names is written, the link stays",
        save("link", "linked") == 0 && lstat("link", &seen) == 0 && S_ISLNK(seen.st_mode) &&
            has_remark("private", "linked"));
    row("writing to a link to nothing", "refused, and the link stays",
        save("dangling", NULL) == SIGNORINI_STATUS_FILE && lstat("dangling", &seen) == 0);
    CHECK_TEXT(signorini_last_error(), "it is a link to nothing");
    CHECK(link("private", "other") == 0);
    row("writing over a file with another name (hard link)", "the other name keeps the old contents",
        save("private", "newer") == 0 && has_remark("other", "linked"));
    CHECK(remove("dangling") == 0 && remove("link") == 0 && remove("other") == 0);
    const int32_t broken = save("no\nsuch\tfolder/p", NULL);
    row("a line feed in a path", "refused in one line, with ? for it",
        broken == SIGNORINI_STATUS_FILE && !strpbrk(signorini_last_error(), "\n\t") &&
            strstr(signorini_last_error(), "no?such?folder"));
    row("a remark that ends with a space", "refused, the argument is named",
        save("private", "a remark ") == -11 && strstr(signorini_last_error(), "with a space"));
    CHECK(has_remark("private", "newer"));
}

static int as_nobody(void *argument)
{
    (void)argument;
    if (geteuid() == 0 && (setegid(65534) || seteuid(65534))) return 2;
    return !(save("locked/p", NULL) == SIGNORINI_STATUS_FILE && entries() > 0);
}

static int with_small_files(void *argument)
{
    const struct rlimit small = {100, 100};
    (void)argument;
    signal(SIGXFSZ, SIG_IGN);
    if (setrlimit(RLIMIT_FSIZE, &small)) return 2;
    return save("kept", "new") != SIGNORINI_STATUS_FILE;
}

/* The old file is as it was, and there is no part of a new one. */
static void disks(void)
{
    CHECK_STATUS(save("kept", "old"), 0);
    const int before = entries();
    const struct {
        int which;
        const char *fault;
    } faults[] = {{WRITE, "the disk is full while a problem file is written"},
                  {FSYNC, "the disk tells with fsync that it has failed"},
                  {RENAME, "the new file cannot take the name of the old one"}};
    for (size_t i = 0; i < sizeof faults / sizeof *faults; i++) {
        disk_watch(faults[i].which);
        const int32_t status = save("kept", "new");
        disk.watching = 0;
        row(faults[i].fault, "a status; the old file is as it was, no part is left",
            status == SIGNORINI_STATUS_FILE && has_remark("kept", "old") && entries() == before);
    }
    row("a limit on the size of files (RLIMIT_FSIZE)",
        "a status; the old file is as it was, no part is left",
        in_child(with_small_files, NULL) == 0 && has_remark("kept", "old") && entries() == before);
    CHECK(mkdir("locked", 0555) == 0);
    row("a directory that cannot be written", "a status", in_child(as_nobody, NULL) == 0);
    CHECK(rmdir("locked") == 0);
    disk_watch(NONE);
    CHECK_STATUS(save("kept", "new"), 0);
    disk.watching = 0;
    /* All bytes, then fsync, then the new name: at no time is there half a file under it. */
    const size_t written = strspn(disk.order, "w");
    row("the power fails while a file is replaced", "the disk has the new file before it takes the name",
        written > 0 && strcmp(disk.order + written, "sr") == 0);
    CHECK(has_remark("kept", "new") && remove("kept") == 0);
}

/* ---- Memory ---------------------------------------------------------------------------------- */

struct refusals {
    struct world *world;
    int32_t (*run)(struct world *);
    int32_t expected;
};

/* Each request of a call refused, alone and with all later ones. */
static int without_memory(void *argument)
{
    const struct refusals *refusals = argument;
    struct world *w = refusals->world;
    refusals->run(w);
    heap_watch(1);
    int32_t status = refusals->run(w);
    const int64_t requests = heap.requests, before = heap.living;
    if (status != refusals->expected || requests == 0) return 1;
    for (int64_t first = 1; first <= requests; first += requests > 50 ? requests / 50 : 1)
        for (int once = 0; once < 2; once++) {
            heap_watch(1);
            heap.first = first;
            heap.last = once ? first : INT64_MAX;
            status = refusals->run(w);
            heap.watching = 0;
            if (status != refusals->expected && status != SIGNORINI_STATUS_OUT_OF_MEMORY) return 2;
            if (heap.living != before || refusals->run(w) != refusals->expected) return 3;
        }
    return 0;
}

static int beyond_its_budget(struct world *w)
{
    chain *c = &w->plane;
    signorini_settings settings;
    CHECK_STATUS(signorini_settings_default(&settings, sizeof settings), 0);
    settings.memory_limit = 1000;
    c->d[0] = 77;
    return signorini_solve(c->dim, c->pairs, c->K, c->n, c->f, c->gap, SIGNORINI_LAW_COULOMB, c->mu,
                           NULL, &settings, c->d, c->F, c->state, NULL, NULL) ==
               SIGNORINI_STATUS_MEMORY_LIMIT && c->d[0] == 77;
}

void sgsolv_(const int32_t *ndim, const int32_t *npair, const double *k, const int32_t *ldk,
             const double *load, const double *gaps, const int32_t *law, const double *fric,
             const double *slip0, const int32_t *method, const double *tol, const int32_t *maxit,
             double *d, double *r, int32_t *state, double *eta, int32_t *iter, int32_t *info);
void sgspar_(const int32_t *n, const int32_t *nnz, const int32_t *colptr, const int32_t *rowind,
             const double *values, const int32_t *tri, const int32_t *nfix, const int32_t *fixed,
             const int32_t *ndim, const int32_t *npair, const int32_t *slave, const int32_t *nmast,
             const int32_t *mstart, const int32_t *master, const double *weight, const double *normal,
             const int32_t *ntan, const double *tangnt, int64_t *handle, int32_t *info);
void sgrecv_(const int64_t *handle, const double *load, const double *presc, const double *d, double *u,
             int32_t *info);
void sgfree_(int64_t *handle, int32_t *info);

/* 400,000,000 pairs, of which no array exists: neither it nor the library touches memory. */
static int absurd_number_of_pairs(void *argument)
{
    const int32_t two = 2, pairs = 400000000, wrong = 800000000, zero = 0, law = 1;
    const size_t bytes = (size_t)pairs * sizeof(int32_t), page = (size_t)sysconf(_SC_PAGESIZE);
    struct rusage before, after;
    (void)argument;
    int32_t *state = mmap(NULL, bytes, PROT_READ | PROT_WRITE,
                          MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    unsigned char *resident = calloc(1, bytes / page + 1);
    if (state == MAP_FAILED || !resident) return 2;
    int32_t info = 0, iter = 0;
    double eta = 0, tolerance = 0, d[2] = {7, 7}, r[2] = {7, 7};
    getrusage(RUSAGE_SELF, &before);
    sgsolv_(&two, &pairs, K, &wrong, f, gap, &law, mu, gap, &zero, &tolerance, &zero, d, r, state,
            &eta, &iter, &info);
    getrusage(RUSAGE_SELF, &after);
    if (info >= 0 || mincore(state, bytes, resident)) return 3;
    for (size_t i = 0; i < bytes / page; i++)
        if (resident[i] & 1) return 4;
    /* Kilobytes. */
    return after.ru_maxrss - before.ru_maxrss > 16 << 10 || d[0] != 7 || r[0] != 7;
}

static int only_refusal(void *argument)
{
    const struct refusals *refusals = argument;
    heap_watch(1);
    heap.first = 1;
    const int32_t status = refusals->run(refusals->world);
    heap.watching = 0;
    return !((status == refusals->expected || status == SIGNORINI_STATUS_OUT_OF_MEMORY) &&
             signorini_last_error()[0]);
}

static void memory(struct world *w)
{
    struct refusals solving = {w, plane_auto, 0}, refusing = {w, refusal, -3}, writing = {w, files, 0};
    row("the system refuses memory to a solution, at any request",
        "SIGNORINI_STATUS_OUT_OF_MEMORY; nothing is held, the next call works",
        in_child(without_memory, &solving) == 0);
    row("the system refuses memory to a file, written and read",
        "SIGNORINI_STATUS_OUT_OF_MEMORY; nothing is held, the next call works",
        in_child(without_memory, &writing) == 0);
    row("the system refuses all memory to a call with a wrong argument",
        "a negative status, with its sentence", in_child(only_refusal, &refusing) == 0);
    row("a call may need more than settings.memory_limit",
        "SIGNORINI_STATUS_MEMORY_LIMIT, nothing is done", beyond_its_budget(w));
    row("NPAIR of SGSOLV is 400,000,000 by mistake", "a negative INFO, no memory is touched",
        in_child(absurd_number_of_pairs, NULL) == 0);
}

/* ---- Structures ------------------------------------------------------------------------------ */

static void structures(void)
{
    /* A report of 16 bytes, then d and F. */
    union {
        unsigned char bytes[512];
        double aligned[64];
    } room;
    const uint32_t size = 16;
    memset(&room, 0xEE, sizeof room);
    memcpy(room.bytes, &size, sizeof size);
    double *const d = room.aligned + 2, *const F = d + 2, elsewhere[4];
    signorini_report *const report = (void *)room.bytes;
    row("an older, smaller report directly before the array d", "solved, nothing overlaps",
        signorini_solve(2, 1, K, 2, f, gap, SIGNORINI_LAW_COULOMB, mu, NULL, NULL, d, F, NULL, report,
                        NULL) == 0 && fabs(d[1] - 1) < 1e-9);
    row("the array d inside the report", "refused, both are named",
        signorini_solve(2, 1, K, 2, f, gap, SIGNORINI_LAW_COULOMB, mu, NULL, NULL, d - 1, F, NULL,
                        report, NULL) == -14 && strstr(signorini_last_error(), "overlaps"));
    int refused = 1;
    for (uint32_t wrong = 0; wrong < sizeof(signorini_report); wrong++) {
        if (wrong >= 16 && wrong % 8 == 0) continue;
        report->struct_size = wrong;
        refused &= signorini_solve(2, 1, K, 2, f, gap, SIGNORINI_LAW_COULOMB, mu, NULL, NULL,
                                   elsewhere, elsewhere + 2, NULL, report, NULL) == -14;
    }
    row("a struct_size below 16, or no multiple of 8", "refused, the structure is named", refused);
}

/* ---- Threads, processes, callbacks ------------------------------------------------------------ */

struct run {
    struct world *world;
    int32_t (*run)(struct world *);
    int32_t status;
    int cancelled;
};

static void *run(void *argument)
{
    struct run *run = argument;
    /* Before its call begins, so that the system ends it wherever the call lets it. */
    if (run->cancelled) pthread_cancel(pthread_self());
    run->status = run->run(run->world);
    pthread_testcancel();
    return NULL;
}

/* A thread that is cancelled ends after its call. */
static int ends_after_its_call(void *argument)
{
    struct run *work = argument;
    pthread_t thread;
    void *end = NULL;
    if (pthread_create(&thread, NULL, run, work) || pthread_join(thread, &end)) return 2;
    return !(work->status == 0 && end == PTHREAD_CANCELED);
}

static int on_a_stack(void *argument)
{
    struct run *work = argument;
    pthread_attr_t attributes;
    pthread_t thread;
    const long least = sysconf(_SC_THREAD_STACK_MIN); /* more than 64 KiB on processors of ARM */
    const size_t bytes = least > 64 << 10 ? (size_t)least : 64 << 10;
    if (pthread_attr_init(&attributes) || pthread_attr_setstacksize(&attributes, bytes) ||
        pthread_create(&thread, &attributes, run, work) || pthread_join(thread, NULL))
        return 2;
    return work->status != 0;
}

/* The number of a model of one node on springs, before a floor below it. */
static int32_t new_handle(int64_t *handle)
{
    static const int32_t start[] = {1, 2, 3}, dofs[] = {1, 2}, two = 2, one = 1, none = 0;
    static const double springs[] = {2, 2}, up[] = {0, -1};
    int32_t info = -77;
    sgspar_(&two, &two, start, dofs, springs, &none, &none, NULL, &two, &one, dofs, &none, NULL, NULL, NULL, up,
            &none, NULL, handle, &info);
    return info;
}

static volatile int ends;

static void *makes_handles(void *argument)
{
    (void)argument;
    while (!ends) {
        int64_t handle = 0;
        int32_t info = new_handle(&handle);
        sgfree_(&handle, &info);
    }
    return NULL;
}

static int makes_a_handle(void *argument)
{
    int64_t handle = 0;
    int32_t info = new_handle(&handle);
    (void)argument;
    if (info) return 1;
    sgfree_(&handle, &info);
    return info != 0;
}

static void handles_and_forks(void)
{
    pthread_t thread[2];
    int good = 0;
    CHECK(pthread_create(thread, NULL, makes_handles, NULL) == 0);
    CHECK(pthread_create(thread + 1, NULL, makes_handles, NULL) == 0);
    enum { FORKS = 200 };
    for (int round = 0; round < FORKS && good == round; round++)
        good += in_child(makes_a_handle, NULL) == 0;
    ends = 1;
    CHECK(pthread_join(thread[0], NULL) == 0 && pthread_join(thread[1], NULL) == 0);
    row("fork while two threads make Fortran handles, 200 times", "every child makes and releases one",
        good == FORKS);
}

/* A handle that is released is refused for ever, also after others were made. */
static void released_handles(void)
{
    int64_t old[8], now[8];
    int32_t info = 0;
    double u[2];
    int refused = 1;
    for (int i = 0; i < 8; i++) {
        int64_t handle = 0;
        info = new_handle(&handle);
        refused &= info == 0 && handle != 0;
        old[i] = handle;
        sgfree_(&handle, &info);
        refused &= info == 0 && handle == 0;
    }
    for (int i = 0; i < 8; i++) refused &= new_handle(&now[i]) == 0;
    for (int i = 0; i < 8; i++) {
        int64_t handle = old[i];
        sgrecv_(&handle, f, NULL, f, u, &info);
        refused &= info == -1 && strstr(signorini_last_error(), "there is no such model") != NULL;
        sgfree_(&handle, &info);
        refused &= info == -1;
    }
    for (int i = 0; i < 8; i++) {
        sgfree_(&now[i], &info);
        refused &= info == 0;
    }
    row("a Fortran handle used after SGFREE, when others were made", "refused", refused);
}

static void threads(struct world *w)
{
    struct run writing = {w, files, -77, 1}, solving = {w, plane_auto, -77, 1};
    row("a thread is cancelled while it writes and reads a file", "the call ends as always, then the thread",
        in_child(ends_after_its_call, &writing) == 0);
    row("a thread is cancelled while it solves", "the call ends as always, then the thread",
        in_child(ends_after_its_call, &solving) == 0);
    struct run searching = {w, plane_others, -77, 0};
    row("a search for other solutions on a stack of 64 KiB", "solved", in_child(on_a_stack, &searching) == 0);
    handles_and_forks();
    released_handles();
}

static int32_t at_once(void *user, const signorini_progress *progress)
{
    (void)user;
    (void)progress;
    return 1;
}

/* A call under settings that end it. */
static int ended(chain *c, int32_t method, double seconds, int cancel, int32_t expected)
{
    signorini_settings settings;
    signorini_report report = {.struct_size = sizeof report};
    CHECK_STATUS(signorini_settings_default(&settings, sizeof settings), 0);
    settings.method = method;
    settings.time_limit = seconds;
    settings.progress = cancel ? at_once : NULL;
    for (int64_t i = 0; i < c->n; i++) c->d[i] = NAN;
    const int32_t status = signorini_solve(c->dim, c->pairs, c->K, c->n, c->f, c->gap,
                                           SIGNORINI_LAW_COULOMB, c->mu, NULL, &settings, c->d, c->F,
                                           c->state, &report, NULL);
    int finite = isfinite(report.eta);
    for (int64_t i = 0; i < c->n; i++) finite &= isfinite(c->d[i]) && isfinite(c->F[i]);
    return status == expected && finite;
}

static int reduction_ends(struct world *w, double seconds, int cancel, int32_t expected)
{
    const signorini_sparse matrix = matrix_of(w->mesh);
    signorini_surface_pairs *contact = NULL;
    signorini_model *model = (signorini_model *)w;
    signorini_settings settings;
    CHECK_STATUS(signorini_settings_default(&settings, sizeof settings), 0);
    CHECK_STATUS(signorini_surface_pair(3, w->mesh->nodes, w->mesh->at[0], &w->bottom, &w->top, NULL,
                                        &contact), 0);
    settings.time_limit = seconds;
    settings.progress = cancel ? at_once : NULL;
    const int64_t before = heap.living;
    const int32_t status = signorini_model_new_sparse(
        &matrix, w->n_fixed, w->fixed, surface_data(contact).rows, &settings, &model);
    const int ended = status == expected && model == NULL && heap.living == before;
    signorini_surface_free(contact);
    return ended;
}

static void limits(struct world *w)
{
    chain large = chain_new(2, 200, 1e-3, 3);
    row("a time limit of 1 ms in the middle of Lemke's method, 400 unknowns",
        "SIGNORINI_STATUS_TIME_LIMIT, with the best iterate",
        ended(&large, SIGNORINI_METHOD_LEMKE, 1e-3, 0, SIGNORINI_STATUS_TIME_LIMIT));
    row("a callback cancels a solution", "SIGNORINI_STATUS_CANCELLED, with the best iterate",
        ended(&large, SIGNORINI_METHOD_LEMKE, 0, 1, SIGNORINI_STATUS_CANCELLED));
    row("a callback cancels the reduction of a sparse matrix", "SIGNORINI_STATUS_CANCELLED, no model, nothing is held",
        reduction_ends(w, 0, 1, SIGNORINI_STATUS_CANCELLED));
    row("a time limit passes in the reduction of a sparse matrix", "SIGNORINI_STATUS_TIME_LIMIT, no model, nothing is held",
        reduction_ends(w, 1e-9, 0, SIGNORINI_STATUS_TIME_LIMIT));
    feclearexcept(FE_ALL_EXCEPT);
    /* Most processors of ARM have no traps. */
    feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
    const int traps = fegetexcept();
#if defined __x86_64__
    CHECK(traps == (FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW));
#endif
    const int32_t status = plane_auto(w);
    const int kept = fegetexcept() == traps;
    fedisableexcept(FE_ALL_EXCEPT);
    row("the host traps floating-point exceptions", "solved, and the traps are set afterwards",
        status == 0 && kept);
    chain_free(&large);
}

/* The name under which a program that is linked with the library looks for it. */
static void shared_object(void)
{
    char path[4096] = "";
    Dl_info found;
    struct stat seen;
    void *address;
    *(const char *(**)(void))&address = signorini_version;
    if (dladdr(address, &found) && realpath(found.dli_fname, path) && strrchr(path, '/')) {
        char *const name = strrchr(path, '/') + 1;
        const char *const version = signorini_version(), *const minor = strchr(version, '.');
        const char *const patch = minor ? strchr(minor + 1, '.') : NULL;
        const int length = patch ? (int)(patch - version) : 0;
        snprintf(name, sizeof path - (size_t)(name - path), "libsignorini.so.%.*s", length, version);
    }
    row("a program is linked with the library that cargo has built", "it starts: the file of the SONAME lies beside",
        path[0] && stat(path, &seen) == 0);
}

int main(void)
{
    char folder[] = "faults_XXXXXX";
    /* Who reads a table wants no error of the child between its rows. */
    struct world *world = world_new();
    if (!mkdtemp(folder) || chmod(folder, 0777) || chdir(folder)) {
        perror(folder);
        return 1;
    }
    plane_auto(world);
    printf("| %-66s | %-70s |\n", "fault", "outcome");
    printf("|%.68s|%.72s|\n", "--------------------------------------------------------------------",
           "------------------------------------------------------------------------");
    memory(world);
    special_files();
    places_of_files();
    disks();
    structures();
    threads(world);
    limits(world);
    shared_object();
    remove("private");
    world_free(world);
    CHECK(chdir("..") == 0 && rmdir(folder) == 0);
    return check_summary("faults");
}
