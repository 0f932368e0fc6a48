// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "describe.h"

#include <pugixml.hpp>

#include <algorithm>

REGAIN_NAMESPACE_BEGIN
namespace conformance {
namespace {

void set(pugi::xml_node node, const char* name, const std::string& value)
{
    node.append_attribute(name).set_value(value.c_str());
}
void set(pugi::xml_node node, const char* name, std::size_t value)
{
    set(node, name, std::to_string(value));
}
void set_seconds(pugi::xml_node node, double seconds)
{
    node.append_attribute("time").set_value(seconds, 6);
}

void add_case(pugi::xml_node suite, const Verdict& v)
{
    pugi::xml_node c = suite.append_child("testcase");
    set(c, "classname", v.subject);
    set(c, "name", v.check + " " + v.title);
    set_seconds(c, v.seconds);
    if (v.kind == Verdict::Kind::not_applicable)
        set(c.append_child("skipped"), "message", v.reason);
    if (v.kind != Verdict::Kind::failed) return;

    // Readers expect no more than one failure of a case: its text has them all.
    pugi::xml_node failure = c.append_child("failure");
    set(failure, "type", v.check);
    set(failure, "message",
        v.title + ": failed at " + std::to_string(v.failures.size()) + " of " +
            std::to_string(v.settings) + (v.settings == 1 ? " setting" : " settings"));
    std::string text = "\n";
    for (const Failure& f : v.failures)
        text += f.setting + "\n  " + in_short(f) + "\n  " + f.detail + "\n  " + f.reproduce + "\n";
    failure.append_child(pugi::node_pcdata).set_value(text.c_str());
}

void add_suite(pugi::xml_node suites, Verdicts first, Verdicts last)
{
    const auto count = [&](Verdict::Kind kind) {
        return static_cast<std::size_t>(
            std::count_if(first, last, [&](const Verdict& v) { return v.kind == kind; }));
    };
    double seconds = 0;
    for (auto v = first; v != last; ++v) seconds += v->seconds;
    pugi::xml_node suite = suites.append_child("testsuite");
    set(suite, "name", first->subject);
    set(suite, "tests", static_cast<std::size_t>(last - first));
    set(suite, "failures", count(Verdict::Kind::failed));
    set(suite, "errors", std::size_t(0));
    set(suite, "skipped", count(Verdict::Kind::not_applicable));
    set_seconds(suite, seconds);
    for (auto v = first; v != last; ++v) add_case(suite, *v);
}

// Partial results that all passed are not to pass for a run.
void add_interruption(pugi::xml_node suites)
{
    pugi::xml_node suite = suites.append_child("testsuite");
    set(suite, "name", std::string("run"));
    for (const char* attribute : {"tests", "errors"}) set(suite, attribute, std::size_t(1));
    for (const char* attribute : {"failures", "skipped"}) set(suite, attribute, std::size_t(0));
    pugi::xml_node c = suite.append_child("testcase");
    set(c, "classname", std::string("run"));
    set(c, "name", std::string("the run goes to its end"));
    set(c.append_child("error"), "message", std::string("interrupted"));
}

}  // namespace

void write_junit(const std::filesystem::path& file, const Report& report)
{
    pugi::xml_document document;
    pugi::xml_node declaration = document.append_child(pugi::node_declaration);
    set(declaration, "version", std::string("1.0"));
    set(declaration, "encoding", std::string("UTF-8"));
    pugi::xml_node suites = document.append_child("testsuites");
    set(suites, "name", "regain conform, tier " + report.tier);
    set(suites, "tests", report.verdicts.size() + report.interrupted);
    set(suites, "failures", report.count(Verdict::Kind::failed));
    set(suites, "errors", std::size_t(report.interrupted));
    set(suites, "skipped", report.count(Verdict::Kind::not_applicable));
    set_seconds(suites, report.seconds);
    for_each_subject(report,
                     [&](Verdicts first, Verdicts last) { add_suite(suites, first, last); });
    if (report.interrupted) add_interruption(suites);
    write_text(file, [&](std::ostream& out) { document.save(out, "  "); });
}

}  // namespace conformance
REGAIN_NAMESPACE_END
