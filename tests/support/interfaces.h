// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// An interface between two media whose every answer is known in closed form, for tests of what
/// hosts make of interfaces.

#pragma once

#include <regain/closures/closure.h>
#include <regain/closures/number.h>

#include <cmath>

namespace regain::tests {

/// What has no density, of the test interface.
enum class Discrete { nothing, transmitted, all };

/// Reflects and transmits evenly in all directions (Lambert's law on both sides), or to a single
/// one. From outside it transmits `share`; from inside share / eta^2, so that it is reciprocal.
template <class RealType, bool estimated = false>
class LambertInterface
{
public:
    using Real = RealType;
    static constexpr int random_numbers = 3;
    static constexpr bool stochastic_eval = estimated;

    LambertInterface(Real eta, Real share, Discrete discrete = Discrete::nothing)
        : _eta(eta), _share(share), _discrete(discrete)
    {}

    Real eta() const { return _eta; }
    Real transmits(const Vec3<Real>& wo) const
    {
        return wo.z > 0 ? _share : _share / (_eta * _eta);
    }

    /// Where the microsurface would be: only its widths and delta limit are asked for.
    struct Widths
    {
        bool delta;
        Real alpha_x() const { return Real(0.75); }
        Real alpha_y() const { return Real(0.25); }
        bool is_delta() const { return delta; }
    };
    Widths distribution() const { return {_discrete == Discrete::all}; }

    Traits traits() const
    {
        Traits t;
        t.reciprocal = t.energy_preserving = t.exact_pdf = t.transmissive = true;
        t.stochastic_eval = estimated;
        t.delta = _discrete != Discrete::nothing;
        t.random_numbers = random_numbers;
        return t;
    }

    class Prepared
    {
    public:
        Prepared(const LambertInterface& closure, const Vec3<Real>& wo)
            : _closure(closure), _valid(detail::is_direction(wo) && wo.z != 0), _wo(wo)
        {}
        const Vec3<Real>& wo() const { return _wo; }
        void scale_by(const Color3<Real>& weight) { _weight *= weight; }

        /// A closure whose value is known has no random numbers here, one that estimates does.
        template <bool exact = !estimated, class = std::enable_if_t<exact>>
        Color3<Real> eval(const Vec3<Real>& wi) const
        {
            return _weight * density(wi);
        }
        template <bool random = estimated, class = std::enable_if_t<random>>
        Color3<Real> eval(const Vec3<Real>& wi, const Vec3<Real>& u) const
        {
            // Twice a number in [0, 1) is 1 on average.
            return _weight * (density(wi) * 2 * u.x);
        }
        Sample<Real> sample(const Vec3<Real>& u) const
        {
            Sample<Real> s;
            s.wi = {0, 0, 1};
            s.weight = Color3<Real>(Real(0));
            s.pdf = 0;
            s.valid = _valid;
            if (!_valid) return s;
            const Real share = _closure.transmits(_wo);
            s.transmitted = u.z < share;
            s.delta = is_discrete(s.transmitted);
            s.weight = _weight;
            s.pdf = s.transmitted ? share : 1 - share;
            if (s.delta)
            {
                s.wi = s.transmitted ? -_wo : Vec3<Real>(-_wo.x, -_wo.y, _wo.z);
                return s;
            }
            const Real r = std::sqrt(u.x), phi = 2 * Real(M_PI) * u.y;
            const Real side = (_wo.z > 0) != s.transmitted ? Real(1) : Real(-1);
            s.wi = {r * std::cos(phi), r * std::sin(phi), side * std::sqrt(1 - u.x)};
            s.pdf = density(s.wi);
            s.valid = s.pdf > 0;
            return s;
        }
        Real pdf(const Vec3<Real>& wi) const { return density(wi); }
        Albedo<Real> albedo() const
        {
            const Real share = _valid ? _closure.transmits(_wo) : Real(0);
            return {_weight * ((_valid ? 1 : 0) - share), _weight * share};
        }

    private:
        bool is_discrete(bool transmitted) const
        {
            return _closure._discrete == Discrete::all ||
                   (transmitted && _closure._discrete == Discrete::transmitted);
        }
        Real density(const Vec3<Real>& wi) const
        {
            const bool transmitted = (wi.z > 0) != (_wo.z > 0);
            if (!_valid || !detail::is_direction(wi) || is_discrete(transmitted)) return 0;
            const Real share = _closure.transmits(_wo);
            return (transmitted ? share : 1 - share) * std::abs(wi.z) / Real(M_PI);
        }

        LambertInterface _closure;
        bool _valid;
        Vec3<Real> _wo;
        Color3<Real> _weight{Real(1)};
    };

    Prepared prepare(const Vec3<Real>& wo) const { return Prepared(*this, wo); }
    Real pdf(const Vec3<Real>& wo, const Vec3<Real>& wi) const { return prepare(wo).pdf(wi); }

private:
    Real _eta, _share;
    Discrete _discrete;
};

/// A gain that tells every direction from every other.
template <class Real>
struct SlopedGain
{
    Color3<Real> at(const Vec3<Real>& wo) const
    {
        return {1 + wo.z / 2, 1 + wo.x / 2, 1 + wo.y / 2};
    }
};

/// A material that is one closure.
template <class Closure>
struct ClosureMaterial
{
    Closure value;

    template <class Real>
    Closure closure(Real) const
    {
        return value;
    }
    const char* lobe_name() const { return "interface"; }
};
template <class Closure>
ClosureMaterial(Closure) -> ClosureMaterial<Closure>;

}  // namespace regain::tests
