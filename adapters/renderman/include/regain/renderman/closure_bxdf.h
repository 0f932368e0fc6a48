// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Any material whose closures answer as in <regain/closures/closure.h>, behind the batched
/// interface of host.h. A material is what <regain/closures/host_queries.h> describes, of one
/// closure or of several; the instance data of beginScatter is a `const Material*`.
///
/// What is expensive happens in beginScatter: the frame of each point, its prepared closures and so
/// their gains.
///
/// The frame of a closure that only reflects is turned to the viewer. That of an interface between
/// two media keeps the surface's own normals, +z outside; what is transmitted to a viewer's path
/// holds (n_V / n_L)^2, closures themselves knowing energy alone. A sample goes where its lobe says
/// only if the geometric normal agrees; the share of the pdf that is lost with the others is not
/// given to anyone.
///
/// A closure whose eval is an estimate takes its random numbers from the host's generator.

#pragma once

#include <regain/renderman/surface_bxdf.h>
#include <regain/renderman/uniform_presence.h>

REGAIN_NAMESPACE_BEGIN
namespace renderman {

/// Makes the bxdfs of one kind of material.
template <class Material>
class ClosureFactory final : public Factory
{
public:
    Bxdf* beginScatter(const ShadingContext* ctx, const LobeSet& lobesWanted, ShadeMode mode, void*,
                       void* instanceData) override
    {
        if (mode != ShadeMode::Scatter || !instanceData) return nullptr;
        const Material& material = *static_cast<const Material*>(instanceData);
        return SurfaceBxdf::create(
            ctx, this, lobesWanted, lobe_count(material), instanceData, &weights, [&](int k) {
                return with_lobe(material, k, 1.0f, [&](const auto& closure) {
                    return make_batch(ctx, closure, lobe_name(material, k));
                });
            });
    }

    bool computesPresence(const void* instanceData) const override
    {
        return instanceData && presence_of<float>(*static_cast<const Material*>(instanceData)) < 1;
    }
    Opacity* beginOpacity(const ShadingContext* ctx, ShadeMode, void*, void* instanceData) override
    {
        if (!computesPresence(instanceData)) return nullptr;
        return UniformPresence::create(
            ctx, presence_of<float>(*static_cast<const Material*>(instanceData)));
    }

private:
    static Color3 weights(const void* material, int, const Color3* albedo, Color3* weight)
    {
        return lobe_weights(*static_cast<const Material*>(material), albedo, weight);
    }
};

}  // namespace renderman
REGAIN_NAMESPACE_END
