// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The figures of Turquin 2019, made again: for each what the paper shows or claims, what was made
/// and measured here, and whether the two agree.

#pragma once

#include "../preview/progress.h"

#include <nlohmann/json.hpp>

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace regain::tools::figures {

enum class Verdict { agrees, differs, shown };

/// One thing that the paper claims or shows, and what was found. `shown` is for what has no claim
/// that a number could test.
struct Finding
{
    std::string claim, measured;
    Verdict verdict = Verdict::shown;
};

struct Table
{
    std::string title;
    std::vector<std::string> columns;
    std::vector<std::vector<std::string>> rows;
};

struct Figure
{
    std::string name;                             ///< "1" to "9", "table1"
    std::string title;                            ///< what is to be seen
    std::vector<std::filesystem::path> pictures;  ///< PNG and SVG, within the output folder
    std::vector<Finding> findings;
    std::vector<Table> tables;
    nlohmann::ordered_json numbers;  ///< whatever was measured, for machines
};

/// A figure of which nothing is known yet but what it is.
Figure titled(std::string name, std::string title);

/// How the figures are to be made.
struct Request
{
    std::filesystem::path folder;
    int samples = 64;      ///< per pixel of pictures
    double size = 1;       ///< scale of pictures
    double precision = 1;  ///< scale of the number of samples behind a measured number
    std::uint32_t seed = 1;
    int threads = 0;
    Progress::Style progress = Progress::Style::Silent;
    const std::atomic<bool>* stop = nullptr;

    bool stopped() const { return stop && stop->load(); }
};

/// Thrown by a figure that was asked to stop.
struct Stopped
{};

struct Maker
{
    std::string_view name, summary;
    Figure (*make)(const Request&);
};

/// All of them, in the paper's order.
const std::vector<Maker>& makers();

Figure make_figure1(const Request&);
Figure make_figure2(const Request&);
Figure make_figure3(const Request&);
Figure make_figure4(const Request&);
Figure make_figure5(const Request&);
Figure make_figure6(const Request&);
Figure make_figure7(const Request&);
Figure make_figure8(const Request&);
Figure make_figure9(const Request&);
Figure make_table1(const Request&);

/// Agrees where `holds`.
Finding tested(std::string claim, std::string measured, bool holds);
Finding shown(std::string claim, std::string measured);

/// Writes text whole or not at all.
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace regain::tools::figures
