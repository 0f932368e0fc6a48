// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A light that surrounds the scene: a latitude-longitude image of radiance, scene linear,
/// importance-sampled. y is up; the image's centre is +z, its left edge longitude +pi (the
/// convention of OpenEXR), so +x lies left of the centre.

#pragma once

#include <Imath/ImathColor.h>
#include <Imath/ImathVec.h>

#include <filesystem>
#include <vector>

namespace regain::tools::preview {

struct LatLongImage
{
    int width = 0, height = 0;       ///< width = 2 height
    std::vector<Imath::C3f> pixels;  ///< row-major, zenith first
};

/// Direction of the image point (u, v), each in [0, 1], (0, 0) at the top left; and back.
Imath::V3f latlong_direction(float u, float v);
Imath::V2f latlong_point(const Imath::V3f& direction);

/// The image in a file that OpenImageIO reads as floating point (EXR, HDR). Throws BadInput that
/// names the file and what is wrong: missing, damaged, not 2:1, fewer than three channels, or a
/// pixel that is negative or not finite.
LatLongImage read_latlong(const std::filesystem::path&);

/// The built-in studio: soft boxes on a dim, even dome.
LatLongImage make_studio();

class Environment
{
public:
    /// Throws BadInput when the image holds no light. It is turned by so many radians about the
    /// vertical, anticlockwise as seen from above.
    explicit Environment(LatLongImage, float turn = 0);

    struct Light
    {
        Imath::C3f radiance;
        float pdf;  ///< of `sample`, per steradian
    };
    struct Sample
    {
        Imath::V3f direction;  ///< unit, towards the light
        Light light;
    };

    Sample sample(const Imath::V2f& u) const;
    /// Radiance that is not a number for a direction that is none.
    Light at(const Imath::V3f& direction) const;

private:
    float solid_angle(int row) const { return _row_solid_angle[static_cast<std::size_t>(row)]; }
    float probability(int row, int column) const;
    Imath::C3f interpolated(float x, float y) const;

    Imath::V3f turned(const Imath::V3f& v, float sine) const
    {
        return {_cosine * v.x + sine * v.z, v.y, _cosine * v.z - sine * v.x};
    }

    LatLongImage _image;
    float _cosine = 1, _sine = 0;         // of the turn
    std::vector<float> _row_cosine;       // height + 1: cosines from the zenith of the row borders
    std::vector<float> _row_solid_angle;  // of one pixel, steradians
    std::vector<float> _rows;             // height + 1: distribution of the row
    std::vector<float> _columns;          // (width + 1) per row: of the column, given the row
};

}  // namespace regain::tools::preview
