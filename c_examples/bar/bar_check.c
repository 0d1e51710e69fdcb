#include "bar_check.h"
#include "bar_reference.h"
#include "signorini.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static double value(const struct solution *solution, size_t node, enum quantity quantity)
{
    const double *values = quantity == UN || quantity == UT ? solution->d : solution->F;
    const size_t tangential = quantity == UT || quantity == FT;
    return values[2 * (node - 1) + tangential] + 0.0; /* + 0.0 turns -0.0 into 0.0 */
}

/* NULL if the table was printed right there. */
static const double *correction(size_t node, enum quantity quantity)
{
    for (size_t i = 0; i < sizeof table_corrections / sizeof *table_corrections; i++)
        if (table_corrections[i].node == node && table_corrections[i].quantity == quantity)
            return &table_corrections[i].value;
    return NULL;
}

/* ---- Checks -------------------------------------------------------------------------------- */

void check_zones(struct checks *checks, const struct solution *solution, size_t open, size_t slip)
{
    size_t wrong = 0, counted[3] = {0, 0, 0};
    for (size_t i = 0; i < BAR_PAIRS; i++) {
        const int32_t expected = i < open          ? SIGNORINI_STATE_OPEN
                                 : i < open + slip ? SIGNORINI_STATE_SLIP
                                                   : SIGNORINI_STATE_STICK;
        counted[expected] += 1;
        if (solution->state[i] != expected && wrong == 0)
            wrong = i + 1;
    }
    judge(checks, wrong == 0);
    printf("zones: from the free corner %zu open, %zu slip, %zu stick",
           counted[SIGNORINI_STATE_OPEN], counted[SIGNORINI_STATE_SLIP],
           counted[SIGNORINI_STATE_STICK]);
    if (wrong != 0)
        printf("; but node %zu is %s", wrong, state_name(solution->state[wrong - 1]));
    putchar('\n');
}

/* Largest difference of any component, relative to the largest of the expected values. */
static void check_components(struct checks *checks, const char *what, const double *computed,
                             const double *expected)
{
    const double limit = 1e-9;
    double difference = 0.0, largest = 0.0;
    int passed = 1;
    for (size_t i = 0; i < BAR_SIZE; i++) {
        difference = fmax(difference, fabs(computed[i] - expected[i]));
        largest = fmax(largest, fabs(expected[i]));
        passed = passed && isfinite(computed[i]);
    }
    judge(checks, passed && difference <= limit * largest);
    printf("%s: off by %.1e of the largest (limit %.0e)\n", what, difference / largest, limit);
}

void check_reference(struct checks *checks, const struct solution *solution)
{
    check_components(checks, "reference displacements", solution->d, reference_d);
    check_components(checks, "reference forces", solution->F, reference_F);
}

/* Largest relative difference over the nodes first to last. */
static void check_column(struct checks *checks, const struct solution *solution, const char *what,
                         enum quantity quantity, size_t first, size_t last, double limit)
{
    double worst = 0.0;
    size_t worst_node = first;
    int passed = 1;
    for (size_t node = first; node <= last; node++) {
        const double *corrected = correction(node, quantity);
        const double read = corrected ? *corrected : table_printed[node - 1][quantity];
        const double difference = fabs(value(solution, node, quantity) / read - 1.0);
        passed = passed && difference <= limit;
        if (difference > worst) {
            worst = difference;
            worst_node = node;
        }
    }
    judge(checks, passed);
    printf("Table 1, %s: off by %.2f %% at node %zu (limit %.1f %%)\n", what, 100.0 * worst,
           worst_node, 100.0 * limit);
}

/* Where the table prints more than zero, on a mesh that is only close to the paper's. */
void check_table1(struct checks *checks, const struct solution *solution)
{
    check_column(checks, solution, "u^n of nodes 1 to 3", UN, 1, 3, 0.017);
    check_column(checks, solution, "u^t of nodes 1 to 18", UT, 1, 18, 0.009);
    check_column(checks, solution, "F^n of nodes 4 to 32", FN, 4, 32, 0.006);
    check_column(checks, solution, "F^t of nodes 4 to 31", FT, 4, 31, 0.011);
    check_column(checks, solution, "F^t of node 32", FT, 32, 32, 0.043); /* small by symmetry */
}

/*
 * Without friction the bar is in a homogeneous state: sigma_yy and sigma_xx are the two pressures
 * and there is no shear. In plane strain
 *     eps_xx = ((1 - nu^2) sigma_xx - nu (1 + nu) sigma_yy) / E
 * and u_x vanishes at x = width. The element contains this state, so that any mesh is exact.
 */
void check_frictionless(struct checks *checks, const struct bar *bar,
                        const struct solution *solution)
{
    const double nu = bar->poisson;
    const double strain =
        (nu * (1.0 + nu) * bar->top_pressure - (1.0 - nu * nu) * bar->side_pressure) / bar->young;
    const double pitch = bar->width / BAR_COLUMNS;
    double d[BAR_SIZE] = {0.0}, F[BAR_SIZE] = {0.0};

    for (size_t i = 0; i < BAR_PAIRS; i++) {
        const int at_end = i == 0 || i == BAR_PAIRS - 1;
        d[2 * i + 1] = strain * ((double)i * pitch - bar->width);
        F[2 * i] = -bar->top_pressure * (at_end ? pitch / 2.0 : pitch);
    }
    check_components(checks, "closed-form displacements", solution->d, d);
    check_components(checks, "closed-form forces", solution->F, F);
}

void check_ssnv128(struct checks *checks, const struct solution *solution)
{
    const double metre = 1000.0;
    int passed = 1;

    puts("          x, mm   code_aster, m    computed, m");
    for (size_t i = 0; i < sizeof ssnv128 / sizeof *ssnv128; i++) {
        char expected[32], computed[32];
        snprintf(expected, sizeof expected, "%.8e", ssnv128[i].ux);
        snprintf(computed, sizeof computed, "%.8e", value(solution, ssnv128[i].node, UT) / metre);
        passed = passed && strcmp(expected, computed) == 0;
        printf("          %5.2f  %s  %s\n", ssnv128[i].x, expected, computed);
    }
    judge(checks, passed);
    puts("code_aster's displacements, all nine digits");
}

/* ---- Table and file ------------------------------------------------------------------------ */

/* One quantity of one line: as printed, as it should read (`with_corrections`), as computed. */
static void print_entry(const struct solution *solution, size_t node, enum quantity quantity,
                        double unit, int with_corrections)
{
    const double computed = value(solution, node, quantity) / unit;
    const double *corrected = correction(node, quantity);
    const double printed = node <= TABLE_NODES ? table_printed[node - 1][quantity] / unit : 0.0;

    if (node > TABLE_NODES)
        printf("%9s", "");
    else if (fabs(printed) < 1e-20) /* where the bar sticks the paper has numbers like 1e-27 */
        printf("%9s", "0");
    else
        printf("%#9.3g", printed);

    if (with_corrections && corrected != NULL)
        printf("%#9.3g", *corrected / unit);
    else if (with_corrections)
        printf("%9s", "");

    if (fabs(computed) < 5e-5)
        printf("%9s", "0");
    else
        printf("%9.4f", computed);
}

void print_table1(const struct solution *solution)
{
    puts("\nDisplacements in 1e-3 mm, nodal forces in daN for 1 mm of thickness.\n"
         "read as: corrects the printed values that have a wrong digit.\n\n"
         "           ----------- u^n ----------  ------ u^t -----"
         "  ------ F^n -----   ----------- F^t ----------\n"
         "node zone    printed  read as computed  printed computed"
         "  printed computed   printed  read as computed");
    for (size_t node = 1; node <= BAR_PAIRS; node++) {
        printf("%4zu %-6s", node, state_name(solution->state[node - 1]));
        print_entry(solution, node, UN, 1e-3, 1);
        print_entry(solution, node, UT, 1e-3, 0);
        print_entry(solution, node, FN, 1.0, 0);
        putchar(' ');
        print_entry(solution, node, FT, 1.0, 1);
        putchar('\n');
    }
    putchar('\n');
}

int write_csv(const char *path, const struct bar *bar, const struct solution *solution)
{
    FILE *file = fopen(path, "w");
    int failed;
    if (file == NULL)
        return -1;
    fputs("node,x,un,ut,Fn,Ft,state\n", file);
    for (size_t node = 1; node <= BAR_PAIRS; node++)
        fprintf(file, "%zu,%.12e,%.12e,%.12e,%.12e,%.12e,%s\n", node,
                (double)(node - 1) * bar->width / BAR_COLUMNS, value(solution, node, UN),
                value(solution, node, UT), value(solution, node, FN), value(solution, node, FT),
                state_name(solution->state[node - 1]));
    failed = ferror(file);
    return fclose(file) != 0 || failed ? -1 : 0;
}
