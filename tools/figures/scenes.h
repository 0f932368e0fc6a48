// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Pictures of rows of objects for the figures, rendered as `regain render` does.

#pragma once

#include "../picture.h"
#include "../preview/bound_material.h"
#include "../preview/row.h"
#include "figure.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace regain::tools::figures {

/// One rendering: objects side by side.
struct Cell
{
    preview::RowLayout layout;
    std::vector<shaders::MicrofacetMaterial> objects;
    /// Instead of `objects`, materials of any other kind.
    std::function<std::unique_ptr<preview::BoundMaterial>(int)> object;
    bool white_furnace = false;  ///< light of radiance 1 from everywhere, instead of the studio
};

/// What a cell is rendered with, at width x height pixels before the request's scale. The request
/// is not kept.
class CellStage
{
public:
    CellStage(const Request&, const Cell&, int width, int height);
    const preview::Integrator& integrator() const { return _integrator->get(); }
    int width() const { return _width; }
    int height() const { return _height; }

private:
    preview::Environment _light;
    preview::RowScene _scene;
    int _width, _height;
    preview::Camera _camera;
    std::unique_ptr<preview::RowIntegrator> _integrator;
};

struct CellPicture
{
    Picture picture;
    double seconds = 0;  ///< of rendering, on the threads of the request
};

/// Renders one cell of width x height pixels before the request's scale. Throws Stopped.
CellPicture render_cell(const Request&, const std::string& label, const Cell&, int width,
                        int height);

/// Cells of equal size as one picture, `columns` to a row.
Picture tiled(const std::vector<Picture>& cells, int columns);

/// The root of the mean square difference of two pictures of one size, over
/// means of 16 x 16 pixels, so that noise counts for little.
double difference(const Picture&, const Picture&);

/// Writes NAME.exr and NAME.png to the request's folder and adds the PNG to the figure. `raw`
/// leaves out the display's tone curve where the colour configuration can, for data.
void write_pictures(const Request&, Figure&, const std::string& name, const Picture&,
                    bool raw = false);

/// Gold by the built-in spectral data, in the working space of the active configuration.
shaders::MicrofacetMaterial gold(double alpha, const shaders::Compensation& method);

/// Clear glass of index 1.5.
shaders::MicrofacetMaterial glass(double alpha, const shaders::Compensation& method);

/// A mirror of F = 1.
shaders::MicrofacetMaterial white(shaders::DistributionKind distribution, double gamma,
                                  double alpha, const shaders::Compensation& method);

}  // namespace regain::tools::figures
