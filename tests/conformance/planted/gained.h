// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Lobes of this folder under a gain by tables of their own, 1 + F_ms (1 - E) / E (Turquin 2019,
/// Eqs. 8 and 10, F_ms = F0), and what can be done wrong with that. Double alone.

#pragma once

#include "energy_table.h"
#include "planted_subject.h"

#include <regain/closures/refraction.h>

namespace regain::planted {

enum class GainFault {
    none,
    in_sample_only,
    table_transposed,
    table_half_a_texel_off,
    claims_to_be_reciprocal,
    albedo_without_it,  ///< albedo() is that of one bounce: a host's layer under it gains
    // Of glass:
    other_side,        ///< E of 1 / eta for eta
    stale_other_side,  ///< Cycles, glass from inside: the table was made when the sampler let light
                       ///< refract back up; the furnace falls to 0.77
    // Of a brushed mirror:
    isotropic_energy  ///< Cycles, BSDL: E of the mean width sqrt(alpha_x alpha_y); 0.66 to 1.04
};

/// Any lobe, times a gain that is known before any direction is.
template <class Lobe>
class Gained
{
public:
    using Real = double;
    /// Of wo.
    using Gain = std::function<Color(const Direction&)>;

    Gained(const Lobe& lobe, Gain gain, GainFault fault)
        : _lobe(lobe), _gain(std::move(gain)), _fault(fault)
    {}

    Traits traits() const
    {
        Traits t = _lobe.traits();
        t.reciprocal = _fault == GainFault::claims_to_be_reciprocal;
        t.energy_preserving = true;
        return t;
    }

    class Prepared
    {
    public:
        Prepared(const Gained& gained, const Direction& wo)
            : _lobe(gained._lobe.prepare(wo)),
              _fault(gained._fault),
              _gain(detail::is_off_horizon(wo) ? gained._gain(detail::normalised(wo)) : Color(1.0))
        {}

        Color eval(const Direction& wi) const
        {
            const Color f = _lobe.eval(wi);
            return _fault == GainFault::in_sample_only ? f : f * _gain;
        }
        double pdf(const Direction& wi) const { return _lobe.pdf(wi); }
        Sample<double> sample(const Direction& u) const
        {
            Sample<double> s = _lobe.sample(u);
            s.weight *= _gain;
            return s;
        }
        Albedo<double> albedo() const
        {
            const Albedo<double> once = _lobe.albedo();
            if (_fault == GainFault::albedo_without_it) return once;
            return {once.reflect * _gain, once.transmit * _gain};
        }

    private:
        typename Lobe::Prepared _lobe;
        GainFault _fault;
        Color _gain;
    };

    Prepared prepare(const Direction& wo) const { return Prepared(*this, wo); }

private:
    Lobe _lobe;
    Gain _gain;
    GainFault _fault;
};

/// Of one width.
PlantedSubject gained_mirror(GainFault fault, const std::string& name);
/// Of eta 1.5 from either side, a table each.
PlantedSubject gained_glass(GainFault fault, const std::string& name);
/// alpha_y a quarter of alpha_x always, over the azimuth, too.
PlantedSubject gained_brushed(GainFault fault, const std::string& name);

}  // namespace regain::planted
