/*
 * signorini: contact pairs from surfaces.
 *
 * Without a contact search of your own: hand over coordinates and faces. The library finds what
 * lies opposite, integrates, and makes the pairs of signorini.h.
 *
 *     signorini_surface_data data = {sizeof data};
 *     signorini_surface_pair(3, nodes, x, &slave, &master, NULL, &contact);
 *     signorini_surface_view(contact, &data);
 *     signorini_model_new_sparse(&K, n_fixed, fixed, data.rows, NULL, &model);
 *     signorini_model_solve(model, 1, f, NULL, data.gaps, ...);
 *     signorini_zone zone = {sizeof zone, 0, contact, NULL, NULL, d, F, state};
 *     signorini_mesh_write("contact.vtu", &mesh, u, 1, &zone, 0, NULL);
 *
 * A quadratic slave face has pairs of nodes with weights: use data.rows as they are. Several
 * contact zones: make pairs for each, and join them by signorini_surface_join.
 */

#ifndef SIGNORINI_SURFACE_H
#define SIGNORINI_SURFACE_H

#include "signorini.h"

#ifdef __cplusplus
extern "C" {
#endif

/* How surfaces are paired. */
/** Dual mortar, the default: a uniform pressure passes between any two flat meshes. */
#define SIGNORINI_PAIRING_DUAL_MORTAR 0
/**
 * Each slave node against the point that it meets along its normal. Forces and moments balance;
 * the pressure between meshes that do not match is wrong by some percent.
 */
#define SIGNORINI_PAIRING_NODE_TO_SURFACE 1

/* Kind of a rigid obstacle, or of the true shape of a side. */
#define SIGNORINI_OBSTACLE_PLANE 0    /**< A half space, in 2D a half plane. */
#define SIGNORINI_OBSTACLE_CYLINDER 1 /**< A round bar of any length, 3D only. */
#define SIGNORINI_OBSTACLE_SPHERE 2   /**< A ball, in 2D a disc. */
/** A mesh of faces, such as the triangles of a drawing; in 2D lines. */
#define SIGNORINI_OBSTACLE_FACES 3
#define SIGNORINI_OBSTACLE_CONE 4     /**< A cone that widens from its apex without end, 3D only. */
#define SIGNORINI_OBSTACLE_TORUS 5    /**< A torus, 3D only. */

#ifdef SIGNORINI_UNSTABLE /* These numbers may still change. */

/* Normals of pairs from surfaces. */
/**
 * The default: the mean of the unit normals of all slave faces at the slave node. Dual mortar:
 * without faces around a sharp edge that lie over nothing.
 */
#define SIGNORINI_NORMALS_AVERAGED 0
/**
 * Normals of the faces in contact. Dual mortar: the mean at the slave node over the faces that lie
 * over the master, weighted by the node's area there; around a sharp edge other faces do not turn
 * it. Nodes against surfaces: opposite to the normal of the nearest master face, at the foot of
 * the perpendicular on it; above an edge without one, of the face that the averaged normal meets.
 * Of faces that are equally near it is the mean, where that normal meets them.
 * The choice does not change which nodes have pairs.
 */
#define SIGNORINI_NORMALS_FACES 1

/* Slave nodes at rims, with little of the master over them. */
/**
 * The default. A slave node with less than half of its area over the master, a corner of a face
 * with mid nodes with less than three tenths, gives its row to the nodes of its faces whose covered
 * parts are nearest; if none can take it, it keeps it. Its area is that on all slave faces around
 * it that look the same way. Uniform pressure stays exact, and others are as exact as
 * elsewhere. Where a master is so small or narrow that few nodes have half, and on one line in
 * 3D, nodes with a tenth keep their rows, or as many with less as carry moments. For dual mortar:
 * nodes against surfaces have no cover, and take the default alone.
 */
#define SIGNORINI_RIMS_FOLD 0
/**
 * They keep pairs of their own with small areas. Uniform pressure stays exact; other pressures may
 * be large there, as the rows reach into the air. Below a millionth they are folded all the same.
 */
#define SIGNORINI_RIMS_KEEP 1
/**
 * As SIGNORINI_RIMS_FOLD, of all nodes with less than three tenths of their area: more pairs
 * resolve the rim, and pressures that are not uniform have up to twice the errors there.
 */
#define SIGNORINI_RIMS_FOLD_LITTLE 2

#endif /* SIGNORINI_UNSTABLE */

typedef struct signorini_faces signorini_faces;
typedef struct signorini_obstacle signorini_obstacle;
typedef struct signorini_surface_settings signorini_surface_settings;
typedef struct signorini_surface_data signorini_surface_data;

/**
 * Faces of a surface as lists of nodes: in 2D lines of 2 or 3 nodes; in 3D triangles of 3 or 6 and
 * quadrilaterals of 4, 8 or 9 nodes, in any mixture. Corners come first, in order around the face,
 * then mid nodes, the first one between the first two corners, then the centre. Seen from outside
 * the body the corners run counterclockwise; in 2D the body lies to the left of a line that runs
 * from its first node to its second.
 */
struct signorini_faces {
    uint32_t struct_size; /**< sizeof(signorini_faces). */
    int32_t face_nodes;   /**< Nodes of each face, if start is NULL; else 0. */
    int64_t count;        /**< Number of faces. */
    /**
     * Start of each face in nodes, count + 1 entries from index_base; NULL: all have face_nodes
     * nodes.
     */
    const int64_t *start;
    const int64_t *nodes; /**< The nodes, counted from index_base. */
};

/** A surface that does not deform, or the true shape of a side. Unused numbers are not read. */
struct signorini_obstacle {
    uint32_t struct_size;      /**< sizeof(signorini_obstacle). */
    int32_t kind;              /**< SIGNORINI_OBSTACLE_... */
    /**
     * A point of the plane or of the cylinder's axis, or the centre; in 2D two entries. Cone: the
     * middle of one of its circles.
     */
    double point[3];
    /**
     * Plane: the direction out of the obstacle. Cylinder: its axis. Of any length. Cone: from point
     * to the apex. Torus: its axis, as long as the radius of the circle in the middle of its tube.
     */
    double direction[3];
    /** Radius of the cylinder, of the sphere, of that circle of the cone, or of the torus' tube. */
    double radius;
    int32_t hollow;            /**< Nonzero: the body is inside, as in a bore or a bowl. */
    int32_t reserved;          /**< 0. */
    int64_t nodes;             /**< Faces: number of nodes of the obstacle's own mesh. */
    const double *coordinates; /**< Faces: dim for each node of the obstacle; length. */
    /**
     * Faces: in nodes of the obstacle, from index_base. Seen from the body that may touch them the
     * corners run counterclockwise; in 2D the obstacle lies to the left of a line.
     */
    const signorini_faces *faces;
};

/**
 * How surfaces are paired. Fill it by signorini_surface_settings_default(), then change what you
 * like.
 */
struct signorini_surface_settings {
    uint32_t struct_size;                   /**< sizeof(signorini_surface_settings). */
    int32_t pairing; /**< SIGNORINI_PAIRING_...; default SIGNORINI_PAIRING_DUAL_MORTAR. */
    /**
     * Largest distance along the normal at which surfaces are paired, open or overlapping; length.
     * Default 0. Then surfaces overlap by the size of the largest slave face at most, the largest
     * distance of two of its nodes, and not through the body behind the slave face. Open surfaces
     * are paired up to that size too, or if that is larger to the radius of the smaller side, the
     * largest distance of a node from the mean of its nodes, with mirror images and all sectors:
     * half the diagonal of a rectangle. Of masters behind each other the nearest counts, and over
     * a step or an edge of the master the nearer part alone. An obstacle without faces has no
     * limit.
     */
    double search_distance;
    /**
     * Number of the first node, degree of freedom and entry of start, 0 or 1, here and in the
     * pairs; default 0. Take that of your matrix.
     */
    int32_t index_base;
    /**
     * Degrees of freedom of each node, such as 6, the first dim of which are its displacements;
     * default 0: dim. Not read if node_dofs is given.
     */
    int32_t dofs_per_node;
    /** Displacements of each node, dim for each; default NULL: dofs_per_node * node + axis. */
    const int64_t *node_dofs;
    /**
     * Number of planes of symmetry of a half or quarter model; default 0. Pairs see the mirror
     * images of both sides, and are those of the whole body. A pair whose slave node stands on a
     * plane neither moves nor carries a force across it, and its normal is in the plane. Fix the
     * nodes on the plane across it as without contact. Where a row reaches beyond a plane, and in
     * sectors, rows have row_vectors, not row_weights.
     */
    int64_t symmetry_planes;
    const int32_t *symmetry_axes; /**< The axis across each plane, counted from index_base. */
    const double *symmetry_at;              /**< Where each plane stands along its axis; length. */
    int32_t normals; /**< SIGNORINI_NORMALS_...; default SIGNORINI_NORMALS_AVERAGED. */
    int32_t rims;                           /**< SIGNORINI_RIMS_...; default SIGNORINI_RIMS_FOLD. */
    /**
     * Nonzero: lines in 2D are meridians of bodies of revolution about the axis x = 0, with the
     * radius x >= 0. Areas are those of whole rings, with the factor 2 pi r: hand over stiffness
     * and loads of whole rings too. The axis is a plane of symmetry without being named.
     * Default 0.
     */
    int32_t axisymmetric;
    /**
     * Nonzero: a side without slave_shape or master_shape is curved through its nodes, by normals
     * that are fitted to the nodes around, and to their images at planes of symmetry; where faces
     * turn by more than 35 degrees it stays sharp.
     * Default 0.
     */
    int32_t fitted;
    double time_limit; /**< Most seconds of wall time; default 0, and infinity: no limit. */
    /** Progress callback as in signorini_settings, called often; default NULL. */
    signorini_progress_fn progress;
    void *user;                             /**< First argument of progress; default NULL. */
    /**
     * The true shape of the slave side, of which its faces are facets, for dual mortar; default
     * NULL: its faces, or as fitted says. Gaps are measured to it, and rows stay those of the
     * faces. These tell on which side the body is: hollow has no say.
     */
    const signorini_obstacle *slave_shape;
    const signorini_obstacle *master_shape; /**< That of the master side. */
    /** Gaps of at most this size, open or overlapping, become zero; length; default 0: none. */
    double close_within;
    /**
     * What is added to every gap then: a clearance, or if it is negative an interference, such as
     * half the thicknesses of shells; length; default 0.
     */
    double clearance;
    /**
     * The direction across each plane of symmetry, dim for each, of any length, along which
     * symmetry_at counts from the origin. Default NULL: symmetry_axes. Of nodes on a skewed plane
     * give u . m = 0 as equations.
     */
    const double *symmetry_normals;
    /**
     * The number of sectors of a body that repeats about an axis, of which the mesh is one; default
     * 0: none. Pairs see the neighbours, and are those of the whole body. The nodes of the second
     * boundary are images of those of the first, u = Q u', which you give as equations; the pair of
     * both is at the first. A right-handed turn about the axis leads from the first to the second.
     */
    int64_t sectors;
    const double *sector_point;             /**< A point of the axis, dim coordinates. */
    /** The direction of the axis, 3 entries, of any length; in 2D not read. */
    const double *sector_axis;
    /**
     * In 3D the direction of first tangents, as nearly as the tangent plane of each pair allows,
     * of any length: the angle of orthotropic friction counts from it. Default 0, 0, 0: the axis
     * most across the normals of all pairs, of equal ones the first; where the normal is along it,
     * the axis most across that. At a plane of symmetry one tangent is across the plane.
     */
    double tangent[3];
    /**
     * In the place of sectors, of a body that repeats along a line: the way from the first boundary
     * of the mesh to the second, dim entries; default 0, 0, 0: none. Displacements of both are the
     * same, which you give as equations.
     */
    double period[3];
    /** The way along a second line, of a body that repeats along two; default 0, 0, 0: none. */
    double second_period[3];
    /**
     * Nonzero, for surfaces that are tied: rows keep rigid turns of both bodies, also where facets
     * of curved sides do not fit. Forces of pairs then balance in moments too, and rows have
     * row_vectors, not row_weights. Default 0.
     */
    int32_t keep_turns;
    int32_t reserved;                       /**< 0. */
    /**
     * Number of degrees of freedom that are fixed, and of those that equations derive from fixed
     * ones alone; default 0. Give them with dual mortar where supports hold both sides in one
     * place: a slave node that they hold along its normal, over masters some of which they hold,
     * then has no pair, as at rims. Its force would be any number. It keeps its pair where all
     * around it is held, as of a die, and three tenths of its masters move, and rests where they
     * hold all of these. Of a penetration gaps have the part that moves; where nothing does, it is
     * refused.
     */
    int64_t n_fixed;
    /** These degrees of freedom, numbered as for signorini_model_new_sparse. */
    const int64_t *fixed;
};

/** Fills settings with their defaults; struct_size is sizeof(signorini_surface_settings). */
int32_t signorini_surface_settings_default(signorini_surface_settings *settings,
                                           uint32_t struct_size);

/**
 * Contact pairs that the library made from surfaces. It does not change: several threads may use
 * one at once. It holds copies: your arrays may go once it is made. signorini_surface_free
 * releases it.
 */
typedef struct signorini_surface_pairs signorini_surface_pairs;

/**
 * Makes contact pairs from two surfaces that may touch. signorini_surface_view shows them.
 *
 * Surfaces that never meet are no error: there are no pairs, and data.summary says why. Faces of
 * one side that lie upon each other are refused, as their area would count twice; those of masters
 * with SIGNORINI_PAIRING_DUAL_MORTAR alone. Then a slave face is refused too if masters lie over
 * each other above it; without a search_distance of yours only if they are no further apart than
 * the size of the largest slave face.
 *
 * @param dim          space dimension, 2 or 3
 * @param nodes        number of nodes of your mesh
 * @param coordinates  dim for each node, of all nodes; length
 * @param slave        the side whose nodes become slaves, each with a pressure; better the coarser
 *                     one: pressures of a finer one follow the other side's facets
 * @param master       the other side; its nodes must not be on the slave side
 * @param settings     NULL: the defaults
 * @param contact      out: the pairs; NULL unless 0 is returned
 * @return the status; signorini_last_error names side, face and node
 */
int32_t signorini_surface_pair(int32_t dim, int64_t nodes, const double *coordinates,
                               const signorini_faces *slave, const signorini_faces *master,
                               const signorini_surface_settings *settings,
                               signorini_surface_pairs **contact);

/**
 * Makes contact pairs from a surface and a rigid obstacle. Nodes may lie on either side of the
 * obstacle's surface: the gap is negative inside. An obstacle of faces is paired as a master is,
 * with the same search distance; its nodes are its own.
 *
 * @param dim,nodes,coordinates  as for signorini_surface_pair
 * @param slave     the faces that may touch the obstacle
 * @param obstacle  the obstacle
 * @param settings  NULL: the defaults; pairing, normals, rims, symmetry_... and master_shape are
 *                  for faces alone. slave_shape and fitted tell where mid nodes on chords belong
 * @param contact   out: the pairs; NULL unless 0 is returned
 */
int32_t signorini_surface_pair_obstacle(int32_t dim, int64_t nodes, const double *coordinates,
                                        const signorini_faces *slave,
                                        const signorini_obstacle *obstacle,
                                        const signorini_surface_settings *settings,
                                        signorini_surface_pairs **contact);

/** Releases pairs. NULL is allowed. */
void signorini_surface_free(signorini_surface_pairs *contact);

/**
 * Pairs from surfaces, and the faces and nodes without any. Arrays live as long as the pairs; one
 * without entries is NULL. Nodes and faces are counted from index_base.
 */
struct signorini_surface_data {
    uint32_t struct_size;        /**< sizeof(signorini_surface_data). */
    int32_t dim;                 /**< Space dimension. */
    int64_t pairs;               /**< Number of pairs. */
    const signorini_pairs *rows; /**< The pairs for signorini_model_new_sparse, as general rows. */
    /** Initial gap of each pair; length; negative where the surfaces overlap. */
    const double *gaps;
    const double *areas;         /**< Area of each pair; its pressure is -F_n over this area. */
    const double *normals; /**< Unit normals, dim for each pair, outward from the slave's body. */
    /** First unit tangents, dim for each pair; in 3D as settings.tangent says, and t2 = n x t1. */
    const double *tangents;
    /** Where the force of each pair acts on the slave's body, dim for each. */
    const double *points;
    const int64_t *nodes;        /**< The slave node of each pair, ascending in each zone. */
    /** Number of slave nodes without a pair: nothing lies over them, or they are folded. */
    int64_t n_unpaired;
    const int64_t *unpaired;     /**< These nodes. */
    /** Number of those whose row is in pairs of nodes of their faces, for their little cover. */
    int64_t n_folded;
    /** Each of these nodes with the nearest such neighbour, 2 entries for each. */
    const int64_t *folded;
    /** Number of slave faces that lie over nothing within the search distance. */
    int64_t n_uncovered;
    const int64_t *uncovered;    /**< These faces. */
    const char *summary;         /**< One sentence on what was found, ASCII text for a log. */
    int64_t slave_faces;         /**< Number of slave faces. */
    double slave_area;           /**< Area of the slave faces. */
    /** The part of it that lies over the other side: the areas of all pairs. */
    double covered_area;
    /** The largest open distance that was looked at; summary names that of overlaps. */
    double search_distance;
    /**
     * How often a master face was near a slave with a normal that does not oppose the slave's. If
     * it is not 0 and there are no pairs, one side is turned over.
     */
    int64_t not_opposed;
    int64_t boxes_searched;      /**< Boxes that the search looked at: its cost. */
    int64_t on_symmetry;         /**< Pairs whose slave node stands on a plane of symmetry. */
    /**
     * Number of slave faces that lie over nothing within the search distance, but point at a master
     * beyond it, or overlap one by more: contact there is not seen. Give a larger search_distance
     * if it may come to it.
     */
    int64_t n_beyond;
    const int64_t *beyond;       /**< These faces. */
    /**
     * How far away the nearest master is, one for each of them; length; negative where they
     * overlap.
     */
    const double *beyond_distances;
    /** The distance between a folded node and its neighbour, one for each; length. */
    const double *folded_distances;
    /**
     * Number of zones that signorini_surface_join has joined; else 0. Lists of faces are those of
     * each zone's own pairs then, and empty here.
     */
    int64_t n_zones;
    /** The first pair of each zone, counted from 0, and the number of all pairs: n_zones + 1. */
    const int64_t *zone_start;
    /**
     * Friction for SIGNORINI_LAW_BY_PAIR, 4 numbers for each pair: the law of its zone and its
     * parameters.
     */
    const double *friction;
};

/** Fills data, whose struct_size you set. Its arrays live as long as the pairs. */
int32_t signorini_surface_view(const signorini_surface_pairs *contact,
                               signorini_surface_data *data);

/**
 * Moves slave nodes so that the two points of each pair meet, as little as that takes; of pairs
 * whose points are no further apart than `within`. A tie of curved sides then follows a rigid turn
 * but for little; rows with settings.keep_turns follow it wholly.
 * Of an obstacle the point is where the measured gap ends: close_within and clearance have no say.
 * Assemble your matrix with the moved nodes, and pair again. Where single pairs of quadratic faces
 * count, pair and move a second time before: a tenth is left of the largest.
 *
 * @param contact      the pairs
 * @param within       largest distance that is closed, also +infinity; length
 * @param coordinates  in: those that were paired, dim for each node; out: moved
 */
int32_t signorini_surface_adjust(const signorini_surface_pairs *contact, double within,
                                 double *coordinates);

/* ---- Several contact zones ----------------------------------------------------------------- */

typedef struct signorini_contact_zone signorini_contact_zone;

/** A contact zone for signorini_surface_join. */
struct signorini_contact_zone {
    uint32_t struct_size;                   /**< sizeof(signorini_contact_zone). */
    /**
     * SIGNORINI_LAW_... of its pairs, but for SIGNORINI_LAW_BY_PAIR. A tie closes the gaps that you
     * hand over: 0 ties surfaces where they stand.
     */
    int32_t law;
    const signorini_surface_pairs *contact; /**< Its pairs. */
    const char *name;                       /**< Its name, UTF-8, which no other zone has. */
    /** The parameters of the law, one set for all of its pairs; NULL if it has none. */
    const double *friction;
};

/**
 * Joins the pairs of contact zones: the result has all pairs, one zone after the other, as
 * data.zone_start tells, and data.friction for SIGNORINI_LAW_BY_PAIR. It is an object of its own:
 * the zones may be released. All calls take it, and each zone's own pairs with its part of d, F and
 * state, unless zones cut a smooth surface.
 *
 * A node may be slave in one zone and master in another. A face that is slave in two zones is
 * refused if both have a pair of one of its nodes: pair it once, with the masters of both. A slave
 * node of faces of its own in each of two zones has two pairs at an edge of the body, where their
 * normals are more than 45 degrees apart. Where zones cut a smooth surface it has one pair, the sum
 * of both, in the first zone and with its law, and none in the other one. Then a part of d, F and
 * state belongs to joined pairs alone: the resultant of a zone is that of joined with an F that is
 * 0 at the pairs of other zones.
 *
 * @param n_zones  number of zones, at least 1
 * @param zones    the zones, paired on one mesh with one numbering
 * @param joined   out: the pairs of all zones; NULL unless 0 is returned
 * @return the status; signorini_last_error names zones, face and node
 */
int32_t signorini_surface_join(int64_t n_zones, const signorini_contact_zone *zones,
                               signorini_surface_pairs **joined);

/**
 * Writes a table for a log: of each zone its name, its pairs, how many are open, slip and stick,
 * the force on the slave's body, the area of the pairs that press, and the largest pressure. Pairs
 * that were not joined are one zone.
 *
 * @param joined  the pairs
 * @param d       relative displacements, N
 * @param F       contact forces, N
 * @param state   SIGNORINI_STATE_... of each pair
 * @param text    out: size bytes, ended by a zero byte; what does not fit is left out
 * @param size    at least 1; 160 for each zone and for the head hold names of 40 bytes
 */
int32_t signorini_surface_table(const signorini_surface_pairs *joined, const double *d,
                                const double *F, const int32_t *state, char *text, int64_t size);

/* ---- A solution on the surfaces ------------------------------------------------------------ */

typedef struct signorini_contact_fields signorini_contact_fields;
typedef struct signorini_resultant signorini_resultant;
typedef struct signorini_penetration signorini_penetration;
typedef struct signorini_mesh signorini_mesh;
typedef struct signorini_zone signorini_zone;
typedef struct signorini_field signorini_field;

/**
 * Fields at the nodes of your mesh. Set struct_size, and the pointers of the arrays that you want.
 * A call writes the nodes in pairs of its contact, on both sides, and leaves the others as they
 * are: set them before, and give the same arrays to the calls of all contact zones. Vectors are in
 * the axes of the mesh. A slave node has the values of its pair; other nodes have means over their
 * pairs, weighted by area and the size of their weights.
 */
struct signorini_contact_fields {
    uint32_t struct_size; /**< sizeof(signorini_contact_fields). */
    int32_t reserved;     /**< 0. */
    /** Out: contact pressure, one for each node; positive presses; force / area. */
    double *pressure;
    /** Out: force of the contact on the node's own body over area, dim for each node. */
    double *traction;
    double *clearance;    /**< Out: gap - d_n, one for each node; positive if open; length. */
    /**
     * Out: motion along the surface against the other body since slip0, dim for each node; length.
     */
    double *slip;
    /**
     * Out: SIGNORINI_STATE_..., one for each node: of its pair, or of the pair of its largest
     * share.
     */
    int32_t *state;
};

/**
 * Sums over a contact zone. Set struct_size before the call; the call writes all other fields. Of
 * bodies of revolution they are those of whole rings: of the force its part along the axis is
 * left, and no moment.
 */
struct signorini_resultant {
    uint32_t struct_size; /**< sizeof(signorini_resultant). */
    int32_t reserved;     /**< 0. */
    double force[3]; /**< Force of the contact on the slave's body; in 2D the third entry is 0. */
    double moment[3];     /**< Its moment about the given point; in 2D the third entry alone. */
    /**
     * Work that friction takes in the step, sum of -F_t . (d_t - slip0), with the forces of its
     * end.
     */
    double friction_work;
    double pressed_area;  /**< Area of the pairs that press. */
};

/**
 * Pressure, traction, clearance and slip at the nodes of both sides.
 *
 * @param contact  the pairs
 * @param gap      gaps, one for each pair; NULL: those of the pairs
 * @param slip0    reference slip, dim - 1 for each pair; NULL: zero
 * @param d        relative displacements, N = dim * pairs
 * @param F        contact forces, N
 * @param state    SIGNORINI_STATE_... of each pair; may be NULL if fields->state is
 * @param fields   out: the arrays of the fields
 */
int32_t signorini_surface_fields(const signorini_surface_pairs *contact, const double *gap,
                                 const double *slip0, const double *d, const double *F,
                                 const int32_t *state, const signorini_contact_fields *fields);

/**
 * Resultant of the contact forces on the slave's body, and the work of friction.
 *
 * @param contact,slip0,d,F  as for signorini_surface_fields
 * @param point      the point of the moment, dim coordinates; NULL: the origin
 * @param resultant  out: the sums; set resultant->struct_size before
 */
int32_t signorini_surface_resultant(const signorini_surface_pairs *contact, const double *slip0,
                                    const double *d, const double *F, const double *point,
                                    signorini_resultant *resultant);

/**
 * What has passed through. Set struct_size before the call; the call writes all other fields.
 * Faces and nodes are counted as yours; -1: none.
 */
struct signorini_penetration {
    uint32_t struct_size; /**< sizeof(signorini_penetration). */
    /**
     * Number of slave nodes and of middles of slave faces that have passed through, and of nodes
     * of the master through other slave faces; 0: none.
     */
    int32_t points;
    /**
     * How deep the deepest is, along its normal before the motion; of an obstacle that is a shape
     * its distance from the shape; length.
     */
    double depth;
    double point[3];      /**< Where it is, moved; in 2D the third entry is 0. */
    int64_t face; /**< Its slave face, or that which a node of the master has passed through. */
    /** Its node, of either side; -1: the middle of the face, or a node of a rigid mesh. */
    int64_t node;
    /** The master face that it has passed through; -1 of an obstacle that is a shape. */
    int64_t master_face;
    int64_t zone; /**< Of joined pairs the zone whose faces these are, in their order, from 0. */
};

/**
 * Checks after a solution if parts of the slave's surface have passed through the master or the
 * obstacle where no pair holds them, such as faces beyond the search distance. Faces that lie
 * wholly over master faces of at least half their size, and all of whose nodes have pairs that
 * slide by less than a tenth of the face, are left to these and not looked at; where some nodes of
 * a face have pairs, or are folded, these may pass by a tenth of its size. Nodes of a master that
 * come to lie over the faces that are looked at are looked at too; where some nodes of the slave
 * face have pairs, they may pass by a tenth of the size of the smaller face. What overlaps before
 * the motion has not passed through by it, and is not counted: data.beyond has the faces that do,
 * by more than was looked at. A clearance of the settings stands between the surfaces here too. A
 * point that has passed through the whole of a shape, as a bar, and is outside again is not found.
 *
 * @param contact      the pairs; of joined ones each zone is asked, points are those of all
 * @param u            displacements of all your degrees of freedom, as signorini_model_recover
 *                     writes them; at least up to the largest one of the nodes of the faces
 * @param penetration  out: what is found; set penetration->struct_size before
 */
int32_t signorini_surface_penetration(const signorini_surface_pairs *contact, const double *u,
                                      signorini_penetration *penetration);

/**
 * A mesh of yours, to be written to a file. Cells have the types and the order of nodes of VTK: 3
 * line, 5 triangle, 9 quadrilateral, 10 tetrahedron, 12 hexahedron, 13 wedge, 14 pyramid; 21 to 29
 * the quadratic ones.
 */
struct signorini_mesh {
    uint32_t struct_size;      /**< sizeof(signorini_mesh). */
    int32_t dim;               /**< Space dimension, 2 or 3. */
    int64_t nodes;             /**< Number of nodes. */
    const double *coordinates; /**< Coordinates, dim for each node. */
    int64_t cells;             /**< Number of cells, 0 allowed. */
    /** 0 or 1: the number of the first node and of the first entry of cell_start. */
    int32_t index_base;
    int32_t cell_type;         /**< VTK's type of all cells, if cell_types is NULL; else 0. */
    const int32_t *cell_types; /**< VTK's type of each cell; NULL: all have cell_type. */
    /**
     * Start of each cell in cell_nodes, cells + 1 entries; NULL: the types tell their numbers of
     * nodes.
     */
    const int64_t *cell_start;
    const int64_t *cell_nodes; /**< Nodes of the cells. */
};

/** A contact zone with its solution, for signorini_mesh_write. */
struct signorini_zone {
    uint32_t struct_size;                   /**< sizeof(signorini_zone). */
    int32_t reserved;                       /**< 0. */
    const signorini_surface_pairs *contact; /**< The pairs. */
    const double *gap; /**< Gaps, one for each pair; NULL: those of the pairs. */
    const double *slip0; /**< Reference slip, dim - 1 for each pair; NULL: zero. */
    const double *d;                        /**< Relative displacements, N = dim * pairs. */
    const double *F;                        /**< Contact forces, N. */
    const int32_t *state; /**< SIGNORINI_STATE_... of each pair; NULL: no states. */
};

/** A field of your own at the nodes of a mesh. */
struct signorini_field {
    uint32_t struct_size; /**< sizeof(signorini_field). */
    int32_t components;   /**< 1: a number for each node; dim: a vector. */
    /**
     * Its name in the file, UTF-8; another one than those that the call writes by itself:
     * displacement, pressure, traction, clearance, slip, state.
     */
    const char *name;
    const double *values; /**< The values, components for each node. */
};

/**
 * Writes a mesh with fields at its nodes to a file in VTK's format .vtu, which ParaView opens. The
 * file keeps every bit, infinities too. With contact zones it has pressure, traction, clearance
 * and slip, as signorini_surface_fields gives them, and state where each zone has it. Nodes in no
 * pair have 0 there, and state -1; of a node in several zones the last one counts.
 *
 * @param path      name of the file, which is replaced if it exists
 * @param mesh      the mesh; with zones the one whose nodes were paired
 * @param u         displacements of all degrees of freedom, as signorini_model_recover gives them,
 *                  up to the largest of node_dofs; without zones dim for each node; NULL: none
 * @param n_zones   number of contact zones, 0 allowed
 * @param zones     the zones, whose pairs number degrees of freedom alike
 * @param n_fields  number of fields of your own, 0 allowed
 * @param fields    these fields
 * @return the status; after SIGNORINI_STATUS_FILE an old file is unchanged
 */
int32_t signorini_mesh_write(const char *path, const signorini_mesh *mesh, const double *u,
                             int64_t n_zones, const signorini_zone *zones, int64_t n_fields,
                             const signorini_field *fields);

#ifdef __cplusplus
} /* extern "C" */
#endif

#endif /* SIGNORINI_SURFACE_H */
