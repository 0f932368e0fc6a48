// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What an adapter asks of any material and of any closure, beyond what closure.h lists.
///
/// A material answers one of
///
///     template <class Real> auto closure(Real strength) const
///     template <class Real, class Visit>
///     decltype(auto) with_closure(Real strength, const Visit& visit) const    visit(closure)
///
/// the second where the type of the closure is known only at run time. with_closure() below calls
/// either. A material of several closures answers
///
///     int lobes() const
///     template <class Real, class Visit>
///     decltype(auto) with_lobe(int k, Real strength, const Visit& visit) const
///     template <class Real>
///     Color3<Real> lobe_weights(const Color3<Real>* albedo, Color3<Real>* weight) const
///     const char* lobe_name(int k) const
///
/// weight[k] being what closure k is multiplied by at a direction where `albedo` holds the
/// directional albedos of all; it returns the albedo of the whole. lobe_count() and so on below
/// ask a material of one closure the same.
///
/// A material that is not there everywhere answers `presence() const`, in [0, 1]: the share of the
/// surface that is. It is no part of any closure and changes nothing of what they scatter; light
/// goes by the rest unchanged. presence_of() below asks any material.
///
/// A closure is asked for
///
///     distribution()    its microfacets, where it has some
///     eta()             where it is an interface between two media: index on the -z side over
///                       index on the +z side; not asked where thin_walled is a static constant
///     lobe()            a closure inside it, which is asked in its place
///     first(), second() the closures it is the sum of
///
/// and where it has none of these, the answer is the one of a surface without them.

#pragma once

#include <regain/closures/closure.h>
#include <regain/closures/compensated.h>
#include <regain/closures/sum.h>

REGAIN_NAMESPACE_BEGIN

namespace detail {

template <class Closure, class = void>
struct HasDistribution : std::false_type
{};
template <class Closure>
struct HasDistribution<Closure,
                       std::void_t<decltype(std::declval<const Closure&>().distribution())>>
    : std::true_type
{};

template <class Closure, class = void>
struct HasEta : std::false_type
{};
template <class Closure>
struct HasEta<Closure, std::void_t<decltype(std::declval<const Closure&>().eta())>> : std::true_type
{};

template <class Closure, class = void>
struct IsThinWalled : std::false_type
{};
template <class Closure>
struct IsThinWalled<Closure, std::void_t<decltype(Closure::thin_walled)>> : std::true_type
{};

template <class Closure, class = void>
struct IsDiffuse : std::false_type
{};
template <class Closure>
struct IsDiffuse<Closure, std::void_t<decltype(Closure::is_diffuse)>>
    : std::bool_constant<Closure::is_diffuse>
{};

template <class Closure, class = void>
struct PassesStraight : std::false_type
{};
template <class Closure>
struct PassesStraight<Closure, std::void_t<decltype(Closure::passes_straight)>>
    : std::bool_constant<Closure::passes_straight>
{};

template <class Closure, class = void>
struct HasLobe : std::false_type
{};
template <class Closure>
struct HasLobe<Closure, std::void_t<decltype(std::declval<const Closure&>().lobe())>>
    : std::true_type
{};

template <class Closure, class = void>
struct IsSum : std::false_type
{};
template <class Closure>
struct IsSum<Closure, std::void_t<decltype(std::declval<const Closure&>().first()),
                                  decltype(std::declval<const Closure&>().second())>>
    : std::true_type
{};

template <class Material, class Real, class Visit, class = void>
struct ChoosesClosure : std::false_type
{};
template <class Material, class Real, class Visit>
struct ChoosesClosure<Material, Real, Visit,
                      std::void_t<decltype(std::declval<const Material&>().with_closure(
                          std::declval<Real>(), std::declval<const Visit&>()))>> : std::true_type
{};

}  // namespace detail

/// visit(closure) with the closure of the material; strength of the compensation in [0, 1]. Visit
/// answers the same type for every closure.
template <class Material, class Real, class Visit>
decltype(auto) with_closure(const Material& material, Real strength, const Visit& visit)
{
    if constexpr (detail::ChoosesClosure<Material, Real, Visit>::value)
        return material.with_closure(strength, visit);
    else
        return visit(material.closure(strength));
}

namespace detail {

template <class Material, class = void>
struct HasLobes : std::false_type
{};
template <class Material>
struct HasLobes<Material, std::void_t<decltype(std::declval<const Material&>().lobes())>>
    : std::true_type
{};

}  // namespace detail

template <class Material>
int lobe_count([[maybe_unused]] const Material& material)
{
    if constexpr (detail::HasLobes<Material>::value)
        return material.lobes();
    else
        return 1;
}

template <class Material>
const char* lobe_name(const Material& material, [[maybe_unused]] int k)
{
    if constexpr (detail::HasLobes<Material>::value)
        return material.lobe_name(k);
    else
        return material.lobe_name();
}

template <class Material, class Real, class Visit>
decltype(auto) with_lobe(const Material& material, [[maybe_unused]] int k, Real strength,
                         const Visit& visit)
{
    if constexpr (detail::HasLobes<Material>::value)
        return material.with_lobe(k, strength, visit);
    else
        return with_closure(material, strength, visit);
}

/// Weights as they are used: in [0, 1e6] per channel, and 0 where a material's own is no number, so
/// that whatever comes of a texture leaves a closure out and not a point.
template <class Material, class Real>
Color3<Real> lobe_weights([[maybe_unused]] const Material& material, const Color3<Real>* albedo,
                          Color3<Real>* weight)
{
    const auto clean = [](const Color3<Real>& c) {
        return detail::per_channel(c, [](Real v) { return detail::sanitised(v, 0, 1e6, 0); });
    };
    if constexpr (detail::HasLobes<Material>::value)
    {
        Color3<Real> whole(Real(0));
        material.lobe_weights(albedo, weight);
        for (int k = 0; k < material.lobes(); ++k)
        {
            weight[k] = clean(weight[k]);
            whole += weight[k] * albedo[k];
        }
        return whole;
    }
    else
    {
        weight[0] = Color3<Real>(Real(1));
        return albedo[0];
    }
}

namespace detail {

template <class Material, class = void>
struct HasPresence : std::false_type
{};
template <class Material>
struct HasPresence<Material, std::void_t<decltype(std::declval<const Material&>().presence())>>
    : std::true_type
{};

}  // namespace detail

/// Clamped; 1 of a material that says nothing, or no number.
template <class Real, class Material>
Real presence_of([[maybe_unused]] const Material& material)
{
    if constexpr (detail::HasPresence<Material>::value)
        return detail::sanitised(static_cast<Real>(material.presence()), 0, 1, 1);
    else
        return Real(1);
}

/// Index on the -z side over index on the +z side; 1 where one medium is on both.
template <class Closure>
REGAIN_HOST_DEVICE typename Closure::Real relative_index(const Closure& closure)
{
    if constexpr (detail::HasEta<Closure>::value && !detail::IsThinWalled<Closure>::value)
        return closure.eta();
    else if constexpr (detail::HasLobe<Closure>::value)
        return relative_index(closure.lobe());
    else if constexpr (detail::IsSum<Closure>::value)
        return relative_index(closure.first());
    else
        return typename Closure::Real(1);
}

/// The two sides of the surface are told apart: the closure answers for wo of either sign, and is
/// not to be turned towards the viewer.
template <class Closure>
REGAIN_HOST_DEVICE bool is_interface(const Closure& closure)
{
    return closure.traits().transmissive || relative_index(closure) != typename Closure::Real(1);
}

/// (n_o / n_i)^2, n_o being the index on the side of wo and n_i on that of wi: what turns a
/// transmitted energy into a transmitted radiance. 1 for a wi on the side of wo.
template <class Closure, class Real = typename Closure::Real>
REGAIN_HOST_DEVICE Real radiance_factor(const Closure& closure, const Vec3<Real>& wo,
                                        const Vec3<Real>& wi)
{
    if ((wo.z < 0) == (wi.z < 0)) return Real(1);
    const Real eta = relative_index(closure);
    const Real ratio = wo.z < 0 ? eta : Real(1) / eta;
    return ratio * ratio;
}

/// The wider of the two microfacet widths; 1 for a closure without microfacets.
template <class Closure>
REGAIN_HOST_DEVICE typename Closure::Real widest_alpha(const Closure& closure)
{
    if constexpr (detail::HasDistribution<Closure>::value)
        return detail::max(closure.distribution().alpha_x(), closure.distribution().alpha_y());
    else if constexpr (detail::HasLobe<Closure>::value)
        return widest_alpha(closure.lobe());
    else if constexpr (detail::IsSum<Closure>::value)
        return detail::max(widest_alpha(closure.first()), widest_alpha(closure.second()));
    else
        return typename Closure::Real(1);
}

/// What light path expressions call diffuse.
template <class Closure>
REGAIN_HOST_DEVICE constexpr bool is_diffuse(const Closure& closure)
{
    if constexpr (detail::HasLobe<Closure>::value)
        return is_diffuse(closure.lobe());
    else
        return detail::IsDiffuse<Closure>::value;
}

/// Light goes straight on, as if there were no surface.
template <class Closure>
REGAIN_HOST_DEVICE constexpr bool passes_straight(const Closure& closure)
{
    if constexpr (detail::HasLobe<Closure>::value)
        return passes_straight(closure.lobe());
    else
        return detail::PassesStraight<Closure>::value;
}

/// All that it scatters has no density: a mirror, smooth glass. A closure for which only
/// traits().delta holds may return both kinds of direction.
template <class Closure>
REGAIN_HOST_DEVICE bool is_delta(const Closure& closure)
{
    if constexpr (detail::PassesStraight<Closure>::value)
        return true;
    else if constexpr (detail::HasDistribution<Closure>::value)
        return closure.traits().delta && closure.distribution().is_delta();
    else if constexpr (detail::HasLobe<Closure>::value)
        return is_delta(closure.lobe());
    else if constexpr (detail::IsSum<Closure>::value)
        return is_delta(closure.first()) && is_delta(closure.second());
    else
        return false;
}

/// The density that hosts are told where a pdf that is not exact is 0 and the value is not: they
/// divide by it.
constexpr double least_pdf = 1e-12;

/// The closure for a path that carries importance: what eval and sample say is then what the eye
/// sees from wi. A gain that is not reciprocal is taken at the other end; all else is reciprocal.
template <class Closure>
REGAIN_HOST_DEVICE const Closure& for_light_path(const Closure& closure)
{
    return closure;
}
template <class First, class Second>
REGAIN_HOST_DEVICE auto for_light_path(const Sum<First, Second>& closure);
template <class Lobe, class Gain>
REGAIN_HOST_DEVICE auto for_light_path(const Compensated<Lobe, Gain>& closure)
{
    const auto lobe = for_light_path(closure.lobe());
    return reversed(compensated(lobe, closure.gain()));
}
template <class First, class Second>
REGAIN_HOST_DEVICE auto for_light_path(const Sum<First, Second>& closure)
{
    return sum(for_light_path(closure.first()), for_light_path(closure.second()));
}

REGAIN_NAMESPACE_END
