// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// The tables against quadrature, against themselves re-baked, and against their files.

#include "../support/closures.h"
#include "../support/temporary_folder.h"

#include <regain/closures/beckmann.h>
#include <regain/closures/gtr.h>
#include <regain/closures/std.h>
#include <regain/luts/albedo_integral.h>
#include <regain/luts/bake.h>
#include <regain/luts/builtin.h>
#include <regain/luts/dielectric_integral.h>
#include <regain/luts/embed.h>
#include <regain/luts/exr.h>
#include <regain/luts/later_bounces.h>
#include <regain/luts/library.h>

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

using namespace regain;
using namespace regain::tests;
namespace fs = std::filesystem;

namespace {

fs::path shipped(const std::string& name) { return fs::path(REGAIN_TABLES) / (name + ".exr"); }

class Files : public testing::Test
{
protected:
    fs::path file(const std::string& name) const { return _folder / name; }

    std::string error_of(const fs::path& path)
    {
        try
        {
            luts::read_table(path);
        }
        catch (const std::runtime_error& e)
        {
            return e.what();
        }
        return "";
    }

    static std::string bytes_of(const fs::path& path)
    {
        std::ifstream in(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    // A file of these bytes, but for those that follow `after` where it is first.
    fs::path with_bytes(std::string all, const std::string& after, const std::string& bytes) const
    {
        const std::size_t at = all.find(after);
        EXPECT_NE(at, std::string::npos) << after;
        all.replace(at + after.size(), bytes.size(), bytes);
        std::ofstream(file("changed.exr"), std::ios::binary) << all;
        return file("changed.exr");
    }

private:
    const test::TemporaryFolder _folder;
};

// Known values: E_ss(alpha 1, mu 1) = 1 - ln 2 in closed form; E_avg of GGX at alpha 1 is 0.409
// (Turquin 2019, "E_avg about 0.4" below Eq. 7; 0.40914 by adaptive quadrature over directions).
TEST(AlbedoIntegral, matches_known_values)
{
    EXPECT_NEAR(luts::ggx_albedo(1, 1), 1 - std::log(2.0), 1e-12);
    EXPECT_NEAR(luts::ggx_average_albedo(1), 0.40914, 1e-5);
    // Average albedos by the same adaptive quadrature.
    const double alpha[] = {0.01, 0.1, 0.25, 0.5, 0.75},
                 average[] = {.99949, .97205, .88232, .70024, .53630};
    for (int i = 0; i < 5; ++i) EXPECT_NEAR(luts::ggx_average_albedo(alpha[i]), average[i], 1e-5);
    const double mu[] = {.01, .05, .1, .2, .35, .5, .7, .9},
                 E[] = {.9538, .8478, .7602, .6416, .5275, .4507, .3789, .3275};
    for (int i = 0; i < 8; ++i) EXPECT_NEAR(luts::ggx_albedo(mu[i], 1), E[i], 1e-4);
}

TEST(AlbedoIntegral, has_converged)
{
    for (double alpha : {1e-3, 0.01, 0.1, 1.0})
        for (double mu : {1e-4, 1e-3, 0.01, 0.1, 0.7, 1.0})
            EXPECT_NEAR(luts::ggx_albedo(mu, alpha, {}, {48}),
                        luts::ggx_albedo(mu, alpha, {}, {110}), 2e-9);
}

// Sampling of visible normals is another way to the same number.
TEST(AlbedoIntegral, agrees_with_sampling)
{
    constexpr int n = 500;
    for (double alpha : {0.2, 1.0})
        for (double mu : {0.1, 0.8})
        {
            const auto prepared =
                white<double>(alpha, alpha, NormalSampling::full).prepare(direction<double>(mu));
            double mean = 0;
            for (int j = 0; j < n; ++j)
                for (int i = 0; i < n; ++i)
                    mean += prepared.sample({(i + 0.5) / n, (j + 0.5) / n}).weight.x / (n * n);
            EXPECT_NEAR(mean, luts::ggx_albedo(mu, alpha), 2e-5);
        }
}

TEST(Tables, look_ups_err_by_less_than_a_thousandth)
{
    const TableView E_ss = luts::builtin_table("ggx_E_ss");
    Random random(4);
    double worst = 0;
    for (int i = 0; i < 20000; ++i)
    {
        const double mu = std::pow(10, -3 * random.unit()),
                     alpha = std::pow(10, -3 * random.unit());
        const double exact = luts::ggx_albedo(mu, alpha, {}, {24});
        const double found = std::min(1.0, E_ss.at(stretched_cosine(mu, alpha), std::sqrt(alpha)));
        worst = std::max(worst, std::abs(found / exact - 1));
    }
    EXPECT_LT(worst, 7e-4);
    EXPECT_NEAR(luts::builtin_table("ggx_E_avg").at(1.0), 0.409, 5e-4);
}

// Below the range that scenes use, down to the delta bound, the tables stay good.
TEST(Tables, look_ups_reach_to_the_delta_bound)
{
    const TableView E_ss = luts::builtin_table("ggx_E_ss");
    for (double alpha : {1e-5, 1e-4, 4e-4})
        for (double mu : {1e-6, 1e-5, 1e-4, 1e-3, 0.1, 1.0})
        {
            const double found =
                std::min(1.0, E_ss.at(stretched_cosine(mu, alpha), std::sqrt(alpha)));
            EXPECT_NEAR(found / luts::ggx_albedo(mu, alpha), 1, 1e-3) << mu << " " << alpha;
        }
}

// E_ss through the closures' own look-up, against quadrature, at mu and alpha log-uniform in
// [1e-3, 1]. `make` gives a distribution of that alpha.
template <class Make>
double worst_look_up(const std::string& name, int points, int nodes, const Make& make)
{
    const MicrofacetTables tables = luts::microfacet_tables(name);
    Random random(5);
    double worst = 0;
    for (int i = 0; i < points; ++i)
    {
        const double mu = std::pow(10, -3 * random.unit()),
                     alpha = std::pow(10, -3 * random.unit());
        const auto distribution = make(alpha, random);
        double gamma = 0;
        if constexpr (decltype(distribution)::has_tail) gamma = distribution.gamma();
        const double exact =
            luts::albedo(luts::SlopeLaw::named(name, alpha, gamma), mu, {}, {nodes});
        const double found = tables.albedo(TableAxes<double>(distribution), mu);
        worst = std::max(worst, std::abs(found / exact - 1));
    }
    return worst;
}

TEST(Tables, look_ups_of_every_distribution_are_as_good_as_documented)
{
    EXPECT_LT(worst_look_up("beckmann", 2000, 20,
                            [](double alpha, Random&) { return Beckmann<double>(alpha); }),
              1e-3);
    EXPECT_LT(worst_look_up("gtr", 400, 20,
                            [](double alpha, Random& random) {
                                return GTR<double>(alpha, gtr_gamma(random.unit()));
                            }),
              4e-3);
    EXPECT_LT(worst_look_up("std", 400, 20,
                            [](double alpha, Random& random) {
                                return STD<double>(alpha, std_gamma(random.unit()));
                            }),
              4e-3);
}

// Next to its end node the albedo of STD runs steeply towards 1.
TEST(Tables, std_is_looked_up_at_the_least_cosine_too)
{
    const MicrofacetTables tables = luts::microfacet_tables("std");
    for (double gamma : {1.51, 1.55, 1.7})
        for (double alpha : {0.3, 0.7, 1.0})
        {
            const double exact =
                luts::albedo(luts::SlopeLaw::named("std", alpha, gamma), 1e-3, {}, {32});
            const double found = tables.albedo(TableAxes<double>(STD<double>(alpha, gamma)), 1e-3);
            EXPECT_NEAR(found / exact, 1, 6e-3) << gamma << " " << alpha;
        }
}

// Dividing by the look-up is what makes glass preserve energy.
TEST(Tables, look_ups_of_dielectrics_are_as_good_as_documented)
{
    const DielectricTables tables =
        luts::dielectric_tables("ggx", TransmissionShadowing::correlated);
    Random random(6);
    double worst = 0;
    const auto check = [&](double alpha, double eta, double mu) {
        const luts::DielectricAlbedo a =
            luts::dielectric_albedo(luts::SlopeLaw::ggx(alpha), mu, eta, 18);
        const double sum = a.reflected + a.transmitted_correlated;
        worst = std::max(worst, std::abs(sum / tables.albedo(alpha, eta, mu) - 1));
        EXPECT_NEAR(tables.reflected_share(alpha, eta, mu), a.reflected / sum, 0.05)
            << alpha << " " << eta << " " << mu;
    };
    for (double eta : {1.0001, 1.001, 1.05, 1.33, 1.5, 2.4, 4.0})
        for (double alpha : {1e-3, 0.05, 0.1, 0.25, 0.5, 0.75, 1.0})
            for (double mu : {0.02, 0.05, 0.1, 0.3, 0.6, 1.0})
            {
                check(alpha, eta, mu);
                check(alpha, 1 / eta, mu);
            }
    EXPECT_LT(worst, 2e-3);

    // The grid meets some cells near their nodes.
    worst = 0;
    for (int i = 0; i < 1500; ++i)
    {
        const double near_1 = 1 + std::pow(10, -4 + 4.47 * random.unit()),
                     even = std::pow(4, random.unit()), eta = i % 2 ? near_1 : even;
        check(std::pow(10, -3 * random.unit()), i % 3 ? 1 / eta : eta,
              std::pow(0.02, random.unit()));
    }
    EXPECT_LT(worst, 4e-3);
}

// Where a look-up reads is where baking wrote, on every axis, also of tables that nobody ships:
// ramps in place of numbers tell the coordinates of a look-up, and what baking takes there has to
// be E^S.
TEST(Tables, baking_and_look_ups_of_dielectrics_agree_about_axes)
{
    const auto coordinate = [&](DielectricTables tables, int axis, double alpha, double eta,
                                double mu) {
        std::uint16_t ramp[8];
        for (int i = 0; i < 8; ++i) ramp[i] = i >> axis & 1 ? 65535 : 0;
        tables.logarithmic = false;
        for (int side = 0; side < 2; ++side) tables.E[side] = {ramp, 2, 2, 2};
        return tables.albedo(alpha, eta, mu);
    };
    for (const std::string distribution : {"ggx", "gtr"})
        for (const bool beta : {false, true})
            for (const bool inside : {false, true})
                for (double alpha : {0.01, 0.3, 0.9})
                    for (double index : {1.001, 1.3, 3.0})
                        for (double mu : {0.03, 0.4, 0.95})
                        {
                            DielectricTables tables;
                            tables.tail = distribution == "gtr";
                            tables.near_index = beta;
                            const double gamma = tables.tail ? 1.3 : 0,
                                         eta = inside ? 1 / index : index;
                            const std::string name = distribution + (tables.tail ? "_1.3" : "") +
                                                     "_E_S_" + (beta ? "beta" : "correlated") +
                                                     (inside ? "_inside" : "_outside");
                            const double found =
                                luts::exact_value(name,
                                                  {coordinate(tables, 0, alpha, eta, mu),
                                                   coordinate(tables, 1, alpha, eta, mu),
                                                   coordinate(tables, 2, alpha, eta, mu)},
                                                  18);
                            const luts::DielectricAlbedo a = luts::dielectric_albedo(
                                luts::SlopeLaw::named(distribution, alpha, gamma), mu, eta, 18);
                            const double expected = a.reflected + (beta ? a.transmitted_beta
                                                                        : a.transmitted_correlated);
                            EXPECT_NEAR(beta ? std::exp(found) : found, expected, 2e-5)
                                << name << " " << alpha << " " << eta << " " << mu;
                        }
}

// The same of R_later, which has to be what walks from there do; the same walks, but for rounding.
TEST(Tables, baking_and_look_ups_of_later_bounces_agree_about_axes)
{
    for (const std::string distribution : {"ggx", "gtr"})
        for (const bool inside : {false, true})
            for (double alpha : {0.1, 0.4, 0.9})
                for (double index : {1.1, 1.6, 3.0})
                    for (double mu : {0.1, 0.4, 0.95})
                    {
                        DielectricTables tables;
                        tables.tail = distribution == "gtr";
                        const double gamma = tables.tail ? 1.3 : 0,
                                     eta = inside ? 1 / index : index;
                        const auto coordinate = [&](int axis) {
                            std::uint16_t ramp[8];
                            for (int i = 0; i < 8; ++i) ramp[i] = i >> axis & 1 ? 65535 : 0;
                            for (TableView& view : tables.later) view = {ramp, 2, 2, 2};
                            return tables.later_reflected_share(alpha, eta, mu);
                        };
                        const std::string name = distribution + (tables.tail ? "_1.3" : "") +
                                                 "_R_later_" + (inside ? "inside" : "outside");
                        const double found = luts::exact_value(
                            name, {coordinate(0), coordinate(1), coordinate(2)}, 1);
                        EXPECT_NEAR(
                            found,
                            luts::later_reflected_share(distribution, alpha, gamma, eta, mu, 1024),
                            0.02)
                            << name << " " << alpha << " " << index << " " << mu;
                    }
}

// A stale table fails: spots of each file are integrated again. Where nodes are not levelled they
// have to be the exact numbers, within the step they are stored in; look-ups between the nodes have
// to be as good as the file says.
TEST(Tables, files_match_their_definition)
{
    for (const std::string& name : luts::shipped_tables())
    {
        const luts::Table table = luts::read_table(shipped(name));
        EXPECT_EQ(table.name(), name);
        const bool solid = table.depth() > 1, relative = table.info().error_kind == "relative";
        const bool grid = !table.info().axis_4.empty();
        // One number takes the balance of a whole lobe.
        const bool balanced = table.info().quantity == "balance_anisotropy";
        // Of walks an integral is an estimate, and the same only by the same walks.
        const bool walked = table.info().method.find("walks") != std::string::npos;
        const bool of_shape = walked && table.info().axis_x != "sqrt(mu)";
        Random random(8);
        double worst = 0;
        for (int i = 0; i < (of_shape             ? 2
                             : walked             ? 12
                             : balanced           ? 4
                             : solid              ? 25
                             : name == "ggx_E_ss" ? 200
                                                  : 60);)
        {
            luts::TablePoint at{random.unit(), random.unit(), solid ? random.unit() : 0,
                                grid ? random.unit() : 0, grid ? random.unit() : 0};
            if (!luts::is_error_promised(name, at)) continue;
            ++i;
            double exact = luts::exact_value(name, at,
                                             of_shape   ? table.info().nodes
                                             : balanced ? 16
                                             : grid     ? 12
                                             : solid    ? 24
                                                        : 32);
            double found = luts::interpolated(table, at);
            if (luts::is_logarithmic(name)) exact = std::exp(exact), found = std::exp(found);
            if (relative && exact < luts::smallest_promised(name)) continue;
            worst = std::max(
                worst, std::abs(relative ? std::min(found, luts::greatest_answer(name)) / exact - 1
                                         : found - exact));
        }
        EXPECT_LT(worst, table.info().error * (solid ? 1.5 : 1.05) + 3e-5) << name;

        if (relative) continue;
        for (int i = 0; i < (of_shape ? 1 : walked ? 4 : 12); ++i)
        {
            const auto node = [&](int length) { return static_cast<int>(random.unit() * length); };
            const int x = node(table.width()), y = node(table.height()), z = node(table.depth());
            const auto along = [](int k, int length) { return k / std::max(1.0, length - 1.0); };
            const luts::TablePoint at{along(x, table.width()), along(y, table.height()),
                                      along(z, table.depth())};
            const float stored = table.values()[static_cast<std::size_t>(
                (z * table.height() + y) * table.width() + x)];
            const double exact = luts::exact_value(name, at, walked ? table.info().nodes : 48);
            EXPECT_NEAR(stored, exact, 2e-6 + luts::storage_step(table, exact) / 2)
                << name << " node " << x << " " << y << " " << z;
        }
    }
}

TEST(Tables, baking_again_gives_the_file)
{
    for (const std::string& name : luts::compiled_in_tables())
    {
        const luts::Table now = luts::bake(name), file = luts::read_table(shipped(name));
        ASSERT_EQ(now.values().size(), file.values().size());
        for (std::size_t i = 0; i < now.values().size(); ++i)
            ASSERT_NEAR(now.values()[i], file.values()[i], 1e-6) << name << " node " << i;
        EXPECT_NEAR(now.info().error, file.info().error, 1e-6);
    }
}

TEST(Tables, compiled_in_copies_are_the_files)
{
    for (const std::string& name : luts::compiled_in_tables())
    {
        const luts::Table file = luts::read_table(shipped(name));
        const TableView builtin = luts::builtin_table(name);
        ASSERT_TRUE(builtin);
        EXPECT_EQ(builtin.width, file.width());
        EXPECT_EQ(builtin.height, file.height());
        EXPECT_EQ(builtin.scale, file.view().scale);
        EXPECT_EQ(builtin.offset, file.view().offset);
        EXPECT_TRUE(std::equal(file.stored().begin(), file.stored().end(), builtin.data)) << name;
    }
    EXPECT_FALSE(luts::builtin_table("ggx_E"));
}

TEST_F(Files, round_trip)
{
    const luts::Table table = luts::read_table(shipped("ggx_E_avg"));
    luts::write_table(file("copy.exr"), table);
    const luts::Table copy = luts::read_table(file("copy.exr"));
    EXPECT_EQ(copy.values(), table.values());
    EXPECT_EQ(luts::embedded(copy), luts::embedded(table));
    EXPECT_EQ(std::distance(fs::directory_iterator(file("copy.exr").parent_path()), {}), 1)
        << "a temporary file was left";
}

TEST_F(Files, broken_files_say_what_is_wrong)
{
    EXPECT_NE(error_of(file("none.exr")).find("none.exr"), std::string::npos);

    std::ofstream(file("text.exr")) << "not an image";
    EXPECT_NE(error_of(file("text.exr")).find("text.exr"), std::string::npos);

    fs::copy(shipped("ggx_E_ss"), file("short.exr"));
    fs::resize_file(file("short.exr"), 2000);
    EXPECT_NE(error_of(file("short.exr")).find("short.exr"), std::string::npos);

    const luts::Table good = luts::read_table(shipped("ggx_E_avg"));
    luts::TableInfo stale = good.info();
    stale.definition = luts::table_definition + 1;
    luts::write_table(file("stale.exr"),
                      luts::Table(stale, good.width(), good.height(), 1, good.values()));
    EXPECT_NE(error_of(file("stale.exr")).find("bake it again"), std::string::npos);
}

// Every number of a header that reading goes by, set to what no table has: the file is refused, and
// before memory is taken for what it says.
TEST_F(Files, headers_that_no_table_has_are_refused)
{
    const std::string good = bytes_of(shipped("ggx_E_avg"));
    const auto refused_for = [&](const std::string& after, const std::string& bytes) {
        return error_of(with_bytes(good, after, bytes));
    };
    const auto little_endian = [](std::int32_t n) {
        std::string bytes;
        for (int i = 0; i < 4; ++i, n >>= 8) bytes.push_back(static_cast<char>(n & 255));
        return bytes;
    };
    const auto attribute = [](const std::string& name, const std::string& type) {
        return name + '\0' + type + '\0';
    };
    const auto contains = [](const std::string& text, const std::string& part) {
        return text.find(part) != std::string::npos;
    };
    ASSERT_EQ(error_of(with_bytes(good, "", "")), "");

    for (const std::int32_t size : {2000000000, 1000000, -1})
        EXPECT_TRUE(contains(
            refused_for(attribute("regain:quantity", "string"), little_endian(size)), "file holds"))
            << size;
    EXPECT_TRUE(
        contains(refused_for(attribute("regain:depth", "int"), little_endian(3)), "file holds"));
    EXPECT_TRUE(
        contains(refused_for(attribute("channels", "chlist"), little_endian(35)), "file holds"));
    const std::string window = attribute("dataWindow", "box2i") + little_endian(16);
    const std::string zero = little_endian(0);
    for (const auto& [right, bottom] : {std::pair{0, 0}, {5000, 0}, {31, 2000000000}, {31, -1}})
        EXPECT_TRUE(contains(
            refused_for(window, zero + zero + little_endian(right) + little_endian(bottom)),
            "a side are accepted"))
            << right << " " << bottom;
    EXPECT_TRUE(
        contains(refused_for("regain:side" + std::string(1, 0), "stringz"), "no table has"));
    // The version follows the four bytes that all EXR files begin with.
    EXPECT_TRUE(contains(refused_for(good.substr(0, 4), little_endian(0x1002)), "several parts"));

    const std::string depth = attribute("regain:depth", "int") + little_endian(4);
    for (const std::int32_t slices : {0, -1, 3})
        EXPECT_TRUE(contains(refused_for(depth, little_endian(slices)), "slices")) << slices;
    const std::string scale = attribute("regain:scale", "double") + little_endian(8);
    // The last two are numbers, but not as floats, which look-ups take.
    for (const double number : {0.0, -1.0, HUGE_VAL, std::nan(""), 1e300, 1e-300})
    {
        std::string bytes(8, '\0');
        std::memcpy(bytes.data(), &number, 8);
        EXPECT_TRUE(contains(refused_for(scale, bytes), "no usable numbers")) << number;
    }
    EXPECT_TRUE(contains(refused_for("regain:node", "z"), "has no 'regain:nodes'"));
    const std::string channels = attribute("channels", "chlist") + little_endian(19);
    EXPECT_TRUE(contains(refused_for(channels, "Z"), "channel 'Y'"));
    // 0: a channel of integers.
    EXPECT_TRUE(contains(refused_for(channels + "Y" + '\0', little_endian(0)), "channel 'Y'"));
}

TEST_F(Files, unwritable_targets_are_errors_and_leave_nothing)
{
    const luts::Table table = luts::read_table(shipped("ggx_E_avg"));
    std::ofstream(file("plain")) << "x";
    EXPECT_THROW(luts::write_table(file("plain") / "t.exr", table), std::runtime_error);
    EXPECT_THROW(luts::write_table(file("missing") / "t.exr", table), std::runtime_error);
    EXPECT_EQ(std::distance(fs::directory_iterator(file("plain").parent_path()), {}), 1);
}

TEST(Tables, values_out_of_range_are_refused)
{
    luts::TableInfo info;
    info.scale = 1.0 / 65535;
    EXPECT_THROW(luts::Table(info, 2, 1, 1, {0.5f, 1.5f}), std::invalid_argument);
    EXPECT_THROW(luts::Table(info, 2, 1, 1, {0.5f, -0.5f}), std::invalid_argument);
    EXPECT_THROW(luts::Table(info, 2, 2, 1, {0.5f, 0.5f}), std::invalid_argument);
    EXPECT_THROW(luts::Table(info, 1, 2, 1, {0.5f, 0.5f}), std::invalid_argument);
    EXPECT_THROW(luts::Table(info, 2, 0, 1, {}), std::invalid_argument);
    EXPECT_THROW(luts::Table(info, 2, 1, 0, {}), std::invalid_argument);
    EXPECT_THROW(luts::bake("ggx_E"), std::invalid_argument);
}

TEST(Tables, baking_can_be_stopped)
{
    EXPECT_THROW(luts::bake("gtr_E_ss", [](double done) { return done < 0.001; }),
                 luts::BakeStopped);
    EXPECT_THROW(luts::bake("ggx_E_ss", [](double done) { return done < 0.1; }), luts::BakeStopped);
    EXPECT_THROW(luts::bake("gtr_1.3_E_S_beta_inside", [](double) { return false; }),
                 luts::BakeStopped);
}

}  // namespace
