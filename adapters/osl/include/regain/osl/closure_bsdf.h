// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Any closure that answers as in <regain/closures/closure.h> as a Bsdf, its own normal and tangent
/// given, and the globals of the shading point.

#pragma once

#include <regain/closures/point_lobe.h>
#include <regain/osl/composite_bsdf.h>
#include <regain/osl/problems.h>
#include <regain/osl/shader_globals.h>

REGAIN_NAMESPACE_BEGIN
namespace osl {

/// The samples of a closure that have a density, or those that have none.
template <class Closure>
class ClosureBsdf final : public Bsdf
{
public:
    using Frame = ShadingFrame<float>;

    ClosureBsdf(const Closure& closure, const Frame& frame, const Imath::V3f& wo,
                bool without_density)
        : _frame(frame),
          _lobe(closure, frame.to_local(wo), frame.to_local(frame.geometric), without_density)
    {}

    Imath::C3f albedo(const Imath::V3f& wo) const override
    {
        return _lobe.albedo(_frame.to_local(wo));
    }
    Imath::C3f expected_albedo(const Imath::V3f& wo) const override
    {
        return _lobe.expected_albedo(_frame.to_local(wo));
    }
    BsdfSample eval(const Imath::V3f& wo, const Imath::V3f& wi) const override
    {
        return answer(wo, wi, _lobe.evaluate(_frame.to_local(wo), _frame.to_local(wi)));
    }
    BsdfSample sample(const Imath::V3f& wo, const Imath::V3f& u) const override
    {
        const PointSample<float> s = _lobe.sample(_frame.to_local(wo), u);
        return answer(wo, _frame.to_world(s.wi), s);
    }
    bool passes_straight() const override { return regain::passes_straight(_lobe.closure()); }

private:
    BsdfSample answer(const Imath::V3f& wo, const Imath::V3f& wi, const PointSample<float>& s) const
    {
        BsdfSample a;
        if (!(s.pdf > 0)) return a;
        a.wi = wi;
        a.weight = s.weight;
        a.pdf = s.pdf;
        a.roughness = _lobe.roughness();
        a.singular = _lobe.without_density();
        a.straight = passes_straight();
        a.ior = relative_index(_lobe.closure());
        a.passes = a.ior != 1 && _frame.geometric.dot(wo) * _frame.geometric.dot(wi) < 0;
        return a;
    }

    Frame _frame;
    PointLobe<Closure> _lobe;
};

/// What of a component says where it is: both as the shader gave them, of any length. A component
/// without parameters for it has the frame of the surface itself.
struct ComponentFrame
{
    Imath::V3f N{0.0f}, U{0.0f};
    bool of_surface = false;
};

namespace detail {

inline bool is_direction(const Imath::V3f& v)
{
    const float length2 = v.dot(v);
    return length2 > 1e-30f && length2 < 1e30f;
}

}  // namespace detail

/// The frame of a component. N is turned to the side of Ng, for shaders do not agree on whether
/// they flip it; where N is no direction it is that of the globals. An interface's z points
/// outside, whatever side is seen.
inline ShadingFrame<float> frame_of(const ComponentFrame& component, const ShaderGlobals& globals,
                                    bool interface, Problems& problems)
{
    const Imath::V3f wo = -globals.I;
    const Imath::V3f Ng = globals.Ng.dot(wo) < 0 ? -globals.Ng : globals.Ng;
    Imath::V3f N = component.of_surface ? Ng : component.N;
    if (!detail::is_direction(N))
    {
        problems |= bad_normal;
        N = detail::is_direction(globals.N) ? globals.N : Ng;
    }
    N = N / N.length();
    if (N.dot(Ng) < 0) N = -N;
    const float side = interface && globals.backfacing ? -1.0f : 1.0f;
    const Imath::V3f& U = detail::is_direction(component.U) ? component.U : globals.dPdu;
    return ShadingFrame<float>::of(N * side, Ng * side, U);
}

/// Adds the closure to what a surface is made of, as one BSDF or two: of a closure whose samples
/// are of both kinds each passes on one. Where `asked`, `albedo` becomes that of the closure
/// towards wo. A closure that finds no place is left out, which `problems` says.
template <class Closure>
void add_closure(const Closure& closure, const ComponentFrame& component,
                 const ShaderGlobals& globals, const Imath::C3f& weight, bool asked,
                 CompositeBsdf& composite, Imath::C3f& albedo, Problems& problems)
{
    using Made = ClosureBsdf<Closure>;
    const auto frame = frame_of(component, globals, is_interface(closure), problems);
    const Imath::V3f wo = -globals.I;
    const Made* made = nullptr;
    for (const bool without_density : {false, true})
    {
        if (without_density ? !closure.traits().delta : is_delta(closure)) continue;
        const Made* added = composite.add<Made>(weight, closure, frame, wo, without_density);
        if (added)
            made = added;
        else
            problems |= too_many_bsdfs;
    }
    if (asked) albedo = made ? made->albedo(wo) : Imath::C3f(0.0f);
}

}  // namespace osl
REGAIN_NAMESPACE_END
