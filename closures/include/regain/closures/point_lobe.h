// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A closure at one shading point, for hosts that ask about one direction at a time and want the
/// value over the pdf: the part of their adapters that is the same.
///
/// Directions are in the closure's frame. Of the closure's samples a lobe passes on those that have
/// a density, or those that have none: one closure whose samples are of both kinds is two lobes.
///
/// A closure whose eval is an estimate gets random numbers that are a hash of the two directions.

#pragma once

#include <regain/closures/host_queries.h>
#include <regain/closures/random_stream.h>
#include <regain/closures/shading_frame.h>

REGAIN_NAMESPACE_BEGIN

/// weight = f |wi.z| / pdf, transmitted radiance by the squared ratio of indices included; of a
/// lobe without densities pdf is the probability of wi. Where pdf is 0 there is no such direction,
/// and the weight is 0.
template <class Real>
struct PointSample
{
    Vec3<Real> wi{Real(0)};
    Color3<Real> weight{Real(0)};
    Real pdf = Real(0);
};

template <class ClosureType>
class PointLobe
{
public:
    using Closure = ClosureType;
    using Real = typename Closure::Real;

    /// view: the known direction that the lobe is mostly asked about; ng: the geometric normal, on
    /// the side of +z. `without_density`: which of the closure's samples are passed on.
    REGAIN_HOST_DEVICE PointLobe(const Closure& closure, const Vec3<Real>& view,
                                 const Vec3<Real>& ng, bool without_density)
        : _closure(closure),
          _prepared(closure.prepare(known_direction(view, ng.dot(view)))),
          _view(view),
          _ng(ng),
          _without_density(without_density)
    {}

    REGAIN_HOST_DEVICE const Closure& closure() const { return _closure; }
    REGAIN_HOST_DEVICE bool without_density() const { return _without_density; }

    /// Microfacet width of the wider axis; 0 of a lobe without densities.
    REGAIN_HOST_DEVICE Real roughness() const
    {
        return _without_density ? Real(0) : widest_alpha(_closure);
    }

    REGAIN_HOST_DEVICE PointSample<Real> sample(const Vec3<Real>& wo, const Vec3<Real>& u) const
    {
        const Sample<Real> s = with_known(wo, [&](const auto& p) { return p.sample(u); });
        PointSample<Real> answer;
        answer.wi = s.wi;
        if (!s.valid || s.delta != _without_density || !is_on_its_side(s.wi)) return answer;
        answer.weight = s.weight * radiance_factor(_closure, wo, s.wi);
        answer.pdf = s.pdf;
        return answer;
    }

    /// Of a lobe without densities the answer is none.
    REGAIN_HOST_DEVICE PointSample<Real> evaluate(const Vec3<Real>& wo, const Vec3<Real>& wi) const
    {
        PointSample<Real> answer;
        answer.wi = wi;
        if (_without_density || !is_on_its_side(wi)) return answer;
        with_known(wo, [&](const auto& p) {
            Real density = p.pdf(wi);
            if (!(density > 0) && !stochastic) return;
            const Color3<Real> f = value(p, wo, wi);
            if (!(density > 0) && f != Color3<Real>(Real(0))) density = Real(least_pdf);
            if (!(density > 0)) return;
            answer.weight = f * (radiance_factor(_closure, wo, wi) / density);
            answer.pdf = density;
        });
        return answer;
    }

    /// Density of wo where wi is known.
    REGAIN_HOST_DEVICE Real reverse_pdf(const Vec3<Real>& wo, const Vec3<Real>& wi) const
    {
        return _closure.pdf(wi, wo);
    }

    /// Reflected and transmitted energy together.
    REGAIN_HOST_DEVICE Color3<Real> albedo(const Vec3<Real>& wo) const
    {
        return with_known(wo, [](const auto& p) {
            const auto a = p.albedo();
            return a.reflect + a.transmit;
        });
    }

    /// About that, for picking among lobes; quicker where albedo takes long.
    REGAIN_HOST_DEVICE Color3<Real> expected_albedo(const Vec3<Real>& wo) const
    {
        return with_known(wo, [](const auto& p) {
            const auto a = regain::expected_albedo(p);
            return a.reflect + a.transmit;
        });
    }

private:
    static constexpr bool stochastic =
        detail::TakesNumbersInEval<typename Closure::Prepared, Real>::value;

    REGAIN_HOST_DEVICE bool is_on_its_side(const Vec3<Real>& wi) const
    {
        return sides_agree(wi.z, _ng.dot(wi));
    }

    template <class Prepared>
    REGAIN_HOST_DEVICE static Color3<Real> value(const Prepared& prepared,
                                                 [[maybe_unused]] const Vec3<Real>& wo,
                                                 const Vec3<Real>& wi)
    {
        if constexpr (stochastic)
        {
            const auto u = RandomStream<Real>(wo).next3();
            return prepared.eval(wi, RandomStream<Real>(u + wi).next3());
        }
        else
            return prepared.eval(wi);
    }

    template <class Ask>
    REGAIN_HOST_DEVICE auto with_known(const Vec3<Real>& wo, const Ask& ask) const
    {
        return wo == _view ? ask(_prepared)
                           : ask(_closure.prepare(known_direction(wo, _ng.dot(wo))));
    }

    Closure _closure;
    typename Closure::Prepared _prepared;
    Vec3<Real> _view, _ng;
    bool _without_density;
};

REGAIN_NAMESPACE_END
