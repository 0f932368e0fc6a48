// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "render_parts.h"

#include "preview/render_job.h"

#include <cstdint>

namespace regain::tools {

using preview::Film;

namespace {

template <class Visit>
void for_each_pixel(const std::vector<Film*>& films, const Part& part, const Visit& visit)
{
    for (const auto& [film, tile] : preview::tiles_of(films, part))
        for (int y = tile.y0; y < tile.y1; ++y)
            for (int x = tile.x0; x < tile.x1; ++x) visit(*films[film], x, y);
}

}  // namespace

void write_render_part(const std::filesystem::path& file, const std::vector<Film*>& films,
                       const JobDescription& job, const Part& part)
{
    Payload payload;
    std::uint64_t non_finite = 0;
    for (const Film* film : films) non_finite += film->non_finite();
    payload.put(&non_finite, 1);
    for_each_pixel(films, part, [&](const Film& film, int x, int y) {
        const Film::Pixel& pixel = film.pixel(x, y);
        payload.put(pixel.sum, 3);
        payload.put(&pixel.samples, 1);
    });
    write_part(file, job, part, payload.bytes());
}

void merge_render_parts(const std::vector<std::string>& files, const std::vector<Film*>& films,
                        const JobDescription& job)
{
    std::uint64_t non_finite = 0;
    read_parts(files, job, [&](const Part& part, PayloadReader& payload) {
        std::uint64_t its = 0;
        payload.take(&its, 1);
        non_finite += its;
        for_each_pixel(films, part, [&](Film& film, int x, int y) {
            Film::Pixel pixel;
            payload.take(pixel.sum, 3);
            payload.take(&pixel.samples, 1);
            film.restore(x, y, pixel);
        });
    });
    films.front()->restore_non_finite(non_finite);
}

}  // namespace regain::tools
