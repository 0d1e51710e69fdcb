/*
 * signorini: models of products and solutions, for codes whose matrix lies on several processes or
 * is never formed. All of it may still change: signorini.h includes it where SIGNORINI_UNSTABLE is
 * defined.
 */

#ifndef SIGNORINI_OPERATOR_H
#define SIGNORINI_OPERATOR_H

#include "signorini.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct signorini_operator signorini_operator;

/**
 * Your product, y = K_rel x or y = W x, with N entries. Returns 0; another number ends the call of
 * the library, whose sentence tells it. As a progress callback it must return, and not call this
 * library.
 */
typedef int32_t (*signorini_product_fn)(void *user, const double *x, double *y);

/**
 * Your solution with components held: y is 0 where held is nonzero, and K_rel y = x in the other
 * components; x counts only there. All have N entries. changed is 0 if the same components are
 * held as in the call before on this model, and that call has not failed: then a factor may serve
 * again. Returns as signorini_product_fn.
 */
typedef int32_t (*signorini_held_fn)(void *user, const int32_t *held, int32_t changed,
                                     const double *x, double *y);

/**
 * Your preconditioner, with unknowns set: z near the solution of A z = r with components of d held
 * and springs. No accuracy is asked, nor that it is linear or symmetric: one cycle of multigrid
 * serves. held has N entries, nonzero where held; r and z do not count there. springs are to be
 * added to A between the tangential components of each pair: force / length, one number for each
 * pair in 2D, in 3D four, a symmetric matrix; those of held components do not count. changed is 0
 * if held and springs are those of the call before on this model, and that call has not failed.
 * Returns as signorini_product_fn.
 */
typedef int32_t (*signorini_precondition_fn)(void *user, const int32_t *held, const double *springs,
                                             int32_t changed, const double *r, double *z);

/**
 * Functions in the place of a matrix, say of a code on several processes. K_rel is the K of
 * signorini_solve.
 */
struct signorini_operator {
    uint32_t struct_size;                   /**< sizeof(signorini_operator). */
    int32_t dim;                            /**< Space dimension. */
    int64_t pairs;                          /**< Number of pairs. */
    /** y = K_rel x; symmetric, positive semi-definite; as exact as the tolerance asks for. */
    signorini_product_fn stiffness;
    /**
     * y = W x, W close to the inverse of K_rel, symmetric, positive definite: a solution with the
     * contact free. NULL: held is used alone.
     */
    signorini_product_fn inverse;
    /** A solution with components held, in the place of W. May be NULL if inverse is given. */
    signorini_held_fn held;
    /**
     * Positive numbers of the size of the diagonal of K_rel, N; force / length. NULL: one for each
     * direction, from products.
     */
    const double *units;
    void *user;                             /**< First argument of the functions. */
    /**
     * 0: vectors have N entries, those of the pairs. Otherwise H, the number of all your unknowns,
     * of which the components of d are some: then stiffness is y = A x on all of them, exact but
     * for rounding; units is given, H; inverse and held are NULL.
     */
    int64_t unknowns;
    /** With unknowns set: the unknown that is each component of d, from 0, N. */
    const int64_t *place;
    signorini_precondition_fn precondition; /**< With unknowns set. */
    /**
     * Of the pairs: what products and solutions agree to, relative to their sizes, as those of an
     * iterative solver: no smaller tolerance can be met. 0: 1e-9.
     */
    double accuracy;
};

/**
 * Makes a model of your functions: no matrix is formed. They run on the threads that call the
 * library.
 *
 * With products and solutions of the pairs H = N: loads and displacements are the relative ones.
 * Load cases are solved as in full space. They take up to 110 products with K_rel and as many with
 * W in 2D, 160 in 3D; or with held up to 70 solutions, with 14 changes of the components that are
 * held.
 *
 * With unknowns set A is symmetric, positive semi-definite, and takes the place of a sparse matrix:
 * supports and the turn to the frames of the pairs are in it. Load cases are solved by Newton's
 * method with FGMRES, in some 10 systems with some 10 preconditionings each. If Newton's method
 * fails, problems with given thresholds of friction follow; no motion of a body that nothing holds
 * is found. eta is measured by a product; the size of the loads beside it is known to a thousandth.
 *
 * The call asks for some products, which must be finite, linear, symmetric, positive and the same
 * each time, to 1e-9 or K->accuracy. Later calls return -1 if a function fails or gives a number
 * that is not finite; the model can be used again.
 *
 * @param K      the functions; the structure is copied, with units and place
 * @param model  out: the model
 */
int32_t signorini_model_new_operator(const signorini_operator *K, signorini_model **model);

#ifdef __cplusplus
} /* extern "C" */
#endif

#endif /* SIGNORINI_OPERATOR_H */
