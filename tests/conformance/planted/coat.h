// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A flat coat that mirrors over a white matte base, f = F + (1 - F) cos / pi with Schlick's F of
/// wo, chosen between by chance; and what can be done wrong with it.

#pragma once

#include "planted_subject.h"

namespace regain::planted {

enum class CoatFault {
    none,
    none_of_estimate,      ///< eval is an estimate, and says so
    probability_left_out,  ///< the mirror's weight is its energy, however seldom it is chosen
    divided_twice,         ///< by that probability
    negative_at_grazing,   ///< F of a fit that exceeds 1 there
    uniform_pdf,           ///< of a base that is sampled by the cosine, declared to be exact
    claims_a_density,      ///< for all that it samples
    estimate_unsaid,
    estimate_biased,  ///< by 5 %
    estimate_claims_to_be_reciprocal
};

class Coat
{
public:
    using Real = double;

    explicit Coat(CoatFault fault = CoatFault::none) : _fault(fault) {}

    Traits traits() const
    {
        Traits t;
        t.energy_preserving = t.exact_pdf = true;
        t.delta = _fault != CoatFault::claims_a_density;
        t.reciprocal = _fault == CoatFault::estimate_claims_to_be_reciprocal;
        t.stochastic_eval = is_estimate() && _fault != CoatFault::estimate_unsaid;
        t.random_numbers = 3;
        return t;
    }

    class Prepared;
    Prepared prepare(const Direction& wo) const;

private:
    bool is_estimate() const
    {
        switch (_fault)
        {
            case CoatFault::none_of_estimate:
            case CoatFault::estimate_unsaid:
            case CoatFault::estimate_biased:
            case CoatFault::estimate_claims_to_be_reciprocal: return true;
            default: return false;
        }
    }

    CoatFault _fault;
};

class Coat::Prepared
{
public:
    Prepared(const Coat& coat, const Direction& wo);
    Color eval(const Direction& wi, const Direction& u) const;
    double pdf(const Direction& wi) const;
    Sample<double> sample(const Direction& u) const;
    Albedo<double> albedo() const { return {Color(_valid ? 1 : 0), Color(0.0)}; }

private:
    double value(const Direction& wi) const;

    Coat _coat;
    bool _valid;
    Direction _wo{0, 0, 1};
    double _F = 0;
};

inline Coat::Prepared Coat::prepare(const Direction& wo) const { return Prepared(*this, wo); }

PlantedSubject coat(CoatFault fault, const std::string& name);

}  // namespace regain::planted
