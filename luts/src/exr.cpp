// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include <regain/luts/exr.h>
#include <regain/luts/replace_file.h>

#include "exr_header.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

REGAIN_NAMESPACE_BEGIN
namespace luts {
namespace {

void insert(Imf::Header& header, const std::string& name, const std::string& value)
{
    header.insert("regain:" + name, Imf::StringAttribute(value));
}
void insert(Imf::Header& header, const std::string& name, double value)
{
    header.insert("regain:" + name, Imf::DoubleAttribute(value));
}
void insert(Imf::Header& header, const std::string& name, int value)
{
    header.insert("regain:" + name, Imf::IntAttribute(value));
}

template <class Attribute, class Value>
void extract(const Imf::Header& header, const std::string& name, Value& value)
{
    const auto* attribute = header.findTypedAttribute<Attribute>("regain:" + name);
    if (!attribute) throw std::runtime_error("the header has no 'regain:" + name + "'");
    value = attribute->value();
}
void extract(const Imf::Header& header, const std::string& name, std::string& value)
{
    extract<Imf::StringAttribute>(header, name, value);
}
void extract(const Imf::Header& header, const std::string& name, double& value)
{
    extract<Imf::DoubleAttribute>(header, name, value);
}
void extract(const Imf::Header& header, const std::string& name, int& value)
{
    extract<Imf::IntAttribute>(header, name, value);
}

// Visits every field of a TableInfo, so that reading and writing cannot disagree.
template <class Info, class Visit>
void for_each_field(Info& info, const Visit& visit)
{
    visit("quantity", info.quantity);
    visit("distribution", info.distribution);
    visit("gamma", info.gamma);
    visit("transmission_shadowing", info.transmission_shadowing);
    visit("side", info.side);
    visit("axis_x", info.axis_x);
    visit("axis_y", info.axis_y);
    visit("axis_z", info.axis_z);
    visit("transform", info.transform);
    visit("method", info.method);
    visit("nodes", info.nodes);
    visit("error", info.error);
    visit("error_kind", info.error_kind);
    visit("definition", info.definition);
    visit("offset", info.offset);
    visit("scale", info.scale);
}

// The same of the axes that most files have none of, nor any attribute.
template <class Info, class Visit>
void for_each_further_axis(Info& info, const Visit& visit)
{
    visit("axis_4", info.axis_4, "length_4", info.length_4);
    visit("axis_5", info.axis_5, "length_5", info.length_5);
}

bool fits_half(const Table& table)
{
    return std::all_of(table.values().begin(), table.values().end(),
                       [](float v) { return static_cast<float>(Imath::half(v)) == v; });
}

Table read(const std::filesystem::path& file)
{
    require_header_of_table(file);
    Imf::InputFile in(file.string().c_str());
    const Imf::Header& header = in.header();

    // First of all whether it is of this definition: of another, nothing else is known to be there.
    TableInfo info;
    extract(header, "definition", info.definition);
    if (info.definition != table_definition)
        throw std::runtime_error("it was baked by definition " + std::to_string(info.definition) +
                                 ", this library reads definition " +
                                 std::to_string(table_definition) + ": bake it again");
    for_each_field(info, [&](const char* name, auto& value) { extract(header, name, value); });
    for_each_further_axis(
        info, [&](const char* axis, std::string& formula, const char* length, int& nodes) {
            if (header.find(std::string("regain:") + axis) == header.end()) return;
            extract(header, axis, formula);
            extract(header, length, nodes);
        });
    // Look-ups have them as floats.
    constexpr double smallest = std::numeric_limits<float>::min(),
                     largest = std::numeric_limits<float>::max() / 65536;
    if (!(std::abs(info.offset) <= largest && info.scale >= smallest && info.scale <= largest / 2))
        throw std::runtime_error("its scale and offset are no usable numbers");

    const Imath::Box2i window = header.dataWindow();
    const Imath::V2i size = window.max - window.min + Imath::V2i(1);
    int depth = 1;
    extract(header, "depth", depth);
    if (depth < 1 || size.y % depth != 0)
        throw std::runtime_error("its " + std::to_string(size.y) + " rows are not " +
                                 std::to_string(depth) + " slices");
    const Imf::Channel* channel = header.channels().findChannel("Y");
    if (!channel || (channel->type != Imf::FLOAT && channel->type != Imf::HALF))
        throw std::runtime_error("it has no float or half channel 'Y'");

    std::vector<float> values(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
    Imf::FrameBuffer frame;
    frame.insert("Y", Imf::Slice::Make(Imf::FLOAT, values.data(), window));
    in.setFrameBuffer(frame);
    in.readPixels(window.min.y, window.max.y);
    for (float v : values)
        if (!std::isfinite(v)) throw std::runtime_error("it holds a number that is not finite");
    return Table(info, size.x, size.y / depth, depth, std::move(values));
}

}  // namespace

void write_table(const std::filesystem::path& file, const Table& table)
{
    replace_file(file, [&](const std::filesystem::path& temporary) {
        Imf::Header header(table.width(), table.height() * table.depth());
        const Imf::PixelType type = fits_half(table) ? Imf::HALF : Imf::FLOAT;
        header.channels().insert("Y", Imf::Channel(type));
        for_each_field(table.info(),
                       [&](const char* name, const auto& value) { insert(header, name, value); });
        for_each_further_axis(table.info(), [&](const char* axis, const std::string& formula,
                                                const char* length, int nodes) {
            if (formula.empty()) return;
            insert(header, axis, formula);
            insert(header, length, nodes);
        });
        insert(header, "depth", table.depth());

        const std::vector<Imath::half> halves(table.values().begin(), table.values().end());
        Imf::FrameBuffer frame;
        frame.insert("Y", Imf::Slice::Make(type,
                                           type == Imf::HALF
                                               ? static_cast<const void*>(halves.data())
                                               : static_cast<const void*>(table.values().data()),
                                           header.dataWindow()));
        Imf::OutputFile out(temporary.string().c_str(), header);
        out.setFrameBuffer(frame);
        out.writePixels(table.height() * table.depth());
    });
}

Table read_table(const std::filesystem::path& file)
{
    try
    {
        return read(file);
    }
    catch (const std::exception& e)
    {
        throw std::runtime_error("cannot use table '" + file.string() + "': " + e.what());
    }
}

}  // namespace luts
REGAIN_NAMESPACE_END
