// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "conform_report.h"

#include "errors.h"
#include "histogram_picture.h"

#include <regain/luts/replace_file.h>

#include <fmt/format.h>

#include <algorithm>

namespace regain::tools {

namespace fs = std::filesystem;

namespace {

// What settings are written with is not what names of files are.
std::string as_file_name(std::string text)
{
    for (char& c : text)
        if (!std::isalnum(static_cast<unsigned char>(c)) &&
            std::string("-_.=,").find(c) == std::string::npos)
            c = '_';
    return text;
}

}  // namespace

void require_writable(const ReportFiles& files)
{
    std::vector<std::string> all;
    for (const std::string& file : {files.junit, files.json, files.markdown})
        if (!file.empty()) all.push_back(fs::absolute(file).lexically_normal().string());
    for (const std::string& file : all)
    {
        if (std::count(all.begin(), all.end(), file) > 1)
            throw BadInput(fmt::format("two reports are to be written to '{}'", file));
        luts::require_replaceable(file);
    }
    if (files.histograms.empty()) return;
    std::error_code ec;
    fs::create_directories(files.histograms, ec);
    if (!fs::is_directory(files.histograms))
        throw BadInput(fmt::format("cannot write to the folder '{}': {}", files.histograms,
                                   ec ? ec.message() : "it is none"));
    luts::require_replaceable(fs::path(files.histograms) / "histogram.exr");
}

std::vector<std::string> write_reports(const ReportFiles& files, const conformance::Report& report)
{
    std::vector<std::string> written;
    const auto write = [&](const std::string& file, auto&& how) {
        if (file.empty()) return;
        how(fs::path(file));
        written.push_back(file);
    };
    write(files.junit, [&](const fs::path& f) { conformance::write_junit(f, report); });
    write(files.json, [&](const fs::path& f) { conformance::write_json(f, report); });
    write(files.markdown, [&](const fs::path& f) { conformance::write_markdown(f, report); });
    if (files.histograms.empty()) return written;
    std::size_t histograms = 0;
    for (const conformance::Verdict& v : report.verdicts)
        for (const conformance::Failure& f : v.failures)
        {
            if (!f.histogram) continue;
            const std::string name = as_file_name(v.subject + "_" + v.check + "_" + f.setting);
            const std::string base = (fs::path(files.histograms) / name).string();
            conformance::write_histogram(base + ".exr", *f.histogram);
            write_histogram_picture(base + ".png", *f.histogram);
            ++histograms;
        }
    written.push_back(fmt::format("{} histograms to {}", histograms, files.histograms));
    return written;
}

}  // namespace regain::tools
