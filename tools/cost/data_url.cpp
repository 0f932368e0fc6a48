// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "data_url.h"

#include <cstdint>

namespace regain::tools::cost {

std::string base64(const std::string& bytes)
{
    constexpr const char* digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3)
    {
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group =
                group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        const std::size_t used = bytes.size() - i;
        for (std::size_t k = 0; k < 4; ++k)
            out += k <= used ? digits[group >> (18 - 6 * k) & 63] : '=';
    }
    return out;
}

std::string data_url(const DisplayPicture& picture)
{
    return "data:image/png;base64," + base64(png_bytes(picture));
}

}  // namespace regain::tools::cost
