// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What a renderer in the manner of OSL's testrender keeps of one shading point: a few BSDFs with
/// weights, in fixed memory, which it samples and evaluates as one.
///
/// Contract
///  O1 Directions are unit, in world space, away from the surface. `wo` is the known one, -I of
///     the shader globals; `wi` the sampled or queried one.
///  O2 weight = f |cos theta_i| / pdf, closure weights and gains included; the pdf is that of the
///     whole, per steradian: sums over all BSDFs, each with the chance that it is picked.
///  O3 Of a singular direction (mirror, clear glass, straight through) pdf is a probability and
///     weight the energy over it; eval knows nothing of them.
///  O4 A BSDF is picked by its closure weight times its albedo towards wo, which includes the gain
///     and what layers above let through; none that may contribute is picked with probability 0.
///  O5 Unidirectional: transmitted weights hold the squared ratio of the indices on the sides of
///     wo and wi. Albedos are energy, and do not.
///  O6 Nothing is allocated, no destructor runs, nothing throws.

#pragma once

#include <Imath/ImathColor.h>
#include <Imath/ImathVec.h>

#include <regain/closures/version.h>

#include <algorithm>
#include <cstddef>
#include <new>
#include <utility>

REGAIN_NAMESPACE_BEGIN
namespace osl {

/// pdf == 0 means "no such direction"; the weight is then 0.
struct BsdfSample
{
    Imath::V3f wi{0.0f};
    Imath::C3f weight{0.0f};
    float pdf = 0;
    float roughness = 0;    ///< microfacet width of what was sampled
    bool singular = false;  ///< O3
    bool straight = false;  ///< wi is -wo, as if there were no surface
    bool passes = false;    ///< wi goes through an interface, of relative index `ior`
    float ior = 1;          ///< index inside over index outside; of BSDFs without one, 1
};

/// One closure in its frame. Its answers are for this BSDF alone, without closure weight.
class Bsdf
{
public:
    virtual Imath::C3f albedo(const Imath::V3f& wo) const = 0;
    /// About that, for O4.
    virtual Imath::C3f expected_albedo(const Imath::V3f& wo) const = 0;
    virtual BsdfSample eval(const Imath::V3f& wo, const Imath::V3f& wi) const = 0;
    virtual BsdfSample sample(const Imath::V3f& wo, const Imath::V3f& u) const = 0;
    /// All its directions are straight ones.
    virtual bool passes_straight() const = 0;

protected:
    ~Bsdf() = default;  // they are in a pool
};

class CompositeBsdf
{
public:
    static constexpr int most_bsdfs = 16;
    static constexpr std::size_t pool_bytes = 64 * 1024;

    void clear()
    {
        _count = 0;
        _used = 0;
    }
    int size() const { return _count; }
    const Imath::C3f& weight(int k) const { return _entries[k].weight; }
    const Bsdf& bsdf(int k) const { return *_entries[k].bsdf; }
    float probability(int k) const { return _entries[k].probability; }

    /// A BSDF of type T, or null where no more fits. `weight` is finite and not negative.
    template <class T, class... Args>
    const T* add(const Imath::C3f& weight, Args&&... args)
    {
        static_assert(alignof(T) <= alignof(std::max_align_t), "the pool is aligned to that");
        const std::size_t at = (_used + alignof(T) - 1) / alignof(T) * alignof(T);
        if (_count == most_bsdfs || at + sizeof(T) > pool_bytes) return nullptr;
        const T* made = new (_pool + at) T(std::forward<Args>(args)...);
        _used = at + sizeof(T);
        _entries[_count++] = {made, weight, 0};
        return made;
    }

    /// The chance of each (O4). Once all are added, before sample and eval; false where an albedo
    /// is no number.
    bool prepare(const Imath::V3f& wo)
    {
        float total = 0;
        for (int k = 0; k < _count; ++k)
        {
            Entry& e = _entries[k];
            const float most = std::max({e.weight.x, e.weight.y, e.weight.z});
            // There is nothing to ask an albedo for where there is one BSDF.
            float share = most;
            if (_count > 1)
            {
                const Imath::C3f energy = e.weight * e.bsdf->expected_albedo(wo);
                share = std::max((energy.x + energy.y + energy.z) / 3, 1e-4f * most);
            }
            e.probability = share;
            total += share;
        }
        if (!(total - total == 0)) return false;
        for (int k = 0; k < _count; ++k)
            _entries[k].probability = total > 0 ? _entries[k].probability / total : 0;
        return true;
    }

    /// Energy that leaves in all, per channel.
    Imath::C3f albedo(const Imath::V3f& wo) const
    {
        Imath::C3f sum(0.0f);
        for (int k = 0; k < _count; ++k) sum += _entries[k].weight * _entries[k].bsdf->albedo(wo);
        return sum;
    }

    /// What goes straight on: of that much shadow rays are not stopped.
    Imath::C3f transparency(const Imath::V3f& wo) const
    {
        Imath::C3f sum(0.0f);
        for (int k = 0; k < _count; ++k)
            if (_entries[k].bsdf->passes_straight())
                sum += _entries[k].weight * _entries[k].bsdf->albedo(wo);
        return sum;
    }

    BsdfSample eval(const Imath::V3f& wo, const Imath::V3f& wi) const
    {
        BsdfSample whole;
        whole.wi = wi;
        return mixed(wo, whole, -1);
    }

    /// u and pick are uniform in [0, 1).
    BsdfSample sample(const Imath::V3f& wo, const Imath::V3f& u, float pick) const
    {
        int chosen = -1;
        float sum = 0;
        for (int k = 0; k < _count; ++k)
        {
            if (!(_entries[k].probability > 0)) continue;
            chosen = k;
            sum += _entries[k].probability;
            if (pick < sum) break;
        }
        if (chosen < 0) return {};
        const Entry& e = _entries[chosen];
        BsdfSample s = e.bsdf->sample(wo, u);
        if (!(s.pdf > 0)) return {};
        if (s.singular)
        {
            s.weight = e.weight * s.weight / e.probability;
            s.pdf *= e.probability;
            return s;
        }
        // As a value, to which the others add theirs.
        s.weight = e.weight * s.weight * s.pdf;
        s.pdf *= e.probability;
        return mixed(wo, s, chosen);
    }

private:
    struct Entry
    {
        const Bsdf* bsdf;
        Imath::C3f weight;
        float probability;
    };

    // Adds value and pdf of all BSDFs but `known` to `s`, whose weight is a value still.
    BsdfSample mixed(const Imath::V3f& wo, BsdfSample s, int known) const
    {
        for (int k = 0; k < _count; ++k)
        {
            if (k == known) continue;
            const Entry& e = _entries[k];
            const BsdfSample other = e.bsdf->eval(wo, s.wi);
            if (!(other.pdf > 0)) continue;
            s.weight += e.weight * other.weight * other.pdf;
            s.pdf += e.probability * other.pdf;
            s.roughness = std::max(s.roughness, other.roughness);
        }
        if (!(s.pdf > 0)) return {};
        s.weight /= s.pdf;
        return s;
    }

    Entry _entries[most_bsdfs];
    int _count = 0;
    std::size_t _used = 0;
    alignas(std::max_align_t) unsigned char _pool[pool_bytes];
};

}  // namespace osl
REGAIN_NAMESPACE_END
