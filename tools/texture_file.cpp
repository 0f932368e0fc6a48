// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "texture_file.h"

#include <regain/shaders/document_color.h>

#include <OpenImageIO/imagecache.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace regain::tools {

using shaders::AddressMode;
using shaders::DocumentColor;

namespace {

// One for the process, which nobody destroys: threads that have used it may end after anybody who
// could.
OIIO::ImageCache& process_cache()
{
    static OIIO::ImageCache* const one = [] {
        OIIO::ImageCache* cache = OIIO::ImageCache::create(false);
        // Files without tiles are read by pieces of that many texels, too.
        cache->attribute("autotile", 64);
        cache->attribute("autoscanline", 1);
        cache->attribute("automip", 0);
        return cache;
    }();
    return *one;
}

}  // namespace

struct TextureFiles::Cache
{
    Cache(const shaders::ColorConfig& c, int megabytes) : config(c), images(&process_cache())
    {
        images->attribute("max_memory_MB", static_cast<float>(megabytes));
        // Files may have changed since they were read for somebody else.
        images->invalidate_all(true);
    }

    shaders::ColorConfig config;
    OIIO::ImageCache* images;
};

namespace {

int wrapped(int i, int n, AddressMode mode)
{
    if (mode == AddressMode::periodic) return (i % n + n) % n;
    if (mode == AddressMode::mirror)
    {
        const int k = (i % (2 * n) + 2 * n) % (2 * n);
        return k < n ? k : 2 * n - 1 - k;
    }
    return std::clamp(i, 0, n - 1);
}

// The texel below a place in units of texels, and how far beyond its middle that is.
int texel_below(float place, float& beyond)
{
    // Far out there are no texels that a float could tell.
    const float x = std::clamp(place, -1e6f, 1e6f) - 0.5f, low = std::floor(x);
    beyond = x - low;
    return static_cast<int>(low);
}

template <class CachePointer>
class FileTexture final : public shaders::Texture
{
public:
    FileTexture(CachePointer cache, const std::filesystem::path& file, const DocumentColor& color)
        : _cache(std::move(cache)), _color(color)
    {
        const OIIO::ustring name(file.string());
        OIIO::ImageSpec spec;
        _image = _cache->images->get_image_handle(name);
        if (!_image || !_cache->images->get_imagespec(name, spec, 0, 0))
        {
            std::string why = _cache->images->geterror();
            if (why.empty()) why = "it is no picture that OpenImageIO reads";
            throw std::runtime_error("cannot read the picture '" + file.string() + "': " + why);
        }
        if (spec.width < 1 || spec.height < 1 || spec.depth > 1)
            throw std::runtime_error("cannot use the picture '" + file.string() +
                                     "': it is no plane of pixels");
        _x = spec.x;
        _y = spec.y;
        _width = spec.width;
        _height = spec.height;
        _channels = std::min(spec.nchannels, 4);
    }

    void at(float u, float v, AddressMode u_mode, AddressMode v_mode,
            float result[4]) const override
    {
        float s, t;
        const int x = texel_below(u * float(_width), s),
                  y = texel_below((1 - v) * float(_height), t);
        Imath::C3f color[4];
        float alpha[4];
        for (int k = 0; k < 4; ++k)
            read(wrapped(x + (k & 1), _width, u_mode), wrapped(y + (k >> 1), _height, v_mode),
                 color[k], alpha[k]);
        // Light is what is to be interpolated.
        if (!_color.is_identity()) _color.apply(color, 4);
        const float w[4] = {(1 - s) * (1 - t), s * (1 - t), (1 - s) * t, s * t};
        for (int c = 0; c < 4; ++c)
        {
            result[c] = 0;
            for (int k = 0; k < 4; ++k) result[c] += w[k] * (c < 3 ? color[k][c] : alpha[k]);
        }
    }

private:
    void read(int x, int y, Imath::C3f& color, float& alpha) const
    {
        float p[4] = {0, 0, 0, 1};
        if (!_cache->images->get_pixels(_image, nullptr, 0, 0, _x + x, _x + x + 1, _y + y,
                                        _y + y + 1, 0, 1, 0, _channels, OIIO::TypeDesc::FLOAT, p))
        {
            (void)_cache->images->geterror();
            p[0] = p[1] = p[2] = 0;
            p[3] = 1;
        }
        const bool grey = _channels < 3;
        color = grey ? Imath::C3f(p[0]) : Imath::C3f(p[0], p[1], p[2]);
        alpha = _channels == 2 ? p[1] : _channels == 4 ? p[3] : 1;
    }

    CachePointer _cache;
    DocumentColor _color;
    OIIO::ImageCache::ImageHandle* _image = nullptr;
    int _x = 0, _y = 0, _width = 1, _height = 1, _channels = 1;
};

}  // namespace

TextureFiles::TextureFiles(const shaders::ColorConfig& config, int megabytes)
    : _cache(std::make_shared<const Cache>(config, megabytes))
{}

shaders::TextureLoader TextureFiles::loader() const
{
    return [cache = _cache](const std::filesystem::path& file,
                            const std::string& space) -> std::shared_ptr<const shaders::Texture> {
        const auto color = DocumentColor::named(cache->config, space);
        return std::make_shared<FileTexture<std::shared_ptr<const Cache>>>(
            cache, file, color ? *color : DocumentColor());
    };
}

std::int64_t TextureFiles::bytes_held() const
{
    std::int64_t bytes = 0;
    _cache->images->getattribute("stat:cache_memory_used", OIIO::TypeDesc::INT64, &bytes);
    return bytes;
}

std::int64_t TextureFiles::bytes_read() const
{
    std::int64_t bytes = 0;
    _cache->images->getattribute("stat:bytes_read", OIIO::TypeDesc::INT64, &bytes);
    return bytes;
}

}  // namespace regain::tools
