// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The preview's scene: a row of objects on a floor, each with a material of its own, seen through
/// one of the hosts.

#pragma once

#include "integrator.h"

#include <regain/shaders/microfacet_material.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace regain::tools::preview {

enum class Host { renderman, clarisse, osl };
constexpr Host all_hosts[] = {Host::renderman, Host::clarisse, Host::osl};

/// "renderman", "clarisse", "osl"; BadInput for any other name.
Host host_named(const std::string&);
const char* name(Host);

/// The widget; a sphere; a sphere with another inside.
enum class Object { widget, sphere, nested };

/// "widget", "sphere", "nested"; BadInput for any other name.
Object object_named(const std::string&);
const char* name(Object);

/// What stands in the row.
struct RowLayout
{
    int objects = 1;
    Object object = Object::widget;
    bool floor = true;
    /// The objects let light through: then they have a bottom, and stand a hair above the floor.
    bool transparent = false;
    /// Of each object about its own vertical, radians, anticlockwise from above.
    float turn = 0;
};

/// Geometry of a row: material 0 is the floor, 1 ... are the objects from left to right. What is
/// inside an object has its material, too.
class RowScene
{
public:
    explicit RowScene(int widgets) : RowScene(RowLayout{widgets}) {}
    explicit RowScene(const RowLayout&);
    const Scene& scene() const { return _scene; }
    Camera camera(float aspect) const;
    /// Where the middle of object i, 0 the left one, is across that camera's frame, in [0, 1].
    float across(int i, float aspect) const;

private:
    float place(int i) const;

    Scene _scene;
    RowLayout _layout;
};

/// The floor: dull grey, the same in every picture so that the eye compares the objects alone.
shaders::MicrofacetMaterial floor_material();

class BoundMaterial;

/// An integrator with its materials, by the indices of RowScene. They are reached through the
/// adapter of the host and in no other way.
class RowIntegrator
{
public:
    /// Binds the tables of the materials.
    RowIntegrator(Host, const World&, const std::vector<shaders::MicrofacetMaterial>& materials);
    /// Materials of any kind.
    RowIntegrator(Host, const World&, std::vector<std::unique_ptr<BoundMaterial>> materials);
    ~RowIntegrator();
    const Integrator& get() const { return *_integrator; }
    std::vector<const BoundMaterial*> materials() const;

private:
    std::vector<std::unique_ptr<BoundMaterial>> _materials;
    std::unique_ptr<Integrator> _integrator;
};

}  // namespace regain::tools::preview
