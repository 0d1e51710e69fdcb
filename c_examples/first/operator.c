/*
 * Two contact nodes of which the library gets no matrix: it asks for products with K and for those
 * of a rough inverse. The host of a real case multiplies by a matrix that lies on many processes,
 * and W is a solution with its own factor, the contact free.
 */
#define SIGNORINI_UNSTABLE /* for operators, which may still change */
#include <signorini.h>
#include <stdio.h>

enum { N = 4 };

struct host { double K[N][N]; int products; };

static int32_t stiffness(void *user, const double *x, double *y)
{
    struct host *host = user;
    host->products++;
    for (int i = 0; i < N; i++) {
        y[i] = 0;
        for (int j = 0; j < N; j++) y[i] += host->K[i][j] * x[j];
    }
    return 0; /* Another number ends the call of the library. */
}

static int32_t inverse(void *user, const double *x, double *y)
{
    const struct host *host = user;
    for (int i = 0; i < N; i++) y[i] = x[i] / host->K[i][i];
    return 0;
}

int main(void)
{
    struct host host = {{{4, 1, -1, 0}, {1, 4, 0, -1}, {-1, 0, 4, 1}, {0, -1, 1, 4}}, 0};
    const signorini_operator K = {.struct_size = sizeof K, .dim = 2, .pairs = 2,
        .stiffness = stiffness, .inverse = inverse, .user = &host};
    const double f[N] = {2, 1.5, 3, 0.5}, gap[2] = {0, 0}, mu[2] = {0.3, 0.3};
    double d[N], F[N];
    signorini_model *model = NULL;

    int32_t status = signorini_model_new_operator(&K, &model);
    if (status == 0)
        status = signorini_model_solve(model, 1, f, NULL, gap, SIGNORINI_LAW_COULOMB, mu, NULL,
                                       NULL, d, F, NULL, NULL, NULL, NULL);
    if (status == 0)
        printf("F %.4f %.4f %.4f %.4f, %d products\n", F[0], F[1], F[2], F[3], host.products);
    else
        fprintf(stderr, "status %d: %s\n", (int)status, signorini_last_error());
    signorini_model_free(model);
    return status != 0;
}
