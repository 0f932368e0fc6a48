// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "resume_file.h"

#include "errors.h"

#include <regain/luts/replace_file.h>

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <cstring>
#include <stdexcept>

namespace regain::tools {

namespace fs = std::filesystem;
using preview::Film;

namespace {

// Three doubles by their halves, and the number of samples.
constexpr int channels = 7;

}  // namespace

void write_resume_file(const fs::path& file, const std::vector<const Film*>& films,
                       const std::string& job)
{
    int height = 0;
    std::uint64_t non_finite = 0;
    std::vector<std::uint32_t> values;
    for (const Film* film : films)
    {
        height += film->height();
        non_finite += film->non_finite();
        for (int y = 0; y < film->height(); ++y)
            for (int x = 0; x < film->width(); ++x)
            {
                const Film::Pixel& p = film->pixel(x, y);
                std::uint32_t words[channels];
                std::memcpy(words, p.sum, sizeof p.sum);
                words[channels - 1] = p.samples;
                values.insert(values.end(), words, words + channels);
            }
    }
    OIIO::ImageSpec spec(films.front()->width(), height, channels, OIIO::TypeDesc::UINT32);
    // EXR sorts channels by their names.
    spec.channelnames = {"c0", "c1", "c2", "c3", "c4", "c5", "c6"};
    spec.attribute("compression", "zip");
    spec.attribute("regain:job", job);
    spec.attribute("regain:non_finite", std::to_string(non_finite));
    luts::replace_file(file, [&](const fs::path& temporary) {
        const auto fail = [&](const std::string& why) {
            throw std::runtime_error("cannot write '" + file.string() + "': " + why);
        };
        const auto out = OIIO::ImageOutput::create(temporary.string());
        if (!out) fail(OIIO::geterror());
        if (!out->open(temporary.string(), spec)) fail(out->geterror());
        const bool written = out->write_image(OIIO::TypeDesc::UINT32, values.data());
        if (!out->close() || !written) fail(out->geterror());
    });
}

void read_resume_file(const fs::path& file, const std::vector<Film*>& films, const std::string& job)
{
    const auto fail = [&](const std::string& why) {
        throw BadInput(fmt::format("--resume: cannot go on from '{}': {}", file.string(), why));
    };
    const auto in = OIIO::ImageInput::open(file.string());
    if (!in) fail(OIIO::geterror());
    const OIIO::ImageSpec& spec = in->spec();
    int height = 0;
    for (const Film* film : films) height += film->height();
    const std::string its_job = std::string(spec.get_string_attribute("regain:job"));
    if (its_job != job)
        fail(its_job.empty()
                 ? "it says nothing of a render"
                 : fmt::format("it is of another render\n  there: {}\n  here:  {}", its_job, job));
    if (spec.nchannels != channels || spec.width != films.front()->width() ||
        spec.height != height || spec.format != OIIO::TypeDesc::UINT32)
        fail("it is of another size, or damaged");
    std::vector<std::uint32_t> values(static_cast<std::size_t>(spec.width) *
                                      static_cast<std::size_t>(spec.height) * channels);
    if (!in->read_image(0, 0, 0, channels, OIIO::TypeDesc::UINT32, values.data()))
        fail(in->geterror());
    const std::uint32_t* words = values.data();
    for (Film* film : films)
        for (int y = 0; y < film->height(); ++y)
            for (int x = 0; x < film->width(); ++x, words += channels)
            {
                Film::Pixel p;
                std::memcpy(p.sum, words, sizeof p.sum);
                p.samples = words[channels - 1];
                film->restore(x, y, p);
            }
    films.front()->restore_non_finite(std::strtoull(
        std::string(spec.get_string_attribute("regain:non_finite")).c_str(), nullptr, 10));
}

}  // namespace regain::tools
