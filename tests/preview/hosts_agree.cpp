// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Both host shapes give the same picture within noise.

#include "doubles.h"
#include "preview/row.h"

#include <gtest/gtest.h>

#include <functional>

namespace regain::tools::preview { namespace {

using namespace doubles;

/// Renders a world several times with each host. How the runs of one host spread tells how noisy a
/// pixel is, and so how much the two hosts may differ.
void expect_agreement(const World& world, int samples, double precision,
                      const std::function<std::unique_ptr<Integrator>(Host, const World&)>& make)
{
    constexpr int kRuns = 8;
    const int pixels = world.width * world.height;
    std::vector<double> sum[2], square[2];
    double run_light[2] = {0.0, 0.0}, run_square[2] = {0.0, 0.0};
    for (int host = 0; host < 2; ++host)
    {
        sum[host].assign(static_cast<std::size_t>(pixels), 0.0);
        square[host].assign(static_cast<std::size_t>(pixels), 0.0);
        for (int run = 0; run < kRuns; ++run)
        {
            World seeded = world;
            seeded.seed = static_cast<std::uint32_t>(1 + run + host * kRuns);
            const auto integrator = make(host ? Host::clarisse : Host::renderman, seeded);
            Film film(world.width, world.height);
            ASSERT_TRUE(render({{{integrator.get(), &film}}, samples}));
            EXPECT_EQ(film.non_finite(), 0u);
            double light = 0.0;
            for (int i = 0; i < pixels; ++i)
            {
                const double v = film.mean(i % world.width, i / world.width).y;
                sum[host][static_cast<std::size_t>(i)] += v / kRuns;
                square[host][static_cast<std::size_t>(i)] += v * v / kRuns;
                light += v;
            }
            run_light[host] += light / kRuns;
            run_square[host] += light * light / kRuns;
        }
    }

    // The pictures as a whole: within four standard errors, which are small.
    double variance = 0.0;
    for (int host = 0; host < 2; ++host)
        variance += (run_square[host] - run_light[host] * run_light[host]) / (kRuns - 1);
    const double error = std::sqrt(variance);
    EXPECT_LT(std::abs(run_light[0] - run_light[1]), 4.0 * error);
    EXPECT_LT(error, precision * run_light[0]);

    // Pixel by pixel: squares of standardised differences are 1 on average, or 14/12 since the
    // spread is only known from 14 degrees of freedom.
    double total = 0.0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(pixels); ++i)
    {
        double v = 1e-12;
        for (int host = 0; host < 2; ++host)
            v += (square[host][i] - sum[host][i] * sum[host][i]) / (kRuns - 1);
        const double d = sum[0][i] - sum[1][i];
        total += d * d / v;
    }
    EXPECT_NEAR(total / pixels, 14.0 / 12.0, 0.25);
    testing::Test::RecordProperty("relative_difference",
                                  std::to_string(run_light[0] / run_light[1] - 1.0));
}

TEST(HostsAgree, ColouredLambert)
{
    const WidgetWorld w(make_studio(), 32, 32);
    TwoLamberts materials(C3f(0.3f), C3f(0.9f, 0.6f, 0.2f));
    expect_agreement(w.world, 32, 2e-3, [&](Host host, const World& world) {
        return host == Host::renderman ? materials.grid(world) : materials.point(world);
    });
}

TEST(HostsAgree, GoldFromMirrorToRough)
{
    /// An integrator that keeps its materials.
    class Bound final : public Integrator
    {
    public:
        Bound(Host host, const World& world, float alpha)
            : _row(host, world,
                   {floor_material(),
                    shaders::SchlickMetal{C3f(0.95f, 0.78f, 0.4f), C3f(1.0f), alpha, alpha}})
        {}
        void render(const Tile& tile, int first, int count, Film& film) const override
        {
            _row.get().render(tile, first, count, film);
        }

    private:
        RowIntegrator _row;
    };

    const WidgetWorld w(make_studio(), 24, 24);
    for (const float alpha : {0.0f, 0.05f, 0.4f, 1.0f})
    {
        SCOPED_TRACE(alpha);
        expect_agreement(w.world, 32, 5e-3, [&](Host host, const World& world) {
            return std::make_unique<Bound>(host, world, alpha);
        });
    }
}

}}  // namespace regain::tools::preview
