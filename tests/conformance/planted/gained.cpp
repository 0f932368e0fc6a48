// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "gained.h"

#include "glass.h"
#include "mirror.h"

#include <algorithm>
#include <cmath>

namespace regain::planted {
namespace {

constexpr double index_of_glass = 1.5, brushed_ratio = 0.25;

Direction towards(double mu, double phi)
{
    const double sine = std::sqrt((1 - mu) * (1 + mu));
    return {sine * std::cos(phi), sine * std::sin(phi), mu};
}

// Of what(u) over evenly spread u.
template <class F>
double mean(const F& what)
{
    constexpr int n = 40;
    double sum = 0;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) sum += what(Direction((i + 0.5) / n, (j + 0.5) / n, 0));
    return sum / (n * n);
}

double once_mirrored(double alpha_x, double alpha_y, const Direction& wo)
{
    const auto lobe = Mirror<double>(alpha_x, alpha_y, Color(1.0)).prepare(wo);
    return mean([&](const Direction& u) { return lobe.sample(u).weight.y; });
}

const EnergyTable& mirror_table()
{
    static const EnergyTable table(
        [](double alpha, double mu) { return once_mirrored(alpha, alpha, towards(mu, 0)); });
    return table;
}

// side 1 from above, -1 from below.
EnergyTable made_for_glass(int side, bool stale)
{
    return EnergyTable([=](double alpha, double mu) {
        const Glass glass(alpha, alpha, side > 0 ? index_of_glass : 1 / index_of_glass);
        const auto lobe = glass.prepare(towards(mu, 0));
        return mean([&](const Direction& u) {
            // Both lobes at each normal; the wrong side counts in the stale table alone.
            return lobe.weight_of_both(u, stale);
        });
    });
}
const EnergyTable& glass_table(int side, bool stale)
{
    static const EnergyTable above = made_for_glass(1, false), below = made_for_glass(-1, false),
                             old = made_for_glass(-1, true);
    return side > 0 ? above : stale ? old : below;
}

// Over a quarter turn, the rest of which is its mirror image.
constexpr int azimuths = 9;
const std::vector<EnergyTable>& brushed_tables()
{
    static const std::vector<EnergyTable> tables = [] {
        std::vector<EnergyTable> t;
        for (int k = 0; k < azimuths; ++k)
            t.emplace_back([k](double alpha, double mu) {
                const double phi = k * pi<double> / 2 / (azimuths - 1);
                return once_mirrored(alpha, brushed_ratio * alpha, towards(mu, phi));
            });
        return t;
    }();
    return tables;
}
double brushed_energy(double alpha, const Direction& wo)
{
    const double turn = std::atan2(std::abs(wo.y), std::abs(wo.x)) / (pi<double> / 2);
    const double place = std::min(turn, 1.0) * (azimuths - 1);
    const auto k = static_cast<std::size_t>(std::min(azimuths - 2, static_cast<int>(place)));
    const double f = place - static_cast<double>(k);
    return (1 - f) * brushed_tables()[k].at(alpha, std::abs(wo.z)) +
           f * brushed_tables()[k + 1].at(alpha, std::abs(wo.z));
}

double limited(double alpha) { return std::max(1e-9, detail::sanitised(alpha, 0.0, 1.0, 1.0)); }

Color F0_of(const Parameters& p)
{
    if (p.reflectance != conformance::Reflectance::schlick) return Color(1.0);
    return detail::per_channel(p.F0, [](double f) { return detail::saturate(f); });
}

// E of one closure, of wo; as it is, and as the fault has it.
using Energy = std::function<double(const Direction&)>;
using EnergyOf = std::function<Energy(const Parameters&, GainFault)>;

Color gain(double E, const Color& F0) { return Color(1.0) + F0 * ((1 - E) / E); }

template <class Lobe>
PlantedSubject gained(GainFault fault, const std::string& name, const Reads& reads,
                      const std::function<Lobe(const Parameters&)>& lobe_of,
                      const EnergyOf& energy_of, double furnace)
{
    const auto subject = new_subject(name, reads, [=](const Parameters& p) {
        const Color F0 = F0_of(p);
        return conformance::adapt(Gained<Lobe>(
            lobe_of(p),
            [E = energy_of(p, fault), F0](const Direction& wo) { return gain(E(wo), F0); }, fault));
    });
    subject->kind = Form::gain;
    subject->without_gain = new_subject(name + ".bare", reads, [lobe_of](const Parameters& p) {
        return conformance::adapt(lobe_of(p));
    });
    subject->promiser = [=](const Parameters& p, const Direction& wo) {
        Promises promises;
        promises.furnace = promises.surplus = furnace;
        promises.albedo = albedo_error;
        const Color most = gain(energy_of(p, GainFault::none)(wo), F0_of(p));
        promises.weight = std::max({most.x, most.y, most.z});
        return promises;
    };
    return subject;
}

LookUp how(GainFault fault)
{
    switch (fault)
    {
        case GainFault::table_transposed: return LookUp::transposed;
        case GainFault::table_half_a_texel_off: return LookUp::half_a_texel_off;
        default: return LookUp::right;
    }
}

// At places between the nodes, against what the nodes are made by.
std::vector<conformance::TableError> table_errors(int places, GainFault fault)
{
    conformance::TableError worst{"E", "", 0, 5e-3};
    for (int i = 0; i < places; ++i)
        for (int j = 0; j < places; ++j)
        {
            const double alpha = std::pow((i + 0.7) / places, 2), mu = (j + 0.7) / places;
            const double off = std::abs(mirror_table().at(alpha, mu, how(fault)) -
                                        once_mirrored(alpha, alpha, towards(mu, 0)));
            if (off <= worst.measured) continue;
            worst.measured = off;
            worst.where = "alpha " + std::to_string(alpha) + ", mu " + std::to_string(mu);
        }
    return {worst};
}

}  // namespace

PlantedSubject gained_mirror(GainFault fault, const std::string& name)
{
    Reads reads;
    reads.alpha = reads.schlick = reads.twice = true;
    const auto subject = gained<Mirror<double>>(
        fault, name, reads,
        [](const Parameters& p) { return Mirror<double>(p.alpha_x, p.alpha_x, F0_of(p)); },
        [](const Parameters& p, GainFault f) {
            return [alpha = limited(p.alpha_x), f](const Direction& wo) {
                return mirror_table().at(alpha, std::abs(wo.z), how(f));
            };
        },
        5e-3);
    subject->table_reader = [fault](int places) { return table_errors(places, fault); };
    return subject;
}

PlantedSubject gained_glass(GainFault fault, const std::string& name)
{
    Reads reads;
    reads.alpha = reads.twice = true;
    return gained<Glass>(
        fault, name, reads,
        [](const Parameters& p) { return Glass(p.alpha_x, p.alpha_x, index_of_glass); },
        [](const Parameters& p, GainFault f) {
            return [alpha = limited(p.alpha_x), f](const Direction& wo) {
                const int side = (wo.z < 0) != (f == GainFault::other_side) ? -1 : 1;
                const bool stale = f == GainFault::stale_other_side;
                return glass_table(side, stale).at(alpha, std::abs(wo.z));
            };
        },
        5e-3);
}

PlantedSubject gained_brushed(GainFault fault, const std::string& name)
{
    Reads reads;
    reads.alpha = reads.twice = true;
    return gained<Mirror<double>>(
        fault, name, reads,
        [](const Parameters& p) {
            return Mirror<double>(p.alpha_x, brushed_ratio * p.alpha_x, Color(1.0));
        },
        [](const Parameters& p, GainFault f) {
            return [alpha = limited(p.alpha_x), f](const Direction& wo) {
                if (f != GainFault::isotropic_energy) return brushed_energy(alpha, wo);
                return mirror_table().at(alpha * std::sqrt(brushed_ratio), std::abs(wo.z));
            };
        },
        5e-3);
}

}  // namespace regain::planted
