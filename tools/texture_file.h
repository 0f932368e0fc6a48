// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Pictures of documents, through OpenImageIO's cache: of a picture those tiles are in memory that
/// are looked at, and of all of them no more than the cache is given. There is one cache in a
/// process; the latest object says how large it is, and drops what others had read.

#pragma once

#include <regain/shaders/color_config.h>
#include <regain/shaders/texture.h>

#include <cstdint>
#include <memory>

namespace regain::tools {

class TextureFiles
{
public:
    static constexpr int default_megabytes = 256;

    explicit TextureFiles(const shaders::ColorConfig&, int megabytes = default_megabytes);

    /// What reads them; it and its textures may outlive this object.
    shaders::TextureLoader loader() const;

    /// Bytes of pixels that are held now, and were read in all.
    std::int64_t bytes_held() const;
    std::int64_t bytes_read() const;

private:
    struct Cache;
    std::shared_ptr<const Cache> _cache;
};

}  // namespace regain::tools
