// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Sums of radiance per pixel, scene linear. One tile at a time owns a pixel and adds its samples
/// in order, so the sums do not depend on threads.

#pragma once

#include <Imath/ImathColor.h>

#include <atomic>
#include <cmath>
#include <cstdint>
#include <vector>

namespace regain::tools::preview {

class Film
{
public:
    Film(int width, int height)
        : _width(width),
          _height(height),
          _pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height))
    {}

    int width() const { return _width; }
    int height() const { return _height; }

    /// Adds one sample. One that is not finite is a fault of a closure: it is counted and stands
    /// for black, so that it cannot spoil the picture unnoticed.
    void add(int x, int y, const Imath::C3f& radiance)
    {
        Pixel& pixel = _pixels[index(x, y)];
        ++pixel.samples;
        if (!std::isfinite(radiance.x) || !std::isfinite(radiance.y) || !std::isfinite(radiance.z))
        {
            _non_finite.fetch_add(1, std::memory_order_relaxed);
            return;
        }
        for (unsigned k = 0; k < 3; ++k) pixel.sum[k] += static_cast<double>(radiance[k]);
    }

    /// Mean of the samples so far; black before the first.
    Imath::C3f mean(int x, int y) const
    {
        const Pixel& pixel = _pixels[index(x, y)];
        const double scale = pixel.samples ? 1.0 / pixel.samples : 0.0;
        return {static_cast<float>(pixel.sum[0] * scale), static_cast<float>(pixel.sum[1] * scale),
                static_cast<float>(pixel.sum[2] * scale)};
    }
    std::uint32_t samples(int x, int y) const { return _pixels[index(x, y)].samples; }

    /// All that is known of a pixel, to go on from.
    struct Pixel
    {
        double sum[3] = {0.0, 0.0, 0.0};
        std::uint32_t samples = 0;
    };
    const Pixel& pixel(int x, int y) const { return _pixels[index(x, y)]; }
    void restore(int x, int y, const Pixel& pixel) { _pixels[index(x, y)] = pixel; }
    void restore_non_finite(std::uint64_t count) { _non_finite = count; }

    std::uint64_t non_finite() const { return _non_finite.load(std::memory_order_relaxed); }

private:
    std::size_t index(int x, int y) const
    {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(_width) +
               static_cast<std::size_t>(x);
    }

    int _width, _height;
    std::vector<Pixel> _pixels;
    std::atomic<std::uint64_t> _non_finite{0};
};

}  // namespace regain::tools::preview
