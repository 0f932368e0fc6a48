// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "environment.h"

#include "../errors.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace regain::tools::preview {

using Imath::C3f;
using Imath::V2f;
using Imath::V3f;

namespace {

constexpr double kPi = 3.14159265358979323846;

/// Index of a pixel, at most one pixel outside: sideways the image closes on itself, and beyond the
/// first and last row the same row goes on.
std::size_t at_pixel(const LatLongImage& image, int row, int column)
{
    const int y = std::clamp(row, 0, image.height - 1);
    const int x = column < 0              ? column + image.width
                  : column >= image.width ? column - image.width
                                          : column;
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
           static_cast<std::size_t>(x);
}

/// Index i with cdf[i] <= u < cdf[i + 1], and how far u is between the two. Never an empty
/// interval, so that no sample has a pdf of 0.
int pick(const float* cdf, int n, float u, float* rest)
{
    const float* upper = std::upper_bound(cdf, cdf + n + 1, u);
    int i = std::clamp(static_cast<int>(upper - cdf) - 1, 0, n - 1);
    while (i > 0 && cdf[i + 1] <= cdf[i]) --i;
    const float width = cdf[i + 1] - cdf[i];
    *rest = width > 0.0f ? std::clamp((u - cdf[i]) / width, 0.0f, 1.0f) : 0.5f;
    return i;
}

/// Running sums of `values`, normalised to end at 1. All zero: uniform.
void make_cdf(const std::vector<double>& values, float* cdf)
{
    double total = 0.0;
    for (const double v : values) total += v;
    double sum = 0.0;
    cdf[0] = 0.0f;
    for (std::size_t i = 0; i < values.size(); ++i)
    {
        sum += total > 0.0 ? values[i] / total : 1.0 / static_cast<double>(values.size());
        cdf[i + 1] = static_cast<float>(std::min(sum, 1.0));
    }
    // Rounding must not leave a gap at the end that no interval covers.
    for (std::size_t i = values.size(); i > 0 && cdf[i] >= cdf[values.size()]; --i) cdf[i] = 1.0f;
}

}  // namespace

V3f latlong_direction(float u, float v)
{
    const float longitude = static_cast<float>(kPi) * (1.0f - 2.0f * u);
    const float theta = static_cast<float>(kPi) * v;  // from the zenith
    return {std::sin(theta) * std::sin(longitude), std::cos(theta),
            std::sin(theta) * std::cos(longitude)};
}

V2f latlong_point(const V3f& d)
{
    const float longitude = std::atan2(d.x, d.z);
    const float theta = std::acos(std::clamp(d.y, -1.0f, 1.0f));
    const float pi = static_cast<float>(kPi);
    return {std::clamp(0.5f * (1.0f - longitude / pi), 0.0f, 1.0f),
            std::clamp(theta / pi, 0.0f, 1.0f)};
}

Environment::Environment(LatLongImage image, float turn)
    : _image(std::move(image)), _cosine(std::cos(turn)), _sine(std::sin(turn))
{
    const int width = _image.width, height = _image.height;
    const auto luminance = [&](int row, int column) {
        const C3f& c = _image.pixels[at_pixel(_image, row, column)];
        return 0.2126 * double(c.x) + 0.7152 * double(c.y) + 0.0722 * double(c.z);
    };

    _row_cosine.resize(static_cast<std::size_t>(height) + 1, 1.0f);
    _row_solid_angle.resize(static_cast<std::size_t>(height));
    _rows.resize(static_cast<std::size_t>(height) + 1);
    _columns.resize(static_cast<std::size_t>(height) * (static_cast<std::size_t>(width) + 1));
    std::vector<double> rows(static_cast<std::size_t>(height));
    std::vector<double> columns(static_cast<std::size_t>(width));
    for (int row = 0; row < height; ++row)
    {
        const double top = std::cos(kPi * row / height),
                     bottom = std::cos(kPi * (row + 1) / height);
        const double angle = 2.0 * kPi / width * (top - bottom);
        double sum = 0.0;
        for (int column = 0; column < width; ++column)
        {
            // The image is interpolated between pixel centres, so light spills half a pixel over.
            // These weights are the mean of the interpolated image over the pixel: a pixel is
            // never sampled with probability 0 where it is lit.
            double mean = 0.0;
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx)
                    mean += (dy ? 0.125 : 0.75) * (dx ? 0.125 : 0.75) *
                            luminance(row + dy, column + dx);
            columns[static_cast<std::size_t>(column)] = mean;
            sum += mean;
        }
        make_cdf(columns,
                 &_columns[static_cast<std::size_t>(row) * (static_cast<std::size_t>(width) + 1)]);
        rows[static_cast<std::size_t>(row)] = sum * angle;
        _row_cosine[static_cast<std::size_t>(row) + 1] = static_cast<float>(bottom);
        _row_solid_angle[static_cast<std::size_t>(row)] = static_cast<float>(angle);
    }
    if (*std::max_element(rows.begin(), rows.end()) <= 0.0)
        throw BadInput("the environment is black: it gives no light to render with");
    make_cdf(rows, _rows.data());
}

float Environment::probability(int row, int column) const
{
    const auto y = static_cast<std::size_t>(row), x = static_cast<std::size_t>(column);
    const float* cdf = &_columns[y * (static_cast<std::size_t>(_image.width) + 1)];
    return (_rows[y + 1] - _rows[y]) * (cdf[x + 1] - cdf[x]);
}

Environment::Sample Environment::sample(const V2f& u) const
{
    float x_rest = 0.0f, y_rest = 0.0f;
    const int row = pick(_rows.data(), _image.height, u.y, &y_rest);
    const float* cdf =
        &_columns[static_cast<std::size_t>(row) * (static_cast<std::size_t>(_image.width) + 1)];
    const int column = pick(cdf, _image.width, u.x, &x_rest);

    // Uniform over the pixel's solid angle: linear in longitude and in the cosine.
    const float top = _row_cosine[static_cast<std::size_t>(row)];
    const float bottom = _row_cosine[static_cast<std::size_t>(row) + 1];
    const float y = top + (bottom - top) * y_rest;
    const float radius = std::sqrt(std::max(0.0f, 1.0f - y * y));
    const float across = static_cast<float>(column) + x_rest;
    const float longitude =
        static_cast<float>(kPi) * (1.0f - 2.0f * across / static_cast<float>(_image.width));
    Sample s;
    s.direction = turned(V3f(radius * std::sin(longitude), y, radius * std::cos(longitude)), _sine);
    const float down = std::acos(y) * static_cast<float>(_image.height / kPi);
    s.light = {interpolated(across, down), probability(row, column) / solid_angle(row)};
    return s;
}

Environment::Light Environment::at(const V3f& direction) const
{
    const V2f p = latlong_point(turned(direction, -_sine));
    if (!(p.x >= 0.0f && p.x <= 1.0f && p.y >= 0.0f && p.y <= 1.0f))
        return {C3f(std::numeric_limits<float>::quiet_NaN()), 0.0f};
    const float x = p.x * static_cast<float>(_image.width);
    const float y = p.y * static_cast<float>(_image.height);
    const int column = std::clamp(static_cast<int>(x), 0, _image.width - 1);
    const int row = std::clamp(static_cast<int>(y), 0, _image.height - 1);
    return {interpolated(x, y), probability(row, column) / solid_angle(row)};
}

/// Bilinear between pixel centres; x, y in pixels from the top left corner.
C3f Environment::interpolated(float x, float y) const
{
    const float fx = std::floor(x - 0.5f), fy = std::floor(y - 0.5f);
    const int column = static_cast<int>(fx), row = static_cast<int>(fy);
    const float s = x - 0.5f - fx, t = y - 0.5f - fy;
    const auto& c = _image.pixels;
    const C3f above =
        c[at_pixel(_image, row, column)] * (1.0f - s) + c[at_pixel(_image, row, column + 1)] * s;
    const C3f below = c[at_pixel(_image, row + 1, column)] * (1.0f - s) +
                      c[at_pixel(_image, row + 1, column + 1)] * s;
    return above * (1.0f - t) + below * t;
}

}  // namespace regain::tools::preview
