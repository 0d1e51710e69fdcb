/*
 * Tools of the fuzz entries. An entry turns bytes into the arguments of calls, calls, and judges.
 *
 * Arrays have their exact size: one end lies at a page that cannot be touched, the other at bytes that are
 * looked at afterwards. So an access behind the end stops the program without any sanitizer, in the library
 * too. Inputs must be as before after every call, outputs as before if the call returned less than zero.
 */

#ifndef FUZZ_H
#define FUZZ_H

#include "../c/everything.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

/* The entry: bytes in; it returns 0, or stops the program by complain(). */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* ---- bytes to numbers ---- */

/* Takes the bytes of an input, and gives back all arrays of the input before. */
void begin(const uint8_t *data, size_t size);

/* The next byte, 0 behind the last. */
uint8_t byte(void);

/* A number from low to high. */
int64_t between(int64_t low, int64_t high);

/* True in one of `odds` inputs or so; behind the last byte never. */
int rarely(int odds);

/* Nonzero if this input keeps to numbers of ordinary size. */
int sane(void);

/* A number: eighths, any bits, or the odd ones that break programs. */
double number(void);

/* A size of an array that is `right`, rarely one that no array can have. */
int64_t size_or_wrong(int64_t right);

/* The rest of the input. */
const uint8_t *rest(size_t *size);

/* ---- arrays ---- */

/* An array of the call, to be filled before it; the library only reads it. */
void *input(size_t count, size_t bytes);

/* An input of indices, of 4 or 8 bytes each. */
void *indices(int64_t count, int bytes, const int64_t *values);

/* An array that the call writes. It is full of one odd byte. */
void *output(size_t count, size_t bytes);

/* Numbers of the input, NULL if count is not positive. */
double *numbers(int64_t count);
double *outputs(int64_t count);
int32_t *states(int64_t count);

/* NULL, where an argument may be. */
void *or_null(void *pointer, int odds);

/* Call it before the library's call, and after it with its status. */
void arm(void);
void check_arrays(int32_t status);

/* An array that the call has left, where it is copied or read by the next call. */
void as_input(const void *array);

/* Prints the fault for whoever reads it; stops the program. */
void complain(const char *format, ...) __attribute__((noreturn, format(printf, 1, 2)));

#define REQUIRE(condition)                                                                         \
    do {                                                                                           \
        if (!(condition)) complain("%s:%d: %s", __FILE__, __LINE__, #condition);                   \
    } while (0)

/* ---- problems ---- */

typedef struct problem {
    int32_t dim, law;
    int64_t pairs, n, ld;
    double *K, *f, *gap, *friction, *slip0;
    /* K is A A' + I of small integers. */
    int definite;
} problem;

/* A column-major matrix; whether it is definite by its making. */
double *matrix(int64_t n, int64_t ld, int *definite);
problem a_problem(void);

/* A law, and numbers of a law for each pair. */
int32_t a_law(int32_t dim);
int per_pair(int32_t law);
double *friction_numbers(int32_t dim, int32_t law, int64_t pairs);

signorini_settings *a_settings(void);
double tolerance_of(const signorini_settings *settings);
signorini_report *a_report(void);
/* Which pairs' arrays are wanted, with room for `cases` cases. */
signorini_extra *an_extra(int64_t n, int64_t pairs, int64_t cases);

/* The statuses that a call may return. */
void check_status(int32_t status, int arguments);

/*
 * Checks that recovered values are finite if the status is 0. Numbers that no structure has may overflow, which is
 * refused.
 */
void check_recovered(int32_t status, const double *values, int64_t count);

/* ---- judges, in quadruple precision ---- */

/* A result of status 0 on the data of a condensed problem. */
void judge_solution(const problem *p, double tolerance, const double *d, const double *F,
                    const int32_t *state, const signorini_report *report);

/* A proof of no equilibrium. */
void judge_motion(const problem *p, const double *motion);

/* Forces under the law and states of their own. */
void judge_law(const problem *p, const double *F, const int32_t *state);

/* d = W F + q and the law, with W in the place of K and q in that of f. */
void judge_flexibility(const problem *p, double tolerance, const double *d, const double *F,
                       const int32_t *state);

/* w = q + M z, both at least 0 and complementary; y proves that there is none. */
void judge_lcp(int64_t n, const double *M, int64_t ld, const double *q, double tolerance,
               const double *w, const double *z);
void judge_ray(int64_t n, const double *M, int64_t ld, const double *q, const double *y);

#endif
