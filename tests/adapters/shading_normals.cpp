// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Shading normals that are not the surface's: both adapters do what shading_frame.h says, and so
// the same.

#include "../support/hosts.h"
#include "../support/interfaces.h"

#include <regain/closures/dielectric.h>
#include <regain/closures/oren_nayar_diffuse.h>

#include <gtest/gtest.h>

using namespace regain;
using namespace regain::tests;

namespace {

namespace rm = regain::renderman;
namespace cl = regain::clarisse;
using V3 = Imath::V3f;

struct Place
{
    V3 V, N, Ng, T;
};

struct Answer
{
    Imath::C3f value{0.0f};
    float pdf = 0, reverse = 0;
};

// One closure behind both adapters, one point at a time.
template <class Closure>
class Hosts
{
public:
    explicit Hosts(const Closure& closure) : _material{closure}, _grid(1) {}

    Answer renderman(const Place& p, const V3& L)
    {
        begin(p);
        Answer a;
        auto w = _grid.weights();
        const auto wanted = rm::LobeSet::all();
        rm::LobeSet evaluated;
        _bxdf->evaluateSample(rm::kDirect, &wanted, &_grid.rng, &evaluated, &L, w, &a.pdf,
                              &a.reverse);
        a.value = w.total(0);
        EXPECT_EQ(evaluated.any(), a.pdf > 0);
        return a;
    }
    // Many of one place: L[i] where there is a sample, 0 where not.
    std::vector<V3> sampled(const Place& p, int n)
    {
        begin(p);
        std::vector<V3> all;
        for (int i = 0; i < n; ++i)
        {
            auto w = _grid.weights();
            const auto wanted = rm::LobeSet::all();
            rm::Lobe lobe;
            V3 L(0.0f);
            float fwd, rev;
            _bxdf->generateSample(rm::kAnyLighting, &wanted, &_grid.rng, &lobe, &L, w, &fwd, &rev,
                                  nullptr);
            all.push_back(lobe.valid ? L : V3(0.0f));
            EXPECT_EQ(lobe.valid, fwd > 0);
            EXPECT_TRUE(!lobe.valid || lobe.reflect == (L.dot(p.Ng) * p.V.dot(p.Ng) > 0));
        }
        return all;
    }
    Answer clarisse(const Place& p, const V3& L)
    {
        cl::shading_point<float> point;
        point.ng = p.Ng;
        point.ns = p.N;
        point.tangent = p.T;
        point.view = p.V;
        point.front_facing = p.Ng.dot(p.V) > 0;
        cl::scratchpad pad(_memory, sizeof _memory);
        cl::lobe_list<float> list;
        EXPECT_TRUE((cl::closure_callbacks<ClosureMaterial<Closure>, float>().create_lobes(
            &_material, point, pad, list)));
        const auto& e = list[0];
        const auto local = [&](const V3& w) { return V3(w.dot(e.x), w.dot(e.y), w.dot(e.z)); };
        Answer a;
        Imath::C3f weight(0.0f);
        a.pdf = e.lobe->evaluate(local(p.V), local(L), weight, &a.reverse);
        a.value = weight * a.pdf;
        // Sampled, it stays on the side that its event and the true normal say.
        V3 wo;
        if (e.lobe->sample(local(p.V), 0.3f, 0.6f, 0.4f, wo, weight, nullptr) > 0)
        {
            const V3 world = e.x * wo.x + e.y * wo.y + e.z * wo.z;
            EXPECT_EQ(world.dot(p.Ng) * p.V.dot(p.Ng) > 0, wo.z * local(p.V).z > 0);
        }
        _albedo = e.lobe->albedo(local(p.V)).x;
        return a;
    }
    float clarisse_albedo() const { return _albedo; }
    float renderman_albedo(const Place& p)
    {
        begin(p);
        rm::Color3 a;
        EXPECT_TRUE(_bxdf->albedo(&a));
        return a.x;
    }

private:
    void begin(const Place& p)
    {
        _grid.reset();
        _grid.V[0] = p.V;
        _grid.N[0] = p.N;
        _grid.Ng[0] = p.Ng;
        _grid.T[0] = p.T;
        _bxdf = _factory.beginScatter(&_grid.ctx, rm::LobeSet::all(), rm::ShadeMode::Scatter,
                                      nullptr, &_material);
    }

    ClosureMaterial<Closure> _material;
    rm::ClosureFactory<ClosureMaterial<Closure>> _factory;
    GridHost _grid;
    rm::Bxdf* _bxdf = nullptr;
    alignas(64) char _memory[8192];
    float _albedo = 0;
};
template <class Closure>
Hosts(Closure) -> Hosts<Closure>;

V3 anywhere(Random& random)
{
    return direction<float>(2 * random.unit() - 1, 2 * M_PI * random.unit());
}

const OrenNayarDiffuse<float> dull(Imath::C3f(0.8f), 0.5f);
const auto metal = compensated(artists_gold<float>(0.6, 0.2), Method::turquin, luts::ggx_tables());
const Dielectric<GGX<float>> glass(GGX<float>(0.5f, 0.3f), 1.5f);

// The rule by itself, from the vectors: `two_media` is not turned.
template <class Closure>
Answer expected(const Closure& closure, const Place& p, const V3& L, bool two_media)
{
    const float side = !two_media && p.Ng.dot(p.V) < 0 ? -1.0f : 1.0f;
    const V3 z = p.N * side, x = (p.T - z * z.dot(p.T)).normalized(), y = z.cross(x);
    const auto local = [&](const V3& w) { return V3(w.dot(x), w.dot(y), w.dot(z)); };
    const V3 wo = local(p.V), wi = local(L);
    const auto above = [&](const V3& w) { return p.Ng.dot(w) * side > 0; };
    Answer a;
    if ((wo.z > 0) != above(p.V) || (wi.z > 0) != above(L)) return a;
    a.pdf = closure.pdf(wo, wi);
    a.reverse = closure.pdf(wi, wo);
    const float eta = two_media ? 1.5f : 1.0f;
    const float scale = (wo.z > 0) == (wi.z > 0) ? 1 : wo.z > 0 ? 1 / (eta * eta) : eta * eta;
    a.value = closure.eval(wo, wi) * scale;
    return a;
}

void expect_near(const Answer& a, const Answer& b)
{
    const auto near = [](float x, float y) {
        EXPECT_TRUE(std::isfinite(x));
        EXPECT_NEAR(x, y, 2e-4f * (1 + std::abs(y)));
    };
    near(a.pdf, b.pdf);
    near(a.reverse, b.reverse);
    for (int c = 0; c < 3; ++c) near(a.value[c], b.value[c]);
}

// True cosines from grazing on, from both sides; normals bent by up to `bend`.
template <class Closure>
void expect_one_rule(const Closure& closure, bool two_media)
{
    Hosts hosts(closure);
    Random random(11);
    int lost_V = 0, lost_L = 0, values = 0;
    for (int i = 0; i < 1500; ++i)
    {
        Place p;
        p.Ng = anywhere(random);
        p.T = anywhere(random);
        const V3 x = (p.T - p.Ng * p.Ng.dot(p.T)).normalized(), y = p.Ng.cross(x);
        const auto about = [&](double mu, double phi) {
            const V3 w = direction<float>(mu, phi);
            return x * w.x + y * w.y + p.Ng * w.z;
        };
        const double grazing = 0.01 + 0.99 * random.unit() * random.unit() * random.unit();
        p.V = about(i % 2 ? grazing : -grazing, 7 * random.unit());
        p.N = about(0.3 + 0.7 * random.unit(), 7 * random.unit());
        const V3 L = anywhere(random);
        // Rounding may tell the sides of a horizon differently.
        const float least = 1e-4f;
        if (std::abs(p.N.dot(p.V)) < 1e-2f || std::abs(p.N.dot(L)) < 1e-2f ||
            std::abs(p.Ng.dot(L)) < least)
            continue;
        const Answer e = expected(closure, p, L, two_media), a = hosts.renderman(p, L),
                     b = hosts.clarisse(p, L);
        expect_near(a, e);
        expect_near(b, e);
        const bool black = (p.N.dot(p.V) > 0) != (p.Ng.dot(p.V) > 0);
        lost_V += black;
        lost_L += (p.N.dot(L) > 0) != (p.Ng.dot(L) > 0);
        values += e.pdf > 0;
        EXPECT_EQ(hosts.clarisse_albedo() == 0, black);
        EXPECT_EQ(hosts.renderman_albedo(p) == 0, black);
        EXPECT_TRUE(!black || hosts.sampled(p, 1)[0] == V3(0.0f));
    }
    // All of the cases are there.
    EXPECT_GT(lost_V, 100);
    EXPECT_GT(lost_L, 100);
    EXPECT_GT(values, 200);
}

TEST(ShadingNormals, are_one_rule_in_both_adapters)
{
    expect_one_rule(dull, false);
    expect_one_rule(metal, false);
    expect_one_rule(glass, true);
}

// Nothing is sampled nor evaluated that has not the side which its lobe says; what is lost with the
// others stays lost: the pdf is what it is without them, and integrates to the share of samples.
template <class Closure>
void expect_no_leak(const Closure& closure, bool two_media)
{
    Hosts hosts(closure);
    for (const float front : {1.0f, -1.0f})
    {
        const Place p{
            direction<float>(0.3, 0.1) * front, direction<float>(0.5, 0.0), {0, 0, 1}, {0, 1, 0}};
        Place flat = p;
        flat.Ng = p.N;
        constexpr int n = 4000;
        int valid = 0, valid_flat = 0;
        for (const V3& L : hosts.sampled(flat, n)) valid_flat += L != V3(0.0f);
        for (const V3& L : hosts.sampled(p, n))
        {
            valid += L != V3(0.0f);
            EXPECT_TRUE(two_media || L.z * front >= 0);
        }
        EXPECT_LT(valid, valid_flat - 50);
        // A spiral that fills the sphere evenly.
        double pdf = 0;
        constexpr int m = 12000;
        for (int i = 0; i < m; ++i)
        {
            const V3 L = direction<float>(1 - (2 * i + 1.0) / m, i * M_PI * (3 - std::sqrt(5.0)));
            const Answer a = hosts.renderman(p, L);
            pdf += a.pdf * 4 * M_PI / m;
            EXPECT_TRUE(two_media || L.z * front > 0 || (a.pdf == 0 && a.value == V3(0.0f)));
        }
        EXPECT_NEAR(pdf, double(valid) / n, 0.025);  // 3 standard errors
    }
}

TEST(ShadingNormals, leak_no_light_and_give_its_pdf_to_nobody)
{
    expect_no_leak(dull, false);
    expect_no_leak(metal, false);
    expect_no_leak(glass, true);
}

// A viewer that the surface sees and its bump does not.
template <class Closure>
void expect_black_beyond_the_horizon(const Closure& closure)
{
    Hosts hosts(closure);
    for (const float mu : {1e-7f, 1e-4f, 0.05f, 0.2f})
        for (const float side : {1.0f, -1.0f})
        {
            const Place p{direction<float>(mu, M_PI) * side,
                          direction<float>(0.5, 0.0),
                          {0, 0, 1},
                          {1, 0, 0}};
            for (const V3& L : {direction<float>(0.9), direction<float>(-0.9), p.V, -p.V, p.N})
                for (const Answer& a : {hosts.renderman(p, L), hosts.clarisse(p, L)})
                {
                    EXPECT_EQ(a.pdf, 0);
                    EXPECT_EQ(a.reverse, 0);
                    EXPECT_EQ(a.value, Imath::C3f(0.0f));
                }
            EXPECT_EQ(hosts.clarisse_albedo(), 0);
            EXPECT_EQ(hosts.renderman_albedo(p), 0);
            for (const V3& L : hosts.sampled(p, 20)) EXPECT_EQ(L, V3(0.0f));
        }
}

TEST(ShadingNormals, are_black_and_not_nan_beyond_the_bumped_horizon)
{
    expect_black_beyond_the_horizon(dull);
    expect_black_beyond_the_horizon(metal);
    expect_black_beyond_the_horizon(glass);
}

// Turned over with both its normals, a surface that only reflects is the same; an interface is
// inside out.
TEST(ShadingNormals, back_faces_have_the_bumps_of_front_faces)
{
    const V3 V = direction<float>(0.6, 0.4), L = direction<float>(0.5, 3);
    const Place front{V, direction<float>(0.9, 1.0), {0, 0, 1}, {1, 0, 0}};
    Place back = front;
    back.N = -front.N;
    back.Ng = -front.Ng;
    Hosts metals(metal);
    const Answer from_front = metals.renderman(front, L);
    EXPECT_GT(from_front.pdf, 0);
    expect_near(metals.renderman(back, L), from_front);
    expect_near(metals.clarisse(back, L), from_front);
    Hosts glasses(glass);
    const Answer outside = glasses.renderman(front, L), inside = glasses.renderman(back, L);
    EXPECT_GT(std::abs(inside.value.x / outside.value.x - 1), 0.05f);
    expect_near(glasses.clarisse(back, L), inside);
}

// One layer over another: what the host leaves out still casts the shadow that it has here, which
// beyond the bumped horizon is none.
struct Coated
{
    int lobes() const { return 2; }
    template <class Real, class Visit>
    decltype(auto) with_lobe(int k, Real, const Visit& visit) const
    {
        return k == 0 ? visit(LambertInterface<Real>(Real(1.5), Real(0.5)))
                      : visit(LambertInterface<Real>(Real(1), Real(0.5)));
    }
    template <class Real>
    Color3<Real> lobe_weights(const Color3<Real>* albedo, Color3<Real>* weight) const
    {
        weight[0] = Color3<Real>(Real(1));
        weight[1] = Color3<Real>(Real(1)) - albedo[0];
        return albedo[0] + weight[1] * albedo[1];
    }
    const char* lobe_name(int) const { return "coat"; }
};

TEST(ShadingNormals, cast_the_same_shadow_whether_or_not_a_lobe_is_wanted)
{
    alignas(64) char memory[8192];
    cl::shading_point<float> point;
    point.ng = V3(0, 0, 1);
    point.ns = direction<float>(0.5, 0.0);
    point.tangent = V3(1, 0, 0);
    point.view = direction<float>(0.1, M_PI);
    const Coated coated;
    const auto add_all = [&](std::uint32_t wanted, std::uint32_t of_first) {
        cl::scratchpad pad(memory, sizeof memory);
        cl::lobe_list<float> list;
        const auto add = [&](int k, cl::PendingLobes<float>& pending, Imath::C3f* albedo) {
            point.wanted = k == 0 ? of_first : wanted;
            return coated.with_lobe(k, 1.0f, [&](const auto& c) {
                return cl::add_lobes(c, k, "coat", point, pad, pending, albedo);
            });
        };
        const auto weigh = [&](const Imath::C3f* albedo, Imath::C3f* weight) {
            coated.lobe_weights(albedo, weight);
        };
        EXPECT_TRUE(cl::assemble_lobes<float>(2, add, weigh, list));
        return list[list.size() - 1].weight.x;
    };
    const std::uint32_t all = cl::all_lobes, none = 0;
    EXPECT_EQ(add_all(all, all), 1);
    EXPECT_EQ(add_all(all, none), 1);
}

}  // namespace
