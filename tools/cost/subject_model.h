// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A Subject of each type of closure that has one distribution: for the files that compile one
/// distribution each.

#pragma once

#include "subject.h"

#include <regain/closures/diffuse.h>
#include <regain/closures/layer.h>

#include <type_traits>
#include <utility>

namespace regain::tools::cost {

template <class Closure>
class SubjectModel final : public Subject
{
public:
    explicit SubjectModel(const Closure& closure) : _closure(closure) {}

    void sample(const Vec3<float>& wo, const std::vector<Vec3<float>>& u,
                std::vector<Sample<float>>& found) const override
    {
        const auto prepared = _closure.prepare(wo);
        for (std::size_t i = 0; i < u.size(); ++i) found[i] = prepared.sample(u[i]);
    }
    void evaluate([[maybe_unused]] const Vec3<float>& wo,
                  [[maybe_unused]] const std::vector<Vec3<float>>& wi,
                  [[maybe_unused]] std::vector<Color3<float>>& value) const override
    {
        if constexpr (!stochastic)
        {
            const auto prepared = _closure.prepare(wo);
            for (std::size_t i = 0; i < wi.size(); ++i) value[i] = prepared.eval(wi[i]);
        }
    }
    bool is_stochastic() const override { return stochastic; }

    figures::Clocked clock(const figures::Inputs& inputs) const override
    {
        return figures::clock_of(_closure, inputs);
    }

private:
    static constexpr bool stochastic =
        regain::detail::TakesNumbersInEval<typename Closure::Prepared, float>::value;

    Closure _closure;
};

/// Whether a closure may be a dielectric that only reflects.
template <class Closure>
struct MayCoat : std::false_type
{};
template <class Distribution, class Gain>
struct MayCoat<Compensated<Dielectric<Distribution>, Gain>> : std::true_type
{};
template <class Lobe>
struct MayCoat<DielectricKullaConty<Lobe>> : std::true_type
{};
template <class Lobe>
struct MayCoat<DielectricTail<Lobe>> : std::true_type
{};

template <class Closure>
std::unique_ptr<Subject> subject_of(const Closure& closure)
{
    return std::make_unique<SubjectModel<Closure>>(closure);
}

/// The surface's tables are bound.
template <template <class> class Distribution>
std::unique_ptr<Subject> surface_of(const Surface& surface)
{
    return surface.material.with_closure_of<Distribution>(
        1.0f, [&](const auto& closure) -> std::unique_ptr<Subject> {
            using Closure = std::decay_t<decltype(closure)>;
            if constexpr (MayCoat<Closure>::value)
                if (surface.base)
                    return subject_of(layer(
                        closure, Diffuse<float>(Color3<float>(static_cast<float>(*surface.base)))));
            return subject_of(closure);
        });
}

/// The walk over facets that reflect as the interface does.
template <template <class> class Distribution>
std::unique_ptr<Subject> coat_of(const shaders::MicrofacetMaterial& m)
{
    const float alpha = static_cast<float>(m.alpha_x);
    const DielectricFresnel<float> fresnel(
        static_cast<float>(std::get<shaders::InterfaceSurface>(m.surface).eta));
    if constexpr (Distribution<float>::has_tail)
        return subject_of(Walk(Distribution<float>(alpha, static_cast<float>(m.gamma)), fresnel));
    else
        return subject_of(Walk(Distribution<float>(alpha), fresnel));
}

/// Both for one distribution: each compiles for a minute, in a file of its own.
struct SubjectMaker
{
    std::unique_ptr<Subject> (*surface)(const Surface&);
    std::unique_ptr<Subject> (*coat)(const shaders::MicrofacetMaterial&);
};

template <template <class> class Distribution>
constexpr SubjectMaker maker_of{&surface_of<Distribution>, &coat_of<Distribution>};

extern const SubjectMaker ggx_subjects, beckmann_subjects, gtr_subjects, std_subjects;

}  // namespace regain::tools::cost
