// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The files that `regain conform` leaves, and whether they can be written, which is asked before
/// an hour is spent.

#pragma once

#include <regain/conformance/report.h>

#include <string>

namespace regain::tools {

/// Names of files and of a folder; empty: not wanted.
struct ReportFiles
{
    std::string junit, json, markdown, histograms;
};

/// Makes the folder. Throws BadInput or std::runtime_error that names what cannot be written, or
/// is given twice.
void require_writable(const ReportFiles& files);

/// Each file whole or not at all. Returns what was written, for messages.
std::vector<std::string> write_reports(const ReportFiles& files, const conformance::Report& report);

}  // namespace regain::tools
