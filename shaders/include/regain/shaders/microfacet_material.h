// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A material whose lobe, distribution and method of compensation are chosen at run time, by name:
///
///     MicrofacetMaterial m;
///     m.surface = InterfaceSurface{1.5};
///     m.distribution = DistributionKind::beckmann;
///     m.alpha_x = m.alpha_y = 0.4;
///     m.method = *compensation_named("turquin");
///     m.bind_tables();                             // throws where there is no such combination
///     m.with_closure(1.0f, [](const auto& closure) { ... });
///
/// with_closure calls with one of many types of closures, all of which are then compiled: keep what
/// it is given small, and in a file of its own. Where time to compile counts, with_closure_of<GGX>
/// and so on take one distribution.
///
/// Parameters are in double, so that closures of any precision can be made of them.

#pragma once

#include <regain/closures/balanced_gain.h>
#include <regain/closures/beckmann.h>
#include <regain/closures/bounded_dielectric_walk.h>
#include <regain/closures/bounded_walk.h>
#include <regain/closures/conductor_fresnel.h>
#include <regain/closures/dielectric_gain.h>
#include <regain/closures/dielectric_kulla_conty.h>
#include <regain/closures/dielectric_tail.h>
#include <regain/closures/dielectric_walk.h>
#include <regain/closures/directional_gain.h>
#include <regain/closures/fitted_tail.h>
#include <regain/closures/ggx.h>
#include <regain/closures/gtr.h>
#include <regain/closures/kulla_conty.h>
#include <regain/closures/method_gain.h>
#include <regain/closures/microfacet_reflection.h>
#include <regain/closures/schlick_fresnel.h>
#include <regain/closures/sheen.h>
#include <regain/closures/std.h>
#include <regain/closures/thin_dielectric.h>
#include <regain/closures/walk.h>
#include <regain/shaders/export.h>
#include <regain/shaders/material.h>
#include <regain/shaders/plain_material.h>

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

REGAIN_NAMESPACE_BEGIN
namespace shaders {

/// MaterialX's generalized_schlick_bsdf, scatter mode R. Colours linear, in [0, 1].
struct SchlickSurface
{
    ColorD F0{1.0}, F82{1.0}, F90{1.0};
    double exponent = 5;
};

/// MaterialX's conductor_bsdf: n + ik per channel; no colours. The default is MaterialX's, gold.
struct ConductorSurface
{
    ColorD n{0.183, 0.421, 1.373}, k{3.424, 2.346, 1.770};
};

/// MaterialX's dielectric_bsdf. eta: index inside over index outside.
struct InterfaceSurface
{
    double eta = 1.5;
    ScatterMode mode = ScatterMode::RT;
    TransmissionShadowing shadowing = TransmissionShadowing::correlated;
    bool thin_walled = false;       ///< a sheet: eta is its index over that around it
    ColorD reflection_tint{1.0};    ///< of what is reflected, in [0, 1]
    ColorD transmission_tint{1.0};  ///< of what is transmitted, in [0, 1]
};

/// Burley's sheen alone: it has no microfacets. color: linear; weight in [0, 1].
struct SheenSurface
{
    ColorD color{1.0};
    double weight = 1;
};

enum class DistributionKind { ggx, beckmann, gtr, std };
constexpr DistributionKind all_distributions[] = {DistributionKind::ggx, DistributionKind::beckmann,
                                                  DistributionKind::gtr, DistributionKind::std};

/// The name on command lines and in documents; and back.
REGAIN_SHADERS_API std::string_view name(DistributionKind);
REGAIN_SHADERS_API std::optional<DistributionKind> distribution_named(std::string_view);

/// Whether the distribution has a tail parameter gamma.
constexpr bool has_gamma(DistributionKind d)
{
    return d == DistributionKind::gtr || d == DistributionKind::std;
}

/// The random walk that replaces the lobe, at any strength but 0; walks that one eval takes.
/// `bounded`: that of bounded_walk.h, which meets a number of facets at most.
struct RandomWalk
{
    int eval_samples = 1;
    bool bounded = false;
};

/// The gain whose colour depends on the direction.
struct Directional
{};

/// The gain of both directions, reciprocal and without loss.
struct Balanced
{};

/// The added lobe with the walk's shape.
struct Tail
{};

/// Burley's 2015 addition to a lobe that is not compensated.
struct BurleySheen
{};

/// Any method of compensation: a gain, an added lobe, a walk, a glow.
using Compensation =
    std::variant<Method, Directional, Balanced, KullaContyForm, Tail, RandomWalk, BurleySheen>;

REGAIN_SHADERS_API std::string_view name(const Compensation&);
REGAIN_SHADERS_API std::optional<Compensation> compensation_named(std::string_view);
REGAIN_SHADERS_API const std::vector<std::string_view>& compensation_names();

/// What docs/methods.md recommends for want of a reason to take another: `directional` of what
/// reflects; of an interface `tail`, and `turquin` where that does not go with it.
REGAIN_SHADERS_API Compensation recommended_compensation(
    const std::variant<SchlickSurface, ConductorSurface, InterfaceSurface, SheenSurface>& surface);

class MicrofacetMaterial
{
public:
    std::variant<SchlickSurface, ConductorSurface, InterfaceSurface, SheenSurface> surface;
    DistributionKind distribution = DistributionKind::ggx;
    double gamma = 2;                       ///< of gtr and std
    double alpha_x = 0.05, alpha_y = 0.05;  ///< microfacet widths in [0, 1]
    Compensation method = Method::turquin;  ///< which goes with all but sheen

    MicrofacetMaterial() = default;
    REGAIN_SHADERS_API MicrofacetMaterial(const SchlickMetal&);

    bool is_interface() const { return std::holds_alternative<InterfaceSurface>(surface); }

    /// Looks up the tables that the closure needs; call it again after a change. `for_albedo`:
    /// those, too, without which nothing is wrong but albedo() integrates. Throws
    /// std::invalid_argument, which says what is wrong and what there is, where the library has no
    /// such combination, and std::runtime_error where a table is missing.
    REGAIN_SHADERS_API void bind_tables(bool for_albedo = false);

    /// visit(closure); strength of the compensation in [0, 1]. Visit answers one type.
    template <class Real, class Visit>
    decltype(auto) with_closure(Real strength, const Visit& visit) const
    {
        switch (distribution)
        {
            case DistributionKind::beckmann: return with_closure_of<Beckmann>(strength, visit);
            case DistributionKind::gtr: return with_closure_of<GTR>(strength, visit);
            case DistributionKind::std: return with_closure_of<STD>(strength, visit);
            case DistributionKind::ggx: break;
        }
        return with_closure_of<GGX>(strength, visit);
    }

    /// The same, if the distribution is this one.
    template <template <class> class Distribution, class Real, class Visit>
    decltype(auto) with_closure_of(Real strength, const Visit& visit) const
    {
        REGAIN_COUNTED(closures);
        const auto distribution_of = [this] {
            using D = Distribution<Real>;
            if constexpr (D::has_tail)
                return D(Real(alpha_x), Real(alpha_y), Real(gamma));
            else
                return D(Real(alpha_x), Real(alpha_y));
        };
        using Color = Color3<Real>;
        if (const auto* s = std::get_if<SheenSurface>(&surface))
            return visit(Sheen<Real>(Real(s->weight), Color(s->color)));
        const auto d = distribution_of();
        if (const auto* i = std::get_if<InterfaceSurface>(&surface))
        {
            const Real eta = Real(i->eta);
            const Color reflected(i->reflection_tint), transmitted(i->transmission_tint);
            if (i->thin_walled)
                return visit(
                    compensated(ThinDielectric(d, eta, i->mode, reflected, transmitted, _tables),
                                gain_method(), _tables, strength));
            const auto* walk = random_walk(strength);
            if (walk && walk->bounded)
                return visit(BoundedDielectricWalk(d, eta, reflected, transmitted,
                                                   walk->eval_samples, _interface_tables, _tables));
            if (walk)
                return visit(DielectricWalk(d, eta, reflected, transmitted, walk->eval_samples));
            const auto lobe = [&] {
                return Dielectric(d, eta, i->mode, reflected, transmitted, i->shadowing,
                                  _interface_tables);
            };
            if (std::holds_alternative<KullaContyForm>(method))
                return visit(kulla_conty(lobe(), _interface_tables, strength));
            if (std::holds_alternative<Tail>(method))
                return visit(fitted_tail(lobe(), _interface_tables, strength));
            return visit(
                build_compensated(lobe, gain_method(), _interface_tables, _tables, strength));
        }
        if (const auto* c = std::get_if<ConductorSurface>(&surface))
            return with_reflection(
                [&] {
                    return MicrofacetReflection(d, ConductorFresnel<Real>(Color(c->n), Color(c->k)),
                                                _tables);
                },
                strength, visit);
        const auto& s = *std::get_if<SchlickSurface>(&surface);
        return with_reflection(
            [&] {
                return MicrofacetReflection(
                    d,
                    SchlickFresnel<Real>(Color(s.F0), Color(s.F82), Color(s.F90), Real(s.exponent)),
                    _tables);
            },
            strength, visit);
    }

    /// What bind_tables bound.
    const MicrofacetTables& tables() const { return _tables; }
    const DielectricTables& interface_tables() const { return _interface_tables; }

    const char* lobe_name() const
    {
        return is_interface()                                  ? "glass"
               : std::holds_alternative<SheenSurface>(surface) ? "sheen"
                                                               : "metal";
    }

private:
    // make() is the lobe, which has the tables.
    template <class MakeLobe, class Real, class Visit>
    decltype(auto) with_reflection(const MakeLobe& make, Real strength, const Visit& visit) const
    {
        if (std::holds_alternative<Directional>(method))
            return visit(build_directional(make, _tables, strength));
        if (std::holds_alternative<Balanced>(method))
            return visit(build_balanced(make, _tables, strength));
        if (const auto* form = std::get_if<KullaContyForm>(&method))
            return visit(kulla_conty(make(), *form, _tables, strength));
        if (std::holds_alternative<Tail>(method))
            return visit(fitted_tail(make(), _tables, strength));
        const auto* walk = random_walk(strength);
        if (walk)
        {
            const auto lobe = make();
            if (walk->bounded)
                return visit(
                    BoundedWalk(lobe.distribution(), lobe.fresnel(), walk->eval_samples, _tables));
            return visit(Walk(lobe.distribution(), lobe.fresnel(), walk->eval_samples, _tables));
        }
        if (std::holds_alternative<BurleySheen>(method))
            return visit(burley_sheen(make(), strength));
        return visit(build_compensated(make, gain_method(), _tables, strength));
    }

    // A lobe cannot be replaced by a part.
    template <class Real>
    const RandomWalk* random_walk(Real strength) const
    {
        return detail::any<Real>(strength > Real(0)) ? std::get_if<RandomWalk>(&method) : nullptr;
    }
    Method gain_method() const
    {
        const auto* gain = std::get_if<Method>(&method);
        return gain ? *gain : Method::none;
    }

    MicrofacetTables _tables;
    DielectricTables _interface_tables;
};

}  // namespace shaders
REGAIN_NAMESPACE_END
