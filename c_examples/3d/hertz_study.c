#include "hertz_study.h"

#include <math.h>
#include <stdlib.h>

static const double pi = 3.14159265358979323846;

/* ---- Load cases ---------------------------------------------------------------------------- */

static struct motion motion_of(const struct study *study, const struct hertz *hertz, int number)
{
    struct motion motion = {.approach = hertz->approach};

    if (number != RIGID)
        motion.press = (struct load){{0.0, 0.0, -hertz->force}, 0.0, hertz_spread(hertz)};
    if (number == SHIFTED) {
        motion.shift = shift_motion(hertz, study->stick_radius);
        motion.friction = (struct load){{shift_force(hertz, study->stick_radius), 0.0, 0.0}, 0.0,
                                        shift_spread(hertz, study->stick_radius)};
    } else if (number == TWISTED) {
        motion.rotation = twist_rotation(hertz, study->stick_radius);
        motion.friction = (struct load){{0.0, 0.0, 0.0}, twist_moment(hertz, study->stick_radius), 0.0};
    }
    return motion;
}

/* Pressing moves no pair tangentially, so that slip0 is zero in the other cases too. */
int32_t study_solve(struct study *study, const struct hertz *hertz)
{
    const struct hertz_mesh *mesh = &study->mesh;
    const size_t pairs = (size_t)mesh->contact.pairs;
    double *gap = malloc(CASES * pairs * sizeof *gap);
    double *friction = malloc(CASES * pairs * sizeof *friction);
    int32_t status = SIGNORINI_STATUS_OUT_OF_MEMORY;

    if (gap != NULL && friction != NULL) {
        for (int number = 0; number < CASES; number++) {
            const struct motion motion = motion_of(study, hertz, number);
            hertz_mesh_prescribe(mesh, hertz, &motion,
                                 &study->prescribed[number * mesh->n_fixed]);
            study->report[number].struct_size = sizeof *study->report;
            for (size_t pair = 0; pair < pairs; pair++) {
                gap[(size_t)number * pairs + pair] = mesh->gap[pair];
                friction[(size_t)number * pairs + pair] = hertz->mu;
            }
        }
        status = signorini_model_solve(study->model, CASES, study->f, study->prescribed, gap,
                                       SIGNORINI_LAW_COULOMB, friction, NULL, NULL,
                                       study->answer.d, study->answer.F, study->answer.state, NULL,
                                       study->report, NULL);
    }
    free(gap);
    free(friction);
    return status;
}

int32_t study_make(struct study *study, const struct hertz *hertz, double stick_radius, int cells)
{
    *study = (struct study){.stick_radius = stick_radius};
    if (!hertz_mesh_make(&study->mesh, hertz, cells))
        return SIGNORINI_STATUS_OUT_OF_MEMORY;

    const size_t pairs = (size_t)study->mesh.contact.pairs;
    study->f = calloc(CASES * (size_t)study->mesh.bricks->dofs, sizeof *study->f);
    study->prescribed = malloc(CASES * (size_t)study->mesh.n_fixed * sizeof *study->prescribed);
    study->answer.d = malloc(CASES * 3 * pairs * sizeof *study->answer.d);
    study->answer.F = malloc(CASES * 3 * pairs * sizeof *study->answer.F);
    study->answer.state = malloc(CASES * pairs * sizeof *study->answer.state);
    if (study->f == NULL || study->prescribed == NULL || study->answer.d == NULL ||
        study->answer.F == NULL || study->answer.state == NULL)
        return SIGNORINI_STATUS_OUT_OF_MEMORY;
    return contact_model(study->mesh.bricks, &study->mesh.contact, study->mesh.n_fixed,
                         study->mesh.fixed, &study->model);
}

void study_release(struct study *study)
{
    signorini_model_free(study->model);
    free(study->f);
    free(study->prescribed);
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
        study->model, study->f, &study->prescribed[number * study->mesh.n_fixed], answer.d, u);
    return status != 0 ? status : signorini_model_nodal_forces(study->model, answer.F, nodal);
}

/* ---- Against the closed forms -------------------------------------------------------------- */

/* What the forces of a load case sum up to. */
struct sums {
    double P, Q, M, p0, apart_p, apart_q, all_p, all_q;
    int closed, stick;
};

/* The closed form's tangential traction at a point. */
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

static struct sums sum_up(const struct study *study, const struct hertz *hertz, int number)
{
    const struct contact *contact = &study->mesh.contact;
    const struct answer answer = study_answer(study, number);
    const double area = study->mesh.cell * study->mesh.cell;
    struct sums sums = {.P = 0.0};

    for (int32_t pair = 0; pair < contact->pairs; pair++) {
        const double *at = study->mesh.bricks->at[contact->lower[pair]], *F = &answer.F[3 * pair];
        const double p = hertz_pressure(hertz, hypot(at[0], at[1]));
        double q[2];
        traction(study, hertz, number, at, q);
        sums.P -= F[0];
        sums.Q += F[1];
        sums.M += at[0] * F[2] - at[1] * F[1];
        sums.p0 = fmax(sums.p0, -F[0] / area);
        sums.apart_p += pow(-F[0] / area - p, 2.0);
        sums.apart_q += pow(F[1] / area - q[0], 2.0) + pow(F[2] / area - q[1], 2.0);
        sums.all_p += p * p;
        sums.all_q += q[0] * q[0] + q[1] * q[1];
        sums.closed += answer.state[pair] != SIGNORINI_STATE_OPEN;
        sums.stick += answer.state[pair] == SIGNORINI_STATE_STICK;
    }
    return sums;
}

struct errors study_errors(const struct study *study, const struct hertz *hertz)
{
    const struct sums pressed = sum_up(study, hertz, PRESSED);
    const struct sums shifted = sum_up(study, hertz, SHIFTED);
    const struct sums twisted = sum_up(study, hertz, TWISTED);
    const double cell = study->mesh.cell;

    return (struct errors){
        .P = pressed.P / hertz->force - 1.0,
        .p0 = pressed.p0 / hertz->pressure - 1.0,
        .Q = shifted.Q / shift_force(hertz, study->stick_radius) - 1.0,
        .M = twisted.M / twist_moment(hertz, study->stick_radius) - 1.0,
        .a = sqrt(pressed.closed / pi) - hertz->a / cell,
        .c_shift = sqrt(shifted.stick / pi) - study->stick_radius / cell,
        .c_twist = sqrt(twisted.stick / pi) - study->stick_radius / cell,
        .p = sqrt(pressed.apart_p / pressed.all_p),
        .q_shift = sqrt(shifted.apart_q / shifted.all_q),
        .q_twist = sqrt(twisted.apart_q / twisted.all_q),
    };
}

double study_force(const struct study *study, int number)
{
    const struct answer answer = study_answer(study, number);
    double force = 0.0;

    for (int32_t pair = 0; pair < study->mesh.contact.pairs; pair++)
        force -= answer.F[3 * pair];
    return force;
}
