// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "describe.h"

#include <nlohmann/json.hpp>

#include <ostream>

REGAIN_NAMESPACE_BEGIN
namespace conformance {
namespace {

// Fields stay in the order in which they are read.
using Json = nlohmann::ordered_json;

const char* name(Verdict::Kind kind)
{
    switch (kind)
    {
        case Verdict::Kind::passed: return "passed";
        case Verdict::Kind::failed: return "failed";
        case Verdict::Kind::not_applicable: break;
    }
    return "not applicable";
}

Json in_json(const Failure& f)
{
    return {{"setting", f.setting}, {"measured", f.measured},       {"bound", f.bound},
            {"detail", f.detail},   {"probability", f.probability}, {"reproduce", f.reproduce}};
}

Json in_json(const Verdict& v)
{
    Json j = {
        {"subject", v.subject}, {"check", v.check}, {"title", v.title}, {"result", name(v.kind)}};
    if (v.kind == Verdict::Kind::not_applicable)
    {
        j["reason"] = v.reason;
        return j;
    }
    j["settings"] = v.settings;
    j["measured"] = v.measured;
    j["bound"] = v.bound;
    j["worst"] = v.worst;
    if (!v.note.empty()) j["note"] = v.note;
    j["seconds"] = v.seconds;
    j["failures"] = Json::array();
    for (const Failure& f : v.failures) j["failures"].push_back(in_json(f));
    return j;
}

}  // namespace

void write_json(std::ostream& out, const Report& report)
{
    Json j = {{"version", REGAIN_VERSION_STRING},
              {"tier", report.tier},
              {"passed", report.count(Verdict::Kind::passed)},
              {"failed", report.count(Verdict::Kind::failed)},
              {"not_applicable", report.count(Verdict::Kind::not_applicable)},
              {"interrupted", report.interrupted},
              {"statistical_tests", report.statistical_tests},
              {"level", report.level},
              {"seconds", report.seconds}};
    j["verdicts"] = Json::array();
    for (const Verdict& v : report.verdicts) j["verdicts"].push_back(in_json(v));
    // What a subject says of itself may be no UTF-8.
    out << j.dump(2, ' ', false, Json::error_handler_t::replace) << "\n";
}

void write_json(const std::filesystem::path& file, const Report& report)
{
    write_text(file, [&](std::ostream& out) { write_json(out, report); });
}

}  // namespace conformance
REGAIN_NAMESPACE_END
