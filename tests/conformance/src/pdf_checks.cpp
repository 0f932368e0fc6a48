// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// C3, C4, C5, C13: what sample, pdf and weight say of each other.

#include "check.h"

#include <algorithm>
#include <cmath>

REGAIN_NAMESPACE_BEGIN
namespace conformance {
namespace {

std::string needs_nothing(const Subject&, const Traits&) { return {}; }

// C16 finds its directions and pdfs to be those of the bare lobe, bit for bit.
std::string needs_own_sampling(const Subject& subject, const Traits&)
{
    if (subject.form() == Form::gain && subject.bare())
        return "it samples as " + subject.bare()->name() + " does";
    return {};
}

std::string needs_exact_pdf(const Subject& subject, const Traits& traits)
{
    if (std::string why = needs_own_sampling(subject, traits); !why.empty()) return why;
    return traits.exact_pdf ? "" : "its pdf is not declared to be exact";
}

// --- C3 ----------------------------------------------------------------------------------------

// How far a is from b, relative to b. Two that are both nothing agree.
double relative(double a, double b)
{
    const double size = std::abs(b);
    return a == b ? 0 : std::abs(a - b) / std::max(size, 1e-30);
}

// weight = eval / pdf and the pdf of the sample is that of pdf(), sample by sample.
std::optional<Outcome> weight_is_eval_over_pdf(Bench& bench)
{
    TestedClosure& closure = bench.closure();
    Random random = bench.random("C3");
    const std::size_t n = bench.tier() == Tier::commit ? 4096 : 8192;
    std::vector<double> differences;
    Outcome worst;
    for (std::size_t i = 0; i < n; ++i)
    {
        const Direction u = random.cube();
        const Sample<double> s = closure.sample(u);
        if (!s.valid || s.delta || std::abs(s.wi.z) < 1e-4) continue;
        const double pdf = closure.pdf(s.wi);
        const Color f = closure.eval(s.wi, Direction(0.5));
        double off = relative(pdf, s.pdf);
        for (int c = 0; c < 3; ++c)
            if (f[c] > 1e-30 || s.weight[c] * s.pdf > 1e-30)
                off = std::max(off, relative(s.weight[c] * s.pdf, f[c]));
        if (std::isnan(off)) off = 1;
        differences.push_back(off);
        if (off > worst.measured)
            worst = {off,
                     0,
                     1,
                     "u " + shown(u) + " gives wi " + shown(s.wi) + ", weight " + shown(s.weight) +
                         ", pdf " + shown(s.pdf) + "; there eval says " + shown(f) + ", pdf " +
                         shown(pdf),
                     {},
                     {}};
    }
    if (differences.empty()) return std::nullopt;
    // Almost all, and all.
    const bool precise = bench.parameters().in_double;
    const double almost = precise ? 1e-9 : 1e-4, all = precise ? 1e-7 : 1e-3;
    const auto place = static_cast<std::ptrdiff_t>(differences.size() * 999 / 1000);
    std::nth_element(differences.begin(), differences.begin() + place, differences.end());
    const double p999 = differences[static_cast<std::size_t>(place)];
    worst.bound = all;
    if (p999 > almost) worst.note = "99.9 % are within " + shown(p999);
    worst.probability = worst.measured <= all && p999 <= almost ? 1 : 0;
    return worst;
}

std::string needs_value_and_exact_pdf(const Subject&, const Traits& traits)
{
    if (traits.stochastic_eval) return "eval is an estimate: C6 compares it on average";
    return traits.exact_pdf ? "" : "its pdf is not declared to be exact";
}

// --- C4 ----------------------------------------------------------------------------------------

std::optional<Outcome> pdf_integrates_to_one(Bench& bench)
{
    const Survey& s = bench.survey();
    if (!s.resolved) return std::nullopt;
    const double share = s.nothing.mean() + s.delta.mean();
    Outcome o;
    o.measured = std::abs(s.pdf + share - 1);
    // Rounding may take as much again, and no more: what is all rounding is no density.
    const double bound = bench.promises().pdf;
    o.bound = bound + std::min(s.rounding, bound);
    const double beyond = o.measured - o.bound - s.error;
    const double error = std::hypot(s.nothing.standard_error(), s.delta.standard_error());
    if (beyond > 0) o.probability = error > 0 ? student_tail(beyond / error, 31) : 0;
    if (!std::isfinite(beyond)) o.probability = 0;
    o.detail = "the integral of pdf is " + shown(s.pdf) + " (error " + shown(s.error) +
               ", by rounding " + shown(s.rounding) + "), P(nothing) " + shown(s.nothing.mean()) +
               ", P(delta) " + shown(s.delta.mean()) + ", together not 1 but " +
               shown(s.pdf + share);
    return o;
}

// --- C5 ----------------------------------------------------------------------------------------

std::shared_ptr<const Histogram> histogram_of(Bench& bench);

std::optional<Outcome> samples_follow_the_pdf(Bench& bench)
{
    const Survey& s = bench.survey();
    if (!s.resolved || s.pdf < 1e-3) return std::nullopt;
    const std::size_t samples = bench.effort().samples;
    const std::vector<Bin>& bins = s.cells->bins();
    const std::vector<double> found_in =
        histogram(bench.closure(), *s.cells, samples, bench.random("C5").bits());
    const double n = static_cast<double>(samples);

    // Bins that expect little count as one.
    double chi2 = 0, few = 0, few_found = 0, worst = 0;
    std::size_t cells = 0, worst_bin = 0;
    for (std::size_t b = 0; b < bins.size(); ++b)
    {
        const double expected = n * bins[b].integral.pdf;
        if (expected < 8)
        {
            few += expected;
            few_found += found_in[b];
            continue;
        }
        // What the integral may be off by is no fault of the samples.
        const double d = std::max(0.0, std::abs(found_in[b] - expected) - n * bins[b].error);
        const double off = d * d / expected;
        chi2 += off;
        ++cells;
        if (off > worst) worst = off, worst_bin = b;
    }
    // And so do the samples that no bin has: those without density.
    double rest_expected = n * std::max(0.0, 1 - s.pdf) + few, rest_found = n + few_found;
    for (double found : found_in) rest_found -= found;
    if (rest_expected >= 8)
    {
        const double d = std::max(0.0, std::abs(rest_found - rest_expected) - n * s.error);
        chi2 += d * d / rest_expected;
        ++cells;
    }
    if (cells < 2) return std::nullopt;

    Outcome o;
    o.measured = chi2;
    o.bound = static_cast<double>(cells - 1);
    o.probability = chi_squared_tail(chi2, o.bound);
    // A few in a place where there should be none show in no sum of squares.
    if (rest_expected < 8 && rest_found > 0)
        o.probability = std::min(o.probability, count_tail(rest_found, rest_expected));
    const Bin& bin = bins[worst_bin];
    const ChartPoint middle{bin.corner.chart, bin.corner.x + bin.size / 2,
                            bin.corner.y + bin.size / 2};
    o.detail = "chi squared " + shown(chi2) + " over " + std::to_string(cells) +
               " bins; the worst, about " + shown(s.cells->charts().direction_of(middle)) +
               ", holds " + shown(found_in[worst_bin]) + " of " + std::to_string(samples) +
               " samples and should hold " + shown(n * bin.integral.pdf);
    if (o.probability < 1e-3) o.histogram = histogram_of(bench);
    return o;
}

// --- C13 ---------------------------------------------------------------------------------------

std::optional<Outcome> weights_are_bounded(Bench& bench)
{
    const std::optional<double> bound = bench.promises().weight;
    if (!bound) return std::nullopt;
    const Survey& s = bench.survey();
    const double rounding = bench.parameters().in_double ? 1e-6 : 1e-3;
    Outcome o = Outcome::within(0, *bound * (1 + rounding));
    for (std::size_t k = 0; k < 3 && !std::isnan(o.measured); ++k)
    {
        const Drawn& d = s.heaviest[k];
        const double weight = d.sample.weight[static_cast<int>(k)];
        if (weight <= o.measured) continue;
        o = Outcome::within(weight, o.bound,
                            "u " + shown(d.u) + " gives wi " + shown(d.sample.wi) +
                                " with weight " + shown(d.sample.weight));
    }
    const double mean = s.weight.both[0].mean();
    if (mean > 0)
        o.note = "variance of the weight " + shown(s.weight_squares[0] / (mean * mean) - 1) +
                 " of its squared mean";
    return o;
}

std::shared_ptr<const Histogram> histogram_of(Bench& bench)
{
    constexpr int width = 128, height = 64, per_cell = 4;
    const double pi = std::acos(-1.0);
    auto h = std::make_shared<Histogram>();
    h->width = width;
    h->height = height;
    h->found.assign(width * height, 0);
    h->expected.assign(width * height, 0);
    TestedClosure& closure = bench.closure();
    const Direction wo = bench.setting().wo;
    const double azimuth = std::atan2(wo.y, wo.x);
    const std::size_t n = 1 << 20;
    Random random = bench.random("histogram");
    for (std::size_t i = 0; i < n; ++i)
    {
        const Sample<double> s = closure.sample(random.cube());
        if (!s.valid || s.delta || !std::isfinite(s.wi.x + s.wi.y + s.wi.z)) continue;
        double turn = (std::atan2(s.wi.y, s.wi.x) - azimuth) / (2 * pi);
        turn -= std::floor(turn);
        const int x = std::min(width - 1, static_cast<int>(turn * width));
        const int y = std::clamp(static_cast<int>(0.5 * (1 - s.wi.z) * height), 0, height - 1);
        ++h->found[static_cast<std::size_t>(y * width + x)];
    }
    for (int y = 0; y < height * per_cell; ++y)
        for (int x = 0; x < width * per_cell; ++x)
        {
            const double z = 1 - 2 * (y + 0.5) / (height * per_cell);
            const double phi = azimuth + 2 * pi * (x + 0.5) / (width * per_cell);
            const double density = closure.pdf(direction_at(z, phi));
            h->expected[static_cast<std::size_t>(y / per_cell * width + x / per_cell)] +=
                static_cast<float>(density * 4 * pi * static_cast<double>(n) /
                                   (width * height * per_cell * per_cell));
        }
    return h;
}

}  // namespace

std::vector<Check> pdf_checks()
{
    return {
        {"C3", "weight is eval over pdf, sample by sample", Scope::direction, false,
         needs_value_and_exact_pdf, weight_is_eval_over_pdf},
        {"C4", "pdf, P(nothing) and P(delta) add up to 1", Scope::direction, true,
         needs_own_sampling, pdf_integrates_to_one},
        {"C5", "samples follow the pdf", Scope::direction, true, needs_exact_pdf,
         samples_follow_the_pdf},
        {"C13", "weights stay below their bound", Scope::direction, false, needs_nothing,
         weights_are_bounded},
    };
}

}  // namespace conformance
REGAIN_NAMESPACE_END
