// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// How far approximations of the average Fresnel reflectance are off. docs/fresnel-averages.md
// states it, and is held to what is measured here.

#include "../support/closures.h"

#include <regain/closures/artist_fresnel.h>
#include <regain/luts/quadrature.h>

#include <gtest/gtest.h>

#include <complex>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>

using namespace regain;
using namespace regain::tests;

namespace {

// Fresnel's equations with a complex index.
double textbook(double n, double k, double mu)
{
    using C = std::complex<double>;
    const C eta(n, k);
    const C cos_t = std::sqrt(1.0 - (1 - mu * mu) / (eta * eta));
    const C s = (mu - eta * cos_t) / (mu + eta * cos_t),
            p = (eta * mu - cos_t) / (eta * mu + cos_t);
    return 0.5 * (std::norm(s) + std::norm(p));
}

// 2 int F mu dmu by 40 nodes in each of four pieces, gathered at 0, 1 and `kink`.
double integral(const std::function<double(double)>& F, double kink)
{
    static const luts::QuadratureRule rule = luts::gauss_legendre(40);
    if (kink <= 0 || kink >= 1) kink = 0.1;
    double sum = 0;
    for (int piece = 0; piece < 4; ++piece)
    {
        const double low = piece < 2 ? 0 : kink, high = piece < 2 ? kink : 1;
        for (std::size_t i = 0; i < rule.x.size(); ++i)
        {
            const double x = rule.x[i], y = 0.5 * (high - low) * x * x * x * x;
            const double mu = piece % 2 == 0 ? low + y : high - y;
            sum += 2 * mu * F(mu) * rule.weight[i] * 2 * (high - low) * x * x * x;
        }
    }
    return sum;
}
double exact_conductor(double n, double k)
{
    return integral([&](double mu) { return textbook(n, k, mu); },
                    std::sqrt(std::max(0.0, 1 - n * n)));
}

ConductorFresnel<double> conductor(double n, double k)
{
    return {Color3<double>(n), Color3<double>(k)};
}
ArtistFresnel<double> artist(double r, double g) { return {Color3<double>(r), Color3<double>(g)}; }

struct Error
{
    double largest = 0, sum = 0;
    int count = 0;
    void add(double error)
    {
        largest = std::max(largest, std::abs(error));
        sum += std::abs(error);
        ++count;
    }
    double mean() const { return sum / count; }
};

using Errors = std::map<std::string, Error>;

constexpr int steps = 40;

void measure_schlick(Errors& errors)
{
    for (int i = 0; i <= steps; ++i)
        for (double exponent : {2.0, 3.5, 5.0, 9.0})
        {
            const SchlickFresnel<double> F(Color3<double>(double(i) / steps), Color3<double>(1.0),
                                           Color3<double>(1.0), exponent);
            errors["Schlick, closed form"].add(F.average().x -
                                               integral([&](double mu) { return F.at(mu).x; }, 0));
        }
    for (int i = 16; i <= steps; ++i)
        for (int j = 0; j <= steps; ++j)
        {
            const Color3<double> F0(double(i) / steps), F82(0.5 + 0.5 * j / steps);
            const SchlickFresnel<double> F(F0, F82);
            errors["F82, closed form"].add(F.average().x -
                                           integral([&](double mu) { return F.at(mu).x; }, 0));
        }
}

void measure_artist(Errors& errors)
{
    for (int i = 0; i <= steps; ++i)
        for (int j = 0; j <= steps; ++j)
        {
            const double r = 0.99 * i / steps, g = double(j) / steps;
            const auto F = artist(r, g);
            const double exact = exact_conductor(F.conductor().n().x, F.conductor().k().x);
            errors["Kulla-Conty, artist"].add(kulla_conty_conductor_average(r, g) - exact);
            if (r >= 0.1 && g <= 0.95)
                errors["Kulla-Conty, artist, usual metals"].add(
                    kulla_conty_conductor_average(r, g) - exact);
            errors["F82 through 0 and 82 degrees, artist"].add(f82_average(F).x - exact);
            errors["Gauss-Legendre 4, artist"].add(gauss_legendre_average(F).x - exact);
            errors["Gauss-Jacobi 3, artist"].add(gauss_jacobi_average<3>(F).x - exact);
            errors["Gauss-Jacobi 5, artist"].add(F.average().x - exact);
            errors["exact_average, artist"].add(F.exact_average().x - exact);
        }
}

void measure_conductor(Errors& errors)
{
    for (int i = 0; i <= steps; ++i)
        for (int j = 0; j <= steps; ++j)
        {
            const double n = 0.04 * std::pow(5 / 0.04, double(i) / steps);
            const double k = 0.5 * std::pow(10 / 0.5, double(j) / steps);
            const auto F = conductor(n, k);
            const double exact = exact_conductor(n, k);
            errors["F82 through 0 and 82 degrees, conductor"].add(f82_average(F).x - exact);
            errors["Gauss-Legendre 4, conductor"].add(gauss_legendre_average(F).x - exact);
            errors["Gauss-Jacobi 3, conductor"].add(gauss_jacobi_average<3>(F).x - exact);
            errors["Gauss-Jacobi 5, conductor"].add(F.average().x - exact);
            errors["exact_average, conductor"].add(F.exact_average().x - exact);
        }
}

void measure_dielectric(Errors& errors)
{
    for (int i = 1; i <= 400; ++i)
        for (bool inside : {false, true})
        {
            const double above = 1 + 2.0 * i / 400, eta = inside ? 1 / above : above;
            const double exact = exact_conductor(eta, 0);
            const std::string side = inside ? ", eta < 1" : ", eta > 1";
            errors["Kulla-Conty" + side].add(kulla_conty_dielectric_average(eta) - exact);
            errors["d'Eon" + side].add(deon_dielectric_average(eta) - exact);
            errors["Gauss-Jacobi 5" + side].add(gauss_jacobi_average<5>(conductor(eta, 0)).x -
                                                exact);
            errors["exact_average" + side].add(conductor(eta, 0).exact_average().x - exact);
        }
}

Errors measured()
{
    Errors errors;
    measure_schlick(errors);
    measure_artist(errors);
    measure_conductor(errors);
    measure_dielectric(errors);
    return errors;
}

struct Row
{
    std::string name, largest, mean;
};

// Lines | name | domain | largest | mean |.
std::vector<Row> documented()
{
    std::ifstream file(REGAIN_DOCS "/fresnel-averages.md");
    std::vector<Row> rows;
    std::string line;
    const auto trimmed = [](const std::string& s) {
        const auto a = s.find_first_not_of(' '), b = s.find_last_not_of(' ');
        return a == std::string::npos ? std::string() : s.substr(a, b - a + 1);
    };
    while (std::getline(file, line))
    {
        if (line.rfind("|", 0) != 0) continue;
        std::vector<std::string> cells;
        std::stringstream stream(line.substr(1));
        std::string cell;
        while (std::getline(stream, cell, '|')) cells.push_back(trimmed(cell));
        if (cells.size() != 4 || cells[0] == "fit" || cells[0].find("--") == 0) continue;
        rows.push_back({cells[0], cells[2], cells[3]});
    }
    return rows;
}

// "0.024", "1.8e-3" to the digits written; "rounding" for below 1e-9.
void expect_documented(double value, const std::string& text, const std::string& what)
{
    if (text == "rounding")
    {
        EXPECT_LT(value, 1e-9) << what;
        return;
    }
    const double said = std::stod(text);
    EXPECT_NEAR(value / said, 1, 0.06) << what << ": documented " << text << ", measured " << value;
}

TEST(FresnelAverage, errors_are_as_documented)
{
    Errors errors = measured();
    for (const Row& row : documented())
    {
        ASSERT_TRUE(errors.count(row.name)) << "docs/fresnel-averages.md: \"" << row.name << "\"";
        expect_documented(errors[row.name].largest, row.largest, row.name + ", largest");
        expect_documented(errors[row.name].mean(), row.mean, row.name + ", mean");
        errors.erase(row.name);
    }
    for (const auto& [name, error] : errors)
        ADD_FAILURE() << "docs/fresnel-averages.md lacks: | " << name << " | | " << error.largest
                      << " | " << error.mean() << " |";
}

// OpenPBR's relation between the sides, which d'Eon's fit below 1 rests on.
TEST(FresnelAverage, sides_of_a_dielectric_are_related)
{
    for (double eta : {1.1, 1.5, 2.4})
        EXPECT_NEAR(1 - exact_conductor(1 / eta, 0), (1 - exact_conductor(eta, 0)) / (eta * eta),
                    1e-9);
}

TEST(FresnelAverage, exact_average_is_exact_for_hard_curves)
{
    for (double n : {0.01, 0.3, 0.95, 1.0, 3.0, 40.0})
        for (double k : {0.0, 0.01, 0.1, 1.0, 100.0})
            EXPECT_NEAR(conductor(n, k).exact_average().x, exact_conductor(n, k), 2e-6)
                << n << " " << k;
}

}  // namespace
