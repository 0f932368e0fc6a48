// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "mirror.h"

#include <regain/closures/generalized_schlick.h>

namespace regain::planted {

template <class Real>
Real Mirror<Real>::Prepared::D(const V& m) const
{
    const GgxTextbook<Real>& ggx = _mirror._ggx;
    if (has(MirrorFault::widths_swapped_in_D))
    {
        GgxTextbook<Real> swapped = ggx;
        std::swap(swapped.ax, swapped.ay);
        return swapped.D(m);
    }
    if (has(MirrorFault::sine_from_cosine) && ggx.ax == ggx.ay)
    {
        const Real c2 = m.z * m.z, a2 = ggx.ax * ggx.ax, r = c2 + (1 - c2) / a2;
        return 1 / (pi<Real> * a2 * r * r);
    }
    return ggx.D(m);
}

// D G2 / (4 cos_o cos_i) cos_i.
template <class Real>
Real Mirror<Real>::Prepared::value(const V& wi, const V& h) const
{
    const GgxTextbook<Real>& ggx = _mirror._ggx;
    if (has(MirrorFault::masking_without_shadowing)) return D(h) * ggx.G1(_wo) / (4 * _wo.z);
    if (has(MirrorFault::isotropic_masking))
    {
        const Real mean = std::sqrt(ggx.ax * ggx.ay);
        return D(h) * GgxTextbook<Real>(mean, mean).visibility(_wo, wi) * wi.z;
    }
    const Real value = D(h) * ggx.visibility(_wo, wi) * wi.z;
    return has(MirrorFault::cosine_kept_from_grazing) ? value * _wo.z / std::max(_wo.z, Real(0.05))
                                                      : value;
}

template <class Real>
typename Mirror<Real>::Prepared::Terms Mirror<Real>::Prepared::terms(const V& wi) const
{
    const GgxTextbook<Real>& ggx = _mirror._ggx;
    Terms t;
    t.valid = _valid && !ggx.is_flat && detail::is_above_horizon(wi);
    if (!t.valid) return t;
    const V h = detail::normalised(_wo + wi);
    const Real cos_facet = std::min(Real(1), detail::dot(_wo, h));
    t.fresnel = _mirror.F(has(MirrorFault::fresnel_of_the_normal) ? _wo.z : cos_facet);
    t.value = value(wi, h);
    // The density of visible normals, over 4 wo.h.
    t.density = D(h) / (4 * ggx.projected_area(_wo));
    if (has(MirrorFault::half_vector_jacobian_missing)) t.density *= 4 * cos_facet;
    if (has(MirrorFault::pdf_a_fiftieth_too_high)) t.density *= Real(1.02);
    return t;
}

template <class Real>
Sample<Real> Mirror<Real>::Prepared::sample(const V& u) const
{
    Sample<Real> s = nothing<Real>();
    if (!_valid) return s;
    Real a = detail::saturate(u.x);
    const Real b = detail::saturate(u.y);
    if (has(MirrorFault::azimuth_biased)) a *= Real(0.99);
    GgxTextbook<Real> ggx = _mirror._ggx;
    if (has(MirrorFault::widths_swapped_in_sample)) std::swap(ggx.ax, ggx.ay);
    V wi = ggx.is_flat ? V(-_wo.x, -_wo.y, _wo.z) : reflected(_wo, ggx.visible(_wo, a, b));
    // Any stretch of u whose quotient is 0 / 0 at its end.
    if (has(MirrorFault::nan_at_one)) wi *= (1 - b) / (1 - b);
    if (ggx.is_flat)
    {
        s.wi = wi;
        s.weight = _mirror.F(_wo.z);
        s.pdf = 1;
        s.valid = s.delta = true;
        return s;
    }
    const Terms t = terms(wi);
    if (!t.valid && !std::isnan(wi.z)) return s;
    s.valid = true;
    s.wi = wi;
    s.pdf = t.density;
    Real value = t.value;
    if (has(MirrorFault::clamped_before_the_ratio))
        value = std::min(value * 4 * _wo.z, highest) / (4 * _wo.z);
    s.weight = t.fresnel * (value / t.density);
    if (has(MirrorFault::fresnel_twice_in_weight)) s.weight *= t.fresnel;
    return s;
}

template class Mirror<float>;
template class Mirror<double>;

namespace {

Color F0_of(const Parameters& p)
{
    return p.reflectance == conformance::Reflectance::schlick ? p.F0 : Color(1.0);
}

template <class Real>
std::unique_ptr<TestedClosure> made(const Parameters& p, MirrorFault fault)
{
    return conformance::adapt(Mirror<Real>(
        static_cast<Real>(p.alpha_x), static_cast<Real>(p.alpha_y), Color3<Real>(F0_of(p)), fault));
}

class Normals final : public TestedNormals
{
public:
    Normals(const Parameters& p, MirrorFault fault)
        : _of_D(fault == MirrorFault::widths_swapped_in_D ? GgxTextbook(p.alpha_y, p.alpha_x)
                                                          : GgxTextbook(p.alpha_x, p.alpha_y)),
          _of_sample(fault == MirrorFault::widths_swapped_in_sample
                         ? GgxTextbook(p.alpha_y, p.alpha_x)
                         : GgxTextbook(p.alpha_x, p.alpha_y)),
          _ggx(p.alpha_x, p.alpha_y)
    {}

    double D(const Direction& m) const override { return _of_D.D(m); }
    double projected_area(const Direction& w) const override { return _ggx.projected_area(w); }
    double G1(const Direction& w) const override { return _ggx.G1(w); }
    double G2(const Direction& a, const Direction& b) const override { return _ggx.G2(a, b); }
    Direction sample_visible(const Direction& wo, const Direction& u) const override
    {
        return _of_sample.visible(wo, u.x, u.y);
    }

private:
    GgxTextbook<double> _of_D, _of_sample, _ggx;
};

}  // namespace

PlantedSubject mirror(MirrorFault fault, const std::string& name)
{
    Reads reads;
    reads.alpha = reads.two_alphas = reads.schlick = reads.single = reads.twice = true;
    const auto subject = new_subject(name, reads, [fault](const Parameters& p) {
        return p.in_double ? made<double>(p, fault) : made<float>(p, fault);
    });
    subject->promiser = [](const Parameters&, const Direction&) {
        Promises promises;
        promises.tint = 1e-3;
        promises.albedo = albedo_error;
        return promises;
    };
    subject->normals_maker = [fault](const Parameters& p) {
        return std::make_unique<Normals>(p, fault);
    };
    subject->compared_with = new_subject(name + ".library", reads, [](const Parameters& p) {
        return conformance::adapt(GeneralizedSchlick<double>(GGX<double>(p.alpha_x, p.alpha_y),
                                                             SchlickFresnel<double>(F0_of(p))));
    });
    return subject;
}

}  // namespace regain::planted
