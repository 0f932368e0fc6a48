// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Any material whose closure answers as in <regain/closures/closure.h>, behind the one-point
/// interface of host.h. A material is what <regain/shaders/material.h> describes; the object that
/// the callbacks are given is a `const Material*`.

#pragma once

#include <regain/clarisse/host.h>
#include <regain/closures/compensated.h>

#include <cmath>

REGAIN_NAMESPACE_BEGIN
namespace clarisse {

/// One closure as a lobe. The host's wi is the closure's wo and the other way round.
template <class Closure>
class ClosureLobe final : public bxdf_lobe<typename Closure::Real>
{
public:
    using Real = typename Closure::Real;

    /// view and ng are in the lobe's frame: the known direction it is prepared for, and the
    /// geometric normal on the viewer's side.
    ClosureLobe(const Closure& closure, const char* name, const vec3<Real>& view,
                const vec3<Real>& ng)
        : _closure(closure), _prepared(closure.prepare(view)), _view(view), _ng(ng), _name(name)
    {}

    lobe_label label() const override
    {
        return {event::reflection, is_singular() ? scatter::singular : scatter::glossy, _name};
    }

    Real roughness() const override
    {
        const auto& d = _closure.lobe().distribution();
        return is_singular() ? Real(0) : d.alpha_x() < d.alpha_y() ? d.alpha_y() : d.alpha_x();
    }

    Real sample(const vec3<Real>& wi, Real u, Real v, Real, vec3<Real>& wo, color<Real>& weight,
                Real* reverse_pdf) const override
    {
        const Sample<Real> s = with_known(wi, [&](const auto& p) { return p.sample({u, v}); });
        wo = s.wi;
        if (!s.valid || !(_ng.dot(wo) > 0)) return none(weight, reverse_pdf);
        weight = s.weight;
        if (reverse_pdf) *reverse_pdf = s.delta ? s.pdf : _closure.pdf(wo, wi);
        return s.pdf;
    }

    Real evaluate(const vec3<Real>& wi, const vec3<Real>& wo, color<Real>& weight,
                  Real* reverse_pdf) const override
    {
        if (!(_ng.dot(wo) > 0)) return none(weight, reverse_pdf);
        const Real pdf = with_known(wi, [&](const auto& p) {
            const Real density = p.pdf(wo);
            if (density > 0) weight = p.eval(wo) * (Real(1) / density);
            return density;
        });
        if (!(pdf > 0)) return none(weight, reverse_pdf);
        if (reverse_pdf) *reverse_pdf = _closure.pdf(wo, wi);
        return pdf;
    }

    color<Real> albedo(const vec3<Real>& wi) const override
    {
        return with_known(wi, [](const auto& p) { return p.albedo().reflect; });
    }

private:
    bool is_singular() const { return _closure.traits().delta; }

    static Real none(color<Real>& weight, Real* reverse_pdf)
    {
        weight = color<Real>(Real(0));
        if (reverse_pdf) *reverse_pdf = 0;
        return 0;
    }

    // Hosts nearly always ask about the direction the lobe was made for.
    template <class Ask>
    auto with_known(const vec3<Real>& wi, const Ask& ask) const
    {
        return wi == _view ? ask(_prepared) : ask(_closure.prepare(wi));
    }

    Closure _closure;
    typename Closure::Prepared _prepared;
    vec3<Real> _view, _ng;
    const char* _name;
};

namespace detail {

template <class Material, class Real>
bool create_lobes(const void* data, const shading_point<Real>& point, scratchpad& pad,
                  lobe_list<Real>& list)
{
    const Material& material = *static_cast<const Material*>(data);
    const auto closure = material.closure(point.multiple_scattering_strength);
    using Lobe = ClosureLobe<std::decay_t<decltype(closure)>>;

    // Which way the surface faces: single-sided ones are black from behind, inverted ones from the
    // front, double-sided ones turn towards the viewer.
    const bool front = point.front_facing;
    if (point.sides == sidedness::single_sided && !front) return true;
    if (point.sides == sidedness::inverted && front) return true;
    const Real side = front ? Real(1) : Real(-1);

    lobe_entry<Real> entry;
    entry.z = point.ns * side;
    vec3<Real> t = point.tangent - entry.z * entry.z.dot(point.tangent);
    if (!(t.dot(t) > Real(1e-12)))
    {
        const vec3<Real> axis =
            entry.z.x * entry.z.x < Real(0.5) ? vec3<Real>(1, 0, 0) : vec3<Real>(0, 1, 0);
        t = axis - entry.z * entry.z.dot(axis);
    }
    entry.x = t * (Real(1) / std::sqrt(t.dot(t)));
    entry.y = entry.z.cross(entry.x);

    const auto local = [&](const vec3<Real>& w) {
        return vec3<Real>(w.dot(entry.x), w.dot(entry.y), w.dot(entry.z));
    };
    const lobe_label label{event::reflection,
                           closure.traits().delta ? scatter::singular : scatter::glossy, ""};
    if (!(label.category() & point.wanted)) return true;

    entry.lobe =
        pad.make<Lobe>(closure, material.lobe_name(), local(point.view), local(point.ng * side));
    return list.add(entry);
}

}  // namespace detail

/// The callbacks of one kind of material. The object outlives its data and is not changed
/// meanwhile.
template <class Material, class Real>
material_callbacks<Real> closure_callbacks()
{
    material_callbacks<Real> c;
    c.create_module_data = [](const void* object) { return const_cast<void*>(object); };
    c.destroy_module_data = [](const void*, void*) {};
    c.create_lobes = &detail::create_lobes<Material, Real>;
    return c;
}

}  // namespace clarisse
REGAIN_NAMESPACE_END
