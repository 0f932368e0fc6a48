// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// What shading a planned scene does, by counting it: a scene of smooth metals has no compensation
// and no table, and what has one is seen to.

#include "../support/price_list.h"

#include <regain/closures/count.h>
#include <regain/luts/library.h>
#include <regain/shaders/planner.h>

#include <gtest/gtest.h>

#include <cmath>

#ifndef REGAIN_COUNT
#error "nothing is counted"
#endif

using namespace regain;
using namespace regain::shaders;

namespace {

struct Work
{
    long closures, gains, bounces;
    std::size_t tables;
};

NamedMaterial metal(double alpha, DistributionKind distribution = DistributionKind::ggx)
{
    MicrofacetMaterial m;
    m.surface = ConductorSurface{};
    m.distribution = distribution;
    m.alpha_x = m.alpha_y = alpha;
    NamedMaterial named{"metal", {}};
    named.surface.tree = ClosureTree(m);
    return named;
}

// A sphere of each material from afar, light from above and whatever is sampled, as a path tracer
// asks for it: an eval and a sample at every point.
template <template <class> class Distribution>
double render(const ClosureTree& tree)
{
    constexpr int size = 24;
    double sum = 0;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
        {
            const float u = (float(x) + 0.5f) / size, v = (float(y) + 0.5f) / size;
            const float a = 2 * u - 1, b = 2 * v - 1, r2 = a * a + b * b;
            if (r2 >= 1) continue;
            const Vec3<float> wo(std::sqrt(r2), 0, std::sqrt(1 - r2)), wi(0, 0.6f, 0.8f);
            for (int k = 0; k < tree.lobes(); ++k)
                std::get<MicrofacetMaterial>(tree.material(k))
                    .with_closure_of<Distribution>(1.0f, [&](const auto& closure) {
                        const auto prepared = closure.prepare(wo);
                        sum += double(prepared.sample({u, v, 0.3f}).weight.x);
                        sum += double(evaluate(prepared, wi, Vec3<float>(u, v, 0.7f)).x);
                    });
        }
    return sum;
}

const MethodCosts& prices()
{
    static const MethodCosts costs = MethodCosts::parse(tests::price_list());
    return costs;
}

template <template <class> class Distribution = GGX>
Work work_of(const std::vector<NamedMaterial>& scene, double tolerance)
{
    const std::size_t before = luts::loaded_files().size();
    const ScenePlan plan = plan_scene(scene, {tolerance, &prices()});
    counts.closures = counts.gains = counts.bounces = 0;
    double light = 0;
    for (const MaterialPlan& m : plan.materials) light += render<Distribution>(m.surface.tree);
    EXPECT_GT(light, 0);
    return {counts.closures, counts.gains, counts.bounces, luts::loaded_files().size() - before};
}

TEST(PlannedScenes, smooth_metals_load_no_table_and_run_no_compensation)
{
    const Work w = work_of({metal(0.001), metal(0.003), metal(0.01)}, 0.01);
    EXPECT_GT(w.closures, 0);
    EXPECT_EQ(w.gains, 0);
    EXPECT_EQ(w.bounces, 0);
    EXPECT_EQ(w.tables, 0u);
    // Nor where their distribution's tables would be files.
    const Work b = work_of<Beckmann>({metal(0.001, DistributionKind::beckmann)}, 0.01);
    EXPECT_EQ(b.gains + b.bounces, 0);
    EXPECT_EQ(b.tables, 0u);
}

TEST(PlannedScenes, what_is_called_for_is_done_once_a_point)
{
    const Work gain = work_of({metal(0.8)}, 0.01);
    EXPECT_EQ(gain.gains, gain.closures);
    EXPECT_EQ(gain.bounces, 0);
    const Work walk = work_of({metal(0.8)}, 0);
    EXPECT_EQ(walk.gains, 0);
    EXPECT_GT(walk.bounces, walk.closures);
    EXPECT_EQ(walk.tables, 0u);
    EXPECT_GT(work_of<Beckmann>({metal(0.8, DistributionKind::beckmann)}, 0.01).tables, 0u);
}

}  // namespace
