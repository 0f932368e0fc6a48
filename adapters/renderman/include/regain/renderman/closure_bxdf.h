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

#pragma once

#include <regain/closures/compensated.h>
#include <regain/renderman/host.h>

#include <new>

REGAIN_NAMESPACE_BEGIN
namespace renderman {

/// Metals go to the slot that light path expressions know as Specular.
constexpr std::uint8_t kSpecularSlot = 1;

/// Orthonormal shading frame on the side of the viewer.
struct Frame
{
    Vec3 x, y, z, geometric;

    /// N and Ng are unit; T is any direction, used where it is not parallel to N. Both normals are
    /// turned to the side of V, Ng first: which side the viewer is on is a matter of geometry.
    static Frame facing(const Vec3& V, const Vec3& N, const Vec3& Ng, const Vec3& T)
    {
        Frame f;
        const bool behind = Ng.dot(V) < 0;
        f.geometric = behind ? -Ng : Ng;
        f.z = behind ? -N : N;
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
        auto* self = ctx->alloc<ClosureBxdf>();
        auto* points = ctx->alloc<Point>(static_cast<std::size_t>(ctx->numPts));
        auto* xi = ctx->alloc<Vec2>(static_cast<std::size_t>(ctx->numPts));
        if (!self || !points || !xi) return nullptr;
        for (int i = 0; i < ctx->numPts; ++i)
        {
            const Frame frame = Frame::facing(ctx->Vn[i], ctx->Nn[i], ctx->Ngn[i], ctx->Tn[i]);
            new (points + i) Point{frame, closure.prepare(frame.to_local(ctx->Vn[i]))};
        }
        return new (self) ClosureBxdf(ctx, factory, wanted, closure, points, xi);
    }

    Domain evaluateDomain() const override
    {
        return _closure.traits().delta ? kEmptyDomain : kReflect;
    }

    LobeSet aggregateLobes() const override
    {
        return LobeSet(lobe(_closure.traits().delta)) & _wanted;
    }

    void generateSample(Transport, const LobeSet* lobesWanted, Rng* rng, Lobe* sampled, Vec3* Ln,
                        LobeWeights& weights, float* fwdPdf, float* revPdf,
                        Color3* compTrans) override
    {
        const LobeSet mine = aggregateLobes();
        Color3* slot = nullptr;
        rng->draw2D(_xi);
        for (int i = 0; i < ctx->numPts; ++i)
        {
            sampled[i] = Lobe();
            fwdPdf[i] = revPdf[i] = 0;
            if (compTrans) compTrans[i] = Color3(0.0f);
            if (!(mine & lobesWanted[i]).any()) continue;

            const Point& p = _points[i];
            const Sample<float> s = p.prepared.sample(_xi[i]);
            const Vec3 L = p.frame.to_world(s.wi);
            if (!s.valid || !is_on_viewers_side(p.frame, L)) continue;

            if (!slot) slot = weights.addActiveLobe(lobe(s.delta));
            // With every slot taken the lobe has no weight, so it is not sampled either.
            if (!slot) continue;
            Ln[i] = L;
            slot[i] = s.delta ? s.weight : s.weight * s.pdf;
            fwdPdf[i] = s.pdf;
            revPdf[i] = s.delta ? s.pdf : reverse_pdf(p, s.wi);
            sampled[i] = lobe(s.delta);
            sampled[i].valid = true;
        }
    }

    void evaluateSample(Transport, const LobeSet* lobesWanted, Rng*, LobeSet* evaluated,
                        const Vec3* Ln, LobeWeights& weights, float* fwdPdf, float* revPdf) override
    {
        Color3* slot = nullptr;
        for (int i = 0; i < ctx->numPts; ++i)
            evaluate(_points[i], lobesWanted[i], Ln, i, evaluated, weights, slot, fwdPdf, revPdf);
    }

    void evaluateSamplesAtIndex(Transport, const LobeSet& lobesWanted, Rng*, int index, int n,
                                LobeSet* evaluated, const Vec3* Ln, LobeWeights& weights,
                                float* fwdPdf, float* revPdf) override
    {
        Color3* slot = nullptr;
        for (int j = 0; j < n; ++j)
            evaluate(_points[index], lobesWanted, Ln, j, evaluated, weights, slot, fwdPdf, revPdf);
    }

    bool albedo(Color3* result) const override
    {
        for (int i = 0; i < ctx->numPts; ++i) result[i] = _points[i].prepared.albedo().reflect;
        return true;
    }

private:
    struct Point
    {
        Frame frame;
        typename Closure::Prepared prepared;
    };

    ClosureBxdf(const ShadingContext* c, Factory* f, const LobeSet& wanted, const Closure& closure,
                const Point* points, Vec2* xi)
        : Bxdf(c, f), _closure(closure), _wanted(wanted), _points(points), _xi(xi)
    {}

    static Lobe lobe(bool discrete)
    {
        Lobe l;
        l.cls = LobeClass::Specular;
        l.id = kSpecularSlot;
        l.discrete = discrete;
        return l;
    }

    // A bumped normal can send light through the surface; that light is dropped, and its share of
    // the pdf with it.
    static bool is_on_viewers_side(const Frame& frame, const Vec3& L)
    {
        return frame.geometric.dot(L) > 0;
    }

    // Density of V for a known L; gains never enter it.
    float reverse_pdf(const Point& p, const Vec3& wi) const
    {
        return _closure.pdf(wi, p.prepared.wo());
    }

    // One direction Ln[at] at point p. It does not read Ln where the host wants no lobe.
    void evaluate(const Point& p, const LobeSet& wanted, const Vec3* Ln, int at, LobeSet* evaluated,
                  LobeWeights& weights, Color3*& slot, float* fwdPdf, float* revPdf) const
    {
        evaluated[at].clear();
        fwdPdf[at] = revPdf[at] = 0;
        const LobeSet mine = LobeSet(lobe(false)) & _wanted & wanted;
        if (!mine.has(lobe(false)) || !is_on_viewers_side(p.frame, Ln[at])) return;

        const Vec3 wi = p.frame.to_local(Ln[at]);
        const float pdf = p.prepared.pdf(wi);
        if (pdf == 0) return;
        if (!slot) slot = weights.addActiveLobe(lobe(false));
        if (!slot) return;
        slot[at] = p.prepared.eval(wi);
        fwdPdf[at] = pdf;
        revPdf[at] = reverse_pdf(p, wi);
        evaluated[at] = LobeSet(lobe(false));
    }

    Closure _closure;
    LobeSet _wanted;
    const Point* _points;
    Vec2* _xi;
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
        const auto closure = static_cast<const Material*>(instanceData)->closure(1.0f);
        if (ctx->lightPath) return begin(ctx, lobesWanted, reversed(closure));
        return begin(ctx, lobesWanted, closure);
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
