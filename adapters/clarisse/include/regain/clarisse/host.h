// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The one-point scattering interface, Clarisse-like. What follows Clarisse's public material:
/// module callbacks, scratchpad objects, `sample` and `evaluate` in a local frame that return the
/// pdf and write value over pdf, labels of event x scattering type with a lobe name, unidirectional
/// path tracing, a multiple scattering strength per material, sidedness. The evaluation interface
/// itself is not public, so every name beyond those is this project's own choice.
///
/// Contract
///  P1 Lobe calls use the lobe's own orthonormal frame, z = its shading normal, turned so that
///     wi.z > 0; that of an interface between two media is not turned, and wi.z < 0 is inside. `wi`
///     is the KNOWN direction (towards the viewer), `wo` the sampled or queried one; both unit,
///     both outward. The closures call the known one wo: the adapter swaps the names.
///  P2 weight = f |wo.z| / pdf, gain included, entry weight excluded. The pdf is per steradian, for
///     this lobe alone. pdf == 0 means "no sample"; the weight is then 0.
///  P3 Singular lobes: sample returns the probability with which it picks wo, 1 for a mirror, and
///     weight = energy fraction over that; evaluate returns 0. No lobe is singular for some
///     directions and not for others.
///  P4 The host picks the lobe, with probability by luminance of entry.weight * albedo(wi), and
///     forms the mixture pdf and the mixture value.
///  P5 albedo(wi) includes the gain. It drives P4, layering and albedo outputs.
///  P6 Unidirectional: radiance only, so a transmitted weight holds (n_wi / n_wo)^2, the indices on
///     the sides of wi and of wo; albedo is energy and does not. `reverse_pdf` may be null; if not,
///     it receives the same lobe's density of wi given wo.
///  P7 Lobes are built in the thread's scratchpad by create_lobes. Nothing is allocated after that;
///     the material's data is const and shared by all threads.
///  P8 `evaluate` gets no random numbers. A lobe that can only estimate its value answers the same
///     estimate for the same two directions; it is right on average over neighbouring directions.
///  P9 Opacity is where the surface is, and multiplies nothing of the lobes: light goes by the rest
///     of it unchanged. What lets light straight on is a `straight` lobe, and is not told a second
///     time as opacity.

#pragma once

#include <Imath/ImathColor.h>
#include <Imath/ImathVec.h>

#include <regain/closures/version.h>

#include <cstddef>
#include <cstdint>
#include <new>
#include <utility>

REGAIN_NAMESPACE_BEGIN
namespace clarisse {

template <class Real>
using vec3 = Imath::Vec3<Real>;
template <class Real>
using color = Imath::Color3<Real>;

/// What a lobe does; `either` is one lobe that does both, and the side of wo says which.
enum class event : std::uint8_t { reflection = 'R', transmission = 'T', either = 'E' };
/// straight is a singular lobe that lets light go on as if there were no surface.
enum class scatter : std::uint8_t { diffuse = 'D', glossy = 'G', singular = 'S', straight = 's' };
/// Which sides of a surface scatter. An interface has both: single_sided and double_sided leave its
/// normals as they are, inverted turns it inside out.
enum class sidedness : std::uint8_t { single_sided, double_sided, inverted };

/// The path tracer's depth and sampling categories, as bits.
enum lobe_filter : std::uint32_t {
    diffuse_reflection = 1,
    glossy_reflection = 2,
    singular_reflection = 4,
    diffuse_transmission = 8,
    glossy_transmission = 16,
    singular_transmission = 32,
    all_lobes = 63
};

/// What a light path expression sees: <R G 'metal'>.
struct lobe_label
{
    event ev = event::reflection;
    scatter sc = scatter::diffuse;
    const char* name = "";  ///< static storage

    /// Its directions have no density.
    bool is_singular() const { return sc == scatter::singular || sc == scatter::straight; }

    /// One bit, or two where the event is `either`.
    std::uint32_t category() const
    {
        const int kind = sc == scatter::diffuse ? 0 : sc == scatter::glossy ? 1 : 2;
        const std::uint32_t reflected = 1u << kind, transmitted = 8u << kind;
        return (ev == event::transmission ? 0u : reflected) |
               (ev == event::reflection ? 0u : transmitted);
    }
};

/// Filled by the host, read-only for materials.
template <class Real>
struct shading_point
{
    vec3<Real> p, ng, ns, tangent;  ///< world space, unit normals
    vec3<Real> p_object{Real(0)};   ///< position in the object's space
    vec3<Real> uvw{Real(0)};        ///< texture coordinates, v upwards
    vec3<Real> view;                ///< world space, unit, towards the viewer
    bool front_facing = true;       ///< dot(ng, view) > 0 before any flip
    sidedness sides = sidedness::double_sided;
    Real multiple_scattering_strength = 1;  ///< 0 = off, 1 = full compensation
    std::uint32_t wanted = all_lobes;       ///< a lobe with no category in here need not be created
};

/// Base of whatever lives in a scratchpad. Its destructor is not run.
struct scratchpad_object
{
    virtual ~scratchpad_object() = default;
};

/// Bump allocator of one thread, reset at every shading point.
class scratchpad
{
public:
    scratchpad(void* mem, std::size_t bytes)
        : _begin(static_cast<char*>(mem)), _at(_begin), _end(_begin + bytes)
    {}

    /// A new T, or null when the pad is full; never throws by itself.
    template <class T, class... Args>
    T* make(Args&&... args)
    {
        const auto misaligned = reinterpret_cast<std::uintptr_t>(_at) % alignof(T);
        const std::size_t pad = misaligned ? alignof(T) - misaligned : 0;
        if (static_cast<std::size_t>(_end - _at) < pad + sizeof(T)) return nullptr;
        char* at = _at + pad;
        _at = at + sizeof(T);
        return new (at) T(std::forward<Args>(args)...);
    }
    void reset() { _at = _begin; }

private:
    char *_begin, *_at, *_end;
};

template <class Real>
class bxdf_lobe : public scratchpad_object
{
public:
    virtual lobe_label label() const = 0;

    /// Microfacet width alpha of the lobe, its wider axis; 0 for a singular lobe.
    virtual Real roughness() const = 0;

    /// Picks wo for wi from three random numbers in [0, 1); returns the pdf (0 = none).
    virtual Real sample(const vec3<Real>& wi, Real u, Real v, Real w, vec3<Real>& wo,
                        color<Real>& weight, Real* reverse_pdf) const = 0;

    /// The same two numbers for a given wo.
    virtual Real evaluate(const vec3<Real>& wi, const vec3<Real>& wo, color<Real>& weight,
                          Real* reverse_pdf) const = 0;

    /// Reflected and transmitted energy together.
    virtual color<Real> albedo(const vec3<Real>& wi) const = 0;

    /// Index of refraction inside over that outside; 1 where one medium is on both sides. By it a
    /// host undoes the factor of P6 where it compares throughputs.
    virtual Real ior() const { return 1; }
};

template <class Real>
struct lobe_entry
{
    const bxdf_lobe<Real>* lobe = nullptr;
    color<Real> weight{Real(1)};  ///< closure weight and layering; no gain
    vec3<Real> x, y, z;           ///< the lobe's frame in world space
};

/// Fixed capacity, filled by the material.
template <class Real>
class lobe_list
{
public:
    static constexpr int capacity = 16;

    /// False when the list is full or the entry has no lobe; the lobe is then not part of the sum.
    bool add(const lobe_entry<Real>& e)
    {
        if (_size == capacity || !e.lobe) return false;
        _entries[_size++] = e;
        return true;
    }
    int size() const { return _size; }
    const lobe_entry<Real>& operator[](int i) const { return _entries[i]; }

private:
    lobe_entry<Real> _entries[capacity];
    int _size = 0;
};

/// Plain function table, registered once per material class.
template <class Real>
struct material_callbacks
{
    /// Once per material instance, before shading; null when the object cannot be used.
    void* (*create_module_data)(const void* object) = nullptr;
    void (*destroy_module_data)(const void* object, void* data) = nullptr;

    /// Once per shading point. False when the scratchpad is full; the list then holds what fits.
    bool (*create_lobes)(const void* data, const shading_point<Real>&, scratchpad&,
                         lobe_list<Real>&) = nullptr;

    /// In [0, 1] per channel, also for rays that ask for nothing else; null: 1 everywhere.
    color<Real> (*opacity)(const void* data, const shading_point<Real>&) = nullptr;
};

}  // namespace clarisse
REGAIN_NAMESPACE_END
