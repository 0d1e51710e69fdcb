/*
 * A friction problem of FCLIB in local form, on dense arrays: u = W r + q.
 */

#ifndef LOCAL_FORM_H
#define LOCAL_FORM_H

#include <stddef.h>
#include <stdint.h>

struct local_form {
    const char *found; /* the form that the file has: "local" or "global" */
    int dim;           /* 2 or 3 */
    size_t contacts, size; /* size = dim * contacts */
    double *W, *q;         /* W column-major, its symmetric part: equal across to the last bit */
    double asymmetry;      /* how far W, or M of a global form, was from it, beside its diagonal */
    double *mu;            /* one for each contact */
};

/* Reads the problem of a file. A global form (M v = H r + f, u = H' v + w, M definite) becomes
 * W = H' M^-1 H, q = H' M^-1 f + w. Returns NULL, or a sentence on what is wrong. */
const char *local_form_read(const char *path, struct local_form *form);

/* Reads FCLIB's own structs likewise. After a sentence the form may hold a part: free it. */
struct fclib_local;
struct fclib_global;
const char *local_form_of_local(const struct fclib_local *problem, struct local_form *form);
const char *local_form_of_global(const struct fclib_global *problem, struct local_form *form);
void local_form_free(struct local_form *form);

/* The lower triangle of W by columns, without its zeros, for signorini_model_new_flexibility_sparse:
 * contacts of bodies that do not touch each other are apart in it. */
struct triangle {
    int64_t *col_start, *row; /* col_start[size] is the number of entries */
    double *values;
};
struct triangle lower_triangle(const struct local_form *form);
void triangle_free(struct triangle *lower);

/* How far reactions r are from a solution of the file's own problem, relative to the largest of
 * them: |r - P(r - u^ / W_aa)|, u^ = W r + q + mu |u_T| e_N, P the projection on the friction cone,
 * W_aa the largest diagonal entry of the contact's block. Zero at exact solutions only. */
double local_form_residual(const struct local_form *form, const double *r);

/* Nonzero if the file has such a group, "/solution" or "/guesses". */
int file_has(const char *path, const char *group);

#endif
