// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// A GPU's answers are the CPU's. Where there is no GPU that each closure compiles for one is all
// that can be said: this program links a kernel for each.

#include "comparison.h"
#include "subjects.h"
#include "surfaces.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace regain;
using namespace regain::tests;

namespace {

struct Machines
{
    const char* list;
    const char* tables;  // of which distribution
    std::vector<Subject> (*cpu)();
    std::vector<Subject> (*gpu)();
};
void PrintTo(const Machines& m, std::ostream* out) { *out << m.list; }

class Answers : public testing::TestWithParam<Machines>
{
protected:
    const std::vector<Subject> cpu = GetParam().cpu(), gpu = GetParam().gpu();
    const std::vector<Surface> surfaces = surfaces_of(GetParam().tables);
    const std::vector<Question> asked = questions();
    static constexpr int one = 7;  // of the questions
};

// Light comes a rounding off; random numbers stay, since streams are hashed from them.
std::vector<Question> a_rounding_off(std::vector<Question> all)
{
    for (Question& q : all)
    {
        q.wo.x = std::nextafter(q.wo.x, 2.0f);
        q.wo.z = std::nextafter(q.wo.z, -2.0f);
        q.wi.y = std::nextafter(q.wi.y, 2.0f);
        q.wi.z = std::nextafter(q.wi.z, 2.0f);
    }
    return all;
}

TEST_P(Answers, every_closure_has_a_kernel)
{
    ASSERT_FALSE(cpu.empty());
    ASSERT_EQ(cpu.size(), gpu.size());
    for (std::size_t i = 0; i < cpu.size(); ++i)
    {
        EXPECT_EQ(cpu[i].name, gpu[i].name);
        EXPECT_TRUE(gpu[i].ask) << gpu[i].name;
    }
}

TEST_P(Answers, a_gpu_answers_as_the_cpu_does)
{
    if (const std::string why = why_no_gpu(); !why.empty())
        GTEST_SKIP() << "the kernels were compiled and not run: " << why;
    for (const Surface& surface : surfaces)
        for (std::size_t i = 0; i < cpu.size(); ++i)
            EXPECT_EQ(differences(cpu[i], surface, asked, gpu[i].ask(surface, asked)), "")
                << cpu[i].name << ", alpha " << surface.alpha_x << ", " << surface.alpha_y;
}

// That comparison by itself.

TEST_P(Answers, rounding_makes_no_difference)
{
    for (const Surface& surface : surfaces)
        for (const Subject& subject : cpu)
            EXPECT_EQ(
                differences(subject, surface, asked, subject.ask(surface, a_rounding_off(asked))),
                "")
                << subject.name << ", alpha " << surface.alpha_x << ", " << surface.alpha_y;
}

TEST_P(Answers, another_closure_makes_a_difference)
{
    Surface other = surfaces[0];
    other.color *= 0.99f;
    other.alpha_x *= 1.02f;
    other.strength *= 0.99f;
    for (const Subject& subject : cpu)
        EXPECT_NE(differences(subject, surfaces[0], asked, subject.ask(other, asked)), "")
            << subject.name;
}

TEST_P(Answers, one_number_that_is_off_makes_a_difference)
{
    const std::vector<Answer> right = cpu[0].ask(surfaces[0], asked);
    ASSERT_EQ(right[one].numbers[Answer::valid], 1);
    for (int k = 0; k < Answer::size; ++k)
    {
        std::vector<Answer> wrong = right;
        float& number = wrong[one].numbers[k];
        number += 0.02f * (1 + std::abs(number));
        EXPECT_EQ(differences(cpu[0], surfaces[0], asked, wrong)
                      .find("question " + std::to_string(one) + ", " + name_of_number(k)),
                  0u)
            << name_of_number(k);
        number = std::nanf("");
        EXPECT_NE(differences(cpu[0], surfaces[0], asked, wrong), "") << name_of_number(k);
    }
}

INSTANTIATE_TEST_SUITE_P(
    of, Answers,
    testing::Values(Machines{"ggx", "ggx", ggx_on_cpu, ggx_on_gpu},
                    Machines{"beckmann", "beckmann", beckmann_on_cpu, beckmann_on_gpu},
                    Machines{"gtr", "gtr", gtr_on_cpu, gtr_on_gpu},
                    Machines{"std", "std", std_on_cpu, std_on_gpu},
                    Machines{"plain", "ggx", plain_on_cpu, plain_on_gpu}),
    [](const testing::TestParamInfo<Machines>& m) { return std::string(m.param.list); });

}  // namespace
