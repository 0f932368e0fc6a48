// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// The kit itself: each planted bug is rejected by the check that is meant to see it, and a closure
// without one passes all.

#include "bugs.h"

#include <regain/conformance/run.h>

#include <gtest/gtest.h>

#include <sstream>

namespace regain::planted { namespace {

using conformance::Options;
using conformance::Report;
using conformance::Verdict;

std::string summary_of(const Report& report)
{
    std::ostringstream text;
    write_summary(text, report);
    return text.str();
}

bool is_by_chance(const std::string& id)
{
    for (const conformance::CheckTitle& check : conformance::all_checks())
        if (check.id == id) return check.by_chance;
    return false;
}

class PlantedBug : public testing::Test
{
public:
    explicit PlantedBug(const Bug& bug) : _bug(bug) {}

    void TestBody() override
    {
        Options options;
        options.checks = {_bug.check};
        options.setting = _bug.setting;
        options.tier = _bug.tier;
        const PlantedSubject subject = _bug.subject(_bug.name);
        const Report report = run({subject.get()}, options);
        ASSERT_EQ(report.verdicts.size(), 1u);
        const Verdict& verdict = report.verdicts[0];
        ASSERT_EQ(verdict.kind, Verdict::Kind::failed) << verdict.reason << summary_of(report);
        for (const conformance::Failure& f : verdict.failures)
        {
            EXPECT_FALSE(f.detail.empty()) << f.setting;
            EXPECT_NE(f.reproduce.find("--check " + _bug.check), std::string::npos) << f.reproduce;
            if (is_by_chance(_bug.check))
                EXPECT_LT(f.probability, report.level) << f.detail;
            else
                EXPECT_GT(f.measured, f.bound) << f.detail;
        }
        RecordProperty("rejected", summary_of(report));
    }

private:
    const Bug& _bug;
};

class Faultless : public testing::Test
{
public:
    explicit Faultless(std::size_t which) : _which(which) {}

    void TestBody() override
    {
        const PlantedSubject subject = faultless()[_which];
        const Report report = conformance::run({subject.get()});
        EXPECT_TRUE(report.passed()) << summary_of(report);
        EXPECT_GT(report.count(Verdict::Kind::passed), 6u) << summary_of(report);
    }

private:
    std::size_t _which;
};

// By name, so that a test says what was planted and who found it.
const bool registered = [] {
    for (const Bug& bug : bugs())
        testing::RegisterTest("PlantedBug", (bug.name + "_is_rejected_by_" + bug.check).c_str(),
                              nullptr, nullptr, __FILE__, __LINE__,
                              [&bug]() -> testing::Test* { return new PlantedBug(bug); });
    const std::vector<PlantedSubject> all = faultless();
    for (std::size_t i = 0; i < all.size(); ++i)
        testing::RegisterTest("Faultless", (all[i]->name() + "_passes_every_check").c_str(),
                              nullptr, nullptr, __FILE__, __LINE__,
                              [i]() -> testing::Test* { return new Faultless(i); });
    return true;
}();

}}  // namespace regain::planted
