/*
 * The declarations of include/signorini.h as commit 8ec450a had them, the first header of SIGNORINI_ABI_VERSION 2:
 * its settings, report, extra and sparse matrix are shorter than today's. A program that was built with it runs
 * with every library of this ABI. It is not to be changed.
 */

#ifndef OLDER_HEADER_H
#define OLDER_HEADER_H

#include <stdint.h>

typedef struct signorini_settings signorini_settings;
typedef struct signorini_report signorini_report;
typedef struct signorini_extra signorini_extra;
#define SIGNORINI_LAW_FRICTIONLESS 0
#define SIGNORINI_LAW_COULOMB 1
#define SIGNORINI_LAW_TRESCA 2
#define SIGNORINI_STATE_OPEN 0
#define SIGNORINI_STATE_SLIP 1
#define SIGNORINI_STATE_STICK 2
int32_t signorini_solve(int32_t dim, int64_t pairs, const double *K, int64_t ldk, const double *f,
                        const double *gap, int32_t law, const double *friction, const double *slip0,
                        const signorini_settings *settings, double *d, double *F, int32_t *state,
                        signorini_report *report, const signorini_extra *extra);
const char *signorini_last_error(void);
#define SIGNORINI_STATUS_SOLVED 0
#define SIGNORINI_STATUS_ITERATION_LIMIT 1
#define SIGNORINI_STATUS_TIME_LIMIT 2
#define SIGNORINI_STATUS_CANCELLED 3
#define SIGNORINI_STATUS_NO_EQUILIBRIUM 4
#define SIGNORINI_STATUS_STALLED 5
#define SIGNORINI_STATUS_NOT_A_SOLUTION 6
#define SIGNORINI_STATUS_INTERNAL -1000
#define SIGNORINI_STATUS_OUT_OF_MEMORY -1001
#define SIGNORINI_STATUS_FILE -1002
const char *signorini_status_string(int32_t status);
#define SIGNORINI_TRIANGLE_LOWER 0
#define SIGNORINI_TRIANGLE_UPPER 1
#define SIGNORINI_TRIANGLE_FULL 2
typedef struct signorini_sparse signorini_sparse;
typedef struct signorini_pairs signorini_pairs;
struct signorini_sparse {
    uint32_t struct_size;
    int32_t index_bytes;
    int32_t index_base;
    int32_t triangle;
    int64_t size;
    int64_t nnz;
    const void *col_start;
    const void *row;
    const double *values;
};
struct signorini_pairs {
    uint32_t struct_size;
    int32_t dim;
    int64_t count;
    const int64_t *slaves;
    const int64_t *master_start;
    const int64_t *masters;
    const double *weights;
    const double *normals;
    const double *tangents;
};
typedef struct signorini_model signorini_model;
int32_t signorini_model_new_sparse(const signorini_sparse *K, int64_t n_fixed, const int64_t *fixed,
                                   const signorini_pairs *pairs, signorini_model **model);
int32_t signorini_model_new_condensed(int32_t dim, int64_t pairs, const double *K, int64_t ldk,
                                      signorini_model **model);
int32_t signorini_model_new_two_body(int32_t dim, int64_t pairs, const double *K_A, int64_t lda,
                                     const double *K_B, int64_t ldb, signorini_model **model);
void signorini_model_free(signorini_model *model);
int32_t signorini_model_dim(const signorini_model *model);
int64_t signorini_model_pairs(const signorini_model *model);
int64_t signorini_model_host_size(const signorini_model *model);
int32_t signorini_model_frames(const signorini_model *model, double *frames);
int32_t signorini_model_stiffness(const signorini_model *model, double *K);
int32_t signorini_model_solve(const signorini_model *model, int64_t cases, const double *f,
                              const double *prescribed, const double *gap, int32_t law,
                              const double *friction, const double *slip0,
                              const signorini_settings *settings, double *d, double *F,
                              int32_t *state, int32_t *status, signorini_report *report,
                              const signorini_extra *extra);
int32_t signorini_model_recover(const signorini_model *model, const double *f,
                                const double *prescribed, const double *d, double *u);
int32_t signorini_model_nodal_forces(const signorini_model *model, const double *F, double *nodal);
int32_t signorini_model_condensed_load(const signorini_model *model, const double *f,
                                       const double *prescribed, double *load);
int32_t signorini_model_certify(const signorini_model *model, const double *f,
                                const double *prescribed, const double *gap, int32_t law,
                                const double *friction, const double *slip0, double tolerance,
                                const double *d, double *F, int32_t *state,
                                signorini_report *report);
int32_t signorini_certify(int32_t dim, int64_t pairs, const double *K, int64_t ldk, const double *f,
                          const double *gap, int32_t law, const double *friction,
                          const double *slip0, double tolerance, const double *d, double *F,
                          int32_t *state, signorini_report *report);
int32_t signorini_problem_write(const char *path, int32_t dim, int64_t pairs, const double *K,
                                int64_t ldk, const double *f, const double *gap, int32_t law,
                                const double *friction, const double *slip0, const char *remark);
int32_t signorini_model_write(const signorini_model *model, const char *path, const double *f,
                              const double *prescribed, const double *gap, int32_t law,
                              const double *friction, const double *slip0, const char *remark);
int32_t signorini_lcp_write(const char *path, int64_t n, const double *M, int64_t ldm,
                            const double *q, const double *cover, const char *remark);
#define SIGNORINI_PROBLEM_CONTACT 0
#define SIGNORINI_PROBLEM_LCP 1
typedef struct signorini_problem signorini_problem;
int32_t signorini_problem_read(const char *path, signorini_problem **problem);
void signorini_problem_free(signorini_problem *problem);
int32_t signorini_problem_kind(const signorini_problem *problem);
int32_t signorini_problem_law(const signorini_problem *problem);
int32_t signorini_problem_dim(const signorini_problem *problem);
int64_t signorini_problem_pairs(const signorini_problem *problem);
int64_t signorini_problem_size(const signorini_problem *problem);
const double *signorini_problem_matrix(const signorini_problem *problem);
const double *signorini_problem_rhs(const signorini_problem *problem);
const double *signorini_problem_gap(const signorini_problem *problem);
const double *signorini_problem_friction(const signorini_problem *problem);
const double *signorini_problem_slip0(const signorini_problem *problem);
const double *signorini_problem_cover(const signorini_problem *problem);
const char *signorini_problem_remark(const signorini_problem *problem);
#define SIGNORINI_METHOD_AUTO 0
#define SIGNORINI_METHOD_SOR_NESTED 1
#define SIGNORINI_METHOD_SOR_DIAGONAL 2
#define SIGNORINI_METHOD_LEMKE 3
#define SIGNORINI_METHOD_BLOCK_PIVOTING 4
#define SIGNORINI_METHOD_NEWTON 5
#define SIGNORINI_SEARCH_OFF 0
#define SIGNORINI_SEARCH_OTHERS 1
typedef struct signorini_progress signorini_progress;
struct signorini_progress {
    int64_t iterations;
    double eta;
    double elapsed;
};
typedef int32_t (*signorini_progress_fn)(void *user, const signorini_progress *progress);
struct signorini_settings {
    uint32_t struct_size;
    int32_t method;
    double tolerance;
    double omega;
    double damping;
    int64_t max_iterations;
    double time_limit;
    int32_t warm_start;
    int32_t search;
    signorini_progress_fn progress;
    void *user;
};
int32_t signorini_settings_default(signorini_settings *settings, uint32_t struct_size);
#define SIGNORINI_UNIQUENESS_NOT_KNOWN 0
#define SIGNORINI_UNIQUENESS_UNIQUE 1
#define SIGNORINI_UNIQUENESS_SEVERAL 2
#define SIGNORINI_FALLBACK_NONE 0
#define SIGNORINI_FALLBACK_CYCLE 1
#define SIGNORINI_FALLBACK_SINGULAR 2
#define SIGNORINI_FALLBACK_UNSTABLE 3
#define SIGNORINI_FALLBACK_INACCURATE 4
struct signorini_report {
    uint32_t struct_size;
    int32_t status;
    int32_t method;
    int32_t uniqueness;
    int64_t iterations;
    int64_t outer_iterations;
    int64_t refactorisations;
    double eta;
    double rounding;
    double penetration;
    double tension;
    double cone_excess;
    double equilibrium;
    double omega;
    double damping;
    int64_t pairs_open;
    int64_t pairs_slipping;
    int64_t pairs_sticking;
    int64_t factorisations;
    int32_t first_method;
    int32_t fallback;
    int32_t orientation;
    int32_t second;
};
int32_t signorini_report_default(signorini_report *report, uint32_t struct_size);
struct signorini_extra {
    uint32_t struct_size;
    int32_t reserved;
    double *motion;
    double *second_d;
    double *second_F;
    int32_t *second_state;
};
int32_t signorini_extra_default(signorini_extra *extra, uint32_t struct_size);
int32_t signorini_lcp_solve(int64_t n, const double *M, int64_t ldm, const double *q,
                            const signorini_settings *settings, double *w, double *z, double *y,
                            signorini_report *report);
int32_t signorini_lcp_lemke(int64_t n, const double *M, int64_t ldm, const double *q,
                            const double *cover, const signorini_settings *settings, double *w,
                            double *z, double *y, signorini_report *report);
#define SIGNORINI_VERSION_MAJOR 0
#define SIGNORINI_VERSION_MINOR 2
#define SIGNORINI_VERSION_PATCH 0
#define SIGNORINI_ABI_VERSION 2
const char *signorini_version(void);
int32_t signorini_abi_version(void);

#endif
