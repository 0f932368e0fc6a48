// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Reflection from a rough surface of microfacets that each reflect like a mirror, once:
///
///   f(wo, wi) = F(wo.h) D(h) G2(wo, wi) / (4 cos theta_o cos theta_i),   h = (wo + wi) / |wo + wi|
///
/// Turquin 2019, Eq. 1; Torrance and Sparrow 1967. With sigma = cos theta / G1 for each direction
/// this is, times cos theta_i,
///
///   f cos theta_i = F D cos theta_i / (4 (sigma_o cos_i + sigma_i cos_o - cos_o cos_i))
///
/// which stays finite at grazing angles. What a second bounce would bring is lost: that is what
/// compensated.h gives back. When the distribution is at its delta limit, the closure is a mirror.

#pragma once

#include <regain/closures/anisotropy.h>
#include <regain/closures/channels.h>
#include <regain/closures/closure.h>
#include <regain/closures/fresnel_moments.h>
#include <regain/closures/refraction.h>

#include <utility>

REGAIN_NAMESPACE_BEGIN

template <class DistributionType, class FresnelType>
class MicrofacetReflection : public Shorthands<MicrofacetReflection<DistributionType, FresnelType>,
                                               typename DistributionType::Real>
{
public:
    using Distribution = DistributionType;
    using Fresnel = FresnelType;
    using Real = typename Distribution::Real;
    using Mask = MaskOf<Real>;
    using Color = Color3<Real>;
    static constexpr int random_numbers = Distribution::random_numbers;

    /// `tables` make albedo() a look-up; without them it integrates, which is slower.
    REGAIN_HOST_DEVICE MicrofacetReflection(const Distribution& distribution,
                                            const Fresnel& fresnel, const AlbedoTables& tables = {})
        : _distribution(distribution), _fresnel(fresnel), _tables(tables)
    {}

    REGAIN_HOST_DEVICE const Distribution& distribution() const { return _distribution; }
    REGAIN_HOST_DEVICE const Fresnel& fresnel() const { return _fresnel; }

    REGAIN_HOST_DEVICE const AlbedoTables& tables() const { return _tables; }
    REGAIN_HOST_DEVICE void set_tables(const AlbedoTables& tables) { _tables = tables; }

    REGAIN_HOST_DEVICE Traits traits() const
    {
        Traits t;
        t.reciprocal = true;
        t.exact_pdf = true;
        t.delta = detail::any<Real>(_distribution.is_delta());
        t.anisotropic = !detail::all<Real>(_distribution.alpha_x() == _distribution.alpha_y());
        t.random_numbers = random_numbers;
        return t;
    }

    class Prepared
    {
    public:
        REGAIN_INLINE Prepared(const MicrofacetReflection& lobe, const Vec3<Real>& wo)
            : _lobe(lobe),
              _delta(lobe._distribution.is_delta()),
              _valid(detail::is_above_horizon(wo)),
              // Directions of hosts are unit up to their own rounding, samples up to this type's.
              _wo(detail::normalised(
                  detail::select(_valid, wo, Vec3<Real>(Real(0), Real(0), Real(1))))),
              _visible(lobe._distribution.reflecting(_wo)),
              _weight(detail::select(_valid, Real(1), Real(0)))
        {}

        REGAIN_HOST_DEVICE const Vec3<Real>& wo() const { return _wo; }

        /// Multiplies the closure weight: all that eval, sample and albedo return, and no direction
        /// or pdf.
        REGAIN_HOST_DEVICE void scale_by(const Color& weight)
        {
            _weight = _weight * detail::channels(weight);
        }

        REGAIN_INLINE Color eval(const Vec3<Real>& wi) const
        {
            const Terms t = terms(wi);
            const auto F = detail::fresnel_channels(_lobe._fresnel, t.cos_facet);
            return detail::select(t.valid, detail::color(F * (_weight * t.value)), Color(Real(0)));
        }

        REGAIN_HOST_DEVICE Sample<Real> sample(const Vec2<Real>& u) const
        {
            return sample(detail::two_numbers<MicrofacetReflection>(u));
        }
        /// u in [0, 1)^3, of which the first `random_numbers` are read.
        REGAIN_INLINE Sample<Real> sample(const Vec3<Real>& u) const
        {
            const Vec3<Real> m =
                detail::select(_delta, Vec3<Real>(Real(0), Real(0), Real(1)), _visible.sample(u));
            const Vec3<Real> wi = m * (Real(2) * detail::dot(_wo, m)) - _wo;
            const Terms t = terms(wi);

            Sample<Real> s;
            s.valid = _valid & (_delta | t.valid);
            s.delta = s.valid & _delta;
            s.wi = detail::select(s.valid, wi, Vec3<Real>(Real(0), Real(0), Real(1)));
            const Real cosine = detail::select(_delta, _wo.z, t.cos_facet);
            const auto F = detail::fresnel_channels(_lobe._fresnel, cosine) * _weight;
            const Real share = detail::select(_delta, Real(1), t.value / t.density);
            s.weight = detail::select(s.valid, detail::color(F * share), Color(Real(0)));
            s.pdf = detail::select(s.valid, detail::select(_delta, Real(1), t.density), Real(0));
            return s;
        }

        REGAIN_INLINE Real pdf(const Vec3<Real>& wi) const
        {
            const Terms t = terms(wi);
            return detail::select(t.valid, t.density, Real(0));
        }

        REGAIN_HOST_DEVICE Albedo<Real> albedo() const
        {
            const AlbedoTables& t = _lobe._tables;
            if (t.has_albedo() && t.has_moments()) return {tabulated_albedo(), Color(Real(0))};
            return detail::mean_weight<Real>(*this, detail::grid_rows<Distribution>);
        }

    private:
        // All that eval, sample and pdf have in common, so that weight = eval / pdf by
        // construction.
        struct Terms
        {
            Mask valid;    // the one predicate: sample returns such wi, eval and pdf know no others
            Real value;    // f cos theta_i with F = 1
            Real density;  // per steradian
            Real cos_facet;  // wo.h
        };

        REGAIN_INLINE Terms terms(const Vec3<Real>& direction) const
        {
            const Distribution& distribution = _lobe._distribution;

            Terms t;
            t.valid = detail::both<Real>(_valid & !_delta, detail::is_above_horizon(direction));
            // Of one float this leaves nothing to select below.
            if (!detail::any<Real>(t.valid)) return {t.valid, Real(0), Real(1), Real(1)};
            const Vec3<Real> wi =
                detail::select(t.valid, direction, Vec3<Real>(Real(0), Real(0), Real(1)));

            const Vec3<Real> h = detail::half_vector(_wo, wi);
            const Real length2 = detail::dot(h, h);
            // wo.h of the unit half-vector is half the length of the sum.
            t.cos_facet = detail::min(Real(0.5f) * detail::sqrt(length2), Real(1));

            const Real D = distribution.D(h, length2);
            const Real sigma_o = _visible.projected_area(),
                       sigma_i = distribution.projected_area(wi);
            t.value = D * Real(0.25f) * wi.z / (sigma_o * wi.z + sigma_i * _wo.z - _wo.z * wi.z);
            t.density = D * _visible.reflected_density();
            return t;
        }

        REGAIN_HOST_DEVICE Color tabulated_albedo() const
        {
            const AlbedoTables& tables = _lobe._tables;
            const DirectionAxes<Real> axes(_lobe._distribution);
            const Real mu = _wo.z;
            const Real E = detail::select(_delta, Real(1), axes.albedo(tables, _wo));
            const Color F = detail::select(_delta, _lobe._fresnel.at(mu),
                                           _lobe._fresnel.mean(tables.moments(axes, mu)));
            return F * detail::color(_weight) * E;
        }

        MicrofacetReflection _lobe;
        Mask _delta, _valid;
        Vec3<Real> _wo;
        decltype(std::declval<const Distribution&>().reflecting(Vec3<Real>())) _visible;
        detail::ChannelsOf<Real> _weight;
    };

    REGAIN_INLINE Prepared prepare(const Vec3<Real>& wo) const { return Prepared(*this, wo); }

private:
    Distribution _distribution;
    Fresnel _fresnel;
    AlbedoTables _tables;
};

REGAIN_NAMESPACE_END
