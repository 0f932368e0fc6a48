// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "bugs.h"

#include "coat.h"
#include "gained.h"
#include "glass.h"
#include "mirror.h"
#include "tailed.h"

namespace regain::planted {
namespace {

template <class Fault>
Bug bug(const char* name, const char* check, PlantedSubject (*subject)(Fault, const std::string&),
        Fault fault, const char* setting = "", Tier tier = Tier::commit)
{
    return {name, check, [=](const std::string& id) { return subject(fault, id); }, setting, tier};
}

}  // namespace

const std::vector<Bug>& bugs()
{
    using M = MirrorFault;
    using G = GlassFault;
    using C = CoatFault;
    using T = TailFault;
    using E = GainFault;
    // A mirror's settings, in double and white but where it says otherwise.
    const char* const rough = "alpha=0.25,white,double,mu=0.3";
    const char* const grazing = "alpha=0.25,schlick,double,mu=0.02";
    const char* const tinted = "alpha=0.25,schlick,double,mu=0.7";
    const char* const brushed = "alpha=0.25,alpha_y=0.0625,white,double,mu=0.7";
    const char* const outside = "alpha=0.25,eta=1.5,double,mu=0.3";
    const char* const inside = "alpha=0.25,eta=1.5,double,mu=-0.7";
    const char* const roughest = "alpha=1,eta=1.5,double,mu=0.7";
    // Checks that choose directions themselves look once, with the first direction.
    const char* const pair = "alpha=0.25,white,double,mu=0.7";
    const char* const pair_outside = "alpha=0.25,eta=1.5,double,mu=0.7";
    static const std::vector<Bug> list{
        bug("half_vector_jacobian_missing", "C6", mirror, M::half_vector_jacobian_missing, rough),
        bug("refraction_jacobian_missing", "C4", glass, G::half_vector_jacobian_missing, outside),
        bug("eta_squared_missing", "C10", glass, G::eta_squared_missing, pair_outside),
        bug("eta_squared_missing_in_eval_and_pdf", "C4", glass, G::eta_squared_missing_in_pdf,
            outside),
        bug("eta_squared_doubled", "C7", glass, G::eta_squared_doubled, outside),
        bug("masking_without_shadowing", "C10", mirror, M::masking_without_shadowing, pair),
        bug("masking_without_shadowing_tint", "C9", mirror, M::masking_without_shadowing, grazing),
        bug("widths_swapped_in_sample", "C5", mirror, M::widths_swapped_in_sample, brushed),
        bug("widths_swapped_in_sampled_normals", "C1", mirror, M::widths_swapped_in_sample,
            brushed),
        bug("widths_swapped_in_D", "C1", mirror, M::widths_swapped_in_D, brushed),
        bug("widths_swapped_in_D_of_eval_and_pdf", "C4", mirror, M::widths_swapped_in_D, brushed),
        bug("roughness_not_squared", "C9", mirror, M::roughness_not_squared, grazing),
        bug("total_reflection_ignored", "C9", glass, G::total_reflection_ignored, inside),
        bug("lobe_probability_missing", "C4", glass, G::lobe_probability_missing, outside),
        bug("pdf_a_fiftieth_too_high", "C4", mirror, M::pdf_a_fiftieth_too_high, rough),
        bug("pdf_of_one_lobe_a_fiftieth_too_high", "C4", glass, G::reflected_pdf_too_high, outside,
            Tier::thorough),
        bug("fresnel_of_the_normal", "C9", mirror, M::fresnel_of_the_normal, grazing),
        bug("fresnel_of_the_normal_in_glass", "C10", glass, G::fresnel_of_the_normal, pair_outside),
        bug("cosine_kept_from_grazing", "C9", mirror, M::cosine_kept_from_grazing, grazing),
        bug("table_transposed", "C8", gained_mirror, E::table_transposed,
            "alpha=0.25,white,double,mu=0.3"),
        bug("table_half_a_texel_off", "C8", gained_mirror, E::table_half_a_texel_off,
            "alpha=0.81,white,double,mu=0.3"),
        bug("table_half_a_texel_off_itself", "C15", gained_mirror, E::table_half_a_texel_off),
        // MaterialX 1.39, mx_microfacet_specular.glsl.
        bug("isotropic_masking_of_two_widths", "C7", mirror, M::isotropic_masking,
            "alpha=0.25,alpha_y=1,white,double,mu=0.02,phi=45"),
        bug("isotropic_masking_of_two_widths_weight", "C13", mirror, M::isotropic_masking,
            "alpha=0.25,alpha_y=0.0625,white,double,mu=0.3,phi=45"),
        // BSDL, OSL 1.16, mtx dielectric.
        bug("transmission_where_none_is_sampled", "C4", glass, G::bounded_normals, roughest),
        bug("transmission_where_none_is_sampled_energy", "C6", glass, G::bounded_normals, roughest),
        // Cycles, bsdf_microfacet.h, "check if the refraction configuration is valid".
        bug("transmission_that_no_facet_joins", "C4", glass, G::impossible_pairs, roughest),
        // Adobe openpbr-bsdf, glass of roughness 0.05.
        bug("clamped_before_the_ratio", "C3", mirror, M::clamped_before_the_ratio,
            "alpha=0.001,white,double,mu=0.3"),
        bug("never_below", "C5", glass, G::never_below, outside),
        bug("nan_at_one", "C2", mirror, M::nan_at_one),
        bug("fresnel_twice_in_weight", "C3", mirror, M::fresnel_twice_in_weight, tinted),
        bug("gain_in_sample_only", "C3", gained_mirror, E::in_sample_only,
            "alpha=0.81,white,double,mu=0.3"),
        bug("gain_in_sample_only_hook", "C16", gained_mirror, E::in_sample_only,
            "alpha=0.81,white,double,mu=0.3"),
        bug("table_of_the_other_side", "C8", gained_glass, E::other_side,
            "alpha=0.81,double,mu=0.3"),
        // Cycles, ggx_glass_inv_E.
        bug("stale_table_of_the_other_side", "C8", gained_glass, E::stale_other_side,
            "alpha=0.81,double,mu=-0.3"),
        bug("schlick_to_the_fourth", "C9", mirror, M::schlick_to_the_fourth, grazing),
        bug("gamma_limit_off", "C4", tailed, T::limit_off, "alpha=0.25,gamma=1,double,mu=0.3"),
        bug("gamma_limit_missing", "C2", tailed, T::limit_missing),
        bug("azimuth_biased", "C5", mirror, M::azimuth_biased, rough),
        bug("sine_from_cosine", "C14", mirror, M::sine_from_cosine,
            "alpha=0.04,white,double,mu=0.7"),
        // Cycles, bsdf_microfacet.h; BSDL, MTX/bsdf_conductor_impl.h.
        bug("isotropic_energy_of_two_widths", "C8", gained_brushed, E::isotropic_energy,
            "alpha=1,double,mu=0.7"),
        bug("delta_probability_left_out", "C8", coat, C::probability_left_out, "double,mu=0.3"),
        bug("delta_divided_twice", "C7", coat, C::divided_twice, "double,mu=0.3"),
        bug("negative_at_grazing", "C2", coat, C::negative_at_grazing),
        bug("claims_to_be_reciprocal", "C10", gained_mirror, E::claims_to_be_reciprocal,
            "alpha=0.81,white,double,mu=0.3"),
        bug("claims_to_preserve_energy", "C8", mirror, M::claims_to_preserve_energy,
            "alpha=0.81,white,double,mu=0.3"),
        bug("claims_an_exact_pdf", "C5", coat, C::uniform_pdf, "double,mu=0.3"),
        bug("claims_to_be_opaque", "C0", glass, G::claims_to_be_opaque, outside),
        bug("claims_two_random_numbers", "C0", glass, G::claims_two_numbers, outside),
        bug("claims_eval_to_be_a_value", "C0", coat, C::estimate_unsaid, "double,mu=0.3"),
        bug("estimate_biased", "C6", coat, C::estimate_biased, "double,mu=0.3"),
        bug("estimate_claims_to_be_reciprocal", "C10", coat, C::estimate_claims_to_be_reciprocal,
            "double,mu=0.3"),
        bug("claims_a_density", "C0", coat, C::claims_a_density, "double,mu=0.3"),
        bug("jump_at_index_one", "C11", glass, G::jump_at_one),
        bug("claims_to_be_isotropic", "C12", mirror, M::claims_to_be_isotropic, brushed),
        // A layer under it gains what the gain gave back.
        bug("albedo_of_one_bounce", "C17", gained_mirror, E::albedo_without_it,
            "alpha=0.81,white,double,mu=0.3"),
    };
    return list;
}

std::vector<PlantedSubject> faultless()
{
    return {mirror(MirrorFault::none, "mirror"),
            glass(GlassFault::none, "glass"),
            coat(CoatFault::none, "coat"),
            coat(CoatFault::none_of_estimate, "coat_estimate"),
            tailed(TailFault::none, "tailed"),
            gained_mirror(GainFault::none, "gained_mirror"),
            gained_glass(GainFault::none, "gained_glass"),
            gained_brushed(GainFault::none, "gained_brushed")};
}

}  // namespace regain::planted
