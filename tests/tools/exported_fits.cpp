// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// The formulas that `regain bake --export` writes, compiled as they stand: what GLSL and OSL have
// in common with C++ is enough for them. They have to say what the closures say.

#include "export_fits.h"
#include "shader_expression.h"

#include <regain/closures/analytic_albedo.h>

#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <sstream>
#include <string>

namespace {

// A float of GLSL and OSL, whose literals have no suffix.
namespace shader {

struct Number
{
    Number(double v) : value(static_cast<float>(v)) {}
    float value;
};
Number operator+(Number a, Number b) { return a.value + b.value; }
Number operator-(Number a, Number b) { return a.value - b.value; }
Number operator*(Number a, Number b) { return a.value * b.value; }
Number operator/(Number a, Number b) { return a.value / b.value; }
Number min(Number a, Number b) { return b.value < a.value ? b : a; }
Number max(Number a, Number b) { return a.value < b.value ? b : a; }
Number sqrt(Number a) { return std::sqrt(a.value); }

}  // namespace shader

#if defined(__clang__)
#pragma clang diagnostic ignored "-Wkeyword-macro"
#endif
#define float shader::Number
namespace glsl {
#include "regain_fits.glsl"
}
#undef REGAIN_FITS
namespace osl {
#include "regain_fits.osl"
}
#undef float

using regain::MicrofacetFits;
using regain::tools::ShaderExpression;
using regain::tools::ShaderFunction;

using OfBoth = shader::Number (*)(shader::Number, shader::Number);
using OfAlpha = shader::Number (*)(shader::Number);

void compare(const MicrofacetFits& fits, OfBoth E_ss, OfAlpha E_avg, OfBoth q_ms, OfBoth mu_ms)
{
    for (int i = 0; i <= 100; ++i)
        for (int j = 0; j <= 100; ++j)
        {
            const float mu = std::pow(float(i) / 100, 2.0f), alpha = std::pow(float(j) / 100, 2.0f);
            EXPECT_NEAR(E_ss(mu, alpha).value, fits.E_ss(mu, alpha), 1e-6) << mu << " " << alpha;
            EXPECT_NEAR(q_ms(mu, alpha).value, fits.q_ms(mu, alpha), 1e-6) << mu << " " << alpha;
            EXPECT_NEAR(mu_ms(mu, alpha).value, fits.mu_ms(mu, alpha), 1e-6) << mu << " " << alpha;
            EXPECT_NEAR(E_avg(alpha).value, fits.E_avg(alpha), 1e-6) << alpha;
        }
}

TEST(ExportedFits, say_in_glsl_what_the_closures_say)
{
    using namespace glsl;
    compare(regain::ggx_fits, regain_ggx_E_ss, regain_ggx_E_avg, regain_ggx_q_ms, regain_ggx_mu_ms);
    compare(regain::beckmann_fits, regain_beckmann_E_ss, regain_beckmann_E_avg,
            regain_beckmann_q_ms, regain_beckmann_mu_ms);
}

TEST(ExportedFits, say_in_osl_what_the_closures_say)
{
    using namespace osl;
    compare(regain::ggx_fits, regain_ggx_E_ss, regain_ggx_E_avg, regain_ggx_q_ms, regain_ggx_mu_ms);
    compare(regain::beckmann_fits, regain_beckmann_E_ss, regain_beckmann_E_avg,
            regain_beckmann_q_ms, regain_beckmann_mu_ms);
}

// What C++ would let pass: numbers without a point are integers, f is no suffix of OSL.
TEST(ExportedFits, have_no_literal_that_is_not_a_float)
{
    for (const char* language : {"glsl", "osl"})
    {
        std::string code;
        std::istringstream text(regain::tools::exported_fits(language));
        for (std::string line; std::getline(text, line);)
        {
            EXPECT_LE(line.size(), 100u) << line;
            if (line.rfind("//", 0) != 0 && line.rfind("#", 0) != 0) code += line + "\n";
        }
        const std::regex word("[A-Za-z_]\\w*|[0-9][0-9.]*(e-[0-9]+)?\\w*"),
            number("[0-9]+\\.[0-9]+|[0-9]+e-[0-9]+");
        int numbers = 0;
        for (std::sregex_iterator i(code.begin(), code.end(), word), end; i != end; ++i)
        {
            if (!std::isdigit(static_cast<unsigned char>(i->str()[0]))) continue;
            EXPECT_TRUE(std::regex_match(i->str(), number)) << i->str();
            ++numbers;
        }
        EXPECT_GT(numbers, 60);
    }
}

TEST(ExportedFits, keep_the_order_of_operations)
{
    ShaderFunction body;
    const ShaderExpression a(body, "a"), b(body, "b"), two(2.0f), less(-0.5f);
    EXPECT_EQ((a - (b - a)).text(), "a - (b - a)");
    EXPECT_EQ((a - b - a).text(), "a - b - a");
    EXPECT_EQ((a * (b * a)).text(), "a * (b * a)");
    EXPECT_EQ((a * b * a).text(), "a * b * a");
    EXPECT_EQ(((a + two) * (b + less)).text(), "(a + 2.0) * (b - 0.5)");
    EXPECT_EQ((less + a * less).text(), "-0.5 + a * -0.5");
    EXPECT_EQ((a - less * b).text(), "a - -0.5 * b");
    const ShaderExpression quotient = a * b / (a + b), root = regain::detail::sqrt(b);
    EXPECT_EQ((quotient + root).text(), "t1 + t2");
    EXPECT_EQ(body.text("f", {"a", "b"}, "t1 + t2"),
              "float f(float a, float b)\n{\n    float t1 = a * b / (a + b);\n    float t2 = "
              "sqrt(b);\n    return t1 + t2;\n}\n");
    EXPECT_EQ(ShaderExpression(1e-30f).text(), "1e-30");
    EXPECT_EQ(ShaderExpression(3.0f).text(), "3.0");
}

}  // namespace
