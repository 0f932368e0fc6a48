// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A run of the kit:
///
///     Report report = run({&my_subject}, {});
///     write_summary(std::cout, report);
///     return report.passed() ? 0 : 1;
///
/// Every random number comes from a seed that is the hash of the name of the case, so any case can
/// be run alone and gives the same numbers. Where chance has a part, all tests of a run together
/// raise a false alarm with a probability of 1e-3 (Sidak's level for each); a rejection counts when
/// a second look, at 16 times as many samples from another seed, rejects, too.

#pragma once

#include <regain/conformance/report.h>
#include <regain/conformance/subject.h>

#include <cstdint>
#include <functional>

REGAIN_NAMESPACE_BEGIN
namespace conformance {

/// commit: minutes for the whole library; thorough: the full grid and 1e8 hostile inputs, an hour.
enum class Tier { commit, thorough };

struct Options
{
    Tier tier = Tier::commit;
    /// A subject's name, or part of those of several, or empty for all; ids of checks, "C4", or
    /// empty for all; a whole setting, as failures name it, or empty for all.
    std::string subject;
    std::vector<std::string> checks;
    std::string setting;
    /// Of the subjects that these leave, those that are run, by their number from 0 on; empty: all.
    /// The level of the tests is that of all: what several runs find of the subjects of one is what
    /// one finds.
    std::function<bool(std::size_t)> chosen;
    /// Other random numbers for every case: for the test of the kit itself.
    std::uint64_t salt = 0;
    int threads = 0;  ///< 0: one a processor
    double family_error = 1e-3;
    /// What a failure's command begins with: "regain conform my.so".
    std::string command = "regain conform";
    /// Called with the fraction done, by the thread that runs; false stops.
    std::function<bool(double)> progress;
};

/// Ids and titles of all checks, in order.
struct CheckTitle
{
    std::string id, title;
    bool by_chance;  ///< random numbers decide
};
REGAIN_CONFORMANCE_API std::vector<CheckTitle> all_checks();

/// Throws std::invalid_argument where the options name a check that is none, nothing is left to
/// run, or a subject's name is unusable or another's.
REGAIN_CONFORMANCE_API Report run(const std::vector<const Subject*>& subjects,
                                  const Options& options = {});

}  // namespace conformance
REGAIN_NAMESPACE_END
