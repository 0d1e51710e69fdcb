#include "hertz_study.h"

#include <math.h>
#include <stdlib.h>

static const double pi = 3.14159265358979323846;

/* ---- The model ----------------------------------------------------------------------------- */

int32_t study_make(struct study *study, const struct hertz *hertz, double stick_radius, int cells)
{
    *study = (struct study){.stick_radius = stick_radius};
    if (!hertz_mesh_make(&study->mesh, hertz, cells))
        return SIGNORINI_STATUS_OUT_OF_MEMORY;

    const struct hertz_mesh *mesh = &study->mesh;
    const size_t pairs = (size_t)mesh->contact.pairs;
    study->f = calloc(CASES * (size_t)mesh->bricks->dofs, sizeof *study->f);
    study->prescribed = malloc(CASES * (size_t)mesh->n_fixed * sizeof *study->prescribed);
    study->gap = malloc(CASES * pairs * sizeof *study->gap);
    study->friction = malloc(CASES * pairs * sizeof *study->friction);
    study->answer.d = malloc(CASES * 3 * pairs * sizeof *study->answer.d);
    study->answer.F = malloc(CASES * 3 * pairs * sizeof *study->answer.F);
    study->answer.state = malloc(CASES * pairs * sizeof *study->answer.state);
    if (study->f == NULL || study->prescribed == NULL || study->gap == NULL ||
        study->friction == NULL || study->answer.d == NULL || study->answer.F == NULL ||
        study->answer.state == NULL)
        return SIGNORINI_STATUS_OUT_OF_MEMORY;

    for (size_t i = 0; i < CASES * pairs; i++) {
        study->gap[i] = mesh->gap[i % pairs];
        study->friction[i] = hertz->mu;
    }
    for (int number = 0; number < CASES; number++)
        study->motion[number].approach = hertz->approach;
    study->motion[SHIFTED].shift = shift_motion(hertz, stick_radius);
    study->motion[TWISTED].rotation = twist_rotation(hertz, stick_radius);
    return contact_model(mesh->bricks, &mesh->contact, mesh->n_fixed, mesh->fixed, &study->model);
}

void study_release(struct study *study)
{
    signorini_model_free(study->model);
    free(study->f);
    free(study->prescribed);
    free(study->gap);
    free(study->friction);
    free(study->answer.d);
    free(study->answer.F);
    free(study->answer.state);
    hertz_mesh_free(&study->mesh);
}

struct answer study_answer(const struct study *study, int number)
{
    const int32_t skip = number * study->mesh.contact.pairs;
    const struct answer *all = &study->answer;
    return (struct answer){all->d + 3 * skip, all->F + 3 * skip, all->state + skip};
}

int32_t study_recover(const struct study *study, int number, double u[], double nodal[])
{
    const struct answer answer = study_answer(study, number);
    const int32_t status = signorini_model_recover(
        study->model, 1, study->f, &study->prescribed[number * study->mesh.n_fixed], answer.d, u);
    return status != 0 ? status : signorini_model_nodal_forces(study->model, answer.F, nodal);
}

/* ---- Load cases ---------------------------------------------------------------------------- */

/* Sums of the forces of a load case on the lower ball. */
struct sums {
    double P, Q, M;              /* along -z, along x, about z */
    double P_squares, Q_squares; /* each force times its squared radius */
};

static struct sums sum_up(const struct study *study, int number)
{
    const struct contact *contact = &study->mesh.contact;
    const struct answer answer = study_answer(study, number);
    struct sums sums = {.P = 0.0};

    for (int32_t pair = 0; pair < contact->pairs; pair++) {
        const double *at = study->mesh.bricks->at[contact->lower[pair]], *F = &answer.F[3 * pair];
        const double square = at[0] * at[0] + at[1] * at[1];
        sums.P -= F[0];
        sums.Q += F[1];
        sums.M += at[0] * F[2] - at[1] * F[1];
        sums.P_squares -= F[0] * square;
        sums.Q_squares += F[1] * square;
    }
    return sums;
}

/* Loads of the cut faces go most of the way to those that contact has. All of the way they would
 * swing: a softer block takes less force. Returns how far they were, relative. */
static double follow(struct motion *motion, const struct sums *sums, int number)
{
    const double share = 0.75;
    double *P = &motion->press.force[2], *Q = &motion->friction.force[0];
    double *M = &motion->friction.moment;
    double apart = fabs(*P + sums->P) / sums->P;

    *P -= share * (*P + sums->P);
    motion->press.spread = sqrt(sums->P_squares / sums->P);
    if (number == SHIFTED) {
        apart = fmax(apart, fabs(*Q - sums->Q) / sums->Q);
        *Q += share * (sums->Q - *Q);
        motion->friction.spread = sqrt(sums->Q_squares / sums->Q);
    } else if (number == TWISTED) {
        apart = fmax(apart, fabs(*M - sums->M) / sums->M);
        *M += share * (sums->M - *M);
    }
    return apart;
}

int32_t study_solve(struct study *study, const struct hertz *hertz)
{
    enum { ROUNDS = 6 };
    const struct hertz_mesh *mesh = &study->mesh;

    for (int round = 0; round < ROUNDS; round++) {
        for (int number = 0; number < CASES; number++) {
            hertz_mesh_prescribe(mesh, hertz, &study->motion[number],
                                 &study->prescribed[number * mesh->n_fixed]);
            signorini_report_default(&study->report[number], sizeof *study->report);
        }
        /* Pressing moves no pair along the contact, so that slip0 is zero in all cases. */
        const int32_t status = signorini_model_solve(
            study->model, CASES, study->f, study->prescribed, study->gap, SIGNORINI_LAW_COULOMB,
            study->friction, NULL, NULL, study->answer.d, study->answer.F, study->answer.state,
            NULL, study->report, NULL);
        if (status != SIGNORINI_STATUS_SOLVED)
            return status;
        study->apart = 0.0;
        for (int number = 0; number < CASES; number++) {
            const struct sums sums = sum_up(study, number);
            study->apart = fmax(study->apart, follow(&study->motion[number], &sums, number));
            if (round == 0 && number == PRESSED)
                study->rigid_force = sums.P;
        }
    }
    return SIGNORINI_STATUS_SOLVED;
}

/* ---- Against the closed forms -------------------------------------------------------------- */

/* Squares of tractions, summed over the pairs: of the closed form, and of what is apart from it. */
struct squares {
    double p, q, apart_p, apart_q;
};

/* The closed form's friction at a point. */
static void traction(const struct study *study, const struct hertz *hertz, int number,
                     const double at[3], double q[2])
{
    const double r = hypot(at[0], at[1]);

    q[0] = q[1] = 0.0;
    if (number == SHIFTED) {
        q[0] = shift_traction(hertz, study->stick_radius, r);
    } else if (number == TWISTED && r > 0.0) {
        const double size = twist_traction(hertz, study->stick_radius, r);
        q[0] = -size * at[1] / r;
        q[1] = size * at[0] / r;
    }
}

static struct squares compare(const struct study *study, const struct hertz *hertz, int number)
{
    const struct contact *contact = &study->mesh.contact;
    const struct answer answer = study_answer(study, number);
    const double area = study->mesh.cell * study->mesh.cell;
    struct squares sum = {.p = 0.0};

    for (int32_t pair = 0; pair < contact->pairs; pair++) {
        const double *at = study->mesh.bricks->at[contact->lower[pair]], *F = &answer.F[3 * pair];
        const double p = hertz_pressure(hertz, hypot(at[0], at[1]));
        double q[2];
        traction(study, hertz, number, at, q);
        sum.p += p * p;
        sum.q += q[0] * q[0] + q[1] * q[1];
        sum.apart_p += pow(-F[0] / area - p, 2.0);
        sum.apart_q += pow(F[1] / area - q[0], 2.0) + pow(F[2] / area - q[1], 2.0);
    }
    return sum;
}

/* Radius of the circle that is as large as so many cells, in cells. */
static double circle(int64_t cells)
{
    return sqrt((double)cells / pi);
}

struct errors study_errors(const struct study *study, const struct hertz *hertz)
{
    const double c = study->stick_radius, cell = study->mesh.cell;
    const struct answer pressed = study_answer(study, PRESSED);
    const struct squares press = compare(study, hertz, PRESSED);
    const struct squares shift = compare(study, hertz, SHIFTED);
    const struct squares twist = compare(study, hertz, TWISTED);
    const signorini_report *report = study->report;
    double largest = 0.0;

    for (int32_t pair = 0; pair < study->mesh.contact.pairs; pair++)
        largest = fmax(largest, -pressed.F[3 * pair] / (cell * cell));
    return (struct errors){
        .P = sum_up(study, PRESSED).P / hertz->force - 1.0,
        .p0 = largest / hertz->pressure - 1.0,
        .Q = sum_up(study, SHIFTED).Q / shift_force(hertz, c) - 1.0,
        .M = sum_up(study, TWISTED).M / twist_moment(hertz, c) - 1.0,
        .a = circle(study->mesh.contact.pairs - report[PRESSED].pairs_open) - hertz->a / cell,
        .c_shift = circle(report[SHIFTED].pairs_sticking) - c / cell,
        .c_twist = circle(report[TWISTED].pairs_sticking) - c / cell,
        .p = sqrt(press.apart_p / press.p),
        .q_shift = sqrt(shift.apart_q / shift.q),
        .q_twist = sqrt(twist.apart_q / twist.q),
    };
}
