// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "plan_check.h"

#include "closures_by_distribution.h"
#include "figures/measures.h"
#include "measured_albedo.h"
#include "plan_report.h"
#include "random_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace regain::tools {
namespace {

using namespace shaders;

// What is seen along one direction.
struct Seen
{
    ColorD reflect{0.0}, transmit{0.0};
    double noise = 0;

    Seen operator*(double w) const { return {reflect * w, transmit * w, noise * w}; }
    Seen operator+(const Seen& s) const
    {
        return {reflect + s.reflect, transmit + s.transmit, std::hypot(noise, s.noise)};
    }
};

struct Closure
{
    std::unique_ptr<AnyClosure> closure;
    ClosureSpec spec;  // what integrating it needs to know
};

Closure closure_of(MicrofacetMaterial m)
{
    m.bind_tables();
    ClosureSpec spec;
    spec.alpha_x = m.alpha_x;
    spec.alpha_y = m.alpha_y;
    spec.method = m.method;
    if (const auto* i = std::get_if<InterfaceSurface>(&m.surface))
    {
        spec.lobe = Lobe::dielectric;
        spec.interface = *i;
    }
    switch (m.distribution)
    {
        case DistributionKind::beckmann: return {make_beckmann_closure(m, spec), spec};
        case DistributionKind::gtr: return {make_gtr_closure(m, spec), spec};
        case DistributionKind::std: return {make_std_closure(m, spec), spec};
        case DistributionKind::ggx: break;
    }
    return {make_ggx_closure(m, spec), spec};
}

// Mean and noise of one side.
class Mean
{
public:
    void add(const ColorD& weight)
    {
        const double w = std::max({weight.x, weight.y, weight.z});
        _sum += weight;
        _largest += w;
        _squares += w * w;
    }
    ColorD of(double n) const { return _sum / n; }
    double noise(double n) const
    {
        const double mean = _largest / n;
        return std::sqrt(std::max(0.0, _squares / n - mean * mean) / n);
    }

private:
    ColorD _sum{0.0};
    double _largest = 0, _squares = 0;
};

Seen seen_along(Closure& c, const Imath::V3d& wo, std::uint64_t samples, std::uint64_t seed)
{
    if (default_albedo_method(c.spec) == AlbedoMethod::quadrature)
    {
        const MeasuredAlbedo a = measured_albedo(*c.closure, c.spec, wo, {});
        return {a.reflect, a.transmit, a.error.value_or(0)};
    }
    RandomNumbers random(seed);
    const double x = random.next<double>(), y = random.next<double>(), z = random.next<double>();
    c.closure->prepare(wo);
    Mean reflect, transmit;
    for (std::uint64_t i = 0; i < samples; ++i)
    {
        const Sample<double> s = c.closure->sample(figures::lattice_point(i, {x, y, z}));
        if (s.valid) (s.transmitted ? transmit : reflect).add(s.weight);
    }
    const double n = static_cast<double>(samples);
    return {reflect.of(n), transmit.of(n), std::max(reflect.noise(n), transmit.noise(n))};
}

// The walk's own, of the same surface.
MicrofacetMaterial reference_of(MicrofacetMaterial m)
{
    m.method = RandomWalk{};
    auto* interface = std::get_if<InterfaceSurface>(&m.surface);
    if (!interface) return m;
    interface->shadowing = TransmissionShadowing::beta;
    // Facets that reflect as an interface does and let the rest through.
    if (interface->mode == ScatterMode::R)
        m.surface = ConductorSurface{ColorD(interface->eta), ColorD(0.0)};
    return m;
}

class Drawer
{
public:
    explicit Drawer(std::uint32_t seed) : _random(seed) {}

    double between(double a, double b) { return a + (b - a) * _random.next<double>(); }
    double logarithmic(double a, double b) { return std::exp(between(std::log(a), std::log(b))); }
    bool chance(double p) { return _random.next<double>() < p; }
    ColorD color(double a, double b) { return {between(a, b), between(a, b), between(a, b)}; }

    MicrofacetMaterial widths()
    {
        MicrofacetMaterial m;
        m.distribution = all_distributions[static_cast<std::size_t>(between(0, 4))];
        if (m.distribution == DistributionKind::gtr) m.gamma = between(1.5, 4);
        if (m.distribution == DistributionKind::std) m.gamma = logarithmic(1.6, 10);
        m.alpha_x = m.alpha_y = logarithmic(0.02, 1);
        if (chance(0.25)) m.alpha_y /= logarithmic(1, 10);
        return m;
    }
    MicrofacetMaterial metal()
    {
        MicrofacetMaterial m = widths();
        if (chance(0.5))
            m.surface = ConductorSurface{color(0.1, 3), color(1, 6)};
        else
            m.surface = SchlickSurface{color(0.02, 1), chance(0.5) ? ColorD(1.0) : color(0.6, 1)};
        return m;
    }
    MicrofacetMaterial interface(ScatterMode mode)
    {
        MicrofacetMaterial m = widths();
        const double eta = between(1.1, 2.2);
        InterfaceSurface s;
        s.eta = mode == ScatterMode::RT && chance(0.3) ? 1 / eta : eta;
        s.mode = mode;
        m.surface = s;
        return m;
    }

private:
    RandomNumbers _random;
};

// A tree of one closure or two, whose albedo is put together here by itself.
class Subject
{
public:
    explicit Subject(Drawer& draw)
    {
        const double kind = draw.between(0, 1);
        if (kind < 0.4)
            _parts = {draw.metal()}, _words = "metal";
        else if (kind < 0.65)
            _parts = {draw.interface(ScatterMode::RT)}, _words = "glass";
        else if (kind < 0.85)
        {
            _parts = {draw.interface(ScatterMode::R)};
            _base = draw.between(0, 1), _words = "plastic";
        }
        else
        {
            _parts = {draw.metal(), draw.metal()};
            _amount = draw.between(0.05, 0.95), _words = "mix";
        }
        for (const MicrofacetMaterial& m : _parts)
            _words += fmt::format(" {} {:.3g} alpha {:.3g} {:.3g}", name(m.distribution),
                                  has_gamma(m.distribution) ? m.gamma : 0, m.alpha_x, m.alpha_y);
    }

    const std::string& words() const { return _words; }

    VaryingTree tree() const
    {
        VaryingTree surface;
        ClosureTree& t = surface.tree;
        ClosureTree::Node root = t.lobe(_parts[0]);
        if (_parts.size() > 1) root = t.mix(root, t.lobe(_parts[1]), _amount);
        if (_base >= 0)
            root = t.layer(root, t.lobe(PlainMaterial{OrenNayarSurface{ColorD(_base)}}));
        t.set_root(root);
        return surface;
    }

    Seen seen(std::vector<Closure>& closures, const Imath::V3d& wo, std::uint64_t n,
              std::uint64_t seed) const
    {
        Seen s = seen_along(closures[0], wo, n, seed);
        if (closures.size() > 1)
            s = s * _amount + seen_along(closures[1], wo, n, seed + 1) * (1 - _amount);
        // Of a diffuse base what it gets comes back.
        if (_base >= 0) s.reflect += (ColorD(1.0) - s.reflect) * _base, s.noise *= 1 - _base;
        return s;
    }
    bool has_two_sides() const
    {
        const auto* i = std::get_if<InterfaceSurface>(&_parts[0].surface);
        return i && i->mode == ScatterMode::RT;
    }

private:
    std::vector<MicrofacetMaterial> _parts;
    double _amount = 1, _base = -1;
    std::string _words;
};

void measure(CheckedPlan& check, const Subject& subject, const MaterialPlan& plan, Drawer& draw,
             std::uint64_t n)
{
    std::vector<Closure> planned, walks;
    for (const PlannedLobe& lobe : plan.lobes)
        if (const auto* m =
                std::get_if<MicrofacetMaterial>(&plan.surface.tree.material_of(lobe.node)))
        {
            planned.push_back(closure_of(*m));
            walks.push_back(closure_of(reference_of(*m)));
        }
    for (const double mu : {0.05, 0.1, 0.2, 0.35, 0.5, 0.7, 0.9, 1.0})
        for (const double side : {1.0, -1.0})
        {
            if (side < 0 && !subject.has_two_sides()) continue;
            const double phi = draw.between(0, 2 * M_PI), s = std::sqrt(1 - mu * mu);
            const Imath::V3d wo(s * std::cos(phi), s * std::sin(phi), side * mu);
            const auto seed = static_cast<std::uint64_t>(draw.between(0, 1e9));
            const Seen a = subject.seen(planned, wo, n, seed),
                       b = subject.seen(walks, wo, 4 * n, seed + 2);
            for (int c = 0; c < 3; ++c)
                check.measured = std::max({check.measured, std::abs(a.reflect[c] - b.reflect[c]),
                                           std::abs(a.transmit[c] - b.transmit[c])});
            check.noise = std::max(check.noise, std::hypot(a.noise, b.noise));
        }
}

}  // namespace

std::vector<CheckedPlan> checked_plans(const MethodCosts& costs, const PlanCheck& settings,
                                       const std::function<void()>& done)
{
    std::vector<CheckedPlan> all;
    Drawer draw(settings.seed);
    while (static_cast<int>(all.size()) < settings.materials)
    {
        const Subject subject(draw);
        const double tolerance = draw.logarithmic(0.003, 0.1);
        const auto scene = plan_scene({{subject.words(), subject.tree()}}, {tolerance, &costs});
        const MaterialPlan& plan = scene.materials.front();
        const bool is_reference = std::all_of(
            plan.lobes.begin(), plan.lobes.end(),
            [](const PlannedLobe& l) { return l.distribution.empty() || l.method == "walk"; });
        if (!plan.is_known || is_reference) continue;
        CheckedPlan check{subject.words(), chosen_methods(plan), tolerance, plan.error};
        measure(check, subject, plan, draw, settings.samples);
        all.push_back(std::move(check));
        done();
    }
    return all;
}

}  // namespace regain::tools
