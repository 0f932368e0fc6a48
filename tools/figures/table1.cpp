// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Table 1 of Turquin 2019 with numbers in place of marks: every method a row. Energy, colour and
// shape are held against the random walk, which is exact for the model.

#include "table1.h"
#include "../table_bytes.h"
#include "clock.h"
#include "figure.h"
#include "measures.h"

#include <regain/closures/balanced_gain.h>
#include <regain/closures/bounded_walk.h>
#include <regain/closures/compensated.h>
#include <regain/closures/conductor_fresnel.h>
#include <regain/closures/constant_fresnel.h>
#include <regain/closures/directional_gain.h>
#include <regain/closures/fitted_tail.h>
#include <regain/closures/ggx.h>
#include <regain/closures/kulla_conty.h>
#include <regain/closures/schlick_fresnel.h>
#include <regain/closures/walk.h>
#include <regain/luts/builtin.h>
#include <regain/shaders/tables_read.h>

#include <fmt/format.h>

#include <stdexcept>

namespace regain::tools::figures {
namespace {

using ColorD = Imath::Color3<double>;

constexpr double alphas[] = {0.25, 0.5, 0.75, 1};
constexpr double cosines[] = {0.1, 0.4, 0.7, 1};
constexpr double shape_alphas[] = {0.5, 1};
constexpr double shape_cosines[] = {0.2, 0.5, 0.9};

/// What is measured of one method.
struct Measured
{
    double energy = 0;                  ///< largest |1 - E| with F = 1
    double tint = 0, tint_squares = 0;  ///< largest difference from the walk, sum of squares
    int tints = 0;
    double shape = 0, worst_shape = 0;  ///< mean and largest L1 distance from the walk
    double reciprocity = 0;             ///< largest |f(wo, wi) / f(wi, wo) - 1|
    double variance = 0;                ///< of the weight with F = 1, mean over the shape cases
    Times times;
    std::size_t tables = 0;  ///< bytes that are read

    double tint_rms() const { return std::sqrt(tint_squares / std::max(tints, 1)); }
};

double largest(const ColorD& c) { return std::max({std::abs(c.x), std::abs(c.y), std::abs(c.z)}); }

// The colours of tint errors: dull, half and bright Schlick terms, and two metals (n, k at 650,
// 550, 450 nm, Johnson and Christy 1972).
template <class Real>
auto schlick()
{
    return SchlickFresnel<Real>(Color3<Real>(Real(0.04), Real(0.5), Real(0.9)));
}
template <class Real>
auto gold()
{
    return ConductorFresnel<Real>(Color3<Real>(Real(0.16), Real(0.42), Real(1.5)),
                                  Color3<Real>(Real(3.46), Real(2.35), Real(1.88)));
}
template <class Real>
auto copper()
{
    return ConductorFresnel<Real>(Color3<Real>(Real(0.21), Real(1.02), Real(1.25)),
                                  Color3<Real>(Real(3.67), Real(2.59), Real(2.48)));
}

// What the walk says, once for all methods.
struct Truth
{
    std::vector<ColorD> tints;      ///< by alpha, cosine, Fresnel term
    std::vector<Histogram> shapes;  ///< by alpha, cosine
    double standard_error = 0;
};

template <class Make, class Visit>
void for_each_tint(const Make& make, const Visit& visit)
{
    for (const double alpha : alphas)
        for (const double mu : cosines)
        {
            const GGX<float> d(static_cast<float>(alpha));
            const auto wo = at_angle<float>(mu);
            visit(make(d, schlick<float>()).prepare(wo));
            visit(make(d, gold<float>()).prepare(wo));
            visit(make(d, copper<float>()).prepare(wo));
        }
}

template <class Make, class Visit>
void for_each_shape(const Make& make, const Visit& visit)
{
    for (const double alpha : shape_alphas)
        for (const double mu : shape_cosines)
            visit(make(GGX<float>(static_cast<float>(alpha)), ConstantFresnel<float>())
                      .prepare(at_angle<float>(mu)));
}

// Pairs of directions over which reciprocity is asked.
template <class Closure>
double reciprocity_error(const Closure& closure)
{
    double worst = 0;
    for (const double a : {0.15, 0.5, 0.95})
        for (const double b : {0.1, 0.4, 0.8})
            for (const double turn : {0.4, 2.8})
            {
                const auto wo = at_angle<double>(a), wi = at_angle<double>(b, turn);
                const double f = closure.eval(wo, wi).x / wi.z, g = closure.eval(wi, wo).x / wo.z;
                worst = std::max(worst, std::abs(f / g - 1));
            }
    return worst;
}

// The same of a closure whose eval is an estimate: means of many.
template <class Closure>
double mean_reciprocity_error(const Closure& closure, const Request& request)
{
    const auto n = static_cast<std::uint64_t>(std::max(256.0, 1e6 * request.precision));
    RandomNumbers random(request.seed);
    const auto mean = [&](const Vec3<double>& wo, const Vec3<double>& wi) {
        const auto prepared = closure.prepare(wo);
        const double a = random.next<double>(), b = random.next<double>(),
                     c = random.next<double>();
        double sum = 0;
        for (std::uint64_t i = 0; i < n; ++i)
            sum += prepared.eval(wi, lattice_point(i, {a, b, c})).x;
        return sum / (static_cast<double>(n) * wi.z);
    };
    double worst = 0;
    for (const double b : {0.1, 0.8})
    {
        const auto wo = at_angle<double>(0.5), wi = at_angle<double>(b, 2.8);
        worst = std::max(worst, std::abs(mean(wo, wi) / mean(wi, wo) - 1));
    }
    return worst;
}

template <class Make>
void measure_lobes(const Make& make, const Request& request, const Truth& truth, Measured& m)
{
    const auto n = static_cast<std::uint64_t>(std::max(1024.0, 65536 * request.precision));
    for (const double alpha : alphas)
        for (const double mu : cosines)
        {
            const auto closure =
                make(GGX<float>(static_cast<float>(alpha)), ConstantFresnel<float>());
            const auto e = sampled_energy(closure.prepare(at_angle<float>(mu)), n, request.seed);
            m.energy = std::max(m.energy, std::abs(1 - e.reflect.x));
        }
    std::size_t i = 0;
    for_each_tint(make, [&](const auto& prepared) {
        const ColorD off = sampled_energy(prepared, n, request.seed + 1).reflect - truth.tints[i++];
        m.tint = std::max(m.tint, largest(off));
        m.tint_squares += off.x * off.x + off.y * off.y + off.z * off.z;
        m.tints += 3;
    });
    std::size_t k = 0;
    constexpr double cases = 6;
    for_each_shape(make, [&](const auto& prepared) {
        const double off =
            shape_error(reflected_histogram(prepared, 16 * n, request.seed + 2), truth.shapes[k++]);
        m.shape += off / cases;
        m.worst_shape = std::max(m.worst_shape, off);
        m.variance += sampled_energy(prepared, n, request.seed + 3).variance / cases;
    });
}

struct Row
{
    std::string name, form;
    Measured measured;
    Clocked clocked;
};

// The closures of each method for any distribution and Fresnel term.
auto with_gain(Method method)
{
    return [method](const auto& distribution, const auto& fresnel) {
        using Distribution = std::decay_t<decltype(distribution)>;
        using Fresnel = std::decay_t<decltype(fresnel)>;
        return compensated(MicrofacetReflection<Distribution, Fresnel>(distribution, fresnel),
                           method, luts::ggx_tables());
    };
}
auto with_directional_gain()
{
    return [](const auto& distribution, const auto& fresnel) {
        using Distribution = std::decay_t<decltype(distribution)>;
        using Fresnel = std::decay_t<decltype(fresnel)>;
        return directional(MicrofacetReflection<Distribution, Fresnel>(distribution, fresnel),
                           luts::ggx_tables());
    };
}
auto with_balanced_gain()
{
    return [](const auto& distribution, const auto& fresnel) {
        using Distribution = std::decay_t<decltype(distribution)>;
        using Fresnel = std::decay_t<decltype(fresnel)>;
        return balanced(MicrofacetReflection<Distribution, Fresnel>(distribution, fresnel),
                        luts::ggx_tables());
    };
}
auto with_added_lobe(KullaContyForm form)
{
    return [form](const auto& distribution, const auto& fresnel) {
        using Distribution = std::decay_t<decltype(distribution)>;
        using Fresnel = std::decay_t<decltype(fresnel)>;
        return kulla_conty(MicrofacetReflection<Distribution, Fresnel>(distribution, fresnel), form,
                           luts::ggx_tables());
    };
}
auto with_tail()
{
    return [](const auto& distribution, const auto& fresnel) {
        using Distribution = std::decay_t<decltype(distribution)>;
        using Fresnel = std::decay_t<decltype(fresnel)>;
        return fitted_tail(MicrofacetReflection<Distribution, Fresnel>(distribution, fresnel),
                           luts::ggx_tables());
    };
}
auto walking()
{
    return [](const auto& distribution, const auto& fresnel) {
        using Distribution = std::decay_t<decltype(distribution)>;
        using Fresnel = std::decay_t<decltype(fresnel)>;
        return Walk<Distribution, Fresnel>(distribution, fresnel);
    };
}

auto walking_within_bounds()
{
    return [](const auto& distribution, const auto& fresnel) {
        using Distribution = std::decay_t<decltype(distribution)>;
        using Fresnel = std::decay_t<decltype(fresnel)>;
        return BoundedWalk<Distribution, Fresnel>(distribution, fresnel, 1, luts::ggx_tables());
    };
}

Truth walk_truth(const Request& request)
{
    const auto tint_walks =
        static_cast<std::uint64_t>(std::max(1024.0, 400000 * request.precision));
    const auto shape_walks = static_cast<std::uint64_t>(std::max(1024.0, 8e6 * request.precision));
    Truth truth;
    for_each_tint(walking(), [&](const auto& prepared) {
        if (request.stopped()) throw Stopped();
        const SampledEnergy e = sampled_energy(prepared, tint_walks, request.seed + 11);
        truth.tints.push_back(e.reflect);
        truth.standard_error = std::max(truth.standard_error, e.standard_error);
    });
    for_each_shape(walking(), [&](const auto& prepared) {
        if (request.stopped()) throw Stopped();
        truth.shapes.push_back(reflected_histogram(prepared, shape_walks, request.seed + 12));
    });
    return truth;
}

template <class Make>
Row measured_row(const std::string& name, const std::string& form, const Make& make,
                 const Request& request, const Truth& truth, const Inputs& inputs,
                 std::size_t tables)
{
    if (request.stopped()) throw Stopped();
    Row row{name, form, {}, clock_of(make(GGX<float>(0.5f), schlick<float>()), inputs)};
    measure_lobes(make, request, truth, row.measured);
    row.measured.tables = tables;
    const auto white = make(GGX<double>(0.6), ConstantFresnel<double>());
    // The walk is reciprocal on average; a single estimate is not to be asked.
    using Prepared = typename decltype(white)::Prepared;
    if constexpr (!regain::detail::TakesNumbersInEval<Prepared, double>::value)
        row.measured.reciprocity = reciprocity_error(white);
    else
        row.measured.reciprocity = mean_reciprocity_error(white, request);
    return row;
}

const Row& row_of(const std::vector<Row>& rows, std::string_view name)
{
    for (const Row& row : rows)
        if (row.name == name) return row;
    throw std::logic_error("no such row");
}

void add_findings(const std::vector<Row>& rows, Figure& figure)
{
    const Measured& none = row_of(rows, "none").measured;
    const Measured& ours = row_of(rows, "turquin").measured;
    const Measured& added = row_of(rows, "kulla-conty").measured;
    const Measured& walk = row_of(rows, "walk").measured;
    const auto add = [&](const char* claim, std::string measured, bool holds) {
        figure.findings.push_back(tested(claim, std::move(measured), holds));
    };
    add("Shape of secondary lobes: the scaled primary is closer to ground truth than Kulla and "
        "Conty's.",
        fmt::format(
            "Distance of the whole lobe from the walk's, GGX: {:.3f} scaled primary, {:.3f} "
            "Kulla and Conty.",
            ours.shape, added.shape),
        ours.shape < added.shape);
    add("Reciprocity: Heitz et al. yes, Kulla and Conty yes, ours no.",
        fmt::format("Largest |f(wo, wi) / f(wi, wo) - 1|: walk {:.2g} (noise), Kulla and Conty "
                    "{:.1g}, turquin {:.2f}.",
                    walk.reciprocity, added.reciprocity, ours.reciprocity),
        added.reciprocity < 1e-4 && ours.reciprocity > 0.01);
    add("Optimal sampling: ours alone reuses the primary's sampler.",
        fmt::format(
            "Relative variance of the weight with F = 1: none {:.4f}, turquin {:.4f}, Kulla "
            "and Conty {:.4f} (exact pdf of the mixture), walk {:.4f} (weights of 1; eval "
            "is an estimate).",
            none.variance, ours.variance, added.variance, walk.variance),
        ours.variance <= none.variance * 1.001 + 1e-6);
    const auto times = [&](const Measured& m) {
        return fmt::format("eval x{:.2f}, sample x{:.2f}", m.times.eval / none.times.eval,
                           m.times.sample / none.times.sample);
    };
    add("Speed: ours is marginally faster than Kulla and Conty, both much faster than the walk.",
        fmt::format("Of an uncompensated lobe's time: turquin {}; Kulla and Conty {}; walk {}.",
                    times(ours), times(added), times(walk)),
        ours.times.eval < added.times.eval && added.times.eval < walk.times.eval);
    add("The walk is 7 times slower (Mitsuba, their original code, whole renders of a conductor).",
        fmt::format("A walk takes {:.1f} times as long as a sample of turquin, one estimate of its "
                    "value {:.1f} times as long as an eval.",
                    walk.times.sample / ours.times.sample, walk.times.eval / ours.times.eval),
        walk.times.sample / ours.times.sample > 5);
    add("All of them preserve energy.",
        fmt::format("Largest |1 - E| with F = 1: none {:.3f}, turquin {:.4f}, Kulla and Conty "
                    "{:.4f}, walk {:.4f}.",
                    none.energy, ours.energy, added.energy, walk.energy),
        ours.energy < 2e-3 && added.energy < 2e-3 && walk.energy < 2e-3);
    add("Whatever F_ms is chosen of Eqs. 12 to 15, results are very close.",
        fmt::format(
            "Largest colour error against the walk: {:.3f} (Eq. 12), {:.3f} (Eq. 13), {:.3f} "
            "(Eq. 14), {:.3f} (Eq. 15), {:.3f} (series).",
            row_of(rows, "turquin-eq12").measured.tint, row_of(rows, "turquin-eq13").measured.tint,
            row_of(rows, "turquin-eq14").measured.tint, ours.tint,
            row_of(rows, "series").measured.tint),
        row_of(rows, "turquin-eq12").measured.tint < 0.1);
}

}  // namespace

Figure make_table1(const Request& request)
{
    Figure figure = titled("table1", "every method, measured");
    const Truth truth = walk_truth(request);
    const Inputs inputs;

    const MicrofacetTables tables = luts::ggx_tables();
    std::vector<Row> rows;
    const auto add = [&](const std::string& name, const std::string& form, const auto& make) {
        const auto size =
            bytes_of(shaders::tables_read(*shaders::compensation_named(name), tables));
        rows.push_back(measured_row(name, form, make, request, truth, inputs, size));
    };
    for (const Method method : all_methods)
        add(std::string(name(method)), method == Method::none ? "-" : "gain(wo)",
            with_gain(method));
    add("directional", "gain(wo)", with_directional_gain());
    add("balanced", "gain(wo) gain(wi)", with_balanced_gain());
    for (const KullaContyForm form : all_kulla_conty_forms)
        add(std::string(name(form)), "added lobe", with_added_lobe(form));
    add("tail", "added lobe", with_tail());
    add("walk", "replaces the lobe", walking());
    add("walk-bounded", "replaces the lobe", walking_within_bounds());
    std::vector<Clocked> clocks;
    for (const Row& row : rows) clocks.push_back(row.clocked);
    const std::vector<Times> times = clocked(clocks, request);
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i].measured.times = times[i];

    const Measured none = row_of(rows, "none").measured;
    Table table{
        "GGX conductors, against the random walk: alpha 0.25 to 1, mu 0.1 to 1; energy and "
        "shape with F = 1; colour: Schlick terms, gold, copper; times: float, one point at "
        "a time, prepare included, alpha 0.5",
        {"method", "form", "energy, worst", "tint, worst", "tint, rms", "shape, mean",
         "shape, worst", "reciprocity", "variance", "eval ns", "eval ratio", "sample ns",
         "sample ratio", "tables"},
        {}};
    for (const Row& row : rows)
    {
        const Measured& m = row.measured;
        table.rows.push_back(
            {row.name, row.form, fmt::format("{:.4f}", m.energy), fmt::format("{:.4f}", m.tint),
             fmt::format("{:.4f}", m.tint_rms()), fmt::format("{:.3f}", m.shape),
             fmt::format("{:.3f}", m.worst_shape), fmt::format("{:.1e}", m.reciprocity),
             fmt::format("{:.4f}", m.variance), fmt::format("{:.1f}", m.times.eval),
             fmt::format("{:.2f}", m.times.eval / none.times.eval),
             fmt::format("{:.1f}", m.times.sample),
             fmt::format("{:.2f}", m.times.sample / none.times.sample),
             fmt::format("{} B", m.tables)});
        figure.numbers[row.name] = {{"form", row.form},
                                    {"energy_worst", m.energy},
                                    {"tint_worst", m.tint},
                                    {"tint_rms", m.tint_rms()},
                                    {"shape_mean", m.shape},
                                    {"shape_worst", m.worst_shape},
                                    {"reciprocity_worst", m.reciprocity},
                                    {"weight_variance", m.variance},
                                    {"eval_ns", m.times.eval},
                                    {"sample_ns", m.times.sample},
                                    {"table_bytes", m.tables}};
    }
    figure.numbers["walk_standard_error"] = truth.standard_error;
    figure.tables.push_back(table);
    add_findings(rows, figure);
    add_glass(request, figure);
    return figure;
}

}  // namespace regain::tools::figures
