// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A material behind either adapter, and all that one call of its host returns.

#pragma once

#include "hosts.h"

#include <gtest/gtest.h>

namespace regain::tests {

/// What the batched host is told, by point.
struct GridAnswers
{
    explicit GridAnswers(int n)
        : sampled(n),
          evaluated(n),
          L(n, renderman::Vec3(0.0f)),
          total(n, renderman::Color3(0.0f)),
          compTrans(n),
          fwd(n, -7.0f),
          rev(n, -7.0f)
    {}
    std::vector<renderman::Lobe> sampled;
    std::vector<renderman::LobeSet> evaluated;
    std::vector<renderman::Vec3> L;
    std::vector<renderman::Color3> total, compTrans;
    std::vector<float> fwd, rev;
    std::vector<renderman::Lobe> slots;

    /// Mean of value over pdf.
    Imath::V3d estimate() const
    {
        Imath::V3d sum(0.0);
        for (std::size_t i = 0; i < total.size(); ++i)
            if (sampled[i].valid) sum += Imath::V3d(total[i]) / double(fwd[i]);
        return sum / double(total.size());
    }
};

template <class Material>
class GridCalls
{
public:
    using LobeSet = renderman::LobeSet;

    explicit GridCalls(const Material& m, int points = 1)
        : host(points, std::size_t(points) * 4096 + 65536), material(m), _points(points)
    {}

    /// The same point everywhere.
    GridCalls& at(const renderman::Vec3& V, const renderman::Vec3& N = {0, 0, 1},
                  const renderman::Vec3& Ng = {0, 0, 1})
    {
        std::fill(host.V.begin(), host.V.end(), V);
        std::fill(host.N.begin(), host.N.end(), N);
        std::fill(host.Ng.begin(), host.Ng.end(), Ng);
        return *this;
    }
    renderman::Bxdf* begin(LobeSet wanted = LobeSet::all())
    {
        host.reset();
        return factory.beginScatter(&host.ctx, wanted, renderman::ShadeMode::Scatter, nullptr,
                                    &material);
    }
    GridAnswers generate(const std::vector<LobeSet>& wanted, renderman::Rng* rng = nullptr,
                         LobeSet of_batch = LobeSet::all())
    {
        auto w = host.weights();
        return generate(wanted, w, rng, of_batch);
    }
    GridAnswers generate(LobeSet wanted = LobeSet::all(), renderman::Rng* rng = nullptr)
    {
        return generate(std::vector(std::size_t(_points), wanted), rng);
    }
    GridAnswers generate(const std::vector<LobeSet>& wanted, renderman::LobeWeights& w,
                         renderman::Rng* rng = nullptr, LobeSet of_batch = LobeSet::all())
    {
        GridAnswers a(_points);
        begin(of_batch)->generateSample(renderman::kAnyLighting, wanted.data(),
                                        rng ? rng : &host.rng, a.sampled.data(), a.L.data(), w,
                                        a.fwd.data(), a.rev.data(), a.compTrans.data());
        finish(a, w);
        return a;
    }
    GridAnswers evaluate(const std::vector<renderman::Vec3>& L, const std::vector<LobeSet>& wanted)
    {
        auto w = host.weights();
        return evaluate(L, wanted, w);
    }
    GridAnswers evaluate(const std::vector<renderman::Vec3>& L, const std::vector<LobeSet>& wanted,
                         renderman::LobeWeights& w)
    {
        GridAnswers a(_points);
        begin()->evaluateSample(renderman::kAnyLighting, wanted.data(), &host.rng,
                                a.evaluated.data(), L.data(), w, a.fwd.data(), a.rev.data());
        finish(a, w);
        return a;
    }
    GridAnswers evaluate(const std::vector<renderman::Vec3>& L, LobeSet wanted = LobeSet::all())
    {
        return evaluate(L, std::vector(std::size_t(_points), wanted));
    }
    GridAnswers evaluate(const renderman::Vec3& L, LobeSet wanted = LobeSet::all())
    {
        return evaluate(std::vector(std::size_t(_points), L), wanted);
    }
    renderman::Color3 albedo()
    {
        std::vector<renderman::Color3> all(static_cast<std::size_t>(_points));
        EXPECT_TRUE(begin()->albedo(all.data()));
        return all[0];
    }

    GridHost host;
    Material material;
    renderman::ClosureFactory<Material> factory;

private:
    void finish(GridAnswers& a, const renderman::LobeWeights& w) const
    {
        for (int i = 0; i < _points; ++i) a.total[std::size_t(i)] = w.total(i);
        for (int k = 0; k < w.active(); ++k) a.slots.push_back(w.lobe(k));
    }
    int _points;
};

/// What the one-point host is told.
template <class Real>
struct PointAnswer
{
    Real pdf = -7, reverse = -7;
    clarisse::color<Real> weight{Real(-7)};
    clarisse::vec3<Real> wo{Real(0)};  ///< in world space
    clarisse::color<Real> value() const { return weight * pdf; }
};

template <class Material, class RealType = float>
class PointCalls
{
public:
    using Real = RealType;
    using V3 = clarisse::vec3<Real>;

    explicit PointCalls(const Material& m) : material(m)
    {
        point.ng = point.ns = V3(0, 0, 1);
        point.tangent = V3(1, 0, 0);
    }
    PointCalls(const PointCalls&) = delete;
    PointCalls& operator=(const PointCalls&) = delete;

    /// Makes the lobes; whether they fit.
    bool make(const V3& view)
    {
        point.view = view;
        point.front_facing = view.dot(point.ng) > 0;
        _pad.reset();
        list = {};
        const auto callbacks = clarisse::closure_callbacks<Material, Real>();
        return callbacks.create_lobes(&material, point, _pad, list);
    }
    const clarisse::bxdf_lobe<Real>& lobe(int k = 0) const { return *list[k].lobe; }
    V3 local(const V3& w, int k = 0) const
    {
        const auto& e = list[k];
        return {w.dot(e.x), w.dot(e.y), w.dot(e.z)};
    }
    PointAnswer<Real> evaluate(const V3& L, int k = 0) const
    {
        PointAnswer<Real> a;
        a.pdf = lobe(k).evaluate(local(point.view, k), local(L, k), a.weight, &a.reverse);
        a.wo = L;
        return a;
    }
    PointAnswer<Real> sample(const V3& u, int k = 0) const
    {
        PointAnswer<Real> a;
        V3 wo(Real(0));
        a.pdf = lobe(k).sample(local(point.view, k), u.x, u.y, u.z, wo, a.weight, &a.reverse);
        const auto& e = list[k];
        a.wo = e.x * wo.x + e.y * wo.y + e.z * wo.z;
        return a;
    }
    clarisse::color<Real> albedo(int k = 0) const { return lobe(k).albedo(local(point.view, k)); }

    Material material;
    clarisse::shading_point<Real> point;
    clarisse::lobe_list<Real> list;

private:
    alignas(64) char _memory[1 << 15];
    clarisse::scratchpad _pad{_memory, sizeof _memory};
};

}  // namespace regain::tests
