/*
 * malloc and its relatives of a whole program, the shared libraries included, over those of glibc: counted,
 * and refused on demand, on all threads. To be included by one source of the program.
 */

#ifndef FAILING_MALLOC_H
#define FAILING_MALLOC_H

#include <errno.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

extern void *__libc_malloc(size_t);
extern void *__libc_calloc(size_t, size_t);
extern void *__libc_realloc(void *, size_t);
extern void *__libc_memalign(size_t, size_t);
extern void __libc_free(void *);

/* Requests of `least` bytes and more are numbered from 1 while `watching`. */
static struct {
    int watching;
    size_t least;
    int64_t requests, refused;
    /* The requests that are refused: from the first to the last. */
    int64_t first, last;
    /* Pieces that the program holds. */
    int64_t living;
} heap;

/* Watches from here on, and refuses nothing yet. */
static inline void heap_watch(size_t least)
{
    heap.least = least;
    heap.requests = heap.refused = 0;
    heap.first = heap.last = INT64_MAX;
    heap.watching = 1;
}

static int heap_refuses(size_t size)
{
    if (!heap.watching || size < heap.least) return 0;
    const int64_t number = __atomic_add_fetch(&heap.requests, 1, __ATOMIC_RELAXED);
    if (number < heap.first || number > heap.last) return 0;
    __atomic_add_fetch(&heap.refused, 1, __ATOMIC_RELAXED);
    errno = ENOMEM;
    return 1;
}

static void heap_lives(int64_t more)
{
    __atomic_add_fetch(&heap.living, more, __ATOMIC_RELAXED);
}

static void *heap_noted(void *memory)
{
    if (memory) heap_lives(1);
    return memory;
}

void *malloc(size_t size)
{
    return heap_refuses(size) ? NULL : heap_noted(__libc_malloc(size));
}

void *calloc(size_t count, size_t size)
{
    if (size && count > SIZE_MAX / size) return NULL;
    return heap_refuses(count * size) ? NULL : heap_noted(__libc_calloc(count, size));
}

void *realloc(void *old, size_t size)
{
    if (heap_refuses(size)) return NULL;
    void *memory = __libc_realloc(old, size);
    if (!old && memory) heap_lives(1);
    if (old && !memory && !size) heap_lives(-1);
    return memory;
}

void *memalign(size_t alignment, size_t size)
{
    return heap_refuses(size) ? NULL : heap_noted(__libc_memalign(alignment, size));
}

void *aligned_alloc(size_t alignment, size_t size)
{
    return memalign(alignment, size);
}

int posix_memalign(void **memory, size_t alignment, size_t size)
{
    void *made = memalign(alignment, size);
    if (!made) return ENOMEM;
    *memory = made;
    return 0;
}

void free(void *memory)
{
    if (!memory) return;
    heap_lives(-1);
    __libc_free(memory);
}

#endif
