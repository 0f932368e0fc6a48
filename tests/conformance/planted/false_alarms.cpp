// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// How often the checks that chance decides raise a false alarm: runs them on closures without a
// fault, each time with other random numbers. A run is to raise one once in a thousand times.
//
//     build/release/tests/conformance/planted/false_alarms [runs] [first salt]

#include "bugs.h"

#include <regain/conformance/run.h>

#include <cstdlib>
#include <iostream>

namespace regain::planted { namespace {

// With its widths fixed, so that a run is short: the tests of this set share the error of a run by
// themselves.
PlantedSubject fixed(const PlantedSubject& subject)
{
    const auto of_width = [](Parameters p) {
        p.alpha_x = p.alpha_y = 0.4;
        return p;
    };
    Reads reads;
    reads.twice = true;
    reads.eta = subject->reads().eta;
    const auto one = new_subject(subject->name(), reads,
                                 [=](const Parameters& p) { return subject->make(of_width(p)); });
    one->promiser = [=](const Parameters& p, const Direction& wo) {
        return subject->promises(of_width(p), wo);
    };
    if (subject->normals({}))
        one->normals_maker = [=](const Parameters& p) { return subject->normals(of_width(p)); };
    if (subject->reference())
        one->compared_with = new_subject(
            subject->name() + ".library", reads,
            [=](const Parameters& p) { return subject->reference()->make(of_width(p)); });
    return one;
}

int main(int argc, char** argv)
{
    const unsigned long runs = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 1000;
    const unsigned long first = argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 1;
    // A value, a value on both sides, an estimate.
    std::vector<PlantedSubject> kept;
    std::vector<const Subject*> subjects;
    for (const PlantedSubject& subject : faultless())
        for (const char* name : {"mirror", "glass", "coat_estimate"})
            if (subject->name() == name)
            {
                kept.push_back(fixed(subject));
                subjects.push_back(kept.back().get());
            }
    conformance::Options options;
    for (const conformance::CheckTitle& check : conformance::all_checks())
        if (check.by_chance) options.checks.push_back(check.id);

    unsigned long alarms = 0;
    for (unsigned long i = 0; i < runs; ++i)
    {
        options.salt = first + i;
        const conformance::Report report = conformance::run(subjects, options);
        if (!report.passed())
        {
            ++alarms;
            std::cout << "salt " << options.salt << ":\n";
            write_summary(std::cout, report);
        }
        if (i == 0)
            std::cout << report.statistical_tests << " tests a run at " << report.level << " each, "
                      << report.seconds << " s a run" << std::endl;
        if ((i + 1) % 50 == 0) std::cout << alarms << " of " << i + 1 << " runs" << std::endl;
    }
    std::cout << alarms << " of " << runs << " runs raised a false alarm\n";
    return 0;
}

}}  // namespace regain::planted

int main(int argc, char** argv) { return regain::planted::main(argc, argv); }
