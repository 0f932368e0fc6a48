// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "lobe_strips.h"

#include "../false_colour.h"
#include "../figures/measures.h"

#include <algorithm>
#include <cmath>

namespace regain::tools::cost {
namespace {

constexpr int disc = 84, gap = 6;

// Mean over the part's channels.
double bin_of(const Shape& shape, const Part& part, std::size_t bin)
{
    double sum = 0;
    for (int c = part.first; c <= part.last; ++c) sum += shape[static_cast<std::size_t>(c)][bin];
    return sum / (part.last - part.first + 1);
}

double brightest(const Shape& shape, const Part& part)
{
    double most = 0;
    for (std::size_t i = 0; i < shape[0].size(); ++i) most = std::max(most, bin_of(shape, part, i));
    return most;
}

bool transmits(const Lobe& walk)
{
    return std::any_of(walk.seen.begin(), walk.seen.end(), [](const Seen& s) {
        return *std::max_element(s.transmit.begin(), s.transmit.end()) > 0;
    });
}

}  // namespace

DisplayPicture lobe_strip(const Lobe& lobe, const Lobe& walk, const Part& part)
{
    const int rows = transmits(walk) ? 2 : 1, columns = static_cast<int>(shape_cosines.size());
    DisplayPicture picture{columns * (disc + gap) - gap, rows * (disc + gap) - gap, {}};
    picture.bytes.assign(3 * static_cast<std::size_t>(picture.width * picture.height), 255);
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
        {
            const auto k = static_cast<std::size_t>(column);
            const double scale = std::max(strip_scale * brightest(walk.shapes[k], part), 1e-12);
            for (int y = 0; y < disc; ++y)
                for (int x = 0; x < disc; ++x)
                {
                    // wo is at azimuth 0, its mirror direction opposite: to the right here.
                    const double px = -(2 * (x + 0.5) / disc - 1), py = 2 * (y + 0.5) / disc - 1;
                    const double r2 = px * px + py * py;
                    if (r2 >= 1) continue;
                    const std::size_t bin = figures::histogram_bin(Imath::V3d(px, py, 1 - r2)) +
                                            (row == 1 ? figures::histogram_bins : 0);
                    const double off =
                        bin_of(lobe.shapes[k], part, bin) - bin_of(walk.shapes[k], part, bin);
                    const Imath::C3f color = difference_colour(off / scale);
                    const int at =
                        (row * (disc + gap) + y) * picture.width + column * (disc + gap) + x;
                    for (int c = 0; c < 3; ++c)
                        picture.bytes[static_cast<std::size_t>(3 * at + c)] =
                            static_cast<std::uint8_t>(255 * std::clamp(color[c], 0.0f, 1.0f) +
                                                      0.5f);
                }
        }
    return picture;
}

}  // namespace regain::tools::cost
