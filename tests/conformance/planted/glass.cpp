// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "glass.h"

#include <regain/closures/dielectric.h>

namespace regain::planted {
namespace {

// At and below this |eta - 1| alpha, refracted light keeps its direction.
constexpr double narrowest = 1e-7;

Direction flipped(const Direction& w, double side) { return {w.x, w.y, w.z * side}; }

}  // namespace

Glass::Glass(double alpha_x, double alpha_y, double eta, GlassFault fault)
    : _ggx(alpha_x, alpha_y), _eta(detail::sanitised(eta, 0.1, 10, 1.5)), _fault(fault)
{}

Traits Glass::traits() const
{
    Traits t;
    t.reciprocal = t.exact_pdf = true;
    t.delta = _ggx.is_flat || std::abs(_eta - 1) * std::max(_ggx.ax, _ggx.ay) <= narrowest;
    t.transmissive = _fault != GlassFault::claims_to_be_opaque;
    t.anisotropic = _ggx.ax != _ggx.ay;
    t.random_numbers = _fault == GlassFault::claims_two_numbers ? 2 : 3;
    return t;
}

Glass::Prepared::Prepared(const Glass& glass, const Direction& wo)
    : _glass(glass), _valid(detail::is_off_horizon(wo)), _narrow(glass.traits().delta)
{
    if (_valid) _side = wo.z < 0 ? -1 : 1, _wo = detail::normalised(flipped(wo, _side));
    _eta = _side > 0 ? glass._eta : 1 / glass._eta;
    const GgxTextbook<double>& ggx = _glass._ggx;
    if (has(GlassFault::bounded_normals))
    {
        // Eto and Tokuyoshi 2023, Eq. 5.
        const double a = std::min(ggx.ax, ggx.ay), s = 1 + std::hypot(_wo.x, _wo.y);
        _share = (1 - a * a) * s * s / (s * s + a * a * _wo.z * _wo.z);
    }
    _visible_area = (_share * _wo.z + ggx.stretched_length(_wo)) / 2;
}

// Unpolarised, from c = wo.m (Born and Wolf 1999, Section 1.5.2).
double Glass::Prepared::F(double c) const
{
    if (has(GlassFault::total_reflection_ignored))
    {
        const double f = (_eta - 1) / (_eta + 1), x = 1 - c;
        return f * f + (1 - f * f) * x * x * x * x * x;
    }
    if (has(GlassFault::fresnel_of_the_normal)) c = _wo.z;
    const double sin2_t = (1 - c * c) / (_eta * _eta);
    if (sin2_t >= 1) return 1;
    const double t = std::sqrt(1 - sin2_t);
    const double s = (c - _eta * t) / (c + _eta * t), p = (_eta * c - t) / (_eta * c + t);
    return (s * s + p * p) / 2;
}

// G2 / cos_o: that of reflection on either side (Heitz 2014, Eq. 99).
double Glass::Prepared::shadowing(double cos_i, const Direction& wi) const
{
    return 4 * cos_i * _glass._ggx.visibility(_wo, Direction(wi.x, wi.y, cos_i));
}

Glass::Prepared::Terms Glass::Prepared::terms(const Direction& direction) const
{
    Terms t;
    if (!_valid || _glass._ggx.is_flat || !detail::is_off_horizon(direction)) return t;
    const Direction wi = flipped(direction, _side);
    t.reflected = wi.z > 0;
    if (!t.reflected)
    {
        if (!_narrow) refract(wi, t);
        return t;
    }
    const Direction h = detail::normalised(_wo + wi);
    const double D = _glass._ggx.D(h), f = F(std::min(1.0, detail::dot(_wo, h)));
    t.valid = f > 0;
    t.value = f * D * shadowing(wi.z, wi) / 4;
    t.density = f * D / (4 * _visible_area);
    if (has(GlassFault::lobe_probability_missing)) t.density /= f;
    if (has(GlassFault::reflected_pdf_too_high)) t.density *= 1.02;
    return t;
}

void Glass::Prepared::refract(const Direction& wi, Terms& t) const
{
    Direction h = _wo + wi * _eta;
    const double length2 = detail::dot(h, h);
    if (length2 < 1e-20) return;
    h *= (h.z < 0 ? -1 : 1) / std::sqrt(length2);
    double c_o = detail::dot(_wo, h), c_i = -detail::dot(wi, h);
    const bool joined = c_o > 0 && c_i > 0;
    if (!joined && !has(GlassFault::impossible_pairs)) return;
    c_o = std::min(1.0, std::abs(c_o));
    c_i = std::abs(c_i);
    const double passed = 1 - F(c_o), D = _glass._ggx.D(h), eta2 = _eta * _eta;
    if (!(passed > 0)) return;
    t.valid = true;
    const double jacobian = c_i * eta2 / length2;
    t.value = passed * D * shadowing(-wi.z, wi) * c_o * jacobian;
    t.density = passed * D * c_o / _visible_area * jacobian;
    if (has(GlassFault::half_vector_jacobian_missing)) t.density /= jacobian;
    if (has(GlassFault::eta_squared_missing) || has(GlassFault::eta_squared_missing_in_pdf))
        t.value /= eta2;
    if (has(GlassFault::eta_squared_missing_in_pdf)) t.density /= eta2;
    if (has(GlassFault::eta_squared_doubled)) t.value *= eta2;
    if (has(GlassFault::lobe_probability_missing)) t.density /= passed;
}

Color Glass::Prepared::eval(const Direction& wi) const
{
    const Terms t = terms(wi);
    return Color(t.valid ? t.value : 0);
}

double Glass::Prepared::pdf(const Direction& wi) const
{
    const Terms t = terms(wi);
    return t.valid ? t.density : 0;
}

// Walter et al. 2007, Eq. 40.
Direction Glass::Prepared::refracted(const Direction& m) const
{
    const double c = detail::dot(_wo, m), r = 1 + (c * c - 1) / (_eta * _eta);
    const double t = std::sqrt(std::max(0.0, r));
    return detail::normalised(m * (c / _eta - t) - _wo * (1 / _eta));
}

// Of a surface that is flat all passes; of a rough one that bends nothing, what its facets leave.
Sample<double> Glass::Prepared::passed_straight(double F) const
{
    Sample<double> s = nothing<double>();
    const Direction wi = refracted(Direction(0, 0, 1));
    if (!detail::is_above_horizon(-wi)) return s;
    s.wi = flipped(wi, _side);
    const double rough = shadowing(-wi.z, wi) * _visible_area;
    s.weight = Color(_glass._ggx.is_flat || has(GlassFault::jump_at_one) ? 1 : rough);
    s.pdf = 1 - F;
    s.valid = s.delta = s.transmitted = true;
    return s;
}

Sample<double> Glass::Prepared::sample(const Direction& u) const
{
    const Sample<double> none = nothing<double>();
    if (!_valid) return none;
    const GgxTextbook<double>& ggx = _glass._ggx;
    const Direction m =
        ggx.is_flat ? Direction(0, 0, 1)
                    : ggx.visible(_wo, detail::saturate(u.x), detail::saturate(u.y), _share);
    const double f = F(std::min(1.0, detail::dot(_wo, m)));
    const bool reflects = f >= 1 || detail::saturate(u.z) < f;
    if (!reflects && has(GlassFault::never_below)) return none;
    if (!reflects && _narrow) return passed_straight(f);

    Sample<double> s = none;
    const Direction wi = reflects ? reflected(_wo, m) : refracted(m);
    if ((wi.z > 0) != reflects) return none;
    s.wi = flipped(wi, _side);
    s.transmitted = !reflects;
    s.valid = true;
    s.delta = ggx.is_flat;
    const Terms t = terms(s.wi);
    if (!s.delta && !t.valid) return none;
    s.pdf = s.delta ? f : t.density;
    s.weight = Color(s.delta ? 1 : t.value / t.density);
    return s;
}

double Glass::Prepared::weight_of_both(const Direction& u, bool on_either_side) const
{
    const Direction m = _glass._ggx.visible(_wo, u.x, u.y);
    const double f = F(std::min(1.0, detail::dot(_wo, m)));
    const Direction up = reflected(_wo, m), down = refracted(m);
    double weight = 0;
    if (up.z > 0) weight += f * shadowing(up.z, up) * _visible_area;
    if (f < 1 && (down.z < 0 || on_either_side))
        weight += (1 - f) * shadowing(std::abs(down.z), down) * _visible_area;
    return weight;
}

PlantedSubject glass(GlassFault fault, const std::string& name)
{
    Reads reads;
    reads.alpha = reads.two_alphas = reads.eta = reads.twice = true;
    const auto subject = new_subject(name, reads, [fault](const Parameters& p) {
        return conformance::adapt(Glass(p.alpha_x, p.alpha_y, p.eta, fault));
    });
    subject->promiser = [](const Parameters&, const Direction&) {
        Promises promises;
        promises.tint = 1e-3;
        promises.albedo = albedo_error;
        return promises;
    };
    subject->compared_with = new_subject(name + ".library", reads, [](const Parameters& p) {
        return conformance::adapt(
            Dielectric<GGX<double>>(GGX<double>(p.alpha_x, p.alpha_y), p.eta));
    });
    return subject;
}

}  // namespace regain::planted
