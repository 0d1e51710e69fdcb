/*
 * Tools of the programs of large.sh: the problem that large_problem.rs has written, the clock, the peak of memory.
 * PROGRAM names the one that fails.
 */
#ifndef LARGE_PROBLEM_H
#define LARGE_PROBLEM_H

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

/* The lower triangle by columns, its last `contact` unknowns those of the pairs; loads, and the gap of each pair. */
struct problem {
    int64_t size, contact, entries;
    int64_t *starts, *rows;
    double *values, *load, *gap;
};

static void die(const char *what)
{
    fprintf(stderr, PROGRAM ": %s\n", what);
    exit(1);
}

static void *memory(size_t count, size_t size)
{
    void *pointer = calloc(count ? count : 1, size);
    if (!pointer) die("out of memory");
    return pointer;
}

static void *array(FILE *file, int64_t count, size_t size)
{
    void *pointer = memory((size_t)count, size);
    if (fread(pointer, size, (size_t)count, file) != (size_t)count) die("the problem is cut off");
    return pointer;
}

static struct problem read_problem(const char *path, int dim)
{
    struct problem p;
    int64_t head[3];
    FILE *file = fopen(path, "rb");
    if (!file || fread(head, sizeof *head, 3, file) != 3) die("the problem cannot be read");
    p.size = head[0];
    p.contact = head[1];
    p.entries = head[2];
    p.starts = array(file, p.size + 1, sizeof(int64_t));
    p.rows = array(file, p.entries, sizeof(int64_t));
    p.values = array(file, p.entries, sizeof(double));
    p.load = array(file, p.size, sizeof(double));
    p.gap = array(file, p.contact / dim, sizeof(double));
    fclose(file);
    return p;
}

static double seconds(clockid_t which)
{
    struct timespec now;
    clock_gettime(which, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Peak resident memory in MB. */
static inline long peak(void)
{
    char line[256];
    long kilobytes = 0;
    FILE *status = fopen("/proc/self/status", "r");
    while (status && fgets(line, sizeof line, status)) sscanf(line, "VmHWM: %ld", &kilobytes);
    if (status) fclose(status);
    return kilobytes / 1000;
}

#endif
