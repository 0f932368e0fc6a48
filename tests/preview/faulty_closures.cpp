// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// A closure that answers with something that is no number is found out: its samples are counted,
// and the picture holds numbers only.

#include "doubles.h"

#include <gtest/gtest.h>

#include <limits>

namespace regain::tools::preview { namespace {

using namespace doubles;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

void expect_counted(const Integrator& integrator)
{
    Film film(16, 16);
    ASSERT_TRUE(render({{{&integrator, &film}}, 4, 1}));
    EXPECT_GT(film.non_finite(), 4u * 100u);
    const C3f average = mean(film);
    EXPECT_TRUE(is_finite(average));
}

TEST(FaultyClosures, ValuesThatAreNoNumbersAreCounted)
{
    const SphereWorld w(constant_image(1.0f), 16);
    GridLambert grid((C3f(kNan)));
    expect_counted(GridIntegrator(w.world, {{&grid, nullptr}}));
    const C3f albedo(kNan);
    const auto point = PointLambert::callbacks<2>();
    expect_counted(PointIntegrator(w.world, {{&point, &albedo}}));
}

/// Samples a direction that is none.
class Lost final : public clarisse::bxdf_lobe<float>
{
public:
    clarisse::lobe_label label() const override { return {}; }
    float roughness() const override { return 1.0f; }
    float sample(const V3f&, float, float, float, V3f& wo, C3f& weight, float*) const override
    {
        wo = V3f(kNan);
        weight = C3f(1.0f);
        return 1.0f;
    }
    float evaluate(const V3f&, const V3f&, C3f&, float*) const override { return 0.0f; }
    C3f albedo(const V3f&) const override { return C3f(1.0f); }
};

TEST(FaultyClosures, DirectionsThatAreNoneAreCounted)
{
    const SphereWorld w(constant_image(1.0f), 16);
    auto callbacks = PointLambert::callbacks<1>();
    callbacks.create_lobes = [](const void*, const clarisse::shading_point<float>& p,
                                clarisse::scratchpad& pad, clarisse::lobe_list<float>& list) {
        clarisse::lobe_entry<float> e;
        e.lobe = pad.make<Lost>();
        e.x = p.tangent;
        e.z = p.ns;
        e.y = e.z.cross(e.x);
        return list.add(e);
    };
    const C3f unused(0.0f);
    expect_counted(PointIntegrator(w.world, {{&callbacks, &unused}}));

    EXPECT_FALSE(is_finite(w.environment.at(V3f(kNan)).radiance));
}

}}  // namespace regain::tools::preview
