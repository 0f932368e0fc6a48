// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Compensation by an added lobe: what single scattering loses leaves in all directions, as a
/// symmetric product of the losses of both directions (Kulla and Conty 2017, after Kelemen and
/// Szirmay-Kalos 2001; Turquin 2019, Eq. 6):
///
///   f_ms(wo, wi) = F_ms (1 - E_ss(wo)) (1 - E_ss(wi)) / (pi (1 - E_avg))
///
/// Its albedo is F_ms (1 - E_ss(wo)), it is reciprocal, and with F = 1 nothing is lost. Its colour:
///
///   kulla-conty          F_ms = F_ss E_avg / (1 - F_ss (1 - E_avg))      Turquin 2019, Eq. 7
///   kulla-conty-series   F_ms = F_ss^2 E_avg / (1 - F_ss (1 - E_avg))    the series corrected
///
/// E_avg is the mean over all wi, of an anisotropic lobe over azimuths, too: its E_ss depends on
/// them, see anisotropy.h.
///
/// The printed series gives its first term, light of the second bounce, one factor of F_ss; but it
/// has met two facets. (Hill 2018 found the same.)
///
/// The lobe and the added lobe make one closure: hosts see one eval, one pdf and weights that are
/// their quotient. The added lobe is sampled by missing_energy.h.
///
/// Building one asks the table of E_ss 28 times, an anisotropic one 168 times; it is meant to be
/// built once per material, or once per shading point where alpha is textured. Per shading point
/// and per direction the cost is one look-up.

#pragma once

#include <regain/closures/directional_loss.h>
#include <regain/closures/microfacet_reflection.h>
#include <regain/closures/missing_energy.h>
#include <regain/closures/reflection_with_added_lobe.h>

#include <optional>
#include <string_view>

REGAIN_NAMESPACE_BEGIN

/// Which F_ms.
enum class KullaContyForm { printed, series };

constexpr KullaContyForm all_kulla_conty_forms[] = {KullaContyForm::printed,
                                                    KullaContyForm::series};

/// The name on command lines and in documents.
constexpr std::string_view name(KullaContyForm form)
{
    return form == KullaContyForm::printed ? "kulla-conty" : "kulla-conty-series";
}

/// The form of that name, or nothing.
constexpr std::optional<KullaContyForm> kulla_conty_form_named(std::string_view wanted)
{
    for (KullaContyForm form : all_kulla_conty_forms)
        if (name(form) == wanted) return form;
    return std::nullopt;
}

/// F_ms of a form for F_ss and E_avg in [0, 1], per channel.
template <class Real>
REGAIN_HOST_DEVICE Color3<Real> kulla_conty_tint(KullaContyForm form, const Color3<Real>& F_ss,
                                                 Real E_avg)
{
    return detail::per_channel(F_ss, [&](Real F) {
        const Real numerator = form == KullaContyForm::printed ? F : F * F;
        // 1 - F (1 - E_avg), which does not cancel where F is 1; then 0 / 0 where nothing is
        // reflected once.
        return numerator * E_avg /
               detail::max(Real(1) - F + F * E_avg, detail::constant<Real>(1e-9));
    });
}

/// The added lobe alone: black for a mirror and without a table. Of an isotropic surface it is
/// symmetric about the normal.
template <class RealType>
class MissingEnergyLobe : public Shorthands<MissingEnergyLobe<RealType>, RealType>
{
public:
    using Real = RealType;
    using Mask = MaskOf<Real>;
    using Color = Color3<Real>;
    static constexpr int random_numbers = 2;

    /// White, so F_ms = 1. Of `tables` it needs E_ss of this distribution.
    template <class Distribution>
    REGAIN_HOST_DEVICE MissingEnergyLobe(const Distribution& distribution,
                                         const MicrofacetTables& tables)
        : _loss(distribution, tables), _tint(Real(1))
    {
        if (bound())
            _missing = MissingEnergy<Real>(axes().alpha(), [this](Real mu) {
                return axes().azimuth_mean(mu, [this](const Vec3<Real>& w) { return loss(w); });
            });
    }

    REGAIN_HOST_DEVICE bool bound() const { return _loss.bound(); }
    REGAIN_HOST_DEVICE const MissingEnergy<Real>& missing() const { return _missing; }

    /// F_ms, in [0, 1] per channel.
    REGAIN_HOST_DEVICE const Color& tint() const { return _tint; }
    REGAIN_HOST_DEVICE void set_tint(const Color& tint) { _tint = tint; }

    /// 1 - E_ss of a unit w, w.z in [0, 1].
    REGAIN_HOST_DEVICE Real loss(const Vec3<Real>& w) const { return _loss.at(w); }

    REGAIN_HOST_DEVICE Traits traits() const
    {
        Traits t;
        t.reciprocal = true;
        t.exact_pdf = true;
        t.anisotropic = !axes().isotropic();
        t.random_numbers = random_numbers;
        return t;
    }

    class Prepared
    {
    public:
        REGAIN_HOST_DEVICE Prepared(const MissingEnergyLobe& lobe, const Vec3<Real>& wo)
            : _lobe(lobe),
              _valid(detail::is_above_horizon(wo)),
              _wo(detail::select(_valid, wo, Vec3<Real>(Real(0), Real(0), Real(1)))),
              _loss(lobe.loss({_wo.x, _wo.y, detail::min(_wo.z, Real(1))})),
              _scale(_loss * detail::constant<Real>(0.318309886183790671538) /
                     detail::max(lobe._missing.average(), detail::constant<Real>(1e-30))),
              _weight(lobe._tint)
        {
            _valid = detail::both<Real>(_valid, _loss > Real(0));
            _weight = detail::select(_valid, _weight, Color(Real(0)));
        }

        REGAIN_HOST_DEVICE const Vec3<Real>& wo() const { return _wo; }
        REGAIN_HOST_DEVICE void scale_by(const Color& weight) { _weight *= weight; }

        /// 1 - E_ss(wo).
        REGAIN_HOST_DEVICE Real loss() const { return _loss; }

        REGAIN_HOST_DEVICE Color eval(const Vec3<Real>& wi) const
        {
            const Terms t = terms(wi);
            return detail::select(t.valid, _weight * value(t), Color(Real(0)));
        }

        REGAIN_HOST_DEVICE Sample<Real> sample(const Vec2<Real>& u) const
        {
            return sample(detail::two_numbers<MissingEnergyLobe>(u));
        }
        REGAIN_HOST_DEVICE Sample<Real> sample(const Vec3<Real>& u) const
        {
            const Real mu = _lobe._missing.sample(detail::saturate(u.x));
            const Vec3<Real> wi = at_some_azimuth(mu, detail::saturate(u.y));
            const Terms t = terms(wi);

            Sample<Real> s;
            s.valid = t.valid;
            s.wi = detail::select(s.valid, wi, Vec3<Real>(Real(0), Real(0), Real(1)));
            const Real pdf = density(t);
            s.weight = detail::select(s.valid, _weight * (value(t) / pdf), Color(Real(0)));
            s.pdf = detail::select(s.valid, pdf, Real(0));
            return s;
        }

        REGAIN_HOST_DEVICE Real pdf(const Vec3<Real>& wi) const
        {
            const Terms t = terms(wi);
            return detail::select(t.valid, density(t), Real(0));
        }

        REGAIN_HOST_DEVICE Albedo<Real> albedo() const { return {_weight * _loss, Color(Real(0))}; }

    private:
        struct Terms
        {
            Mask valid;
            Vec3<Real> wi;
        };
        REGAIN_HOST_DEVICE Terms terms(const Vec3<Real>& wi) const
        {
            Terms t;
            t.valid = detail::both<Real>(_valid, detail::is_above_horizon(wi));
            t.wi = detail::select(t.valid, wi, Vec3<Real>(Real(0), Real(0), Real(1)));
            t.wi.z = detail::min(t.wi.z, Real(1));
            return t;
        }
        // f cos theta_i of a white lobe.
        REGAIN_HOST_DEVICE Real value(const Terms& t) const
        {
            return _scale * _lobe.loss(t.wi) * t.wi.z;
        }
        // Per steradian. It takes a logarithm, so eval is spared it.
        REGAIN_HOST_DEVICE Real density(const Terms& t) const
        {
            const Real even =
                _lobe._missing.density(t.wi.z) * detail::constant<Real>(0.159154943091895335769);
            if (_lobe.axes().isotropic()) return even;
            return even * _lobe.axes().azimuths().relative_density(t.wi);
        }
        REGAIN_HOST_DEVICE Vec3<Real> at_some_azimuth(const Real& mu, const Real& u) const
        {
            if (!_lobe.axes().isotropic()) return _lobe.axes().azimuths().sample(mu, u);
            const Real sine = detail::sqrt((Real(1) - mu) * (Real(1) + mu));
            const Real phi = detail::constant<Real>(6.28318530717958647692) * u;
            return {sine * detail::cos(phi), sine * detail::sin(phi), mu};
        }

        MissingEnergyLobe _lobe;
        Mask _valid;
        Vec3<Real> _wo;
        Real _loss, _scale;  // 1 - E_ss(wo), that over pi (1 - E_avg)
        Color _weight;
    };

    REGAIN_HOST_DEVICE Prepared prepare(const Vec3<Real>& wo) const { return Prepared(*this, wo); }

private:
    REGAIN_HOST_DEVICE const DirectionAxes<Real>& axes() const { return _loss.axes(); }

    DirectionalLoss<Real> _loss;
    Color _tint;
    MissingEnergy<Real> _missing;
};

/// A MicrofacetReflection and its added lobe.
template <class LobeType>
class KullaConty
    : public ReflectionWithAddedLobe<LobeType, MissingEnergyLobe<typename LobeType::Real>>
{
public:
    using Lobe = LobeType;
    using Real = typename Lobe::Real;

    /// strength in [0, 1] scales the added lobe; clamped, NaN becomes 0. Without a table of E_ss
    /// there is no added lobe.
    REGAIN_HOST_DEVICE KullaConty(const Lobe& lobe, KullaContyForm form,
                                  const MicrofacetTables& tables, Real strength = Real(1))
        : ReflectionWithAddedLobe<Lobe, MissingEnergyLobe<Real>>(
              lobe, added(lobe, form, tables, detail::saturate(strength)), strength)
    {}

private:
    REGAIN_HOST_DEVICE static MissingEnergyLobe<Real> added(const Lobe& lobe, KullaContyForm form,
                                                            const MicrofacetTables& tables,
                                                            Real strength)
    {
        MissingEnergyLobe<Real> added(lobe.distribution(), tables);
        const Real E_avg = Real(1) - added.missing().average();
        added.set_tint(kulla_conty_tint(form, lobe.fresnel().average(), E_avg) * strength);
        return added;
    }
};

/// The lobe compensated by Kulla and Conty's added lobe, at strength s in [0, 1]. The tables serve
/// the added lobe and, unless the lobe has its own, its albedo.
template <class Lobe>
REGAIN_HOST_DEVICE KullaConty<Lobe> kulla_conty(
    Lobe lobe, KullaContyForm form, const MicrofacetTables& tables,
    typename Lobe::Real strength = typename Lobe::Real(1))
{
    if (!lobe.tables().has_albedo()) lobe.set_tables(tables);
    return {lobe, form, tables, strength};
}

REGAIN_NAMESPACE_END
