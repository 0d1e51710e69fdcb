/*
 * The functions of the guide's chapter of questions, c_examples/guide/questions.md, do what it says. They come into
 * this program as they stand there: tests/guide.sh cuts them out. Answers are closed forms of springs.
 */

#include "check.h" /* first: what may still change */

#include "questions.h"

/* A diagonal stiffness: each degree of freedom has a spring to the ground. */
enum { MOST = 12 };
static signorini_sparse springs(int64_t size, int32_t base, const double *stiffness)
{
    static int64_t start[MOST + 1], row[MOST];
    for (int64_t i = 0; i <= size; i++)
        start[i] = base + i;
    for (int64_t i = 0; i < size; i++)
        row[i] = base + i;
    return (signorini_sparse){.struct_size = sizeof(signorini_sparse), .index_bytes = 8, .index_base = base,
                              .triangle = SIGNORINI_TRIANGLE_LOWER, .size = size, .nnz = size, .col_start = start,
                              .row = row, .values = stiffness};
}

/*
 * Three lines of two nodes above each other, A and B 0.2 apart, B and C 0.1, each node on a spring: 1, 2 and 4. The
 * nodes of A are pressed down by 4. They go down by a, b and c with a - b = 0.2, b - c = 0.1 and a + 2 b + 4 c = 4: so
 * c = 0.5, and B presses on C by 4 c = 2, A on B by 2 + 2 b = 3.2. B is master of one zone and slave of the other.
 */
static void check_zones(int32_t base)
{
    const double x[12] = {0, 0.3, 1, 0.3, 0, 0.1, 1, 0.1, 0, 0, 1, 0};
    const double stiffness[12] = {1, 1, 1, 1, 2, 2, 2, 2, 4, 4, 4, 4}, load[12] = {0, -4, 0, -4}, mu = 0.1;
    /* A body lies to the left of its line: each line of B looks down as a slave, up as a master. */
    const int64_t down[2][2] = {{base, base + 1}, {base + 2, base + 3}};
    const int64_t up[2][2] = {{base + 3, base + 2}, {base + 5, base + 4}};
    const char *const name[2] = {"A on B", "B on C"};
    double d[8], F[8];
    int32_t state[4];
    signorini_surface_settings settings;
    signorini_surface_pairs *zone[2], *joined;
    signorini_contact_zone zones[2];

    signorini_surface_settings_default(&settings, sizeof settings);
    settings.index_base = base;
    for (int i = 0; i < 2; i++) {
        const signorini_faces slave = {.struct_size = sizeof slave, .face_nodes = 2, .count = 1, .nodes = down[i]};
        const signorini_faces master = {.struct_size = sizeof master, .face_nodes = 2, .count = 1, .nodes = up[i]};
        CHECK_STATUS(signorini_surface_pair(2, 6, x, &slave, &master, &settings, &zone[i]), 0);
        zones[i] = (signorini_contact_zone){.struct_size = sizeof zones[i], .law = SIGNORINI_LAW_COULOMB * i,
                                            .contact = zone[i], .name = name[i], .friction = i ? &mu : NULL};
    }
    const signorini_sparse K = springs(12, base, stiffness);
    CHECK_STATUS(solve_zones(2, zones, &K, 0, NULL, load, d, F, state), 0);
    for (int i = 0; i < 4; i++)
        CHECK_NEAR(F[2 * i], i < 2 ? -3.2 : -2);

    /* What the joined pairs are, and what each zone carries. */
    signorini_surface_data data = {.struct_size = sizeof data};
    signorini_resultant sums = {.struct_size = sizeof sums};
    char table[1024], part[40];
    CHECK_STATUS(signorini_surface_join(2, zones, &joined), 0);
    CHECK_STATUS(signorini_surface_view(joined, &data), 0);
    CHECK(data.pairs == 4 && data.n_zones == 2 && data.rows->count == 4);
    CHECK(data.zone_start[0] == 0 && data.zone_start[1] == 2 && data.zone_start[2] == 4);
    for (int i = 0; i < 4; i++)
        CHECK(data.friction[4 * i] == i / 2 && data.friction[4 * i + 1] == mu * (i / 2) && data.friction[4 * i + 2] == 0);
    CHECK_TEXT(data.summary, "A on B: 2 pairs on 100.00 %");
    CHECK_TEXT(data.summary, ". B on C: 2 pairs on");
    CHECK_STATUS(signorini_surface_table(joined, d, F, state, table, sizeof table), 0);
    CHECK_TEXT(table, "\nA on B                  2        0        2        0   0.0000e+00   6.4000e+00");
    CHECK_TEXT(table, "\nB on C                  2 ");
    CHECK_STATUS(signorini_surface_table(joined, d, F, state, part, sizeof part), 0);
    CHECK(strlen(part) == sizeof part - 1 && strncmp(part, table, sizeof part - 1) == 0);
    const int32_t kept = state[0];
    state[0] = 7;
    CHECK_STATUS(signorini_surface_table(joined, d, F, state, part, sizeof part), -4);
    CHECK_TEXT(signorini_last_error(), "is 7, it must be 0, 1 or 2");
    state[0] = kept;
    CHECK_STATUS(signorini_surface_table(joined, d, F, state, part, 0), -6);
    CHECK_STATUS(signorini_surface_resultant(joined, NULL, d, F, NULL, &sums), 0);
    CHECK_NEAR(sums.force[1], 2 * 3.2 + 2 * 2);
    CHECK_STATUS(signorini_surface_resultant(zone[1], NULL, d + 4, F + 4, NULL, &sums), 0);
    CHECK_NEAR(sums.force[1], 2 * 2);
    /* Fields of all zones at once: a node of B has the values of the pair whose slave it is. */
    double pressure[6] = {0};
    const signorini_contact_fields fields = {.struct_size = sizeof fields, .pressure = pressure};
    CHECK_STATUS(signorini_surface_fields(joined, NULL, NULL, d, F, state, &fields), 0);
    for (int i = 0; i < 6; i++)
        CHECK_NEAR(pressure[i], i < 2 ? 6.4 : 4);
    const int64_t cells[6] = {base, base + 1, base + 2, base + 3, base + 4, base + 5};
    const signorini_mesh mesh = {.struct_size = sizeof mesh, .dim = 2, .nodes = 6, .coordinates = x, .cells = 3,
                                 .index_base = base, .cell_type = 3, .cell_nodes = cells};
    const signorini_zone written = {.struct_size = sizeof written, .contact = joined, .d = d, .F = F, .state = state};
    CHECK_STATUS(signorini_mesh_write("zones.vtu", &mesh, NULL, 1, &written, 0, NULL), 0);
    CHECK(remove("zones.vtu") == 0);

    /* Nothing has passed through. Moves are asked of each zone where B is slave and master. */
    signorini_penetration through = {.struct_size = sizeof through};
    const double still[12] = {0};
    double moved[12];
    memcpy(moved, x, sizeof moved);
    CHECK_STATUS(signorini_surface_penetration(joined, still, &through), 0);
    CHECK(through.points == 0 && through.face == -1 && through.zone == 0);
    CHECK_STATUS(signorini_surface_adjust(joined, 1, moved), -3);
    CHECK_TEXT(signorini_last_error(), "would move, and slave nodes onto it: adjust zone by zone, and pair again");
    CHECK(memcmp(moved, x, sizeof moved) == 0);
    for (int i = 0; i < 2; i++)
        CHECK_STATUS(signorini_surface_adjust(zone[i], 1, moved), 0);
    for (int i = 0; i < 12; i++)
        CHECK_NEAR(moved[i], i % 2 == 0 ? x[i] : i < 4 ? 0.1 : 0);
    signorini_surface_free(joined);

    /* Arguments that are refused. */
    zones[1].name = name[0];
    CHECK_STATUS(signorini_surface_join(2, zones, &joined), -2);
    CHECK_TEXT(signorini_last_error(), "two zones are named 'A on B'");
    zones[1].name = "";
    CHECK_STATUS(signorini_surface_join(2, zones, &joined), -2);
    CHECK_TEXT(signorini_last_error(), "zone 1 has no name");
    zones[1].name = "again";
    zones[1].contact = zone[0];
    CHECK_STATUS(signorini_surface_join(2, zones, &joined), -2);
    CHECK_TEXT(signorini_last_error(), "slave face 0 of zone 'again' is slave face 0 of zone 'A on B', and both");
    zones[1].law = SIGNORINI_LAW_BY_PAIR;
    const double *friction = zones[1].friction;
    for (int given = 0; given < 2; given++) {
        zones[1].friction = given ? friction : NULL;
        CHECK_STATUS(signorini_surface_join(2, zones, &joined), -2);
        CHECK_TEXT(signorini_last_error(), "law is SIGNORINI_LAW_BY_PAIR: give the law of the zone");
    }
    zones[1].contact = zone[1];
    for (int law = SIGNORINI_LAW_FRICTIONLESS; law <= SIGNORINI_LAW_TIED; law += SIGNORINI_LAW_TIED) {
        zones[1].law = law;
        CHECK_STATUS(signorini_surface_join(2, zones, &joined), -2);
        CHECK_TEXT(signorini_last_error(), "has no parameters: give the law of these numbers");
    }
    zones[1].law = SIGNORINI_LAW_COULOMB;
    zones[1].friction = NULL;
    CHECK_STATUS(signorini_surface_join(2, zones, &joined), -2);
    CHECK_STATUS(signorini_surface_join(0, zones, &joined), -1);
    CHECK(joined == NULL);
    for (int i = 0; i < 2; i++)
        signorini_surface_free(zone[i]);
}

/*
 * A rigid rod from (0, 0, 0) to (2, 0, 0) has unit springs on the six degrees of freedom at its middle. Its ends press
 * on the ground, two pairs that the host names by numbers beyond its matrix. Pressed down by 4 at the middle and turned
 * about y by a moment of 1, it stays where it is: the forces are 2 - 1/2 and 2 + 1/2.
 */
static void check_rigid_nodes(int32_t base)
{
    const int64_t motion[6] = {base, base + 1, base + 2, base + 3, base + 4, base + 5};
    const int64_t ends[6] = {base + 20, base + 21, base + 22, base + 30, base + 31, base + 32};
    const double arms[2][3] = {{-1, 0, 0}, {1, 0, 0}}, normals[6] = {0, 0, -1, 0, 0, -1};
    const double stiffness[6] = {1, 1, 1, 1, 1, 1}, load[6] = {0, 0, -4, 0, 1, 0}, gap[2] = {0, 0};
    int64_t count = 0, dependent[6], start[7] = {base}, dofs[18];
    double coefficients[18], d[6], F[6], u[6], nodal[6];
    signorini_model *model;

    for (int end = 0; end < 2; end++)
        append_rigid_node(ends + 3 * end, arms[end], motion, &count, dependent, start, dofs, coefficients);
    CHECK(count == 6 && start[6] == base + 18);
    const signorini_equations equations = {.struct_size = sizeof equations, .count = count, .dependent = dependent,
                                           .start = start, .dofs = dofs, .coefficients = coefficients};
    const signorini_pairs rows = {.struct_size = sizeof rows, .dim = 3, .count = 2, .slaves = ends,
                                  .normals = normals};
    const signorini_sparse K = springs(6, base, stiffness);
    CHECK_STATUS(model_with_equations(&K, 0, NULL, &rows, &equations, &model), 0);
    CHECK_STATUS(signorini_model_solve(model, 1, load, NULL, gap, SIGNORINI_LAW_FRICTIONLESS, NULL, NULL, NULL, d, F,
                                       NULL, NULL, NULL, NULL), 0);
    CHECK_STATUS(signorini_model_recover(model, 1, load, NULL, d, u), 0);
    CHECK_STATUS(signorini_model_nodal_forces(model, F, nodal), 0);
    /* u_z = U_z - theta_y x: the moment presses the end at x = 1. */
    CHECK(fabs(F[0] + 1.5) < 1e-9 && fabs(F[3] + 2.5) < 1e-9);
    for (int i = 0; i < 6; i++) {
        CHECK(fabs(u[i]) < 1e-9);
        CHECK(fabs(nodal[i] + load[i]) < 1e-9);
    }
    signorini_model_free(model);
}

static void check_initial_gaps(void)
{
    const double gaps[3] = {0.02, -0.001, 0.5};
    const signorini_surface_data data = {.struct_size = sizeof data, .pairs = 3, .gaps = gaps};
    double gap[3];

    initial_gaps(&data, 0, 0.01, gap);
    CHECK(gap[0] == 0.02 && gap[1] == 0 && gap[2] == 0.5);
    initial_gaps(&data, -0.5, 0.01, gap);
    CHECK(gap[0] == 0.02 - 0.5 && gap[1] == -0.001 - 0.5 && gap[2] == 0);
}

/*
 * A bolt of two springs, 2 above its section and 4 below, whose head stands on the ground. A pretension of 6 shortens the
 * section by 6 / 2 + 6 / 4. Locked, a pull of 2 at the head relieves the ground and moves nothing, one of 8 lifts the head
 * by (8 - 6) (1 / 2 + 1 / 4).
 */
static void check_pretension(int32_t base)
{
    enum { N = 10, SHORTENING = 9 };
    const int64_t head[3] = {base, base + 1, base + 2}, upper[3] = {base + 3, base + 4, base + 5};
    const int64_t lower[3] = {base + 6, base + 7, base + 8}, unknown = base + SHORTENING;
    const int64_t starts[N + 1] = {0, 1, 2, 4, 5, 6, 7, 8, 9, 10, 10}, rows[10] = {0, 1, 2, 5, 3, 4, 5, 6, 7, 8};
    const double values[10] = {1, 1, 2, -2, 1, 1, 2, 1, 1, 4}, axis[3] = {0, 0, 1}, normal[3] = {0, 0, -1};
    const double gap[1] = {0}, shortening = 4.5, pulls[2] = {2, 8}, pressed[2] = {-4, 0}, lifted[2] = {0, 1.5};
    int64_t col_start[N + 1], row[10], count = 0, dependent[3], start[4] = {base}, dofs[6];
    double coefficients[6], f[N] = {0}, d[3], F[3], u[N];
    signorini_model *model;

    for (int i = 0; i <= N; i++)
        col_start[i] = base + starts[i];
    for (int i = 0; i < 10; i++)
        row[i] = base + rows[i];
    append_section_node(upper, lower, unknown, axis, &count, dependent, start, dofs, coefficients);
    const signorini_sparse K = {.struct_size = sizeof K, .index_bytes = 8, .index_base = base,
                                .triangle = SIGNORINI_TRIANGLE_LOWER, .size = N, .nnz = 10, .col_start = col_start,
                                .row = row, .values = values};
    const signorini_equations equations = {.struct_size = sizeof equations, .count = count, .dependent = dependent,
                                           .start = start, .dofs = dofs, .coefficients = coefficients};
    const signorini_pairs pairs = {.struct_size = sizeof pairs, .dim = 3, .count = 1, .slaves = head,
                                   .normals = normal, .equations = &equations};

    CHECK_STATUS(signorini_model_new_sparse(&K, 0, NULL, &pairs, NULL, &model), 0);
    f[SHORTENING] = 6;
    CHECK_STATUS(signorini_model_solve(model, 1, f, NULL, gap, SIGNORINI_LAW_FRICTIONLESS, NULL, NULL, NULL, d, F, NULL,
                                       NULL, NULL, NULL), 0);
    CHECK_STATUS(signorini_model_recover(model, 1, f, NULL, d, u), 0);
    CHECK_NEAR(F[0], -6);
    CHECK_NEAR(u[SHORTENING], shortening);
    CHECK_NEAR(u[8], 1.5);
    CHECK_NEAR(u[5], -3);
    signorini_model_free(model);

    CHECK_STATUS(signorini_model_new_sparse(&K, 1, &unknown, &pairs, NULL, &model), 0);
    f[SHORTENING] = 0;
    for (int k = 0; k < 2; k++) {
        f[2] = pulls[k];
        CHECK_STATUS(signorini_model_solve(model, 1, f, &shortening, gap, SIGNORINI_LAW_FRICTIONLESS, NULL, NULL, NULL, d,
                                           F, NULL, NULL, NULL, NULL), 0);
        CHECK_STATUS(signorini_model_recover(model, 1, f, &shortening, d, u), 0);
        CHECK_NEAR(F[0], pressed[k]);
        CHECK_NEAR(u[2], lifted[k]);
    }
    signorini_model_free(model);
}

/*
 * Springs of 2. A tied pair that is pulled by 3 and pushed by 1 does not move. Of two that slide the one pressed by
 * 3 and pushed by 2 carries 0.5 * 3 and slips by 0.25, the other one, pulled by 1, opens by 0.5.
 */
static void check_tie(void)
{
    enum { N = 6 };
    const int32_t tied[3] = {1, 0, 0};
    const double f[N] = {-3, 1, 3, 2, -1, 0}, gap[3] = {0};
    const double moved[N] = {0, 0, 0, 0.25, -0.5, 0}, held[N] = {3, -1, -3, -1.5, 0, 0};
    double K[N * N] = {0}, friction[12], d[N], F[N];

    for (int i = 0; i < N; i++)
        K[i + N * i] = 2;
    tied_and_sliding(3, tied, 0.5, friction);
    CHECK_STATUS(signorini_solve(2, 3, K, N, f, gap, SIGNORINI_LAW_BY_PAIR, friction, NULL, NULL, d, F, NULL, NULL,
                                 NULL), 0);
    for (int i = 0; i < N; i++) {
        CHECK_NEAR(d[i], moved[i]);
        CHECK_NEAR(F[i], held[i]);
    }
}

/* Two nodes with a spring between them, one above the other; nothing but contact holds them along y. */
static void check_escape(void)
{
    const int64_t col_start[5] = {0, 1, 3, 4, 5}, row[5] = {0, 1, 3, 2, 3}, fixed[2] = {0, 2}, slave[2] = {0, 1};
    const double values[5] = {1, 5, -5, 1, 5}, normal[2] = {0, -1}, gap[1] = {0.5}, mu[1] = {0};
    const double press[4] = {0, 0, 0, -2}, pull[4] = {0, 0, 0, 2};
    const signorini_sparse K = {.struct_size = sizeof K, .index_bytes = 8, .triangle = SIGNORINI_TRIANGLE_LOWER,
                                .size = 4, .nnz = 5, .col_start = col_start, .row = row, .values = values};
    const signorini_pairs pairs = {.struct_size = sizeof pairs, .dim = 2, .count = 1, .slaves = slave,
                                   .normals = normal};
    double d[2], F[2], escape[2], u[4] = {0};
    signorini_model *model;

    CHECK_STATUS(signorini_model_new_sparse(&K, 2, fixed, &pairs, NULL, &model), 0);
    CHECK_STATUS(solve_or_escape(model, press, gap, mu, d, F, escape, u), SIGNORINI_STATUS_SOLVED);
    CHECK_NEAR(d[0], 0.5);
    CHECK_NEAR(F[0], -2);
    CHECK_STATUS(solve_or_escape(model, pull, gap, mu, d, F, escape, u), SIGNORINI_STATUS_NO_EQUILIBRIUM);
    CHECK(u[0] == 0 && u[2] == 0 && u[1] > 0);
    CHECK_NEAR(u[3], u[1]); /* rigid */
    signorini_model_free(model);
}

int main(void)
{
    check_zones(0);
    check_zones(1);
    check_rigid_nodes(0);
    check_rigid_nodes(1);
    check_initial_gaps();
    check_pretension(0);
    check_pretension(1);
    check_tie();
    check_escape();
    return check_summary("questions");
}
