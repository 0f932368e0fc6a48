/* SPDX-License-Identifier: Apache-2.0 */
/* Copyright Contributors to the Regain project */

/* A closure from elsewhere, as it may stand in any renderer: the modified Phong model (Lafortune
 * and Willems 1994), a diffuse lobe and a glossy one about the mirror direction r of wo, f = kd /
 * pi + ks (n + 2) / (2 pi) cos(r, wi)^n,   n = 2 / alpha^2 - 2 It knows nothing of Regain. C99;
 * vectors are double[3] in the local shading frame. */

#ifndef PHONG_H
#define PHONG_H

#include <math.h>
#include <stdbool.h>

static const double phong_pi = 3.14159265358979324;
static const double phong_kd[3] = {0.5, 0.3, 0.2}, phong_ks[3] = {0.3, 0.4, 0.5};
static const double phong_diffuse_share = 0.5; /* of the samples */

/* A factor other than 1 is a mistake in the pdf, for the test of the test. */
#ifndef PHONG_PDF_FACTOR
#define PHONG_PDF_FACTOR 1
#endif

typedef struct phong
{
    double n;
} phong;

/* x within [lo, hi]; NaN is lo. isless raises no floating-point exception, unlike <. */
static double phong_within(double x, double lo, double hi)
{
    return isless(lo, x) ? (isless(x, hi) ? x : hi) : lo;
}

static phong phong_make(double alpha)
{
    const double a = phong_within(alpha, 1e-3, 1);
    const phong p = {2 / (a * a) - 2};
    return p;
}

/* Of unit length, and above the horizon. */
static bool phong_usable(const double w[3])
{
    if (!isless(0, w[2]) || !isless(fabs(w[0]), 1.1) || !isless(fabs(w[1]), 1.1) ||
        !isless(w[2], 1.1))
        return false;
    return fabs(w[0] * w[0] + w[1] * w[1] + w[2] * w[2] - 1) < 1e-5;
}

/* cos(r, wi)^n. */
static double phong_lobe(const phong* p, const double wo[3], const double wi[3])
{
    const double c = wo[2] * wi[2] - wo[0] * wi[0] - wo[1] * wi[1];
    return c > 0 ? pow(fmin(c, 1), p->n) : 0;
}

/* f |cos theta_i|. */
static void phong_eval(const phong* p, const double wo[3], const double wi[3], double f[3])
{
    const bool usable = phong_usable(wo) && phong_usable(wi);
    const double lobe = usable ? (p->n + 2) / (2 * phong_pi) * phong_lobe(p, wo, wi) : 0;
    for (int k = 0; k < 3; ++k)
        f[k] = usable ? (phong_kd[k] / phong_pi + phong_ks[k] * lobe) * wi[2] : 0;
}

static double phong_pdf(const phong* p, const double wo[3], const double wi[3])
{
    if (!phong_usable(wo) || !phong_usable(wi)) return 0;
    const double diffuse = wi[2] / phong_pi;
    const double lobe = (p->n + 1) / (2 * phong_pi) * phong_lobe(p, wo, wi);
    return PHONG_PDF_FACTOR * (phong_diffuse_share * diffuse + (1 - phong_diffuse_share) * lobe);
}

/* Writes wi; false where nothing is sampled: below the horizon. u[2] chooses the lobe. */
static bool phong_sample(const phong* p, const double wo[3], const double u[3], double wi[3])
{
    if (!phong_usable(wo)) return false;
    const double x = phong_within(u[0], 0, 1), phi = 2 * phong_pi * phong_within(u[1], 0, 1);
    const bool diffuse = phong_within(u[2], 0, 1) < phong_diffuse_share;
    /* By the cosine, about the normal or the mirror direction. */
    const double c = diffuse ? sqrt(x) : pow(x, 1 / (p->n + 1)), s = sqrt((1 - c) * (1 + c));
    const double a = s * cos(phi), b = s * sin(phi);
    if (diffuse)
    {
        wi[0] = a;
        wi[1] = b;
        wi[2] = c;
    }
    else
    {
        /* A frame about r (Duff et al. 2017); r.z = wo.z is positive. */
        const double r[3] = {-wo[0], -wo[1], wo[2]};
        const double t = -1 / (1 + r[2]), d = r[0] * r[1] * t;
        wi[0] = a * (1 + r[0] * r[0] * t) + b * d + c * r[0];
        wi[1] = a * d + b * (1 + r[1] * r[1] * t) + c * r[1];
        wi[2] = -a * r[0] - b * r[1] + c * r[2];
    }
    /* wo may be a little off unit length; what is returned is not. */
    const double length = sqrt(wi[0] * wi[0] + wi[1] * wi[1] + wi[2] * wi[2]);
    for (int k = 0; k < 3; ++k) wi[k] /= length;
    return phong_usable(wi) && phong_pdf(p, wo, wi) > 0;
}

/* No sample weighs more: the largest ratio of either lobe to its part of the pdf. */
static double phong_largest_weight(const phong* p)
{
    const double glossy = (p->n + 2) / (p->n + 1) / (1 - phong_diffuse_share);
    return fmax(phong_kd[0] / phong_diffuse_share, phong_ks[2] * glossy) / PHONG_PDF_FACTOR;
}

#endif
