// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The preview's scene: a row of widgets on a floor, each with a metal of its own, seen through one
/// of the hosts.

#pragma once

#include "integrator.h"

#include <regain/shaders/material.h>

#include <memory>
#include <string>
#include <vector>

namespace regain::tools::preview {

enum class Host { renderman, clarisse };

/// "renderman", "clarisse"; BadInput for any other name.
Host host_named(const std::string&);
const char* name(Host);

/// Geometry of a row of `widgets` on a floor: material 0 is the floor, 1 ... are the widgets from
/// left to right.
class RowScene
{
public:
    explicit RowScene(int widgets);
    const Scene& scene() const { return _scene; }
    Camera camera(float aspect) const;

private:
    Scene _scene;
    int _widgets;
};

/// The floor: dull grey, the same in every picture so that the eye compares the widgets alone.
shaders::SchlickMetal floor_material();

/// An integrator with its materials, by the indices of RowScene. They are reached through the
/// adapter of the host and in no other way.
class RowIntegrator
{
public:
    RowIntegrator(Host, const World&, std::vector<shaders::SchlickMetal> materials);
    ~RowIntegrator();
    const Integrator& get() const { return *_integrator; }

private:
    struct Binding;
    std::unique_ptr<Binding> _binding;
    std::unique_ptr<Integrator> _integrator;
};

}  // namespace regain::tools::preview
