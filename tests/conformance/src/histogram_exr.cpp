// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include <regain/conformance/report.h>
#include <regain/luts/replace_file.h>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>

#include <stdexcept>

REGAIN_NAMESPACE_BEGIN
namespace conformance {

void write_histogram(const std::filesystem::path& file, const Histogram& h)
{
    const bool sized = h.width > 0 && h.height > 0;
    const std::size_t cells =
        sized ? static_cast<std::size_t>(h.width) * static_cast<std::size_t>(h.height) : 0;
    if (!sized || h.found.size() != cells || h.expected.size() != cells)
        throw std::invalid_argument("cannot write '" + file.string() + "': the histogram is " +
                                    std::to_string(h.width) + " x " + std::to_string(h.height) +
                                    " and holds " + std::to_string(h.found.size()) + " and " +
                                    std::to_string(h.expected.size()) + " counts");
    std::vector<float> difference;
    for (std::size_t i = 0; i < cells; ++i) difference.push_back(h.found[i] - h.expected[i]);

    luts::replace_file(file, [&](const std::filesystem::path& temporary) {
        Imf::Header header(h.width, h.height);
        Imf::FrameBuffer frame;
        const auto add = [&](const char* name, const std::vector<float>& values) {
            header.channels().insert(name, Imf::Channel(Imf::FLOAT));
            frame.insert(name, Imf::Slice::Make(Imf::FLOAT, values.data(), header.dataWindow()));
        };
        add("found", h.found);
        add("expected", h.expected);
        add("difference", difference);
        Imf::OutputFile out(temporary.string().c_str(), header);
        out.setFrameBuffer(frame);
        out.writePixels(h.height);
    });
}

}  // namespace conformance
REGAIN_NAMESPACE_END
