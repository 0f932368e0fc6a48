/* SPDX-License-Identifier: Apache-2.0 */
/* Copyright Contributors to the Regain project */

/**
 * @file
 * A closure from elsewhere, for the conformance kit, in plain C (C99): a shared object that exports
 *
 *     const regain_subject_v1* regain_conformance_subject(int index);
 *
 * is all that `regain conform OBJECT.so` needs. It links nothing of Regain. See
 * docs/conformance-kit.md for an example.
 *
 * All numbers are double. A closure that computes in float says so in `reads` and rounds what it is
 * given and computes by itself.
 *
 * Directions are unit, in the local shading frame (z = shading normal), and point away from the
 * surface. Values are energy: transmission carries no squared ratio of indices. Colours are linear
 * red, green, blue.
 *
 * The kit calls from several threads at once, but asks each closure that it created from one thread
 * at a time. It also passes what no renderer should: numbers that are not finite, directions below
 * the horizon or of no unit length, random numbers beyond [0, 1). Such input may get black, a pdf
 * of 0 and no sample; it may not get anything that is infinite, negative or NaN, nor a crash.
 */

#ifndef REGAIN_CONFORMANCE_C_CLOSURE_H
#define REGAIN_CONFORMANCE_C_CLOSURE_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** What is described here. A struct with another last digit is another struct; these stay. */
#define REGAIN_CONFORMANCE_C_VERSION 1

/** What reflects at a facet: F = 1 in every channel, Schlick's with F0 and F82, or n and k. */
enum { REGAIN_WHITE = 0, REGAIN_SCHLICK = 1, REGAIN_CONDUCTOR = 2 };

/** How compensation acts on the lobe that it compensates. */
enum {
    REGAIN_FORM_NONE = 0,
    REGAIN_FORM_GAIN = 1,
    REGAIN_FORM_ADDED = 2,
    REGAIN_FORM_REPLACED = 3,
    REGAIN_FORM_PAIR_GAIN = 4 /* a gain of both directions */
};

/** What a closure is made of. Any of it may be hostile. */
typedef struct regain_parameters_v1
{
    double alpha_x, alpha_y; /**< microfacet widths in [0, 1]; a roughness squared */
    double gamma;            /**< tail parameter, in the range that is read */
    double eta;              /**< index on the -z side over the index on the +z side */
    double F0[3], F82[3];    /**< REGAIN_SCHLICK: colour at normal incidence; tint at cosine 1/7 */
    double n[3], k[3];       /**< REGAIN_CONDUCTOR: complex index per channel */
    int32_t reflectance;     /**< REGAIN_WHITE, REGAIN_SCHLICK or REGAIN_CONDUCTOR */
    int32_t in_double;       /**< compute in double, or else in float */
} regain_parameters_v1;

/** Which of these it reads; 0 is no, anything else yes. */
typedef struct regain_reads_v1
{
    double lowest_gamma, highest_gamma;
    int32_t alpha;      /**< alpha_x and alpha_y */
    int32_t two_alphas; /**< they may differ */
    int32_t gamma;
    int32_t eta;
    int32_t one_medium; /**< on both sides, as of a sheet: eta is of what lies between */
    int32_t schlick, conductor;
    int32_t in_float, in_double; /**< precisions it computes in; at least one */
} regain_reads_v1;

/** What it promises to be; 0 is no, anything else yes. */
typedef struct regain_traits_v1
{
    int32_t reciprocal;        /**< f(wo, wi) = f(wi, wo); eta squared across an interface */
    int32_t energy_preserving; /**< with F = 1 the albedo is 1 */
    int32_t exact_pdf;         /**< pdf is the density of sample */
    int32_t stochastic_eval;   /**< eval draws random numbers and is right on average */
    int32_t delta;             /**< sample may return directions without density */
    int32_t transmissive;      /**< some light leaves on the other side than wo's */
    int32_t anisotropic;       /**< turning wo and wi about the normal changes the value */
    int32_t random_numbers;    /**< that sample reads: 1 to 3 */
} regain_traits_v1;

/** What it promises in numbers, of one closure along one direction; NaN where nothing is. */
typedef struct regain_promises_v1
{
    double surplus; /**< the albedo is at most 1 + this: for anything that emits no light */
    double furnace; /**< if energy_preserving, a white closure's albedo is within this of 1 */
    double albedo;  /**< albedo() is within this of what the closure reflects and transmits */
    double tint;    /**< the albedo is within this of the reference subject's */
    double weight;  /**< no sample weighs more */
    /** In float, eval is within this of double, relative, but for one in a thousand; half of all
     * are within a 200th of it. Where it is not positive, 1e-3. */
    double single;
    /** albedo() is a mean of samples, and chance moves it by this. Where it is not positive, by
     *  nothing. */
    double albedo_noise;
    /** The integral of the pdf, and the chances of nothing and of delta lobes, are 1 within this.
     *  Where it is not positive, 5e-4. */
    double pdf;
} regain_promises_v1;

/** One sampled direction, or nothing. The kit passes it filled with zeros. */
typedef struct regain_sample_v1
{
    double wi[3];        /**< unit; (0, 0, 1) where nothing was sampled */
    double weight[3];    /**< f |cos theta_i| / pdf; of a delta lobe its share of energy */
    double pdf;          /**< per steradian; of a delta lobe the probability of choosing it */
    int32_t valid;       /**< 0: nothing was sampled, weight and pdf are 0 */
    int32_t delta;       /**< the direction has no density: eval and pdf of it are 0 */
    int32_t transmitted; /**< wi is on the other side than wo */
    int32_t reserved;    /**< 0 */
} regain_sample_v1;

/** Directional albedo: the energy that leaves for a unit that arrives along wo. */
typedef struct regain_albedo_v1
{
    double reflect[3], transmit[3];
} regain_albedo_v1;

/** A closure with its parameters still open, and what is promised of it. Static, or alive as long
 *  as the shared object is open. No function pointer is null unless it says that it may be. */
typedef struct regain_subject_v1
{
    uint32_t version; /**< REGAIN_CONFORMANCE_C_VERSION of the header that it was compiled with */
    uint32_t size;    /**< sizeof(regain_subject_v1) */
    const char* name; /**< unique; letters, digits, '-', '_' and '.' */
    regain_reads_v1 reads;
    regain_promises_v1 promises;

    /** Where promises depend on parameters or direction: writes those that do. `out` comes with
     *  `promises` in it. May be null. */
    void (*promises_at)(const regain_parameters_v1*, const double wo[3], regain_promises_v1* out);

    /** A closure, or null, which is a failure of it: what cannot be made is to be sanitised. */
    void* (*create)(const regain_parameters_v1*);
    /** Called once for each closure that is not null. */
    void (*destroy)(void* closure);
    void (*traits)(const void* closure, regain_traits_v1* out);

    /** f(wo, wi) |cos theta_i| per channel into f. u in [0, 1)^3 is read where it is an estimate.
     */
    void (*eval)(const void* closure, const double wo[3], const double wi[3], const double u[3],
                 double f[3]);
    /** Per steradian; integrates, over all that sample can return, to 1 - P(nothing) - P(delta). */
    double (*pdf)(const void* closure, const double wo[3], const double wi[3]);
    /** u in [0, 1)^3, of which the first `random_numbers` are read. */
    void (*sample)(const void* closure, const double wo[3], const double u[3],
                   regain_sample_v1* out);
    void (*albedo)(const void* closure, const double wo[3], regain_albedo_v1* out);

    /** Names of other subjects of this shared object, or null: the lobe that this one compensates,
     *  and what its tinted albedos are compared with. */
    const char *bare, *reference;
    int32_t form;     /**< REGAIN_FORM_NONE ... REGAIN_FORM_REPLACED: how it compensates `bare` */
    int32_t reserved; /**< 0 */
} regain_subject_v1;

/** Seen from outside where symbols are hidden. */
#if defined(__GNUC__)
#define REGAIN_CONFORMANCE_EXPORT __attribute__((visibility("default")))
#else
#define REGAIN_CONFORMANCE_EXPORT
#endif

/** What the shared object exports: its subjects by index from 0, null past the last. */
REGAIN_CONFORMANCE_EXPORT const regain_subject_v1* regain_conformance_subject(int index);
typedef const regain_subject_v1* (*regain_conformance_subject_function)(int index);
#define REGAIN_CONFORMANCE_SUBJECT "regain_conformance_subject"

#ifdef __cplusplus
}
#endif

#endif
