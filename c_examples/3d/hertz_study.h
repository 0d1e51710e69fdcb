/*
 * A mesh of the two balls with its model and load cases, and how far the answers are from the
 * closed forms.
 */

#ifndef HERTZ_STUDY_H
#define HERTZ_STUDY_H

#include "hertz_mesh.h"

enum { PRESSED, SHIFTED, TWISTED, CASES };

struct study {
    double stick_radius; /* c: so far the balls are shifted or twisted */
    struct hertz_mesh mesh;
    signorini_model *model;
    struct motion motion[CASES];
    double rigid_force; /* what presses the balls if the cut faces do not give way */
    double apart;       /* loads of the cut faces less those of contact in the end, relative */
    /* One load case after the other, as the library has them. */
    double *f, *prescribed, *gap, *friction;
    struct answer answer;
    signorini_report report[CASES];
};

/* Meshes, assembles and makes the model. Returns the library's status; study_release after any. */
int32_t study_make(struct study *study, const struct hertz *hertz, double stick_radius, int cells);

/*
 * Solves all load cases, with cut faces that give way under the forces of contact themselves: first
 * without any, then some rounds with those of the round before. Returns the library's status.
 */
int32_t study_solve(struct study *study, const struct hertz *hertz);

/* The part of the answer that belongs to a load case. */
struct answer study_answer(const struct study *study, int number);

/* Displacements of all nodes in a load case, and the contact forces on them. Returns the library's
 * status. */
int32_t study_recover(const struct study *study, int number, double u[], double nodal[]);

void study_release(struct study *study);

/* Against the closed forms. */
struct errors {
    double P, p0, Q, M;         /* relative: forces, moment and largest pressure */
    double a, c_shift, c_twist; /* in cells: radii of circles as large as the area of all closed
                                   pairs, and of all sticking pairs */
    double p, q_shift, q_twist; /* root mean square of p and of the friction's traction, relative */
};

struct errors study_errors(const struct study *study, const struct hertz *hertz);

#endif
