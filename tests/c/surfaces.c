/*
 * Pairs from surfaces: the patch test with blocks of bricks whose nodes do not match, fields and
 * resultants in closed form, obstacles, the numbers of nodes and degrees of freedom, and what is
 * refused.
 */

#include "check.h"

#include "../../c_examples/3d/brick_mesh.h"

#include <stdlib.h>
#include <string.h>

/* ---- Patch test ---------------------------------------------------------------------------- */

enum { LOWER, UPPER, MOST = 400 };

#define PRESSURE 7.0

/* A quarter of two blocks on the unit square: nothing moves across x = 0, y = 0 and the bottom. */
struct blocks {
    struct brick_mesh *mesh;
    int64_t lower[16][4], upper[16][4], fixed[MOST];
    signorini_faces top, bottom;
    int64_t n_fixed;
    double load[3 * MOST];
};

static const double x_lower[] = {0, 0.4, 0.7, 1}, x_upper[] = {0, 0.2, 0.45, 0.8, 1};
static const double z_lower[] = {-0.8, -0.3, 0}, z_upper[] = {0, 0.4, 0.6};

static signorini_faces quadrilaterals(int64_t count, const int64_t *nodes)
{
    return (signorini_faces){.struct_size = sizeof(signorini_faces), .face_nodes = 4,
                             .count = count, .nodes = nodes};
}

/* Length that belongs to a node of a line: half of its cells. */
static double share(const double *line, int cells, int node)
{
    return (line[node < cells ? node + 1 : cells] - line[node > 0 ? node - 1 : 0]) / 2;
}

static struct blocks *blocks_new(void)
{
    const struct box boxes[2] = {{{3, 3, 2}, {x_lower, x_lower, z_lower}},
                                 {{4, 4, 2}, {x_upper, x_upper, z_upper}}};
    struct blocks *blocks = calloc(1, sizeof *blocks);
    blocks->mesh = brick_mesh_new(2, boxes, (struct material){1000, 0.3});
    const struct brick_mesh *mesh = blocks->mesh;
    blocks->top = quadrilaterals(brick_faces(mesh, LOWER, 1, blocks->lower), blocks->lower[0]);
    blocks->bottom = quadrilaterals(brick_faces(mesh, UPPER, 0, blocks->upper), blocks->upper[0]);
    for (int32_t node = 0; node < mesh->nodes; node++)
        for (int axis = 0; axis < 3; axis++)
            if (mesh->at[node][axis] == (axis < 2 ? 0.0 : -0.8))
                blocks->fixed[blocks->n_fixed++] = 3 * node + axis;
    for (int j = 0; j <= 4; j++)
        for (int i = 0; i <= 4; i++)
            blocks->load[3 * brick_node(mesh, UPPER, i, j, 2) + 2] =
                -PRESSURE * share(x_upper, 4, i) * share(x_upper, 4, j);
    return blocks;
}

static void blocks_free(struct blocks *blocks)
{
    brick_mesh_free(blocks->mesh);
    free(blocks);
}

static signorini_sparse matrix_of(const struct brick_mesh *mesh)
{
    return (signorini_sparse){.struct_size = sizeof(signorini_sparse), .index_bytes = 4,
                              .triangle = SIGNORINI_TRIANGLE_FULL, .size = mesh->dofs,
                              .nnz = mesh->starts[mesh->dofs], .col_start = mesh->starts,
                              .row = mesh->rows, .values = mesh->values};
}

/* Every pressure is that of the load, on both sides; nothing is open and no clearance is left. */
static void check_fields(const struct blocks *blocks, const signorini_surface_pairs *contact,
                         double sign, const double *d, const double *F, const int32_t *state)
{
    double pressure[MOST], traction[3 * MOST], clearance[MOST], slip[3 * MOST];
    int32_t of_node[MOST];
    const signorini_contact_fields fields = {.struct_size = sizeof fields, .pressure = pressure,
                                             .traction = traction, .clearance = clearance,
                                             .slip = slip, .state = of_node};
    for (int i = 0; i < MOST; i++) {
        pressure[i] = clearance[i] = -77;
        of_node[i] = -1;
    }
    CHECK_STATUS(signorini_surface_fields(contact, NULL, NULL, d, F, state, &fields), 0);
    for (int32_t node = 0; node < blocks->mesh->nodes; node++) {
        if (blocks->mesh->at[node][2] != 0) {
            CHECK(pressure[node] == -77 && clearance[node] == -77 && of_node[node] == -1);
            continue;
        }
        const int lower = node < blocks->mesh->first[UPPER];
        CHECK_NEAR(pressure[node] / PRESSURE, 1);
        CHECK_NEAR(traction[3 * node + 2] / PRESSURE, lower ? -1 : 1);
        CHECK_NEAR(clearance[node], 0);
        CHECK(of_node[node] == SIGNORINI_STATE_SLIP);
    }
    const double about[3] = {0.5, 0, 3};
    signorini_resultant sum = {.struct_size = sizeof sum};
    CHECK_STATUS(signorini_surface_resultant(contact, NULL, d, F, about, &sum), 0);
    const double down = sign * PRESSURE;
    CHECK_NEAR(sum.force[0], 0);
    CHECK_NEAR(sum.force[2], down);
    /* The force acts in the middle, (0.5, 0.5, 0). */
    CHECK_NEAR(sum.moment[0], 0.5 * down);
    CHECK_NEAR(sum.moment[1], 0);
    CHECK_NEAR(sum.friction_work, 0);
    CHECK_NEAR(sum.pressed_area, 1);
}

/*
 * Either side slave: the blocks have the same material, so that the exact solution is a uniform
 * stress, which both meshes have. 1e-10: a thousand times the tolerance.
 */
static void patch(int upper_is_slave)
{
    struct blocks *blocks = blocks_new();
    const struct brick_mesh *mesh = blocks->mesh;
    const signorini_sparse K = matrix_of(mesh);
    signorini_surface_pairs *contact = NULL;
    signorini_model *model = NULL;
    signorini_settings settings;
    /* The finer side as slave: rows on the planes of symmetry give up the axis across them. */
    const int32_t axes[] = {0, 1};
    const double places[] = {0, 0};
    signorini_surface_settings planes;
    signorini_surface_settings_default(&planes, sizeof planes);
    planes.symmetry_planes = upper_is_slave ? 2 : 0;
    planes.symmetry_axes = axes;
    planes.symmetry_at = places;
    /* The length has no say. Without a direction the first of the axes along the surface. */
    planes.tangent[1] = upper_is_slave ? 2 : 0;
    double d[3 * MOST] = {0}, F[3 * MOST] = {0}, u[3 * MOST];
    int32_t state[MOST];

    CHECK_STATUS(signorini_surface_pair(3, mesh->nodes, mesh->at[0],
                                        upper_is_slave ? &blocks->bottom : &blocks->top,
                                        upper_is_slave ? &blocks->top : &blocks->bottom, &planes,
                                        &contact), 0);
    const signorini_surface_data told = surface_data(contact);
    const int64_t count = surface_data(contact).pairs;
    const double along[] = {upper_is_slave ? 0 : 1, upper_is_slave ? 1 : 0, 0};
    CHECK(count > 0 && memcmp(told.tangents, along, sizeof along) == 0);
    CHECK(count == (upper_is_slave ? 25 : 16) && told.pairs == count && told.n_unpaired == 0);
    CHECK(told.on_symmetry == (upper_is_slave ? 9 : 0));
    CHECK_NEAR(told.covered_area, 1);
    CHECK_TEXT(surface_data(contact).summary, "pairs on");
    CHECK_STATUS(signorini_model_new_sparse(&K, blocks->n_fixed, blocks->fixed,
                                            surface_data(contact).rows, NULL, &model), 0);
    signorini_settings_default(&settings, sizeof settings);
    settings.tolerance = 1e-13;
    CHECK_STATUS(signorini_model_solve(model, 1, blocks->load, NULL, surface_data(contact).gaps,
                                       SIGNORINI_LAW_FRICTIONLESS, NULL, NULL, &settings, d, F,
                                       state, NULL, NULL, NULL), 0);
    const double *area = surface_data(contact).areas;
    for (int64_t j = 0; j < count; j++)
        CHECK(fabs(-F[3 * j] / area[j] / PRESSURE - 1) < 1e-10);
    check_fields(blocks, contact, upper_is_slave ? 1 : -1, d, F, state);

    CHECK_STATUS(signorini_model_recover(model, 1, blocks->load, NULL, d, u), 0);
    const signorini_mesh cells = {.struct_size = sizeof cells, .dim = 3, .nodes = mesh->nodes,
                                  .coordinates = mesh->at[0], .cells = mesh->bricks,
                                  .cell_type = 12, .cell_nodes = mesh->corners[0]};
    const signorini_zone zone = {.struct_size = sizeof zone, .contact = contact, .d = d, .F = F,
                                 .state = state};
    CHECK_STATUS(signorini_mesh_write("surfaces.vtu", &cells, u, 1, &zone, 0, NULL), 0);
    CHECK_STATUS(signorini_mesh_write("surfaces.vtu", &cells, u, 0, NULL, 0, NULL), 0);
    CHECK_STATUS(signorini_mesh_write("no/folder/x.vtu", &cells, u, 1, &zone, 0, NULL),
                 SIGNORINI_STATUS_FILE);
    remove("surfaces.vtu");
    signorini_model_free(model);
    signorini_surface_free(contact);
    blocks_free(blocks);
}

/* ---- Small surfaces in the plane ------------------------------------------------------------ */

/* A line of one element, 0 to 1, 0.1 above one of two elements, -1 to 2. */
static const double plane_nodes[] = {0, 0.1, 1, 0.1, -1, 0, 0.5, 0, 2, 0};
static const int64_t line[] = {0, 1}, below[] = {4, 3, 3, 2};

static signorini_faces lines(int64_t count, const int64_t *nodes)
{
    return (signorini_faces){.struct_size = sizeof(signorini_faces), .face_nodes = 2,
                             .count = count, .nodes = nodes};
}

static signorini_surface_settings defaults(void)
{
    signorini_surface_settings settings;
    CHECK_STATUS(signorini_surface_settings_default(&settings, sizeof settings), 0);
    return settings;
}

/* Rows, gaps, areas and frames by hand; nodes and faces counted from 1 and nodes of 6 components. */
static void numbers(void)
{
    const int64_t start[] = {1, 3, 5}, line1[] = {1, 2}, below1[] = {5, 4, 4, 3};
    const int64_t own[] = {20, 21, 18, 19, 16, 17, 14, 15, 12, 13};
    for (int form = 0; form < 4; form++) {
        signorini_surface_settings settings = defaults();
        signorini_faces slave = lines(1, line), master = lines(2, below);
        signorini_surface_pairs *contact;
        const int base = form == 1;
        if (form == 1) {
            slave.nodes = line1;
            master.nodes = below1;
            master.start = start;
            master.face_nodes = 0;
            settings.index_base = 1;
        }
        if (form == 2) settings.dofs_per_node = 6;
        if (form == 3) settings.node_dofs = own;
        CHECK_STATUS(signorini_surface_pair(2, 5, plane_nodes, &slave, &master, &settings, &contact), 0);
        const signorini_pairs *rows = surface_data(contact).rows;
        CHECK(rows->count == 2 && rows->dim == 2 && rows->row_start[0] == base);
        for (int pair = 0; pair < 2; pair++) {
            double sum = 0;
            CHECK(surface_data(contact).nodes[pair] == pair + base);
            CHECK_NEAR(surface_data(contact).gaps[pair], 0.1);
            CHECK_NEAR(surface_data(contact).areas[pair], 0.5);
            CHECK_NEAR(surface_data(contact).normals[2 * pair + 1], -1);
            CHECK_NEAR(surface_data(contact).tangents[2 * pair], 1);
            CHECK_NEAR(surface_data(contact).points[2 * pair], pair);
            for (int64_t k = rows->row_start[pair] - base; k < rows->row_start[pair + 1] - base; k++) {
                const int64_t *dof = &rows->row_nodes[2 * k];
                CHECK(dof[1] == dof[0] + 1);
                CHECK(form != 1 || dof[0] % 2 == 1);
                CHECK(form != 2 || dof[0] % 6 == 0);
                CHECK(form != 3 || (dof[0] >= 12 && dof[0] % 2 == 0));
                sum += rows->row_weights[k];
            }
            CHECK_NEAR(sum, 0);
        }
        signorini_surface_free(contact);
    }
}

/* The side and the bottom of a block, a sharp edge between them at node 1, over a floor that ends under the last
 * face of the bottom, from x = 1 to 1.2. */
static void choices(void)
{
    const double places[] = {0, 1.1, 0, 0.1, 1, 0.1, 1.2, 0.1, -1, 0, 1.1, 0};
    const int64_t sides[] = {0, 1, 1, 2, 2, 3}, floor[] = {5, 4};
    const signorini_faces slave = lines(3, sides), master = lines(1, floor);
    signorini_surface_pairs *contact;
    for (int32_t pairing = 0; pairing < 2; pairing++) {
        signorini_surface_settings settings = defaults();
        CHECK(settings.normals == SIGNORINI_NORMALS_AVERAGED && settings.rims == SIGNORINI_RIMS_FOLD);
        settings.pairing = pairing;
        settings.search_distance = 0.5;
        for (settings.normals = 0; settings.normals < 2; settings.normals++) {
            CHECK_STATUS(signorini_surface_pair(2, 6, places, &slave, &master, &settings, &contact), 0);
            const double *normal = surface_data(contact).normals;
            CHECK(surface_data(contact).nodes[0] == 1);
            /* By dual mortar the side, which lies over nothing, has no say. */
            const int of_face =
                settings.normals == SIGNORINI_NORMALS_FACES || pairing == SIGNORINI_PAIRING_DUAL_MORTAR;
            CHECK_NEAR(normal[0], of_face ? 0 : -sqrt(0.5));
            CHECK_NEAR(normal[1], of_face ? -1 : -sqrt(0.5));
            signorini_surface_free(contact);
        }
    }
    /* Nine tenths of the last face are covered, and .81 of the node at its end; a tenth, and a hundredth. */
    const double ends[] = {1.18, 1.02};
    double moved[12];
    memcpy(moved, places, sizeof moved);
    for (int little = 0; little < 2; little++) {
        moved[10] = ends[little];
        for (int32_t rims = 0; rims < 3; rims++) {
            signorini_surface_settings settings = defaults();
            settings.search_distance = 0.5;
            settings.rims = rims;
            CHECK_STATUS(signorini_surface_pair(2, 6, moved, &slave, &master, &settings, &contact), 0);
            const signorini_surface_data report = surface_data(contact);
            const int gone = little && rims != SIGNORINI_RIMS_KEEP;
            CHECK(report.pairs == (gone ? 2 : 3) && report.n_unpaired == (gone ? 2 : 1));
            CHECK(report.n_folded == gone);
            if (gone) CHECK_NEAR(report.folded_distances[0], 0.2);
            if (gone) CHECK(surface_data(contact).unpaired[1] == 3);
            const double c = little ? 0.1 : 0.9, area = 0.1 * c * c;
            CHECK_NEAR(report.covered_area, 1 + 0.2 * c);
            if (!gone) CHECK_NEAR(surface_data(contact).areas[2], area);
            signorini_surface_free(contact);
        }
    }
}

/* Counts the calls and cancels at the second argument of the pairing. */
static int32_t counted(void *user, const signorini_progress *progress)
{
    int *calls = user;
    CHECK(progress->reduced >= 0 && progress->reduced <= 1);
    return ++*calls > 0;
}

/* A callback and a limit of time end a pairing; a master beyond the search distance is told; rings have areas. */
static void limits_and_rings(void)
{
    static const int64_t line_nodes[] = {0, 1}, floor_nodes[] = {3, 2};
    const double x[] = {0, 0, 1, 0, 0, 0, 1, 0}, apart[] = {0, 9, 1, 9, 0, 0, 1, 0};
    const signorini_faces slave = lines(1, line_nodes), master = lines(1, floor_nodes);
    const signorini_obstacle floor = {.struct_size = sizeof floor, .kind = SIGNORINI_OBSTACLE_PLANE,
                                      .direction = {0, 1}};
    signorini_surface_settings settings = defaults();
    signorini_surface_pairs *contact;
    int calls = 0;
    settings.progress = counted;
    settings.user = &calls;
    CHECK_STATUS(signorini_surface_pair(2, 4, x, &slave, &master, &settings, &contact), SIGNORINI_STATUS_CANCELLED);
    CHECK(calls == 1 && contact == NULL);
    CHECK_TEXT(signorini_last_error(), "% of the pairing done");
    CHECK_STATUS(signorini_surface_pair_obstacle(2, 4, x, &slave, &floor, &settings, &contact),
                 SIGNORINI_STATUS_CANCELLED);
    settings = defaults();
    settings.time_limit = 1e-12;
    CHECK_STATUS(signorini_surface_pair(2, 4, x, &slave, &master, &settings, &contact), SIGNORINI_STATUS_TIME_LIMIT);
    settings = defaults();
    CHECK_STATUS(signorini_surface_pair(2, 4, apart, &slave, &master, &settings, &contact), 0);
    CHECK(surface_data(contact).n_beyond == 1 && surface_data(contact).beyond[0] == 0);
    CHECK_NEAR(surface_data(contact).beyond_distances[0], 9);
    CHECK_TEXT(surface_data(contact).summary, "1 slave faces point at a master beyond the search distance");
    signorini_surface_free(contact);
    settings.axisymmetric = 1;
    CHECK_STATUS(signorini_surface_pair(2, 4, x, &slave, &master, &settings, &contact), 0);
    /* A disc of the radius 1: 2 pi times the integrals of (1 - r) r and of r r. */
    CHECK_NEAR(surface_data(contact).areas[0], acos(-1) / 3);
    CHECK_NEAR(surface_data(contact).areas[1], 2 * acos(-1) / 3);
    CHECK(surface_data(contact).on_symmetry == 1 && surface_data(contact).n_beyond == 0);
    signorini_surface_free(contact);
}

static void obstacles(void)
{
    const signorini_faces slave = lines(1, line);
    signorini_surface_settings settings = defaults();
    signorini_obstacle floor = {.struct_size = sizeof floor, .kind = SIGNORINI_OBSTACLE_PLANE,
                                .point = {3, -1, NAN}, .direction = {0, 4, NAN}};
    signorini_obstacle disc = {.struct_size = sizeof disc, .kind = SIGNORINI_OBSTACLE_SPHERE,
                               .point = {0.5, -1.1}, .radius = 1};
    signorini_surface_pairs *contact;
    CHECK_STATUS(signorini_surface_pair_obstacle(2, 5, plane_nodes, &slave, &floor, NULL, &contact), 0);
    CHECK(surface_data(contact).pairs == 2);
    CHECK_NEAR(surface_data(contact).gaps[1], 1.1);
    signorini_surface_free(contact);
    settings.search_distance = INFINITY;
    CHECK_STATUS(signorini_surface_pair_obstacle(2, 5, plane_nodes, &slave, &disc, &settings,
                                                 &contact), 0);
    /* The nodes are (+-0.5, 1.2) from the centre: 1.3 away. */
    CHECK_NEAR(surface_data(contact).gaps[0], 0.3);
    CHECK_NEAR(surface_data(contact).normals[1], -12.0 / 13);
    signorini_surface_free(contact);
    settings.search_distance = 1;
    CHECK_STATUS(signorini_surface_pair_obstacle(2, 5, plane_nodes, &slave, &floor, &settings,
                                                 &contact), 0);
    CHECK(surface_data(contact).pairs == 0);
    signorini_surface_free(contact);

    settings.clearance = -0.5;
    CHECK_STATUS(signorini_surface_pair_obstacle(2, 5, plane_nodes, &slave, &disc, &settings, &contact), 0);
    CHECK_NEAR(surface_data(contact).gaps[0], 0.3 - 0.5);
    signorini_surface_free(contact);
    settings.clearance = NAN;
    CHECK_STATUS(signorini_surface_pair_obstacle(2, 5, plane_nodes, &slave, &disc, &settings, &contact), -6);

    CHECK_STATUS(signorini_surface_pair_obstacle(2, 5, plane_nodes, &slave, NULL, NULL, &contact), -5);
    disc.radius = -1;
    CHECK_STATUS(signorini_surface_pair_obstacle(2, 5, plane_nodes, &slave, &disc, NULL, &contact), -5);
    CHECK_TEXT(signorini_last_error(), "radius is -1");
    disc.kind = SIGNORINI_OBSTACLE_CYLINDER;
    CHECK_STATUS(signorini_surface_pair_obstacle(2, 5, plane_nodes, &slave, &disc, NULL, &contact), -5);
    disc.kind = 9;
    CHECK_STATUS(signorini_surface_pair_obstacle(2, 5, plane_nodes, &slave, &disc, NULL, &contact), -5);
    CHECK_TEXT(signorini_last_error(), "there is no kind 9");
    floor.reserved = 2;
    CHECK_STATUS(signorini_surface_pair_obstacle(2, 5, plane_nodes, &slave, &floor, NULL, &contact), -5);
    CHECK_TEXT(signorini_last_error(), "obstacle: reserved is 2, it must be 0");
}

/* Two lines as facets of circles about one centre: the difference of the radii. */
static void true_shapes(void)
{
    /* The lower body is inside of the circle of the radius 5, the upper one outside of that of 5.25. */
    const double x[] = {-3, 4, 3, 4, -4.2, 3.15, 4.2, 3.15};
    const int64_t inner[2] = {1, 0}, outer[2] = {2, 3};
    signorini_faces slave = lines(1, inner), master = lines(1, outer);
    signorini_surface_settings settings = defaults();
    signorini_obstacle circles[2];
    signorini_surface_pairs *contact;
    for (int side = 0; side < 2; side++)
        circles[side] = (signorini_obstacle){.struct_size = sizeof *circles, .radius = 5 + 0.25 * side,
                                             .kind = SIGNORINI_OBSTACLE_SPHERE, .point = {0, 0, NAN}};
    settings.slave_shape = &circles[0];
    settings.master_shape = &circles[1];
    CHECK_STATUS(signorini_surface_pair(2, 4, x, &slave, &master, &settings, &contact), 0);
    CHECK(surface_data(contact).pairs == 2);
    CHECK_NEAR(surface_data(contact).gaps[0], 0.25);
    signorini_surface_free(contact);
    settings.close_within = 0.3;
    settings.clearance = 0.125;
    CHECK_STATUS(signorini_surface_pair(2, 4, x, &slave, &master, &settings, &contact), 0);
    CHECK(surface_data(contact).gaps[1] == 0.125);
    signorini_surface_free(contact);
    circles[1].radius = 50;
    CHECK_STATUS(signorini_surface_pair(2, 4, x, &slave, &master, &settings, &contact), -6);
    CHECK_TEXT(signorini_last_error(), "shape of the master: node 2 of face 0 is ");
    CHECK_TEXT(signorini_last_error(), " of the face's size away from it: leave that face out");
    circles[1].kind = SIGNORINI_OBSTACLE_FACES;
    CHECK_STATUS(signorini_surface_pair(2, 4, x, &slave, &master, &settings, &contact), -6);
    CHECK_TEXT(signorini_last_error(), "master_shape: faces are no shape");
    circles[1].kind = SIGNORINI_OBSTACLE_SPHERE;
    settings.master_shape = NULL;
    settings.slave_shape = NULL;
    settings.close_within = settings.clearance = 0;
    settings.fitted = 1;
    /* Four chords of up to 21 degrees inside of six: arcs are off by the sixth power of half of that. */
    const double circle[7][2] = {{-4, 3}, {-3, 4}, {-1.4, 4.8}, {0, 5}, {1.4, 4.8}, {3, 4}, {4, 3}};
    int64_t inside[4][2], outside[6][2];
    double more[12][2];
    for (int i = 0; i < 7; i++)
        for (int axis = 0; axis < 2; axis++) {
            more[i][axis] = 1.05 * circle[i][axis];
            if (i < 5)
                more[7 + i][axis] = circle[1 + i][axis];
        }
    for (int i = 0; i < 6; i++) {
        outside[i][0] = i;
        outside[i][1] = i + 1;
        if (i < 4) {
            inside[i][0] = 8 + i;
            inside[i][1] = 7 + i;
        }
    }
    signorini_faces within = lines(4, inside[0]), around = lines(6, outside[0]);
    CHECK_STATUS(signorini_surface_pair(2, 12, more[0], &within, &around, &settings, &contact), 0);
    for (int pair = 0; pair < 5; pair++)
        CHECK(fabs(surface_data(contact).gaps[pair] - 0.25) < 5 * pow(0.18, 6));
    signorini_surface_free(contact);
    settings.close_within = -1;
    CHECK_STATUS(signorini_surface_pair(2, 4, x, &slave, &master, &settings, &contact), -6);
    CHECK_TEXT(signorini_last_error(), "close_within is -1");
}

/* The lower line as a rigid one, with numbers of its own: the gaps of the two lines, no masters, and
 * what is wrong with it is named by these numbers. */
static void rigid_faces(void)
{
    const double places[] = {2, 0, 0.5, 0, -1, 0}, not_finite[] = {2, 0, 0.5, NAN, -1, 0};
    const int64_t nodes[] = {0, 1, 1, 2}, one_based[] = {1, 2, 2, 3}, slave_one[] = {1, 2};
    const int64_t missing[] = {0, 1, 1, 3};
    const signorini_faces slave = lines(1, line);
    signorini_faces faces = lines(2, nodes);
    signorini_surface_settings settings = defaults();
    signorini_obstacle rigid = {.struct_size = sizeof rigid, .kind = SIGNORINI_OBSTACLE_FACES,
                                .nodes = 3, .coordinates = places, .faces = &faces};
    signorini_surface_pairs *contact;
    for (int base = 0; base < 2; base++) {
        const signorini_faces own = lines(1, base == 0 ? line : slave_one);
        settings.index_base = base;
        faces.nodes = base == 0 ? nodes : one_based;
        CHECK_STATUS(signorini_surface_pair_obstacle(2, 5, plane_nodes, &own, &rigid, &settings,
                                                     &contact), 0);
        CHECK(surface_data(contact).pairs == 2);
        CHECK_NEAR(surface_data(contact).gaps[0], 0.1);
        CHECK_NEAR(surface_data(contact).areas[1], 0.5);
        /* A row has the slave alone. */
        CHECK(surface_data(contact).rows->row_start[2] == 2 + base);
        signorini_surface_free(contact);
    }
    faces.nodes = missing;
    CHECK_STATUS(signorini_surface_pair_obstacle(2, 5, plane_nodes, &slave, &rigid, NULL, &contact), -5);
    CHECK_TEXT(signorini_last_error(), "obstacle face 1 has node 3, the coordinates");
    faces.nodes = nodes;
    rigid.coordinates = not_finite;
    CHECK_STATUS(signorini_surface_pair_obstacle(2, 5, plane_nodes, &slave, &rigid, NULL, &contact), -5);
    CHECK_TEXT(signorini_last_error(), "coordinates[3] of node 1 in obstacle face 0 is not finite");
    rigid.coordinates = NULL;
    CHECK_STATUS(signorini_surface_pair_obstacle(2, 5, plane_nodes, &slave, &rigid, NULL, &contact), -5);
    CHECK_TEXT(signorini_last_error(), "obstacle: coordinates is NULL");
    rigid.coordinates = places;
    rigid.faces = NULL;
    CHECK_STATUS(signorini_surface_pair_obstacle(2, 5, plane_nodes, &slave, &rigid, NULL, &contact), -5);
    CHECK_TEXT(signorini_last_error(), "obstacle: faces is NULL");
    rigid.reserved = 2;
    CHECK_STATUS(signorini_surface_pair_obstacle(2, 5, plane_nodes, &slave, &rigid, NULL, &contact), -5);
    CHECK_TEXT(signorini_last_error(), "obstacle: reserved is 2, it must be 0");
}

/* Surfaces that never meet are no error, and the sentence says why. */
static void never_meet(void)
{
    const double far_nodes[] = {0, 5, 1, 5, -1, 0, 0.5, 0, 2, 0};
    const int64_t turned[] = {1, 0};
    const signorini_faces slave = lines(1, line), master = lines(2, below), over = lines(1, turned);
    signorini_surface_pairs *contact;
    CHECK_STATUS(signorini_surface_pair(2, 5, far_nodes, &slave, &master, NULL, &contact), 0);
    const signorini_surface_data told = surface_data(contact);
    CHECK(surface_data(contact).pairs == 0 && told.n_unpaired == 2 && told.n_uncovered == 1);
    CHECK(surface_data(contact).uncovered[0] == 0 && surface_data(contact).unpaired[1] == 1);
    CHECK(surface_data(contact).gaps == NULL && surface_data(contact).folded == NULL);
    CHECK_TEXT(surface_data(contact).summary, "no pairs: nothing lies opposite the 1 slave");
    signorini_surface_free(contact);
    CHECK_STATUS(signorini_surface_pair(2, 5, plane_nodes, &over, &master, NULL, &contact), 0);
    CHECK_TEXT(surface_data(contact).summary, "one side is turned over");
    signorini_surface_free(contact);
}

/* ---- Refusals ------------------------------------------------------------------------------ */

static void refused(const double *nodes, const signorini_faces *slave, const signorini_faces *master,
                    const signorini_surface_settings *settings, int argument, const char *part)
{
    signorini_surface_pairs *contact = (signorini_surface_pairs *)&checks_done;
    CHECK_STATUS(signorini_surface_pair(2, 5, nodes, slave, master, settings, &contact),
                 -argument);
    CHECK(contact == NULL);
    CHECK_TEXT(signorini_last_error(), part);
}

static void refusals(void)
{
    const double nan_nodes[] = {0, NAN, 1, 0.1, -1, 0, 0.5, 0, 2, 0};
    const double no_area[] = {0, 0.1, 0, 0.1, -1, 0, 0.5, 0, 2, 0};
    const int64_t twice[] = {1, 1}, missing[] = {0, 5}, negative[] = {0, -1}, shared[] = {1, 3};
    const int64_t descending[] = {0, 2, 1};
    signorini_faces slave = lines(1, line), master = lines(2, below), wrong = slave;
    signorini_surface_settings settings = defaults();
    signorini_surface_pairs *contact;

    refused(nan_nodes, &slave, &master, NULL, 3,
            "coordinates[1] of node 0 in slave face 0 is not finite");
    refused(no_area, &slave, &master, NULL, 4, "slave face 0 has no area");
    wrong.nodes = twice;
    refused(plane_nodes, &wrong, &master, NULL, 4, "slave face 0 has node 1 twice");
    wrong.nodes = missing;
    refused(plane_nodes, &slave, &wrong, NULL, 5, "master face 0 has node 5, the coordinates");
    wrong.nodes = negative;
    refused(plane_nodes, &slave, &wrong, NULL, 5, "master: nodes[1] is -1");
    wrong.nodes = shared;
    refused(plane_nodes, &slave, &wrong, NULL, 5, "has node 1, which is on the slave side too");
    wrong = master;
    wrong.start = descending;
    refused(plane_nodes, &slave, &wrong, NULL, 5, "start is given, and face_nodes too");
    wrong.face_nodes = 0;
    refused(plane_nodes, &slave, &wrong, NULL, 5, "master: start[2] is less than start[1]");
    wrong = slave;
    wrong.face_nodes = 0;
    refused(plane_nodes, &wrong, &master, NULL, 4, "face_nodes is 0");
    wrong.face_nodes = 1;
    refused(plane_nodes, &wrong, &master, NULL, 4, "slave face 0 has 1 nodes, a face has 2 or 3");
    wrong.struct_size = 8;
    refused(plane_nodes, &wrong, &master, NULL, 4, "struct_size is 8");
    refused(plane_nodes, NULL, &master, NULL, 4, "slave is NULL");
    refused(NULL, &slave, &master, NULL, 3, "coordinates is NULL");
    settings.search_distance = -1;
    refused(plane_nodes, &slave, &master, &settings, 6, "search_distance is -1");
    settings = defaults();
    settings.pairing = 2;
    refused(plane_nodes, &slave, &master, &settings, 6, "there is no pairing 2");
    settings = defaults();
    settings.normals = 2;
    refused(plane_nodes, &slave, &master, &settings, 6, "there is no choice of normals 2");
    settings = defaults();
    settings.rims = -1;
    refused(plane_nodes, &slave, &master, &settings, 6, "there is no choice of rims -1");
    settings.rims = SIGNORINI_RIMS_KEEP;
    settings.pairing = SIGNORINI_PAIRING_NODE_TO_SURFACE;
    refused(plane_nodes, &slave, &master, &settings, 6, "rims: nodes against surfaces have no cover");
    settings = defaults();
    settings.time_limit = -1;
    refused(plane_nodes, &slave, &master, &settings, 6, "time_limit is -1");
    settings = defaults();
    settings.fitted = 1;
    settings.pairing = SIGNORINI_PAIRING_NODE_TO_SURFACE;
    refused(plane_nodes, &slave, &master, &settings, 6, "true shapes are for dual mortar");
    settings = defaults();
    settings.dofs_per_node = 1;
    refused(plane_nodes, &slave, &master, &settings, 6, "dofs_per_node is 1");
    settings = defaults();
    settings.index_base = 2;
    refused(plane_nodes, &slave, &master, &settings, 6, "index_base is 2");
    const int32_t axes[] = {0, 2};
    const double places[] = {0, 0};
    settings = defaults();
    settings.symmetry_planes = -1;
    refused(plane_nodes, &slave, &master, &settings, 6, "symmetry_planes is -1");
    settings.symmetry_planes = 2;
    refused(plane_nodes, &slave, &master, &settings, 6, "symmetry_axes is NULL");
    settings.symmetry_axes = axes;
    refused(plane_nodes, &slave, &master, &settings, 6, "symmetry_at is NULL");
    settings.symmetry_at = places;
    refused(plane_nodes, &slave, &master, &settings, 6, "plane of symmetry 1: there is no axis 2");
    settings.index_base = 1;
    refused(plane_nodes, &slave, &master, &settings, 6, "symmetry_axes has 0, there is no such axis");
    const double across[] = {1, 0, 0, 0};
    settings = defaults();
    settings.symmetry_planes = 2;
    settings.symmetry_normals = across;
    refused(plane_nodes, &slave, &master, &settings, 6, "symmetry_at is NULL");
    settings.symmetry_at = places;
    refused(plane_nodes, &slave, &master, &settings, 6, "plane of symmetry 1: its normal 0, 0, 0 is no direction");
    settings = defaults();
    settings.sectors = -1;
    refused(plane_nodes, &slave, &master, &settings, 6, "sectors is -1");
    settings.sectors = 4;
    refused(plane_nodes, &slave, &master, &settings, 6, "sector_point is NULL");
    settings.sector_point = places;
    settings.axisymmetric = 1;
    refused(plane_nodes, &slave, &master, &settings, 6, "axisymmetric: a body of revolution has no sector");
    CHECK_STATUS(signorini_surface_pair(4, 5, plane_nodes, &slave, &master, NULL, &contact), -1);
    CHECK_STATUS(signorini_surface_pair(2, -5, plane_nodes, &slave, &master, NULL, &contact),
                 -2);
    CHECK_STATUS(signorini_surface_pair(2, 5, plane_nodes, &slave, &master, NULL, NULL), -7);
    signorini_surface_data data = {.struct_size = sizeof data};
    CHECK_STATUS(signorini_surface_view(NULL, &data), -1);
    CHECK_TEXT(signorini_last_error(), "contact is NULL");
    CHECK(data.pairs == 0 && data.rows == NULL);
    signorini_surface_free(NULL);
}

/*
 * A plane of symmetry by its direction is that by its axis. A sector whose neighbours are far away has the rows of the part
 * itself, by degree of freedom.
 */
static void planes_by_directions(void)
{
    const signorini_faces slave = lines(1, line), master = lines(2, below);
    const int32_t axes[] = {0};
    const double places[] = {0}, across[] = {2, 0}, point[] = {0, -50};
    signorini_surface_settings settings = defaults();
    signorini_surface_data by_axis = {.struct_size = sizeof by_axis}, other = by_axis;
    signorini_surface_pairs *contact, *same;

    settings.symmetry_planes = 1;
    settings.symmetry_axes = axes;
    settings.symmetry_at = places;
    CHECK_STATUS(signorini_surface_pair(2, 5, plane_nodes, &slave, &master, &settings, &contact), 0);
    CHECK_STATUS(signorini_surface_view(contact, &by_axis), 0);
    settings.symmetry_axes = NULL;
    settings.symmetry_normals = across;
    CHECK_STATUS(signorini_surface_pair(2, 5, plane_nodes, &slave, &master, &settings, &same), 0);
    CHECK_STATUS(signorini_surface_view(same, &other), 0);
    const int64_t entries = by_axis.rows->row_start[by_axis.pairs];
    CHECK(other.pairs == 2 && by_axis.pairs == 2 && other.on_symmetry == 1 && by_axis.on_symmetry == 1);
    CHECK(memcmp(other.rows->row_nodes, by_axis.rows->row_nodes, 2 * (size_t)entries * sizeof(int64_t)) == 0);
    CHECK(memcmp(other.rows->row_weights, by_axis.rows->row_weights, (size_t)entries * sizeof(double)) == 0);
    signorini_surface_free(same);

    /* A sector whose neighbours are far away: the rows of before, with the weight of a node in the place of each axis. */
    settings = defaults();
    settings.sectors = 4;
    settings.sector_point = point;
    CHECK_STATUS(signorini_surface_pair(2, 5, plane_nodes, &slave, &master, NULL, &same), 0);
    CHECK_STATUS(signorini_surface_view(same, &by_axis), 0);
    signorini_surface_free(contact);
    CHECK_STATUS(signorini_surface_pair(2, 5, plane_nodes, &slave, &master, &settings, &contact), 0);
    CHECK_STATUS(signorini_surface_view(contact, &other), 0);
    CHECK(other.rows->row_weights == NULL && other.pairs == by_axis.pairs);
    /* Means over three sectors, to rounding. */
    CHECK(fabs(other.slave_area - by_axis.slave_area) < 1e-15 && fabs(other.covered_area - by_axis.covered_area) < 1e-15);
    for (int64_t k = 0; k < by_axis.rows->row_start[by_axis.pairs]; k++) {
        for (int axis = 0; axis < 2; axis++) {
            const double *vector = other.rows->row_vectors + 4 * k + 2 * axis;
            CHECK(other.rows->row_nodes[2 * k + axis] == by_axis.rows->row_nodes[2 * k + axis]);
            CHECK(vector[axis] == by_axis.rows->row_weights[k] && vector[1 - axis] == 0);
        }
    }
    signorini_surface_free(contact);
    signorini_surface_free(same);
}

/* Faults of the calls after the solution. */
static void refused_results(void)
{
    const signorini_faces slave = lines(1, line), master = lines(2, below);
    const double d[4] = {0}, F[4] = {0};
    double pressure[5];
    int32_t of_node[5];
    signorini_surface_pairs *contact;
    signorini_contact_fields fields = {.struct_size = sizeof fields, .pressure = pressure};
    signorini_mesh mesh = {.struct_size = sizeof mesh, .dim = 2, .nodes = 5,
                           .coordinates = plane_nodes, .cells = 2, .cell_type = 3,
                           .cell_nodes = below};
    CHECK_STATUS(signorini_surface_pair(2, 5, plane_nodes, &slave, &master, NULL, &contact), 0);
    CHECK_STATUS(signorini_surface_fields(contact, NULL, NULL, d, NULL, NULL, &fields), -5);
    CHECK_STATUS(signorini_surface_fields(contact, NULL, NULL, d, F, NULL, NULL), -7);
    CHECK_STATUS(signorini_surface_fields(NULL, NULL, NULL, d, F, NULL, &fields), -1);
    fields.state = of_node;
    CHECK_STATUS(signorini_surface_fields(contact, NULL, NULL, d, F, NULL, &fields), -6);
    const int32_t state[2] = {1, 9};
    CHECK_STATUS(signorini_surface_fields(contact, NULL, NULL, d, F, state, &fields), -6);
    CHECK_TEXT(signorini_last_error(), "state[1] is 9, it must be 0, 1 or 2");
    fields.state = NULL;
    const double no_number[4] = {0, NAN, 0, 0};
    CHECK_STATUS(signorini_surface_fields(contact, no_number, NULL, d, F, NULL, &fields), -2);
    CHECK_TEXT(signorini_last_error(), "gap[1] is NaN, it must be a number or +inf");
    CHECK_STATUS(signorini_surface_fields(contact, NULL, no_number, d, F, NULL, &fields), -3);
    CHECK_TEXT(signorini_last_error(), "slip0[1] is not finite");
    CHECK_STATUS(signorini_surface_fields(contact, NULL, NULL, no_number, F, NULL, &fields), -4);
    CHECK_TEXT(signorini_last_error(), "d[1] is not finite");
    CHECK_STATUS(signorini_surface_fields(contact, NULL, NULL, d, no_number, NULL, &fields), -5);
    CHECK_TEXT(signorini_last_error(), "F[1] is not finite");
    signorini_resultant sums = {.struct_size = sizeof sums};
    CHECK_STATUS(signorini_surface_resultant(contact, no_number, d, F, NULL, &sums), -2);
    CHECK_STATUS(signorini_surface_resultant(contact, NULL, no_number, F, NULL, &sums), -3);
    CHECK_STATUS(signorini_surface_resultant(contact, NULL, d, no_number, NULL, &sums), -4);
    CHECK_STATUS(signorini_surface_resultant(contact, NULL, d, F, no_number, &sums), -5);
    CHECK_TEXT(signorini_last_error(), "point[1] is not finite");
    CHECK_STATUS(signorini_surface_resultant(contact, NULL, d, F, NULL, NULL), -6);
    CHECK_STATUS(signorini_surface_penetration(contact, NULL, NULL), -2);
    CHECK_STATUS(signorini_surface_adjust(contact, 1, NULL), -3);
    /* The line 0.1 above comes down; what is further apart than `within` stays. */
    double moved[10];
    for (int k = 0; k < 3; k++) {
        const double within[3] = {-1, 0.05, 0.2};
        memcpy(moved, plane_nodes, sizeof moved);
        CHECK_STATUS(signorini_surface_adjust(contact, within[k], moved), k == 0 ? -2 : 0);
        for (int i = 0; i < 10; i++)
            CHECK_NEAR(moved[i], k == 2 && (i == 1 || i == 3) ? 0 : plane_nodes[i]);
    }
    mesh.nodes = 4;
    const signorini_zone zone = {.struct_size = sizeof zone, .contact = contact, .d = d, .F = F};
    CHECK_STATUS(signorini_mesh_write("x.vtu", &mesh, NULL, 1, &zone, 0, NULL), -5);
    CHECK_TEXT(signorini_last_error(), "pairs are of 5 nodes of dim 2, the mesh has 4 nodes");
    mesh.nodes = 5;
    const signorini_zone other = {.struct_size = sizeof other, .contact = contact, .d = d, .F = F, .state = state};
    CHECK_STATUS(signorini_mesh_write("x.vtu", &mesh, NULL, 1, &other, 0, NULL), -5);
    CHECK_TEXT(signorini_last_error(), "state[1] is 9, it must be 0, 1 or 2");
    mesh.nodes = 4;
    CHECK_STATUS(signorini_mesh_write("x.vtu", &mesh, NULL, 0, NULL, 0, NULL), -2);
    CHECK_TEXT(signorini_last_error(), "cell 0 has node 4");
    mesh.nodes = 5;
    mesh.cell_type = 42;
    CHECK_STATUS(signorini_mesh_write("x.vtu", &mesh, NULL, 0, NULL, 0, NULL), -2);
    mesh.cell_type = 3;
    signorini_field own = {.struct_size = sizeof own, .components = 3, .name = "own", .values = d};
    CHECK_STATUS(signorini_mesh_write("x.vtu", &mesh, NULL, 0, NULL, 1, &own), -7);
    CHECK_TEXT(signorini_last_error(), "own has 3 components");
    signorini_surface_free(contact);
}

/* A line 0.1 above another one, with nothing between them, moves down by 0.3: both its nodes and its middle are 0.2 deep. A
 * shorter line of another zone, 0.3 above, moves by 0.8, and is 0.5 deep. */
static void penetration(void)
{
    static const double x[14] = {0, 0.1, 1, 0.1, -1, 0, 0.5, 0, 2, 0, 0.2, 0.3, 0.8, 0.3}, still[14];
    static const double down[14] = {0, -0.3, 0, -0.3}, both[14] = {0, -0.3, 0, -0.3, 0, 0, 0, 0, 0, 0, 0, -0.8, 0, -0.8};
    const int64_t above[2][2] = {{1, 2}, {6, 7}}, below[4] = {5, 4, 4, 3};
    const signorini_faces master = {.struct_size = sizeof master, .face_nodes = 2, .count = 2, .nodes = below};
    const char *const name[2] = {"lower", "upper"};
    signorini_penetration found = {.struct_size = sizeof found};
    signorini_surface_pairs *contact[2], *joined = NULL;
    signorini_contact_zone zones[2];
    signorini_surface_settings settings;
    CHECK_STATUS(signorini_surface_settings_default(&settings, sizeof settings), 0);
    settings.search_distance = 0.05;
    settings.index_base = 1;
    for (int i = 0; i < 2; i++) {
        const signorini_faces slave = {.struct_size = sizeof slave, .face_nodes = 2, .count = 1, .nodes = above[i]};
        CHECK_STATUS(signorini_surface_pair(2, 7, x, &slave, &master, &settings, &contact[i]), 0);
        CHECK(surface_data(contact[i]).pairs == 0);
        zones[i] = (signorini_contact_zone){.struct_size = sizeof zones[i], .contact = contact[i], .name = name[i]};
    }
    CHECK_STATUS(signorini_surface_join(2, zones, &joined), 0);
    signorini_surface_free(contact[1]);
    for (int i = 0; i < 2; i++) {
        const signorini_surface_pairs *const asked = i ? joined : contact[0];
        CHECK_STATUS(signorini_surface_penetration(asked, still, &found), 0);
        CHECK(found.points == 0 && found.depth == 0 && found.face == -1 && found.node == -1 && found.zone == 0);
        CHECK_STATUS(signorini_surface_penetration(asked, down, &found), 0);
        CHECK(found.points == 3 && found.face == 1 && found.master_face > 0 && found.zone == 0);
        CHECK_NEAR(found.depth, 0.2);
        CHECK_NEAR(found.point[1], -0.2);
        CHECK_STATUS(signorini_surface_penetration(asked, down, NULL), -3);
        const double nowhere[14] = {0, NAN};
        CHECK_STATUS(signorini_surface_penetration(asked, nowhere, &found), -2);
        if (i == 0)
            signorini_surface_free(contact[0]);
    }
    CHECK_STATUS(signorini_surface_penetration(joined, both, &found), 0);
    CHECK(found.points == 6 && found.face == 1 && found.zone == 1);
    CHECK_NEAR(found.depth, 0.5);
    signorini_surface_free(joined);
}

int main(void)
{
    patch(0);
    patch(1);
    numbers();
    choices();
    obstacles();
    limits_and_rings();
    true_shapes();
    rigid_faces();
    never_meet();
    penetration();
    refusals();
    planes_by_directions();
    refused_results();
    return check_summary("surfaces");
}
