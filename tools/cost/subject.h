// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What is measured: a closure as a renderer builds it, in float, one point at a time. Questions
/// are asked many at once, so that what stands between costs nothing beside the answers.

#pragma once

#include "../figures/clock.h"

#include <regain/shaders/microfacet_material.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace regain::tools::cost {

class Subject
{
public:
    virtual ~Subject() = default;

    /// found[i] = sample(u[i]) as seen along wo; both are as long.
    virtual void sample(const Vec3<float>& wo, const std::vector<Vec3<float>>& u,
                        std::vector<Sample<float>>& found) const = 0;

    /// value[i] = eval(wi[i]) as seen along wo, cosine included; both are as long. Not of a closure
    /// whose eval is an estimate: its samples say more for the time.
    virtual void evaluate(const Vec3<float>& wo, const std::vector<Vec3<float>>& wi,
                          std::vector<Color3<float>>& value) const = 0;
    virtual bool is_stochastic() const = 0;

    /// The inputs outlive the clock.
    virtual figures::Clocked clock(const figures::Inputs&) const = 0;
};

/// A surface: a lobe with microfacets, alone or as the coat of a diffuse base.
struct Surface
{
    shaders::MicrofacetMaterial material;
    std::optional<double> base;  ///< what the base reflects; of dielectrics of scatter mode R
};

struct Bound
{
    std::unique_ptr<Subject> subject;
    std::size_t table_bytes = 0;  ///< of the tables that eval and sample by this method read
};

/// Throws BadInput, which says why, where the library has no such combination.
Bound make_subject(Surface);

/// The random walk, which is exact for the model, in place of the surface's method. Of a surface
/// with a base it is the coat's alone, whose facets reflect and let the rest go to the base.
std::unique_ptr<Subject> make_reference(Surface);

}  // namespace regain::tools::cost
