// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "../support/temporary_folder.h"

#include <regain/conformance/run.h>
#include <regain/conformance/shared_object.h>

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

using namespace regain::conformance;

namespace {

std::string object(const std::string& name) { return REGAIN_OBJECTS "/" + name + ".so"; }

// What is said of it, or that it loads.
std::string refusal(const std::string& file)
{
    try
    {
        load_shared_object(file);
    }
    catch (const std::runtime_error& e)
    {
        return e.what();
    }
    return "it loads";
}

bool says(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

const Direction up(0, 0, 1);

}  // namespace

TEST(KitSharedObject, gives_its_subjects_in_order)
{
    const auto subjects = load_shared_object(object("good"));
    ASSERT_EQ(subjects.size(), 2u);
    EXPECT_EQ(subjects[0]->name(), "lambert");
    EXPECT_EQ(subjects[1]->name(), "lambert2");
    EXPECT_TRUE(subjects[0]->reads().twice);
    EXPECT_FALSE(subjects[0]->reads().single);
    EXPECT_FALSE(subjects[0]->reads().alpha);
    EXPECT_EQ(subjects[0]->bare(), nullptr);
    EXPECT_EQ(subjects[0]->form(), Form::none);
}

TEST(KitSharedObject, closures_answer_what_the_object_computes)
{
    const double pi = std::acos(-1.0);
    const auto subjects = load_shared_object(object("good"));
    const auto closure = subjects[0]->make({});
    EXPECT_TRUE(closure->traits().reciprocal);
    EXPECT_FALSE(closure->traits().energy_preserving);
    EXPECT_EQ(closure->traits().random_numbers, 2);
    closure->prepare(Direction(0.6, 0, 0.8));
    const Direction wi(0, -0.6, 0.8);
    EXPECT_EQ(closure->eval(wi, up), Color(0.5 * 0.8 / pi));
    EXPECT_EQ(closure->pdf(wi), 0.8 / pi);
    EXPECT_EQ(closure->albedo().reflect, Color(0.5));
    EXPECT_EQ(closure->albedo().transmit, Color(0.0));
    const regain::Sample<double> s = closure->sample(Direction(0.25, 0, 0));
    EXPECT_TRUE(s.valid);
    EXPECT_FALSE(s.delta);
    EXPECT_EQ(s.wi, Direction(std::sqrt(0.75), 0, 0.5));
    EXPECT_EQ(s.weight, Color(0.5));
    EXPECT_EQ(s.pdf, 0.5 / pi);
    closure->prepare(Direction(0, 0, -1));
    EXPECT_FALSE(closure->sample(Direction(0.25, 0, 0)).valid);
}

TEST(KitSharedObject, promises_are_fixed_or_follow_parameters)
{
    const auto fixed = load_shared_object(object("good"))[0]->promises({}, up);
    EXPECT_EQ(fixed.surplus, 0);
    EXPECT_EQ(fixed.furnace, std::nullopt);
    EXPECT_EQ(fixed.weight, 0.5);
    EXPECT_EQ(fixed.single, 1e-3);
    EXPECT_EQ(fixed.albedo_noise, 0);
    EXPECT_EQ(fixed.pdf, 5e-4);
    Parameters p;
    p.alpha_x = 0.75;
    const auto following = load_shared_object(object("promising"))[0]->promises(p, up);
    EXPECT_EQ(following.weight, 0.75);
    EXPECT_EQ(following.surplus, std::nullopt);
    EXPECT_EQ(following.albedo, fixed.albedo);
    EXPECT_EQ(following.single, 2e-3);
    EXPECT_EQ(following.albedo_noise, 1e-2);
    EXPECT_EQ(following.pdf, 3e-3);
}

TEST(KitSharedObject, subjects_know_those_that_they_name)
{
    const auto subjects = load_shared_object(object("related"));
    EXPECT_EQ(subjects[1]->bare(), subjects[0].get());
    EXPECT_EQ(subjects[1]->reference(), subjects[0].get());
    EXPECT_EQ(subjects[1]->form(), Form::replaced);
    EXPECT_EQ(subjects[0]->bare(), nullptr);
}

TEST(KitSharedObject, stays_open_as_long_as_a_closure_of_it_lives)
{
    std::unique_ptr<TestedClosure> closure;
    {
        closure = load_shared_object(object("good"))[1]->make({});
    }
    closure->prepare(up);
    EXPECT_EQ(closure->albedo().reflect, Color(0.5));
}

TEST(KitSharedObject, what_cannot_be_used_is_refused_with_the_reason)
{
    for (const auto& [name, part] : std::vector<std::pair<std::string, std::string>>{
             {"no_symbol", "exports no function regain_conformance_subject"},
             {"newer",
              "subject 1 was written for version 2 of the interface; this kit knows 1 to 1"},
             {"no_version", "subject 0 was written for version 0"},
             {"other_size", "its struct has 8 bytes"},
             {"no_subjects", "it has no subjects"},
             {"endless", "more than 1000 subjects"},
             {"null_name", "subject 1 has no name"},
             {"empty_name", "the name '' cannot be used"},
             {"bad_name", "the name 'a name; with more' cannot be used; accepted: "},
             {"same_name", "two of its subjects are called 'lambert'"},
             {"null_create", "the function create of 'lambert' is null"},
             {"null_destroy", "the function destroy of 'lambert' is null"},
             {"null_traits", "the function traits of 'lambert' is null"},
             {"null_eval", "the function eval of 'lambert' is null"},
             {"null_pdf", "the function pdf of 'lambert' is null"},
             {"null_sample", "the function sample of 'lambert' is null"},
             {"null_albedo", "the function albedo of 'lambert' is null"},
             {"no_precision", "neither in float nor in double"},
             {"no_range", "reads gamma from 3"},
             {"bad_form", "the form of 'lambert2' is 5; accepted: 0 to 4"},
             {"bad_bare", "'lambert' names 'a name; with more'"}})
    {
        const std::string said = refusal(object(name));
        EXPECT_TRUE(says(said, part)) << name << ": " << said;
        EXPECT_TRUE(says(said, "cannot use '" + object(name) + "'")) << said;
    }
}

TEST(KitSharedObject, a_file_that_is_none_or_no_object_is_refused)
{
    const test::TemporaryFolder folder;
    EXPECT_TRUE(says(refusal(folder / "none.so"), "there is no such file"));
    EXPECT_TRUE(says(refusal(folder.path()), "it is a folder"));
    const std::string text = folder.write("text.so", "no object");
    const std::string said = refusal(text);
    EXPECT_TRUE(says(said, "cannot be loaded as a shared object (")) << said;
    EXPECT_TRUE(says(said, "text.so")) << said;
}

TEST(KitSharedObject, a_closure_that_is_not_made_or_answers_nan_fails_and_ends_nothing)
{
    const auto subjects = load_shared_object(object("not_finite"));
    for (const auto& subject : subjects)
    {
        Options one;
        one.setting = "double,mu=0.7";
        Report report;
        ASSERT_NO_THROW(report = run({subject.get()}, one));
        EXPECT_FALSE(report.passed()) << subject->name();
        EXPECT_FALSE(report.interrupted);
    }
}

TEST(KitSharedObject, subjects_of_one_name_are_refused_in_one_run)
{
    const auto one = load_shared_object(object("good")), two = load_shared_object(object("good"));
    EXPECT_THROW(run({one[0].get(), two[0].get()}), std::invalid_argument);
}
