// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A closure at many shading points at once, an array for each component: what a host calls that
/// has points in batches, whatever vectors of floats the answers are computed with. Who makes one
/// is told in wide_closure.h and, of materials chosen at run time, in
/// <regain/shaders/wide_material.h>.
///
/// Answers are those of closure.h in float, to 1e-5 relative. Nothing is allocated, locked or
/// thrown. Directions are in the local shading frame, or in world space where the points were
/// prepared with frames; then they are answered as shading_frame.h has it, and a direction that the
/// normals do not agree on gets black and a pdf of 0.

#pragma once

#include <regain/closures/version.h>

#include <cstddef>
#include <cstdint>

REGAIN_NAMESPACE_BEGIN

/// An array of three components each: x, y, z or red, green, blue. `stride` is the distance of
/// neighbours in floats: 1 of three arrays, 3 of one array of Imath::V3f or C3f.
template <class Float>
struct Triples
{
    Float *x = nullptr, *y = nullptr, *z = nullptr;
    std::ptrdiff_t stride = 1;

    explicit operator bool() const { return x != nullptr; }

    /// Of an array of structures whose members x, y, z follow each other.
    template <class Vec>
    static Triples of(Vec* first)
    {
        return {&first->x, &first->y, &first->z, sizeof(Vec) / sizeof(Float)};
    }
};
using Triples3f = Triples<float>;
using ConstTriples3f = Triples<const float>;

/// What sample() returns of a point: bits of a byte. No bits: nothing was sampled.
enum WideEvent : std::uint8_t { wide_valid = 1, wide_delta = 2, wide_transmitted = 4 };

/// Where sample() writes. An array that is null is not wanted.
struct WideSamples
{
    Triples3f wi;                   ///< unit
    Triples3f weight;               ///< f |cos theta_i| / pdf; 0 where there is no sample
    float* pdf = nullptr;           ///< per steradian; of a delta lobe its probability
    std::uint8_t* event = nullptr;  ///< bits of WideEvent
};

/// Which points are asked: entry j of the arrays is about point at[j]. Without `at` it is about
/// point j, and there are no more entries than points. Points in ascending order are quickest, as
/// neighbours are computed together.
struct WideSelection
{
    int count = 0;
    const int* at = nullptr;
};

/// Where closures are prepared. With `V` alone it is wo of each point in the local frame. With all
/// of the others the points are in world space: V is unit, towards the viewer, N and Ng are the
/// shading and the geometric normal, T is along x of the frame.
struct WideSurface
{
    ConstTriples3f V, N, Ng, T;
    bool facing = true;     ///< both normals are turned to the viewer: of all but interfaces
    bool radiance = false;  ///< what is transmitted is multiplied by (n_o / n_i)^2

    bool in_world() const { return bool(N); }
};

/// Memory of the caller's: function(arena, bytes, alignment) returns some, or null where it is
/// spent. It is never given back.
struct WideMemory
{
    void* (*function)(void* arena, std::size_t bytes, std::size_t alignment);
    void* arena;
};

class WidePoints
{
public:
    /// f |cos theta_i| and the density of wi, per entry; 0 where the pair is impossible. Either
    /// array may be null. u in [0, 1)^3 is read where eval is an estimate.
    virtual void eval(const WideSelection&, const ConstTriples3f& wi, const ConstTriples3f& u,
                      const Triples3f& value, float* pdf) const = 0;

    /// One direction per entry, by its u in [0, 1)^3.
    virtual void sample(const WideSelection&, const ConstTriples3f& u,
                        const WideSamples&) const = 0;

    /// Directional albedo of each point; either array may be null.
    virtual void albedo(const Triples3f& reflect, const Triples3f& transmit) const = 0;
    /// About their sum, but quick: see expected_albedo() of closure.h.
    virtual void expected_albedo(const Triples3f& sum) const = 0;

    /// What compensation multiplies the closure by at each point, if it is a gain of wo; 1 of all
    /// else.
    virtual void gain(const Triples3f&) const = 0;

protected:
    ~WidePoints() = default;
};

REGAIN_NAMESPACE_END
