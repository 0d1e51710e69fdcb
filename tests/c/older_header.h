/*
 * The declarations of include/ as the first headers of SIGNORINI_ABI_VERSION 3 had them, without what stands behind
 * SIGNORINI_UNSTABLE. A program that was built with it runs with every library of this ABI. It is not to be changed
 * once a version with this ABI is released.
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
#define SIGNORINI_LAW_COHESIVE 3
#define SIGNORINI_LAW_ORTHOTROPIC 4
#define SIGNORINI_LAW_ORTHOTROPIC_COLLINEAR 5
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
#define SIGNORINI_STATUS_NOT_PROVED 7
#define SIGNORINI_STATUS_MEMORY_LIMIT 8
#define SIGNORINI_STATUS_INTERNAL -1000
#define SIGNORINI_STATUS_OUT_OF_MEMORY -1001
#define SIGNORINI_STATUS_FILE -1002
const char *signorini_status_string(int32_t status);
#define SIGNORINI_TRIANGLE_LOWER 0
#define SIGNORINI_TRIANGLE_UPPER 1
#define SIGNORINI_TRIANGLE_FULL 2
typedef struct signorini_sparse signorini_sparse;
typedef struct signorini_pairs signorini_pairs;
typedef struct signorini_model_data signorini_model_data;
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
    const void *order;
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
    const int64_t *row_start;
    const int64_t *row_nodes;
    const double *row_weights;
};
typedef struct signorini_model signorini_model;
int32_t signorini_model_new_sparse(const signorini_sparse *K, int64_t n_fixed, const int64_t *fixed,
                                   const signorini_pairs *pairs, const signorini_settings *settings,
                                   signorini_model **model);
int32_t signorini_model_new_condensed(int32_t dim, int64_t pairs, const double *K, int64_t ldk,
                                      const signorini_settings *settings, signorini_model **model);
int32_t signorini_model_new_two_body(int32_t dim, int64_t pairs, const double *K_A, int64_t lda,
                                     const double *K_B, int64_t ldb,
                                     const signorini_settings *settings, signorini_model **model);
int32_t signorini_model_new_flexibility(int32_t dim, int64_t pairs, const double *W, int64_t ldw,
                                        signorini_model **model);
int32_t signorini_model_new_flexibility_sparse(int32_t dim, int64_t pairs,
                                               const signorini_sparse *W, signorini_model **model);
void signorini_model_free(signorini_model *model);
#define SIGNORINI_MODEL_STIFFNESS 0
#define SIGNORINI_MODEL_FULL_SPACE 1
#define SIGNORINI_MODEL_OPERATOR 2
#define SIGNORINI_MODEL_FLEXIBILITY 3
struct signorini_model_data {
    uint32_t struct_size;
    int32_t dim;
    int64_t pairs;
    int64_t host_size;
    int64_t fixed;
    int64_t memory;
    int32_t kind;
    int32_t dependent;
    const double *K;
    const double *frames;
};
int32_t signorini_model_view(const signorini_model *model, signorini_model_data *data);
int32_t signorini_model_solve(const signorini_model *model, int64_t cases, const double *f,
                              const double *prescribed, const double *gap, int32_t law,
                              const double *friction, const double *slip0,
                              const signorini_settings *settings, double *d, double *F,
                              int32_t *state, int32_t *status, signorini_report *report,
                              const signorini_extra *extra);
int32_t signorini_model_recover(const signorini_model *model, int64_t cases, const double *f,
                                const double *prescribed, const double *d, double *u);
int32_t signorini_model_nodal_forces(const signorini_model *model, const double *F, double *nodal);
int32_t signorini_model_condensed_load(const signorini_model *model, const double *f,
                                       const double *prescribed, double *load);
int32_t signorini_model_certify(const signorini_model *model, const double *f,
                                const double *prescribed, const double *gap, int32_t law,
                                const double *friction, const double *slip0, double tolerance,
                                const double *d, double *F, int32_t *state,
                                signorini_report *report);
#define SIGNORINI_METHOD_AUTO 0
#define SIGNORINI_METHOD_SOR_NESTED 1
#define SIGNORINI_METHOD_SOR_DIAGONAL 2
#define SIGNORINI_METHOD_LEMKE 3
#define SIGNORINI_METHOD_BLOCK_PIVOTING 4
#define SIGNORINI_METHOD_NEWTON 5
#define SIGNORINI_METHOD_PATH 6
#define SIGNORINI_SEARCH_OFF 0
#define SIGNORINI_SEARCH_OTHERS 1
typedef struct signorini_progress signorini_progress;
struct signorini_progress {
    int64_t iterations;
    double eta;
    double elapsed;
    double reduced;
    int64_t memory;
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
    int32_t proof;
    int32_t reserved;
    int64_t memory_limit;
    int32_t full_space;
    int32_t threads;
};
int32_t signorini_settings_default(signorini_settings *settings, uint32_t struct_size);
int64_t signorini_solve_memory(int64_t n);
#define SIGNORINI_UNIQUENESS_NOT_KNOWN 0
#define SIGNORINI_UNIQUENESS_UNIQUE 1
#define SIGNORINI_UNIQUENESS_SEVERAL 2
#define SIGNORINI_PROOF_NOT_ASKED 0
#define SIGNORINI_PROOF_PROVED 1
#define SIGNORINI_PROOF_NOT_PROVED 2
#define SIGNORINI_FALLBACK_NONE 0
#define SIGNORINI_FALLBACK_CYCLE 1
#define SIGNORINI_FALLBACK_SINGULAR 2
#define SIGNORINI_FALLBACK_UNSTABLE 3
#define SIGNORINI_FALLBACK_INACCURATE 4
#define SIGNORINI_REMARK_GAPS_NEGATIVE 1
#define SIGNORINI_REMARK_FRICTION_LARGE 2
#define SIGNORINI_REMARK_FREE_MOTION 4
const char *signorini_remark_string(int32_t remark);
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
    double error_d;
    double error_F;
    int32_t proof;
    int32_t remarks;
};
int32_t signorini_report_default(signorini_report *report, uint32_t struct_size);
struct signorini_extra {
    uint32_t struct_size;
    int32_t reserved;
    double *motion;
    double *second_d;
    double *second_F;
    int32_t *second_state;
    double *radius_d;
    double *radius_F;
    double *escape;
};
int32_t signorini_extra_default(signorini_extra *extra, uint32_t struct_size);
int32_t signorini_lcp_solve(int64_t n, const double *M, int64_t ldm, const double *q,
                            const double *cover, const signorini_settings *settings, double *w,
                            double *z, double *y, signorini_report *report);
#define SIGNORINI_VERSION_MAJOR 0
#define SIGNORINI_VERSION_MINOR 2
#define SIGNORINI_VERSION_PATCH 0
#define SIGNORINI_ABI_VERSION 3
const char *signorini_version(void);
int32_t signorini_abi_version(void);
#define SIGNORINI_PAIRING_DUAL_MORTAR 0
#define SIGNORINI_PAIRING_NODE_TO_SURFACE 1
#define SIGNORINI_OBSTACLE_PLANE 0
#define SIGNORINI_OBSTACLE_CYLINDER 1
#define SIGNORINI_OBSTACLE_SPHERE 2
#define SIGNORINI_OBSTACLE_FACES 3
typedef struct signorini_faces signorini_faces;
typedef struct signorini_obstacle signorini_obstacle;
typedef struct signorini_surface_settings signorini_surface_settings;
typedef struct signorini_surface_data signorini_surface_data;
struct signorini_faces {
    uint32_t struct_size;
    int32_t face_nodes;
    int64_t count;
    const int64_t *start;
    const int64_t *nodes;
};
struct signorini_obstacle {
    uint32_t struct_size;
    int32_t kind;
    double point[3];
    double direction[3];
    double radius;
    int32_t hollow;
    int32_t reserved;
    int64_t nodes;
    const double *coordinates;
    const signorini_faces *faces;
};
struct signorini_surface_settings {
    uint32_t struct_size;
    int32_t pairing;
    double search_distance;
    int32_t index_base;
    int32_t dofs_per_node;
    const int64_t *node_dofs;
    int64_t symmetry_planes;
    const int32_t *symmetry_axes;
    const double *symmetry_at;
    int32_t normals;
    int32_t rims;
};
int32_t signorini_surface_settings_default(signorini_surface_settings *settings,
                                           uint32_t struct_size);
typedef struct signorini_surface_pairs signorini_surface_pairs;
int32_t signorini_surface_pair(int32_t dim, int64_t nodes, const double *coordinates,
                               const signorini_faces *slave, const signorini_faces *master,
                               const signorini_surface_settings *settings,
                               signorini_surface_pairs **contact);
int32_t signorini_surface_pair_obstacle(int32_t dim, int64_t nodes, const double *coordinates,
                                        const signorini_faces *slave,
                                        const signorini_obstacle *obstacle,
                                        const signorini_surface_settings *settings,
                                        signorini_surface_pairs **contact);
void signorini_surface_free(signorini_surface_pairs *contact);
struct signorini_surface_data {
    uint32_t struct_size;
    int32_t dim;
    int64_t pairs;
    const signorini_pairs *rows;
    const double *gaps;
    const double *areas;
    const double *normals;
    const double *tangents;
    const double *points;
    const int64_t *nodes;
    int64_t n_unpaired;
    const int64_t *unpaired;
    int64_t n_folded;
    const int64_t *folded;
    int64_t n_uncovered;
    const int64_t *uncovered;
    const char *summary;
    int64_t slave_faces;
    double slave_area;
    double covered_area;
    double search_distance;
    int64_t not_opposed;
    int64_t boxes_searched;
    int64_t on_symmetry;
    int64_t n_beyond;
};
int32_t signorini_surface_view(const signorini_surface_pairs *contact,
                               signorini_surface_data *data);
typedef struct signorini_contact_fields signorini_contact_fields;
typedef struct signorini_resultant signorini_resultant;
typedef struct signorini_mesh signorini_mesh;
typedef struct signorini_zone signorini_zone;
typedef struct signorini_field signorini_field;
struct signorini_contact_fields {
    uint32_t struct_size;
    int32_t reserved;
    double *pressure;
    double *traction;
    double *clearance;
    double *slip;
    int32_t *state;
};
struct signorini_resultant {
    uint32_t struct_size;
    int32_t reserved;
    double force[3];
    double moment[3];
    double friction_work;
    double pressed_area;
};
int32_t signorini_surface_fields(const signorini_surface_pairs *contact, const double *gap,
                                 const double *slip0, const double *d, const double *F,
                                 const int32_t *state, const signorini_contact_fields *fields);
int32_t signorini_surface_resultant(const signorini_surface_pairs *contact, const double *slip0,
                                    const double *d, const double *F, const double *point,
                                    signorini_resultant *resultant);
struct signorini_mesh {
    uint32_t struct_size;
    int32_t dim;
    int64_t nodes;
    const double *coordinates;
    int64_t cells;
    int32_t index_base;
    int32_t cell_type;
    const int32_t *cell_types;
    const int64_t *cell_start;
    const int64_t *cell_nodes;
};
struct signorini_zone {
    uint32_t struct_size;
    int32_t reserved;
    const signorini_surface_pairs *contact;
    const double *gap;
    const double *slip0;
    const double *d;
    const double *F;
    const int32_t *state;
};
struct signorini_field {
    uint32_t struct_size;
    int32_t components;
    const char *name;
    const double *values;
};
int32_t signorini_mesh_write(const char *path, const signorini_mesh *mesh, const double *u,
                             int64_t n_zones, const signorini_zone *zones, int64_t n_fields,
                             const signorini_field *fields);
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
typedef struct signorini_problem_data signorini_problem_data;
typedef struct signorini_problem signorini_problem;
int32_t signorini_problem_read(const char *path, signorini_problem **problem);
void signorini_problem_free(signorini_problem *problem);
struct signorini_problem_data {
    uint32_t struct_size;
    int32_t kind;
    int32_t law;
    int32_t dim;
    int64_t pairs;
    int64_t size;
    const double *matrix;
    const double *rhs;
    const double *gap;
    const double *friction;
    const double *slip0;
    const double *cover;
    const char *remark;
};
int32_t signorini_problem_view(const signorini_problem *problem, signorini_problem_data *data);

#endif
