// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "method_prediction.h"

#include <algorithm>
#include <cmath>

REGAIN_NAMESPACE_BEGIN
namespace shaders::planning {
namespace {

// Of the difference between the numbers that one is read between, what the curve may bulge in their
// middle. By bench/plan_error.
constexpr double bulge = 0.25;

// What plastic's error is of its coat's: the diffuse base gives back half of what the coat lets by.
constexpr double coat_share = 0.5;

// Smaller numbers are those of a mirror, which loses nothing.
bool is_mirror(const MicrofacetMaterial& m) { return GGX<double>(m.alpha_x, m.alpha_y).is_delta(); }

struct Law
{
    DistributionKind kind;
    double gamma;
    bool own;  // not one that stands in at the gamma where both are the same
};

// A GTR of gamma 2 is GGX, and an STD of infinite gamma is Beckmann's. Empty where tails are longer
// than measured ones.
std::vector<Law> measured_laws(const MethodCosts& costs, const MicrofacetMaterial& m)
{
    if (!has_gamma(m.distribution)) return {{m.distribution, 2, true}};
    std::vector<Law> all;
    for (const double g : costs.gammas(m.distribution)) all.push_back({m.distribution, g, true});
    if (all.empty()) return {};
    if (m.distribution == DistributionKind::gtr) all.push_back({DistributionKind::ggx, 2, false});
    std::sort(all.begin(), all.end(), [](const Law& a, const Law& b) { return a.gamma < b.gamma; });
    const auto above = std::lower_bound(all.begin(), all.end(), m.gamma,
                                        [](const Law& a, double g) { return a.gamma < g; });
    if (above != all.end() && above->gamma == m.gamma) return {*above};
    if (above == all.begin()) return {};
    if (above != all.end()) return {*(above - 1), *above};
    if (m.distribution == DistributionKind::std)
        return {all.back(), {DistributionKind::beckmann, 2, false}};
    return {all.back()};
}

// Where x lies between numbers that rise.
struct Place
{
    std::size_t low = 0, high = 0;
    double fraction = 0;
};

Place place(const std::vector<double>& nodes, double x)
{
    const auto above = std::lower_bound(nodes.begin(), nodes.end(), x);
    if (above == nodes.begin()) return {};
    const std::size_t high = static_cast<std::size_t>(above - nodes.begin());
    if (above == nodes.end()) return {high - 1, high - 1, 0};
    return {high - 1, high, (x - nodes[high - 1]) / (nodes[high] - nodes[high - 1])};
}

double between(const std::vector<double>& values, const Place& p)
{
    return values[p.low] + (values[p.high] - values[p.low]) * p.fraction;
}

// 0 at both ends, 1 in the middle.
double middle(const Place& p) { return 4 * p.fraction * (1 - p.fraction); }

// Of widths below the least cosine that counts, 0.05, and below all that were measured. The light
// that is lost there is that of slopes beyond that cosine, whose share goes with a power of the
// width that the tail says; 6 is an upper bound for all distributions, by quadrature.
double of_narrower(const MethodCost& cost, double alpha)
{
    const double x = alpha / 0.05;
    if (x >= 1 || alpha >= cost.alpha.front()) return 1;
    const double power =
        has_gamma(cost.distribution) ? std::clamp(2 * (cost.gamma - 1), 0.0, 2.0) : 2;
    return std::min(1.0, 6 * std::pow(x, power));
}

double error_at(const MethodCost& cost, double alpha, double x)
{
    const Place a = place(cost.alpha, alpha), b = place(cost.axis, x);
    const auto along = [&](const std::vector<double>& row) { return between(row, b); };
    const double low = along(cost.error[a.low]), high = along(cost.error[a.high]);
    const auto at = [&](std::size_t i) {
        return cost.error[a.low][i] + (cost.error[a.high][i] - cost.error[a.low][i]) * a.fraction;
    };
    const double value =
        low + (high - low) * a.fraction +
        bulge * (middle(a) * std::abs(high - low) + middle(b) * std::abs(at(b.high) - at(b.low)));
    // Noise makes the largest of several numbers larger, so it is in there already in part.
    return std::hypot(value, 2 * cost.noise) * of_narrower(cost, alpha);
}

double worst_at(const MethodCost& cost, double alpha)
{
    double worst = 0;
    for (const double x : cost.axis) worst = std::max(worst, error_at(cost, alpha, x));
    return worst;
}

double wide_alpha(const MicrofacetMaterial& m) { return std::max(m.alpha_x, m.alpha_y); }

// Directions along and across the grooves see different widths, and all between them.
std::vector<double> seen_alphas(const MethodCost& cost, const MicrofacetMaterial& m)
{
    const double narrow = std::min(m.alpha_x, m.alpha_y), wide = wide_alpha(m);
    std::vector<double> all{wide};
    if (narrow == wide) return all;
    all.push_back(narrow);
    for (const double a : cost.alpha)
        if (a > narrow && a < wide) all.push_back(a);
    return all;
}

// The worst of them.
double error_at(const MethodCost& cost, const MicrofacetMaterial& m, double x)
{
    double worst = 0;
    for (const double alpha : seen_alphas(cost, m))
        worst = std::max(worst, error_at(cost, alpha, x));
    return worst;
}

// What tables leave of two widths besides: the white furnaces of docs/methods.md. Single scattering
// needs none, and the walk knows all.
double of_two_widths(const MicrofacetMaterial& m, const Compensation& method, double lost)
{
    if (m.alpha_x == m.alpha_y || name(method) == "none" ||
        std::holds_alternative<RandomWalk>(method))
        return 0;
    const double most = has_gamma(m.distribution) ? 0.01 : 0.003;
    return std::min(most, lost);
}

class Predictor
{
public:
    Predictor(const MethodCosts& costs, const MicrofacetMaterial& m, const Compensation& method)
        : _costs(costs), _m(m), _method(method)
    {}

    std::optional<Prediction> operator()(const SheenSurface&)
    {
        // There is nothing to compensate.
        if (name(_method) != "none") return std::nullopt;
        return Prediction{};
    }
    std::optional<Prediction> operator()(const SchlickSurface& s)
    {
        const bool plain = s.F82 == ColorD(1.0) && s.F90 == ColorD(1.0) && s.exponent == 5;
        return reflection(!plain);
    }
    std::optional<Prediction> operator()(const ConductorSurface&) { return reflection(true); }
    std::optional<Prediction> operator()(const InterfaceSurface& s)
    {
        if (s.thin_walled || s.mode == ScatterMode::T || !(s.eta > 0)) return std::nullopt;
        return s.mode == ScatterMode::R ? coat(s) : glass(s);
    }

private:
    std::optional<Prediction> reflection(bool coloured)
    {
        const ColorD F0 = normal_reflectance(_m);
        return over_laws([&](const Law& law) {
            return add(CostClass::metal, law, [&](const MethodCost& cost) {
                double more = 0;
                if (coloured) more = of_colour(law, cost);
                ColorD e;
                for (int c = 0; c < 3; ++c) e[c] = error_at(cost, _m, F0[c]) + more;
                return e;
            });
        });
    }
    // What n and k or an edge tint err by, beyond greys of any F0.
    double of_colour(const Law& law, const MethodCost& grey) const
    {
        const MethodCost* cost =
            _costs.find(CostClass::coloured_metal, law.kind, law.gamma, _method);
        if (!cost) return 0;
        return std::max(0.0, worst_at(*cost, wide_alpha(_m)) - worst_at(grey, wide_alpha(_m)));
    }
    std::optional<Prediction> coat(const InterfaceSurface& s)
    {
        // Total reflection was not measured.
        if (s.eta < 1) return std::nullopt;
        return over_laws([&](const Law& law) {
            return add(CostClass::plastic, law, [&](const MethodCost& cost) {
                return s.reflection_tint * (error_at(cost, _m, s.eta) / coat_share);
            });
        });
    }
    // Either side may be seen.
    std::optional<Prediction> glass(const InterfaceSurface& s)
    {
        const double eta = std::max(s.eta, 1 / s.eta);
        ColorD tint;
        for (int c = 0; c < 3; ++c)
            tint[c] = std::max(s.reflection_tint[c], s.transmission_tint[c]);
        const auto of = [&](const MethodCost& cost) { return tint * error_at(cost, _m, eta); };
        return over_laws([&](const Law& law) {
            const MethodCost* cost = find(CostClass::glass_inside, law);
            if (cost && eta < cost->axis.front()) return false;
            return add(CostClass::glass_outside, law, of) && add(CostClass::glass_inside, law, of);
        });
    }

    const MethodCost* find(CostClass kind, const Law& law) const
    {
        return _costs.find(kind, law.kind, law.gamma, _method);
    }
    // The worse of all that is added.
    template <class Error>
    bool add(CostClass kind, const Law& law, const Error& error)
    {
        const MethodCost* cost = find(kind, law);
        if (!cost) return !law.own;
        const ColorD e = error(*cost);
        for (int c = 0; c < 3; ++c) _sum.error[c] = std::max(_sum.error[c], e[c]);
        const Place a = place(cost->alpha, wide_alpha(_m));
        _sum.eval = std::max(_sum.eval, between(cost->eval, a));
        _sum.sample = std::max(_sum.sample, between(cost->sample, a));
        _any = true;
        return true;
    }
    template <class Add>
    std::optional<Prediction> over_laws(const Add& add_law)
    {
        for (const Law& law : measured_laws(_costs, _m))
            if (!add_law(law)) return std::nullopt;
        if (!_any) return std::nullopt;
        return _sum;
    }

    const MethodCosts& _costs;
    const MicrofacetMaterial& _m;
    const Compensation& _method;
    Prediction _sum;
    bool _any = false;
};

std::optional<Prediction> isotropic_prediction(const MethodCosts& costs,
                                               const MicrofacetMaterial& m,
                                               const Compensation& method)
{
    return std::visit(Predictor(costs, m, method), m.surface);
}

}  // namespace

ColorD normal_reflectance(const MicrofacetMaterial& m)
{
    if (const auto* s = std::get_if<SchlickSurface>(&m.surface)) return s->F0;
    if (const auto* s = std::get_if<ConductorSurface>(&m.surface))
    {
        ColorD F0;
        for (int c = 0; c < 3; ++c)
        {
            const double below = s->n[c] - 1, above = s->n[c] + 1, k2 = s->k[c] * s->k[c];
            F0[c] = (below * below + k2) / (above * above + k2);
        }
        return F0;
    }
    if (const auto* s = std::get_if<InterfaceSurface>(&m.surface))
        return s->reflection_tint * std::pow((s->eta - 1) / (s->eta + 1), 2);
    return std::get<SheenSurface>(m.surface).color;
}

std::optional<Prediction> predicted(const MethodCosts& costs, const MicrofacetMaterial& m,
                                    const Compensation& method)
{
    auto p = isotropic_prediction(costs, m, method);
    // That needs no measurement.
    if (!p && is_mirror(m) && name(method) == "none") p = Prediction{ColorD(0.0), 1, 1};
    if (!p) return p;
    const auto* walk = std::get_if<RandomWalk>(&method);
    // The reference, whose error in the file is the noise of the measurement.
    if ((walk && !walk->bounded) || is_mirror(m)) p->error = ColorD(0.0);
    if (const auto bare = isotropic_prediction(costs, m, Method::none); bare && !is_mirror(m))
        p->error += ColorD(of_two_widths(m, method, largest(bare->error)));
    return p;
}

std::vector<Compensation> predictable_methods(const MethodCosts& costs, const MicrofacetMaterial& m)
{
    std::vector<Compensation> all;
    for (const std::string_view n : compensation_names())
    {
        const Compensation method = *compensation_named(n);
        // An effect of its own, kept for comparison.
        if (std::holds_alternative<BurleySheen>(method)) continue;
        if (predicted(costs, m, method)) all.push_back(method);
    }
    return all;
}

}  // namespace shaders::planning
REGAIN_NAMESPACE_END
