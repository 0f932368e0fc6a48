// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// One closure at all points of a batch: its prepared closures and what a surface_bxdf.h asks them,
/// an array at a time. Points are told by index; directions are in world space. Everything lives in
/// the arena of the context.
///
/// On a light path the gain is taken at L, the eye's side (host.h, C7): a gain of one direction is
/// not reciprocal, and the path from the eye is the one to agree with. How often a closure is
/// picked is a matter of the path from the eye, too, whichever way light is followed.

#pragma once

#include <regain/closures/host_queries.h>
#include <regain/closures/random_stream.h>
#include <regain/closures/shading_frame.h>
#include <regain/renderman/host.h>

#include <cstring>
#include <new>

REGAIN_NAMESPACE_BEGIN
namespace renderman {

/// Light path expressions know slots by these names, which are the host's for lobes 2, 3 of the
/// diffuse and 2, 4, 6, 8 of the specular class (numbered from 1).
constexpr std::uint8_t kDiffuseSlot = 1, kSubsurfaceSlot = 2;
constexpr std::uint8_t kSpecularSlot = 1, kClearcoatSlot = 3, kFuzzSlot = 5, kGlassSlot = 7;

/// The slot of a closure by the name that its material gives it: "metal", "glass", "coat", "sheen",
/// "diffuse", "translucent", "subsurface". Of any other name that of glass for an interface, and
/// the specular one for what reflects.
inline Lobe slot_named(const char* name, bool two_media)
{
    struct Known
    {
        const char* name;
        LobeClass cls;
        std::uint8_t id;
    };
    constexpr Known known[] = {{"glass", LobeClass::Specular, kGlassSlot},
                               {"coat", LobeClass::Specular, kClearcoatSlot},
                               {"sheen", LobeClass::Specular, kFuzzSlot},
                               {"diffuse", LobeClass::Diffuse, kDiffuseSlot},
                               {"translucent", LobeClass::Diffuse, kDiffuseSlot},
                               {"subsurface", LobeClass::Diffuse, kSubsurfaceSlot}};
    Lobe l;
    l.cls = LobeClass::Specular;
    l.id = two_media ? kGlassSlot : kSpecularSlot;
    for (const Known& k : known)
        if (std::strcmp(k.name, name) == 0)
        {
            l.cls = k.cls;
            l.id = k.id;
        }
    return l;
}

/// A direction that was sampled for a point.
struct SampledDirection
{
    Vec3 L{0.0f};
    Color3 value{0.0f};  ///< f |cos|; of a delta lobe the energy fraction times its probability
    float pdf = 0;       ///< of this closure alone
    bool valid = false, discrete = false, transmitted = false;
};

class LobeBatch
{
public:
    Lobe slot;              ///< class and id
    bool discrete = false;  ///< all that it scatters has no density
    bool mixed = false;     ///< some of it may have none
    bool transmissive = false;
    bool two_media = false;  ///< its frame is the surface's own, not turned to the viewer
    bool estimates = false;  ///< eval takes random numbers
    bool straight = false;   ///< light goes straight on
    float ior = 1;           ///< inside over outside
    int random_numbers = 2;  ///< that sample reads

    /// Of this closure the lobe that a direction belongs to.
    Lobe lobe(bool reflect, bool is_discrete) const
    {
        Lobe l = slot;
        l.reflect = reflect;
        l.discrete = is_discrete;
        l.continuation = straight;
        return l;
    }
    /// All of them.
    LobeSet lobes() const
    {
        LobeSet set;
        for (const bool reflect : {true, false})
        {
            if (reflect ? straight : !transmissive) continue;
            if (!discrete) set |= LobeSet(lobe(reflect, false));
            if (discrete || mixed) set |= LobeSet(lobe(reflect, true));
        }
        return set;
    }

    /// That of a point, where points differ.
    virtual float ior_at(int /*at*/) const { return ior; }

    /// Energy reflected and let through towards V, gain included, of every point.
    virtual void albedo(Color3* result) const = 0;
    /// About that, but quick: by it closures are picked.
    virtual void expected_albedo(Color3* result) const = 0;

    /// result[i] by u[i], for each of n points i in `at`.
    virtual void sample(int n, const int* at, const Vec3* u, SampledDirection* result) const = 0;

    /// f |cos| and pdf towards L[j] at point at[j]; 0 where the pair is impossible. u[j] is read
    /// where eval is an estimate.
    virtual void evaluate(int n, const int* at, const Vec3* L, const Vec3* u, Color3* value,
                          float* pdf) const = 0;

    /// Whether L[j] is on the reflecting side of point at[j], as this closure's frame sees it.
    virtual bool reflects(int at, const Vec3& L) const = 0;

    /// Seen from L[j] in place of V: the expected albedo, unless that is null, and the density of
    /// V.
    virtual void look_back(int n, const int* at, const Vec3* L, Color3* albedo,
                           float* pdf) const = 0;

protected:
    ~LobeBatch() = default;

    /// All the members above, of a closure that its material calls `name`.
    template <class Closure>
    void describe(const Closure& closure, const char* name)
    {
        const Traits traits = closure.traits();
        discrete = is_delta(closure);
        mixed = traits.delta && !discrete;
        transmissive = traits.transmissive;
        two_media = is_interface(closure);
        estimates = regain::detail::TakesNumbersInEval<typename Closure::Prepared, float>::value;
        random_numbers = Closure::random_numbers;
        straight = passes_straight(closure);
        ior = relative_index(closure);
        slot = slot_named(name, two_media);
    }

    /// look_back() at one point; wo in its frame.
    template <class Closure>
    void look_back_at(const ShadingFrame<float>& frame, const Closure& closure, Vec3 wo,
                      const Vec3& L, Color3* albedo, float* pdf) const
    {
        Vec3 wi = frame.to_local(L);
        if (albedo) *albedo = Color3(0.0f);
        *pdf = 0;
        if (!frame.is_on_its_side(L, wi)) return;
        // Seen from the other side, the frame would be turned there.
        if (!two_media && wi.z < 0)
        {
            wi = Vec3(wi.x, -wi.y, -wi.z);
            wo = Vec3(wo.x, -wo.y, -wo.z);
        }
        const auto back = closure.prepare(wi);
        if (albedo)
        {
            const auto a = regain::expected_albedo(back);
            *albedo = a.reflect + a.transmit;
        }
        if (!discrete) *pdf = back.pdf(wo);
    }
};

/// `Used` is the closure of the path: for_light_path(closure) on one from the light.
template <class Closure, class Used>
class ClosureBatch final : public LobeBatch
{
public:
    /// Null when the arena is spent.
    static ClosureBatch* create(const ShadingContext* ctx, const Closure& closure, const Used& used,
                                const char* name)
    {
        auto* self = ctx->alloc<ClosureBatch>();
        auto* points = ctx->alloc<Point>(static_cast<std::size_t>(ctx->numPts));
        if (!self || !points) return nullptr;
        new (self) ClosureBatch(ctx, closure, points, name);
        for (int i = 0; i < ctx->numPts; ++i)
        {
            const Vec3 &V = ctx->Vn[i], &N = ctx->Nn[i], &Ng = ctx->Ngn[i], &T = ctx->Tn[i];
            const auto frame = self->two_media ? ShadingFrame<float>::of(N, Ng, T)
                                               : ShadingFrame<float>::facing(V, N, Ng, T);
            new (points + i) Point{frame, used.prepare(frame.known(V))};
        }
        return self;
    }

    void albedo(Color3* result) const override
    {
        for (int i = 0; i < _ctx->numPts; ++i)
            result[i] = ask_closure(i, [](const auto& p) { return p.albedo(); });
    }
    void expected_albedo(Color3* result) const override
    {
        for (int i = 0; i < _ctx->numPts; ++i)
            result[i] = ask_closure(i, [](const auto& p) { return regain::expected_albedo(p); });
    }

    void sample(int n, const int* at, const Vec3* u, SampledDirection* result) const override
    {
        for (int j = 0; j < n; ++j)
        {
            const Point& p = _points[at[j]];
            const Sample<float> s = p.prepared.sample(u[at[j]]);
            SampledDirection& r = result[at[j]];
            r = SampledDirection();
            r.L = p.frame.to_world(s.wi);
            if (!s.valid || !p.frame.is_on_its_side(r.L, s.wi)) continue;
            r.valid = true;
            r.discrete = s.delta;
            r.transmitted = s.transmitted;
            r.pdf = s.pdf;
            r.value = s.weight * (s.pdf * factor(p, s.wi));
        }
    }

    void evaluate(int n, const int* at, const Vec3* L, const Vec3* u, Color3* value,
                  float* pdf) const override
    {
        for (int j = 0; j < n; ++j)
        {
            const Point& p = _points[at[j]];
            const Vec3 wi = p.frame.to_local(L[j]);
            value[j] = Color3(0.0f);
            pdf[j] = 0;
            if (discrete || !p.frame.is_on_its_side(L[j], wi)) continue;
            const float density = p.prepared.pdf(wi);
            if (!stochastic && !(density > 0)) continue;
            const Color3 f = regain::evaluate(p.prepared, wi, u[j]);
            if (!(density > 0) && f == Color3(0.0f)) continue;
            pdf[j] = density > 0 ? density : static_cast<float>(least_pdf);
            value[j] = f * factor(p, wi);
        }
    }

    bool reflects(int at, const Vec3& L) const override
    {
        const Point& p = _points[at];
        return (p.frame.to_local(L).z < 0) == (p.prepared.wo().z < 0);
    }

    void look_back(int n, const int* at, const Vec3* L, Color3* albedo, float* pdf) const override
    {
        for (int j = 0; j < n; ++j)
        {
            const Point& p = _points[at[j]];
            look_back_at(p.frame, _closure, p.prepared.wo(), L[j], albedo ? albedo + j : nullptr,
                         pdf + j);
        }
    }

private:
    using Prepared = typename Used::Prepared;
    static constexpr bool stochastic = regain::detail::TakesNumbersInEval<Prepared, float>::value;

    struct Point
    {
        ShadingFrame<float> frame;
        Prepared prepared;
    };

    ClosureBatch(const ShadingContext* ctx, const Closure& closure, const Point* points,
                 const char* name)
        : _ctx(ctx), _closure(closure), _points(points)
    {
        describe(closure, name);
    }

    // What the closure of a path from the eye says of V.
    template <class Ask>
    Color3 ask_closure(int i, const Ask& ask) const
    {
        const auto total = [](const auto& a) { return Color3(a.reflect + a.transmit); };
        if constexpr (std::is_same_v<Closure, Used>)
            return total(ask(_points[i].prepared));
        else
            return total(ask(_closure.prepare(_points[i].prepared.wo())));
    }

    // Of radiance against energy.
    float factor(const Point& p, const Vec3& wi) const
    {
        return _ctx->lightPath ? 1.0f : radiance_factor(_closure, p.prepared.wo(), wi);
    }

    const ShadingContext* _ctx;
    Closure _closure;
    const Point* _points;
};

/// A closure at the points of a context, or null when its arena is spent.
template <class Closure>
LobeBatch* make_batch(const ShadingContext* ctx, const Closure& closure, const char* name)
{
    if (!ctx->lightPath) return ClosureBatch<Closure, Closure>::create(ctx, closure, closure, name);
    const auto turned = for_light_path(closure);
    return ClosureBatch<Closure, std::decay_t<decltype(turned)>>::create(ctx, closure, turned,
                                                                         name);
}

}  // namespace renderman
REGAIN_NAMESPACE_END
