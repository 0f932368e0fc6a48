// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// An AnyClosure of each type of closure that has one distribution: for the files that compile one
/// distribution each.

#pragma once

#include "any_closure.h"
#include "errors.h"

#include <regain/closures/compensated.h>
#include <regain/closures/host_queries.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace regain::tools {

/// Whether a closure is another one with a gain that depends on wi.
template <class Closure>
struct HasPairGain : std::false_type
{};
template <class Lobe, class Gain>
struct HasPairGain<Compensated<Lobe, Gain>>
    : std::bool_constant<Compensated<Lobe, Gain>::depends_on_wi>
{};

template <class Closure>
class ClosureModel final : public AnyClosure
{
public:
    using Real = typename Closure::Real;

    /// radiance: transmitted values hold the squared ratio of indices.
    ClosureModel(const Closure& closure, bool radiance) : _closure(closure), _radiance(radiance) {}

    Traits traits() const override { return _closure.traits(); }

    void prepare(const Imath::V3d& wo) override
    {
        _wo = rounded(wo);
        _prepared.emplace(_closure.prepare(_wo));
    }

    ColorD eval(const Imath::V3d& wi, const Imath::V3d& u) const override
    {
        const Vec3<Real> direction = rounded(wi);
        return ColorD(evaluate(*_prepared, direction, rounded_numbers(u)) * factor(direction));
    }
    double pdf(const Imath::V3d& wi) const override { return double(_prepared->pdf(rounded(wi))); }
    Sample<double> sample(const Imath::V3d& u) const override
    {
        const Sample<Real> s = _prepared->sample(rounded_numbers(u));
        Sample<double> wide;
        wide.wi = Imath::V3d(s.wi);
        wide.weight = ColorD(s.valid ? s.weight * factor(s.wi) : s.weight);
        wide.pdf = double(s.pdf);
        wide.valid = s.valid;
        wide.delta = s.delta;
        wide.transmitted = s.transmitted;
        return wide;
    }
    Albedo<double> albedo() const override { return wide(_prepared->albedo()); }
    GainAnswer gain(const std::optional<Imath::V3d>& wi) const override
    {
        if constexpr (HasPairGain<Closure>::value)
            if (wi && !is_dark())
                return {ColorD(_closure.gain().at(_wo) * _closure.gain().pair(_wo, rounded(*wi))),
                        pair_form};
        return gain_of(_closure);
    }

    int bounces([[maybe_unused]] const Imath::V3d& u) const override
    {
        if constexpr (walks)
            return static_cast<int>(_prepared->path(rounded_numbers(u)).bounces);
        else
            return 1;
    }

private:
    static constexpr const char* pair_form = "gain(wo, wi)";
    static constexpr bool walks =
        regain::detail::TakesNumbersInEval<typename Closure::Prepared, Real>::value;

    static Vec3<Real> rounded(const Imath::V3d& w)
    {
        return {static_cast<Real>(w.x), static_cast<Real>(w.y), static_cast<Real>(w.z)};
    }
    // Below 1 also after rounding; quiet where a number is none.
    static Vec3<Real> rounded_numbers(const Imath::V3d& u)
    {
        Vec3<Real> r = rounded(u);
        for (int k = 0; k < 3; ++k)
            if (std::isless(u[k], 1.0) && !std::isless(r[k], Real(1)))
                r[k] = std::nextafter(Real(1), Real(0));
        return r;
    }
    static Albedo<double> wide(const Albedo<Real>& a)
    {
        return {ColorD(a.reflect), ColorD(a.transmit)};
    }

    Real factor(const Vec3<Real>& wi) const
    {
        return _radiance ? radiance_factor(_closure, _wo, wi) : Real(1);
    }

    // Below the horizon of a lobe that only reflects a gain has nothing to act on.
    bool is_dark() const
    {
        return !regain::detail::is_direction(_wo) || _wo.z == 0 ||
               (_wo.z < 0 && !is_interface(_closure));
    }

    template <class Lobe, class Gain>
    GainAnswer gain_of(const Compensated<Lobe, Gain>& closure) const
    {
        if constexpr (HasPairGain<Closure>::value)
        {
            GainAnswer mean = added(closure.lobe());
            mean.form = pair_form;
            return mean;
        }
        GainAnswer answer;
        answer.form = "gain(wo)";
        if (!is_dark()) answer.gain = ColorD(closure.gain().at(_wo));
        return answer;
    }
    template <class Lobe>
    GainAnswer gain_of(const KullaConty<Lobe>& closure) const
    {
        return added(closure.lobe());
    }
    template <class Lobe>
    GainAnswer gain_of(const FittedTail<Lobe>& closure) const
    {
        return added(closure.lobe());
    }
    template <class Lobe>
    GainAnswer gain_of(const DielectricKullaConty<Lobe>& closure) const
    {
        return added(closure.lobe());
    }
    template <class Lobe>
    GainAnswer gain_of(const DielectricTail<Lobe>& closure) const
    {
        return added(closure.lobe());
    }
    template <class First, class Second>
    GainAnswer gain_of(const Sum<First, Second>& closure) const
    {
        return added(closure.first());
    }
    template <class Other>
    GainAnswer gain_of(const Other&) const
    {
        if constexpr (walks)
            throw BadInput("the method walk replaces the lobe and has no gain: ask for the albedo");
        else
            return {};
    }

    // What is reflected with the added lobe over what is without.
    template <class Lobe>
    GainAnswer added(const Lobe& lobe) const
    {
        GainAnswer answer;
        answer.form = "added lobe";
        if (is_dark()) return answer;
        const Albedo<double> with = albedo(), without = wide(lobe.prepare(_wo).albedo());
        for (int c = 0; c < 3; ++c)
        {
            const double one = without.reflect[c] + without.transmit[c];
            if (one > 0) answer.gain[c] = (with.reflect[c] + with.transmit[c]) / one;
        }
        return answer;
    }

    Closure _closure;
    bool _radiance;
    Vec3<Real> _wo{Real(0)};
    std::optional<typename Closure::Prepared> _prepared;
};

/// The closure of a material of this distribution, whose tables are bound.
template <template <class> class Distribution>
std::unique_ptr<AnyClosure> make_closure_of(const shaders::MicrofacetMaterial& material,
                                            const ClosureSpec& spec)
{
    const auto make = [&](auto strength) {
        return material.with_closure_of<Distribution>(
            strength, [&](const auto& closure) -> std::unique_ptr<AnyClosure> {
                return std::make_unique<ClosureModel<std::decay_t<decltype(closure)>>>(
                    closure, spec.transport == Transport::radiance);
            });
    };
    if (spec.precision == Precision::twice) return make(spec.strength);
    return make(static_cast<float>(spec.strength));
}

}  // namespace regain::tools
