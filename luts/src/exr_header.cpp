// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "exr_header.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

REGAIN_NAMESPACE_BEGIN
namespace luts {
namespace {

// No table comes near this; a header that says so is broken, and is not worth the memory. Of more
// axes than two all slices lie below each other.
constexpr std::int64_t largest_width = 4096, largest_height = 65536, most_nodes = 1 << 24;

// The types of the attributes that tables have, and how many bytes such a value takes; 0: any
// number. Others, such as a picture for a preview, may hold sizes of their own.
struct Type
{
    std::string_view name;
    std::int64_t size;
};
constexpr Type known_types[] = {{"box2i", 16},    {"chlist", 0}, {"compression", 1},
                                {"double", 8},    {"float", 4},  {"int", 4},
                                {"lineOrder", 1}, {"string", 0}, {"v2f", 8}};

void require(bool holds)
{
    if (!holds) throw std::runtime_error("its header says more than the file holds, or less");
}

// Little-endian, as everything in an EXR file.
class Reader
{
public:
    explicit Reader(const std::filesystem::path& file) : _in(file, std::ios::binary | std::ios::ate)
    {
        _size = _in ? static_cast<std::int64_t>(_in.tellg()) : 0;
        _in.seekg(0);
    }

    std::int64_t rest() { return _size - static_cast<std::int64_t>(_in.tellg()); }
    std::int32_t number()
    {
        std::array<char, 4> bytes;
        require(rest() >= 4 && bool(_in.read(bytes.data(), 4)));
        std::uint32_t n = 0;
        for (std::size_t i = 4; i > 0; --i) n = n << 8 | static_cast<unsigned char>(bytes[i - 1]);
        return static_cast<std::int32_t>(n);
    }
    std::string text()
    {
        std::string s;
        require(bool(std::getline(_in, s, '\0')) && !_in.eof());
        return s;
    }
    void skip(std::int64_t bytes)
    {
        require(bytes >= 0 && bytes <= rest());
        _in.seekg(bytes, std::ios::cur);
    }
    std::int64_t size() const { return _size; }

private:
    std::ifstream _in;
    std::int64_t _size;
};

void require_size(Reader& in)
{
    const std::int64_t left = in.number(), top = in.number(), right = in.number(),
                       bottom = in.number();
    const std::int64_t width = right - left + 1, height = bottom - top + 1;
    if (width < 2 || height < 1 || width > largest_width || height > largest_height ||
        width * height > most_nodes)
        throw std::runtime_error(
            "it has " + std::to_string(width) + " x " + std::to_string(height) + " nodes; 2 to " +
            std::to_string(largest_width) + " by 1 to " + std::to_string(largest_height) +
            " a side are accepted, " + std::to_string(most_nodes) + " in all");
}

// Name, type and sampling of each, and an empty name: OpenEXR goes by that, whatever `size` says.
void skip_channels(Reader& in, std::int64_t size)
{
    const std::int64_t rest = in.rest() - size;
    while (!in.text().empty()) in.skip(16);
    require(in.rest() == rest);
}

}  // namespace

void require_header_of_table(const std::filesystem::path& file)
{
    constexpr std::int32_t magic = 20000630, several_parts = 0x1000;
    // A folder can be opened, and has no end.
    if (!std::filesystem::is_regular_file(file)) return;
    Reader in(file);
    if (in.size() < 8 || in.number() != magic) return;
    if (in.number() & several_parts) throw std::runtime_error("it has several parts");
    for (std::string name = in.text(); !name.empty(); name = in.text())
    {
        const std::string wanted = in.text();
        const Type* type = std::find_if(std::begin(known_types), std::end(known_types),
                                        [&](const Type& t) { return t.name == wanted; });
        if (type == std::end(known_types))
            throw std::runtime_error("its header has a '" + name + "' of type '" + wanted +
                                     "', which no table has");
        const std::int64_t size = in.number();
        require(size == type->size || type->size == 0);
        if (name == "dataWindow" && type->name == "box2i")
            require_size(in);
        else if (type->name == "chlist")
            skip_channels(in, size);
        else
            in.skip(size);
    }
}

}  // namespace luts
REGAIN_NAMESPACE_END
