// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What a closure is asked, on a CPU or a GPU alike, and its answers as a row of numbers.

#pragma once

#include <regain/closures/closure.h>
#include <regain/closures/dielectric_tables.h>
#include <regain/closures/host_queries.h>
#include <regain/closures/shading_frame.h>
#include <regain/closures/table.h>

namespace regain::tests {

/// What closures are made of, in memory of the machine that makes them.
struct Surface
{
    float alpha_x = 0.3f, alpha_y = 0.3f, gamma = 1.7f, eta = 1.5f, strength = 1;
    Color3<float> color{0.9f, 0.6f, 0.3f};
    MicrofacetTables mirror;
    DielectricTables glass[2];  ///< by form of transmission shadowing
};

/// wo and wi are in world space, where the surface lies askew.
struct Question
{
    Vec3<float> wo, wi, u;
};

REGAIN_HOST_DEVICE inline ShadingFrame<float> askew()
{
    const Vec3<float> N(0.48f, 0.6f, 0.64f);
    return ShadingFrame<float>::of(N, N, {1, 0, 0});
}

struct Answer
{
    /// Where what stands.
    enum {
        value,
        pdf = 3,
        direction,
        weight = 7,
        sample_pdf = 10,
        valid,
        after_sample = 14,
        size = 21
    };

    float numbers[size];
};

/// The names of the numbers.
inline const char* name_of_number(int k)
{
    constexpr const char* names[Answer::size] = {
        "eval, red",       "eval, green",      "eval, blue",         "pdf",
        "sample, x",       "sample, y",        "sample, z",          "weight, red",
        "weight, green",   "weight, blue",     "the sample's pdf",   "valid",
        "delta",           "transmitted",      "reflected, red",     "reflected, green",
        "reflected, blue", "let through, red", "let through, green", "let through, blue",
        "radiance factor"};
    return names[k];
}

template <class Closure>
REGAIN_HOST_DEVICE Answer answer_of(const Closure& closure, const Question& q)
{
    const ShadingFrame<float> frame = askew();
    const Vec3<float> wo = frame.known(q.wo), wi = frame.known(q.wi);
    const auto prepared = closure.prepare(wo);
    const Color3<float> f = evaluate(prepared, wi, q.u);
    const Sample<float> s = prepared.sample(q.u);
    const Vec3<float> sampled = frame.to_world(s.wi);
    const Albedo<float> a = prepared.albedo();
    return {{f.x,
             f.y,
             f.z,
             prepared.pdf(wi),
             sampled.x,
             sampled.y,
             sampled.z,
             s.weight.x,
             s.weight.y,
             s.weight.z,
             s.pdf,
             float(s.valid),
             float(s.delta),
             float(s.transmitted),
             a.reflect.x,
             a.reflect.y,
             a.reflect.z,
             a.transmit.x,
             a.transmit.y,
             a.transmit.z,
             radiance_factor(closure, wo, wi)}};
}

}  // namespace regain::tests
