// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The closures with MaterialX's names as OSL's stdosl.h declares them: what a host registers, and
/// the structs that it then finds behind a component. Positional parameters come in the order and
/// with the types of stdosl.h, those with a key after them; N and U are in world space, colours
/// linear, roughnesses of microfacets are widths alpha, thicknesses in nanometres.
///
/// Beyond OSL's, the keys "color82", "gamma", "compensation", "transmission_shadowing",
/// "thin_walled" and "mode" say what OSL has no parameter for; a shader that does not know them
/// gets the defaults below. Hosts zero parameters before a shader runs, so 0 and null are the
/// defaults of keys wherever they may be.

#pragma once

#include <regain/osl/closure_nodes.h>

REGAIN_NAMESPACE_BEGIN
namespace osl {

/// A string of OSL: the one word of a ustring, whose characters it points at. A host whose strings
/// are hashes reads them by a function of its own, see ClosureLibrary::read_strings_by.
struct StringParam
{
    const char* text = nullptr;
};

struct OrenNayarDiffuseParams
{
    Imath::V3f N{0.0f};
    Imath::C3f albedo{0.18f};
    float roughness = 0;
    StringParam label;
    int energy_compensation = 0;
};

struct BurleyDiffuseParams
{
    Imath::V3f N{0.0f};
    Imath::C3f albedo{0.18f};
    float roughness = 0;
    StringParam label;
};

/// Of an interface ior is the index inside over that outside.
struct DielectricParams
{
    Imath::V3f N{0.0f}, U{0.0f};
    Imath::C3f reflection_tint{1.0f}, transmission_tint{1.0f};
    float roughness_x = 0.05f, roughness_y = 0.05f;
    float ior = 1.5f;
    StringParam distribution;
    float thinfilm_thickness = 0, thinfilm_ior = 0;
    StringParam label;
    float gamma = 0;                     ///< of gtr and std; 0 means 2
    StringParam compensation;            ///< a method's name; null: the library's own
    StringParam transmission_shadowing;  ///< correlated or beta; null: the library's own
    int thin_walled = 0;
};

struct ConductorParams
{
    Imath::V3f N{0.0f}, U{0.0f};
    float roughness_x = 0.05f, roughness_y = 0.05f;
    Imath::C3f ior{0.183f, 0.421f, 1.373f}, extinction{3.424f, 2.346f, 1.770f};
    StringParam distribution;
    float thinfilm_thickness = 0, thinfilm_ior = 0;
    StringParam label;
    float gamma = 0;
    StringParam compensation;
};

struct GeneralizedSchlickParams
{
    Imath::V3f N{0.0f}, U{0.0f};
    Imath::C3f reflection_tint{1.0f}, transmission_tint{0.0f};
    float roughness_x = 0.05f, roughness_y = 0.05f;
    Imath::C3f f0{1.0f}, f90{1.0f};
    float exponent = 5;
    StringParam distribution;
    float thinfilm_thickness = 0, thinfilm_ior = 0;
    StringParam label;
    float gamma = 0;
    StringParam compensation;
    /// Of 0, no surface has it at 82 degrees, which is why 0 means 1: no tint.
    Imath::C3f color82{0.0f};
};

struct TranslucentParams
{
    Imath::V3f N{0.0f};
    Imath::C3f albedo{1.0f};
    StringParam label;
};

struct TransparentParams
{
    StringParam label;
};

struct SubsurfaceParams
{
    Imath::V3f N{0.0f};
    Imath::C3f albedo{0.18f};
    Imath::C3f radius{1.0f};
    float anisotropy = 0;
    StringParam label;
};

/// mode: 0 conty_kulla, 1 zeltner; 2 Burley's of 2015.
struct SheenParams
{
    Imath::V3f N{0.0f};
    Imath::C3f albedo{1.0f};
    float roughness = 0.3f;
    StringParam label;
    int mode = 0;
};

struct LayerParams
{
    const ClosureColor* top = nullptr;
    const ClosureColor* base = nullptr;
};

/// Components are known by these numbers. A host with closures of its own gives them others.
enum ClosureId : int {
    oren_nayar_diffuse_id = 0,
    burley_diffuse_id,
    dielectric_id,
    conductor_id,
    generalized_schlick_id,
    translucent_id,
    transparent_id,
    subsurface_id,
    sheen_id,
    layer_id,
    closure_ids  ///< how many there are
};

enum class ParamType { integer, real, color, vector, string, closure };

/// What OSL calls a ClosureParam.
struct ParamInfo
{
    ParamType type;
    int offset, size;  ///< bytes
    const char* key;   ///< null of a positional parameter
};

struct ClosureInfo
{
    const char* name;
    int id;
    const ParamInfo* params;
    int count;
    int size, alignment;  ///< of the struct, bytes
};

/// Closure `id`, from 0 to closure_ids - 1.
inline const ClosureInfo& closure_info(int id);

namespace detail {

template <class T>
constexpr ParamType type_of()
{
    if constexpr (std::is_same_v<T, int>)
        return ParamType::integer;
    else if constexpr (std::is_same_v<T, float>)
        return ParamType::real;
    else if constexpr (std::is_same_v<T, Imath::C3f>)
        return ParamType::color;
    else if constexpr (std::is_same_v<T, Imath::V3f>)
        return ParamType::vector;
    else if constexpr (std::is_same_v<T, StringParam>)
        return ParamType::string;
    else
    {
        static_assert(std::is_same_v<T, const ClosureColor*>, "no type of OSL");
        return ParamType::closure;
    }
}

}  // namespace detail

// The structs have one access control throughout, so that offsetof is defined.
#define REGAIN_OSL_PARAM(Struct, field, key)                                      \
    {                                                                             \
        detail::type_of<decltype(Struct::field)>(), int(offsetof(Struct, field)), \
            int(sizeof(Struct::field)), key                                       \
    }

inline const ClosureInfo& closure_info(int id)
{
    using ON = OrenNayarDiffuseParams;
    static constexpr ParamInfo oren_nayar[] = {
        REGAIN_OSL_PARAM(ON, N, nullptr), REGAIN_OSL_PARAM(ON, albedo, nullptr),
        REGAIN_OSL_PARAM(ON, roughness, nullptr), REGAIN_OSL_PARAM(ON, label, "label"),
        REGAIN_OSL_PARAM(ON, energy_compensation, "energy_compensation")};

    using BD = BurleyDiffuseParams;
    static constexpr ParamInfo burley[] = {
        REGAIN_OSL_PARAM(BD, N, nullptr), REGAIN_OSL_PARAM(BD, albedo, nullptr),
        REGAIN_OSL_PARAM(BD, roughness, nullptr), REGAIN_OSL_PARAM(BD, label, "label")};

    using D = DielectricParams;
    static constexpr ParamInfo dielectric[] = {
        REGAIN_OSL_PARAM(D, N, nullptr),
        REGAIN_OSL_PARAM(D, U, nullptr),
        REGAIN_OSL_PARAM(D, reflection_tint, nullptr),
        REGAIN_OSL_PARAM(D, transmission_tint, nullptr),
        REGAIN_OSL_PARAM(D, roughness_x, nullptr),
        REGAIN_OSL_PARAM(D, roughness_y, nullptr),
        REGAIN_OSL_PARAM(D, ior, nullptr),
        REGAIN_OSL_PARAM(D, distribution, nullptr),
        REGAIN_OSL_PARAM(D, thinfilm_thickness, "thinfilm_thickness"),
        REGAIN_OSL_PARAM(D, thinfilm_ior, "thinfilm_ior"),
        REGAIN_OSL_PARAM(D, label, "label"),
        REGAIN_OSL_PARAM(D, gamma, "gamma"),
        REGAIN_OSL_PARAM(D, compensation, "compensation"),
        REGAIN_OSL_PARAM(D, transmission_shadowing, "transmission_shadowing"),
        REGAIN_OSL_PARAM(D, thin_walled, "thin_walled")};

    using C = ConductorParams;
    static constexpr ParamInfo conductor[] = {
        REGAIN_OSL_PARAM(C, N, nullptr),
        REGAIN_OSL_PARAM(C, U, nullptr),
        REGAIN_OSL_PARAM(C, roughness_x, nullptr),
        REGAIN_OSL_PARAM(C, roughness_y, nullptr),
        REGAIN_OSL_PARAM(C, ior, nullptr),
        REGAIN_OSL_PARAM(C, extinction, nullptr),
        REGAIN_OSL_PARAM(C, distribution, nullptr),
        REGAIN_OSL_PARAM(C, thinfilm_thickness, "thinfilm_thickness"),
        REGAIN_OSL_PARAM(C, thinfilm_ior, "thinfilm_ior"),
        REGAIN_OSL_PARAM(C, label, "label"),
        REGAIN_OSL_PARAM(C, gamma, "gamma"),
        REGAIN_OSL_PARAM(C, compensation, "compensation")};

    using G = GeneralizedSchlickParams;
    static constexpr ParamInfo schlick[] = {
        REGAIN_OSL_PARAM(G, N, nullptr),
        REGAIN_OSL_PARAM(G, U, nullptr),
        REGAIN_OSL_PARAM(G, reflection_tint, nullptr),
        REGAIN_OSL_PARAM(G, transmission_tint, nullptr),
        REGAIN_OSL_PARAM(G, roughness_x, nullptr),
        REGAIN_OSL_PARAM(G, roughness_y, nullptr),
        REGAIN_OSL_PARAM(G, f0, nullptr),
        REGAIN_OSL_PARAM(G, f90, nullptr),
        REGAIN_OSL_PARAM(G, exponent, nullptr),
        REGAIN_OSL_PARAM(G, distribution, nullptr),
        REGAIN_OSL_PARAM(G, thinfilm_thickness, "thinfilm_thickness"),
        REGAIN_OSL_PARAM(G, thinfilm_ior, "thinfilm_ior"),
        REGAIN_OSL_PARAM(G, label, "label"),
        REGAIN_OSL_PARAM(G, gamma, "gamma"),
        REGAIN_OSL_PARAM(G, compensation, "compensation"),
        REGAIN_OSL_PARAM(G, color82, "color82")};

    using T = TranslucentParams;
    static constexpr ParamInfo translucent[] = {REGAIN_OSL_PARAM(T, N, nullptr),
                                                REGAIN_OSL_PARAM(T, albedo, nullptr),
                                                REGAIN_OSL_PARAM(T, label, "label")};

    static constexpr ParamInfo transparent[] = {
        REGAIN_OSL_PARAM(TransparentParams, label, "label")};

    using S = SubsurfaceParams;
    static constexpr ParamInfo subsurface[] = {
        REGAIN_OSL_PARAM(S, N, nullptr), REGAIN_OSL_PARAM(S, albedo, nullptr),
        REGAIN_OSL_PARAM(S, radius, nullptr), REGAIN_OSL_PARAM(S, anisotropy, nullptr),
        REGAIN_OSL_PARAM(S, label, "label")};

    using F = SheenParams;
    static constexpr ParamInfo sheen[] = {
        REGAIN_OSL_PARAM(F, N, nullptr), REGAIN_OSL_PARAM(F, albedo, nullptr),
        REGAIN_OSL_PARAM(F, roughness, nullptr), REGAIN_OSL_PARAM(F, label, "label"),
        REGAIN_OSL_PARAM(F, mode, "mode")};

    static constexpr ParamInfo layer[] = {REGAIN_OSL_PARAM(LayerParams, top, nullptr),
                                          REGAIN_OSL_PARAM(LayerParams, base, nullptr)};

#define REGAIN_OSL_CLOSURE(name, id, list, Struct)                                              \
    {                                                                                           \
        name, id, list, int(sizeof(list) / sizeof(*list)), int(sizeof(Struct)), alignof(Struct) \
    }
    static constexpr ClosureInfo all[closure_ids] = {
        REGAIN_OSL_CLOSURE("oren_nayar_diffuse_bsdf", oren_nayar_diffuse_id, oren_nayar, ON),
        REGAIN_OSL_CLOSURE("burley_diffuse_bsdf", burley_diffuse_id, burley, BD),
        REGAIN_OSL_CLOSURE("dielectric_bsdf", dielectric_id, dielectric, D),
        REGAIN_OSL_CLOSURE("conductor_bsdf", conductor_id, conductor, C),
        REGAIN_OSL_CLOSURE("generalized_schlick_bsdf", generalized_schlick_id, schlick, G),
        REGAIN_OSL_CLOSURE("translucent_bsdf", translucent_id, translucent, T),
        REGAIN_OSL_CLOSURE("transparent_bsdf", transparent_id, transparent, TransparentParams),
        REGAIN_OSL_CLOSURE("subsurface_bssrdf", subsurface_id, subsurface, S),
        REGAIN_OSL_CLOSURE("sheen_bsdf", sheen_id, sheen, F),
        REGAIN_OSL_CLOSURE("layer", layer_id, layer, LayerParams)};
#undef REGAIN_OSL_CLOSURE
#undef REGAIN_OSL_PARAM
    return all[id];
}

}  // namespace osl
REGAIN_NAMESPACE_END
