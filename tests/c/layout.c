/*
 * The binary interface, number by number: the structures of SIGNORINI_ABI_VERSION 3 and the
 * constants. A number that changes here breaks programs that are already built.
 */

#include "check.h"

#include <stddef.h>

#define SIZE(type, bytes) _Static_assert(sizeof(type) == (bytes), "size of " #type)
#define FIELD(type, field, ctype, bytes)                                                          \
    _Static_assert(offsetof(type, field) == (bytes) && sizeof((type *)0)->field == sizeof(ctype), \
                   "place of " #type "." #field)
#define VALUE(constant, number) _Static_assert((constant) == (number), "value of " #constant)

VALUE(SIGNORINI_ABI_VERSION, 3);

VALUE(SIGNORINI_STATUS_SOLVED, 0);
VALUE(SIGNORINI_STATUS_ITERATION_LIMIT, 1);
VALUE(SIGNORINI_STATUS_TIME_LIMIT, 2);
VALUE(SIGNORINI_STATUS_CANCELLED, 3);
VALUE(SIGNORINI_STATUS_NO_EQUILIBRIUM, 4);
VALUE(SIGNORINI_STATUS_STALLED, 5);
VALUE(SIGNORINI_STATUS_NOT_A_SOLUTION, 6);
VALUE(SIGNORINI_STATUS_NOT_PROVED, 7);
VALUE(SIGNORINI_STATUS_MEMORY_LIMIT, 8);
VALUE(SIGNORINI_STATUS_INTERNAL, -1000);
VALUE(SIGNORINI_STATUS_OUT_OF_MEMORY, -1001);
VALUE(SIGNORINI_STATUS_FILE, -1002);
VALUE(SIGNORINI_LAW_FRICTIONLESS, 0);
VALUE(SIGNORINI_LAW_COULOMB, 1);
VALUE(SIGNORINI_LAW_TRESCA, 2);
VALUE(SIGNORINI_LAW_COHESIVE, 3);
VALUE(SIGNORINI_LAW_ORTHOTROPIC, 4);
VALUE(SIGNORINI_LAW_ORTHOTROPIC_COLLINEAR, 5);
VALUE(SIGNORINI_LAW_BY_PAIR, 6);
VALUE(SIGNORINI_LAW_TIED, 7);
VALUE(SIGNORINI_MODEL_STIFFNESS, 0);
VALUE(SIGNORINI_MODEL_FULL_SPACE, 1);
VALUE(SIGNORINI_MODEL_OPERATOR, 2);
VALUE(SIGNORINI_MODEL_FLEXIBILITY, 3);
VALUE(SIGNORINI_PROBLEM_CONTACT, 0);
VALUE(SIGNORINI_PROBLEM_LCP, 1);
VALUE(SIGNORINI_METHOD_AUTO, 0);
VALUE(SIGNORINI_METHOD_SOR_NESTED, 1);
VALUE(SIGNORINI_METHOD_SOR_DIAGONAL, 2);
VALUE(SIGNORINI_METHOD_LEMKE, 3);
VALUE(SIGNORINI_METHOD_BLOCK_PIVOTING, 4);
VALUE(SIGNORINI_METHOD_NEWTON, 5);
VALUE(SIGNORINI_METHOD_PATH, 6);
VALUE(SIGNORINI_START_PREVIOUS, 2);
VALUE(SIGNORINI_SEARCH_OFF, 0);
VALUE(SIGNORINI_SEARCH_OTHERS, 1);
VALUE(SIGNORINI_STATE_OPEN, 0);
VALUE(SIGNORINI_STATE_SLIP, 1);
VALUE(SIGNORINI_STATE_STICK, 2);
VALUE(SIGNORINI_UNIQUENESS_NOT_KNOWN, 0);
VALUE(SIGNORINI_UNIQUENESS_UNIQUE, 1);
VALUE(SIGNORINI_UNIQUENESS_SEVERAL, 2);
VALUE(SIGNORINI_PROOF_NOT_ASKED, 0);
VALUE(SIGNORINI_PROOF_PROVED, 1);
VALUE(SIGNORINI_PROOF_NOT_PROVED, 2);
VALUE(SIGNORINI_FALLBACK_NONE, 0);
VALUE(SIGNORINI_FALLBACK_CYCLE, 1);
VALUE(SIGNORINI_FALLBACK_SINGULAR, 2);
VALUE(SIGNORINI_FALLBACK_UNSTABLE, 3);
VALUE(SIGNORINI_FALLBACK_INACCURATE, 4);
VALUE(SIGNORINI_REMARK_GAPS_NEGATIVE, 1);
VALUE(SIGNORINI_REMARK_FRICTION_LARGE, 2);
VALUE(SIGNORINI_REMARK_FREE_MOTION, 4);
VALUE(SIGNORINI_REMARK_HELD_BY_ROUNDING, 8);
VALUE(SIGNORINI_REMARK_NEEDS_LOW_PART, 16);
VALUE(SIGNORINI_REMARK_GAPS_PASSED, 32);
VALUE(SIGNORINI_TRIANGLE_LOWER, 0);
VALUE(SIGNORINI_TRIANGLE_UPPER, 1);
VALUE(SIGNORINI_TRIANGLE_FULL, 2);
VALUE(SIGNORINI_PAIRING_DUAL_MORTAR, 0);
VALUE(SIGNORINI_PAIRING_NODE_TO_SURFACE, 1);
VALUE(SIGNORINI_NORMALS_AVERAGED, 0);
VALUE(SIGNORINI_NORMALS_FACES, 1);
VALUE(SIGNORINI_RIMS_FOLD, 0);
VALUE(SIGNORINI_RIMS_KEEP, 1);
VALUE(SIGNORINI_RIMS_FOLD_LITTLE, 2);
VALUE(SIGNORINI_OBSTACLE_PLANE, 0);
VALUE(SIGNORINI_OBSTACLE_CYLINDER, 1);
VALUE(SIGNORINI_OBSTACLE_SPHERE, 2);
VALUE(SIGNORINI_OBSTACLE_CONE, 4);
VALUE(SIGNORINI_OBSTACLE_TORUS, 5);
VALUE(SIGNORINI_OBSTACLE_FACES, 3);

/* 64-bit pointers, doubles and 64-bit integers aligned to their size. */
#if defined __LP64__ || defined _WIN64

SIZE(signorini_progress, 40);
FIELD(signorini_progress, iterations, int64_t, 0);
FIELD(signorini_progress, eta, double, 8);
FIELD(signorini_progress, elapsed, double, 16);
FIELD(signorini_progress, reduced, double, 24);
FIELD(signorini_progress, memory, int64_t, 32);

SIZE(signorini_settings, 96);
FIELD(signorini_settings, struct_size, uint32_t, 0);
FIELD(signorini_settings, method, int32_t, 4);
FIELD(signorini_settings, tolerance, double, 8);
FIELD(signorini_settings, omega, double, 16);
FIELD(signorini_settings, damping, double, 24);
FIELD(signorini_settings, max_iterations, int64_t, 32);
FIELD(signorini_settings, time_limit, double, 40);
FIELD(signorini_settings, warm_start, int32_t, 48);
FIELD(signorini_settings, search, int32_t, 52);
FIELD(signorini_settings, progress, signorini_progress_fn, 56);
FIELD(signorini_settings, user, void *, 64);
FIELD(signorini_settings, proof, int32_t, 72);
FIELD(signorini_settings, reserved, int32_t, 76);
FIELD(signorini_settings, memory_limit, int64_t, 80);
FIELD(signorini_settings, full_space, int32_t, 88);
FIELD(signorini_settings, threads, int32_t, 92);

SIZE(signorini_report, 176);
FIELD(signorini_report, struct_size, uint32_t, 0);
FIELD(signorini_report, status, int32_t, 4);
FIELD(signorini_report, method, int32_t, 8);
FIELD(signorini_report, uniqueness, int32_t, 12);
FIELD(signorini_report, iterations, int64_t, 16);
FIELD(signorini_report, outer_iterations, int64_t, 24);
FIELD(signorini_report, refactorisations, int64_t, 32);
FIELD(signorini_report, eta, double, 40);
FIELD(signorini_report, rounding, double, 48);
FIELD(signorini_report, penetration, double, 56);
FIELD(signorini_report, tension, double, 64);
FIELD(signorini_report, cone_excess, double, 72);
FIELD(signorini_report, equilibrium, double, 80);
FIELD(signorini_report, omega, double, 88);
FIELD(signorini_report, damping, double, 96);
FIELD(signorini_report, pairs_open, int64_t, 104);
FIELD(signorini_report, pairs_slipping, int64_t, 112);
FIELD(signorini_report, pairs_sticking, int64_t, 120);
FIELD(signorini_report, factorisations, int64_t, 128);
FIELD(signorini_report, first_method, int32_t, 136);
FIELD(signorini_report, fallback, int32_t, 140);
FIELD(signorini_report, orientation, int32_t, 144);
FIELD(signorini_report, second, int32_t, 148);
FIELD(signorini_report, error_d, double, 152);
FIELD(signorini_report, error_F, double, 160);
FIELD(signorini_report, proof, int32_t, 168);
FIELD(signorini_report, remarks, int32_t, 172);

SIZE(signorini_sparse, 64);
FIELD(signorini_sparse, struct_size, uint32_t, 0);
FIELD(signorini_sparse, index_bytes, int32_t, 4);
FIELD(signorini_sparse, index_base, int32_t, 8);
FIELD(signorini_sparse, triangle, int32_t, 12);
FIELD(signorini_sparse, size, int64_t, 16);
FIELD(signorini_sparse, nnz, int64_t, 24);
FIELD(signorini_sparse, col_start, void *, 32);
FIELD(signorini_sparse, row, void *, 40);
FIELD(signorini_sparse, values, double *, 48);
FIELD(signorini_sparse, order, void *, 56);

SIZE(signorini_pairs, 104);
FIELD(signorini_pairs, struct_size, uint32_t, 0);
FIELD(signorini_pairs, dim, int32_t, 4);
FIELD(signorini_pairs, count, int64_t, 8);
FIELD(signorini_pairs, slaves, int64_t *, 16);
FIELD(signorini_pairs, master_start, int64_t *, 24);
FIELD(signorini_pairs, masters, int64_t *, 32);
FIELD(signorini_pairs, weights, double *, 40);
FIELD(signorini_pairs, normals, double *, 48);
FIELD(signorini_pairs, tangents, double *, 56);
FIELD(signorini_pairs, row_start, int64_t *, 64);
FIELD(signorini_pairs, row_nodes, int64_t *, 72);
FIELD(signorini_pairs, row_weights, double *, 80);
FIELD(signorini_pairs, row_vectors, double *, 88);
FIELD(signorini_pairs, equations, signorini_equations *, 96);

SIZE(signorini_equations, 48);
FIELD(signorini_equations, struct_size, uint32_t, 0);
FIELD(signorini_equations, reserved, int32_t, 4);
FIELD(signorini_equations, count, int64_t, 8);
FIELD(signorini_equations, dependent, int64_t *, 16);
FIELD(signorini_equations, start, int64_t *, 24);
FIELD(signorini_equations, dofs, int64_t *, 32);
FIELD(signorini_equations, coefficients, double *, 40);

SIZE(signorini_extra, 72);
FIELD(signorini_extra, struct_size, uint32_t, 0);
FIELD(signorini_extra, reserved, int32_t, 4);
FIELD(signorini_extra, motion, double *, 8);
FIELD(signorini_extra, second_d, double *, 16);
FIELD(signorini_extra, second_F, double *, 24);
FIELD(signorini_extra, second_state, int32_t *, 32);
FIELD(signorini_extra, radius_d, double *, 40);
FIELD(signorini_extra, radius_F, double *, 48);
FIELD(signorini_extra, escape, double *, 56);
FIELD(signorini_extra, d_low, double *, 64);

SIZE(signorini_faces, 32);
FIELD(signorini_faces, struct_size, uint32_t, 0);
FIELD(signorini_faces, face_nodes, int32_t, 4);
FIELD(signorini_faces, count, int64_t, 8);
FIELD(signorini_faces, start, int64_t *, 16);
FIELD(signorini_faces, nodes, int64_t *, 24);

SIZE(signorini_obstacle, 96);
FIELD(signorini_obstacle, struct_size, uint32_t, 0);
FIELD(signorini_obstacle, kind, int32_t, 4);
FIELD(signorini_obstacle, point, double[3], 8);
FIELD(signorini_obstacle, direction, double[3], 32);
FIELD(signorini_obstacle, radius, double, 56);
FIELD(signorini_obstacle, hollow, int32_t, 64);
FIELD(signorini_obstacle, reserved, int32_t, 68);
FIELD(signorini_obstacle, nodes, int64_t, 72);
FIELD(signorini_obstacle, coordinates, double *, 80);
FIELD(signorini_obstacle, faces, signorini_faces *, 88);

SIZE(signorini_operator, 88);
FIELD(signorini_operator, struct_size, uint32_t, 0);
FIELD(signorini_operator, dim, int32_t, 4);
FIELD(signorini_operator, pairs, int64_t, 8);
FIELD(signorini_operator, stiffness, signorini_product_fn, 16);
FIELD(signorini_operator, inverse, signorini_product_fn, 24);
FIELD(signorini_operator, held, signorini_held_fn, 32);
FIELD(signorini_operator, units, double *, 40);
FIELD(signorini_operator, user, void *, 48);
FIELD(signorini_operator, unknowns, int64_t, 56);
FIELD(signorini_operator, place, int64_t *, 64);
FIELD(signorini_operator, precondition, signorini_precondition_fn, 72);
FIELD(signorini_operator, accuracy, double, 80);
SIZE(signorini_surface_settings, 256);
FIELD(signorini_surface_settings, struct_size, uint32_t, 0);
FIELD(signorini_surface_settings, pairing, int32_t, 4);
FIELD(signorini_surface_settings, search_distance, double, 8);
FIELD(signorini_surface_settings, index_base, int32_t, 16);
FIELD(signorini_surface_settings, dofs_per_node, int32_t, 20);
FIELD(signorini_surface_settings, node_dofs, int64_t *, 24);
FIELD(signorini_surface_settings, symmetry_planes, int64_t, 32);
FIELD(signorini_surface_settings, symmetry_axes, int32_t *, 40);
FIELD(signorini_surface_settings, symmetry_at, double *, 48);
FIELD(signorini_surface_settings, normals, int32_t, 56);
FIELD(signorini_surface_settings, rims, int32_t, 60);
FIELD(signorini_surface_settings, axisymmetric, int32_t, 64);
FIELD(signorini_surface_settings, fitted, int32_t, 68);
FIELD(signorini_surface_settings, time_limit, double, 72);
FIELD(signorini_surface_settings, progress, signorini_progress_fn, 80);
FIELD(signorini_surface_settings, user, void *, 88);
FIELD(signorini_surface_settings, slave_shape, signorini_obstacle *, 96);
FIELD(signorini_surface_settings, master_shape, signorini_obstacle *, 104);
FIELD(signorini_surface_settings, close_within, double, 112);
FIELD(signorini_surface_settings, clearance, double, 120);
FIELD(signorini_surface_settings, symmetry_normals, const double *, 128);
FIELD(signorini_surface_settings, sectors, int64_t, 136);
FIELD(signorini_surface_settings, sector_point, const double *, 144);
FIELD(signorini_surface_settings, sector_axis, const double *, 152);
FIELD(signorini_surface_settings, tangent, double[3], 160);
FIELD(signorini_surface_settings, period, double[3], 184);
FIELD(signorini_surface_settings, second_period, double[3], 208);
FIELD(signorini_surface_settings, keep_turns, int32_t, 232);
FIELD(signorini_surface_settings, reserved, int32_t, 236);
FIELD(signorini_surface_settings, n_fixed, int64_t, 240);
FIELD(signorini_surface_settings, fixed, const int64_t *, 248);

SIZE(signorini_surface_data, 240);
FIELD(signorini_surface_data, struct_size, uint32_t, 0);
FIELD(signorini_surface_data, dim, int32_t, 4);
FIELD(signorini_surface_data, pairs, int64_t, 8);
FIELD(signorini_surface_data, rows, const signorini_pairs *, 16);
FIELD(signorini_surface_data, gaps, const double *, 24);
FIELD(signorini_surface_data, areas, const double *, 32);
FIELD(signorini_surface_data, normals, const double *, 40);
FIELD(signorini_surface_data, tangents, const double *, 48);
FIELD(signorini_surface_data, points, const double *, 56);
FIELD(signorini_surface_data, nodes, const int64_t *, 64);
FIELD(signorini_surface_data, n_unpaired, int64_t, 72);
FIELD(signorini_surface_data, unpaired, const int64_t *, 80);
FIELD(signorini_surface_data, n_folded, int64_t, 88);
FIELD(signorini_surface_data, folded, const int64_t *, 96);
FIELD(signorini_surface_data, n_uncovered, int64_t, 104);
FIELD(signorini_surface_data, uncovered, const int64_t *, 112);
FIELD(signorini_surface_data, summary, const char *, 120);
FIELD(signorini_surface_data, slave_faces, int64_t, 128);
FIELD(signorini_surface_data, slave_area, double, 136);
FIELD(signorini_surface_data, covered_area, double, 144);
FIELD(signorini_surface_data, search_distance, double, 152);
FIELD(signorini_surface_data, not_opposed, int64_t, 160);
FIELD(signorini_surface_data, boxes_searched, int64_t, 168);
FIELD(signorini_surface_data, on_symmetry, int64_t, 176);
FIELD(signorini_surface_data, n_beyond, int64_t, 184);
FIELD(signorini_surface_data, beyond, const int64_t *, 192);
FIELD(signorini_surface_data, beyond_distances, const double *, 200);
FIELD(signorini_surface_data, folded_distances, const double *, 208);
FIELD(signorini_surface_data, n_zones, int64_t, 216);
FIELD(signorini_surface_data, zone_start, const int64_t *, 224);
FIELD(signorini_surface_data, friction, const double *, 232);

SIZE(signorini_contact_zone, 32);
FIELD(signorini_contact_zone, struct_size, uint32_t, 0);
FIELD(signorini_contact_zone, law, int32_t, 4);
FIELD(signorini_contact_zone, contact, const signorini_surface_pairs *, 8);
FIELD(signorini_contact_zone, name, const char *, 16);
FIELD(signorini_contact_zone, friction, const double *, 24);

SIZE(signorini_zone, 56);
FIELD(signorini_zone, struct_size, uint32_t, 0);
FIELD(signorini_zone, reserved, int32_t, 4);
FIELD(signorini_zone, contact, const signorini_surface_pairs *, 8);
FIELD(signorini_zone, gap, const double *, 16);
FIELD(signorini_zone, slip0, const double *, 24);
FIELD(signorini_zone, d, const double *, 32);
FIELD(signorini_zone, F, const double *, 40);
FIELD(signorini_zone, state, const int32_t *, 48);

SIZE(signorini_model_data, 64);
FIELD(signorini_model_data, struct_size, uint32_t, 0);
FIELD(signorini_model_data, dim, int32_t, 4);
FIELD(signorini_model_data, pairs, int64_t, 8);
FIELD(signorini_model_data, host_size, int64_t, 16);
FIELD(signorini_model_data, fixed, int64_t, 24);
FIELD(signorini_model_data, memory, int64_t, 32);
FIELD(signorini_model_data, kind, int32_t, 40);
FIELD(signorini_model_data, dependent, int32_t, 44);
FIELD(signorini_model_data, K, const double *, 48);
FIELD(signorini_model_data, frames, const double *, 56);

SIZE(signorini_problem_data, 88);
FIELD(signorini_problem_data, struct_size, uint32_t, 0);
FIELD(signorini_problem_data, kind, int32_t, 4);
FIELD(signorini_problem_data, law, int32_t, 8);
FIELD(signorini_problem_data, dim, int32_t, 12);
FIELD(signorini_problem_data, pairs, int64_t, 16);
FIELD(signorini_problem_data, size, int64_t, 24);
FIELD(signorini_problem_data, matrix, const double *, 32);
FIELD(signorini_problem_data, rhs, const double *, 40);
FIELD(signorini_problem_data, gap, const double *, 48);
FIELD(signorini_problem_data, friction, const double *, 56);
FIELD(signorini_problem_data, slip0, const double *, 64);
FIELD(signorini_problem_data, cover, const double *, 72);
FIELD(signorini_problem_data, remark, const char *, 80);

SIZE(signorini_contact_fields, 48);
FIELD(signorini_contact_fields, struct_size, uint32_t, 0);
FIELD(signorini_contact_fields, reserved, int32_t, 4);
FIELD(signorini_contact_fields, pressure, double *, 8);
FIELD(signorini_contact_fields, traction, double *, 16);
FIELD(signorini_contact_fields, clearance, double *, 24);
FIELD(signorini_contact_fields, slip, double *, 32);
FIELD(signorini_contact_fields, state, int32_t *, 40);

SIZE(signorini_resultant, 72);
FIELD(signorini_resultant, struct_size, uint32_t, 0);
FIELD(signorini_resultant, reserved, int32_t, 4);
FIELD(signorini_resultant, force, double[3], 8);
FIELD(signorini_resultant, moment, double[3], 32);
FIELD(signorini_resultant, friction_work, double, 56);
FIELD(signorini_resultant, pressed_area, double, 64);

SIZE(signorini_penetration, 72);
FIELD(signorini_penetration, struct_size, uint32_t, 0);
FIELD(signorini_penetration, points, int32_t, 4);
FIELD(signorini_penetration, depth, double, 8);
FIELD(signorini_penetration, point, double[3], 16);
FIELD(signorini_penetration, face, int64_t, 40);
FIELD(signorini_penetration, node, int64_t, 48);
FIELD(signorini_penetration, master_face, int64_t, 56);
FIELD(signorini_penetration, zone, int64_t, 64);

SIZE(signorini_mesh, 64);
FIELD(signorini_mesh, struct_size, uint32_t, 0);
FIELD(signorini_mesh, dim, int32_t, 4);
FIELD(signorini_mesh, nodes, int64_t, 8);
FIELD(signorini_mesh, coordinates, double *, 16);
FIELD(signorini_mesh, cells, int64_t, 24);
FIELD(signorini_mesh, index_base, int32_t, 32);
FIELD(signorini_mesh, cell_type, int32_t, 36);
FIELD(signorini_mesh, cell_types, int32_t *, 40);
FIELD(signorini_mesh, cell_start, int64_t *, 48);
FIELD(signorini_mesh, cell_nodes, int64_t *, 56);

SIZE(signorini_field, 24);
FIELD(signorini_field, struct_size, uint32_t, 0);
FIELD(signorini_field, components, int32_t, 4);
FIELD(signorini_field, name, char *, 8);
FIELD(signorini_field, values, double *, 16);

#endif

/* The library has the same structures: each default and each measure arrives in its field. */
int main(void)
{
    signorini_settings settings;
    memset(&settings, 0xFF, sizeof settings);
    CHECK(signorini_abi_version() == SIGNORINI_ABI_VERSION);
    CHECK_STATUS(signorini_settings_default(&settings, sizeof settings), 0);
    CHECK(settings.struct_size == sizeof settings);
    CHECK(settings.method == SIGNORINI_METHOD_AUTO);
    CHECK(settings.tolerance == 1e-10);
    CHECK(settings.omega == 0);
    CHECK(settings.damping == 0);
    CHECK(settings.max_iterations == 200000);
    CHECK(settings.time_limit == 0);
    CHECK(settings.warm_start == 0);
    CHECK(settings.search == SIGNORINI_SEARCH_OFF);
    CHECK(settings.progress == NULL);
    CHECK(settings.user == NULL);
    CHECK(settings.proof == 0 && settings.reserved == 0);
    CHECK(settings.full_space == 0 && settings.threads == 1);
    signorini_extra extra;
    memset(&extra, 0xFF, sizeof extra);
    CHECK_STATUS(signorini_extra_default(&extra, sizeof extra), 0);
    CHECK(extra.struct_size == sizeof extra && extra.reserved == 0 && extra.motion == NULL);
    CHECK(extra.radius_d == NULL && extra.radius_F == NULL);
    CHECK(extra.second_d == NULL && extra.second_F == NULL && extra.second_state == NULL);
    CHECK(extra.escape == NULL);
    CHECK(extra.d_low == NULL);
    signorini_report blank, zeros = {.struct_size = sizeof zeros};
    memset(&blank, 0xFF, sizeof blank);
    CHECK_STATUS(signorini_report_default(&blank, sizeof blank), 0);
    CHECK(memcmp(&blank, &zeros, sizeof blank) == 0);

    /* One pair slips by 1 and one is open, in one sweep with factor 1. */
    const double K[16] = {5, [5] = 3, [10] = 1, [15] = 1}, f[4] = {10, 8, -1, 0};
    const double gap[2] = {0, 0}, mu[2] = {0.5, 0.5};
    double d[4], F[4];
    signorini_report report;
    memset(&report, 0xFF, sizeof report);
    report.struct_size = sizeof report;
    settings.method = SIGNORINI_METHOD_SOR_NESTED;
    settings.omega = 1;
    settings.damping = 0.75;
    settings.tolerance = 1e-12;
    CHECK_STATUS(signorini_solve(2, 2, K, 4, f, gap, SIGNORINI_LAW_COULOMB, mu, NULL, &settings, d,
                                 F, NULL, &report, NULL), 0);
    CHECK(report.struct_size == sizeof report && report.status == 0 && report.second == 0);
    CHECK(report.method == SIGNORINI_METHOD_SOR_NESTED);
    CHECK(report.iterations >= 1 && report.iterations <= 1000);
    CHECK(report.outer_iterations >= 1 && report.outer_iterations <= report.iterations);
    CHECK(report.refactorisations == 0);
    CHECK(report.eta >= 0 && report.eta <= 1e-12);
    CHECK(report.rounding > 0 && report.rounding < 1e-15);
    CHECK(report.penetration == 0 && report.tension == 0);
    CHECK(report.cone_excess >= 0 && report.cone_excess < 1e-10);
    CHECK(report.equilibrium >= 0 && report.equilibrium < 1e-10);
    CHECK(report.omega == 1 && report.damping == 0.75);
    CHECK(report.pairs_open == 1 && report.pairs_slipping == 1 && report.pairs_sticking == 0);
    CHECK(report.factorisations == 0);
    CHECK(report.first_method == SIGNORINI_METHOD_SOR_NESTED);
    CHECK(report.fallback == SIGNORINI_FALLBACK_NONE);
    CHECK(report.uniqueness == SIGNORINI_UNIQUENESS_NOT_KNOWN && report.orientation == 0);
    CHECK(report.proof == SIGNORINI_PROOF_NOT_ASKED && report.remarks == 0);
    CHECK(report.error_d >= -1 && report.error_d < 1e-12 && report.error_F < 1e-12);

    /* Once more with a proof, by settings and extra of this size, and by a report of the size before. */
    double radius_d[4], radius_F[4];
    extra.radius_d = radius_d;
    extra.radius_F = radius_F;
    settings.proof = 1;
    CHECK_STATUS(signorini_solve(2, 2, K, 4, f, gap, SIGNORINI_LAW_COULOMB, mu, NULL, &settings, d,
                                 F, NULL, &report, &extra), 0);
    CHECK(report.proof == SIGNORINI_PROOF_PROVED);
    CHECK(report.error_d >= 0 && report.error_d < 1e-14 && report.error_F < 1e-14);
    /* Pressed by 10 and pushed by 8, held by 5 of friction: d_t = 3 / 3. */
    CHECK(d[1] - radius_d[1] <= 1 && d[1] + radius_d[1] >= 1 && radius_d[1] < 1e-14);
    CHECK(F[1] - radius_F[1] <= -5 && F[1] + radius_F[1] >= -5 && radius_F[1] < 1e-14);
    memset(&report, 0xFF, sizeof report);
    report.struct_size = offsetof(signorini_report, error_d);
    settings.struct_size = offsetof(signorini_settings, proof);
    CHECK_STATUS(signorini_solve(2, 2, K, 4, f, gap, SIGNORINI_LAW_COULOMB, mu, NULL, &settings, d,
                                 F, NULL, &report, &extra), 0);
    CHECK(report.second == 0 && report.proof == -1 && radius_d[0] == -1 && radius_F[3] == -1);
    settings.struct_size = sizeof settings;
    settings.proof = 0;

    /* Displacements of another solver, with these states and with one of them turned. */
    int32_t state[2] = {SIGNORINI_STATE_SLIP, SIGNORINI_STATE_OPEN};
    const double other[4] = {0, 1.001, -1, 0};
    CHECK_STATUS(prove_condensed(2, 2, K, 4, f, gap, SIGNORINI_LAW_COULOMB, mu, NULL, other, state,
                                 F, radius_d, radius_F), 0);
    CHECK(radius_d[1] > 0.000999 && radius_d[1] < 0.001001 && F[1] > -5.000001 && F[1] < -4.999999);
    CHECK_STATUS(prove_condensed(2, 2, K, 4, f, gap, SIGNORINI_LAW_COULOMB, mu, NULL, other, NULL,
                                 NULL, NULL, NULL), 0);
    state[0] = SIGNORINI_STATE_STICK;
    CHECK_STATUS(prove_condensed(2, 2, K, 4, f, gap, SIGNORINI_LAW_COULOMB, mu, NULL, other, state,
                                 F, radius_d, radius_F), SIGNORINI_STATUS_NOT_PROVED);
    CHECK(radius_d[1] == -1 && radius_F[1] == -1 && F[1] == 0);
    state[0] = 3;
    CHECK_STATUS(prove_condensed(2, 2, K, 4, f, gap, SIGNORINI_LAW_COULOMB, mu, NULL, other, state,
                                 F, radius_d, radius_F), -9);

    /* By Newton's method; without coupling every determinant is a product of positive entries. */
    memset(&report, 0xFF, sizeof report);
    report.struct_size = sizeof report;
    settings.method = SIGNORINI_METHOD_NEWTON;
    CHECK_STATUS(signorini_solve(2, 2, K, 4, f, gap, SIGNORINI_LAW_COULOMB, mu, NULL, &settings, d,
                                 F, NULL, &report, NULL), 0);
    CHECK(report.method == SIGNORINI_METHOD_NEWTON && report.second == 0);
    CHECK(report.first_method == SIGNORINI_METHOD_NEWTON);
    CHECK(report.fallback == SIGNORINI_FALLBACK_NONE);
    CHECK(report.iterations >= 1 && report.iterations <= 10);
    CHECK(report.factorisations >= 1 && report.factorisations <= report.iterations);
    CHECK(report.orientation == 1 && report.uniqueness != SIGNORINI_UNIQUENESS_SEVERAL);
    CHECK(report.omega == 0 && report.damping == 0 && report.outer_iterations == 0);
    return check_summary("layout");
}
