// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Both adapters on interfaces between two media: sides, events, radiance against energy, lobes with
// and without density, values that are estimates.

#include "../support/interfaces.h"
#include "../support/hosts.h"

#include <regain/closures/dielectric_walk.h>
#include <regain/closures/kulla_conty.h>
#include <regain/closures/thin_dielectric.h>
#include <regain/closures/walk.h>

#include <gtest/gtest.h>

#include <algorithm>

using namespace regain;
using namespace regain::tests;

namespace {

namespace rm = regain::renderman;
namespace cl = regain::clarisse;

constexpr float eta = 1.5f, share = 0.8f;
const LambertInterface<float> plain(eta, share);

// What one call of the batched host returns for every point.
struct Answers
{
    explicit Answers(int n) : sampled(n), evaluated(n), L(n), total(n), fwd(n), rev(n) {}
    std::vector<rm::Lobe> sampled;
    std::vector<rm::LobeSet> evaluated;
    std::vector<rm::Vec3> L;
    std::vector<rm::Color3> total;
    std::vector<float> fwd, rev;
};

// A batch at one material.
template <class Closure>
class Grid
{
public:
    Grid(const Closure& closure, int points)
        : host(points, std::size_t(points) * 2048 + 4096), _material{closure}, _points(points)
    {}

    rm::Bxdf& bxdf()
    {
        host.reset();
        return *_factory.beginScatter(&host.ctx, rm::LobeSet::all(), rm::ShadeMode::Scatter,
                                      nullptr, &_material);
    }
    Answers generate(rm::LobeSet wanted = rm::LobeSet::all())
    {
        Answers a(_points);
        auto w = host.weights();
        bxdf().generateSample(rm::kAnyLighting, std::vector(_points, wanted).data(), &host.rng,
                              a.sampled.data(), a.L.data(), w, a.fwd.data(), a.rev.data(), nullptr);
        for (int i = 0; i < _points; ++i) a.total[i] = w.total(i);
        return a;
    }
    Answers evaluate(const std::vector<rm::Vec3>& L, rm::LobeSet wanted = rm::LobeSet::all())
    {
        Answers a(_points);
        auto w = host.weights();
        bxdf().evaluateSample(rm::kAnyLighting, std::vector(_points, wanted).data(), &host.rng,
                              a.evaluated.data(), L.data(), w, a.fwd.data(), a.rev.data());
        for (int i = 0; i < _points; ++i) a.total[i] = w.total(i);
        return a;
    }

    GridHost host;

private:
    ClosureMaterial<Closure> _material;
    rm::ClosureFactory<ClosureMaterial<Closure>> _factory;
    int _points;
};

// One point at one material; directions are those of the world, normals +z.
template <class Closure>
class Point
{
public:
    using Real = typename Closure::Real;
    explicit Point(const Closure& closure) : _material{closure} {}

    int lobes(const cl::vec3<Real>& view, cl::vec3<Real> ns = {0, 0, 1})
    {
        point.ng = {0, 0, 1};
        point.ns = ns;
        point.tangent = {1, 0, 0};
        point.view = view;
        point.front_facing = view.z > 0;
        _pad.reset();
        list = {};
        using Material = ClosureMaterial<Closure>;
        EXPECT_TRUE(
            (cl::closure_callbacks<Material, Real>().create_lobes(&_material, point, _pad, list)));
        return list.size();
    }
    const cl::bxdf_lobe<Real>& lobe(int k = 0) const { return *list[k].lobe; }

    cl::shading_point<Real> point;
    cl::lobe_list<Real> list;

private:
    ClosureMaterial<Closure> _material;
    alignas(64) char _memory[8192];
    cl::scratchpad _pad{_memory, sizeof _memory};
};

// From outside light enters the denser medium, where its radiance is eta^2 times as much.
double factor(const Imath::V3f& to_viewer, const Imath::V3f& to_light)
{
    if ((to_viewer.z > 0) == (to_light.z > 0)) return 1;
    return to_viewer.z > 0 ? 1 / (eta * eta) : eta * eta;
}

Imath::V3f anywhere(Random& random)
{
    return direction<float>(2 * random.unit() - 1, 2 * M_PI * random.unit());
}

TEST(InterfaceInRenderMan, energy_is_kept_and_radiance_scaled)
{
    constexpr int n = 40000;
    for (const float side : {0.6f, -0.6f})
        for (const bool light_path : {false, true})
        {
            Grid grid(plain, n);
            std::fill(grid.host.V.begin(), grid.host.V.end(), direction<float>(side, 1));
            grid.host.ctx.lightPath = light_path;
            const double T = side > 0 ? share : share / (eta * eta);
            const double scale = light_path ? 1 : factor({0, 0, side}, {0, 0, -side});
            const Answers g = grid.generate();
            Random random(5);
            std::vector<rm::Vec3> everywhere(n);
            for (auto& L : everywhere) L = anywhere(random);
            const Answers e = grid.evaluate(everywhere);
            double reflect[2] = {0, 0}, transmit[2] = {0, 0};
            for (int i = 0; i < n; ++i)
            {
                ASSERT_TRUE(g.sampled[i].valid);
                const bool same = g.L[i].z * side > 0;
                EXPECT_EQ(g.sampled[i].reflect, same);
                EXPECT_EQ(g.sampled[i].id, rm::kGlassSlot);
                (same ? reflect : transmit)[0] += g.total[i].x / g.fwd[i] / n;
                (everywhere[i].z * side > 0 ? reflect : transmit)[1] += e.total[i].x * 4 * M_PI / n;
            }
            for (int k = 0; k < 2; ++k)
            {
                EXPECT_NEAR(reflect[k], 1 - T, 0.02) << side << light_path;
                EXPECT_NEAR(transmit[k] / scale, T, 0.02) << side << light_path;
            }
            std::vector<rm::Color3> albedo(n);
            std::vector<float> ior(n);
            ASSERT_TRUE(grid.bxdf().albedo(albedo.data()));
            ASSERT_TRUE(grid.bxdf().materialIor(ior.data()));
            EXPECT_FLOAT_EQ(albedo[3].x, 1);
            EXPECT_FLOAT_EQ(ior[3], eta);
            EXPECT_EQ(grid.bxdf().evaluateDomain(), rm::kBoth);
        }
}

TEST(InterfaceInRenderMan, generate_and_evaluate_agree_and_reverse_is_forward_from_the_other_side)
{
    constexpr int n = 256;
    Grid grid(plain, n);
    Random random(3);
    for (auto& V : grid.host.V) V = anywhere(random);
    const Answers g = grid.generate(), e = grid.evaluate(g.L);
    std::vector<rm::Vec3> V = grid.host.V;
    grid.host.V = g.L;
    grid.host.ctx.Vn = grid.host.V.data();
    const Answers back = grid.evaluate(V);
    for (int i = 0; i < n; ++i)
    {
        ASSERT_TRUE(g.sampled[i].valid);
        EXPECT_TRUE(e.evaluated[i].has(g.sampled[i]));
        EXPECT_NEAR(g.fwd[i] / e.fwd[i], 1, 1e-4);
        EXPECT_NEAR(g.rev[i] / e.rev[i], 1, 1e-4);
        EXPECT_NEAR(g.total[i].x / e.total[i].x, 1, 1e-4);
        EXPECT_NEAR(back.fwd[i] / g.rev[i], 1, 1e-4);
        EXPECT_NEAR(back.rev[i] / g.fwd[i], 1, 1e-4);
    }
}

// C7: both ends of a path give one value, also through the surface and with a gain of one
// direction.
TEST(InterfaceInRenderMan, a_light_path_sees_what_an_eye_path_sees)
{
    const auto closure = compensated(plain, SlopedGain<float>());
    for (const float eye_side : {0.35f, -0.35f})
        for (const float light_side : {0.9f, -0.9f})
        {
            const auto eye = direction<float>(eye_side, 0.3);
            const auto light = direction<float>(light_side, 2.5);
            Grid from_eye(closure, 1), from_light(closure, 1);
            from_eye.host.V[0] = eye;
            from_light.host.V[0] = light;
            from_light.host.ctx.lightPath = true;
            const Answers a = from_eye.evaluate({light}), b = from_light.evaluate({eye});
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(a.total[0][c] / std::abs(light.z), b.total[0][c] / std::abs(eye.z),
                            1e-5);
            EXPECT_NEAR(a.fwd[0], b.rev[0], 1e-6);
            EXPECT_NEAR(a.rev[0], b.fwd[0], 1e-6);
        }
}

TEST(InterfaceInRenderMan, lobes_wanted_choose_the_event)
{
    constexpr int n = 2000;
    Grid grid(plain, n);
    std::fill(grid.host.V.begin(), grid.host.V.end(), direction<float>(0.6));
    for (const bool reflect : {true, false})
    {
        const rm::LobeSet wanted(
            rm::Lobe{rm::LobeClass::Specular, rm::kGlassSlot, reflect, false, false});
        const Answers g = grid.generate(wanted);
        int valid = 0;
        for (int i = 0; i < n; ++i)
        {
            if (!g.sampled[i].valid) continue;
            ++valid;
            EXPECT_EQ(g.L[i].z > 0, reflect);
        }
        EXPECT_NEAR(double(valid) / n, reflect ? 1 - share : share, 0.05);
        for (const float side : {0.5f, -0.5f})
        {
            const std::vector<rm::Vec3> L(n, direction<float>(side));
            EXPECT_EQ(grid.evaluate(L, wanted).evaluated[0].any(), (side > 0) == reflect);
        }
    }
}

// A bumped normal never sends light to a side that the true normal does not confirm, and a viewer
// between the two horizons sees nothing.
TEST(InterfaceInRenderMan, light_does_not_take_a_bumped_normal_for_the_true_one)
{
    constexpr int n = 4000;
    Grid grid(plain, n);
    const auto bumped = direction<float>(0.5, 0.0);
    std::fill(grid.host.N.begin(), grid.host.N.end(), bumped);
    std::fill(grid.host.V.begin(), grid.host.V.end(), direction<float>(0.3, 0.1));
    const Answers g = grid.generate();
    int declined = 0;
    for (int i = 0; i < n; ++i)
    {
        if (!g.sampled[i].valid)
            ++declined;
        else
            EXPECT_EQ(g.sampled[i].reflect, g.L[i].z > 0);
    }
    EXPECT_GT(declined, 50);
    // Above the true surface, below the bumped one.
    const auto between = direction<float>(0.1, M_PI);
    ASSERT_LT(between.dot(bumped), 0);
    std::fill(grid.host.V.begin(), grid.host.V.end(), direction<float>(0.3, 0.1));
    EXPECT_EQ(grid.evaluate(std::vector<rm::Vec3>(n, between)).fwd[0], 0);
    std::fill(grid.host.V.begin(), grid.host.V.end(), between);
    EXPECT_FALSE(grid.generate().sampled[0].valid);
}

TEST(InterfaceInRenderMan, smooth_glass_is_two_discrete_lobes)
{
    constexpr int n = 2000;
    Grid grid(LambertInterface<float>(eta, share, Discrete::all), n);
    const auto V = direction<float>(-0.6);
    std::fill(grid.host.V.begin(), grid.host.V.end(), V);
    EXPECT_EQ(grid.bxdf().evaluateDomain(), rm::kEmptyDomain);
    const Answers g = grid.generate(), e = grid.evaluate(g.L);
    const float T = share / (eta * eta);
    for (int i = 0; i < n; ++i)
    {
        ASSERT_TRUE(g.sampled[i].valid);
        EXPECT_TRUE(g.sampled[i].discrete);
        EXPECT_EQ(g.sampled[i].reflect, g.L[i].z < 0);
        const float chance = g.sampled[i].reflect ? 1 - T : T;
        EXPECT_FLOAT_EQ(g.fwd[i], chance);
        EXPECT_NEAR(g.total[i].x / g.fwd[i], factor(V, g.L[i]), 1e-5);
        EXPECT_FALSE(e.evaluated[i].any());
        EXPECT_EQ(e.fwd[i], 0);
    }
    rm::LobeSet smooth = rm::LobeSet::all();
    smooth.bits &= ~rm::LobeSet::kDiscrete;
    EXPECT_FALSE(grid.generate(smooth).sampled[0].valid);
}

TEST(InterfaceInRenderMan, estimates_are_right_on_average)
{
    constexpr int n = 20000;
    Grid grid(LambertInterface<float, true>(eta, share), n);
    std::fill(grid.host.V.begin(), grid.host.V.end(), direction<float>(0.6));
    const auto L = direction<float>(-0.5, 2);
    const Answers e = grid.evaluate(std::vector<rm::Vec3>(n, L));
    std::vector<rm::Color3> storage(std::size_t(rm::kMaxActive) * n);
    rm::LobeWeights w(storage.data(), n);
    std::vector<rm::LobeSet> evaluated(n);
    std::vector<float> fwd(n), rev(n);
    grid.bxdf().evaluateSamplesAtIndex(rm::kDirect, rm::LobeSet::all(), &grid.host.rng, 7, n,
                                       evaluated.data(), std::vector<rm::Vec3>(n, L).data(), w,
                                       fwd.data(), rev.data());
    double mean = 0, at_index = 0;
    for (int i = 0; i < n; ++i)
    {
        mean += e.total[i].x / n;
        at_index += w.total(i).x / n;
    }
    const double value = share / (eta * eta) * 0.5 / M_PI;
    // 2 u has a standard deviation of 1 / sqrt(3).
    const double bound = 4.5 * value / std::sqrt(3.0 * n);
    EXPECT_NEAR(mean, value, bound);
    EXPECT_NEAR(at_index, value, bound);
    EXPECT_NE(e.total[0].x, e.total[1].x);
}

template <class Real>
class InterfaceInClarisse : public testing::Test
{};
using Precisions = testing::Types<float, double>;
TYPED_TEST_SUITE(InterfaceInClarisse, Precisions);

TYPED_TEST(InterfaceInClarisse, energy_is_kept_and_radiance_scaled)
{
    using Real = TypeParam;
    Point host{LambertInterface<Real>(Real(eta), Real(share))};
    for (const double side : {0.6, -0.6})
    {
        const auto wi = direction<Real>(side, 1);
        ASSERT_EQ(host.lobes(wi), 1);
        EXPECT_GT(host.list[0].z.z, 0) << "the normal is not turned";
        const auto& lobe = host.lobe();
        EXPECT_EQ(lobe.label().ev, cl::event::either);
        EXPECT_EQ(lobe.label().category(), cl::glossy_reflection | cl::glossy_transmission);
        EXPECT_NEAR(lobe.roughness(), 0.75, 1e-6);
        EXPECT_NEAR(lobe.albedo(wi).x, 1, 1e-6);
        EXPECT_NEAR(lobe.ior(), eta, 1e-6);
        const double T = side > 0 ? share : share / (eta * eta);
        const double scale = side > 0 ? 1 / (eta * eta) : eta * eta;
        constexpr int n = 40;
        double reflect[2] = {0, 0}, transmit[2] = {0, 0};
        for (int i = 0; i < n * n * n; ++i)
        {
            const Real u = Real((i % n + 0.5) / n), v = Real((i / n % n + 0.5) / n),
                       w = Real((i / (n * n) + 0.5) / n);
            cl::vec3<Real> wo;
            cl::color<Real> weight;
            ASSERT_GT(lobe.sample(wi, u, v, w, wo, weight, nullptr), 0);
            (wo.z * wi.z > 0 ? reflect : transmit)[0] += weight.x / (n * n * n);
            wo = direction<Real>(2 * u - 1, 2 * M_PI * v);
            const Real pdf = lobe.evaluate(wi, wo, weight, nullptr);
            (wo.z * wi.z > 0 ? reflect : transmit)[1] += weight.x * pdf * 4 * M_PI / (n * n * n);
        }
        for (int k = 0; k < 2; ++k)
        {
            EXPECT_NEAR(reflect[k], 1 - T, 0.02);
            EXPECT_NEAR(transmit[k], T * scale, 0.02 * scale);
        }
    }
}

TYPED_TEST(InterfaceInClarisse, sample_and_evaluate_agree)
{
    using Real = TypeParam;
    Point host(compensated(LambertInterface<Real>(Real(eta), Real(share)), SlopedGain<Real>()));
    Random random(4);
    for (int i = 0; i < 300; ++i)
    {
        const auto wi = direction<Real>(2 * random.unit() - 1, 7 * random.unit());
        ASSERT_EQ(host.lobes(wi), 1);
        cl::vec3<Real> wo;
        cl::color<Real> a, b, unused;
        Real reverse_a, reverse_b, back;
        const Real u = Real(random.unit()), v = Real(random.unit()), w = Real(random.unit());
        const Real pdf = host.lobe().sample(wi, u, v, w, wo, a, &reverse_a);
        ASSERT_GT(pdf, 0);
        EXPECT_NEAR(host.lobe().evaluate(wi, wo, b, &reverse_b) / pdf, 1, 1e-5);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c] / b[c], 1, 1e-5);
        EXPECT_NEAR(reverse_a / reverse_b, 1, 1e-5);
        EXPECT_NEAR(host.lobe().evaluate(wo, wi, unused, &back) / reverse_a, 1, 1e-5);
        EXPECT_NEAR(back / pdf, 1, 1e-5);
    }
}

// A viewer below meets the inside whatever the sidedness, but for a surface turned inside out.
TYPED_TEST(InterfaceInClarisse, sides)
{
    using Real = TypeParam;
    const LambertInterface<Real> closure{Real(eta), Real(share)};
    Point host(closure);
    const auto reflected = [&](double side) {
        const auto wi = direction<Real>(side);
        EXPECT_EQ(host.lobes(wi), 1);
        const auto& e = host.list[0];
        const cl::vec3<Real> local(wi.dot(e.x), wi.dot(e.y), wi.dot(e.z));
        cl::vec3<Real> wo;
        cl::color<Real> weight;
        host.lobe().sample(local, Real(0.5), Real(0.5), Real(0.999), wo, weight, nullptr);
        const Real pdf = host.lobe().evaluate(local, wo, weight, nullptr);
        return double(weight.x * pdf * M_PI / std::abs(wo.z));
    };
    for (const auto sides : {cl::sidedness::single_sided, cl::sidedness::double_sided})
    {
        host.point.sides = sides;
        EXPECT_NEAR(reflected(0.6), 1 - share, 1e-5);
        EXPECT_NEAR(reflected(-0.6), 1 - share / (eta * eta), 1e-5);
    }
    host.point.sides = cl::sidedness::inverted;
    EXPECT_NEAR(reflected(-0.6), 1 - share, 1e-5);
}

// P3: no lobe is singular for some directions only.
TYPED_TEST(InterfaceInClarisse, both_kinds_of_direction_make_two_lobes)
{
    using Real = TypeParam;
    Point host(LambertInterface<Real>(Real(eta), Real(share), Discrete::transmitted));
    const auto wi = direction<Real>(0.6);
    ASSERT_EQ(host.lobes(wi), 2);
    double sum = 0;
    for (int k = 0; k < 2; ++k)
    {
        const auto& lobe = host.lobe(k);
        const bool singular = lobe.label().sc == cl::scatter::singular;
        EXPECT_EQ(singular, k == 1);
        EXPECT_EQ(lobe.roughness() == 0, singular);
        constexpr int n = 100;
        for (int i = 0; i < n; ++i)
        {
            cl::vec3<Real> wo;
            cl::color<Real> weight, again;
            const Real w = Real((i + 0.5) / n);
            const Real pdf = lobe.sample(wi, Real(0.3), Real(0.6), w, wo, weight, nullptr);
            if (pdf == 0) continue;
            sum += weight.x / n * (singular ? eta * eta : 1);
            EXPECT_EQ(wo.z < 0, singular);
            EXPECT_EQ(lobe.evaluate(wi, wo, again, nullptr) == 0, singular);
            EXPECT_TRUE(!singular || std::abs(double(pdf) - share) < 1e-6);
        }
    }
    EXPECT_NEAR(sum, 1, 1e-5) << "together they are the closure";
    host.point.wanted = cl::singular_transmission;
    EXPECT_EQ(host.lobes(wi), 1);
}

// P8: the same for the same directions, right on average over others.
TYPED_TEST(InterfaceInClarisse, estimates_depend_on_the_directions_alone)
{
    using Real = TypeParam;
    Point host{LambertInterface<Real, true>(Real(eta), Real(share))};
    const auto wi = direction<Real>(0.6, 0.5);
    ASSERT_EQ(host.lobes(wi), 1);
    constexpr int n = 20000;
    double mean = 0;
    for (int i = 0; i < n; ++i)
    {
        const auto wo = direction<Real>(0.5, 2 * M_PI * (i + 0.5) / n);
        cl::color<Real> a, b;
        host.lobe().evaluate(wi, wo, a, nullptr);
        host.lobe().evaluate(wi, wo, b, nullptr);
        EXPECT_EQ(a, b);
        mean += a.x / n;  // value over pdf: twice the number drawn
    }
    EXPECT_NEAR(mean, 1, 4.5 / std::sqrt(3.0 * n));
}

// The library's own closures, of every kind that the adapters tell apart.
const GGX<float> ggx(0.5f, 0.3f);
const Dielectric<GGX<float>> rough_glass(ggx, eta);
const ThinDielectric<GGX<float>> sheet(ggx, eta);
const DielectricWalk<GGX<float>> walked_glass(ggx, eta);
const Walk<GGX<float>, ConstantFresnel<float>> walked_metal(ggx, ConstantFresnel<float>());
const auto added_metal =
    kulla_conty(white<float>(0.5, 0.5), KullaContyForm::printed, luts::ggx_tables());

// Of every pair of directions both hosts are told the same, and what generateSample says is what
// evaluateSample does.
template <class Closure>
void expect_hosts_agree(const Closure& closure, bool estimated = false)
{
    constexpr int n = 128;
    Grid grid(closure, n);
    Point point_host(closure);
    Random random(8);
    for (auto& V : grid.host.V) V = anywhere(random);
    const Answers g = grid.generate(), e = grid.evaluate(g.L);
    const std::vector<rm::Vec3> V = grid.host.V;
    grid.host.V = g.L;
    grid.host.ctx.Vn = grid.host.V.data();
    const Answers back = grid.evaluate(V);
    int valid = 0;
    for (int i = 0; i < n; ++i)
    {
        if (!g.sampled[i].valid || g.sampled[i].discrete) continue;
        ++valid;
        // Between grazing directions float has few digits.
        if (std::abs(V[i].z) < 0.05f || std::abs(g.L[i].z) < 0.05f) continue;
        // A walk goes where its pdf has nothing, and its value is there or not.
        if (estimated && std::min({g.fwd[i], g.rev[i], e.fwd[i], back.fwd[i]}) < 1e-6f) continue;
        EXPECT_NEAR(g.fwd[i] / e.fwd[i], 1, 5e-3);
        EXPECT_NEAR(back.rev[i] / g.fwd[i], 1, 5e-3);
        EXPECT_NEAR(back.fwd[i] / g.rev[i], 1, 5e-3);
        EXPECT_TRUE(estimated || std::abs(g.total[i].x / e.total[i].x - 1) < 5e-3f);

        ASSERT_EQ(point_host.lobes(V[i]), 1);
        const auto& f = point_host.list[0];
        const auto local = [&](const rm::Vec3& w) {
            return rm::Vec3(w.dot(f.x), w.dot(f.y), w.dot(f.z));
        };
        cl::color<float> weight;
        float reverse;
        const float pdf = f.lobe->evaluate(local(V[i]), local(g.L[i]), weight, &reverse);
        EXPECT_NEAR(pdf / e.fwd[i], 1, 1e-3);
        EXPECT_NEAR(reverse / e.rev[i], 1, 1e-3);
        EXPECT_TRUE(estimated || std::abs(weight.x * pdf / e.total[i].x - 1) < 1e-3f);
    }
    EXPECT_GT(valid, n / 4);
}

TEST(Interfaces, both_hosts_are_told_the_same)
{
    expect_hosts_agree(rough_glass);
    expect_hosts_agree(sheet);
    expect_hosts_agree(added_metal);
    expect_hosts_agree(walked_glass, true);
    expect_hosts_agree(walked_metal, true);
}

// By generate and by evaluate, through both hosts; the albedo of a walk is 1 on either side.
template <class Closure>
void expect_energy(const Closure& closure, double side, bool two_media, double expected)
{
    constexpr int n = 40000;
    Grid grid(closure, n);
    Point host(closure);
    const auto V = direction<float>(side, 1);
    std::fill(grid.host.V.begin(), grid.host.V.end(), V);
    ASSERT_EQ(host.lobes(V), 1);
    const auto& f = host.list[0];
    const auto local = [&](const rm::Vec3& w) {
        return rm::Vec3(w.dot(f.x), w.dot(f.y), w.dot(f.z));
    };
    Random random(9);
    std::vector<rm::Vec3> everywhere(n);
    for (auto& L : everywhere) L = anywhere(random);
    const Answers g = grid.generate(), e = grid.evaluate(everywhere);
    double sums[4] = {0, 0, 0, 0}, squares[4] = {0, 0, 0, 0};
    const auto add = [&](int k, double x) {
        sums[k] += x / n;
        squares[k] += x * x / n;
    };
    for (int i = 0; i < n; ++i)
    {
        const auto energy = [&](const rm::Vec3& L, double x) {
            return two_media ? x / factor(V, L) : x;
        };
        add(0, g.sampled[i].valid ? energy(g.L[i], g.total[i].x / g.fwd[i]) : 0);
        add(1, energy(everywhere[i], e.total[i].x * 4 * M_PI));
        rm::Vec3 wo;
        cl::color<float> weight;
        const float u = random.unit<float>(), v = random.unit<float>(), w = random.unit<float>();
        const bool valid = f.lobe->sample(local(V), u, v, w, wo, weight, nullptr) > 0;
        add(2, valid ? energy(f.x * wo.x + f.y * wo.y + f.z * wo.z, weight.x) : 0);
        const float pdf = f.lobe->evaluate(local(V), local(everywhere[i]), weight, nullptr);
        add(3, energy(everywhere[i], weight.x * pdf * 4 * M_PI));
    }
    for (int k = 0; k < 4; ++k)
    {
        const double error = std::sqrt(std::max(squares[k] - sums[k] * sums[k], 0.0) / n);
        EXPECT_NEAR(sums[k], expected, 5 * error + 2e-3) << k << " from " << side;
    }
}

TEST(Interfaces, furnace_through_both_hosts)
{
    for (const double side : {0.7, -0.7})
    {
        expect_energy(walked_glass, side, true, 1);
        const auto a = rough_glass.albedo(direction<float>(side, 1));
        expect_energy(rough_glass, side, true, a.reflect.x + a.transmit.x);
        const auto b = sheet.albedo(direction<float>(side, 1));
        expect_energy(sheet, side, false, b.reflect.x + b.transmit.x);
    }
    expect_energy(walked_metal, 0.7, false, 1);
    expect_energy(added_metal, 0.7, false, 1);
}

}  // namespace
