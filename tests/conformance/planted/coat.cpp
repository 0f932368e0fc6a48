// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "coat.h"

#include <cmath>

namespace regain::planted {
namespace {

constexpr double pi = 3.14159265358979323846;
// Of the samples, whatever F is: so that a weight is no longer 1 by itself.
constexpr double mirror_share = 0.25;

double schlick(double cosine)
{
    const double x = 1 - cosine;
    return 0.04 + 0.96 * x * x * x * x * x;
}

}  // namespace

Coat::Prepared::Prepared(const Coat& coat, const Direction& wo)
    : _coat(coat), _valid(detail::is_above_horizon(wo))
{
    if (!_valid) return;
    _wo = detail::normalised(wo);
    _F = schlick(std::min(1.0, _wo.z));
    if (_coat._fault == CoatFault::negative_at_grazing) _F *= 1.05;
}

double Coat::Prepared::value(const Direction& wi) const
{
    return _valid && detail::is_above_horizon(wi) ? (1 - _F) * wi.z / pi : 0;
}

// An estimate is nothing, or as much more in its stead.
Color Coat::Prepared::eval(const Direction& wi, const Direction& u) const
{
    if (!_coat.is_estimate()) return Color(value(wi));
    const double times = _coat._fault == CoatFault::estimate_biased ? 2.1 : 2;
    return Color(std::isless(u.x, 0.5) ? times * value(wi) : 0);
}

double Coat::Prepared::pdf(const Direction& wi) const
{
    if (!_valid || !detail::is_above_horizon(wi)) return 0;
    return (1 - mirror_share) * (_coat._fault == CoatFault::uniform_pdf ? 0.5 : wi.z) / pi;
}

Sample<double> Coat::Prepared::sample(const Direction& u) const
{
    Sample<double> s = nothing<double>();
    if (!_valid) return s;
    if (detail::saturate(u.z) < mirror_share)
    {
        s.wi = Direction(-_wo.x, -_wo.y, _wo.z);
        s.pdf = mirror_share;
        const double times = _coat._fault == CoatFault::probability_left_out ? 0
                             : _coat._fault == CoatFault::divided_twice      ? 2
                                                                             : 1;
        s.weight = Color(_F / std::pow(mirror_share, times));
        s.valid = s.delta = true;
        return s;
    }
    const double r2 = detail::saturate(u.x), r = std::sqrt(r2);
    const double phi = 2 * pi * detail::saturate(u.y);
    s.wi = Direction(r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - r2));
    if (!detail::is_above_horizon(s.wi))
    {
        s.wi = Direction(0, 0, 1);
        return s;
    }
    s.valid = true;
    s.pdf = pdf(s.wi);
    s.weight = Color(value(s.wi) / s.pdf);
    return s;
}

PlantedSubject coat(CoatFault fault, const std::string& name)
{
    Reads reads;
    reads.twice = true;
    const auto subject = new_subject(
        name, reads, [fault](const Parameters&) { return conformance::adapt(Coat(fault)); });
    subject->promiser = [](const Parameters&, const Direction&) {
        Promises promises;
        promises.weight = 1 / mirror_share;
        return promises;
    };
    return subject;
}

}  // namespace regain::planted
