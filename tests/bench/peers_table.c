#include "peers_table.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "../c/everything.h"
#include "peers_held.h"

const char *family_name(enum family family)
{
    static const char *const names[] = {"frictionless", "friction2d", "friction3d"};
    return names[family];
}

const char *geometry_name(enum geometry geometry)
{
    static const char *const names[] = {"bar", "two_blocks", "block_shift", "block_twist",
        "block_tilt", "block_waves", "block_rim", "column_10", "column_20", "column_40"};
    return geometry < HELD_OUT ? names[geometry] : held_name(geometry - HELD_OUT);
}

static int is_peer(const struct row *row)
{
    return strcmp(row->solver->library, "signorini") != 0;
}

void write_csv(FILE *file, const struct row *rows, size_t count)
{
    fprintf(file, "family,geometry,pairs,mu,library,solver,cpu_ms,iterations,eta,rel_error,"
                  "status\n");
    for (size_t k = 0; k < count; k++) {
        const struct row *row = &rows[k];
        fprintf(file, "%s,%s,%zu,%g,%s,%s,", family_name(row->solver->family),
                geometry_name(row->geometry), row->pairs, row->mu, row->solver->library,
                row->solver->name);
        /* A figure that was not measured stays empty. */
        if (row->ms > 0.0)
            fprintf(file, "%.6g,%d,", row->ms, row->iterations);
        else
            fprintf(file, ",,");
        if (isfinite(row->eta))
            fprintf(file, "%.3e", row->eta);
        fputc(',', file);
        if (isfinite(row->rel_error))
            fprintf(file, "%.3e", row->rel_error);
        fprintf(file, ",%s\n", row->status);
        /* The yardstick, once for each problem. */
        if (row->lu_ms > 0.0 && !is_peer(row))
            fprintf(file, "%s,%s,%zu,%g,lapack,dgetrf,%.6g,,,,yardstick\n",
                    family_name(row->solver->family), geometry_name(row->geometry), row->pairs,
                    row->mu, row->lu_ms);
    }
}

/* ---- who is compared with whom ---- */

static int same_problem(const struct row *a, const struct row *b)
{
    return a->solver->family == b->solver->family && a->geometry == b->geometry &&
           a->pairs == b->pairs && a->mu == b->mu;
}

static const struct row *find(const struct row *rows, size_t count, const struct row *like,
                              const char *library, const char *solver)
{
    for (size_t k = 0; k < count; k++)
        if (same_problem(&rows[k], like) && strcmp(rows[k].solver->library, library) == 0 &&
            strcmp(rows[k].solver->name, solver) == 0)
            return &rows[k];
    return NULL;
}

/* The fastest peer with a certified answer; if there is none, with a usable one. */
static const struct row *best_peer(const struct row *rows, size_t count, const struct row *like)
{
    for (int usable = 0; usable < 2; usable++) {
        const struct row *best = NULL;
        for (size_t k = 0; k < count; k++)
            if (is_peer(&rows[k]) && same_problem(&rows[k], like) && rows[k].ms > 0.0 &&
                (usable ? strcmp(rows[k].status, "inexact") == 0 : is_solved(&rows[k])) &&
                (best == NULL || rows[k].ms < best->ms))
                best = &rows[k];
        if (best != NULL)
            return best;
    }
    return NULL;
}

/* ---- geometric means ---- */

struct mean {
    double logs;
    int count;
    double least;
};

static void add(struct mean *mean, double ratio)
{
    mean->logs += log(ratio);
    if (mean->count == 0 || ratio < mean->least)
        mean->least = ratio;
    mean->count++;
}

static void say_mean(FILE *file, const char *what, const struct mean *mean)
{
    if (mean->count > 0)
        fprintf(file, "| %s | %d | %.2f | %.2f |\n", what, mean->count,
                exp(mean->logs / mean->count), mean->least);
}

/* Problems of which there is one mean. */
enum group { USUAL, COLUMNS, HELD };

static const struct class {
    enum family family;
    enum group group;
    size_t least, most; /* pairs */
    const char *name;
} classes[] = {
    {FRICTIONLESS, USUAL, 0, 64, "frictionless, 33 pairs"},
    {FRICTIONLESS, USUAL, 65, 256, "frictionless, 129 pairs"},
    {FRICTIONLESS, USUAL, 257, SIZE_MAX, "frictionless, 513 pairs and more"},
    {FRICTION_2D, USUAL, 0, 64, "friction in 2D, 33 pairs"},
    {FRICTION_2D, USUAL, 65, 256, "friction in 2D, 129 pairs"},
    {FRICTION_2D, USUAL, 257, SIZE_MAX, "friction in 2D, 513 pairs and more"},
    {FRICTION_3D, USUAL, 0, 25, "friction in 3D, 25 pairs"},
    {FRICTION_3D, USUAL, 225, 225, "friction in 3D, 225 pairs"},
    {FRICTION_3D, USUAL, 961, 961, "friction in 3D, 961 pairs"},
    {FRICTION_3D, USUAL, 2025, 2025, "friction in 3D, 2025 pairs"},
    {FRICTION_3D, COLUMNS, 0, SIZE_MAX, "friction in 3D, slender columns"},
    {FRICTION_2D, HELD, 0, 130, "held out, 2D, up to 130 pairs"},
    {FRICTION_2D, HELD, 131, 400, "held out, 2D, 131 to 400"},
    {FRICTION_2D, HELD, 401, SIZE_MAX, "held out, 2D, 401 and more"},
    {FRICTION_3D, HELD, 0, 130, "held out, 3D, up to 130 pairs"},
    {FRICTION_3D, HELD, 131, 400, "held out, 3D, 131 to 400"},
    {FRICTION_3D, HELD, 401, SIZE_MAX, "held out, 3D, 401 and more"},
};
enum { CLASSES = sizeof classes / sizeof classes[0] };

static enum group group_of(const struct row *row)
{
    return row->geometry >= HELD_OUT ? HELD : row->geometry >= COLUMN_10 ? COLUMNS : USUAL;
}

/* True if a row of the default solver is one of a class. */
static int is_of(const struct row *row, const struct class *class)
{
    return !is_peer(row) && strcmp(row->solver->name, "auto") == 0 && is_solved(row) &&
           row->solver->family == class->family && group_of(row) == class->group &&
           row->pairs >= class->least && row->pairs <= class->most;
}

static void speed_means(FILE *file, const struct row *rows, size_t count)
{
    for (size_t c = 0; c < CLASSES; c++) {
        struct mean mean = {0};
        for (size_t k = 0; k < count; k++) {
            const struct row *best = best_peer(rows, count, &rows[k]);
            if (is_of(&rows[k], &classes[c]) && best != NULL)
                add(&mean, best->ms / rows[k].ms);
        }
        say_mean(file, classes[c].name, &mean);
    }
}

/* Pivots in a second, ours to theirs, of the same forms of the same problems. */
static void lemke_means(FILE *file, const struct row *rows, size_t count)
{
    static const struct {
        const char *ours, *theirs;
    } forms[] = {{"lemke", "lemke_K"}, {"lemke_W", "lemke_W"}};
    static const size_t sizes[] = {33, 129, 513, 1025, 2049};
    for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; s++) {
        struct mean mean = {0};
        for (size_t k = 0; k < count; k++)
            for (size_t form = 0; form < 2; form++) {
                const struct row *row = &rows[k];
                if (is_peer(row) || row->solver->family != FRICTIONLESS ||
                    row->pairs != sizes[s] || strcmp(row->solver->name, forms[form].ours) != 0)
                    continue;
                const struct row *peer = find(rows, count, row, "siconos", forms[form].theirs);
                if (peer != NULL && peer->ms > 0.0 && peer->iterations > 0 && row->iterations > 0)
                    add(&mean, (row->iterations / row->ms) / (peer->iterations / peer->ms));
            }
        char what[64];
        snprintf(what, sizeof what, "Lemke's method, pivots per second, %zu pairs", sizes[s]);
        say_mean(file, what, &mean);
    }
}

/* How much the default solve costs in units of one LU factorisation. */
static void lu_means(FILE *file, const struct row *rows, size_t count)
{
    fprintf(file, "\n| default solve over one LU | problems | mean | most |\n"
                  "|---|---|---|---|\n");
    for (size_t c = 0; c < CLASSES; c++) {
        struct mean mean = {0};
        double most = 0.0;
        for (size_t k = 0; k < count; k++)
            if (is_of(&rows[k], &classes[c]) && rows[k].lu_ms > 0.0) {
                add(&mean, rows[k].ms / rows[k].lu_ms);
                most = fmax(most, rows[k].ms / rows[k].lu_ms);
            }
        if (mean.count > 0)
            fprintf(file, "| %s | %d | %.2f | %.2f |\n", classes[c].name, mean.count,
                    exp(mean.logs / mean.count), most);
    }
}

/* ---- the document ---- */

/* The processor's name, as Linux has it. */
static void machine(FILE *file)
{
    char line[256], *name = NULL;
    FILE *info = fopen("/proc/cpuinfo", "r");
    while (info != NULL && name == NULL && fgets(line, sizeof line, info) != NULL)
        if (strncmp(line, "model name", 10) == 0 && (name = strchr(line, ':')) != NULL)
            name[strcspn(name, "\n")] = '\0';
    if (info != NULL)
        fclose(info);
    fprintf(file, "%s", name != NULL ? name + 2 : "unknown processor");
}

static void failures(FILE *file, const struct row *rows, size_t count, const struct row *like)
{
    const char *separator = "";
    for (size_t k = 0; k < count; k++)
        if (same_problem(&rows[k], like) && !is_solved(&rows[k])) {
            fprintf(file, "%s%s%s %s", separator, is_peer(&rows[k]) ? "" : "**ours** ",
                    rows[k].solver->name, rows[k].status);
            separator = ", ";
        }
}

/* One row of the table; returns whether its ratio is to a peer that is usable only. */
static int table_row(FILE *file, const struct row *rows, size_t count, const struct row *row)
{
    const struct row *best = best_peer(rows, count, row);
    int marked = 0;
    fprintf(file, "| %s | %s | %zu | %g | ", family_name(row->solver->family),
            geometry_name(row->geometry), row->pairs, row->mu);
    if (is_solved(row))
        fprintf(file, "%.3g | ", row->ms);
    else
        fprintf(file, "%s | ", row->status);
    if (row->lu_ms > 0.0 && is_solved(row))
        fprintf(file, "%.2f | ", row->ms / row->lu_ms);
    else if (row->lu_ms > 0.0)
        fprintf(file, "- | ");
    if (best != NULL && is_solved(row)) {
        marked = !is_solved(best);
        fprintf(file, "%.4g%s | %.2f | %s | ", best->ms, marked ? " (*)" : "",
                best->ms / row->ms, best->solver->name);
    } else if (best != NULL) {
        fprintf(file, "%.4g | - | %s | ", best->ms, best->solver->name);
    } else {
        fprintf(file, "none | - | - | ");
    }
    failures(file, rows, count, row);
    fprintf(file, " |\n");
    return marked;
}

/* The problems without a yardstick, or those that have one. */
static void table(FILE *file, const struct row *rows, size_t count, int has_lu)
{
    int marked = 0, begun = 0;
    for (size_t k = 0; k < count; k++) {
        const struct row *row = &rows[k];
        if (is_peer(row) || strcmp(row->solver->name, "auto") != 0 ||
            (row->lu_ms > 0.0) != has_lu)
            continue;
        if (!begun)
            fprintf(file, "| family | geometry | pairs | mu | `auto`, ms |%s best of Siconos, ms | "
                          "ratio | which | not solved |\n|---|---|---|---|---|%s---|---|---|---|\n",
                    has_lu ? " over LU |" : "", has_lu ? "---|" : "");
        begun = 1;
        marked |= table_row(file, rows, count, row);
    }
    if (marked)
        fprintf(file, "\n(*) No peer reaches 1e-12 here: the fastest with `eta <= 1e-8` counts.\n");
    if (begun)
        fprintf(file, "\n");
}

void write_markdown(FILE *file, const struct row *rows, size_t count, const char *versions,
                    double limit)
{
    char date[32];
    const time_t now = time(NULL);
    strftime(date, sizeof date, "%Y-%m-%d", gmtime(&now));
    fprintf(file, "%s, one core of: ", date);
    machine(file);
    fprintf(file, ". %s\n\n", versions);
    fprintf(file,
            "Thread CPU time to `eta <= 1e-12`, measured by the same certificate for every solver; "
            "a call may take %g s, in space a hundred LU factorisations if that is less (0.2 s at "
            "the least). Siconos is Debian's build, for any x86-64 but for its BLAS; each of its "
            "solvers runs at the loosest tolerance whose answer is accepted, on stiffness (`_K`) "
            "and flexibility (`_W`). With friction it is given the flexibility, whose computation "
            "is not timed. LU: one `dgetrf` of the stiffness, same BLAS, same run.\n\n",
            limit);
    table(file, rows, count, 0);
    table(file, rows, count, 1);
    fprintf(file, "| geometric means of the ratios | problems | mean | least |\n"
                  "|---|---|---|---|\n");
    speed_means(file, rows, count);
    lemke_means(file, rows, count);
    lu_means(file, rows, count);
}
