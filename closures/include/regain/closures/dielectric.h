// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// `dielectric`: a rough interface between two dielectrics, of microfacets that each reflect and
/// refract once. MaterialX's dielectric_bsdf, OSL's dielectric_bsdf.
///
///   reflected    F D G2 / (4 cos_o cos_i) * cos_i                      Walter et al. 2007, Eq. 20
///   transmitted  (1 - F) D G2 |wo.m| |wi.m| eta_o^2 / (cos_o |h|^2),   Eq. 21 as energy
///                h = wo + eta_o wi, m along h
///
/// with cosines of absolute value and eta_o the index ahead of wo over the one behind: eta for
/// wo.z > 0, 1 / eta for wo.z < 0. Eq. 21 carries radiance; what is returned here carries energy
/// (importance): f(wo, wi) = eta_o^2 f(wi, wo), and adapters multiply by the (n_o / n_i)^2 that
/// radiance gains. All is sampled by visible normals, then by F of the facet, so that the weight is
/// G2 / G1(wo).
///
/// Two forms of G2 exist for transmission. `correlated` is 1 / (1 + Lambda_o + Lambda_i), as for
/// reflection. `beta`, B(1 + Lambda_o, 1 + Lambda_i), is what the Smith model means by passing in
/// from one side and out to the other (Heitz et al. 2016), and far lower at grazing angles.
///
/// Delta lobes. Of a flat surface (the distribution's delta limit) both lobes are. The transmitted
/// directions spread over |eta - 1| alpha; at or below delta_width of that, light passes along the
/// direction that the macroscopic surface refracts it to, while reflection stays rough. Its weight
/// is then the G2 / G1(wo) that the rough lobe tends to, so that neither the albedo nor its
/// compensation jumps, and its pdf the 1 - F of the facet that was drawn, whose mean is P(delta).
/// At eta = 1 nothing is reflected. A flat surface of mode T samples nothing beyond the critical
/// angle.

#pragma once

#include <regain/closures/beta_function.h>
#include <regain/closures/channels.h>
#include <regain/closures/closure.h>
#include <regain/closures/dielectric_fresnel.h>
#include <regain/closures/dielectric_tables.h>
#include <regain/closures/ggx.h>
#include <regain/closures/random_stream.h>

#include <type_traits>
#include <utility>

REGAIN_NAMESPACE_BEGIN

/// Which of its two lobes a dielectric has: reflected, transmitted, both.
enum class ScatterMode { R, T, RT };

/// The masking and shadowing of transmitted light; see above.
enum class TransmissionShadowing { correlated, beta };

template <class DistributionType>
class Dielectric : public Shorthands<Dielectric<DistributionType>, typename DistributionType::Real>
{
public:
    using Distribution = DistributionType;
    using Real = typename Distribution::Real;
    using Mask = MaskOf<Real>;
    using Color = Color3<Real>;
    using Channels = detail::ChannelsOf<Real>;
    static constexpr int random_numbers = 3;

    /// The bound of |eta - 1| alpha: directions are known to an ulp, and the half-vector of two
    /// that oppose each other to an ulp over |eta - 1|, which has to be small beside alpha.
    static constexpr double delta_width = sizeof(ScalarOf<Real>) == 4 ? 1e-5 : 1e-9;

    /// eta: index on the -z side over index on the +z side, in [1e-2, 1e2], clamped, NaN becomes
    /// 1.5. Tints in [0, 1] per channel, clamped, NaN becomes 0. The tables, of this distribution
    /// and this form of shadowing, make albedo() a look-up; without them it integrates, which is
    /// slower.
    REGAIN_HOST_DEVICE Dielectric(
        const Distribution& distribution, Real eta, ScatterMode mode = ScatterMode::RT,
        const Color& reflection_tint = Color(Real(1)),
        const Color& transmission_tint = Color(Real(1)),
        TransmissionShadowing shadowing = TransmissionShadowing::correlated,
        const DielectricAlbedoTables& tables = {})
        : _distribution(distribution),
          _eta(RelativeIndex<Real>::of(eta)),
          _reflection_tint(detail::saturated_channels(reflection_tint)),
          _transmission_tint(detail::saturated_channels(transmission_tint)),
          _mode(mode),
          _shadowing(shadowing),
          _tables(tables)
    {}

    REGAIN_HOST_DEVICE const Distribution& distribution() const { return _distribution; }
    REGAIN_HOST_DEVICE Real eta() const { return _eta.eta; }
    REGAIN_HOST_DEVICE ScatterMode scatter_mode() const { return _mode; }
    REGAIN_HOST_DEVICE Color reflection_tint() const { return detail::color(_reflection_tint); }
    REGAIN_HOST_DEVICE Color transmission_tint() const { return detail::color(_transmission_tint); }
    REGAIN_HOST_DEVICE TransmissionShadowing transmission_shadowing() const { return _shadowing; }

    REGAIN_HOST_DEVICE const DielectricAlbedoTables& tables() const { return _tables; }
    REGAIN_HOST_DEVICE void set_tables(const DielectricAlbedoTables& tables) { _tables = tables; }

    /// Index ahead of a direction over index behind it.
    REGAIN_HOST_DEVICE RelativeIndex<Real> relative_index(const Vec3<Real>& w) const
    {
        return detail::select(w.z < Real(0), _eta.inverse(), _eta);
    }

    /// Light passes in one direction.
    REGAIN_HOST_DEVICE Mask transmits_delta() const
    {
        const Real alpha = detail::max(_distribution.alpha_x(), _distribution.alpha_y());
        const Real width = detail::abs(_eta.minus_one) / detail::max(_eta.eta, Real(1)) * alpha;
        const Mask flat = _distribution.is_delta(),
                   narrow = width <= detail::constant<Real>(delta_width);
        return flat | narrow;
    }

    REGAIN_HOST_DEVICE Traits traits() const
    {
        Traits t;
        t.reciprocal = true;
        t.exact_pdf = true;
        t.transmissive = _mode != ScatterMode::R;
        t.delta = detail::any<Real>(t.transmissive ? transmits_delta() : _distribution.is_delta());
        t.anisotropic = !detail::all<Real>(_distribution.alpha_x() == _distribution.alpha_y());
        t.random_numbers = random_numbers;
        return t;
    }

    /// Works on the side of wo: what is seen from below is mirrored to above.
    class Prepared
    {
    public:
        REGAIN_HOST_DEVICE Prepared(const Dielectric& lobe, const Vec3<Real>& wo)
            : Prepared(lobe, detail::is_off_horizon(wo), wo)
        {}

        REGAIN_HOST_DEVICE Vec3<Real> wo() const { return turned(_wo); }

        /// Multiplies the closure weight: all that eval, sample and albedo return, and no direction
        /// or pdf.
        REGAIN_HOST_DEVICE void scale_by(const Color& weight)
        {
            const Channels w = detail::channels(weight);
            _reflection = _reflection * w;
            _transmission = _transmission * w;
        }

        REGAIN_INLINE Color eval(const Vec3<Real>& wi) const
        {
            const Terms t = terms(wi);
            return detail::select(
                t.valid, detail::color(tint(t.reflected) * (t.weight * t.density)), Color(Real(0)));
        }

        /// u.x, u.y: the normal; u.z: reflection where it is below the facet's F.
        REGAIN_INLINE Sample<Real> sample(const Vec3<Real>& u) const
        {
            const Vec3<Real> up(Real(0), Real(0), Real(1));
            const Vec3<Real> m = detail::select(_flat, up, _visible.sample(normal_numbers(u)));
            const Real cos_facet = detail::clamped(detail::dot(_wo, m), 0, 1);
            const auto F = _fresnel.split(cos_facet);
            const Mask reflect = chooses_reflection(F.reflectance, detail::saturate(u.z));

            Refraction<Real> refraction{regain::reflect(_wo, m), Real(0), Mask(false)};
            Vec3<Real> scattered = refraction.wi;
            if (!detail::all<Real>(reflect))
            {
                refraction =
                    refract(_wo, detail::select(_narrow, up, m), _fresnel.relative_index());
                scattered = detail::select(reflect, scattered, refraction.wi);
            }
            const Vec3<Real> wi = turned(scattered);
            const Terms t = terms(wi);

            const Mask is_delta = detail::both<Real>(_narrow, _flat | !reflect);
            const Mask on_its_side = !detail::differ<Real>(reflect, t.reflected);
            const Real share = detail::select(reflect, F.reflectance, F.transmittance);
            const Real choice = both_lobes() ? share : Real(1);
            const Real passed = both_lobes() ? Real(1) : share;
            Real weight = t.weight;
            if (detail::any<Real>(is_delta))
                weight = detail::select(is_delta, passed * delta_masking(refraction.wi, t.masking),
                                        weight);

            Sample<Real> s;
            s.pdf = detail::select(is_delta, choice, t.density);
            // Of a lobe alone, what the facet lets through may be nothing.
            const Mask passes = reflect | (share > Real(0));
            s.valid = detail::both<Real>(_valid & on_its_side & passes & (s.pdf > Real(0)),
                                         is_delta | (t.valid & (reflect | refraction.valid)));
            s.delta = s.valid & is_delta;
            s.transmitted = s.valid & !reflect;
            s.pdf = detail::select(s.valid, s.pdf, Real(0));
            s.wi = detail::select(s.valid, wi, up);
            s.weight =
                detail::select(s.valid, detail::color(tint(reflect) * weight), Color(Real(0)));
            return s;
        }

        REGAIN_INLINE Real pdf(const Vec3<Real>& wi) const
        {
            const Terms t = terms(wi);
            return detail::select(t.valid, t.density, Real(0));
        }

        REGAIN_HOST_DEVICE Albedo<Real> albedo() const
        {
            if (!_lobe._tables)
                return {reflects() ? alone(ScatterMode::R).reflect : Color(Real(0)),
                        transmits() ? alone(ScatterMode::T).transmit : Color(Real(0))};

            const Real eta = _fresnel.relative_index().eta, mu = detail::min(_wo.z, Real(1));
            const auto F = _fresnel.split(mu);
            const Real E = _lobe._tables.albedo(_lobe._distribution, eta, _wo);
            const Real share = _lobe._tables.reflected_share(_lobe._distribution, eta, _wo);
            const Color none(Real(0));
            return {reflects() ? detail::color(_reflection) *
                                     detail::select(_flat, F.reflectance, E * share)
                               : none,
                    transmits() ? detail::color(_transmission) *
                                      detail::select(_flat, F.transmittance, E * (Real(1) - share))
                                : none};
        }

    private:
        using Visible = decltype(std::declval<const Distribution&>().visible(Vec3<Real>()));

        REGAIN_HOST_DEVICE Prepared(const Dielectric& lobe, const Mask& valid, const Vec3<Real>& wo)
            : _lobe(lobe),
              _valid(valid),
              _flat(lobe._distribution.is_delta()),
              _narrow(lobe.transmits_delta()),
              _side(detail::select(detail::both<Real>(valid, detail::quiet_less(wo.z, Real(0))),
                                   Real(-1), Real(1))),
              _wo(detail::normalised(
                  detail::select(valid, turned(wo), Vec3<Real>(Real(0), Real(0), Real(1))))),
              _fresnel(lobe.relative_index(Vec3<Real>(Real(0), Real(0), _side))),
              _visible(normals(lobe, _wo)),
              _sigma_o(_visible.projected_area()),
              _reflection(lobe._reflection_tint * detail::select(valid, Real(1), Real(0))),
              _transmission(lobe._transmission_tint * detail::select(valid, Real(1), Real(0)))
        {
            _inv_sigma_o = Real(1) / _sigma_o;
            _reflected_density = Real(0.25f) * _inv_sigma_o;
            if constexpr (may_leave_out_normals)
                if (!transmits()) _reflected_density = _visible.reflected_density();
            _reflected_weight = Real(0.25f) / _reflected_density;
            if (_lobe._shadowing == TransmissionShadowing::beta && transmits())
                _lambda_o = _lobe._distribution.lambda(_wo);
        }

        // The albedo of one of the lobes, which takes no choice and so no third random number.
        REGAIN_HOST_DEVICE Albedo<Real> alone(ScatterMode mode) const
        {
            Prepared lobe = *this;
            lobe._lobe._mode = mode;
            return detail::mean_weight<Real>(lobe, detail::grid_rows<Distribution>);
        }

        // A lobe that only reflects may leave out the normals that reflect below the horizon.
        static constexpr bool may_leave_out_normals =
            std::is_same_v<Visible,
                           decltype(std::declval<const Distribution&>().reflecting(Vec3<Real>()))>;
        REGAIN_HOST_DEVICE static Visible normals(const Dielectric& lobe, const Vec3<Real>& wo)
        {
            if constexpr (may_leave_out_normals)
                if (lobe._mode == ScatterMode::R) return lobe._distribution.reflecting(wo);
            return lobe._distribution.visible(wo);
        }

        // The third number of the normal has to be independent of the choice of the lobe.
        REGAIN_HOST_DEVICE Vec3<Real> normal_numbers(const Vec3<Real>& u) const
        {
            if constexpr (Distribution::random_numbers > 2)
                if (both_lobes()) return {u.x, u.y, RandomStream<Real>(u).next()};
            return u;
        }

        REGAIN_INLINE bool reflects() const { return _lobe._mode != ScatterMode::T; }
        REGAIN_INLINE bool transmits() const { return _lobe._mode != ScatterMode::R; }
        REGAIN_INLINE bool both_lobes() const { return _lobe._mode == ScatterMode::RT; }

        REGAIN_HOST_DEVICE Mask chooses_reflection(const Real& F, const Real& u) const
        {
            if (!both_lobes()) return Mask(reflects());
            return (u < F) | (F >= Real(1));
        }

        REGAIN_INLINE Vec3<Real> turned(const Vec3<Real>& w) const
        {
            return {w.x, w.y, w.z * _side};
        }

        REGAIN_INLINE Channels tint(const Mask& reflected) const
        {
            return detail::select(reflected, _reflection, _transmission);
        }

        // All that eval, sample and pdf have in common, so that weight = eval / pdf by
        // construction.
        struct Terms
        {
            Mask reflected;  // or else transmitted
            Mask valid;    // the one predicate: sample returns such wi, eval and pdf know no others
            Real weight;   // f cos theta_i / density
            Real density;  // per steradian
            Real masking;  // G2 / G1(wo)
        };

        REGAIN_INLINE Terms terms(const Vec3<Real>& direction) const
        {
            const Vec3<Real> up(Real(0), Real(0), Real(1));
            const Mask possible = detail::both<Real>(_valid, detail::is_off_horizon(direction));
            if (!detail::any<Real>(possible))
                return {Mask(true), possible, Real(0), Real(0), Real(1)};
            const Vec3<Real> wi = detail::select(possible, turned(direction), up);
            const Mask reflected = wi.z > Real(0);

            const Vec3<Real> wi_up(wi.x, wi.y, detail::abs(wi.z));
            const Real sigma_i = _lobe._distribution.projected_area(wi_up);
            // G2 / cos theta_o of the correlated form, finite at grazing angles.
            const Real shadowing =
                wi_up.z / (_sigma_o * wi_up.z + sigma_i * _wo.z - _wo.z * wi_up.z);

            // One float is on one side.
            if (detail::all<Real>(reflected)) return reflection(wi, shadowing, possible);
            const Terms t = transmission(wi, wi_up, shadowing, possible);
            if (!detail::any<Real>(reflected)) return t;
            const Terms r = reflection(wi, shadowing, possible);
            const Mask reflects_here = detail::both<Real>(reflected, r.valid),
                       passes_here = detail::both<Real>(!reflected, t.valid);
            const Mask valid = reflects_here | passes_here;
            return {reflected, valid, detail::select(reflected, r.weight, t.weight),
                    detail::select(reflected, r.density, t.density),
                    detail::select(reflected, r.masking, t.masking)};
        }

        // Of wi on the side of wo.
        REGAIN_INLINE Terms reflection(const Vec3<Real>& wi, const Real& shadowing,
                                       const Mask& possible) const
        {
            Terms t{Mask(true), Mask(false), Real(0), Real(0), shadowing * _sigma_o};
            if (!reflects()) return t;
            const Facet f(detail::half_vector(_wo, wi));
            // Where both are above, so is the facet that lies half-way, and it faces both.
            t.valid = detail::both<Real>(possible & f.known, !_flat);
            // Of the unit half-vector wo.h is half the length of the sum.
            const Real c2 = detail::min(Real(0.25f) * f.length2, Real(1));
            t.weight = shadowing * _reflected_weight;
            t.density = _lobe._distribution.D(f.h, f.length2) * _reflected_density;
            (both_lobes() ? t.density : t.weight) *= _fresnel.split_of_square(c2).reflectance;
            return t;
        }

        // Of wi on the other side.
        REGAIN_INLINE Terms transmission(const Vec3<Real>& wi, const Vec3<Real>& wi_up,
                                         const Real& shadowing, const Mask& possible) const
        {
            Terms t{Mask(false), Mask(false), Real(0), Real(0),
                    transmission_masking(wi_up, shadowing)};
            if (!transmits()) return t;
            const Facet f(detail::refraction_half_vector(_wo, wi, _fresnel.relative_index()));
            // is_transmission(), of which the sides of wo and wi are known here.
            const Real near = detail::dot(_wo, f.h), far = -detail::dot(wi, f.h);
            const Mask faces = (f.h.z > Real(0)) & (near > Real(0)) & (far > Real(0));
            t.valid = detail::both<Real>(possible & f.known & faces, !_narrow);
            const Real inv = Real(1) / f.length2, eta = _fresnel.relative_index().eta;
            t.weight = t.masking;
            t.density = _lobe._distribution.D(f.h, f.length2) *
                        (_inv_sigma_o * (eta * near * inv) * (eta * far * inv));
            // Of the cosines, near and far over the length of h, nothing else is needed.
            (both_lobes() ? t.density : t.weight) *= _fresnel.transmittance(near, far);
            return t;
        }

        // Where wi is wo's continuation, the facet is any.
        struct Facet
        {
            Mask known;
            Vec3<Real> h;
            Real length2;

            REGAIN_INLINE explicit Facet(const Vec3<Real>& sum) : h(sum), length2(detail::dot(h, h))
            {
                known = length2 > detail::constant<Real>(1e-20);
                h = detail::select(known, h, Vec3<Real>(Real(0), Real(0), Real(1)));
                length2 = detail::select(known, length2, Real(1));
            }
        };

        REGAIN_HOST_DEVICE Real transmission_masking(const Vec3<Real>& wi_up,
                                                     const Real& shadowing) const
        {
            if (_lobe._shadowing == TransmissionShadowing::correlated || !transmits())
                return shadowing * _sigma_o;
            return beta_quotient(_lambda_o, _lobe._distribution.lambda(wi_up));
        }

        // G2 / G1(wo) of the rough lobe in the limit that it is narrow. Facets that are tilted turn
        // wo less than the surface as a whole does: in the mean by mu / sigma_o of that, where
        // the turn is small.
        REGAIN_HOST_DEVICE Real delta_masking(const Vec3<Real>& refracted,
                                              const Real& masking) const
        {
            const Mask rough = detail::both<Real>(_narrow, !_flat);
            if (!detail::any<Real>(rough)) return detail::select(_flat, Real(1), masking);
            const Real whole = detail::abs(refracted.z), mu = _wo.z;
            const Real z = detail::min(mu + (whole - mu) * (mu * _inv_sigma_o), Real(1));
            const Real tangential2 = refracted.x * refracted.x + refracted.y * refracted.y;
            const Real wanted2 = detail::max(Real(1) - z * z, Real(0));
            const Real scale =
                detail::sqrt(wanted2 / detail::max(tangential2, detail::constant<Real>(1e-12)));
            const Vec3<Real> wi(refracted.x * scale, refracted.y * scale, z);
            const Real correlated =
                _sigma_o * z /
                (_sigma_o * z + _lobe._distribution.projected_area(wi) * mu - mu * z);
            return detail::select(_flat, Real(1),
                                  transmission_masking(wi, correlated * _inv_sigma_o));
        }

        Dielectric _lobe;
        Mask _valid, _flat, _narrow;
        Real _side;      // 1 above, -1 below
        Vec3<Real> _wo;  // above
        DielectricFresnel<Real> _fresnel;
        Visible _visible;
        Real _sigma_o, _inv_sigma_o;
        Real _reflected_density, _reflected_weight;  // what turns D and G2 into them
        Real _lambda_o = Real(0);
        Channels _reflection, _transmission;  // what multiplies the lobes
    };

    REGAIN_HOST_DEVICE Prepared prepare(const Vec3<Real>& wo) const { return Prepared(*this, wo); }

private:
    Distribution _distribution;
    RelativeIndex<Real> _eta;
    Channels _reflection_tint, _transmission_tint;
    ScatterMode _mode;
    TransmissionShadowing _shadowing;
    DielectricAlbedoTables _tables;
};

REGAIN_NAMESPACE_END
