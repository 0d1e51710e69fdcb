/*
 * Mistakes that users make, and what they are told: a row for each, with the status and the
 * sentence, and whether the words that name the mistake are there. What no library can see, such as
 * wrong units, is not here.
 */

#include "check.h"
#include "small_block.h"

/* A row: words that the sentence must have, NULL if it must be empty; the remarks of the report. */
static void row(int line, const char *mistake, int32_t status, const char *const words[3],
                int32_t remarks)
{
    const int32_t got = small_block_run();
    const int32_t remarked = got >= 0 ? block.report.remarks : 0;
    printf("| %s | C | %d | %s |%s\n", mistake, (int)got, block.sentence,
           remarked ? " remarks" : "");
    if (!check_result(__FILE__, line, got == status)) printf("not %d\n", (int)status);
    if (!check_result(__FILE__, line, remarked == remarks))
        printf("remarks %d, not %d\n", (int)remarked, (int)remarks);
    if (!words[0] && !check_result(__FILE__, line, !*block.sentence)) printf("a sentence\n");
    for (int i = 0; i < 3 && words[i]; i++)
        if (!check_result(__FILE__, line, strstr(block.sentence, words[i]) != NULL))
            printf("not a word of \"%s\"\n", words[i]);
}

#define WORDS(...) ((const char *const[3]){__VA_ARGS__})
/* A mistake, the status, the words, the remarks; then the statements that make it. */
#define MISTAKE(mistake, status, words, remarks, ...)                                             \
    do {                                                                                          \
        small_block_prepare();                                                                    \
        __VA_ARGS__;                                                                              \
        row(__LINE__, mistake, status, words, remarks);                                           \
    } while (0)
#define REFUSED(mistake, status, words, ...) MISTAKE(mistake, status, words, 0, __VA_ARGS__)

static void each_pair(double *numbers, double value)
{
    for (int i = 0; i < PAIRS; i++) numbers[i] = value;
}

static void indices(void)
{
    REFUSED("counted from 1, index_base 0", -1,
            WORDS("col_start[0] is 1, but index_base is 0", "set index_base to 1"),
            store(DOFS, SIGNORINI_TRIANGLE_LOWER, 1), block.K.index_base = 0);
    REFUSED("counted from 0, index_base 1", -1,
            WORDS("col_start[0] is 0, but index_base is 1", "set index_base to 0"),
            block.K.index_base = 1);
    REFUSED("matrix counted from 1, the rest from 0", -3, WORDS("fixed[0] is 0, less than 1"),
            store(DOFS, SIGNORINI_TRIANGLE_LOWER, 1));
    REFUSED("int32_t arrays, index_bytes 8", -1,
            WORDS("col_start[0] is", "4 bytes, and index_bytes 8?"), block.K.index_bytes = 8);
    REFUSED("int64_t arrays, index_bytes 4", -1, WORDS("8 bytes, and index_bytes 4?"),
            block.K.col_start = block.wide_start, block.K.row = block.wide_row);
    REFUSED("col_start int64_t, row int32_t", -1, WORDS("col_start[3] is 0", "index_bytes 4?"),
            block.K.col_start = block.wide_start);
    REFUSED("index_bytes forgotten", -1, WORDS("index_bytes is 0, it must be 4 or 8"),
            block.K.index_bytes = 0);
    REFUSED("size is the number of nodes", -1,
            WORDS("size, here 12, must be the number of degrees of freedom", "nnz is 139"),
            block.K.size = NODES);
    REFUSED("one entry too few", -1, WORDS("the columns hold 139 entries", "nnz is 138"),
            block.K.nnz--);
    REFUSED("entries of one place not summed", -1,
            WORDS("listed twice", "sum the values"), block.row[1] = 0);
}

static void matrices(void)
{
    REFUSED("one triangle stored, FULL said", -1,
            WORDS("K is not symmetric", "K[0,1] is 0", "if one triangle is stored, triangle must name it"),
            block.K.triangle = SIGNORINI_TRIANGLE_FULL);
    REFUSED("lower stored, UPPER said", -1, WORDS("not in the triangle"),
            block.K.triangle = SIGNORINI_TRIANGLE_UPPER);
    small_block_prepare();
    for (int j = 0; j < DOFS; j++)
        for (int i = 0; i < j; i++)
            block.dense[i + DOFS * j] = (double)(float)(block.dense[i + DOFS * j] * (1 + 1e-7));
    store(DOFS, SIGNORINI_TRIANGLE_FULL, 0);
    row(__LINE__, "one triangle in single precision", -1,
        WORDS("K is not symmetric", "1e-9 is allowed", "hand over one triangle"), 0);
    REFUSED("a degree of freedom without stiffness", -1,
            WORDS("nothing resists degree of freedom 24: list it in fixed"),
            store(DOFS + 1, SIGNORINI_TRIANGLE_LOWER, 0));
    /* That remedy is taken. */
    REFUSED("the same, listed in fixed: right", 0, WORDS(NULL),
            store(DOFS + 1, SIGNORINI_TRIANGLE_LOWER, 0), block.fixed[block.n_fixed++] = DOFS);
    REFUSED("struct_size forgotten", -1, WORDS("struct_size is 0, set it to sizeof"),
            block.K.struct_size = 0);
}

static void pairs(void)
{
    REFUSED("masters and weights, master_start NULL", -4,
            WORDS("master_start is NULL, but masters or weights is not"),
            block.pairs.masters = block.masters, block.pairs.weights = block.weights);
    REFUSED("masters face themselves", -4, WORDS("pair 0", "its weights cancel"),
            block.pairs.master_start = block.master_start, block.pairs.masters = block.slaves,
            block.pairs.weights = block.weights);
    REFUSED("weights sum to 2", -4, WORDS("pair 0: its weights sum to 2, not to 1"),
            block.pairs.master_start = block.master_start, block.pairs.masters = block.masters,
            block.pairs.weights = block.weights, each_pair(block.weights, 2));
    REFUSED("normals not set", -4, WORDS("pair 0: its normal is zero"), block.normals[1] = 0);
    REFUSED("no pairs, and a body that floats", -1,
            WORDS("a motion remains that no support and no pair holds",
                  "most of all degree of freedom"),
            block.pairs.count = 0);
}

/* That bodies move away as springs are let go is seen before rounding ends it, or not: on aarch64 it is not. */
#if defined(__x86_64__) || defined(_M_X64)
#define AWAY "the bodies move away"
#else
#define AWAY "eta is"
#endif

/* The sentence on a body that flies off says what to look at. */
static void signs(void)
{
    const char *const off[3] = {"no equilibrium exists", "the slave of pair ",
                                "is a normal, a load or the sign of gap turned round?"};
    REFUSED("normals point into the body", 4, off,
            for (int i = 0; i < PAIRS; i++) block.normals[2 * i + 1] = 1);
    REFUSED("the load turned round", 4, off,
            for (int i = 0; i < DOFS; i++) block.f[i] = -block.f[i]);
    REFUSED("pushed along the plane, nothing holds", 4,
            WORDS("most of all degree of freedom", "the resultant of the loads along it is 1.000e-1",
                  "are a support, friction, or a pair missing"),
            block.n_fixed = 0, each_pair(block.mu, 0), block.f[16] = 0.1);
    REFUSED("x and y exchanged in slaves", 5,
            WORDS("no method converges", AWAY, "is a normal, a load"),
            for (int i = 0; i < PAIRS; i++) {
                block.slaves[2 * i] = 2 * i + 1;
                block.slaves[2 * i + 1] = 2 * i;
            });
}

/* Legal, and often a mistake: a remark in the report. */
static void remarks(void)
{
    MISTAKE("right", 0, WORDS(NULL), 0, (void)0);
    MISTAKE("the sign of gap turned round", 0, WORDS(NULL), SIGNORINI_REMARK_GAPS_NEGATIVE,
            each_pair(block.gap, -1e-3));
    MISTAKE("one gap of interference: right", 0, WORDS(NULL), 0, block.gap[1] = -1e-3);
    MISTAKE("mu in percent", 0, WORDS(NULL), SIGNORINI_REMARK_FRICTION_LARGE,
            each_pair(block.mu, 30));
    MISTAKE("no support along x, no friction", 0, WORDS(NULL), SIGNORINI_REMARK_FREE_MOTION,
            block.n_fixed = 0, each_pair(block.mu, 0));
    MISTAKE("no support along x, friction: right", 0, WORDS(NULL), 0, block.n_fixed = 0);
    MISTAKE("supported, no friction: right", 0, WORDS(NULL), 0, each_pair(block.mu, 0));
    MISTAKE("gap and mu", 0, WORDS(NULL),
            SIGNORINI_REMARK_GAPS_NEGATIVE | SIGNORINI_REMARK_FRICTION_LARGE, block.n_fixed = 0,
            each_pair(block.mu, 1e3), each_pair(block.gap, -1e-3));
}

int main(void)
{
    printf("| mistake | interface | status | sentence |\n|---|---|---|---|\n");
    indices();
    matrices();
    pairs();
    signs();
    remarks();
    return check_summary("mistakes");
}
