/* Bytes to arguments, and arrays between guards. */

#include "fuzz.h"

#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

enum {
    SLOTS = 48,
    /* Bytes of the largest array. */
    ROOM = 1 << 16,
    /* Bytes beside an array that are looked at. */
    ZONE = 64,
    ZONE_BYTE = 0xC3,
    OUTPUT_BYTE = 0xA7
};

typedef struct slot {
    uint8_t *room, *array, *copy;
    size_t bytes;
    int written;
} slot;

static slot slots[SLOTS];
static int used;
static const uint8_t *at, *end;
static int is_sane, kind_of_law;

void complain(const char *format, ...)
{
    va_list list;
    va_start(list, format);
    fputs("FOUND: ", stderr);
    vfprintf(stderr, format, list);
    fprintf(stderr, " (last error: \"%s\")\n", signorini_last_error());
    va_end(list);
    abort();
}

/* ---- bytes ---- */

uint8_t byte(void)
{
    return at < end ? *at++ : 0;
}

int64_t between(int64_t low, int64_t high)
{
    return low + byte() % (high - low + 1);
}

int rarely(int odds)
{
    return byte() % odds == odds - 1;
}

int sane(void)
{
    return is_sane;
}

const uint8_t *rest(size_t *size)
{
    *size = (size_t)(end - at);
    return at;
}

double number(void)
{
    static const double odd[] = {NAN,      INFINITY, -INFINITY, 1e308, -1e308, 5e-324, -0.0,
                                 2.3e-308, 1e-200,   1e200,     1e16,  1e-16,  1e300,  -5e-324};
    const uint8_t first = byte();
    if (is_sane || first < 200) return (int8_t)first / 8.0;
    if (first < 200 + sizeof odd / sizeof *odd) return odd[first - 200];
    if (first < 235) return (int8_t)byte() * pow(10, (int8_t)byte() / 8.0);
    double bits;
    uint8_t raw[sizeof bits];
    for (size_t i = 0; i < sizeof bits; i++) raw[i] = byte();
    memcpy(&bits, raw, sizeof bits);
    return bits;
}

int64_t size_or_wrong(int64_t right)
{
    /* So large that arrays of these sizes cannot be: others a call must believe. */
    static const int64_t wrong[] = {-1, INT64_MIN, INT64_MAX, (int64_t)1 << 62};
    if (is_sane || !rarely(32)) return right;
    return wrong[between(0, 3)];
}

/* ---- arrays ---- */

static void make_slots(void)
{
    const size_t page = (size_t)sysconf(_SC_PAGESIZE);
    const size_t each = ROOM + 2 * page;
    uint8_t *all = mmap(NULL, SLOTS * each, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (all == MAP_FAILED) complain("no memory for arrays");
    for (int i = 0; i < SLOTS; i++) {
        slots[i].room = all + each * (size_t)i + page;
        slots[i].copy = malloc(ROOM);
        if (mprotect(slots[i].room, ROOM, PROT_READ | PROT_WRITE) || !slots[i].copy)
            complain("no memory for arrays");
    }
}

void begin(const uint8_t *data, size_t size)
{
    if (!slots[0].room) make_slots();
    at = data;
    end = data + size;
    used = 0;
    const uint8_t first = byte();
    is_sane = first % 4 != 3;
    kind_of_law = first / 4 % 8;
}

static uint8_t *take(size_t count, size_t bytes, int written)
{
    if (used == SLOTS || count > ROOM / bytes) complain("the entry wants more arrays than there are");
    slot *s = &slots[used++];
    s->bytes = count * bytes;
    s->written = written;
    /* Every other array lies at the page before it. */
    const int left = used % 2;
    s->array = left ? s->room : s->room + ROOM - s->bytes;
    const size_t zone = ROOM - s->bytes < ZONE ? ROOM - s->bytes : ZONE;
    memset(left ? s->array + s->bytes : s->array - zone, ZONE_BYTE, zone);
    memset(s->array, written ? OUTPUT_BYTE : 0, s->bytes);
    return s->array;
}

void *input(size_t count, size_t bytes)
{
    return take(count, bytes, 0);
}

void *indices(int64_t count, int bytes, const int64_t *values)
{
    void *array = input((size_t)count, (size_t)bytes);
    for (int64_t i = 0; i < count; i++) {
        if (bytes == 4) ((int32_t *)array)[i] = (int32_t)values[i];
        else ((int64_t *)array)[i] = values[i];
    }
    return array;
}

void *output(size_t count, size_t bytes)
{
    return take(count, bytes, 1);
}

double *numbers(int64_t count)
{
    if (count <= 0) return NULL;
    double *array = input((size_t)count, sizeof *array);
    for (int64_t i = 0; i < count; i++) array[i] = number();
    return array;
}

double *outputs(int64_t count)
{
    return count > 0 ? output((size_t)count, sizeof(double)) : NULL;
}

int32_t *states(int64_t count)
{
    return count > 0 ? output((size_t)count, sizeof(int32_t)) : NULL;
}

void *or_null(void *pointer, int odds)
{
    return rarely(odds) ? NULL : pointer;
}

void arm(void)
{
    for (int i = 0; i < used; i++) memcpy(slots[i].copy, slots[i].array, slots[i].bytes);
}

void as_input(const void *array)
{
    for (int i = 0; i < used; i++) {
        if (slots[i].array == array) slots[i].written = 0;
    }
}

void check_arrays(int32_t status)
{
    for (int i = 0; i < used; i++) {
        const slot *s = &slots[i];
        const int left = (i + 1) % 2;
        const size_t zone = ROOM - s->bytes < ZONE ? ROOM - s->bytes : ZONE;
        const uint8_t *beside = left ? s->array + s->bytes : s->array - zone;
        for (size_t k = 0; k < zone; k++) {
            if (beside[k] != ZONE_BYTE) complain("array %d: written outside of it", i);
        }
        const int refused = status < 0 || status == SIGNORINI_STATUS_MEMORY_LIMIT;
        if ((!s->written || refused) && memcmp(s->copy, s->array, s->bytes) != 0)
            complain("array %d of %zu bytes: an %s was written, status %d", i, s->bytes,
                     s->written ? "output of a refused call" : "input", (int)status);
    }
}

/* ---- problems ---- */

double *matrix(int64_t n, int64_t ld, int *definite)
{
    *definite = 0;
    if (n <= 0) return NULL;
    double *K = input((size_t)(ld * (n - 1) + n), sizeof *K);
    const int64_t kind = between(0, 7), rank = between(1, 4);
    double A[16][4];
    for (int64_t i = 0; i < n; i++) {
        for (int64_t c = 0; c < rank; c++) A[i % 16][c] = (int8_t)byte() / 16.0;
    }
    for (int64_t j = 0; j < n; j++) {
        for (int64_t i = 0; i < n; i++) {
            double sum = kind <= 3 && i == j ? 1 : 0;
            for (int64_t c = 0; c < rank; c++) sum += A[i % 16][c] * A[j % 16][c];
            if (kind == 6 && i < j) sum = K[j + ld * i];
            if (kind == 6 && i >= j) sum = number();
            if (kind == 7) sum = number();
            K[i + ld * j] = sum;
        }
    }
    if (kind == 5) {
        /* Symmetry by the symmetric of one factor, in units far apart. */
        const double unit = pow(10, (int8_t)byte() / 8.0);
        for (int64_t j = 0; j < n; j++) {
            for (int64_t i = 0; i < n; i++) K[i + ld * j] *= unit;
        }
    }
    *definite = kind <= 3;
    return K;
}

int per_pair(int32_t law)
{
    switch (law) {
    case SIGNORINI_LAW_FRICTIONLESS:
    case SIGNORINI_LAW_TIED: return 0;
    case SIGNORINI_LAW_COULOMB:
    case SIGNORINI_LAW_TRESCA: return 1;
    case SIGNORINI_LAW_BY_PAIR: return 4;
    default: return 3;
    }
}

int32_t a_law(int32_t dim)
{
    const int32_t law = (int32_t)between(0, dim == 3 ? 5 : 3);
    /* Inputs that were kept before these laws were there keep theirs. */
    if (kind_of_law == 5) return SIGNORINI_LAW_BY_PAIR;
    return kind_of_law == 6 ? SIGNORINI_LAW_TIED : law;
}

/* Makes three numbers such as a law has them, zero behind its own. */
static void obey(int32_t law, double *of)
{
    const int count = per_pair(law);
    for (int i = 0; i < 3; i++) of[i] = i < count ? fabs(of[i]) / 4 : 0;
    if (law == SIGNORINI_LAW_COHESIVE) of[1] += of[0] * of[2];
    else if (count == 3) { of[0] += 0.125; of[1] += 0.125; }
}

double *friction_numbers(int32_t dim, int32_t law, int64_t pairs)
{
    const int count = per_pair(law);
    if (count == 0 || pairs <= 0) return NULL;
    double *friction = numbers(count * pairs);
    for (int64_t i = 0; i < pairs; i++) {
        double *of = friction + count * i;
        if (law == SIGNORINI_LAW_BY_PAIR) {
            const int64_t own = between(0, dim == 3 ? 6 : 4);
            of[0] = own == (dim == 3 ? 6 : 4) ? SIGNORINI_LAW_TIED : (double)own;
            if (sane()) obey((int32_t)of[0], of + 1);
        } else if (sane() && count == 3) {
            obey(law, of);
        } else if (sane()) {
            of[0] = fabs(of[0]) / 4;
        }
    }
    return friction;
}

problem a_problem(void)
{
    problem p = {.dim = (int32_t)between(2, 3), .pairs = between(0, 4)};
    p.law = a_law(p.dim);
    p.n = p.dim * p.pairs;
    p.ld = (p.n > 1 ? p.n : 1) + (rarely(4) ? 2 : 0);
    p.K = matrix(p.n, p.ld, &p.definite);
    p.f = numbers(p.n);
    p.gap = numbers(p.pairs);
    for (int64_t i = 0; i < p.pairs; i++) {
        if (rarely(8)) p.gap[i] = INFINITY;
        else if (rarely(3)) p.gap[i] = 0;
    }
    p.friction = friction_numbers(p.dim, p.law, p.pairs);
    p.slip0 = rarely(2) ? numbers(p.n - p.pairs) : NULL;
    return p;
}

signorini_settings *a_settings(void)
{
    if (rarely(4)) return NULL;
    /* An older program's structure is smaller. */
    const size_t bytes = rarely(4) ? 8 * (size_t)between(2, 10) : sizeof(signorini_settings);
    signorini_settings *settings = input(bytes, 1), whole;
    if (signorini_settings_default(&whole, sizeof whole) != 0) complain("no default settings");
    whole.struct_size = (uint32_t)bytes;
    whole.max_iterations = 200;
    whole.method = rarely(4) ? (int32_t)between(1, 6) : SIGNORINI_METHOD_AUTO;
    whole.search = rarely(64);
    whole.proof = rarely(32);
    if (rarely(4)) whole.tolerance = pow(10, -(double)between(2, 14));
    if (!sane() && rarely(4)) {
        whole.tolerance = rarely(4) ? number() : whole.tolerance;
        whole.omega = number();
        whole.damping = number();
        whole.method = (int32_t)between(-1, 9);
        whole.reserved = rarely(8);
        whole.memory_limit = (int64_t)number() % 1000;
        if (rarely(8)) whole.struct_size = (uint32_t)between(0, 255);
        if (whole.struct_size > bytes) whole.struct_size = (uint32_t)bytes;
    }
    memcpy(settings, &whole, bytes);
    return settings;
}

double tolerance_of(const signorini_settings *settings)
{
    return settings ? settings->tolerance : 1e-10;
}

signorini_report *a_report(void)
{
    const uint32_t bytes = rarely(4) ? 8 * (uint32_t)between(2, 22) : sizeof(signorini_report);
    signorini_report *report = output(bytes, 1);
    report->struct_size = bytes;
    return report;
}

signorini_extra *an_extra(int64_t n, int64_t pairs, int64_t cases)
{
    if (rarely(2)) return NULL;
    signorini_extra *extra = input(1, sizeof *extra);
    if (signorini_extra_default(extra, sizeof *extra) != 0) complain("no default extra");
    extra->motion = outputs(n * cases);
    extra->second_d = or_null(outputs(n * cases), 4);
    extra->second_F = or_null(outputs(n * cases), 4);
    extra->second_state = or_null(states(pairs * cases), 4);
    extra->radius_d = or_null(outputs(n * cases), 4);
    extra->radius_F = or_null(outputs(n * cases), 4);
    extra->escape = or_null(outputs(n * cases), 4);
    return extra;
}

void check_status(int32_t status, int arguments)
{
    if (status == SIGNORINI_STATUS_OUT_OF_MEMORY || status == SIGNORINI_STATUS_FILE) return;
    if (status == SIGNORINI_STATUS_INTERNAL) complain("a defect of the library");
    if (status < -arguments || status > SIGNORINI_STATUS_MEMORY_LIMIT)
        complain("status %d", (int)status);
    const char *sentence = signorini_last_error();
    /* a solved call has a sentence for its remarks alone */
    bool remarks = strstr(sentence, "solved: ") && strstr(sentence, "; remark: ");
    if (status == 0 ? sentence[0] && !remarks : !sentence[0] || remarks)
        complain("status %d and this sentence", (int)status);
    for (; *sentence; sentence++) {
        if ((unsigned char)*sentence < ' ') complain("a line feed in the sentence");
    }
}

void check_recovered(int32_t status, const double *values, int64_t count)
{
    if (status != 0 && !sane()) return;
    REQUIRE(status == 0);
    for (int64_t i = 0; i < count; i++) REQUIRE(isfinite(values[i]));
}
