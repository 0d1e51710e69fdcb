/*
 * Two equal balls are pressed together, then shifted along x, or twisted about z, so far that the
 * middle sticks and a ring slips: the contact of Hertz, with friction after Cattaneo and Mindlin,
 * and after Lubkin.
 *
 * Near the contact a ball is a half-space. A block of bricks is cut out of each (hertz_mesh.c); the
 * gap is r^2 / 2 R. The cut faces give way as the rest of the half-space would under the forces of
 * contact. These are not known before, so that each load case is solved several times
 * (hertz_study.c). Points of two equal balls that meet move alike along the contact when the balls
 * are pressed, and across it when they are shifted or twisted: the closed forms (hertz_theory.c)
 * count on it. That of the shift is exact if Poisson's ratio is zero.
 *
 * The program solves three meshes, each with three load cases of one model, and compares pressing
 * force P, friction force Q, moment M, largest pressure, radii and tractions with the closed forms.
 *
 *     hertz [DIR]
 *
 * With DIR, it also writes hertz_pressed, hertz_shifted and hertz_twisted, .csv and .vtu, of the
 * finest mesh to DIR; hertz.py draws them. It returns 0 if every check passed.
 */

#include "brick_output.h"
#include "hertz_study.h"
#include "../common/checks.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MESHES = 3 };

static const double pi = 3.14159265358979323846;

static const int cells_of[MESHES] = {4, 6, 8}; /* along the radius of the contact */

/* Two steel balls of 200 mm (without Poisson's ratio), N, mm, MPa: 1 / R = 1 / 200 + 1 / 200. */
static const struct material material = {200000.0, 0.0};
static const double gap_radius = 100.0, contact_radius = 1.0, mu = 0.3;
static const double stick_radius = 0.6; /* so far they are shifted or twisted */

/* ---- What is seen -------------------------------------------------------------------------- */

static void print_closed_forms(const struct hertz *hertz)
{
    const double c = stick_radius;

    printf("closed forms: a %.3f mm, approach %.3f um, P %.1f N, p0 %.1f MPa, c %.3f mm\n"
           "shifted by %.3f um: Q %.1f N = %.4f mu P\n"
           "twisted by %.3f mrad: M %.1f N mm = %.4f mu P a\n\n",
           hertz->a, 1e3 * hertz->approach, hertz->force, hertz->pressure, c,
           1e3 * shift_motion(hertz, c), shift_force(hertz, c),
           shift_force(hertz, c) / (mu * hertz->force), 1e3 * twist_rotation(hertz, c),
           twist_moment(hertz, c), twist_moment(hertz, c) / (mu * hertz->force * hertz->a));
}

/* The closed form of the twist at its two ends: everything slips, M = mu int p r dA; and almost
 * nothing does, as if each ball were turned by a glued disc, M = 16/3 G a^3 rotation / 2. */
static void check_closed_form(struct checks *checks, const struct hertz *hertz)
{
    const double shear = material.young / (2.0 * (1.0 + material.poisson));
    const double a = hertz->a, near = 1e-6;
    const double all = 3.0 * pi / 16.0 * mu * hertz->force * a;
    const double glued = 16.0 / 3.0 * shear * pow(a, 3.0) *
                         twist_rotation(hertz, (1.0 - near) * a) / 2.0;
    const double off = fmax(fabs(twist_moment(hertz, near * a) / all - 1.0),
                            fabs(twist_moment(hertz, (1.0 - near) * a) / glued - 1.0));

    judge(checks, off <= 10.0 * near);
    printf("the closed form of the twist between no slip and slip everywhere: off by %.0e\n", off);
}

static void print_head(void)
{
    puts("\nOff the closed forms: forces and tractions in %, radii in cells\n"
         "             pressed                      shifted              twisted\n"
         " a / h pairs     P     p0      a      p      Q      c      q      M      c      q");
}

static void print_row(const struct study *study, const struct errors *e, int cells)
{
    printf("%6d %5d %+6.2f %+6.2f %+6.2f %6.2f %+6.2f %+6.2f %6.2f %+6.2f %+6.2f %6.2f\n", cells,
           (int)study->mesh.contact.pairs, 100.0 * e->P, 100.0 * e->p0, e->a, 100.0 * e->p,
           100.0 * e->Q, e->c_shift, 100.0 * e->q_shift, 100.0 * e->M, e->c_twist,
           100.0 * e->q_twist);
}

/* ---- What is checked ----------------------------------------------------------------------- */

static double largest(int count, const double values[])
{
    double most = 0.0;
    for (int i = 0; i < count; i++)
        most = fmax(most, fabs(values[i]));
    return most;
}

/*
 * Trilinear bricks: the error of forces is of second order in h / a. Tractions have a vertical
 * tangent at r = a, and there a pair is either open or closed as a whole: their root mean square
 * error is of first order, and a circle is known to half a cell.
 */
static void check_errors(struct checks *checks, const struct errors errors[MESHES])
{
    double forces[MESHES], tractions[MESHES];

    for (int i = 0; i < MESHES; i++) {
        const struct errors *e = &errors[i];
        const double h = 1.0 / cells_of[i];
        const double radii = largest(3, (double[]){e->a, e->c_shift, e->c_twist});
        forces[i] = largest(4, (double[]){e->P, e->p0, e->Q, e->M});
        tractions[i] = largest(3, (double[]){e->p, e->q_shift, e->q_twist});
        judge(checks, forces[i] <= h * h / 2.0 && tractions[i] <= h && radii <= 0.5);
        printf("a / h = %d: forces off by %.2f %% (limit %.2f), tractions by %.1f %% (%.1f), "
               "radii by %.2f cells (0.50)\n",
               cells_of[i], 100.0 * forces[i], 50.0 * h * h, 100.0 * tractions[i], 100.0 * h,
               radii);
    }
    for (int i = 1; i < MESHES; i++) {
        judge(checks, forces[i] < forces[i - 1] && tractions[i] < tractions[i - 1]);
        printf("a / h = %d is nearer than %d\n", cells_of[i], cells_of[i - 1]);
    }
}

static void check_solution(struct checks *checks, const struct study *study,
                           const struct hertz *hertz)
{
    const int32_t pairs = study->mesh.contact.pairs;
    double excess = 0.0, eta = 0.0;

    for (int number = 0; number < CASES; number++) {
        excess = fmax(excess, contact_excess(pairs, study_answer(study, number).F, mu));
        eta = fmax(eta, study->report[number].eta);
    }
    judge(checks, excess <= 1e-9 * hertz->force);
    printf("no tension, |F_t| <= mu |F_n|: exceeded by %.0e N; eta %.0e\n", excess, eta);
    judge(checks, study->apart <= 1e-3); /* small beside the errors allowed below */
    printf("the cut faces give way under the forces of contact: off by %.0e\n", study->apart);
}

/* ---- Files --------------------------------------------------------------------------------- */

static void report_file(struct checks *checks, const char *path, int result)
{
    judge(checks, result == 0);
    if (result == 0)
        printf("wrote %s\n", path);
    else
        printf("cannot write %s: %s\n", path, strerror(errno));
}

static void save(struct checks *checks, const char *directory, const struct study *study)
{
    static const char *const name[] = {"pressed", "shifted", "twisted"};
    const struct brick_mesh *bricks = study->mesh.bricks;
    const struct contact *contact = &study->mesh.contact;
    double *u = malloc((size_t)bricks->dofs * sizeof *u);
    double *nodal = malloc((size_t)bricks->dofs * sizeof *nodal);
    double *area = malloc((size_t)contact->pairs * sizeof *area);

    for (int number = PRESSED; number <= TWISTED; number++) {
        const struct answer answer = study_answer(study, number);
        char path[4096];
        snprintf(path, sizeof path, "%s/hertz_%s.csv", directory, name[number]);
        report_file(checks, path, write_csv(path, bricks, contact, &answer));
        if (u == NULL || nodal == NULL || area == NULL ||
            study_recover(study, number, u, nodal) != 0) {
            judge(checks, 0);
            puts("no displacements");
            break;
        }
        for (int32_t pair = 0; pair < contact->pairs; pair++)
            area[pair] = study->mesh.cell * study->mesh.cell;
        snprintf(path, sizeof path, "%s/hertz_%s.vtu", directory, name[number]);
        report_file(checks, path,
                    write_vtu(path, bricks, contact, answer.state, area, u, nodal));
    }
    free(u);
    free(nodal);
    free(area);
}

int main(int argc, char **argv)
{
    const struct hertz hertz = hertz_pressed(material, gap_radius, contact_radius, mu);
    struct errors errors[MESHES];
    struct checks checks = {0, 0};

    if (argc > 2) {
        fprintf(stderr, "usage: %s [DIR]\n", argv[0]);
        return EXIT_FAILURE;
    }
    printf("signorini %s\n\n", signorini_version());
    print_closed_forms(&hertz);
    check_closed_form(&checks, &hertz);
    print_head();
    for (int i = 0; i < MESHES; i++) {
        struct study study;
        int32_t status = study_make(&study, &hertz, stick_radius, cells_of[i]);
        if (status == 0)
            status = study_solve(&study, &hertz);
        if (status != 0) {
            judge(&checks, 0);
            printf("a / h = %d: %s: %s\n", cells_of[i], signorini_status_string(status),
                   signorini_last_error());
            study_release(&study);
            return conclude(&checks);
        }
        errors[i] = study_errors(&study, &hertz);
        print_row(&study, &errors[i], cells_of[i]);
        if (i == MESHES - 1) {
            printf("\nWith rigid cut faces P is off by %+.1f %%: a block is not a half-space.\n\n",
                   100.0 * (study.rigid_force / hertz.force - 1.0));
            check_solution(&checks, &study, &hertz);
            if (argc == 2)
                save(&checks, argv[1], &study);
        }
        study_release(&study);
    }
    check_errors(&checks, errors);
    return conclude(&checks);
}
