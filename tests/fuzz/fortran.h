/* The entries of Fortran 77 as C sees them; WIDE: those for 8-byte integers. */

#ifndef FORTRAN_H
#define FORTRAN_H

#include "fuzz.h"

#ifdef WIDE
typedef int64_t integer;
#define ENTRY(name) name##_64_
#else
typedef int32_t integer;
#define ENTRY(name) name##_
#endif

typedef const integer *in;
typedef const double *reals;

void ENTRY(sgsolv)(in ndim, in npair, reals k, in ldk, reals f, reals gap, in law, reals fric,
                   reals slip0, in method, reals tol, in maxit, double *d, double *r,
                   integer *state, double *eta, integer *iter, integer *info);
void ENTRY(sglcps)(in n, reals m, in ldm, reals q, in method, reals tol, in maxit, double *w,
                   double *z, double *eta, integer *iter, integer *info);
void ENTRY(sgspar)(in n, in nnz, in colptr, in rowind, reals values, in tri, in nfix, in fixed,
                   in ndim, in npair, in slave, in nmast, in mstart, in master, reals weight,
                   reals normal, in ntan, reals tangnt, int64_t *handle, integer *info);
void ENTRY(sgcase)(const int64_t *handle, reals f, reals presc, reals gap, in law, reals fric,
                   reals slip0, in method, reals tol, in maxit, double *d, double *r,
                   integer *state, double *eta, integer *iter, integer *info);
void ENTRY(sgrecv)(const int64_t *handle, reals f, reals presc, reals d, double *u, integer *info);
void ENTRY(sgfree)(int64_t *handle, integer *info);
void ENTRY(sgmesg)(char *text, in ltext);

/* A scalar by reference, in memory that ends behind it. */
static inline integer *number_of(int64_t value)
{
    integer *place = input(1, sizeof *place);
    *place = (integer)value;
    return place;
}

static inline double *real_of(double value)
{
    double *place = input(1, sizeof *place);
    *place = value;
    return place;
}

static inline integer *integers(int64_t count)
{
    return output((size_t)count, sizeof(integer));
}

/* Indices in small numbers. */
static inline integer *some(int64_t count, int64_t low, int64_t high)
{
    integer *array = input((size_t)count, sizeof *array);
    for (int64_t i = 0; i < count; i++) array[i] = (integer)between(low, high);
    return array;
}

/* The sentence fits its room, and nothing stands behind it. */
static inline void check_sentence(integer info)
{
    const int64_t room = between(0, 80);
    char *text = output((size_t)room, 1);
    const integer length = (integer)room;
    if (info == SIGNORINI_STATUS_INTERNAL) complain("a defect of the library");
    ENTRY(sgmesg)(text, &length);
    for (int64_t i = 0; i < room; i++) REQUIRE((unsigned char)text[i] >= ' ');
    if (room > 0 && info < 0) REQUIRE(text[0] != ' ');
}

/* States of Fortran's integers for a judge. */
static inline const int32_t *narrow(const integer *state, int64_t pairs)
{
    static int32_t codes[16];
    for (int64_t i = 0; i < pairs; i++) codes[i] = (int32_t)state[i];
    return codes;
}

#endif
