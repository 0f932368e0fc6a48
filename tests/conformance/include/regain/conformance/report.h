// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What a run of the kit found, and the forms in which it is written down.

#pragma once

#include <regain/closures/version.h>
#include <regain/conformance/export.h>

#include <filesystem>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

REGAIN_NAMESPACE_BEGIN
namespace conformance {

/// Counts of samples in cells of the sphere, on a grid of equal solid angles: rows from the normal
/// (top) to the nadir, columns from the azimuth of wo on. For people to look at; the test itself
/// has cells that follow the lobe.
struct Histogram
{
    int width = 0, height = 0;
    std::vector<float> found, expected;  ///< row by row
};

struct Failure
{
    std::string setting;  ///< the parameters and the direction
    double measured = 0, bound = 0;
    double probability = 0;  ///< of as much by chance; 0 where chance has no part
    std::string detail;      ///< directions, random numbers, values
    std::string reproduce;   ///< one command
    std::shared_ptr<const Histogram> histogram;
};

/// One check of one subject, over all its settings.
struct Verdict
{
    enum class Kind { passed, failed, not_applicable };

    std::string subject, check,
        title;  ///< "conductor.ggx.turquin", "C4", "the pdf integrates to 1"
    Kind kind = Kind::passed;
    std::string reason;  ///< why it does not apply
    std::size_t settings = 0;
    /// Of the setting that came nearest to its bound, or furthest beyond.
    double measured = 0, bound = 0;
    std::string worst;
    std::string note;  ///< what was found out on the way
    double seconds = 0;
    std::vector<Failure> failures;
};

struct Report
{
    std::string tier;
    std::vector<Verdict> verdicts;
    std::size_t statistical_tests = 0;  ///< that share the family-wise error
    double level = 0;                   ///< of each of them
    double seconds = 0;
    bool interrupted = false;

    REGAIN_CONFORMANCE_API std::size_t count(Verdict::Kind kind) const;
    bool passed() const { return !interrupted && count(Verdict::Kind::failed) == 0; }
};

/// For people: how many passed, a line for each subject that did, then every failure with all that
/// is known about it.
REGAIN_CONFORMANCE_API void write_summary(std::ostream& out, const Report& report);
/// A table of subjects and checks, in Markdown. The same results give the same text: it holds no
/// times.
REGAIN_CONFORMANCE_API void write_markdown(std::ostream& out, const Report& report);
/// One object, with all that the report holds but the histograms. A number that is not finite is
/// null.
REGAIN_CONFORMANCE_API void write_json(std::ostream& out, const Report& report);

/// These write the file whole or not at all, and throw std::runtime_error that names it.
REGAIN_CONFORMANCE_API void write_markdown(const std::filesystem::path& file, const Report& report);
REGAIN_CONFORMANCE_API void write_json(const std::filesystem::path& file, const Report& report);
/// JUnit's XML: a suite for each subject, a case for each check. An interrupted run has an error.
REGAIN_CONFORMANCE_API void write_junit(const std::filesystem::path& file, const Report& report);
/// OpenEXR, 32-bit channels found, expected and difference, which is found - expected. Throws
/// std::invalid_argument where the histogram is empty or its size is not that of its counts.
REGAIN_CONFORMANCE_API void write_histogram(const std::filesystem::path& file,
                                            const Histogram& histogram);

}  // namespace conformance
REGAIN_NAMESPACE_END
