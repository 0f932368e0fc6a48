// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// What noise the random walks have for the time they take, plain and of bounded cost, and how near
// their pdfs are: the tables of docs/methods.md, section `walk-bounded`.
//
//   walk_efficiency [pairs] [evals]
//
// Of eval: the relative variance of one estimate, in the mean over pairs of directions, times the
// nanoseconds that it takes, prepare excluded; the less the better. wo has mu 0.2, 0.6 and 0.95,
// and of glass the same from inside; wi is drawn from the walk itself. Of light in the green for
// gold, with F = 1 for white, of glass with index 1.5. The variance is that of all the numbers
// passed to eval, so a walk that is joined by luck counts as much as it weighs; where estimates are
// rare and large the figures are uncertain by some tens of per cent.
//
// Of sample: the variance of the weight over the square of its mean, times the nanoseconds.
//
// Of the pdf: the L1 distance to the density of samples, both over 512 cells of either side, of the
// light of later facets; the rest is exact. It is the mean over samples of |pdf / density - 1|.
//
// Single precision, one point at a time, the least of many runs of one thread.

#include <regain/closures/beckmann.h>
#include <regain/closures/bounded_dielectric_walk.h>
#include <regain/closures/bounded_walk.h>
#include <regain/closures/conductor_fresnel.h>
#include <regain/closures/constant_fresnel.h>
#include <regain/closures/dielectric_walk.h>
#include <regain/closures/ggx.h>
#include <regain/closures/walk.h>
#include <regain/luts/library.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

using namespace regain;

constexpr double alphas[] = {0.1, 0.5, 1}, cosines[] = {0.2, 0.6, 0.95};
constexpr double pi = 3.14159265358979323846;

int pairs = 400, evals = 1000;

template <class Real>
Vec3<Real> towards(double mu, double azimuth = 0)
{
    const double s = std::sqrt((1 - mu) * (1 + mu));
    return {Real(s * std::cos(azimuth)), Real(s * std::sin(azimuth)), Real(mu)};
}

// Nanoseconds of f(i), the least of several runs.
template <class F>
double nanoseconds(const F& f)
{
    using Clock = std::chrono::steady_clock;
    constexpr int calls = 2000;
    double least = 1e30;
    float sum = 0;
    for (int run = 0; run < 40; ++run)
    {
        const auto start = Clock::now();
        for (int i = 0; i < calls; ++i) sum += f(i);
        least = std::min(least, std::chrono::duration<double>(Clock::now() - start).count());
    }
    if (!(sum < 1e30f)) std::printf("!");
    return least * 1e9 / calls;
}

struct Noise
{
    double variance = 0, time = 0;

    double cost() const { return variance * time; }
};

// Noise of eval and of sample, at one wo.
template <class Prepared>
std::pair<Noise, Noise> noise_of(const Prepared& prepared)
{
    RandomStream<float> stream({0.1f, 0.2f, 0.3f});
    std::vector<Vec3<float>> numbers, directions;
    for (int i = 0; i < evals; ++i) numbers.push_back(stream.next3());
    for (int i = 0; i < pairs; ++i) directions.push_back(prepared.path(stream.next3()).wi);

    Noise eval, sample;
    for (const Vec3<float>& wi : directions)
    {
        double sum = 0, squares = 0;
        for (int i = 0; i < evals; ++i)
        {
            const double f = double(prepared.eval(wi, stream.next3()).y);
            sum += f;
            squares += f * f;
        }
        if (sum > 0) eval.variance += (squares * evals / (sum * sum) - 1) / pairs;
    }
    double sum = 0, squares = 0;
    const int samples = 100 * evals;
    for (int i = 0; i < samples; ++i)
    {
        const double w = double(prepared.path(stream.next3()).weight.y);
        sum += w;
        squares += w * w;
    }
    sample.variance = squares * samples / (sum * sum) - 1;

    const auto at = [](const auto& v, int i) { return v[static_cast<std::size_t>(i) % v.size()]; };
    eval.time =
        nanoseconds([&](int i) { return prepared.eval(at(directions, i), at(numbers, 7 * i)).y; });
    sample.time = nanoseconds([&](int i) {
        const Sample<float> s = prepared.sample(at(numbers, i));
        return s.weight.y + s.pdf * 1e-20f;
    });
    return {eval, sample};
}

// The mean over wo of both, `make` being asked for each closure prepared.
template <class Make>
std::pair<Noise, Noise> mean_noise(const Make& make, double side)
{
    Noise eval, sample;
    for (const double mu : cosines)
    {
        const auto [e, s] = noise_of(make(towards<float>(side * mu)));
        eval.variance += e.variance / 3;
        eval.time += e.time / 3;
        sample.variance += s.variance / 3;
        sample.time += s.time / 3;
    }
    return {eval, sample};
}

template <class Plain, class Bounded>
void print_noise(const std::string& name, const Plain& plain, const Bounded& bounded, double side)
{
    const auto [eval, sample] = mean_noise(plain, side);
    const auto [new_eval, new_sample] = mean_noise(bounded, side);
    std::printf(
        "| %s | %.4f x %.0f = %.2f | %.4f x %.0f = %.2f | %.2f | %.5f x %.0f | %.5f x %.0f |\n",
        name.c_str(), eval.variance, eval.time, eval.cost(), new_eval.variance, new_eval.time,
        new_eval.cost(), eval.cost() / new_eval.cost(), sample.variance, sample.time,
        new_sample.variance, new_sample.time);
    std::fflush(stdout);
}

// L1 distance, see above; in the mean over wo that are cosine-weighted, and the largest.
template <class Make, class Single>
void print_pdf(const std::string& name, const Make& make, const Single& single, double side)
{
    constexpr int rows = 16, columns = 16, wos = 6, fine = 6;
    const int samples = 400 * evals;
    double mean = 0, most = 0;
    for (int k = 0; k < wos; ++k)
    {
        const Vec3<double> wo = towards<double>(side * std::sqrt((k + 0.5) / wos));
        const auto prepared = make(wo);
        const auto once = single(wo);
        std::vector<double> cells(2 * rows * columns);
        RandomStream<double> stream({0.5, 0.25, 0.125});
        for (int i = 0; i < samples; ++i)
        {
            const auto p = prepared.path(stream.next3());
            if (p.bounces < 1.5) continue;
            const int row = std::min(rows - 1, int(std::abs(p.wi.z) * rows)),
                      column =
                          std::min(columns - 1,
                                   int((std::atan2(p.wi.y, p.wi.x) / (2 * pi) + 0.5) * columns));
            cells[std::size_t(((p.wi.z < 0) * rows + row) * columns + column)] += 1.0 / samples;
        }
        double distance = 0;
        for (int cell = 0; cell < 2 * rows * columns; ++cell)
        {
            const int below = cell / (rows * columns), row = cell / columns % rows;
            double sum = 0;
            for (int i = 0; i < fine * fine; ++i)
            {
                const double z = (row + (i / fine + 0.5) / fine) / rows,
                             turn = (cell % columns + (i % fine + 0.5) / fine) / columns - 0.5;
                const auto wi = towards<double>(below ? -z : z, 2 * pi * turn);
                sum += prepared.pdf(wi) - once.eval(wi).x;
            }
            distance +=
                std::abs(cells[std::size_t(cell)] - sum * 2 * pi / (rows * columns * fine * fine));
        }
        mean += distance / wos;
        most = std::max(most, distance);
    }
    std::printf("| %s | %.3f | %.3f |\n", name.c_str(), mean, most);
    std::fflush(stdout);
}

MicrofacetTables tables_of(const std::string& distribution)
{
    MicrofacetTables tables = luts::microfacet_tables(distribution);
    luts::add_later_bounces(tables, distribution);
    luts::add_later_shape(tables, distribution);
    return tables;
}

template <template <class> class Distribution>
void noise(const std::string& name)
{
    using D = Distribution<float>;
    using White = ConstantFresnel<float>;
    using Gold = ConductorFresnel<float>;
    const MicrofacetTables tables = tables_of(name);
    const DielectricTables glass = luts::dielectric_tables(name, TransmissionShadowing::beta);
    const Gold gold({0.16f, 0.42f, 1.5f}, {3.46f, 2.35f, 1.88f});
    const Color3<float> one(1.0f);
    for (const double alpha : alphas)
    {
        const D d{float(alpha)};
        const std::string place = name + ", alpha " + std::to_string(alpha).substr(0, 3);
        const auto conductor = [&](const std::string& kind, const auto& fresnel) {
            using F = std::decay_t<decltype(fresnel)>;
            print_noise(
                place + ", " + kind,
                [&](const auto& wo) { return Walk<D, F>(d, fresnel, 1, tables).prepare(wo); },
                [&](const auto& wo) {
                    return BoundedWalk<D, F>(d, fresnel, 1, tables).prepare(wo);
                },
                1);
        };
        conductor("white", White());
        conductor("gold", gold);
        for (const double side : {1.0, -1.0})
            print_noise(
                place + (side > 0 ? ", glass from outside" : ", glass from inside"),
                [&](const auto& wo) { return DielectricWalk<D>(d, 1.5f).prepare(wo); },
                [&](const auto& wo) {
                    return BoundedDielectricWalk<D>(d, 1.5f, one, one, 1, glass, tables)
                        .prepare(wo);
                },
                side);
    }
}

template <template <class> class Distribution>
void pdfs(const std::string& name)
{
    using D = Distribution<double>;
    using White = ConstantFresnel<double>;
    const MicrofacetTables tables = tables_of(name);
    const DielectricTables glass = luts::dielectric_tables(name, TransmissionShadowing::beta);
    const Color3<double> one(1.0);
    for (const double alpha : {0.1, 0.25, 0.5, 0.75, 1.0})
    {
        const D d{alpha};
        const std::string place = name + ", alpha " + std::to_string(alpha).substr(0, 4);
        const auto single = [&](const auto& wo) {
            return MicrofacetReflection<D, White>(d, White()).prepare(wo);
        };
        print_pdf(
            place + ", white, `walk`",
            [&](const auto& wo) { return Walk<D, White>(d, White(), 1, tables).prepare(wo); },
            single, 1);
        print_pdf(
            place + ", white, `walk-bounded`",
            [&](const auto& wo) {
                return BoundedWalk<D, White>(d, White(), 1, tables).prepare(wo);
            },
            single, 1);
        for (const double eta : {1.1, 1.33, 1.5, 2.0, 3.0})
            for (const double side : {1.0, -1.0})
            {
                const auto once = [&](const auto& wo) {
                    return Dielectric<D>(d, eta, ScatterMode::RT, one, one,
                                         TransmissionShadowing::beta)
                        .prepare(wo);
                };
                const std::string from = place + ", index " + std::to_string(eta).substr(0, 4) +
                                         (side > 0 ? " from outside" : " from inside");
                print_pdf(
                    from + ", `walk`",
                    [&](const auto& wo) { return DielectricWalk<D>(d, eta).prepare(wo); }, once,
                    side);
                print_pdf(
                    from + ", `walk-bounded`",
                    [&](const auto& wo) {
                        return BoundedDielectricWalk<D>(d, eta, one, one, 1, glass, tables)
                            .prepare(wo);
                    },
                    once, side);
            }
    }
}

}  // namespace

int main(int argc, char** argv)
{
    if (argc > 1) pairs = std::atoi(argv[1]);
    if (argc > 2) evals = std::atoi(argv[2]);
    if (pairs < 1 || evals < 2)
    {
        std::fprintf(stderr, "accepted: pairs from 1, evals from 2\n");
        return 2;
    }
    std::printf(
        "| | eval, `walk`: variance x ns | `walk-bounded` | ratio | sample, `walk` | "
        "`walk-bounded` |\n|---|---|---|---|---|---|\n");
    noise<GGX>("ggx");
    noise<Beckmann>("beckmann");
    std::printf("\n| pdf | mean L1 | largest |\n|---|---|---|\n");
    pdfs<GGX>("ggx");
    pdfs<Beckmann>("beckmann");
    return 0;
}
