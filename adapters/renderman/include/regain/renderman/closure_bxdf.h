// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Any material whose closure answers as in <regain/closures/closure.h>, behind the batched
/// interface of host.h. A material is what <regain/shaders/material.h> describes; the instance data
/// of beginScatter is a `const Material*`.
///
/// What is expensive happens in beginScatter: the frame of each point, its prepared closure and so
/// its gain. On a light path the gain is taken at Ln, the eye's side: a gain of one direction is
/// not reciprocal, and the path from the eye is the one to agree with.
///
/// The frame of a closure that only reflects is turned to the viewer. That of an interface between
/// two media keeps the surface's own normals, +z outside; what is transmitted to a viewer's path
/// holds (n_V / n_L)^2, closures themselves knowing energy alone. A sample goes where its lobe says
/// only if the geometric normal agrees; the share of the pdf that is lost with the others is not
/// given to anyone.
///
/// A closure whose eval is an estimate takes its random numbers from the host's generator.

#pragma once

#include <regain/closures/host_queries.h>
#include <regain/closures/random_stream.h>
#include <regain/renderman/host.h>

#include <new>

REGAIN_NAMESPACE_BEGIN
namespace renderman {

/// Light path expressions know these slots as Specular and Glass: what only reflects goes to the
/// first, both lobes of an interface go to the second.
constexpr std::uint8_t kSpecularSlot = 1, kGlassSlot = 7;

/// Orthonormal shading frame.
struct Frame
{
    Vec3 x, y, z, geometric;

    /// On the side of the viewer: both normals are turned to the side of V, Ng first, because which
    /// side the viewer is on is a matter of geometry.
    static Frame facing(const Vec3& V, const Vec3& N, const Vec3& Ng, const Vec3& T)
    {
        return Ng.dot(V) < 0 ? Frame::of(-N, -Ng, T) : Frame::of(N, Ng, T);
    }

    /// As the normals are. N and Ng are unit; T is any direction, used where it is not parallel to
    /// N.
    static Frame of(const Vec3& N, const Vec3& Ng, const Vec3& T)
    {
        Frame f;
        f.geometric = Ng;
        f.z = N;
        Vec3 t = T - f.z * f.z.dot(T);
        if (!(t.dot(t) > 1e-12f))
        {
            const Vec3 axis = f.z.x * f.z.x < 0.5f ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
            t = axis - f.z * f.z.dot(axis);
        }
        f.x = t * (1.0f / std::sqrt(t.dot(t)));
        f.y = f.z.cross(f.x);
        return f;
    }

    Vec3 to_local(const Vec3& w) const { return {w.dot(x), w.dot(y), w.dot(z)}; }
    Vec3 to_world(const Vec3& w) const { return x * w.x + y * w.y + z * w.z; }
};

/// The scattering of a batch whose points share one closure.
template <class Closure>
class ClosureBxdf final : public Bxdf
{
public:
    /// Null when the arena is spent.
    static ClosureBxdf* create(const ShadingContext* ctx, Factory* factory, const LobeSet& wanted,
                               const Closure& closure)
    {
        const auto n = static_cast<std::size_t>(ctx->numPts);
        auto* self = ctx->alloc<ClosureBxdf>();
        auto* points = ctx->alloc<Point>(n);
        auto* pairs = ctx->alloc<Vec2>(n);
        auto* singles = ctx->alloc<float>(n);
        if (!self || !points || !pairs || !singles) return nullptr;
        const bool two_media = is_interface(closure);
        for (int i = 0; i < ctx->numPts; ++i)
        {
            const Vec3 &V = ctx->Vn[i], &N = ctx->Nn[i], &Ng = ctx->Ngn[i], &T = ctx->Tn[i];
            const Frame frame = two_media ? Frame::of(N, Ng, T) : Frame::facing(V, N, Ng, T);
            Vec3 wo = frame.to_local(V);
            // A normal bent so far that V is on its other side: no direction, so a black closure.
            if ((wo.z < 0) != (frame.geometric.dot(V) < 0)) wo = Vec3(0.0f);
            new (points + i) Point{frame, closure.prepare(wo)};
        }
        return new (self) ClosureBxdf(ctx, factory, wanted, closure, points, pairs, singles);
    }

    Domain evaluateDomain() const override
    {
        if (_discrete) return kEmptyDomain;
        return _two_media ? kBoth : kReflect;
    }

    LobeSet aggregateLobes() const override { return _made & _wanted; }

    void generateSample(Transport, const LobeSet* lobesWanted, Rng* rng, Lobe* sampled, Vec3* Ln,
                        LobeWeights& weights, float* fwdPdf, float* revPdf,
                        Color3* compTrans) override
    {
        const LobeSet mine = aggregateLobes();
        Slots slots;
        rng->draw2D(_pairs);
        if constexpr (Closure::random_numbers > 2) rng->draw1D(_singles);
        for (int i = 0; i < ctx->numPts; ++i)
        {
            sampled[i] = Lobe();
            fwdPdf[i] = revPdf[i] = 0;
            if (compTrans) compTrans[i] = Color3(0.0f);
            const LobeSet enabled = mine & lobesWanted[i];
            if (!enabled.any()) continue;

            const Point& p = _points[i];
            const float third = Closure::random_numbers > 2 ? _singles[i] : 0.0f;
            const Sample<float> s =
                p.prepared.sample(regain::Vec3<float>(_pairs[i].x, _pairs[i].y, third));
            const Vec3 L = p.frame.to_world(s.wi);
            if (!s.valid || !is_on_its_side(p.frame, L, s.wi)) continue;

            const Lobe chosen = lobe(!s.transmitted, s.delta);
            if (!enabled.has(chosen)) continue;
            Color3* slot = slots.open(weights, chosen);
            // With every slot taken the lobe has no weight, so it is not sampled either.
            if (!slot) continue;
            Ln[i] = L;
            slot[i] = s.weight * (s.pdf * factor(p, s.wi));
            fwdPdf[i] = s.pdf;
            revPdf[i] = s.delta ? s.pdf : reverse_pdf(p, s.wi);
            sampled[i] = chosen;
            sampled[i].valid = true;
        }
    }

    void evaluateSample(Transport, const LobeSet* lobesWanted, Rng* rng, LobeSet* evaluated,
                        const Vec3* Ln, LobeWeights& weights, float* fwdPdf, float* revPdf) override
    {
        Slots slots;
        if constexpr (stochastic) draw_for_eval(rng);
        for (int i = 0; i < ctx->numPts; ++i)
            evaluate(_points[i], lobesWanted[i], numbers_for_eval(i), Ln, i, evaluated, weights,
                     slots, fwdPdf, revPdf);
    }

    void evaluateSamplesAtIndex(Transport, const LobeSet& lobesWanted, Rng* rng, int index, int n,
                                LobeSet* evaluated, const Vec3* Ln, LobeWeights& weights,
                                float* fwdPdf, float* revPdf) override
    {
        Slots slots;
        if constexpr (stochastic) draw_for_eval(rng);
        // The generator has one set of numbers per point: further directions get what follows from
        // it.
        regain::Vec3<float> u = numbers_for_eval(index);
        RandomStream<float> more(u);
        for (int j = 0; j < n; ++j)
        {
            evaluate(_points[index], lobesWanted, u, Ln, j, evaluated, weights, slots, fwdPdf,
                     revPdf);
            if constexpr (stochastic) u = more.next3();
        }
    }

    bool albedo(Color3* result) const override
    {
        for (int i = 0; i < ctx->numPts; ++i)
        {
            const auto a = _points[i].prepared.albedo();
            result[i] = a.reflect + a.transmit;
        }
        return true;
    }

    bool materialIor(float* result) const override
    {
        if (!_two_media) return false;
        for (int i = 0; i < ctx->numPts; ++i) result[i] = relative_index(_closure);
        return true;
    }

private:
    static constexpr bool stochastic =
        regain::detail::TakesNumbersInEval<typename Closure::Prepared, float>::value;

    struct Point
    {
        Frame frame;
        typename Closure::Prepared prepared;
    };

    /// The weights of one call, opened when a point first has one: reflected and transmitted.
    struct Slots
    {
        Color3* reflect = nullptr;
        Color3* transmit = nullptr;

        Color3* open(LobeWeights& weights, const Lobe& l)
        {
            Color3*& slot = l.reflect ? reflect : transmit;
            if (!slot) slot = weights.addActiveLobe(l);
            return slot;
        }
    };

    ClosureBxdf(const ShadingContext* c, Factory* f, const LobeSet& wanted, const Closure& closure,
                const Point* points, Vec2* pairs, float* singles)
        : Bxdf(c, f),
          _closure(closure),
          _wanted(wanted),
          _points(points),
          _pairs(pairs),
          _singles(singles),
          _two_media(is_interface(closure)),
          _discrete(is_delta(closure))
    {
        const Traits traits = closure.traits();
        for (const bool reflect : {true, false})
        {
            if (!reflect && !traits.transmissive) continue;
            if (!_discrete) _made |= LobeSet(lobe(reflect, false));
            if (traits.delta) _made |= LobeSet(lobe(reflect, true));
        }
    }

    Lobe lobe(bool reflect, bool discrete) const
    {
        Lobe l;
        l.cls = LobeClass::Specular;
        l.id = _two_media ? kGlassSlot : kSpecularSlot;
        l.reflect = reflect;
        l.discrete = discrete;
        return l;
    }

    // A bumped normal can send light to the wrong side of the surface; that light is dropped, and
    // its share of the pdf with it.
    static bool is_on_its_side(const Frame& frame, const Vec3& L, const Vec3& wi)
    {
        const float side = frame.geometric.dot(L);
        return wi.z < 0 ? side < 0 : side > 0;
    }

    // Of radiance against energy.
    float factor(const Point& p, const Vec3& wi) const
    {
        return ctx->lightPath ? 1.0f : radiance_factor(_closure, p.prepared.wo(), wi);
    }

    // Density of V for a known L; gains never enter it.
    float reverse_pdf(const Point& p, const Vec3& wi) const
    {
        return _closure.pdf(wi, p.prepared.wo());
    }

    void draw_for_eval(Rng* rng) const
    {
        constexpr std::uint32_t domain = 0x45564131;  // not the numbers of generateSample
        rng->newDomain(domain);
        rng->draw2D(_pairs);
        rng->draw1D(_singles);
    }
    regain::Vec3<float> numbers_for_eval([[maybe_unused]] int i) const
    {
        if constexpr (stochastic)
            return {_pairs[i].x, _pairs[i].y, _singles[i]};
        else
            return regain::Vec3<float>(0.0f);
    }

    // One direction Ln[at] at point p. It does not read Ln where the host wants no lobe.
    void evaluate(const Point& p, const LobeSet& wanted, const regain::Vec3<float>& u,
                  const Vec3* Ln, int at, LobeSet* evaluated, LobeWeights& weights, Slots& slots,
                  float* fwdPdf, float* revPdf) const
    {
        evaluated[at].clear();
        fwdPdf[at] = revPdf[at] = 0;
        const LobeSet mine = aggregateLobes() & wanted;
        if (!mine.any()) return;

        const Vec3 wi = p.frame.to_local(Ln[at]);
        const Lobe asked = lobe((wi.z < 0) == (p.prepared.wo().z < 0), false);
        if (!mine.has(asked) || !is_on_its_side(p.frame, Ln[at], wi)) return;
        float pdf = p.prepared.pdf(wi);
        if (!stochastic && pdf == 0) return;
        const Color3 value = regain::evaluate(p.prepared, wi, u);
        if (pdf == 0 && value == Color3(0.0f)) return;
        if (pdf == 0) pdf = static_cast<float>(least_pdf);
        Color3* slot = slots.open(weights, asked);
        if (!slot) return;
        slot[at] = value * factor(p, wi);
        fwdPdf[at] = pdf;
        revPdf[at] = reverse_pdf(p, wi);
        evaluated[at] = LobeSet(asked);
    }

    Closure _closure;
    LobeSet _wanted, _made;
    const Point* _points;
    Vec2* _pairs;
    float* _singles;
    bool _two_media, _discrete;
};

/// Makes the bxdfs of one kind of material.
template <class Material>
class ClosureFactory final : public Factory
{
public:
    Bxdf* beginScatter(const ShadingContext* ctx, const LobeSet& lobesWanted, ShadeMode mode, void*,
                       void* instanceData) override
    {
        if (mode != ShadeMode::Scatter || !instanceData) return nullptr;
        return with_closure(*static_cast<const Material*>(instanceData), 1.0f,
                            [&](const auto& closure) -> Bxdf* {
                                if (ctx->lightPath)
                                    return begin(ctx, lobesWanted, for_light_path(closure));
                                return begin(ctx, lobesWanted, closure);
                            });
    }

private:
    template <class Closure>
    Bxdf* begin(const ShadingContext* ctx, const LobeSet& lobesWanted, const Closure& closure)
    {
        return ClosureBxdf<Closure>::create(ctx, this, lobesWanted, closure);
    }
};

}  // namespace renderman
REGAIN_NAMESPACE_END
