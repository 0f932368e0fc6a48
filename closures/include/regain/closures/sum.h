// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Two closures added: f = f_1 + f_2, one closure again. Of a pair of directions each lobe gives
/// its share; a sample comes from one of them, chosen by expected albedo, and is weighed against
/// the density of both:
///
///   pdf(wi)  = p pdf_1(wi) + (1 - p) pdf_2(wi)
///   weight   = (f_1 + f_2) cos theta_i / pdf
///
/// (one-sample multiple importance sampling with the balance heuristic: Veach 1997, Section 9.2.4).
/// MaterialX's `add`. Adding is the caller's responsibility: nothing keeps the sum from reflecting
/// more than arrives.
///
/// A lobe without density (a mirror) keeps its samples to itself: their weight is the lobe's over
/// the probability of choosing it. Garbage in directions gets what closure.h says, lobe by lobe.

#pragma once

#include <regain/closures/closure.h>

#include <utility>

REGAIN_NAMESPACE_BEGIN

template <class FirstType, class SecondType>
class Sum : public Shorthands<Sum<FirstType, SecondType>, typename FirstType::Real>
{
public:
    using First = FirstType;
    using Second = SecondType;
    using Real = typename First::Real;
    using Mask = MaskOf<Real>;
    using Color = Color3<Real>;
    /// The third chooses the lobe; stretched, it serves a lobe that reads three itself.
    static constexpr int random_numbers = 3;

    REGAIN_HOST_DEVICE Sum(const First& first, const Second& second)
        : _first(first), _second(second)
    {}

    REGAIN_HOST_DEVICE const First& first() const { return _first; }
    REGAIN_HOST_DEVICE const Second& second() const { return _second; }

    REGAIN_HOST_DEVICE Traits traits() const
    {
        const Traits a = _first.traits(), b = _second.traits();
        Traits t;
        t.reciprocal = a.reciprocal && b.reciprocal;
        t.exact_pdf = a.exact_pdf && b.exact_pdf;
        t.delta = a.delta || b.delta;
        t.transmissive = a.transmissive || b.transmissive;
        t.anisotropic = a.anisotropic || b.anisotropic;
        t.random_numbers = random_numbers;
        return t;
    }

    class Prepared
    {
    public:
        REGAIN_HOST_DEVICE Prepared(const Sum& sum, const Vec3<Real>& wo)
            : Prepared(sum._first.prepare(wo), sum._second.prepare(wo))
        {}

        REGAIN_HOST_DEVICE Prepared(const typename First::Prepared& first,
                                    const typename Second::Prepared& second)
            : Prepared(first, second, total(regain::expected_albedo(first)),
                       total(regain::expected_albedo(second)))
        {}

        /// `energy_1` and `energy_2`, not negative, say how often each lobe is chosen. One whose
        /// energy is 0 never is: it has to be black then.
        REGAIN_HOST_DEVICE Prepared(const typename First::Prepared& first,
                                    const typename Second::Prepared& second, Real energy_1,
                                    Real energy_2)
            : _first(first), _second(second)
        {
            // An estimate is no reason to starve a lobe.
            const Real share =
                energy_1 / detail::max(energy_1 + energy_2, detail::constant<Real>(1e-30));
            _p = detail::sanitised(share, least_probability, 1 - least_probability, 0.5);
            _p = detail::select(energy_1 > Real(0), _p, Real(0));
            _p = detail::select(energy_2 > Real(0), _p, Real(1));
        }

        REGAIN_HOST_DEVICE decltype(auto) wo() const { return _first.wo(); }
        REGAIN_HOST_DEVICE void scale_by(const Color& weight)
        {
            _first.scale_by(weight);
            _second.scale_by(weight);
        }

        REGAIN_HOST_DEVICE const typename First::Prepared& first() const { return _first; }
        REGAIN_HOST_DEVICE const typename Second::Prepared& second() const { return _second; }

        /// Probability that sample asks the first lobe.
        REGAIN_HOST_DEVICE Real first_probability() const { return _p; }

        REGAIN_HOST_DEVICE Color eval(const Vec3<Real>& wi) const
        {
            return _first.eval(wi) + _second.eval(wi);
        }
        REGAIN_HOST_DEVICE Real pdf(const Vec3<Real>& wi) const
        {
            return _p * _first.pdf(wi) + (Real(1) - _p) * _second.pdf(wi);
        }

        REGAIN_HOST_DEVICE Sample<Real> sample(const Vec3<Real>& u) const
        {
            const Real z = detail::saturate(u.z), q = Real(1) - _p;
            const Real tiny = detail::constant<Real>(1e-30);
            const Mask first = (z < _p) | (_p == Real(1));

            Sample<Real> a = nothing(), b = nothing();
            if (detail::any<Real>(first))
                a = _first.sample(
                    Vec3<Real>(u.x, u.y, detail::saturate(z / detail::max(_p, tiny))));
            if (!detail::all<Real>(first))
                b = _second.sample(
                    Vec3<Real>(u.x, u.y, detail::saturate((z - _p) / detail::max(q, tiny))));

            Sample<Real> s;
            s.wi = detail::select(first, a.wi, b.wi);
            const Real density = pdf(s.wi);
            s.delta = either(first, a.delta, b.delta);
            s.valid =
                detail::both<Real>(either(first, a.valid, b.valid), s.delta | (density > Real(0)));
            s.transmitted =
                detail::both<Real>(s.valid, either(first, a.transmitted, b.transmitted));
            s.wi = detail::select(s.valid, s.wi, Vec3<Real>(Real(0), Real(0), Real(1)));

            const Real chosen = detail::max(detail::select(first, _p, q), tiny);
            const Color alone = detail::select(first, a.weight, b.weight) * (Real(1) / chosen);
            const Color mixed = eval(s.wi) * (Real(1) / detail::max(density, tiny));
            s.weight =
                detail::select(s.valid, detail::select(s.delta, alone, mixed), Color(Real(0)));
            s.pdf = detail::select(
                s.valid,
                detail::select(s.delta, chosen * detail::select(first, a.pdf, b.pdf), density),
                Real(0));
            return s;
        }

        REGAIN_HOST_DEVICE Albedo<Real> albedo() const
        {
            const Albedo<Real> a = _first.albedo(), b = _second.albedo();
            return {a.reflect + b.reflect, a.transmit + b.transmit};
        }

        REGAIN_HOST_DEVICE Albedo<Real> expected_albedo() const
        {
            const Albedo<Real> a = regain::expected_albedo(_first),
                               b = regain::expected_albedo(_second);
            return {a.reflect + b.reflect, a.transmit + b.transmit};
        }

    private:
        static constexpr double least_probability = 1.0 / 32;

        REGAIN_HOST_DEVICE static Mask either(const Mask& first, const Mask& a, const Mask& b)
        {
            const Mask second = !first;
            return (first & a) | (second & b);
        }
        REGAIN_HOST_DEVICE static Sample<Real> nothing()
        {
            Sample<Real> s;
            s.wi = Vec3<Real>(Real(0), Real(0), Real(1));
            s.weight = Color(Real(0));
            s.pdf = Real(0);
            return s;
        }
        REGAIN_HOST_DEVICE static Real total(const Albedo<Real>& albedo)
        {
            const Color sum = albedo.reflect + albedo.transmit;
            return sum.x + sum.y + sum.z;
        }

        typename First::Prepared _first;
        typename Second::Prepared _second;
        Real _p;
    };

    REGAIN_HOST_DEVICE Prepared prepare(const Vec3<Real>& wo) const { return Prepared(*this, wo); }

private:
    First _first;
    Second _second;
};

/// Sum<First, Second> without naming the types.
template <class First, class Second>
REGAIN_HOST_DEVICE Sum<First, Second> sum(const First& first, const Second& second)
{
    return {first, second};
}

REGAIN_NAMESPACE_END
