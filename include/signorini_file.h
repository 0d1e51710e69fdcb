/*
 * signorini: problems in files. A problem file holds one problem as text, with the same bits. Mail
 * it with a bug report.
 */

#ifndef SIGNORINI_FILE_H
#define SIGNORINI_FILE_H

#include "signorini.h"

#ifdef __cplusplus
extern "C" {
#endif

/**
 * Writes the problem of signorini_solve to a file, as text that keeps every bit.
 *
 * The file is a dense matrix in the Matrix Market format: the columns of K, f, gap, friction and
 * slip0, and comment lines that say so. It is written beside its place under a name that ends in
 * .part, then renamed: it appears only when it is complete. A file that it replaces hands on its
 * mode; through a symbolic link the file is replaced that it names; pipes, devices and links to
 * nothing are refused. K must be finite; its symmetry and definiteness are not checked.
 *
 * @param path    name of the file, which is replaced if it exists; bytes as for fopen (UTF-8 on
 *                Windows)
 * @param dim,pairs,K,ldk,f,gap,law,friction,slip0  as for signorini_solve
 * @param remark  one line of UTF-8 for the reader of the file, at most 1000 bytes, that does not
 *                begin or end with a space; may be NULL
 * @return the status; after SIGNORINI_STATUS_FILE an old file is unchanged
 */
int32_t signorini_problem_write(const char *path, int32_t dim, int64_t pairs, const double *K,
                                int64_t ldk, const double *f, const double *gap, int32_t law,
                                const double *friction, const double *slip0, const char *remark);

/**
 * Writes a load case of a model as signorini_problem_write does: the condensed problem, for which
 * signorini_solve gives the same d and F. If pairs depend on each other there is none: -1 is
 * returned.
 *
 * @param model        the model
 * @param path,remark  as for signorini_problem_write
 * @param f,prescribed,gap,law,friction,slip0  as for signorini_model_solve
 * @return as signorini_problem_write
 */
int32_t signorini_model_write(const signorini_model *model, const char *path, const double *f,
                              const double *prescribed, const double *gap, int32_t law,
                              const double *friction, const double *slip0, const char *remark);

/**
 * Writes the problem of signorini_lcp_solve as signorini_problem_write does: the columns of M, q
 * and, if given, cover.
 *
 * @param path,remark  as for signorini_problem_write
 * @param n,M,ldm,q    as for signorini_lcp_solve
 * @param cover        covering vector, n positive entries; may be NULL
 * @return as signorini_problem_write
 */
int32_t signorini_lcp_write(const char *path, int64_t n, const double *M, int64_t ldm,
                            const double *q, const double *cover, const char *remark);

/* Kind of a problem. */
#define SIGNORINI_PROBLEM_CONTACT 0 /**< A contact problem, of signorini_solve. */
#define SIGNORINI_PROBLEM_LCP 1     /**< An LCP, of signorini_lcp_solve. */

typedef struct signorini_problem_data signorini_problem_data;

/**
 * A problem from a file. It does not change: several threads may use one at once.
 * signorini_problem_free releases it.
 */
typedef struct signorini_problem signorini_problem;

/**
 * Reads a problem from a file. Any file is safe to read: the call returns either a problem or an
 * error that names the line. Pipes and devices are refused at once.
 *
 * @param path     name of the file
 * @param problem  out: the problem; NULL unless 0 is returned
 * @return the status; SIGNORINI_STATUS_FILE: the file cannot be read, or is no complete problem
 *         file
 */
int32_t signorini_problem_read(const char *path, signorini_problem **problem);

/** Releases a problem. NULL is allowed. */
void signorini_problem_free(signorini_problem *problem);

/** The content of a problem. Arrays live as long as the problem; one without entries is NULL. */
struct signorini_problem_data {
    uint32_t struct_size; /**< sizeof(signorini_problem_data). */
    int32_t kind;         /**< SIGNORINI_PROBLEM_..., the kind of the problem. */
    int32_t law;          /**< SIGNORINI_LAW_..., the friction law; -1 of an LCP. */
    int32_t dim;          /**< Space dimension, 2 or 3; 0 of an LCP. */
    int64_t pairs;        /**< Number of contact pairs; 0 of an LCP. */
    int64_t size;         /**< Number of unknowns, N = dim * pairs or n. */
    const double *matrix; /**< K or M, column-major; its leading dimension is size. */
    const double *rhs;    /**< Right-hand side: f or q, size entries. */
    const double *gap;    /**< Gaps, one for each pair. */
    /** Parameters of the friction law, pair by pair; NULL if frictionless. */
    const double *friction;
    const double *slip0;  /**< Reference slip, dim - 1 for each pair. */
    const double *cover;  /**< Covering vector of an LCP; NULL if the file has none. */
    const char *remark;   /**< The remark of the file, UTF-8; empty if there is none. */
};

/** Fills data, whose struct_size you set. Its arrays live as long as the problem. */
int32_t signorini_problem_view(const signorini_problem *problem, signorini_problem_data *data);

#ifdef __cplusplus
} /* extern "C" */
#endif

#endif /* SIGNORINI_FILE_H */
