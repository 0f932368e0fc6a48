// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "known_inputs.h"

#include <sstream>

REGAIN_NAMESPACE_BEGIN
namespace shaders {
namespace {

struct Known
{
    const char* category;
    const char* inputs;  // divided by spaces
};

// MaterialX 1.38 and 1.39, pbrlib and bxdf; and what is understood beyond.
constexpr Known known[] = {
    {"oren_nayar_diffuse_bsdf", "weight color roughness normal energy_compensation"},
    {"burley_diffuse_bsdf", "weight color roughness normal"},
    {"translucent_bsdf", "weight color normal"},
    {"subsurface_bsdf", "weight color radius anisotropy normal"},
    {"sheen_bsdf", "weight color roughness normal mode"},
    {"dielectric_bsdf",
     "weight tint ior roughness retroreflective thinfilm_thickness thinfilm_ior normal tangent "
     "distribution scatter_mode gamma"},
    {"conductor_bsdf",
     "weight ior extinction roughness retroreflective thinfilm_thickness thinfilm_ior normal "
     "tangent distribution gamma metal"},
    {"generalized_schlick_bsdf",
     "weight color0 color82 color90 exponent roughness retroreflective thinfilm_thickness "
     "thinfilm_ior normal tangent distribution scatter_mode gamma"},
    {"layer", "top base"},
    {"mix", "fg bg mix"},
    {"add", "in1 in2"},
    {"multiply", "in1 in2"},
    {"surface", "bsdf edf opacity thin_walled"},
    {"standard_surface",
     "base base_color diffuse_roughness metalness specular specular_color specular_roughness "
     "specular_IOR specular_anisotropy specular_rotation transmission transmission_color "
     "transmission_depth transmission_scatter transmission_scatter_anisotropy "
     "transmission_dispersion transmission_extra_roughness subsurface subsurface_color "
     "subsurface_radius subsurface_scale subsurface_anisotropy sheen sheen_color sheen_roughness "
     "coat coat_color coat_roughness coat_anisotropy coat_rotation coat_IOR coat_normal "
     "coat_affect_color coat_affect_roughness thin_film_thickness thin_film_IOR emission "
     "emission_color opacity thin_walled normal tangent"},
    {"open_pbr_surface",
     "base_weight base_color base_diffuse_roughness base_roughness base_metalness specular_weight "
     "specular_color specular_roughness specular_ior specular_roughness_anisotropy "
     "specular_anisotropy specular_rotation specular_ior_level transmission_weight "
     "transmission_color transmission_depth transmission_scatter transmission_scatter_anisotropy "
     "transmission_dispersion_scale transmission_dispersion_abbe_number subsurface_weight "
     "subsurface_color subsurface_radius subsurface_radius_scale subsurface_scatter_anisotropy "
     "subsurface_anisotropy subsurface_scale fuzz_weight fuzz_color fuzz_roughness coat_weight "
     "coat_color coat_roughness coat_roughness_anisotropy coat_anisotropy coat_rotation coat_ior "
     "coat_ior_level coat_darkening thin_film_weight thin_film_thickness thin_film_ior "
     "emission_luminance emission_color geometry_opacity geometry_thin_walled geometry_normal "
     "geometry_coat_normal geometry_tangent geometry_coat_tangent"},
    {"gltf_pbr",
     "base_color metallic roughness normal tangent occlusion transmission specular specular_color "
     "ior alpha alpha_mode alpha_cutoff iridescence iridescence_ior iridescence_thickness "
     "sheen_color sheen_roughness clearcoat clearcoat_roughness clearcoat_normal emissive "
     "emissive_strength thickness attenuation_distance attenuation_color anisotropy_strength "
     "anisotropy_rotation dispersion"},
    {"UsdPreviewSurface",
     "diffuseColor emissiveColor useSpecularWorkflow specularColor metallic roughness clearcoat "
     "clearcoatRoughness opacity opacityMode opacityThreshold ior normal displacement occlusion"},
    {"surfacematerial", "surfaceshader backsurfaceshader displacementshader"}};

bool is_among(const std::string& name, const char* list)
{
    std::istringstream words(list);
    for (std::string word; words >> word;)
        if (word == name) return true;
    return false;
}

}  // namespace

void note_unknown_inputs(const NodeInputs& in)
{
    const std::string category = in.node.category();
    for (const Known& one : known)
    {
        if (category != one.category) continue;
        for (const char* kind : {"input", "parameter"})
            for (const pugi::xml_node& child : in.node.xml.children(kind))
                if (const std::string name = child.attribute("name").value();
                    !is_among(name, one.inputs))
                    in.values.note({child, in.node.file}, "'" + name + "' is no input of " +
                                                              category + "; it has no effect");
    }
}

}  // namespace shaders
REGAIN_NAMESPACE_END
