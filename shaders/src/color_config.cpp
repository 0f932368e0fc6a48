// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "builtin_config.h"
#include "names.h"

#include <regain/shaders/color_config.h>
#include <regain/shaders/white_adaptation.h>

#include <OpenColorIO/OpenColorIO.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <stdexcept>

namespace OCIO = OCIO_NAMESPACE;

REGAIN_NAMESPACE_BEGIN
namespace shaders {

using detail::listed;

struct ColorTransform::Impl
{
    OCIO::ConstCPUProcessorRcPtr processor;
};

namespace {

// Exact arithmetic instead of OpenColorIO's default of fast approximations: the same colours on
// every machine are worth more than the time of a picture's last step.
OCIO::ConstCPUProcessorRcPtr cpu_processor(const OCIO::ConstProcessorRcPtr& processor)
{
    return processor->getOptimizedCPUProcessor(OCIO::OPTIMIZATION_LOSSLESS);
}

// OpenColorIO's own words, to be part of a sentence.
std::string reason(const OCIO::Exception& e)
{
    std::string text = e.what();
    while (!text.empty() &&
           (text.back() == '.' || std::isspace(static_cast<unsigned char>(text.back()))))
        text.pop_back();
    return text;
}

// The matrix, for columns, of a transform that is linear; nothing if it is not.
std::optional<Imath::M33d> matrix_of(const OCIO::ConstCPUProcessorRcPtr& processor)
{
    const auto applied = [&](Imath::C3f v) {
        processor->applyRGB(&v.x);
        return C3d(v);
    };
    Imath::M33d m;
    for (int column = 0; column < 3; ++column)
    {
        Imath::C3f unit(0.0f);
        unit[column] = 1;
        const C3d image = applied(unit);
        for (int row = 0; row < 3; ++row) m[row][column] = image[row];
    }
    for (const float scale : {0.0f, 0.01f, 0.18f, 1.0f, 16.0f})
    {
        const Imath::C3f probe = scale * Imath::C3f(0.9f, 1.0f, 1.1f);
        const C3d difference = applied(probe) - times_column(m, C3d(probe));
        for (int c = 0; c < 3; ++c)
            if (!(std::abs(difference[c]) <= 1e-4 * scale + 1e-7)) return {};
    }
    return m;
}

// XYZ of the D65 white to ACES2065-1, by Bradford to the ACES white; the primaries are those of
// SMPTE ST 2065-1.
Imath::M33d aces_of_xyz_d65()
{
    Imath::M33d primaries;
    const double xy[3][2] = {{0.7347, 0.2653}, {0.0, 1.0}, {0.0001, -0.0770}};
    for (int p = 0; p < 3; ++p)
    {
        primaries[0][p] = xy[p][0];
        primaries[1][p] = xy[p][1];
        primaries[2][p] = 1 - xy[p][0] - xy[p][1];
    }
    const C3d luminance = times_column(primaries.inverse(), aces_white());
    for (int row = 0; row < 3; ++row)
        for (int p = 0; p < 3; ++p) primaries[row][p] *= luminance[p];
    return primaries.inverse() * bradford_adaptation(d65_white(), aces_white());
}

// What ACES2065-1 is called in configs from before the interchange roles.
constexpr const char* aces_names[] = {"ACES2065-1", "ACES - ACES2065-1", "lin_ap0", "Linear ACES"};

struct WayFromXyz
{
    std::optional<Imath::M33d> matrix;
    std::string why_not;
};

WayFromXyz find_way_from_xyz(const OCIO::ConstConfigRcPtr& config)
{
    std::string tried;
    const auto linear_from = [&](const char* space) -> std::optional<Imath::M33d> {
        std::string why = "is not linearly related to scene_linear";
        try
        {
            const auto m =
                matrix_of(cpu_processor(config->getProcessor(space, OCIO::ROLE_SCENE_LINEAR)));
            if (m) return m;
        }
        catch (const OCIO::Exception& e)
        {
            why = "cannot be converted: " + reason(e);
        }
        tried += std::string("; '") + space + "' " + why;
        return {};
    };

    if (config->hasRole("aces_interchange"))
        if (const auto m = linear_from("aces_interchange")) return {*m * aces_of_xyz_d65(), ""};
    if (config->hasRole("cie_xyz_d65_interchange"))
        if (const auto m = linear_from("cie_xyz_d65_interchange")) return {*m, ""};
    for (const char* name : aces_names)
        if (config->getColorSpace(name))
            if (const auto m = linear_from(name)) return {*m * aces_of_xyz_d65(), ""};
    return {std::nullopt, tried};
}

}  // namespace

struct ColorConfig::Impl
{
    OCIO::ConstConfigRcPtr ocio;
    std::string name;
    WayFromXyz from_xyz;

    explicit Impl(OCIO::ConstConfigRcPtr config, std::string its_name)
        : ocio(std::move(config)), name(std::move(its_name)), from_xyz(find_way_from_xyz(ocio))
    {}

    [[noreturn]] void fail(const std::string& what) const
    {
        throw std::runtime_error("colour config '" + name + "': " + what);
    }

    std::string known_display(const std::string& display) const
    {
        if (display.empty()) return ocio->getDefaultDisplay();
        for (int i = 0; i < ocio->getNumDisplays(); ++i)
            if (display == ocio->getDisplay(i)) return display;
        std::vector<std::string> names;
        for (int i = 0; i < ocio->getNumDisplays(); ++i) names.emplace_back(ocio->getDisplay(i));
        fail("no display is called '" + display + "'; there are: " + listed(names));
    }

    std::shared_ptr<const ColorTransform::Impl> transform(
        const OCIO::ConstProcessorRcPtr& processor) const
    {
        return std::make_shared<const ColorTransform::Impl>(
            ColorTransform::Impl{cpu_processor(processor)});
    }
};

// --- ColorTransform ---

void ColorTransform::apply(Imath::C3f* pixels, std::size_t count) const
{
    static_assert(sizeof(Imath::C3f) == 3 * sizeof(float), "pixels are packed");
    if (!_impl) return;
    // OpenColorIO keeps a copy of a line: long pictures go in pieces.
    constexpr std::size_t piece = 65536;
    for (std::size_t done = 0; done < count; done += piece)
    {
        const auto width = static_cast<long>(std::min(piece, count - done));
        OCIO::PackedImageDesc image(pixels + done, width, 1, 3);
        _impl->processor->apply(image);
    }
}

bool ColorTransform::is_identity() const { return !_impl || _impl->processor->isNoOp(); }

// --- ColorConfig: where it comes from ---

ColorConfig ColorConfig::active()
{
    const char* ocio = std::getenv("OCIO");
    if (!ocio || !*ocio) return builtin();
    try
    {
        return from_file(ocio);
    }
    catch (const std::runtime_error& e)
    {
        throw std::runtime_error(std::string(e.what()) +
                                 "; the environment variable OCIO names it: mend it, name another, "
                                 "or unset OCIO for the built-in config");
    }
}

ColorConfig ColorConfig::builtin()
{
    static const auto once =
        std::make_shared<const Impl>(detail::make_builtin_config(), "regain-builtin");
    return ColorConfig(once);
}

ColorConfig ColorConfig::from_file(const std::filesystem::path& file)
{
    const auto fail = [&](const std::string& why) {
        throw std::runtime_error("cannot use the colour config '" + file.string() + "': " + why);
    };
    std::error_code ignored;
    if (std::filesystem::is_directory(file, ignored)) fail("it is a folder");
    try
    {
        const auto config = OCIO::Config::CreateFromFile(file.string().c_str());
        if (!config->getColorSpace(OCIO::ROLE_SCENE_LINEAR))
            fail(
                "it has no role scene_linear that names one of its colour spaces; add it under "
                "'roles:'");
        const std::string name = config->getName();
        return ColorConfig(
            std::make_shared<const Impl>(config, name.empty() ? file.string() : name));
    }
    catch (const OCIO::Exception& e)
    {
        fail(reason(e));
        throw;
    }
}

// --- ColorConfig: spaces ---

std::string ColorConfig::name() const { return _impl->name; }

std::string ColorConfig::scene_linear() const
{
    return _impl->ocio->getColorSpace(OCIO::ROLE_SCENE_LINEAR)->getName();
}

C3d ColorConfig::to_scene_linear_from_xyz_d65(const C3d& xyz) const
{
    if (!_impl->from_xyz.matrix)
        _impl->fail("it does not say how its colours relate to CIE XYZ" + _impl->from_xyz.why_not +
                    ". Add the role aces_interchange, naming its ACES2065-1 space, or the role "
                    "cie_xyz_d65_interchange, naming its CIE XYZ (D65) space");
    return times_column(*_impl->from_xyz.matrix, xyz);
}

Imath::C3f ColorConfig::to_scene_linear_from_xyz_d65(const Imath::C3f& xyz) const
{
    return Imath::C3f(to_scene_linear_from_xyz_d65(C3d(xyz)));
}

std::vector<std::string> ColorConfig::color_spaces() const
{
    std::vector<std::string> names;
    for (int i = 0; i < _impl->ocio->getNumColorSpaces(); ++i)
        names.emplace_back(_impl->ocio->getColorSpaceNameByIndex(i));
    return names;
}

bool ColorConfig::has_color_space(const std::string& name_or_role) const
{
    return _impl->ocio->getColorSpace(name_or_role.c_str()) != nullptr;
}

ColorTransform ColorConfig::convert(const std::string& from_space,
                                    const std::string& to_space) const
{
    for (const std::string& space : {from_space, to_space})
        if (!has_color_space(space))
            _impl->fail("no colour space or role is called '" + space +
                        "'; there are: " + listed(color_spaces()));
    try
    {
        return ColorTransform(
            _impl->transform(_impl->ocio->getProcessor(from_space.c_str(), to_space.c_str())));
    }
    catch (const OCIO::Exception& e)
    {
        _impl->fail("cannot convert from '" + from_space + "' to '" + to_space + "': " + reason(e));
    }
}

// --- ColorConfig: displays ---

std::vector<std::string> ColorConfig::displays() const
{
    std::vector<std::string> names;
    const std::string first = default_display();
    if (!first.empty()) names.push_back(first);
    for (int i = 0; i < _impl->ocio->getNumDisplays(); ++i)
        if (first != _impl->ocio->getDisplay(i)) names.emplace_back(_impl->ocio->getDisplay(i));
    return names;
}

std::vector<std::string> ColorConfig::views(const std::string& display) const
{
    const std::string known = _impl->known_display(display);
    std::vector<std::string> names;
    const std::string first = default_view(known);
    if (!first.empty()) names.push_back(first);
    bool raw = detail::same_letters(first, "raw");
    for (int i = 0; i < _impl->ocio->getNumViews(known.c_str()); ++i)
    {
        const std::string view = _impl->ocio->getView(known.c_str(), i);
        raw |= detail::same_letters(view, "raw");
        if (view != first) names.push_back(view);
    }
    if (!raw) names.emplace_back("raw");
    return names;
}

std::string ColorConfig::default_display() const { return _impl->ocio->getDefaultDisplay(); }

std::string ColorConfig::default_view(const std::string& display) const
{
    return _impl->ocio->getDefaultView(_impl->known_display(display).c_str());
}

ColorTransform ColorConfig::display_transform(const std::string& display,
                                              const std::string& view) const
{
    const std::string known = _impl->known_display(display);
    const std::string wanted = view.empty() ? default_view(known) : view;
    if (detail::same_letters(wanted, "raw")) return ColorTransform();

    bool has_view = false;
    for (const std::string& name : views(known)) has_view |= name == wanted;
    if (!has_view)
        _impl->fail("display '" + known + "' has no view '" + wanted +
                    "'; there are: " + listed(views(known)));
    try
    {
        return ColorTransform(_impl->transform(_impl->ocio->getProcessor(
            OCIO::ROLE_SCENE_LINEAR, known.c_str(), wanted.c_str(), OCIO::TRANSFORM_DIR_FORWARD)));
    }
    catch (const OCIO::Exception& e)
    {
        _impl->fail("cannot use view '" + wanted + "' of display '" + known + "': " + reason(e));
    }
}

// --- ColorConfig: the config itself ---

void ColorConfig::validate() const
{
    try
    {
        _impl->ocio->validate();
    }
    catch (const OCIO::Exception& e)
    {
        _impl->fail(reason(e));
    }
}

std::string ColorConfig::text() const
{
    std::ostringstream text;
    try
    {
        _impl->ocio->serialize(text);
    }
    catch (const OCIO::Exception& e)
    {
        _impl->fail(reason(e));
    }
    return text.str();
}

}  // namespace shaders
REGAIN_NAMESPACE_END
