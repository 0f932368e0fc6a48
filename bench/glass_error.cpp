// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// How far each method's reflected share is from the random walk's, of rough glass: the table of
// docs/methods.md.
//
//   glass_error [walks]
//
// alpha 0.1 to 1, mu 0.05 to 1, eta 1.1 to 3 from outside and from inside, the beta form of
// shadowing. The share is R / (R + T) by samples, white; that of `turquin` is that of `none`, too,
// since it scales both lobes alike. So is R + T, to a few thousandths, of `turquin` to a few
// hundredths. 2^17 walks, the default, have a standard error of at most 1.4e-3 and take two
// minutes.

#include <regain/closures/beckmann.h>
#include <regain/closures/dielectric_gain.h>
#include <regain/closures/dielectric_kulla_conty.h>
#include <regain/closures/dielectric_tail.h>
#include <regain/closures/dielectric_walk.h>
#include <regain/closures/ggx.h>
#include <regain/luts/library.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

namespace {

using namespace regain;

constexpr double alphas[] = {0.1, 0.25, 0.5, 0.75, 1};
constexpr double indices[] = {1.1, 1.33, 1.5, 2, 3};
constexpr double cosines[] = {0.05, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.95, 1};
constexpr int samples = 1 << 16;

constexpr const char* methods[] = {"`turquin`", "`kulla-conty`",
                                   "`kulla-conty`, greatest transmission", "`tail`"};
constexpr std::size_t method_count = std::size(methods);

struct Errors
{
    double largest = 0, squares = 0, energy = 0;
    int count = 0;

    void add(const Albedo<double>& found, const Albedo<double>& walk)
    {
        const double sum = found.reflect.x + found.transmit.x;
        const double e = std::abs(found.reflect.x / sum - walk.reflect.x);
        largest = std::max(largest, e);
        squares += e * e;
        energy = std::max(energy, std::abs(sum - 1));
        ++count;
    }
    void add(const Errors& other)
    {
        largest = std::max(largest, other.largest);
        squares += other.squares;
        energy = std::max(energy, other.energy);
        count += other.count;
    }
};

template <class Prepared>
Albedo<double> sampled(const Prepared& prepared, int n)
{
    const Vec3<double> start = RandomStream<double>({0.3, 0.5, 0.25}).next3();
    Albedo<double> sum{Color3<double>(0.0), Color3<double>(0.0)};
    for (int i = 0; i < n; ++i)
    {
        const Sample<double> s = prepared.sample(regain::detail::shifted_numbers(start, i));
        (s.transmitted ? sum.transmit : sum.reflect) += s.weight * (1.0 / n);
    }
    return sum;
}

// Of one alpha: by method.
struct Row
{
    Errors outside[method_count], inside[method_count];
};

template <class Distribution>
Row measured(double alpha, const DielectricTables& tables, int walks)
{
    Row row;
    const Color3<double> white(1.0);
    const Distribution distribution(alpha);
    for (const double index : indices)
        for (const bool inside : {false, true})
        {
            const double eta = inside ? 1 / index : index;
            const Dielectric<Distribution> lobe(distribution, eta, ScatterMode::RT, white, white,
                                                TransmissionShadowing::beta, tables);
            for (const double mu : cosines)
            {
                const Vec3<double> wo(std::sqrt((1 - mu) * (1 + mu)), 0, mu);
                const auto truth =
                    sampled(DielectricWalk<Distribution>(distribution, eta).prepare(wo), walks);
                const auto add = [&](std::size_t method, const auto& closure) {
                    (inside ? row.inside : row.outside)[method].add(
                        sampled(closure.prepare(wo), samples), truth);
                };
                add(0, compensated(lobe, Method::turquin, tables));
                add(1, kulla_conty(lobe, tables));
                add(2, kulla_conty(lobe, tables, 1.0, KullaContySplit::greatest));
                add(3, fitted_tail(lobe, tables));
            }
        }
    return row;
}

template <class Distribution>
void print(const std::string& name, int walks)
{
    DielectricTables tables = luts::dielectric_tables(name, TransmissionShadowing::beta);
    luts::add_later_split(tables, name);
    constexpr std::size_t count = std::size(alphas);
    std::vector<Row> rows(count);
    // Two at a time.
    const auto every_second = [&](std::size_t first) {
        for (std::size_t i = first; i < count; i += 2)
            rows[i] = measured<Distribution>(alphas[i], tables, walks);
    };
    std::thread other(every_second, std::size_t(1));
    every_second(0);
    other.join();

    const auto text = [](const Errors& e) {
        char buffer[64];
        std::snprintf(buffer, sizeof buffer, "%.4f / %.4f", e.largest,
                      std::sqrt(e.squares / e.count));
        return std::string(buffer);
    };
    for (std::size_t m = 0; m < method_count; ++m)
    {
        Errors outside, inside;
        for (const Row& row : rows)
        {
            outside.add(row.outside[m]);
            inside.add(row.inside[m]);
        }
        std::printf("| %s, %s | %s | %s | %.4f |\n", name.c_str(), methods[m],
                    text(outside).c_str(), text(inside).c_str(),
                    std::max(outside.energy, inside.energy));
    }
    for (std::size_t i = 0; i < count; ++i)
        std::printf("| %s, `tail`, alpha %g | %s | %s | |\n", name.c_str(), alphas[i],
                    text(rows[i].outside[method_count - 1]).c_str(),
                    text(rows[i].inside[method_count - 1]).c_str());
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv)
{
    const int walks = argc > 1 ? std::atoi(argv[1]) : 1 << 17;
    if (walks < 1)
    {
        std::fprintf(stderr, "walks is '%s'; accepted: 1 to %d\n", argv[1], 1 << 30);
        return 2;
    }
    std::printf("| method | from outside | from inside | R + T |\n|---|---|---|---|\n");
    print<GGX<double>>("ggx", walks);
    print<Beckmann<double>>("beckmann", walks);
    return 0;
}
