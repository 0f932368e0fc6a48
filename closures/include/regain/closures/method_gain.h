// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The compensation methods that are a gain on the closure weight:
///
///   gain(wo) = 1 + s F_ms (1 - E_ss(wo)) / E_ss(wo)              Turquin 2019, Eqs. 8 and 10
///
/// with the strength s in [0, 1] and, by method, the colour of the later bounces F_ms:
///
///   normalise      1                                               Eq. 9
///   turquin        F0                                              Eqs. 15, 16
///   turquin-eq12   E_avg / (1 - F_ss (1 - E_avg))                  Eq. 12
///   turquin-eq13   F_ss^(alpha sqrt(alpha))                        Eq. 13
///   turquin-eq14   F_ss                                            Eq. 14
///   series         F_ss E_avg / (1 - F_ss (1 - E_avg))             Eq. 7 inside Eq. 8: the series
///                                                                  that does not count the first
///                                                                  bounce twice (Hill 2018)
///
/// F_ms does not depend on a direction, so it is computed once, when the gain is built. A table may
/// hold albedos of 0, which count as 1e-12 where they are divided by.

#pragma once

#include <regain/closures/anisotropy.h>
#include <regain/closures/channels.h>
#include <regain/closures/gain.h>

#include <optional>
#include <string_view>

REGAIN_NAMESPACE_BEGIN

enum class Method { none, normalise, turquin, turquin_eq12, turquin_eq13, turquin_eq14, series };

constexpr Method all_methods[] = {Method::none,         Method::normalise,    Method::turquin,
                                  Method::turquin_eq12, Method::turquin_eq13, Method::turquin_eq14,
                                  Method::series};

/// The name on command lines and in documents.
constexpr std::string_view name(Method method)
{
    switch (method)
    {
        case Method::none: return "none";
        case Method::normalise: return "normalise";
        case Method::turquin: return "turquin";
        case Method::turquin_eq12: return "turquin-eq12";
        case Method::turquin_eq13: return "turquin-eq13";
        case Method::turquin_eq14: return "turquin-eq14";
        case Method::series: return "series";
    }
    return "";
}

/// The method of that name, or nothing.
constexpr std::optional<Method> method_named(std::string_view wanted)
{
    for (Method m : all_methods)
        if (name(m) == wanted) return m;
    return std::nullopt;
}

/// The gain of a method for a lobe of one alpha and Fresnel term. With a table missing that the
/// method needs, the gain is 1.
template <class RealType>
class MethodGain
{
public:
    using Real = RealType;
    using Color = Color3<Real>;

    /// `lobe` is a MicrofacetReflection; strength is clamped to [0, 1], NaN becomes 0.
    template <class Lobe>
    REGAIN_INLINE MethodGain(const Lobe& lobe, Method method, const MicrofacetTables& tables,
                             Real strength)
        : _tables(tables), _axes(lobe.distribution())
    {
        const bool needs_average = method == Method::turquin_eq12 || method == Method::series;
        _bound = method != Method::none && tables.has_albedo() &&
                 (tables.has_average_albedo() || !needs_average);
        if (!_bound) return;

        const auto& distribution = lobe.distribution();
        const Real s = detail::saturate(strength);
        const Real E_avg = needs_average ? tables.average_albedo(_axes) : Real(1);
        // A mirror loses nothing to later bounces.
        _F_ms = detail::channels(F_ms(method, lobe.fresnel(), E_avg)) *
                detail::select(distribution.is_delta(), Real(0), s);
        // Of two widths the tables know to one per cent, which is no promise.
        _preserves = detail::all<Real>(s == Real(1)) &&
                     detail::all<Real>(distribution.alpha_x() == distribution.alpha_y());
    }

    REGAIN_INLINE Color at(const Vec3<Real>& wo) const
    {
        if (!_bound) return Color(Real(1));
        REGAIN_COUNTED(gains);
        const Real E = _axes.albedo(_tables, {wo.x, wo.y, detail::saturate(wo.z)});
        return detail::color(Channels(Real(1)) +
                             _F_ms * ((Real(1) - E) / detail::max(E, least_albedo())));
    }

    /// Every method has F_ms = 1 where F = 1, so at full strength the albedo is 1 there; of an
    /// anisotropic lobe it is not promised.
    REGAIN_HOST_DEVICE bool energy_preserving() const { return _bound && _preserves; }

private:
    using Channels = detail::ChannelsOf<Real>;

    template <class Fresnel>
    REGAIN_HOST_DEVICE Color F_ms(Method method, const Fresnel& fresnel, Real E_avg) const
    {
        const Color one(Real(1));
        switch (method)
        {
            case Method::normalise: return one;
            case Method::turquin: return fresnel.normal_incidence();
            case Method::turquin_eq12:
                return detail::per_channel(fresnel.average(),
                                           [&](Real F_ss) { return E_avg / kept(F_ss, E_avg); });
            case Method::turquin_eq13:
                return detail::per_channel(fresnel.average(), [&](Real F_ss) {
                    // pow of 0 in a vector goes through log.
                    const Real alpha = _axes.alpha();
                    return detail::pow(detail::max(F_ss, detail::constant<Real>(1e-20)),
                                       alpha * detail::sqrt(alpha));
                });
            case Method::turquin_eq14: return fresnel.average();
            case Method::series:
                return detail::per_channel(
                    fresnel.average(), [&](Real F_ss) { return F_ss * E_avg / kept(F_ss, E_avg); });
            case Method::none: break;
        }
        return Color(Real(0));
    }

    // 1 - F_ss (1 - E_avg), which does not cancel where F_ss is 1.
    REGAIN_HOST_DEVICE static Real kept(Real F_ss, Real E_avg)
    {
        return detail::max(Real(1) - F_ss + F_ss * E_avg, least_albedo());
    }
    REGAIN_HOST_DEVICE static Real least_albedo() { return detail::constant<Real>(1e-12); }

    LossTables _tables;
    DirectionAxes<Real> _axes;
    Channels _F_ms = Channels(Real(0));
    bool _bound = false, _preserves = false;
};

REGAIN_NAMESPACE_END
