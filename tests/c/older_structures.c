/*
 * Structures of any size that a program may have, anywhere in its memory: at the end of a page before one that
 * cannot be touched, in memory that cannot be written where the library only reads, and directly before an array
 * of the same call.
 */

#define _GNU_SOURCE

#include "check.h"

#include <stddef.h>
#include <stdlib.h>
#ifdef _WIN32
#include <windows.h>
#else
#include <sys/mman.h>
#include <unistd.h>
#endif

static size_t page;

#ifdef _WIN32
static size_t page_size(void)
{
    SYSTEM_INFO info;
    GetSystemInfo(&info);
    return info.dwPageSize;
}

/* Two pages, of which the second cannot be touched; NULL: there are none. */
static unsigned char *two_pages(void)
{
    DWORD before;
    unsigned char *both = VirtualAlloc(NULL, 2 * page, MEM_COMMIT | MEM_RESERVE, PAGE_READWRITE);
    return both && VirtualProtect(both + page, page, PAGE_NOACCESS, &before) ? both : NULL;
}

static int give_back(unsigned char *first)
{
    return VirtualFree(first, 0, MEM_RELEASE) != 0;
}

static int protect(unsigned char *first)
{
    DWORD before;
    return VirtualProtect(first, page, PAGE_READONLY, &before) != 0;
}
#else
static size_t page_size(void)
{
    return (size_t)sysconf(_SC_PAGESIZE);
}

/* Two pages, of which the second cannot be touched; NULL: there are none. */
static unsigned char *two_pages(void)
{
    unsigned char *both =
        mmap(NULL, 2 * page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    return both != MAP_FAILED && mprotect(both + page, page, PROT_NONE) == 0 ? both : NULL;
}

static int give_back(unsigned char *first)
{
    return munmap(first, 2 * page) == 0;
}

static int protect(unsigned char *first)
{
    return mprotect(first, page, PROT_READ) == 0;
}
#endif

static unsigned char *page_of(void *place)
{
    return (unsigned char *)((uintptr_t)place / page * page);
}

/* `bytes` bytes at the end of a page; the next one cannot be touched. */
static void *at_the_end(size_t bytes)
{
    unsigned char *both = two_pages();
    if (both == NULL) exit(2);
    memset(both, 0xEE, page);
    return both + page - bytes;
}

static void drop(void *place)
{
    CHECK(give_back(page_of(place)));
}

static void only_read(void *place)
{
    CHECK(protect(page_of(place)));
}

/* Pressed by 10 and pushed by 8 against 5 of friction: it slips by 1. */
static const double K[4] = {5, 0, 0, 3}, f[2] = {10, 8}, gap[1] = {0}, mu[1] = {0.5};

static int32_t solve(const signorini_settings *settings, double *d, double *F,
                     signorini_report *report, const signorini_extra *extra)
{
    return signorini_solve(2, 1, K, 2, f, gap, SIGNORINI_LAW_COULOMB, mu, NULL, settings, d, F, NULL,
                           report, extra);
}

static void settings_of_each_size(void)
{
    for (uint32_t size = 16; size <= sizeof(signorini_settings); size += 8) {
        double d[2], F[2];
        signorini_settings *settings = at_the_end(size);
        CHECK_STATUS(signorini_settings_default(settings, size), 0);
        only_read(settings);
        CHECK_STATUS(solve(settings, d, F, NULL, NULL), 0);
        CHECK_NEAR(d[1], 1);
        const double M[1] = {2}, q[1] = {-4};
        CHECK_STATUS(signorini_lcp_solve(1, M, 1, q, NULL, settings, F, d, NULL, NULL), 0);
        CHECK_NEAR(d[0], 2);
        signorini_model *model = NULL;
        CHECK_STATUS(signorini_model_new_condensed(2, 1, K, 2, NULL, &model), 0);
        CHECK_STATUS(signorini_model_solve(model, 1, f, NULL, gap, SIGNORINI_LAW_COULOMB, mu, NULL,
                                           settings, d, F, NULL, NULL, NULL, NULL), 0);
        signorini_model_free(model);
        CHECK_STATUS(solve_flexibility(2, 1, K, 2, f, gap, SIGNORINI_LAW_FRICTIONLESS,
                                                 NULL, NULL, settings, d, F, NULL, NULL, NULL), 0);
        drop(settings);
    }
}

static void reports_of_each_size(void)
{
    for (uint32_t size = 16; size <= sizeof(signorini_report); size += 8) {
        double d[2], F[2];
        signorini_report *report = at_the_end(size);
        CHECK_STATUS(signorini_report_default(report, size), 0);
        CHECK_STATUS(solve(NULL, d, F, report, NULL), 0);
        CHECK(report->struct_size == size && report->status == 0);
        CHECK_STATUS(certify_condensed(2, 1, K, 2, f, gap, SIGNORINI_LAW_COULOMB, mu, NULL, 1e-9, d,
                                       NULL, NULL, report), 0);
        const double M[1] = {2}, q[1] = {-4};
        CHECK_STATUS(signorini_lcp_solve(1, M, 1, q, NULL, NULL, F, d, NULL, report), 0);
        CHECK_STATUS(solve_flexibility(2, 1, K, 2, f, gap, SIGNORINI_LAW_FRICTIONLESS,
                                                 NULL, NULL, NULL, d, F, NULL, report, NULL), 0);
        drop(report);
        /* Two of a model's cases, one behind the other. */
        unsigned char *two = at_the_end(2 * size);
        memcpy(two, &size, sizeof size);
        memcpy(two + size, &size, sizeof size);
        const double f2[4] = {10, 8, -1, 0}, gap2[2] = {0, 0}, mu2[2] = {0.5, 0.5};
        double d2[4], F2[4];
        signorini_model *model = NULL;
        CHECK_STATUS(signorini_model_new_condensed(2, 1, K, 2, NULL, &model), 0);
        CHECK_STATUS(signorini_model_solve(model, 2, f2, NULL, gap2, SIGNORINI_LAW_COULOMB, mu2,
                                           NULL, NULL, d2, F2, NULL, NULL,
                                           (signorini_report *)(void *)two, NULL), 0);
        CHECK_NEAR(d2[1], 1);
        CHECK(((signorini_report *)(void *)(two + size))->struct_size == size);
        signorini_model_free(model);
        drop(two);
    }
}

static void extras_of_each_size(void)
{
    for (uint32_t size = 16; size <= sizeof(signorini_extra); size += 8) {
        double d[2], F[2], motion[2] = {7, 7};
        signorini_extra *extra = at_the_end(size);
        CHECK_STATUS(signorini_extra_default(extra, size), 0);
        extra->motion = motion;
        only_read(extra);
        CHECK_STATUS(solve(NULL, d, F, NULL, extra), 0);
        CHECK(motion[0] == 0 && motion[1] == 0);
        drop(extra);
    }
}

/* A short structure, and an array of the call right behind it: they share nothing. */
static void structures_before_arrays(void)
{
    unsigned char *room = malloc(512);
    if (!room) exit(2);
    for (uint32_t size = 16; size <= sizeof(signorini_report); size += 8) {
        double *d = (double *)(void *)(room + size), *F = d + 2;
        memset(room, 0xEE, 512);
        memcpy(room, &size, sizeof size);
        CHECK_STATUS(solve(NULL, d, F, (signorini_report *)(void *)room, NULL), 0);
        CHECK_NEAR(d[1], 1);
        CHECK_STATUS(certify_condensed(2, 1, K, 2, f, gap, SIGNORINI_LAW_COULOMB, mu, NULL, 1e-9, d,
                                       F, NULL, (signorini_report *)(void *)room), 0);
        CHECK_STATUS(solve_flexibility(2, 1, K, 2, f, gap, SIGNORINI_LAW_FRICTIONLESS,
                                                 NULL, NULL, NULL, d, F, NULL,
                                                 (signorini_report *)(void *)room, NULL), 0);
        const double M[1] = {2}, q[1] = {-4};
        CHECK_STATUS(signorini_lcp_solve(1, M, 1, q, NULL, NULL, d, F, NULL,
                                         (signorini_report *)(void *)room), 0);
        /* One entry nearer they do share, whatever the size of today. */
        CHECK(solve(NULL, d - 1, F, (signorini_report *)(void *)room, NULL) < 0);
    }
    for (uint32_t size = 16; size <= sizeof(signorini_settings); size += 8) {
        double *d = (double *)(void *)(room + size), *F = d + 2;
        CHECK_STATUS(signorini_settings_default((signorini_settings *)(void *)room, size), 0);
        CHECK_STATUS(solve((signorini_settings *)(void *)room, d, F, NULL, NULL), 0);
        CHECK_NEAR(d[1], 1);
    }
    for (uint32_t size = 16; size <= sizeof(signorini_extra); size += 8) {
        double *d = (double *)(void *)(room + size), *F = d + 2;
        CHECK_STATUS(signorini_extra_default((signorini_extra *)(void *)room, size), 0);
        CHECK_STATUS(solve(NULL, d, F, NULL, (signorini_extra *)(void *)room), 0);
        CHECK_NEAR(d[1], 1);
        /* Arrays that are only read must not be written to either. */
        CHECK_STATUS(solve(NULL, d - 1, F, NULL, (signorini_extra *)(void *)room), -15);
        CHECK_TEXT(signorini_last_error(), "extra overlaps d");
    }
    free(room);
}

/* Sizes that no structure has. */
static void sizes_that_are_refused(void)
{
    double d[2], F[2];
    for (uint32_t size = 0; size <= sizeof(signorini_report); size++) {
        if (size >= 16 && size % 8 == 0) continue;
        signorini_report *report = at_the_end(size < 8 ? 8 : (size + 7) / 8 * 8);
        report->struct_size = size;
        CHECK_STATUS(solve(NULL, d, F, report, NULL), -14);
        CHECK_TEXT(signorini_last_error(), "struct_size");
        if (size < 4) {
            drop(report);
            continue;
        }
        CHECK_STATUS(signorini_report_default(report, size), -2);
        drop(report);
    }
    for (uint32_t size = 4; size <= sizeof(signorini_settings); size++) {
        if (size >= 16 && size % 8 == 0) continue;
        signorini_settings *settings = at_the_end((size + 7) / 8 * 8);
        settings->struct_size = size;
        CHECK_STATUS(solve(settings, d, F, NULL, NULL), -10);
        CHECK_STATUS(signorini_settings_default(settings, size), -2);
        drop(settings);
    }
}

/* Structures of a later version, larger by a few words: words of zero are accepted, and any other byte is refused where
 * the library reads; where it writes, all that it does not know becomes zero, and nothing behind it is touched. */
static void later_structures(void)
{
    for (uint32_t more = 8; more <= 32; more += 8) {
        double d[2], F[2], motion[2] = {7, 7};
        signorini_settings *settings = at_the_end(sizeof *settings + more);
        signorini_extra *extra = at_the_end(sizeof *extra + more);
        signorini_report *report = at_the_end(sizeof *report + more);
        unsigned char *const beyond = (unsigned char *)settings + sizeof *settings;
        const unsigned char *const told = (unsigned char *)report + sizeof *report;
        CHECK_STATUS(signorini_settings_default(settings, (uint32_t)sizeof *settings + more), 0);
        CHECK_STATUS(signorini_extra_default(extra, (uint32_t)sizeof *extra + more), 0);
        CHECK(settings->struct_size == sizeof *settings + more && settings->tolerance == 1e-10);
        report->struct_size = (uint32_t)sizeof *report + more;
        extra->motion = motion;
        CHECK_STATUS(solve(settings, d, F, report, extra), 0);
        CHECK_NEAR(d[1], 1);
        CHECK(motion[0] == 0 && report->pairs_slipping == 1 && report->struct_size == sizeof *report + more);
        for (uint32_t i = 0; i < more; i++) CHECK(beyond[i] == 0 && told[i] == 0);
        for (uint32_t i = 0; i < more; i++) {
            beyond[i] = 1;
            CHECK_STATUS(solve(settings, d, F, NULL, NULL), -10);
            CHECK_TEXT(signorini_last_error(), "leave the fields of a later version at zero");
            beyond[i] = 0;
        }
        memset(report, 0xEE, sizeof *report + more);
        CHECK_STATUS(signorini_report_default(report, (uint32_t)sizeof *report + more), 0);
        CHECK(report->eta == 0 && told[0] == 0 && told[more - 1] == 0);
        /* A structure that the library only reads in place, one that it has no older form of, and a view. */
        signorini_model *model = NULL;
        signorini_model_data *data = at_the_end(sizeof *data + more);
        signorini_sparse *A = at_the_end(sizeof *A + more);
        const int64_t start[3] = {0, 1, 2}, row[2] = {0, 1}, slaves[2] = {0, 1};
        const double values[2] = {2, 2}, normals[2] = {1, 0};
        const signorini_pairs pairs = {.struct_size = sizeof pairs, .dim = 2, .count = 1, .slaves = slaves,
            .normals = normals};
        memset(A, 0, sizeof *A + more);
        *A = (signorini_sparse){.struct_size = (uint32_t)sizeof *A + more, .index_bytes = 8, .size = 2, .nnz = 2,
            .col_start = start, .row = row, .values = values};
        data->struct_size = (uint32_t)sizeof *data + more;
        CHECK_STATUS(signorini_model_new_sparse(A, 0, NULL, &pairs, settings, &model), 0);
        CHECK_STATUS(signorini_model_view(model, data), 0);
        CHECK(data->host_size == 2 && ((unsigned char *)data)[sizeof *data + more - 1] == 0);
        signorini_model_free(model);
        ((unsigned char *)A)[sizeof *A] = 1;
        CHECK_STATUS(signorini_model_new_sparse(A, 0, NULL, &pairs, settings, &model), -1);
        void *const all[] = {settings, extra, report, data, A};
        for (size_t i = 0; i < sizeof all / sizeof *all; i++) drop(all[i]);
    }
}

/* A spring of 2 and a rigid obstacle, the structures of the sparse model each at the end of a page. */
static void structures_of_a_sparse_model(void)
{
    const int64_t start[3] = {0, 1, 2}, row[2] = {0, 1}, slaves[2] = {0, 1};
    const double values[2] = {2, 2}, normals[2] = {1, 0};
    const signorini_sparse matrix = {.struct_size = sizeof matrix, .index_bytes = 8, .size = 2,
        .nnz = 2, .col_start = start, .row = row, .values = values};
    const signorini_pairs contact = {.struct_size = sizeof contact, .dim = 2, .count = 1,
        .slaves = slaves, .normals = normals};
    const uint32_t sizes[2][2] = {
        {sizeof matrix, sizeof contact},
        {offsetof(signorini_sparse, order), offsetof(signorini_pairs, row_start)}};
    for (int older = 0; older < 2; older++) {
        signorini_sparse *A = at_the_end(sizes[older][0]);
        signorini_pairs *pairs = at_the_end(sizes[older][1]);
        memcpy(A, &matrix, sizes[older][0]);
        memcpy(pairs, &contact, sizes[older][1]);
        A->struct_size = sizes[older][0];
        pairs->struct_size = sizes[older][1];
        only_read(A);
        only_read(pairs);
        signorini_model *model = NULL;
        CHECK_STATUS(signorini_model_new_sparse(A, 0, NULL, pairs, NULL, &model), 0);
        signorini_model_free(model);
        drop(A);
        drop(pairs);
    }
}

/* A line of two nodes above a plane: the structures of surfaces. */
static void structures_of_a_surface(void)
{
    const double x[4] = {0, 1, 1, 1}, d[4] = {0}, F[4] = {-1, 0, -1, 0};
    const int64_t nodes[2] = {0, 1};
    signorini_faces *faces = at_the_end(sizeof *faces);
    signorini_obstacle *plane = at_the_end(sizeof *plane);
    signorini_surface_settings *settings = at_the_end(sizeof *settings);
    signorini_surface_data *data = at_the_end(sizeof *data);
    signorini_resultant *resultant = at_the_end(sizeof *resultant);
    signorini_contact_fields *fields = at_the_end(sizeof *fields);
    *faces = (signorini_faces){.struct_size = sizeof *faces, .face_nodes = 2, .count = 1, .nodes = nodes};
    *plane = (signorini_obstacle){.struct_size = sizeof *plane, .kind = SIGNORINI_OBSTACLE_PLANE,
        .direction = {0, 1}};
    *fields = (signorini_contact_fields){.struct_size = sizeof *fields};
    CHECK_STATUS(signorini_surface_settings_default(settings, sizeof *settings), 0);
    data->struct_size = sizeof *data;
    resultant->struct_size = sizeof *resultant;
    only_read(faces);
    only_read(plane);
    only_read(settings);
    only_read(fields);
    signorini_surface_pairs *contact = NULL;
    CHECK_STATUS(signorini_surface_pair_obstacle(2, 2, x, faces, plane, settings, &contact), 0);
    CHECK_STATUS(signorini_surface_view(contact, data), 0);
    CHECK(data->pairs == 2 && data->rows->count == 2);
    CHECK_STATUS(signorini_surface_resultant(contact, NULL, d, F, NULL, resultant), 0);
    /* The plane pushes upwards with 2. */
    CHECK_NEAR(resultant->force[1], 2);
    CHECK_STATUS(signorini_surface_fields(contact, NULL, NULL, d, F, NULL, fields), 0);
    signorini_surface_free(contact);
    void *const all[] = {faces, plane, settings, data, resultant, fields};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) drop(all[i]);
}

/* Settings and data of surfaces of each size: what a program does not know has its default, and is not written. */
static void surfaces_of_each_size(void)
{
    const double x[] = {0, 0, 1, 0, -1, 0, 0.9, 0};
    const int64_t line[2] = {0, 1}, floor[2] = {3, 2};
    const signorini_faces slave = {.struct_size = sizeof slave, .face_nodes = 2, .count = 1, .nodes = line};
    signorini_faces master = slave;
    master.nodes = floor;
    for (uint32_t size = 16; size <= sizeof(signorini_surface_settings); size += 8) {
        signorini_surface_settings *settings = at_the_end(size);
        CHECK_STATUS(signorini_surface_settings_default(settings, size), 0);
        only_read(settings);
        for (uint32_t told = 16; told <= sizeof(signorini_surface_data); told += 8) {
            signorini_surface_data *data = at_the_end(told);
            signorini_surface_pairs *contact = NULL;
            data->struct_size = told;
            CHECK_STATUS(signorini_surface_pair(2, 4, x, &slave, &master, settings, &contact), 0);
            CHECK_STATUS(signorini_surface_view(contact, data), 0);
            CHECK(data->struct_size == told && data->pairs == 2);
            signorini_surface_free(contact);
            drop(data);
        }
        drop(settings);
    }
}

int main(void)
{
    page = page_size();
    settings_of_each_size();
    reports_of_each_size();
    extras_of_each_size();
    structures_before_arrays();
    sizes_that_are_refused();
    later_structures();
    structures_of_a_sparse_model();
    structures_of_a_surface();
    surfaces_of_each_size();
    return check_summary("older_structures");
}
