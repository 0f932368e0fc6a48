// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Materials by vectors of floats against the same material one float at a time, for every closure
// and every instruction set that this machine has.

#include "../support/closures.h"
#include "../support/trapped.h"
#include "materials.h"

#include <regain/closures/host_queries.h>
#include <regain/closures/shading_frame.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <new>
#include <string>

using namespace regain;
using namespace regain::tests;
using shaders::InstructionSet;

namespace {

// Memory that is given back with it.
class Arena
{
public:
    ~Arena()
    {
        for (const auto& [p, alignment] : _all) ::operator delete(p, std::align_val_t(alignment));
    }
    WideMemory memory()
    {
        return {[](void* self, std::size_t bytes, std::size_t alignment) {
                    return static_cast<Arena*>(self)->allocate(bytes, alignment);
                },
                this};
    }

private:
    void* allocate(std::size_t bytes, std::size_t alignment)
    {
        void* p = ::operator new(bytes, std::align_val_t(alignment));
        _all.emplace_back(p, alignment);
        return p;
    }
    std::vector<std::pair<void*, std::size_t>> _all;
};

std::vector<InstructionSet> vector_sets()
{
    std::vector<InstructionSet> sets = shaders::instruction_sets();
    sets.erase(sets.begin());
    return sets;
}

// Null of what SSE4.2 leaves to floats: distributions with a tail.
const shaders::WideMaker* maker_of(const NamedMaterial& m, InstructionSet set)
{
    const shaders::WideMaker* maker = wide_maker(m.material, set);
    const auto* facets = std::get_if<shaders::MicrofacetMaterial>(&m.material);
    const bool left = set == InstructionSet::sse4_2 && facets && has_gamma(facets->distribution);
    EXPECT_EQ(maker == nullptr, left) << m.name << ", " << name(set);
    return maker;
}

// What one point answers.
struct Answer
{
    Color3<float> value, weight, reflect, transmit, gain;
    Vec3<float> wi;
    float pdf, sample_pdf;
    int event;
};

struct Case
{
    Vec3<float> wo, wi, u;
};

std::vector<Case> cases(int n, unsigned seed)
{
    Random random(seed);
    std::vector<Case> all;
    for (int i = 0; i < n; ++i)
    {
        const auto at = [&](bool below) {
            auto w = direction<float>(0.05 + 0.95 * random.unit(), 6.28 * random.unit());
            if (below) w.z = -w.z;
            return w;
        };
        const Vec3<float> wo = at(i % 4 == 3);
        Vec3<float> wi = at(i % 3 == 2);
        // Half of them near the mirror direction, where narrow lobes are.
        if (i % 2) wi = (Vec3<float>(-wo.x, -wo.y, wo.z) + wi * 0.2f).normalized();
        const float u = random.unit<float>(), v = random.unit<float>();
        all.push_back({wo, wi, {u, v, random.unit<float>()}});
    }
    return all;
}

// visit(closure) in floats.
template <class Visit>
auto with_closure_of(const shaders::ClosureTree::Material& material, const Visit& visit)
{
    if (const auto* plain = std::get_if<shaders::PlainMaterial>(&material))
        return plain->with_closure(1.0f, visit);
    return std::get<shaders::MicrofacetMaterial>(material).with_closure(1.0f, visit);
}

Answer scalar_answer(const shaders::ClosureTree::Material& material, const Case& c)
{
    const auto ask = [&](const auto& closure) {
        const auto prepared = closure.prepare(c.wo);
        const Sample<float> s = prepared.sample(c.u);
        const auto a = prepared.albedo();
        Answer r;
        r.value = evaluate(prepared, c.wi, c.u);
        r.pdf = prepared.pdf(c.wi);
        r.weight = s.weight;
        r.sample_pdf = s.pdf;
        r.wi = s.wi;
        r.event = (s.valid ? wide_valid : 0) | (s.delta ? wide_delta : 0) |
                  (s.transmitted ? wide_transmitted : 0);
        r.reflect = a.reflect;
        r.transmit = a.transmit;
        return r;
    };
    return with_closure_of(material, ask);
}

struct Results
{
    std::vector<Color3<float>> value, weight, reflect, transmit, gain;
    std::vector<Vec3<float>> wi;
    std::vector<float> pdf, sample_pdf;
    std::vector<std::uint8_t> event;

    explicit Results(std::size_t n)
        : value(n),
          weight(n),
          reflect(n),
          transmit(n),
          gain(n),
          wi(n),
          pdf(n),
          sample_pdf(n),
          event(n)
    {}
    Answer at(std::size_t i) const
    {
        return {value[i], weight[i], reflect[i],    transmit[i], gain[i],
                wi[i],    pdf[i],    sample_pdf[i], event[i]};
    }
};

Results wide_answers(const shaders::WideMaker& maker,
                     const shaders::ClosureTree::Material& material, const std::vector<Case>& all)
{
    const std::size_t n = all.size();
    std::vector<Vec3<float>> wo, wi, u;
    for (const Case& c : all)
    {
        wo.push_back(c.wo);
        wi.push_back(c.wi);
        u.push_back(c.u);
    }
    Arena arena;
    WideSurface surface;
    surface.V = ConstTriples3f::of(wo.data());
    const WidePoints* points =
        maker.prepare(material, 1.0f, static_cast<int>(n), surface, arena.memory());
    Results r(n);
    const WideSelection every{static_cast<int>(n), nullptr};
    points->eval(every, ConstTriples3f::of(wi.data()), ConstTriples3f::of(u.data()),
                 Triples3f::of(r.value.data()), r.pdf.data());
    points->sample(every, ConstTriples3f::of(u.data()),
                   {Triples3f::of(r.wi.data()), Triples3f::of(r.weight.data()), r.sample_pdf.data(),
                    r.event.data()});
    points->albedo(Triples3f::of(r.reflect.data()), Triples3f::of(r.transmit.data()));
    points->gain(Triples3f::of(r.gain.data()));
    return r;
}

float largest(const Vec3<float>& a)
{
    return std::max(std::abs(a.x), std::max(std::abs(a.y), std::abs(a.z)));
}
// Relative, of what is not next to nothing.
float apart(float a, float b, float least)
{
    return std::abs(a - b) / std::max(std::max(std::abs(a), std::abs(b)), least);
}
float apart(const Color3<float>& a, const Color3<float>& b, float least)
{
    return largest(a - b) / std::max(std::max(largest(a), largest(b)), least);
}

// 99 of 100 differences are at most `usual`, all are at most `most`.
struct Bound
{
    float usual, most;
};

class Differences
{
public:
    void add(float d) { _all.push_back(std::isfinite(d) ? d : 1e30f); }
    void expect_within(const Bound& bound, const std::string& what)
    {
        ASSERT_FALSE(_all.empty()) << what;
        std::sort(_all.begin(), _all.end());
        EXPECT_LE(_all[_all.size() * 99 / 100], bound.usual) << what << ", 99 of 100";
        EXPECT_LE(_all.back(), bound.most) << what;
    }

private:
    std::vector<float> _all;
};

TEST(WidePoints, answer_as_one_float_at_a_time)
{
    const auto all = cases(203, 7);
    for (const double alpha : {0.05, 0.3, 1.0})
        for (const NamedMaterial& m : wide_materials(alpha))
        {
            std::vector<Answer> expected;
            for (const Case& c : all) expected.push_back(scalar_answer(m.material, c));
            for (const InstructionSet set : vector_sets())
            {
                const std::string what =
                    m.name + ", alpha " + std::to_string(alpha) + ", " + std::string(name(set));
                const shaders::WideMaker* maker = maker_of(m, set);
                if (!maker) continue;
                const Results r = wide_answers(*maker, m.material, all);
                Differences eval, pdf, weight, wi, sample_pdf, albedo;
                int other_events = 0;
                for (std::size_t i = 0; i < all.size(); ++i)
                {
                    const Answer &x = expected[i], y = r.at(i);
                    eval.add(apart(x.value, y.value, 0.1f));
                    pdf.add(apart(x.pdf, y.pdf, 0.1f));
                    albedo.add(apart(x.reflect, y.reflect, 0.1f));
                    albedo.add(apart(x.transmit, y.transmit, 0.1f));
                    if (x.event != y.event)
                    {
                        ++other_events;
                        continue;
                    }
                    wi.add(largest(x.wi - y.wi));
                    weight.add(apart(x.weight, y.weight, 0.1f));
                    sample_pdf.add(apart(x.sample_pdf, y.sample_pdf, 0.1f));
                }
                // Sums of lobes hand on what is left of a random number, stretched, and STD's tries
                // are decided by a hash of it: rounding may pick another sample.
                const bool other_samples = m.name.find(", std, ") != std::string::npos &&
                                           (m.name.find("kulla") != std::string::npos ||
                                            m.name.find("tail") != std::string::npos ||
                                            m.name.find("burley") != std::string::npos);
                EXPECT_LE(other_events, other_samples ? 10 : 0) << what;
                eval.expect_within({1e-5f, 1e-4f}, "eval of " + what);
                pdf.expect_within({1e-5f, 1e-3f}, "pdf of " + what);
                albedo.expect_within({1e-5f, 1e-4f}, "albedo of " + what);
                if (other_samples) continue;
                wi.expect_within({1e-5f, 1e-5f}, "direction of " + what);
                // Along the surface a direction's last digit is its cosine.
                weight.expect_within({1e-5f, 1e-3f}, "weight of " + what);
                sample_pdf.expect_within({1e-5f, 1.5e-3f}, "pdf of samples of " + what);
            }
        }
}

// Kept small: one of every kind of closure.
std::vector<NamedMaterial> some_materials()
{
    std::vector<NamedMaterial> some;
    for (NamedMaterial& m : wide_materials(0.4, 0.1))
        if (m.name.find("ggx, turquin") != std::string::npos ||
            m.name.find("ggx, balanced") != std::string::npos ||
            m.name.find("ggx, tail") != std::string::npos ||
            m.name.find("std, walk") != std::string::npos ||
            m.name.find("ggx, walk") != std::string::npos || m.name.find("plain") == 0)
            some.push_back(m);
    return some;
}

template <class T>
bool same_bits(const T& a, const T& b)
{
    return std::memcmp(&a, &b, sizeof(T)) == 0;
}

// A point's answer is the same whichever points it is computed with, and in which order: pictures
// would differ by how they are cut into tiles.
TEST(WidePoints, bits_do_not_depend_on_the_company)
{
    const auto all = cases(150, 3);
    for (const InstructionSet set : vector_sets())
        for (const NamedMaterial& m : some_materials())
        {
            const std::string what = m.name + ", " + std::string(name(set));
            if (!maker_of(m, set)) continue;
            const shaders::WideMaker& maker = *maker_of(m, set);
            const Results together = wide_answers(maker, m.material, all);

            // Fewer points.
            for (const std::size_t n : {1u, 5u, 17u})
            {
                const Results few = wide_answers(maker, m.material, {all.begin(), all.begin() + n});
                for (std::size_t i = 0; i < n; ++i)
                {
                    EXPECT_TRUE(same_bits(few.value[i], together.value[i])) << what;
                    EXPECT_TRUE(same_bits(few.wi[i], together.wi[i])) << what;
                    EXPECT_TRUE(same_bits(few.weight[i], together.weight[i])) << what;
                    EXPECT_TRUE(same_bits(few.pdf[i], together.pdf[i])) << what;
                }
            }

            // Entries in disorder: some points twice, some a hundred times in a row, some not.
            std::vector<Vec3<float>> wo, wi, u;
            for (const Case& c : all) wo.push_back(c.wo);
            std::vector<int> at;
            Random random(5);
            for (int i = 0; i < 130; ++i) at.push_back(static_cast<int>(random.unit() * 150));
            at.insert(at.end(), 100, 37);
            for (int i = 149; i >= 0; i -= 3) at.push_back(i);
            for (const int i : at)
            {
                wi.push_back(all[static_cast<std::size_t>(i)].wi);
                u.push_back(all[static_cast<std::size_t>(i)].u);
            }
            Arena arena;
            WideSurface surface;
            surface.V = ConstTriples3f::of(wo.data());
            const WidePoints* points =
                maker.prepare(m.material, 1.0f, 150, surface, arena.memory());
            Results r(at.size());
            const WideSelection entries{static_cast<int>(at.size()), at.data()};
            points->eval(entries, ConstTriples3f::of(wi.data()), ConstTriples3f::of(u.data()),
                         Triples3f::of(r.value.data()), r.pdf.data());
            points->sample(entries, ConstTriples3f::of(u.data()),
                           {Triples3f::of(r.wi.data()), Triples3f::of(r.weight.data()),
                            r.sample_pdf.data(), r.event.data()});
            for (std::size_t j = 0; j < at.size(); ++j)
            {
                const auto i = static_cast<std::size_t>(at[j]);
                EXPECT_TRUE(same_bits(r.value[j], together.value[i])) << what << ", entry " << j;
                EXPECT_TRUE(same_bits(r.pdf[j], together.pdf[i])) << what << ", entry " << j;
                EXPECT_TRUE(same_bits(r.wi[j], together.wi[i])) << what << ", entry " << j;
                EXPECT_TRUE(same_bits(r.weight[j], together.weight[i])) << what << ", entry " << j;
                EXPECT_EQ(r.event[j], together.event[i]) << what << ", entry " << j;
            }
        }
}

// A call about the first few points writes no more than their answers.
TEST(WidePoints, the_first_points_alone)
{
    const auto all = cases(43, 17);
    const std::size_t few = 21;
    const Color3<float> untouched(-7.0f);
    for (const InstructionSet set : vector_sets())
        for (const NamedMaterial& m : some_materials())
        {
            if (!maker_of(m, set)) continue;
            const shaders::WideMaker& maker = *maker_of(m, set);
            const Results expected = wide_answers(maker, m.material, all);
            std::vector<Vec3<float>> wo, wi, u;
            for (const Case& c : all)
            {
                wo.push_back(c.wo);
                wi.push_back(c.wi);
                u.push_back(c.u);
            }
            Arena arena;
            WideSurface surface;
            surface.V = ConstTriples3f::of(wo.data());
            const WidePoints* points =
                maker.prepare(m.material, 1.0f, int(all.size()), surface, arena.memory());
            std::vector<Color3<float>> value(all.size(), untouched), weight(all.size(), untouched);
            const WideSelection first{int(few), nullptr};
            points->eval(first, ConstTriples3f::of(wi.data()), ConstTriples3f::of(u.data()),
                         Triples3f::of(value.data()), nullptr);
            points->sample(first, ConstTriples3f::of(u.data()),
                           {{}, Triples3f::of(weight.data()), nullptr, nullptr});
            for (std::size_t i = 0; i < all.size(); ++i)
            {
                const bool asked = i < few;
                EXPECT_TRUE(same_bits(value[i], asked ? expected.value[i] : untouched)) << m.name;
                EXPECT_TRUE(same_bits(weight[i], asked ? expected.weight[i] : untouched)) << m.name;
            }
        }
}

// Arrays of each component are the same as one array of all three.
TEST(WidePoints, strides_change_nothing)
{
    const auto all = cases(43, 11);
    const std::size_t n = all.size();
    const NamedMaterial m = some_materials().front();
    for (const InstructionSet set : vector_sets())
    {
        const Results expected = wide_answers(*wide_maker(m.material, set), m.material, all);
        std::vector<float> wo(3 * n), wi(3 * n), value(3 * n);
        for (std::size_t i = 0; i < n; ++i)
            for (int k = 0; k < 3; ++k)
            {
                wo[static_cast<std::size_t>(k) * n + i] = all[i].wo[k];
                wi[static_cast<std::size_t>(k) * n + i] = all[i].wi[k];
            }
        const auto apart_each = [n](float* p) { return Triples3f{p, p + n, p + 2 * n, 1}; };
        const auto view = [&](const std::vector<float>& v) {
            return ConstTriples3f{v.data(), v.data() + n, v.data() + 2 * n, 1};
        };
        Arena arena;
        WideSurface surface;
        surface.V = view(wo);
        const WidePoints* points =
            wide_maker(m.material, set)->prepare(m.material, 1.0f, int(n), surface, arena.memory());
        points->eval({int(n), nullptr}, view(wi), {}, apart_each(value.data()), nullptr);
        for (std::size_t i = 0; i < n; ++i)
            EXPECT_TRUE(same_bits(Color3<float>(value[i], value[n + i], value[2 * n + i]),
                                  expected.value[i]));
    }
}

// In world space: bumped normals, back faces, and radiance across an interface.
TEST(WidePoints, frames_are_those_of_one_float_at_a_time)
{
    Random random(9);
    constexpr std::size_t n = 203;
    std::vector<Vec3<float>> V, N, Ng, T, L, u;
    for (std::size_t i = 0; i < n; ++i)
    {
        const auto any = [&] {
            auto w = direction<float>(2 * random.unit() - 1, 6.28 * random.unit());
            return w.normalized();
        };
        Ng.push_back(any());
        N.push_back((Ng.back() + any() * 0.3f).normalized());
        V.push_back(any());
        T.push_back(i % 7 ? any() : N.back());
        L.push_back(any());
        const float x = random.unit<float>(), y = random.unit<float>();
        u.emplace_back(x, y, random.unit<float>());
    }
    for (const NamedMaterial& m : some_materials())
    {
        if (m.name.find("walk") != std::string::npos) continue;  // the same code around them
        for (const InstructionSet set : vector_sets())
        {
            const std::string what = m.name + ", " + std::string(name(set));
            const shaders::WideMaker* maker = maker_of(m, set);
            if (!maker) continue;
            const auto ask = [&](const auto& closure) {
                const bool two_media = is_interface(closure);
                Arena arena;
                WideSurface surface;
                surface.V = ConstTriples3f::of(V.data());
                surface.N = ConstTriples3f::of(N.data());
                surface.Ng = ConstTriples3f::of(Ng.data());
                surface.T = ConstTriples3f::of(T.data());
                surface.facing = !two_media;
                surface.radiance = true;
                const WidePoints* points =
                    maker->prepare(m.material, 1.0f, int(n), surface, arena.memory());
                Results r(n);
                points->eval({int(n), nullptr}, ConstTriples3f::of(L.data()),
                             ConstTriples3f::of(u.data()), Triples3f::of(r.value.data()),
                             r.pdf.data());
                points->sample({int(n), nullptr}, ConstTriples3f::of(u.data()),
                               {Triples3f::of(r.wi.data()), Triples3f::of(r.weight.data()),
                                r.sample_pdf.data(), r.event.data()});
                int black = 0;
                for (std::size_t i = 0; i < n; ++i)
                {
                    using Frame = ShadingFrame<float>;
                    const Frame frame = two_media ? Frame::of(N[i], Ng[i], T[i])
                                                  : Frame::facing(V[i], N[i], Ng[i], T[i]);
                    const auto prepared = closure.prepare(frame.known(V[i]));
                    const auto wi = frame.known(L[i]);
                    const auto f = evaluate(prepared, wi, u[i]) *
                                   radiance_factor<std::decay_t<decltype(closure)>, float>(
                                       closure, prepared.wo(), wi);
                    EXPECT_LT(apart(f, r.value[i], 0.1f), 1e-4f) << what;
                    EXPECT_LT(apart(prepared.pdf(wi), r.pdf[i], 0.1f), 1e-4f) << what;
                    black += r.value[i] == Color3<float>(0.0f);
                    const auto s = prepared.sample(u[i]);
                    const auto to = frame.to_world(s.wi);
                    const bool valid = s.valid && frame.is_on_its_side(to, s.wi);
                    EXPECT_EQ(valid, bool(r.event[i] & wide_valid)) << what;
                    if (!valid) continue;
                    // Of a V along the normal, the azimuth is a last digit.
                    EXPECT_LT(largest(to - r.wi[i]), 1e-3f) << what;
                    const auto w =
                        s.weight * radiance_factor<std::decay_t<decltype(closure)>, float>(
                                       closure, prepared.wo(), s.wi);
                    EXPECT_LT(apart(w, r.weight[i], 0.1f), 1e-3f) << what;
                }
                EXPECT_GT(black, 10) << what;
            };
            with_closure_of(m.material, ask);
        }
    }
}

// Garbage in any lane gives finite answers there and changes no other lane; nothing traps.
TEST(WidePoints, hostile_directions_and_numbers)
{
    const float inf = std::numeric_limits<float>::infinity(),
                nan = std::numeric_limits<float>::quiet_NaN();
    const Vec3<float> garbage[] = {{nan, 0, 1},   {inf, 0, 0},     {0, 0, 0},       {0, 0, 1e-30f},
                                   {1, 0, 0},     {0, 0, -1},      {nan, nan, nan}, {1e30f, 0, 1},
                                   {0, 1, 1e-7f}, {-inf, inf, nan}};
    auto all = cases(101, 13);
    for (std::size_t i = 0; i < all.size(); i += 3)
    {
        const Vec3<float>& g = garbage[i / 3 % std::size(garbage)];
        if (i % 2) all[i].wo = g;
        if (i % 4) all[i].wi = g;
        all[i].u = g;
    }
    const auto sane = [](const Vec3<float>& c) {
        return std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z) && c.x >= 0 &&
               c.y >= 0 && c.z >= 0;
    };
    for (const double alpha : {0.0, 0.2, 1.0})
        for (const NamedMaterial& m : wide_materials(alpha))
            for (const InstructionSet set : vector_sets())
            {
                if (set == InstructionSet::avx512 && alpha > 0.5) continue;
                const std::string what = m.name + ", " + std::string(name(set));
                const shaders::WideMaker* maker = maker_of(m, set);
                if (!maker) continue;
                const Trapped trapped;
                const Results r = wide_answers(*maker, m.material, all);
                for (std::size_t i = 0; i < all.size(); ++i)
                {
                    EXPECT_TRUE(sane(r.value[i]) && sane(r.weight[i]) && sane(r.reflect[i]) &&
                                sane(r.transmit[i]) && sane(r.gain[i]))
                        << what << ", " << all[i].wo << " " << all[i].wi << " " << all[i].u;
                    EXPECT_TRUE(std::isfinite(r.pdf[i]) && r.pdf[i] >= 0) << what;
                    EXPECT_NEAR(r.wi[i].length(), 1, 1e-5) << what;
                }
            }
}

TEST(WidePoints, memory_that_is_spent_gives_nothing)
{
    const NamedMaterial m = some_materials().front();
    const Vec3<float> up(0, 0, 1);
    WideSurface surface;
    surface.V = ConstTriples3f::of(&up);
    const WideMemory none{[](void*, std::size_t, std::size_t) -> void* { return nullptr; },
                          nullptr};
    for (const InstructionSet set : vector_sets())
        EXPECT_EQ(wide_maker(m.material, set)->prepare(m.material, 1.0f, 1, surface, none),
                  nullptr);
}

TEST(WidePoints, the_widest_set_is_taken_and_names_are_known)
{
    const auto& sets = shaders::instruction_sets();
    ASSERT_FALSE(sets.empty());
    EXPECT_EQ(sets.front(), InstructionSet::scalar);
    for (const InstructionSet set : sets) EXPECT_EQ(shaders::instruction_set_named(name(set)), set);
    EXPECT_EQ(shaders::instruction_set_named("avx3"), std::nullopt);
    const NamedMaterial m = some_materials().front();
    EXPECT_EQ(wide_maker(m.material, InstructionSet::scalar), nullptr);
    int lanes = 1;
    for (const InstructionSet set : vector_sets())
    {
        EXPECT_GT(wide_maker(m.material, set)->lanes, lanes);
        lanes = wide_maker(m.material, set)->lanes;
    }
}

}  // namespace
