// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "../support/temporary_folder.h"

#include <regain/conformance/run.h>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>

#include <cmath>
#include <sstream>
#include <stdexcept>

using namespace regain::conformance;
using nlohmann::json;

namespace {

Verdict verdict(const std::string& subject, const std::string& check, Verdict::Kind kind)
{
    Verdict v;
    v.subject = subject;
    v.check = check;
    v.title = check + "'s <title> & more";
    v.kind = kind;
    v.settings = kind == Verdict::Kind::not_applicable ? 0 : 3;
    v.measured = 0.125;
    v.bound = 0.25;
    v.worst = "mu=0.3";
    v.seconds = 1.5;
    if (kind == Verdict::Kind::not_applicable) v.reason = "a \"reason\"";
    if (kind == Verdict::Kind::failed)
    {
        v.measured = 0.5;
        v.failures.push_back({"mu=0.3", 0.5, 0.25, 1e-9, "u [0.1, 0.2, 0.3]",
                              "regain conform --setting 'mu=0.3'", nullptr});
        v.failures.push_back({"", std::nan(""), 0.25, 0, "all of it", "regain conform", nullptr});
    }
    return v;
}

Report report()
{
    Report r;
    r.tier = "commit";
    r.verdicts = {verdict("one", "C3", Verdict::Kind::passed),
                  verdict("one", "C4", Verdict::Kind::failed),
                  verdict("one", "C5", Verdict::Kind::not_applicable),
                  verdict("two", "C3", Verdict::Kind::passed),
                  verdict("two", "C5", Verdict::Kind::not_applicable)};
    r.statistical_tests = 12;
    r.level = 1e-4;
    r.seconds = 3;
    return r;
}

template <class Write>
std::string text(const Write& write)
{
    std::ostringstream out;
    write(out);
    return out.str();
}

bool says(const std::string& all, const std::string& part)
{
    return all.find(part) != std::string::npos;
}

std::string attribute(const pugi::xml_node& node, const char* name)
{
    return node.attribute(name).value();
}

}  // namespace

TEST(KitReports, json_says_what_the_report_does)
{
    const Report r = report();
    const test::TemporaryFolder folder;
    write_json(folder / "report.json", r);
    std::ifstream in(folder / "report.json");
    const json j = json::parse(in);
    EXPECT_EQ(j["passed"], 2);
    EXPECT_EQ(j["failed"], 1);
    EXPECT_EQ(j["not_applicable"], 2);
    EXPECT_EQ(j["interrupted"], false);
    EXPECT_EQ(j["statistical_tests"], 12);
    ASSERT_EQ(j["verdicts"].size(), r.verdicts.size());
    for (std::size_t i = 0; i < r.verdicts.size(); ++i)
    {
        const json& v = j["verdicts"][i];
        EXPECT_EQ(v["subject"], r.verdicts[i].subject);
        EXPECT_EQ(v["check"], r.verdicts[i].check);
        EXPECT_EQ(v["title"], r.verdicts[i].title);
    }
    EXPECT_EQ(j["verdicts"][0]["result"], "passed");
    EXPECT_EQ(j["verdicts"][0]["measured"], 0.125);
    EXPECT_EQ(j["verdicts"][2]["result"], "not applicable");
    EXPECT_EQ(j["verdicts"][2]["reason"], "a \"reason\"");
    const json& failed = j["verdicts"][1];
    EXPECT_EQ(failed["result"], "failed");
    ASSERT_EQ(failed["failures"].size(), 2u);
    EXPECT_EQ(failed["failures"][0]["setting"], "mu=0.3");
    EXPECT_EQ(failed["failures"][0]["probability"], 1e-9);
    EXPECT_EQ(failed["failures"][0]["reproduce"], "regain conform --setting 'mu=0.3'");
    EXPECT_TRUE(failed["failures"][1]["measured"].is_null());
}

TEST(KitReports, junit_says_what_the_report_does)
{
    const Report r = report();
    const test::TemporaryFolder folder;
    write_junit(folder / "report.xml", r);
    pugi::xml_document document;
    ASSERT_TRUE(document.load_file((folder / "report.xml").c_str()));
    const pugi::xml_node suites = document.child("testsuites");
    EXPECT_EQ(attribute(suites, "tests"), "5");
    EXPECT_EQ(attribute(suites, "failures"), "1");
    EXPECT_EQ(attribute(suites, "skipped"), "2");
    EXPECT_EQ(attribute(suites, "errors"), "0");
    std::size_t i = 0;
    for (const pugi::xml_node& suite : suites.children("testsuite"))
        for (const pugi::xml_node& c : suite.children("testcase"))
        {
            ASSERT_LT(i, r.verdicts.size());
            const Verdict& v = r.verdicts[i++];
            EXPECT_EQ(attribute(suite, "name"), v.subject);
            EXPECT_EQ(attribute(c, "classname"), v.subject);
            EXPECT_EQ(attribute(c, "name"), v.check + " " + v.title);
            EXPECT_EQ(!c.child("failure").empty(), v.kind == Verdict::Kind::failed);
            EXPECT_EQ(attribute(c.child("skipped"), "message"), v.reason);
            for (const Failure& f : v.failures)
            {
                const std::string all = c.child("failure").child_value();
                EXPECT_TRUE(says(all, f.setting + "\n")) << all;
                EXPECT_TRUE(says(all, f.detail)) << all;
                EXPECT_TRUE(says(all, f.reproduce)) << all;
            }
        }
    EXPECT_EQ(i, r.verdicts.size());
}

TEST(KitReports, an_interrupted_run_does_not_pass_for_a_whole_one)
{
    Report r = report();
    r.verdicts.erase(r.verdicts.begin() + 1);  // the failure
    EXPECT_TRUE(r.passed());
    r.interrupted = true;
    EXPECT_FALSE(r.passed());
    const test::TemporaryFolder folder;
    write_junit(folder / "report.xml", r);
    pugi::xml_document document;
    ASSERT_TRUE(document.load_file((folder / "report.xml").c_str()));
    EXPECT_EQ(attribute(document.child("testsuites"), "errors"), "1");
    EXPECT_FALSE(document.select_node("//testcase/error[@message='interrupted']").node().empty());
    EXPECT_EQ(json::parse(text([&](auto& out) { write_json(out, r); }))["interrupted"], true);
    EXPECT_TRUE(says(text([&](auto& out) { write_summary(out, r); }), ", interrupted: "));
    EXPECT_TRUE(says(text([&](auto& out) { write_markdown(out, r); }), ", interrupted: "));
}

TEST(KitReports, the_table_has_a_row_for_each_subject_and_explains_each_check)
{
    Report r = report();
    const std::string table = text([&](auto& out) { write_markdown(out, r); });
    EXPECT_TRUE(says(table, "| subject | C3 | C4 | C5 |\n|---|---:|---:|---:|\n")) << table;
    EXPECT_TRUE(says(table, "| `one` | 0.125 | **FAILED** 0.5 | - |\n")) << table;
    EXPECT_TRUE(says(table, "| `two` | 0.125 | - | - |\n")) << table;
    for (const CheckTitle& c : all_checks())
        EXPECT_TRUE(says(table, "| " + c.id + " | " + c.title + " | ")) << c.id;
    // Times make no difference.
    for (Verdict& v : r.verdicts) v.seconds *= 2;
    r.seconds = 77;
    EXPECT_EQ(text([&](auto& out) { write_markdown(out, r); }), table);
}

TEST(KitReports, the_summary_has_a_line_for_each_subject_and_every_failure)
{
    const Report r = report();
    const std::string summary = text([&](auto& out) { write_summary(out, r); });
    EXPECT_EQ(summary.find("2 subjects, tier commit: 2 checks passed, 1 failed, 2 not applicable"),
              0u);
    EXPECT_TRUE(says(summary, "\none  FAILED C4; passed C3\n")) << summary;
    EXPECT_TRUE(says(summary, "\ntwo  passed C3\n")) << summary;
    EXPECT_TRUE(says(summary, "at 2 of 3 settings")) << summary;
    EXPECT_TRUE(says(summary, "measured 0.5, accepted up to 0.25; by chance once in 1e+09"));
    for (const Failure& f : r.verdicts[1].failures)
    {
        EXPECT_TRUE(says(summary, "    " + f.detail + "\n")) << summary;
        EXPECT_TRUE(says(summary, "    " + f.reproduce + "\n")) << summary;
    }
}

TEST(KitReports, histograms_come_back_from_their_files)
{
    const test::TemporaryFolder folder;
    Histogram h;
    h.width = 3;
    h.height = 2;
    h.found = {0, 1, 2, 3, 4, 1e7f + 1};
    h.expected = {0.5f, 1, 1, 1, 4.25f, 1e7f};
    write_histogram(folder / "h.exr", h);
    Imf::InputFile in((folder / "h.exr").c_str());
    const Imath::Box2i window = in.header().dataWindow();
    EXPECT_EQ(window, Imath::Box2i(Imath::V2i(0), Imath::V2i(2, 1)));
    for (const char* name : {"found", "expected", "difference"})
    {
        ASSERT_TRUE(in.header().channels().findChannel(name)) << name;
        std::vector<float> values(6);
        Imf::FrameBuffer frame;
        frame.insert(name, Imf::Slice::Make(Imf::FLOAT, values.data(), window));
        in.setFrameBuffer(frame);
        in.readPixels(0, 1);
        for (std::size_t i = 0; i < 6; ++i)
            EXPECT_EQ(values[i], std::string(name) == "found"      ? h.found[i]
                                 : std::string(name) == "expected" ? h.expected[i]
                                                                   : h.found[i] - h.expected[i]);
    }
    h.found.pop_back();
    EXPECT_THROW(write_histogram(folder / "h.exr", h), std::invalid_argument);
    EXPECT_THROW(write_histogram(folder / "h.exr", {}), std::invalid_argument);
}

TEST(KitReports, files_that_cannot_be_written_are_named)
{
    const test::TemporaryFolder folder;
    const Report r = report();
    const auto file = folder / "none/report";
    const std::vector<std::function<void()>> writers{[&] { write_json(file, r); },
                                                     [&] { write_junit(file, r); },
                                                     [&] { write_markdown(file, r); },
                                                     [&] {
                                                         write_histogram(file, {1, 1, {0}, {0}});
                                                     }};
    for (const auto& write : writers) try
        {
            write();
            ADD_FAILURE() << "it was written";
        }
        catch (const std::runtime_error& e)
        {
            EXPECT_TRUE(says(e.what(), file.string())) << e.what();
        }
    EXPECT_FALSE(std::filesystem::exists(folder / "none"));
}
