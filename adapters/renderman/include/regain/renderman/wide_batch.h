// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// One closure at all points of a batch, as in lobe_batch.h, of which many points are computed
/// together: <regain/closures/wide_points.h>. What is asked less often, all that looks back from L,
/// is answered one point at a time. A path from the light takes the closure at its other end, and
/// has lobe_batch.h.
///
/// Everything lives in the arena of the context.

#pragma once

#include <regain/closures/wide_points.h>
#include <regain/renderman/lobe_batch.h>

REGAIN_NAMESPACE_BEGIN
namespace renderman {

template <class Closure>
class WideBatch final : public LobeBatch
{
public:
    /// prepare(surface, memory) are the closure's WidePoints at the points of the context. Null
    /// where that is, or where the arena is spent.
    template <class Prepare>
    static WideBatch* create(const ShadingContext* ctx, const Closure& closure, const char* name,
                             const Prepare& prepare)
    {
        auto* self = ctx->alloc<WideBatch>();
        if (!self) return nullptr;
        new (self) WideBatch(ctx, closure, name);
        if (!self->allocate()) return nullptr;

        WideSurface surface;
        surface.V = ConstTriples3f::of(ctx->Vn);
        surface.N = ConstTriples3f::of(ctx->Nn);
        surface.Ng = ConstTriples3f::of(ctx->Ngn);
        surface.T = ConstTriples3f::of(ctx->Tn);
        surface.facing = !self->two_media;
        surface.radiance = true;
        self->_points = prepare(surface, WideMemory{ctx->allocFn, ctx->arena});
        return self->_points ? self : nullptr;
    }

    void albedo(Color3* result) const override
    {
        _points->albedo(Triples3f::of(result), Triples3f::of(_color));
        for (int i = 0; i < _ctx->numPts; ++i) result[i] += _color[i];
    }
    void expected_albedo(Color3* result) const override
    {
        _points->expected_albedo(Triples3f::of(result));
    }

    void sample(int n, const int* at, const Vec3* u, SampledDirection* result) const override
    {
        for (int j = 0; j < n; ++j) _numbers[j] = u[at[j]];
        _points->sample({n, all_points(n, at) ? nullptr : at}, ConstTriples3f::of(_numbers),
                        {Triples3f::of(_L), Triples3f::of(_color), _pdf, _event});
        for (int j = 0; j < n; ++j)
        {
            SampledDirection& r = result[at[j]];
            r = SampledDirection();
            r.L = _L[j];
            if (!(_event[j] & wide_valid)) continue;
            r.valid = true;
            r.discrete = _event[j] & wide_delta;
            r.transmitted = _event[j] & wide_transmitted;
            r.pdf = _pdf[j];
            r.value = _color[j] * _pdf[j];
        }
    }

    void evaluate(int n, const int* at, const Vec3* L, const Vec3* u, Color3* value,
                  float* pdf) const override
    {
        if (discrete)
        {
            for (int j = 0; j < n; ++j)
            {
                value[j] = Color3(0.0f);
                pdf[j] = 0;
            }
            return;
        }
        _points->eval({n, all_points(n, at) ? nullptr : at}, ConstTriples3f::of(L),
                      ConstTriples3f::of(u), Triples3f::of(value), pdf);
        if (!estimates) return;
        for (int j = 0; j < n; ++j)
            if (!(pdf[j] > 0) && value[j] != Color3(0.0f)) pdf[j] = static_cast<float>(least_pdf);
    }

    bool reflects(int at, const Vec3& L) const override
    {
        const Side& s = _sides[at];
        return (regain::detail::dot(s.normal, L) < 0) == s.below;
    }

    void look_back(int n, const int* at, const Vec3* L, Color3* albedo, float* pdf) const override
    {
        for (int j = 0; j < n; ++j)
        {
            const int i = at[j];
            const Vec3 &V = _ctx->Vn[i], &N = _ctx->Nn[i], &Ng = _ctx->Ngn[i], &T = _ctx->Tn[i];
            const auto frame = two_media ? ShadingFrame<float>::of(N, Ng, T)
                                         : ShadingFrame<float>::facing(V, N, Ng, T);
            look_back_at(frame, _closure, frame.known(V), L[j], albedo ? albedo + j : nullptr,
                         pdf + j);
        }
    }

private:
    // What tells on which side of a point a direction is.
    struct Side
    {
        Vec3 normal;
        bool below;  // V is
    };

    WideBatch(const ShadingContext* ctx, const Closure& closure, const char* name)
        : _ctx(ctx), _closure(closure)
    {
        describe(closure, name);
    }

    bool allocate()
    {
        const auto n = static_cast<std::size_t>(_ctx->numPts);
        _sides = _ctx->alloc<Side>(n);
        _numbers = _ctx->alloc<Vec3>(n);
        _L = _ctx->alloc<Vec3>(n);
        _color = _ctx->alloc<Color3>(n);
        _pdf = _ctx->alloc<float>(n);
        _event = _ctx->alloc<std::uint8_t>(n);
        if (!_sides || !_numbers || !_L || !_color || !_pdf || !_event) return false;
        for (int i = 0; i < _ctx->numPts; ++i)
        {
            const Vec3 &V = _ctx->Vn[i], &N = _ctx->Nn[i], &Ng = _ctx->Ngn[i];
            const float with_N = regain::detail::dot(N, V), with_Ng = regain::detail::dot(Ng, V);
            if (two_media)
                _sides[i] = {N, with_N < 0 && with_Ng < 0};
            else
                _sides[i] = {with_Ng < 0 ? -N : N, false};
        }
        return true;
    }

    bool all_points(int n, const int* at) const
    {
        return n == _ctx->numPts && n > 0 && at[0] == 0 && at[n - 1] == n - 1 &&
               is_ascending(n, at);
    }
    static bool is_ascending(int n, const int* at)
    {
        for (int j = 0; j < n; ++j)
            if (at[j] != j) return false;
        return true;
    }

    const ShadingContext* _ctx;
    Closure _closure;
    const WidePoints* _points = nullptr;
    Side* _sides = nullptr;
    // Of one call.
    Vec3 *_numbers = nullptr, *_L = nullptr;
    Color3* _color = nullptr;
    float* _pdf = nullptr;
    std::uint8_t* _event = nullptr;
};

}  // namespace renderman
REGAIN_NAMESPACE_END
