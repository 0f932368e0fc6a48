// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Any material whose closure answers as in <regain/closures/closure.h>, behind the one-point
/// interface of host.h. A material is what <regain/shaders/material.h> describes; the object that
/// the callbacks are given is a `const Material*`.
///
/// A material of several closures gives each its entry weight, what is under a layer by the albedos
/// of what lies on it.
///
/// A closure is one lobe; an interface between two media is one, too, with the event `either`,
/// because its sampler picks the event. Only a closure whose samples are of both kinds, with and
/// without density, becomes two lobes, of which each passes on its own kind.

#pragma once

#include <regain/clarisse/host.h>
#include <regain/closures/point_lobe.h>

REGAIN_NAMESPACE_BEGIN
namespace clarisse {

/// One closure as a lobe. The host's wi is the closure's wo and the other way round.
template <class Closure>
class ClosureLobe final : public bxdf_lobe<typename Closure::Real>
{
public:
    using Real = typename Closure::Real;

    /// view and ng are in the lobe's frame: the known direction it is prepared for, and the
    /// geometric normal on the side of +z. Of the closure's samples the lobe is those that have a
    /// density, or those that have none.
    ClosureLobe(const Closure& closure, const char* name, const vec3<Real>& view,
                const vec3<Real>& ng, scatter kind)
        : _lobe(closure, view, ng, lobe_label{event::reflection, kind, name}.is_singular()),
          _name(name),
          _kind(kind)
    {}

    lobe_label label() const override
    {
        const bool both = _lobe.closure().traits().transmissive;
        return {both ? event::either : event::reflection, _kind, _name};
    }

    Real roughness() const override { return _lobe.roughness(); }

    Real sample(const vec3<Real>& wi, Real u, Real v, Real w, vec3<Real>& wo, color<Real>& weight,
                Real* reverse_pdf) const override
    {
        const PointSample<Real> s = _lobe.sample(wi, {u, v, w});
        wo = s.wi;
        if (reverse_pdf)
            *reverse_pdf = !(s.pdf > 0)              ? Real(0)
                           : _lobe.without_density() ? s.pdf
                                                     : _lobe.reverse_pdf(wi, wo);
        weight = s.weight;
        return s.pdf;
    }

    Real evaluate(const vec3<Real>& wi, const vec3<Real>& wo, color<Real>& weight,
                  Real* reverse_pdf) const override
    {
        const PointSample<Real> s = _lobe.evaluate(wi, wo);
        if (reverse_pdf) *reverse_pdf = s.pdf > 0 ? _lobe.reverse_pdf(wi, wo) : Real(0);
        weight = s.weight;
        return s.pdf;
    }

    color<Real> albedo(const vec3<Real>& wi) const override { return _lobe.albedo(wi); }

    Real ior() const override { return relative_index(_lobe.closure()); }

private:
    PointLobe<Closure> _lobe;
    const char* _name;
    scatter _kind;
};

/// The lobes of a material before they have their weights.
template <class Real>
struct PendingLobes
{
    struct Pending
    {
        lobe_entry<Real> entry;
        int closure;
    };
    Pending of[lobe_list<Real>::capacity];
    int count = 0;

    bool add(const lobe_entry<Real>& entry, int closure)
    {
        if (count == lobe_list<Real>::capacity || !entry.lobe) return false;
        of[count++] = {entry, closure};
        return true;
    }
};

/// Adds the lobe of closure k, or two. False when the scratchpad is full. Its directional albedo
/// goes where `albedo` points, unless that is null.
template <class Closure>
bool add_lobes(const Closure& closure, int k, const char* name,
               const shading_point<typename Closure::Real>& point, scratchpad& pad,
               PendingLobes<typename Closure::Real>& list, color<typename Closure::Real>* albedo)
{
    using Real = typename Closure::Real;
    if (albedo) *albedo = color<Real>(Real(0));

    // Which way the surface faces. An interface has an outside. Of the others, single-sided ones
    // are black from behind, inverted ones from the front, double-sided ones turn towards the
    // viewer.
    bool turned = !point.front_facing;
    if (is_interface(closure))
        turned = point.sides == sidedness::inverted;
    else if (point.sides != sidedness::double_sided &&
             turned != (point.sides == sidedness::inverted))
        return true;
    const Real side = turned ? Real(-1) : Real(1);

    const auto frame = ShadingFrame<Real>::of(point.ns * side, point.ng * side, point.tangent);
    const vec3<Real> view = frame.to_local(point.view), ng = frame.to_local(frame.geometric);
    lobe_entry<Real> entry;
    entry.x = frame.x;
    entry.y = frame.y;
    entry.z = frame.z;

    const Traits traits = closure.traits();
    const scatter dense = is_diffuse(closure) ? scatter::diffuse : scatter::glossy,
                  singular = passes_straight(closure) ? scatter::straight : scatter::singular;
    const bxdf_lobe<Real>* made = nullptr;
    for (const scatter kind : {dense, singular})
    {
        if (kind == dense ? is_delta(closure) : !traits.delta) continue;
        const event ev = traits.transmissive ? event::either : event::reflection;
        if (!(lobe_label{ev, kind, name}.category() & point.wanted)) continue;
        made = entry.lobe = pad.make<ClosureLobe<Closure>>(closure, name, view, ng, kind);
        if (!list.add(entry, k)) return false;
    }
    if (!albedo) return true;
    if (made)
        *albedo = made->albedo(view);
    else
    {
        const auto a = closure.prepare(known_direction(view, ng.dot(view))).albedo();
        *albedo = a.reflect + a.transmit;
    }
    return true;
}

/// Fills the list with the lobes of a material of several closures. add(k, pending, albedo) adds
/// those of closure k by add_lobes; weigh(albedo, weight) is its lobe_weights. False when something
/// is full.
template <class Real, class Add, class Weigh>
bool assemble_lobes(int closures, const Add& add, const Weigh& weigh, lobe_list<Real>& list)
{
    constexpr int most = lobe_list<Real>::capacity;
    if (closures > most) return false;
    PendingLobes<Real> pending;
    color<Real> albedo[most], weight[most];
    for (color<Real>& a : albedo) a = color<Real>(Real(1));
    for (int k = 0; k < closures; ++k)
    {
        // One alone is not asked: its weight does not depend on it.
        if (!add(k, pending, closures > 1 ? albedo + k : nullptr)) return false;
    }
    weigh(albedo, weight);
    for (int j = 0; j < pending.count; ++j)
    {
        auto& p = pending.of[j];
        p.entry.weight = weight[p.closure];
        if (!list.add(p.entry)) return false;
    }
    return true;
}

namespace detail {

template <class Material, class Real>
bool create_lobes(const void* data, const shading_point<Real>& point, scratchpad& pad,
                  lobe_list<Real>& list)
{
    const Material& material = *static_cast<const Material*>(data);
    const auto add = [&](int k, PendingLobes<Real>& pending, color<Real>* albedo) {
        return with_lobe(material, k, point.multiple_scattering_strength, [&](const auto& closure) {
            return add_lobes(closure, k, lobe_name(material, k), point, pad, pending, albedo);
        });
    };
    const auto weigh = [&](const color<Real>* albedo, color<Real>* weight) {
        lobe_weights(material, albedo, weight);
    };
    return assemble_lobes<Real>(lobe_count(material), add, weigh, list);
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
    if constexpr (regain::detail::HasPresence<Material>::value)
        c.opacity = [](const void* data, const shading_point<Real>&) {
            return color<Real>(presence_of<Real>(*static_cast<const Material*>(data)));
        };
    return c;
}

}  // namespace clarisse
REGAIN_NAMESPACE_END
