// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "conform_parts.h"

#include <algorithm>
#include <cstdint>
#include <map>

namespace regain::tools {

using conformance::Failure;
using conformance::Histogram;
using conformance::Report;
using conformance::Verdict;

namespace {

// One list of fields, for both directions: visit(field) of each that a file holds.
template <class Visit>
void each_field(Failure& f, const Visit& visit)
{
    visit(f.setting), visit(f.measured), visit(f.bound), visit(f.probability), visit(f.detail);
    visit(f.reproduce);
}
template <class Visit>
void each_field(Verdict& v, const Visit& visit)
{
    visit(v.subject), visit(v.check), visit(v.title), visit(v.kind), visit(v.reason);
    visit(v.settings), visit(v.measured), visit(v.bound), visit(v.worst), visit(v.note);
    visit(v.seconds);
}
template <class Visit>
void each_field(Report& r, const Visit& visit)
{
    visit(r.tier), visit(r.statistical_tests), visit(r.level), visit(r.seconds);
}

struct Writer
{
    Payload& payload;

    void operator()(const std::string& text) const { payload.put_text(text); }
    template <class Number>
    void operator()(const Number& number) const
    {
        payload.put(&number, 1);
    }
};

struct Reader
{
    PayloadReader& payload;

    void operator()(std::string& text) const { text = payload.take_text(); }
    template <class Number>
    void operator()(Number& number) const
    {
        payload.take(&number, 1);
    }
};

void put(Payload& payload, const Histogram& h)
{
    const int size[] = {h.width, h.height};
    payload.put(size, 2);
    payload.put(h.found.data(), h.found.size());
    payload.put(h.expected.data(), h.expected.size());
}

Histogram take_histogram(PayloadReader& payload)
{
    int size[2];
    payload.take(size, 2);
    Histogram h{size[0], size[1], {}, {}};
    h.found.resize(static_cast<std::size_t>(h.width) * static_cast<std::size_t>(h.height));
    h.expected.resize(h.found.size());
    payload.take(h.found.data(), h.found.size());
    payload.take(h.expected.data(), h.expected.size());
    return h;
}

Report read(PayloadReader& payload)
{
    const Reader take{payload};
    const auto take_count = [&] {
        std::uint64_t count = 0;
        take(count);
        return count;
    };
    Report report;
    each_field(report, take);
    for (std::uint64_t n = take_count(); n > 0; --n)
    {
        Verdict& v = report.verdicts.emplace_back();
        each_field(v, take);
        for (std::uint64_t m = take_count(); m > 0; --m)
        {
            Failure& f = v.failures.emplace_back();
            each_field(f, take);
            if (take_count() > 0)
                f.histogram = std::make_shared<const Histogram>(take_histogram(payload));
        }
    }
    return report;
}

}  // namespace

void write_conform_part(const std::filesystem::path& file, const Report& report,
                        const JobDescription& job, const Part& part)
{
    Payload payload;
    const Writer put_field{payload};
    const auto put_count = [&](std::uint64_t count) { put_field(count); };
    Report copy = report;
    each_field(copy, put_field);
    put_count(copy.verdicts.size());
    for (Verdict& v : copy.verdicts)
    {
        each_field(v, put_field);
        put_count(v.failures.size());
        for (Failure& f : v.failures)
        {
            each_field(f, put_field);
            put_count(f.histogram ? 1 : 0);
            if (f.histogram) put(payload, *f.histogram);
        }
    }
    write_part(file, job, part, payload.bytes());
}

Report merge_conform_parts(const std::vector<std::string>& files, const JobDescription& job,
                           const std::vector<const conformance::Subject*>& subjects)
{
    std::map<std::string, std::size_t> place;
    for (const conformance::Subject* subject : subjects)
        place.emplace(subject->name(), place.size());
    Report all;
    read_parts(files, job, [&](const Part&, PayloadReader& payload) {
        Report one = read(payload);
        all.tier = one.tier;
        all.statistical_tests = one.statistical_tests;
        all.level = one.level;
        all.seconds += one.seconds;
        std::move(one.verdicts.begin(), one.verdicts.end(), std::back_inserter(all.verdicts));
    });
    std::stable_sort(all.verdicts.begin(), all.verdicts.end(),
                     [&](const Verdict& a, const Verdict& b) {
                         return place.at(a.subject) < place.at(b.subject);
                     });
    return all;
}

}  // namespace regain::tools
