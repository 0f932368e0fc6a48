// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A GGX mirror of Schlick's colour, as a textbook has it (Torrance and Sparrow 1967; Walter et
/// al. 2007, Eq. 20), and what can be done wrong with it.

#pragma once

#include "ggx_textbook.h"
#include "planted_subject.h"

namespace regain::planted {

enum class MirrorFault {
    none,
    half_vector_jacobian_missing,  ///< from the pdf
    masking_without_shadowing,     ///< G1 for G2
    widths_swapped_in_sample,
    widths_swapped_in_D,
    roughness_not_squared,
    fresnel_of_the_normal,  ///< F(n.wo) for F(h.wo)
    fresnel_twice_in_weight,
    schlick_to_the_fourth,
    cosine_kept_from_grazing,  ///< cos theta_o at least 0.05
    pdf_a_fiftieth_too_high,
    azimuth_biased,  ///< by 1 %
    nan_at_one,      ///< u = 1
    /// MaterialX, GLSL generator: D of two widths, G2 of their mean; its furnace is 0.31 to 3.07.
    isotropic_masking,
    /// Adobe's openpbr-bsdf: a bound that sample puts on D G2 F before it is divided by cosines and
    /// eval after that; weights differ from eval / pdf by up to 5.8 %.
    clamped_before_the_ratio,
    sine_from_cosine,  ///< of D, by 1 - cos^2: in float it cancels
    claims_to_preserve_energy,
    claims_to_be_isotropic
};

template <class RealType>
class Mirror
{
public:
    using Real = RealType;
    using V = Vec3<Real>;
    using C = Color3<Real>;

    Mirror(Real alpha_x, Real alpha_y, const C& F0, MirrorFault fault = MirrorFault::none)
        : _ggx(fault == MirrorFault::roughness_not_squared ? root(alpha_x) : alpha_x,
               fault == MirrorFault::roughness_not_squared ? root(alpha_y) : alpha_y),
          _F0(detail::per_channel(F0, [](Real v) { return detail::saturate(v); })),
          _fault(fault)
    {}

    Traits traits() const
    {
        Traits t;
        t.reciprocal = t.exact_pdf = true;
        t.energy_preserving = _fault == MirrorFault::claims_to_preserve_energy;
        t.delta = _ggx.is_flat;
        t.anisotropic = _ggx.ax != _ggx.ay && _fault != MirrorFault::claims_to_be_isotropic;
        t.random_numbers = 2;
        return t;
    }

    class Prepared
    {
    public:
        Prepared(const Mirror& mirror, const V& wo)
            : _mirror(mirror), _valid(detail::is_above_horizon(wo))
        {
            if (_valid) _wo = detail::normalised(wo);
        }

        C eval(const V& wi) const
        {
            const Terms t = terms(wi);
            if (!t.valid) return C(0);
            const C f = t.fresnel * t.value;
            if (!has(MirrorFault::clamped_before_the_ratio)) return f;
            return detail::per_channel(f, [](Real v) { return std::min(v, highest); });
        }
        Real pdf(const V& wi) const
        {
            const Terms t = terms(wi);
            return t.valid ? t.density : 0;
        }
        Sample<Real> sample(const V& u) const;
        Albedo<Real> albedo() const { return detail::mean_weight<Real>(*this); }

    private:
        struct Terms
        {
            bool valid = false;
            C fresnel;
            Real value = 0, density = 0;  // f cos theta_i with F = 1; per steradian
        };

        bool has(MirrorFault fault) const { return _mirror._fault == fault; }
        Terms terms(const V& direction) const;
        Real D(const V& m) const;
        Real value(const V& wi, const V& h) const;

        Mirror _mirror;
        bool _valid;
        V _wo{0, 0, 1};
    };

    Prepared prepare(const V& wo) const { return Prepared(*this, wo); }

private:
    static constexpr Real highest = Real(1e4);

    static Real root(Real alpha) { return std::sqrt(detail::sanitised(alpha, 0, 1, 1)); }

    // F0 + (1 - F0) (1 - cos)^5, Schlick 1994, Eq. 15.
    C F(Real cosine) const
    {
        const Real x = std::max(Real(0), 1 - cosine);
        const Real power =
            x * x * x * x * (_fault == MirrorFault::schlick_to_the_fourth ? Real(1) : x);
        return detail::per_channel(_F0, [power](Real f) { return f + (1 - f) * power; });
    }

    GgxTextbook<Real> _ggx;
    C _F0;
    MirrorFault _fault;
};

/// Computed in float and double, compared with the library's own colour.
PlantedSubject mirror(MirrorFault fault, const std::string& name);

}  // namespace regain::planted
