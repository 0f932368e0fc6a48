// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Materials by vectors of floats against the same material one float at a time, for every closure
// and every instruction set that this machine has.

#include "../support/closures.h"
#include "materials.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
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

Answer scalar_answer(const shaders::ClosureTree::Material& material, const Case& c)
{
    const auto ask = [&](const auto& closure) {
        const auto prepared = closure.prepare(c.wo);
        const auto s = prepared.sample(c.u);
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
    if (const auto* plain = std::get_if<shaders::PlainMaterial>(&material))
        return plain->with_closure(1.0f, ask);
    return std::get<shaders::MicrofacetMaterial>(material).with_closure(1.0f, ask);
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
    const auto all = cases(83, 7);
    for (const double alpha : {0.05, 0.3, 1.0})
        for (const NamedMaterial& m : wide_materials(alpha))
        {
            std::vector<Answer> expected;
            for (const Case& c : all) expected.push_back(scalar_answer(m.material, c));
            for (const InstructionSet set : vector_sets())
            {
                const std::string what =
                    m.name + ", alpha " + std::to_string(alpha) + ", " + std::string(name(set));
                const Results r = wide_answers(*wide_maker(m.material, set), m.material, all);
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
                EXPECT_EQ(other_events, 0) << what;
                eval.expect_within({1e-5f, 1e-4f}, "eval of " + what);
                pdf.expect_within({1e-5f, 1e-3f}, "pdf of " + what);
                wi.expect_within({1e-5f, 1e-5f}, "direction of " + what);
                // Along the surface a direction's last digit is its cosine.
                weight.expect_within({1e-5f, 1e-3f}, "weight of " + what);
                sample_pdf.expect_within({1e-5f, 1e-3f}, "pdf of samples of " + what);
                albedo.expect_within({1e-5f, 1e-4f}, "albedo of " + what);
            }
        }
}

}  // namespace
