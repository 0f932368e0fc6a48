// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "sphere_cells.h"

#include "random.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace regain::conformance;

namespace {

const double pi = std::acos(-1.0);

double sum(const SphereCells& cells)
{
    double all = 0;
    for (const Bin& b : cells.bins()) all += b.integral.pdf;
    return all;
}

// The von Mises-Fisher distribution about the axis, whose integral is 1.
struct Lobe
{
    Direction axis;
    double concentration;

    double operator()(const Direction& w) const
    {
        const Direction d = w - axis;  // 1 - cosine without cancellation
        return concentration / (2 * pi * -std::expm1(-2 * concentration)) *
               std::exp(-0.5 * concentration * d.dot(d));
    }
    Direction sample(Random& random) const
    {
        const double c =
            1 + std::log1p(-random.unit() * -std::expm1(-2 * concentration)) / concentration;
        const double phi = 2 * pi * random.unit(), s = std::sqrt((1 - c) * (1 + c));
        const Direction x =
            axis.cross(std::abs(axis.z) < 0.9 ? Direction(0, 0, 1) : Direction(1, 0, 0))
                .normalized();
        return axis * c + x * (s * std::cos(phi)) + axis.cross(x) * (s * std::sin(phi));
    }
    std::vector<Direction> samples(std::size_t n) const
    {
        Random random(hash_of("lobe"));
        std::vector<Direction> all;
        while (all.size() < n) all.push_back(sample(random));
        return all;
    }
};

Direction direction(double x, double y, double z) { return Direction(x, y, z).normalized(); }

}  // namespace

TEST(KitSphereCells, one_integrates_to_the_sphere)
{
    SphereCells cells(direction(1, 2, 3), Lobe{direction(1, 0, 1), 50}.samples(4096), 1.0 / 64);
    cells.integrate([](const Direction&) { return Density{1, Color(2.0)}; }, 1e-9, 1 << 20);
    EXPECT_NEAR(sum(cells), 4 * pi, 1e-9);
    double value = 0;
    for (const Bin& b : cells.bins()) value += b.integral.value.y;
    EXPECT_NEAR(value, 8 * pi, 1e-9);
}

TEST(KitSphereCells, the_cosine_integrates_to_pi)
{
    SphereCells cells(direction(0, 1, 0.1), {}, 1);
    cells.integrate(
        [](const Direction& w) {
            return Density{std::max(0.0, w.z), Color(0.0)};
        },
        1e-9, 1 << 20);
    EXPECT_NEAR(sum(cells), pi, 1e-9);
}

// A ring that begins at once, z0 below the horizon's side: (z - z0)^-0.6 above z0, nothing below,
// as of upright facets with a long tail. Its integral is elementary.
TEST(KitSphereCells, a_singular_ring_is_integrated_wherever_cells_end)
{
    for (double z0 : {0.02, 0.1234, 0.4999, 0.5001, 0.75})
    {
        SphereCells cells(direction(1, 0, 0.3), {}, 1);
        const double error = cells.integrate(
            [&](const Direction& w) {
                return Density{w.z > z0 ? std::pow(w.z - z0, -0.6) : 0, Color(0.0)};
            },
            1e-4, 1 << 22);
        const double exact = 2 * pi * std::pow(1 - z0, 0.4) / 0.4;
        // Of the 9 to 16 that it integrates to, 1e-4 is in the smallest cells.
        EXPECT_LE(error, 2e-4) << z0;
        EXPECT_NEAR(sum(cells), exact, 1e-3 * exact) << z0;
    }
}

// Most of a lobe is in one chart, of which samples tell; the rest begins at the edge of a large
// cell of another, where hardly any fall.
TEST(KitSphereCells, what_reaches_into_a_neighbour_is_seen)
{
    const Direction wo = direction(1, 0, 0.5);
    for (double tilt : {1e-4, 5e-4, 2e-3})
    {
        // Just beside the plane of incidence, and far from any corner.
        const Lobe lobe{direction(1, tilt, 0.37), 1e6};
        std::vector<Direction> one_side;
        for (const Direction& w : lobe.samples(1 << 14))
            if (w.y > 0) one_side.push_back(w);
        SphereCells cells(wo, one_side, 1.0 / 256);
        cells.integrate(
            [&](const Direction& w) {
                return Density{lobe(w), Color(0.0)};
            },
            1e-5, 1 << 20);
        EXPECT_NEAR(sum(cells), 1, 1e-4) << tilt;
    }
}

TEST(KitSphereCells, what_no_direction_tells_of_is_seen_where_it_is_looked_for)
{
    const Lobe lobe{direction(0.3, -0.4, 0.1), 1e8};
    SphereCells cells(direction(0.3, -0.4, 0.6), Lobe{direction(1, 1, 1), 10}.samples(1 << 12),
                      1.0 / 64);
    const std::size_t bins = cells.bins().size();
    for (const Direction& w : lobe.samples(64)) cells.look_at(w);
    EXPECT_EQ(cells.bins().size(), bins);
    cells.integrate(
        [&](const Direction& w) {
            return Density{lobe(w), Color(0.0)};
        },
        1e-5, 1 << 20);
    EXPECT_NEAR(sum(cells), 1, 1e-4);
}

// Wider and narrower than a cell, across a pole, a horizon and the seam of azimuths. About the
// pole, where cells are long, no narrower than a surface of alpha 1e-3 looked at straight on, and
// to the tolerance of a commit; elsewhere to that of a thorough run.
TEST(KitSphereCells, lobes_integrate_to_one_and_errors_are_not_understated)
{
    struct Case
    {
        Direction axis;
        double narrowest, tolerance;
    };
    const Direction wo = direction(0.3, -0.4, 0.6);
    for (const Case& c :
         {Case{direction(0, 0, 1), 1e6, 1e-4}, Case{direction(0, 0, -1), 1e6, 1e-4},
          Case{direction(1, 0, 0), 1e10, 1e-5}, Case{direction(0.3, -0.4, 0.1), 1e10, 1e-5},
          Case{direction(-1, 2, -3), 1e10, 1e-5}, Case{direction(-0.3, 0.4, 0.6), 1e10, 1e-5}})
        for (double concentration = 1; concentration <= c.narrowest; concentration *= 100)
        {
            const Lobe lobe{c.axis, concentration};
            SphereCells cells(wo, lobe.samples(1 << 14), 1.0 / 256);
            const double error = cells.integrate(
                [&](const Direction& w) {
                    return Density{lobe(w), Color(0.0)};
                },
                c.tolerance, 1 << 20);
            EXPECT_LE(error, c.tolerance) << c.axis << " " << concentration;
            EXPECT_NEAR(sum(cells), 1, c.tolerance) << c.axis << " " << concentration;
        }
}

TEST(KitSphereCells, bins_are_where_their_directions_are)
{
    const Direction wo = direction(0.3, -0.4, 0.6);
    const SphereCells cells(wo, Lobe{wo, 1e6}.samples(1 << 14), 1.0 / 256);
    ASSERT_GT(cells.bins().size(), 256u);
    double area = 0;
    Random random(hash_of("bins"));
    for (std::size_t b = 0; b < cells.bins().size(); ++b)
    {
        const Bin& bin = cells.bins()[b];
        area += bin.size * bin.size;
        // Away from edges, where rounding decides.
        const ChartPoint inside{bin.corner.chart,
                                bin.corner.x + bin.size * (0.01 + 0.98 * random.unit()),
                                bin.corner.y + bin.size * (0.01 + 0.98 * random.unit())};
        EXPECT_EQ(cells.bin_of(cells.charts().direction_of(inside)), b);
    }
    EXPECT_NEAR(area, 8, 1e-12);
}

TEST(KitSphereCells, directions_come_back_from_their_places)
{
    Random random(hash_of("places"));
    const Charts charts(direction(-1, 0.2, 0.5));
    for (int i = 0; i < 100000; ++i)
    {
        Direction w = random.direction();
        // Half of them close to a pole.
        if (i % 2) w = direction(1e-7 * w.x, 1e-7 * w.y, w.z);
        const Direction back = charts.direction_of(charts.place_of(w));
        EXPECT_LT((back - w).length(), 1e-15 + 1e-12 * std::hypot(w.x, w.y)) << w;
    }
    for (const Direction& w : {Direction(0, 0, 1), Direction(0, 0, -1)})
        EXPECT_EQ(charts.direction_of(charts.place_of(w)), w);
}

TEST(KitSphereCells, what_is_no_direction_is_in_some_bin)
{
    const double infinity = std::numeric_limits<double>::infinity();
    const SphereCells cells(direction(0, 0, 1), Lobe{direction(0, 0, 1), 10}.samples(1000), 0.1);
    for (const Direction& w : {Direction(std::nan(""), 0, 0), Direction(0, 0, std::nan("")),
                               Direction(infinity, 0, 1), Direction(0, 0, -infinity)})
        EXPECT_LT(cells.bin_of(w), cells.bins().size());
}
