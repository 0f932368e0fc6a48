// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "tailed.h"

#include <algorithm>
#include <cmath>

namespace regain::planted {
namespace {

constexpr double pi = 3.14159265358979323846;
// Narrower is a mirror, and nearer to gamma = 1 its limit.
constexpr double narrowest = 1e-6, nearest = 1e-9;

}  // namespace

Tailed::Tailed(double alpha, double gamma, TailFault fault)
{
    const double a = detail::sanitised(alpha, 0, 1, 1);
    _flat = a <= narrowest;
    // At 1 the formula is 0 / 0 for every gamma.
    _alpha = std::clamp(a, narrowest, 1 - 1e-6);
    _gamma = detail::sanitised(gamma, 1, 10, 2);
    _is_limit = std::abs(_gamma - 1) < nearest && fault != TailFault::limit_missing;
    const double l = 2 * std::log(_alpha), a2 = _alpha * _alpha;
    if (_is_limit)
        _peak = (a2 - 1) / (pi * (fault == TailFault::limit_off ? l / 2 : l));
    else
        _peak = (_gamma - 1) * (a2 - 1) / (pi * -std::expm1((1 - _gamma) * l));
}

double Tailed::D(const Direction& m) const
{
    const double a2 = _alpha * _alpha, sine2 = m.x * m.x + m.y * m.y;
    return _peak * std::pow(sine2 + a2 * m.z * m.z, -_gamma);
}

// By the inverse of D cos theta.
Direction Tailed::normal(double u, double v) const
{
    const double a2 = _alpha * _alpha, l = 2 * std::log(_alpha);
    // 1 + (a^2-1) cos^2, between a^2 at the top and 1.
    const double r = _is_limit
                         ? std::exp(l * (1 - v))
                         : std::pow(v + (1 - v) * std::exp((1 - _gamma) * l), 1 / (1 - _gamma));
    const double sine2 = std::clamp((r - a2) / (1 - a2), 0.0, 1.0), phi = 2 * pi * u;
    const double sine = std::sqrt(sine2);
    return {sine * std::cos(phi), sine * std::sin(phi), std::sqrt(1 - sine2)};
}

Tailed::Prepared::Prepared(const Tailed& tailed, const Direction& wo)
    : _tailed(tailed), _valid(detail::is_above_horizon(wo))
{
    if (_valid) _wo = detail::normalised(wo);
}

Tailed::Prepared::Terms Tailed::Prepared::terms(const Direction& wi) const
{
    Terms t;
    t.valid = _valid && !_tailed._flat && detail::is_above_horizon(wi);
    if (!t.valid) return t;
    const Direction sum = _wo + wi, h = detail::normalised(sum);
    // wo.h, which rounding makes negative at grazing.
    const double c = 0.5 * std::sqrt(detail::dot(sum, sum)), D = _tailed.D(h);
    // Cook and Torrance 1982, Eq. 9, over cos_o: finite at grazing.
    const double G = std::min(1 / _wo.z, 2 * h.z / c * std::min(1.0, wi.z / _wo.z));
    t.value = D * G / 4;
    t.density = D * h.z / (4 * c);
    return t;
}

Color Tailed::Prepared::eval(const Direction& wi) const
{
    const Terms t = terms(wi);
    return Color(t.valid ? t.value : 0);
}

double Tailed::Prepared::pdf(const Direction& wi) const
{
    const Terms t = terms(wi);
    return t.valid ? t.density : 0;
}

Sample<double> Tailed::Prepared::sample(const Direction& u) const
{
    Sample<double> s = nothing<double>();
    if (!_valid) return s;
    if (_tailed._flat)
    {
        s.wi = Direction(-_wo.x, -_wo.y, _wo.z);
        s.weight = Color(1.0);
        s.pdf = 1;
        s.valid = s.delta = true;
        return s;
    }
    const Direction m = _tailed.normal(detail::saturate(u.x), detail::saturate(u.y));
    const double c = detail::dot(_wo, m);
    if (c <= 0) return s;
    const Direction wi = m * (2 * c) - _wo;
    const Terms t = terms(wi);
    if (!t.valid) return s;
    s.wi = wi;
    s.pdf = t.density;
    s.weight = Color(t.value / t.density);
    s.valid = true;
    return s;
}

PlantedSubject tailed(TailFault fault, const std::string& name)
{
    Reads reads;
    reads.alpha = reads.gamma = reads.twice = true;
    reads.lowest_gamma = 1;
    reads.highest_gamma = 10;
    const auto subject = new_subject(name, reads, [fault](const Parameters& p) {
        return conformance::adapt(Tailed(p.alpha_x, p.gamma, fault));
    });
    subject->promiser = [](const Parameters&, const Direction&) {
        Promises promises;
        // G is at most 2 m.z cos_o / (wo.m).
        promises.weight = 2;
        promises.albedo = albedo_error;
        return promises;
    };
    return subject;
}

}  // namespace regain::planted
