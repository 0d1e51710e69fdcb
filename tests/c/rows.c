/*
 * General rows in a model: lists of nodes with signed weights, lists of degrees of freedom with vectors,
 * equations between degrees of freedom, a node on two planes, and what is refused.
 *
 * Node A (components 0, 1) and node B (2, 3), each component on a spring of stiffness 2.
 */

#include "check.h"

#include <stddef.h>

enum { SIZE = 4 };

static const int64_t starts[SIZE + 1] = {0, 1, 2, 3, 4}, rows[SIZE] = {0, 1, 2, 3};
static const double springs[SIZE] = {2, 2, 2, 2};
static const signorini_sparse K = {.struct_size = sizeof K, .index_bytes = 8, .index_base = 0,
                                   .triangle = SIGNORINI_TRIANGLE_LOWER, .size = SIZE, .nnz = SIZE,
                                   .col_start = starts, .row = rows, .values = springs};

/* A on B along y: as a pair of slave and master, and as a row. */
static const int64_t slave[] = {0, 1}, master_start[] = {0, 1}, master[] = {2, 3};
static const int64_t row_start[] = {0, 2}, row_nodes[] = {0, 1, 2, 3};
static const double weight[] = {1}, row_weights[] = {1, -1}, down[] = {0, -1};

static signorini_pairs named(void)
{
    return (signorini_pairs){.struct_size = sizeof(signorini_pairs), .dim = 2, .count = 1,
                             .slaves = slave, .master_start = master_start, .masters = master,
                             .weights = weight, .normals = down};
}

static signorini_pairs listed(void)
{
    return (signorini_pairs){.struct_size = sizeof(signorini_pairs), .dim = 2, .count = 1,
                             .normals = down, .row_start = row_start, .row_nodes = row_nodes,
                             .row_weights = row_weights};
}

static signorini_model *made(const signorini_pairs *pairs)
{
    signorini_model *model = NULL;
    CHECK_STATUS(signorini_model_new_sparse(&K, 0, NULL, pairs, NULL, &model), 0);
    return model;
}

/* The same pair by degree of freedom. */
static const int64_t vector_start[] = {0, 4};
static const double vectors[] = {1, 0, 0, 1, -1, 0, 0, -1};

static signorini_pairs by_dof(void)
{
    return (signorini_pairs){.struct_size = sizeof(signorini_pairs), .dim = 2, .count = 1,
                             .normals = down, .row_start = vector_start, .row_nodes = rows,
                             .row_vectors = vectors};
}

/* Node A in axes that are turned by a quarter: (7, 9) = (-u_1, u_0) has the numbers 7 and 9. */
static const int64_t turned[] = {9, 7}, turned_start[] = {0, 1, 2}, turned_dofs[] = {0, 1};
static const double turned_coefficients[] = {1, -1};
static const signorini_equations quarter = {.struct_size = sizeof quarter, .count = 2,
                                            .dependent = turned, .start = turned_start,
                                            .dofs = turned_dofs, .coefficients = turned_coefficients};

static void refused(const signorini_pairs *pairs, const char *part)
{
    signorini_model *model;
    CHECK_STATUS(signorini_model_new_sparse(&K, 0, NULL, pairs, NULL, &model), -4);
    CHECK(model == NULL);
    if (!check_result(__FILE__, __LINE__, strstr(signorini_last_error(), part) != NULL))
        printf("\"%s\" does not contain \"%s\"\n", signorini_last_error(), part);
}

/* Two springs of 2 in a row are one of 1. An older program's structure ends before row_start or row_vectors. */
static void a_row_is_a_pair(void)
{
    signorini_pairs forms[5] = {named(), listed(), named(), listed(), by_dof()};
    forms[2].struct_size = offsetof(signorini_pairs, row_start);
    forms[2].row_start = row_start; /* must not be looked at */
    forms[3].struct_size = offsetof(signorini_pairs, row_vectors);
    forms[3].row_vectors = vectors; /* likewise */
    for (int form = 0; form < 5; form++) {
        signorini_model *model = made(&forms[form]);
        double stiffness[4], nodal[SIZE];
        const double force[2] = {-3, 1};
        CHECK_STATUS(copy_stiffness(model, stiffness), 0);
        for (int i = 0; i < 4; i++) CHECK_NEAR(stiffness[i], i % 3 == 0);
        /* n = (0, -1), t = (1, 0). */
        CHECK_STATUS(signorini_model_nodal_forces(model, force, nodal), 0);
        CHECK_NEAR(nodal[0], 1);
        CHECK_NEAR(nodal[1], 3);
        CHECK_NEAR(nodal[2], -1);
        CHECK_NEAR(nodal[3], -3);
        signorini_model_free(model);
    }
}

/* The slave is node A in its turned axes: the pair's x is -u_1, its y is u_0. Springs are alike in both. */
static void equations_turn_axes(void)
{
    static const int64_t label[] = {7, 9};
    signorini_pairs pairs = named();
    pairs.slaves = label;
    pairs.equations = &quarter;
    signorini_model *model = made(&pairs);
    double stiffness[4], nodal[SIZE], u[SIZE];
    const double force[2] = {-3, 1}, d[2] = {0.25, 0.5}, none[SIZE] = {0};
    CHECK_STATUS(copy_stiffness(model, stiffness), 0);
    for (int i = 0; i < 4; i++) CHECK_NEAR(stiffness[i], i % 3 == 0);
    /* The force (1, 3) on the slave does the work of (3, -1) on (u_0, u_1). */
    CHECK_STATUS(signorini_model_nodal_forces(model, force, nodal), 0);
    CHECK_NEAR(nodal[0], 3);
    CHECK_NEAR(nodal[1], -1);
    CHECK_NEAR(nodal[2], -1);
    CHECK_NEAR(nodal[3], -3);
    /* The slave moves by (0.5, -0.25) against the master, and each by half of it. */
    CHECK_STATUS(signorini_model_recover(model, 1, none, NULL, d, u), 0);
    CHECK_NEAR(u[0], -0.125);
    CHECK_NEAR(u[1], -0.25);
    CHECK_NEAR(u[2], -0.25);
    CHECK_NEAR(u[3], 0.125);
    signorini_model_free(model);
}

/* A dependent of the matrix is eliminated: node B moves as node A, and a load on B is one on A. */
static void equations_eliminate(void)
{
    static const int64_t tied[] = {2, 3}, start[] = {0, 1, 2}, dofs[] = {0, 1};
    static const double ones[] = {1, 1};
    const signorini_equations tie = {.struct_size = sizeof tie, .count = 2, .dependent = tied,
                                     .start = start, .dofs = dofs, .coefficients = ones};
    signorini_pairs pairs = {.struct_size = sizeof pairs, .dim = 2, .count = 1, .slaves = tied,
                             .normals = down, .equations = &tie};
    signorini_model *model = made(&pairs);
    double stiffness[4], load[2], u[SIZE], nodal[SIZE];
    const double f[SIZE] = {0, 0, 1, -3}, d[2] = {0.25, 0.5};
    CHECK_STATUS(copy_stiffness(model, stiffness), 0);
    for (int i = 0; i < 4; i++) CHECK_NEAR(stiffness[i], 4 * (i % 3 == 0));
    CHECK_STATUS(signorini_model_condensed_load(model, f, NULL, load), 0);
    CHECK_NEAR(load[0], 3);
    CHECK_NEAR(load[1], 1);
    CHECK_STATUS(signorini_model_recover(model, 1, f, NULL, d, u), 0);
    CHECK_STATUS(signorini_model_nodal_forces(model, d, nodal), 0);
    for (int i = 0; i < SIZE; i++) {
        CHECK_NEAR(u[i], i % 2 == 0 ? 0.5 : -0.25);
        CHECK_NEAR(nodal[i], i > 1 ? 0 : i == 0 ? 0.5 : -0.25);
    }
    signorini_model_free(model);
}

/*
 * A on the floor and at a wall, pressed by (1, -1): it rests, and the smallest forces share the load,
 * N + T = 1 with T = mu N. No stiffness in relative displacements exists.
 */
static void a_node_on_two_planes(void)
{
    const int64_t twice[] = {0, 1, 0, 1}, start[] = {0, 1, 2};
    const double ones[] = {1, 1}, planes[] = {0, -1, 1, 0}, mu[] = {0.25, 0.25}, gap[] = {0, 0};
    const double load[SIZE] = {1, -1, 0, 0};
    const signorini_pairs slaves = {.struct_size = sizeof slaves, .dim = 2, .count = 2,
                                    .slaves = twice, .normals = planes};
    const signorini_pairs general = {.struct_size = sizeof general, .dim = 2, .count = 2,
                                     .normals = planes, .row_start = start, .row_nodes = twice,
                                     .row_weights = ones};
    for (int form = 0; form < 2; form++) {
        signorini_model *model = made(form ? &general : &slaves);
        double d[4] = {0}, F[4] = {0}, stiffness[16], condensed[4], u[SIZE];
        signorini_report report = {.struct_size = sizeof report};
        int32_t status = 77;
        CHECK_STATUS(signorini_model_solve(model, 1, load, NULL, gap, SIGNORINI_LAW_COULOMB, mu,
                                           NULL, NULL, d, F, NULL, &status, &report, NULL), 0);
        CHECK_STATUS(status, 0);
        for (int i = 0; i < 4; i++) CHECK(fabs(d[i]) < 1e-8);
        CHECK(fabs(F[0] + 0.8) < 1e-8 && fabs(F[2] + 0.8) < 1e-8);
        CHECK(fabs(fabs(F[1]) - 0.2) < 1e-8 && fabs(fabs(F[3]) - 0.2) < 1e-8);
        CHECK(report.uniqueness == SIGNORINI_UNIQUENESS_NOT_KNOWN);
        CHECK_STATUS(signorini_model_recover(model, 1, load, NULL, d, u), 0);
        for (int i = 0; i < SIZE; i++) CHECK(fabs(u[i]) < 1e-8);
        CHECK_STATUS(copy_stiffness(model, stiffness), -1);
        CHECK(model_data(model).kind == SIGNORINI_MODEL_STIFFNESS && model_data(model).dependent > 0);
        CHECK_STATUS(signorini_model_condensed_load(model, load, NULL, condensed), -1);
        CHECK(strstr(signorini_last_error(), "follow from those of other pairs") != NULL);
        /* d does not tell the forces: they are measured with it. */
        CHECK_STATUS(signorini_model_certify(model, load, NULL, gap, SIGNORINI_LAW_COULOMB, mu, NULL,
                                             1e-10, d, F, NULL, NULL), 0);
        CHECK_STATUS(signorini_model_certify(model, load, NULL, gap, SIGNORINI_LAW_COULOMB, mu, NULL,
                                             1e-10, d, NULL, NULL, NULL), -10);
        const double kept = F[0];
        F[0] -= 1e-3;
        CHECK_STATUS(signorini_model_certify(model, load, NULL, gap, SIGNORINI_LAW_COULOMB, mu, NULL,
                                             1e-10, d, F, NULL, NULL), SIGNORINI_STATUS_NOT_A_SOLUTION);
        F[0] = kept;
        CHECK_STATUS(signorini_model_write(model, "not_written", load, NULL, gap,
                                           SIGNORINI_LAW_COULOMB, mu, NULL, NULL), -1);
        signorini_model_free(model);
    }
}

static void refusals(void)
{
    const double positive[] = {1, 1}, none[] = {0, 0};
    signorini_pairs pairs = listed();
    pairs.slaves = slave;
    refused(&pairs, "row_start is set, and slaves, master_start, masters or weights too");
    pairs = named();
    pairs.row_nodes = row_nodes;
    refused(&pairs, "row_nodes, row_weights or row_vectors is set, but row_start is NULL");
    pairs = named();
    pairs.row_vectors = vectors;
    refused(&pairs, "row_nodes, row_weights or row_vectors is set, but row_start is NULL");
    pairs = by_dof();
    pairs.row_weights = row_weights;
    refused(&pairs, "row_weights and row_vectors are set: leave row_vectors NULL");
    pairs = by_dof();
    pairs.row_nodes = NULL;
    refused(&pairs, "row_nodes is NULL");
    pairs = listed();
    pairs.row_nodes = NULL;
    refused(&pairs, "row_nodes is NULL");
    pairs = listed();
    pairs.row_weights = positive;
    refused(&pairs, "pair 0: its signed weights sum to 2: they must sum to 0 between bodies, to 1");
    pairs.row_weights = none;
    refused(&pairs, "pair 0: it has no node with a weight");
    pairs = named();
    pairs.slaves = NULL;
    refused(&pairs, "slaves is NULL");
    pairs = named();
    pairs.struct_size = offsetof(signorini_pairs, tangents);
    refused(&pairs, "pairs: struct_size is");
}

static void refused_equations(void)
{
    const int64_t negative[] = {-1, 7}, twice[] = {7, 7}, descending[] = {0, 2, 1}, itself[] = {0, 7};
    const double infinite[] = {1, HUGE_VAL};
    signorini_pairs pairs = named();
    signorini_equations equations = quarter;
    pairs.equations = &equations;
    equations.struct_size = 0;
    refused(&pairs, "equations: struct_size is 0, set it to sizeof");
    equations = quarter, equations.reserved = 1;
    refused(&pairs, "equations: reserved is 1");
    equations = quarter, equations.count = -1;
    refused(&pairs, "equations: count is -1");
    equations = quarter, equations.dependent = NULL;
    refused(&pairs, "equations: dependent is NULL");
    equations = quarter, equations.dependent = negative;
    refused(&pairs, "equations: dependent[0] is -1, less than 0");
    equations = quarter, equations.dependent = twice;
    refused(&pairs, "equation 1: it gives degree of freedom 7, as equation 0 does");
    equations = quarter, equations.start = NULL;
    refused(&pairs, "equations: start is NULL");
    equations = quarter, equations.start = descending;
    refused(&pairs, "equation 1: its terms begin after they end");
    equations = quarter, equations.dofs = NULL;
    refused(&pairs, "equations: dofs is NULL");
    equations = quarter, equations.dofs = itself;
    refused(&pairs, "equation 1: its dependent degree of freedom follows from itself, by way of 7");
    equations = quarter, equations.coefficients = NULL;
    refused(&pairs, "equations: coefficients is NULL");
    equations = quarter, equations.coefficients = infinite;
    refused(&pairs, "equation 1: a coefficient is not finite");
    /* Without equations nothing is read. */
    equations = (signorini_equations){.struct_size = sizeof equations};
    signorini_model_free(made(&pairs));
}

int main(void)
{
    a_row_is_a_pair();
    equations_turn_axes();
    equations_eliminate();
    refused_equations();
    a_node_on_two_planes();
    refusals();
    return check_summary("rows");
}
