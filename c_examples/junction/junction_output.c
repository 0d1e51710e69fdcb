#include "junction_output.h"
#include "../common/checks.h"
#include "signorini.h"

#include <math.h>
#include <stdio.h>

/* The closing load acts in all of them. */
const struct step steps[STEPS] = {{"closing", 0.0}, {"p10", 10.0}, {"p20", 20.0},
                                  {"p30", 30.0},    {"p40", 40.0}, {"p0", 0.0}};

double zone_force(const struct junction *junction, const double F[SIZE], int zone)
{
    double sum = 0.0;
    for (size_t i = 0; i < PAIRS; i++)
        if (junction->zone[i] == zone)
            sum -= F[2 * i];
    return sum;
}

double largest_opening(const double d[SIZE])
{
    double largest = 0.0;
    for (size_t i = 0; i < PAIRS; i++)
        largest = fmax(largest, -d[2 * i]);
    return largest;
}

void zone_states(const struct junction *junction, const int32_t state[PAIRS], int zone,
                 char text[PAIRS + 1])
{
    for (size_t i = 0; i < PAIRS; i++)
        if (junction->zone[i] == zone)
            *text++ = state[i] == SIGNORINI_OPEN    ? 'o'
                      : state[i] == SIGNORINI_SLIP  ? 's'
                      : state[i] == SIGNORINI_STICK ? '.'
                                                    : '?';
    *text = '\0';
}

void print_history(const struct junction *junction, const struct history *history)
{
    puts("\nStates from the smallest radius outward: o open, s slip, . stick. Forces in kN over\n"
         "the whole circumference, the largest opening in um.\n\n"
         " mu step     zone 1 (seal)         zone 2 (cover)  zone 3"
         "      force 1  force 2  force 3  opening");
    for (size_t i = 0; i < history->cases; i++) {
        for (size_t s = 0; s < STEPS; s++) {
            printf("%3.1f %-8s", history->mu[i], steps[s].name);
            for (int zone = 1; zone <= ZONES; zone++) {
                char text[PAIRS + 1];
                zone_states(junction, history->state[s][i], zone, text);
                printf(" %-*s", zone == 1 ? 21 : zone == 2 ? 15 : 9, text);
            }
            for (int zone = 1; zone <= ZONES; zone++)
                printf(" %8.2f", zone_force(junction, history->F[s][i], zone) / 1000.0);
            printf(" %8.2f\n", 1000.0 * largest_opening(history->d[s][i]));
        }
    }
    putchar('\n');
}

static int finish(FILE *file)
{
    const int failed = ferror(file);
    return fclose(file) != 0 || failed ? -1 : 0;
}

int write_junction_csv(const char *path, const struct junction *junction,
                       const struct history *history)
{
    FILE *file = fopen(path, "w");
    if (file == NULL)
        return -1;
    fputs("mu,step,zone,pair,r,d_n,d_t,F_n,F_t,state\n", file);
    for (size_t i = 0; i < history->cases; i++) {
        for (size_t s = 0; s < STEPS; s++) {
            const double *d = history->d[s][i], *F = history->F[s][i];
            int number = 0;
            for (size_t pair = 0; pair < PAIRS; pair++) {
                number = pair > 0 && junction->zone[pair] == junction->zone[pair - 1] ? number + 1
                                                                                      : 1;
                /* + 0.0 turns -0.0 into 0.0 */
                fprintf(file, "%.1f,%s,%d,%d,%.12e,%.12e,%.12e,%.12e,%.12e,%s\n", history->mu[i],
                        steps[s].name, junction->zone[pair], number,
                        junction->r[junction->lower[pair]], d[2 * pair] + 0.0,
                        d[2 * pair + 1] + 0.0, F[2 * pair] + 0.0, F[2 * pair + 1] + 0.0,
                        state_name(history->state[s][i][pair]));
            }
        }
    }
    return finish(file);
}

/* A file in VTK's legacy format, as ParaView opens it: x = r, y = z. */
int write_junction_vtk(const char *path, const char *title, const struct junction *junction,
                       const double u[DOFS])
{
    double stress[NODES], of_elements[ELEMENTS];
    FILE *file = fopen(path, "w");
    if (file == NULL)
        return -1;
    junction_stress(junction, u, stress, of_elements);

    fprintf(file, "# vtk DataFile Version 3.0\n%s\nASCII\nDATASET UNSTRUCTURED_GRID\n", title);
    fprintf(file, "POINTS %d double\n", NODES);
    for (size_t i = 0; i < NODES; i++)
        fprintf(file, "%.9g %.9g 0\n", junction->r[i], junction->z[i]);
    fprintf(file, "CELLS %d %d\n", ELEMENTS, 5 * ELEMENTS);
    for (size_t e = 0; e < ELEMENTS; e++) {
        const int32_t *corners = junction->corners[e];
        fprintf(file, "4 %ld %ld %ld %ld\n", (long)corners[0], (long)corners[1], (long)corners[2],
                (long)corners[3]);
    }
    fprintf(file, "CELL_TYPES %d\n", ELEMENTS);
    for (size_t e = 0; e < ELEMENTS; e++)
        fputs("9\n", file); /* VTK_QUAD */

    fprintf(file, "CELL_DATA %d\nSCALARS part int 1\nLOOKUP_TABLE default\n", ELEMENTS);
    for (size_t e = 0; e < ELEMENTS; e++)
        fprintf(file, "%d\n", junction->part[junction->corners[e][0]]);
    fputs("SCALARS mean_sigma_zz double 1\nLOOKUP_TABLE default\n", file);
    for (size_t e = 0; e < ELEMENTS; e++)
        fprintf(file, "%.9g\n", of_elements[e]);
    fprintf(file, "POINT_DATA %d\nVECTORS displacement double\n", NODES);
    for (size_t i = 0; i < NODES; i++)
        fprintf(file, "%.9g %.9g 0\n", u[2 * i], u[2 * i + 1]);
    fputs("SCALARS sigma_zz double 1\nLOOKUP_TABLE default\n", file);
    for (size_t i = 0; i < NODES; i++)
        fprintf(file, "%.9g\n", stress[i]);
    return finish(file);
}
