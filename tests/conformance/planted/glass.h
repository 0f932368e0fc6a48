// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A rough interface after Walter et al. 2007 (Eqs. 20 and 21, as energy), by visible normals and
/// a choice by Fresnel's formulae, and what can be done wrong with it. Double alone.

#pragma once

#include "ggx_textbook.h"
#include "planted_subject.h"

namespace regain::planted {

enum class GlassFault {
    none,
    half_vector_jacobian_missing,  ///< of refraction, from the pdf
    eta_squared_missing,           ///< from eval and weight
    eta_squared_missing_in_pdf,    ///< and from eval: the same lobe, but never what is sampled
    eta_squared_doubled,
    total_reflection_ignored,
    lobe_probability_missing,  ///< from the pdf
    reflected_pdf_too_high,    ///< by 2 %, of that lobe alone
    fresnel_of_the_normal,
    never_below,  ///< the sampler's lower hemisphere is empty
    /// BSDL, MaterialX dielectric by default: normals from the bounded cap, which is for reflection
    /// alone, while eval and pdf know every refracted direction; its pdf integrates to 1.86.
    bounded_normals,
    /// Cycles: eval and pdf know pairs of directions that no facet joins; its pdf integrates to
    /// 2.59.
    impossible_pairs,
    jump_at_one,  ///< of eta: what passes straight on weighs 1, what is hardly bent G2 / G1
    claims_two_numbers,
    claims_to_be_opaque
};

class Glass
{
public:
    using Real = double;

    /// eta: index below over index above, in [0.1, 10].
    Glass(double alpha_x, double alpha_y, double eta, GlassFault fault = GlassFault::none);

    Traits traits() const;

    class Prepared;
    Prepared prepare(const Direction& wo) const;

private:
    GgxTextbook<double> _ggx;
    double _eta;
    GlassFault _fault;
};

/// Works above the surface; what is seen from below is mirrored.
class Glass::Prepared
{
public:
    Prepared(const Glass& glass, const Direction& wo);
    Color eval(const Direction& wi) const;
    double pdf(const Direction& wi) const;
    Sample<double> sample(const Direction& u) const;
    Albedo<double> albedo() const { return detail::mean_weight<double>(*this); }

    /// What the two lobes of the normal of u weigh together, each by its share. On either
    /// side: refraction counts, too, that leaves through the wrong side of the surface.
    double weight_of_both(const Direction& u, bool on_either_side = false) const;

private:
    struct Terms
    {
        bool valid = false, reflected = true;
        double value = 0, density = 0;  // f cos theta_i; per steradian
    };

    bool has(GlassFault fault) const { return _glass._fault == fault; }
    double F(double cos_facet) const;
    Terms terms(const Direction& wi) const;
    void refract(const Direction& wi, Terms& t) const;
    double shadowing(double cos_i, const Direction& wi) const;
    // Where it is refracted at the facet m, or straight on where nothing is.
    Direction refracted(const Direction& m) const;
    Sample<double> passed_straight(double F) const;

    Glass _glass;
    bool _valid, _narrow;
    double _side = 1, _eta, _share = 1, _visible_area;
    Direction _wo{0, 0, 1};
};

inline Glass::Prepared Glass::prepare(const Direction& wo) const { return Prepared(*this, wo); }

PlantedSubject glass(GlassFault fault, const std::string& name);

}  // namespace regain::planted
