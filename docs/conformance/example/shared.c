/* SPDX-License-Identifier: Apache-2.0 */
/* Copyright Contributors to the Regain project */

/* The adapter, as a shared object: plain C, and of Regain one header. */

#include "phong.h"

#include <regain/conformance/c_closure.h>

#include <stdlib.h>

static void* create(const regain_parameters_v1* parameters)
{
    phong* p = malloc(sizeof *p);
    if (p) *p = phong_make(parameters->alpha_x);
    return p;
}

static void traits(const void* closure, regain_traits_v1* out)
{
    (void)closure;
    out->reciprocal = 1;
    out->exact_pdf = 1;
    out->random_numbers = 3;
}

static void promises_at(const regain_parameters_v1* parameters, const double wo[3],
                        regain_promises_v1* out)
{
    const phong p = phong_make(parameters->alpha_x);
    (void)wo;
    out->weight = phong_largest_weight(&p);
}

static void eval(const void* closure, const double wo[3], const double wi[3], const double u[3],
                 double f[3])
{
    (void)u;
    phong_eval(closure, wo, wi, f);
}

static double pdf(const void* closure, const double wo[3], const double wi[3])
{
    return phong_pdf(closure, wo, wi);
}

static void sample(const void* closure, const double wo[3], const double u[3],
                   regain_sample_v1* out)
{
    out->valid = phong_sample(closure, wo, u, out->wi);
    if (!out->valid)
    {
        out->wi[0] = out->wi[1] = 0;
        out->wi[2] = 1;
        return;
    }
    out->pdf = phong_pdf(closure, wo, out->wi);
    phong_eval(closure, wo, out->wi, out->weight);
    for (int k = 0; k < 3; ++k) out->weight[k] /= out->pdf;
}

/* No closed form: 0, and nothing is promised of it. */
static void albedo(const void* closure, const double wo[3], regain_albedo_v1* out)
{
    (void)closure;
    (void)wo;
    for (int k = 0; k < 3; ++k) out->reflect[k] = out->transmit[k] = 0;
}

const regain_subject_v1* regain_conformance_subject(int index)
{
    static const regain_subject_v1 subject = {
        .version = REGAIN_CONFORMANCE_C_VERSION,
        .size = sizeof(regain_subject_v1),
        .name = "phong",
        .reads = {.alpha = 1, .in_double = 1},
        .promises = {.surplus = 0, .furnace = NAN, .albedo = NAN, .tint = NAN, .weight = NAN},
        .promises_at = promises_at,
        .create = create,
        .destroy = free,
        .traits = traits,
        .eval = eval,
        .pdf = pdf,
        .sample = sample,
        .albedo = albedo,
    };
    return index == 0 ? &subject : NULL;
}
