// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A mirror of GTR's normals (Burley 2012, appendix B) under Cook and Torrance's masking, whose
/// grooves hide the right area of any distribution (Heitz 2014, Section 4.1); by normals drawn from
/// D. And what can be done wrong with it.
///
///   D(m) = (gamma-1) (a^2-1) / (pi (1 - a^(2 (1-gamma)))) (1 + (a^2-1) cos^2)^(-gamma)
///   gamma = 1: (a^2-1) / (pi ln a^2) / (1 + (a^2-1) cos^2)

#pragma once

#include "planted_subject.h"

namespace regain::planted {

enum class TailFault {
    none,
    limit_missing,  ///< at gamma = 1
    limit_off       ///< there: ln a for ln a^2
};

class Tailed
{
public:
    using Real = double;

    Tailed(double alpha, double gamma, TailFault fault = TailFault::none);

    Traits traits() const
    {
        Traits t;
        t.reciprocal = t.exact_pdf = true;
        t.delta = _flat;
        t.random_numbers = 2;
        return t;
    }

    class Prepared;
    Prepared prepare(const Direction& wo) const;

private:
    double D(const Direction& m) const;
    Direction normal(double u, double v) const;

    double _alpha, _gamma, _peak;  // D(0, 0, 1) alpha^(2 gamma)
    bool _flat, _is_limit;
};

class Tailed::Prepared
{
public:
    Prepared(const Tailed& tailed, const Direction& wo);
    Color eval(const Direction& wi) const;
    double pdf(const Direction& wi) const;
    Sample<double> sample(const Direction& u) const;
    Albedo<double> albedo() const { return detail::mean_weight<double>(*this); }

private:
    struct Terms
    {
        bool valid = false;
        double value = 0, density = 0;
    };
    Terms terms(const Direction& wi) const;

    Tailed _tailed;
    bool _valid;
    Direction _wo{0, 0, 1};
};

inline Tailed::Prepared Tailed::prepare(const Direction& wo) const { return Prepared(*this, wo); }

PlantedSubject tailed(TailFault fault, const std::string& name);

}  // namespace regain::planted
