// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "scenes.h"

#include "../preview/render_job.h"

#include <regain/shaders/metals.h>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace regain::tools::figures {

using namespace preview;
using shaders::Compensation;
using shaders::MicrofacetMaterial;

namespace {

LatLongImage white_dome()
{
    LatLongImage image;
    image.width = 8;
    image.height = 4;
    image.pixels.assign(32, Imath::C3f(1.0f));
    return image;
}

int scaled(const Request& request, int pixels)
{
    return std::max(8, static_cast<int>(std::lround(pixels * request.size)));
}

}  // namespace

CellStage::CellStage(const Request& request, const Cell& cell, int width, int height)
    : _light(cell.white_furnace ? white_dome() : make_studio()),
      _scene(cell.layout),
      _width(scaled(request, width)),
      _height(scaled(request, height)),
      _camera(_scene.camera(static_cast<float>(_width) / static_cast<float>(_height)))
{
    std::vector<std::unique_ptr<BoundMaterial>> materials;
    const auto add = [&](MicrofacetMaterial material) {
        material.bind_tables();
        materials.push_back(bind(material));
    };
    add(floor_material());
    for (const MicrofacetMaterial& material : cell.objects) add(material);
    if (cell.object)
        for (int i = 0; i < cell.layout.objects; ++i) materials.push_back(cell.object(i));
    _integrator =
        std::make_unique<RowIntegrator>(Host::renderman,
                                        World{_scene.scene(), _light, _camera, _width, _height,
                                              request.seed, cell.layout.transparent ? 64 : 16},
                                        std::move(materials));
}

CellPicture render_cell(const Request& request, const std::string& label, const Cell& cell,
                        int width, int height)
{
    const CellStage stage(request, cell, width, height);
    const int w = stage.width(), h = stage.height();
    Film film(w, h);
    RenderJob job;
    job.targets.push_back({&stage.integrator(), &film});
    job.samples = request.samples;
    job.threads = request.threads;
    job.stop = request.stop;
    Progress progress(label, total_samples(job), request.progress);
    job.progress = &progress;

    const auto start = std::chrono::steady_clock::now();
    if (!preview::render(job)) throw Stopped();
    CellPicture result;
    result.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (film.non_finite())
        throw std::runtime_error(
            fmt::format("{}: {} samples were not finite", label, film.non_finite()));
    result.picture.width = w;
    result.picture.height = h;
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x) result.picture.pixels.push_back(film.mean(x, y));
    return result;
}

Picture tiled(const std::vector<Picture>& cells, int columns)
{
    const int w = cells.front().width, h = cells.front().height;
    const int rows = (static_cast<int>(cells.size()) + columns - 1) / columns;
    Picture all;
    all.width = w * columns;
    all.height = h * rows;
    all.pixels.assign(static_cast<std::size_t>(all.width) * static_cast<std::size_t>(all.height),
                      Imath::C3f(0.0f));
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
        const int x0 = w * (static_cast<int>(i) % columns),
                  y0 = h * (static_cast<int>(i) / columns);
        for (int y = 0; y < h; ++y)
            std::copy_n(cells[i].pixels.begin() + y * w, w,
                        all.pixels.begin() + (y0 + y) * all.width + x0);
    }
    return all;
}

double difference(const Picture& a, const Picture& b)
{
    constexpr int block = 16;
    double sum = 0;
    int blocks = 0;
    for (int y0 = 0; y0 < a.height; y0 += block)
        for (int x0 = 0; x0 < a.width; x0 += block)
        {
            Imath::Color3<double> off(0.0);
            const int x1 = std::min(x0 + block, a.width), y1 = std::min(y0 + block, a.height);
            for (int y = y0; y < y1; ++y)
                for (int x = x0; x < x1; ++x)
                {
                    const auto i = static_cast<std::size_t>(y * a.width + x);
                    off += Imath::Color3<double>(a.pixels[i]) - Imath::Color3<double>(b.pixels[i]);
                }
            off *= 1.0 / ((x1 - x0) * (y1 - y0));
            sum += (off.x * off.x + off.y * off.y + off.z * off.z) / 3;
            ++blocks;
        }
    return std::sqrt(sum / blocks);
}

void write_pictures(const Request& request, Figure& figure, const std::string& name,
                    const Picture& picture, bool raw)
{
    const auto config = shaders::ColorConfig::active();
    std::string view;
    if (raw)
        for (const std::string& candidate : config.views(""))
        {
            std::string lower = candidate;
            std::transform(lower.begin(), lower.end(), lower.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
            if (lower == "raw") view = candidate;
        }
    Metadata metadata;
    metadata.entries = {{"figure", figure.name},
                        {"spp", std::to_string(request.samples)},
                        {"seed", std::to_string(request.seed)}};
    write_exr(request.folder / (name + ".exr"), picture, metadata);
    const auto png = request.folder / (name + ".png");
    write_png(png, picture, config, "", view);
    figure.pictures.push_back(png);
}

MicrofacetMaterial gold(double alpha, const Compensation& method)
{
    const auto metal = shaders::metal_color("gold", shaders::ColorConfig::active());
    shaders::SchlickSurface surface;
    surface.F0 = shaders::ColorD(metal.F0);
    surface.F82 = shaders::ColorD(metal.F82);
    MicrofacetMaterial m;
    m.surface = surface;
    m.alpha_x = m.alpha_y = alpha;
    m.method = method;
    return m;
}

MicrofacetMaterial glass(double alpha, const Compensation& method)
{
    MicrofacetMaterial m;
    m.surface = shaders::InterfaceSurface{};
    m.alpha_x = m.alpha_y = alpha;
    m.method = method;
    return m;
}

MicrofacetMaterial white(shaders::DistributionKind distribution, double gamma, double alpha,
                         const Compensation& method)
{
    MicrofacetMaterial m;
    m.surface = shaders::SchlickSurface{};
    m.distribution = distribution;
    m.gamma = gamma;
    m.alpha_x = m.alpha_y = alpha;
    m.method = method;
    return m;
}

}  // namespace regain::tools::figures
