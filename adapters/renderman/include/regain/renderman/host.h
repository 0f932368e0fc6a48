// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The batched scattering interface: the shape of a RenderMan bxdf plug-in, in this project's own
/// words. Porting to the real SDK is renaming; the counterpart of each name stands in brackets.
///
/// Contract
///  C1 Directions are unit, in world space, and point away from the surface. `Vn` goes to the
///     previous path vertex (the viewer on an eye path), `Ln` to the next one (the light).
///  C2 A lobe weight is f(V, L) |cos(Nn, L)|, not divided by a pdf; closure weight, tint and
///     compensation gain are already inside.
///  C3 `fwdPdf` is the density (per steradian) with which generateSample picks L given V, over all
///     lobes that `lobesWanted` leaves enabled, selection probabilities included. `revPdf` is what
///     the same sampler would give V for a known L. Gains never enter either.
///  C4 A discrete sample has weight and pdf as finite selection probabilities; evaluate never
///     reports discrete lobes.
///  C5 Every call handles all `ctx->numPts` points (AtIndex: n directions at one point). A point
///     may decline alone: generate sets `sampled[i].valid = false`, evaluate clears
///     `evaluated[i]`; pdfs and weights of that point are then 0. A black sample is valid.
///  C6 A Bxdf belongs to one thread; its Factory is shared by all. Memory comes from the arena of
///     the context and lives as long as the context; no destructor is run.
///  C7 `ctx->lightPath`: importance is carried, V is the light's side and L the eye's. On an eye
///     path radiance is, and a transmitted weight holds (n_V / n_L)^2, the indices on the sides of
///     V and of L; on a light path it does not.
///  C8 `revPdf` may be null, and costs nothing then.
///  C9 The surface of an interface between two media has an outside: where the normals point. Which
///     side V is on is told by Ngn. Other surfaces are the same from both sides.

#pragma once

#include <Imath/ImathColor.h>
#include <Imath/ImathVec.h>

#include <regain/closures/version.h>

#include <cstddef>
#include <cstdint>

REGAIN_NAMESPACE_BEGIN
namespace renderman {

using Vec3 = Imath::V3f;
using Vec2 = Imath::V2f;
using Color3 = Imath::C3f;

/// Where a bxdf may be evaluated, by the hemispheres of the geometric normal [RixBXEvaluateDomain].
enum Domain : unsigned {
    kEmptyDomain = 0,
    kOutsideReflect = 1,
    kOutsideTransmit = 2,
    kInsideReflect = 4,
    kInsideTransmit = 8,
    kReflect = kOutsideReflect | kInsideReflect,
    kTransmit = kOutsideTransmit | kInsideTransmit,
    kBoth = kReflect | kTransmit
};

/// Which light the integrator is after [RixBXTransportTrait]. Not radiance against importance:
/// that is `ShadingContext::lightPath`.
enum Transport : unsigned { kDirect = 1, kIndirect = 2, kAnyLighting = 3 };

enum class ShadeMode { Scatter, PresenceQuery, OpacityQuery };  ///< [RixSCShadingMode]
enum class LobeClass : std::uint8_t { Diffuse, Specular, User };

constexpr int kMaxDiffuse = 4, kMaxSpecular = 8, kMaxUser = 12;
constexpr int kMaxActive = 16;  ///< lobe slots that one call can open

/// Exactly one lobe [RixBXLobeSampled]; `id` is its slot in its class, the number that light path
/// expressions use.
struct Lobe
{
    LobeClass cls = LobeClass::Diffuse;
    std::uint8_t id = 0;
    bool reflect = true, discrete = false, valid = false;
    bool continuation = false;  ///< light goes on as if there were no surface

    /// Bit of this lobe in a LobeSet: 2 per diffuse or specular slot (reflect, transmit), 1 per
    /// user slot.
    int slot() const
    {
        const int side = reflect ? 0 : 1;
        switch (cls)
        {
            case LobeClass::Diffuse: return 2 * id + side;
            case LobeClass::Specular: return 2 * (kMaxDiffuse + id) + side;
            default: return 2 * (kMaxDiffuse + kMaxSpecular) + id;
        }
    }
};

/// Any number of lobes [RixBXLobeTraits]. Smooth and discrete are two bits for the whole set.
struct LobeSet
{
    static constexpr std::uint64_t kDiscrete = 1ull << 62, kSmooth = 1ull << 63;
    static constexpr std::uint64_t kMeasure = kDiscrete | kSmooth;

    std::uint64_t bits = 0;

    LobeSet() = default;
    explicit LobeSet(const Lobe& l) : bits((1ull << l.slot()) | (l.discrete ? kDiscrete : kSmooth))
    {}
    static LobeSet all()
    {
        LobeSet s;
        s.bits = ~0ull;
        return s;
    }

    bool any() const { return (bits & ~kMeasure) && (bits & kMeasure); }
    bool has(const Lobe& l) const
    {
        const std::uint64_t b = LobeSet(l).bits;
        return (bits & b) == b;
    }
    void clear() { bits = 0; }
    LobeSet& operator|=(LobeSet o)
    {
        bits |= o.bits;
        return *this;
    }
    LobeSet operator&(LobeSet o) const
    {
        o.bits &= bits;
        return o;
    }
};

/// Lobe weights, slots opened on demand [RixBXLobeWeights].
class LobeWeights
{
public:
    /// `storage` holds kMaxActive * n colours and belongs to the host.
    LobeWeights(Color3* storage, int n) : _store(storage), _n(n) {}

    /// Zeroed array of n weights for `l`, the same array when it is open already, null when all
    /// kMaxActive slots are taken [AddActiveLobe].
    Color3* addActiveLobe(const Lobe& l)
    {
        for (int k = 0; k < _used; ++k)
            if (_lobes[k].slot() == l.slot()) return _store + std::ptrdiff_t(k) * _n;
        if (_used == kMaxActive) return nullptr;
        Color3* w = _store + std::ptrdiff_t(_used) * _n;
        for (int i = 0; i < _n; ++i) w[i] = Color3(0.0f);
        _lobes[_used++] = l;
        return w;
    }

    int active() const { return _used; }
    const Lobe& lobe(int k) const { return _lobes[k]; }
    const Color3* weights(int k) const { return _store + std::ptrdiff_t(k) * _n; }

    /// Sum over the open slots at point i.
    Color3 total(int i) const
    {
        Color3 t(0.0f);
        for (int k = 0; k < _used; ++k) t += weights(k)[i];
        return t;
    }

private:
    Color3* _store;
    int _n, _used = 0;
    Lobe _lobes[kMaxActive];
};

/// One stratified stream per point [RixRNG]. A draw does not advance the stream: the same domain
/// drawn twice gives the same numbers, and one number may be the first of a pair.
struct Rng
{
    virtual void draw1D(float* xi) = 0;                  ///< fills numPts values in [0, 1)
    virtual void draw2D(Vec2* xi) = 0;                   ///< fills numPts pairs in [0, 1)^2
    virtual void newDomain(std::uint32_t scramble) = 0;  ///< decorrelates before drawing again

protected:
    ~Rng() = default;
};

/// A batch of shading points [RixShadingContext], read-only for plug-ins.
struct ShadingContext
{
    int numPts = 0;
    bool lightPath = false;  ///< [scTraits.lightPath]
    const Vec3 *Vn = nullptr, *Nn = nullptr, *Ngn = nullptr, *Tn = nullptr;
    const Vec2* st = nullptr;  ///< texture coordinates, t upwards [primvar "st"]; null where none
    const Vec3* Po = nullptr;  ///< position in the object's space [k_Po]; null where none
    void* (*allocFn)(void* arena, std::size_t bytes, std::size_t align) = nullptr;
    void* arena = nullptr;

    /// Uninitialised memory for n objects, or null when the arena is spent
    /// [Allocator::AllocForBxdf].
    template <class T>
    T* alloc(std::size_t n = 1) const
    {
        return static_cast<T*>(allocFn(arena, n * sizeof(T), alignof(T)));
    }
};

class Factory;

/// The scattering of one batch [RixBxdf].
class Bxdf
{
public:
    Bxdf(const ShadingContext* c, Factory* f) : ctx(c), factory(f) {}

    virtual Domain evaluateDomain() const = 0;

    /// Lobes it can make and the host wants.
    virtual LobeSet aggregateLobes() const = 0;

    virtual void generateSample(Transport, const LobeSet* lobesWanted, Rng*, Lobe* sampled,
                                Vec3* Ln, LobeWeights&, float* fwdPdf, float* revPdf,
                                Color3* compTrans) = 0;

    virtual void evaluateSample(Transport, const LobeSet* lobesWanted, Rng*, LobeSet* evaluated,
                                const Vec3* Ln, LobeWeights&, float* fwdPdf, float* revPdf) = 0;

    virtual void evaluateSamplesAtIndex(Transport, const LobeSet& lobesWanted, Rng*, int index,
                                        int n, LobeSet* evaluated, const Vec3* Ln, LobeWeights&,
                                        float* fwdPdf, float* revPdf) = 0;

    /// Directional albedo towards Vn per point, reflected and transmitted energy together, gain
    /// included [GetProperty(k_Albedo)]; false when the bxdf has none.
    virtual bool albedo(Color3*) const { return false; }

    /// Index of refraction inside over that outside, per point; false when the bxdf lets no light
    /// through, or has one medium on both sides [GetProperty(k_MaterialIor)]. By it a host undoes
    /// the factor of C7 where it compares throughputs.
    virtual bool materialIor(float*) const { return false; }

protected:
    ~Bxdf() = default;

    const ShadingContext* ctx;
    Factory* factory;
};

/// Where a surface is, and how much light it lets by [RixOpacity]. It changes nothing of what
/// scatters: lobe weights are those of the surface where it is. What lets light straight on is a
/// closure and a continuation lobe, and is not told here a second time.
class Opacity
{
public:
    /// In [0, 1] per point; false: 1 everywhere.
    virtual bool presence(float*) const = 0;
    /// Per point; false: 1 everywhere.
    virtual bool opacity(Color3*) const = 0;

protected:
    ~Opacity() = default;
};

/// One per bound material, shared by all threads [RixBxdfFactory].
class Factory
{
public:
    virtual ~Factory() = default;

    /// A Bxdf in the arena of `ctx`, or null when the arena is spent.
    virtual Bxdf* beginScatter(const ShadingContext* ctx, const LobeSet& lobesWanted, ShadeMode,
                               void* parentData, void* instanceData) = 0;
    virtual void endScatter(Bxdf*) {}

    /// Whether beginOpacity is worth asking [GetInstanceHints, k_ComputesPresence].
    virtual bool computesPresence(const void* /*instanceData*/) const { return false; }

    /// Null where the surface is everywhere, or the arena is spent.
    virtual Opacity* beginOpacity(const ShadingContext*, ShadeMode, void* /*parentData*/,
                                  void* /*instanceData*/)
    {
        return nullptr;
    }
    virtual void endOpacity(Opacity*) {}
};

}  // namespace renderman
REGAIN_NAMESPACE_END
