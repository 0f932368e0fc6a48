// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Tables come from files when they are first asked for, once, and what is wrong with a file is
// said.

#include "../support/temporary_folder.h"

#include <regain/luts/bake.h>
#include <regain/luts/builtin.h>
#include <regain/luts/exr.h>
#include <regain/luts/library.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <thread>

using namespace regain;
namespace fs = std::filesystem;

namespace {

class Library : public testing::Test
{
protected:
    Library() { luts::set_table_folders({_folder.path()}); }
    ~Library() override { luts::set_table_folders({}); }

    fs::path file(const std::string& name) const { return _folder / (name + ".exr"); }

    static std::string error_of(const std::string& table)
    {
        try
        {
            luts::table_named(table);
        }
        catch (const std::runtime_error& e)
        {
            return e.what();
        }
        return "";
    }
    static auto times_loaded(const std::string& name)
    {
        const std::vector<fs::path> loaded = luts::loaded_files();
        return std::count_if(loaded.begin(), loaded.end(),
                             [&](const fs::path& f) { return f.filename() == name + ".exr"; });
    }
    static bool contains(const std::string& text, const std::string& part)
    {
        return text.find(part) != std::string::npos;
    }
    // Any table, under the name of one that is not shipped.
    // A small table that says to be the one of that name.
    static luts::TableInfo info_of(const std::string& name)
    {
        luts::TableInfo info = luts::bakeable_info(name);
        info.offset = 0;
        info.scale = 1.0 / 65535;
        return info;
    }
    static luts::Table small(const luts::TableInfo& info)
    {
        return luts::Table(info, 2, 2, 2, std::vector<float>(8, 0.5f));
    }
    static luts::Table as(const std::string& quantity, int definition = luts::table_definition)
    {
        luts::TableInfo info = info_of("gtr_1.25_" + quantity + "_beta_inside");
        info.definition = definition;
        return small(info);
    }

private:
    const test::TemporaryFolder _folder;
};

TEST_F(Library, ggx_mirrors_open_no_file)
{
    const std::size_t before = luts::loaded_files().size();
    EXPECT_TRUE(luts::microfacet_tables("ggx").E_ss);
    EXPECT_EQ(luts::microfacet_tables("ggx").E_ss.data, luts::ggx_tables().E_ss.data);
    EXPECT_EQ(luts::loaded_files().size(), before);
}

TEST_F(Library, every_shipped_table_is_found_and_is_what_its_name_says)
{
    for (const char* distribution : {"ggx", "beckmann", "gtr", "std"})
    {
        const MicrofacetTables tables = luts::microfacet_tables(distribution);
        EXPECT_TRUE(tables.E_ss && tables.E_avg && tables.falloff && tables.dip);
        EXPECT_EQ(tables.logarithmic, distribution == std::string("std"));
    }
    for (const char* distribution : {"ggx", "beckmann"})
    {
        EXPECT_TRUE(luts::dielectric_tables(distribution, TransmissionShadowing::correlated));
        const DielectricTables beta =
            luts::dielectric_tables(distribution, TransmissionShadowing::beta);
        EXPECT_TRUE(beta);
        EXPECT_TRUE(beta.logarithmic);
        EXPECT_FALSE(beta.later[0]);
    }
    for (const std::string& name : luts::shipped_tables()) EXPECT_TRUE(luts::table_named(name));
}

TEST_F(Library, what_anisotropic_glass_takes_is_loaded_for_it_alone)
{
    for (const char* distribution : {"ggx", "beckmann"})
    {
        DielectricTables tables =
            luts::dielectric_tables(distribution, TransmissionShadowing::correlated);
        EXPECT_FALSE(tables.anisotropy);
        luts::add_anisotropy(tables, distribution, TransmissionShadowing::correlated);
        ASSERT_TRUE(tables.anisotropy);
        EXPECT_TRUE(tables.anisotropy->change[0] && tables.anisotropy->change[1]);
        DielectricTables again;
        luts::add_anisotropy(again, distribution, TransmissionShadowing::correlated);
        EXPECT_EQ(again.anisotropy, tables.anisotropy);
    }
    DielectricTables none;
    luts::add_anisotropy(none, "gtr", TransmissionShadowing::beta);
    EXPECT_FALSE(none.anisotropy);
}

TEST_F(Library, a_table_is_loaded_once_whoever_asks)
{
    std::vector<std::thread> threads;
    for (int i = 0; i < 8; ++i)
        threads.emplace_back([] { EXPECT_TRUE(luts::microfacet_tables("std").E_ss); });
    for (std::thread& t : threads) t.join();
    EXPECT_EQ(luts::microfacet_tables("std").E_ss.data, luts::microfacet_tables("std").E_ss.data);
    EXPECT_EQ(times_loaded("std_E_ss"), 1);
}

TEST_F(Library, what_only_lobes_of_two_widths_read_is_loaded_for_them)
{
    const auto loads = [] { return times_loaded("beckmann_balance_anisotropy"); };
    const auto before = loads();
    MicrofacetTables tables = luts::microfacet_tables("beckmann");
    luts::add_balance(tables, "beckmann");
    EXPECT_EQ(loads(), before);
    EXPECT_FALSE(tables.balance_anisotropy);
    luts::add_balance_anisotropy(tables, "beckmann");
    EXPECT_EQ(loads(), 1);
    EXPECT_TRUE(*tables.balance_anisotropy);
    EXPECT_EQ(tables.balance_anisotropy->size[4], 1);
    luts::add_balance_anisotropy(tables, "std");
    EXPECT_GT(tables.balance_anisotropy->size[4], 1);
}

TEST_F(Library, a_missing_table_says_where_it_was_looked_for_and_what_bakes_it)
{
    const std::string error = error_of("gtr_1.25_E_S_beta_outside");
    EXPECT_TRUE(contains(error, "gtr_1.25_E_S_beta_outside.exr")) << error;
    EXPECT_TRUE(contains(error, luts::table_folders().front().string())) << error;
    EXPECT_TRUE(contains(error, "regain bake gtr_1.25_E_S_beta_outside -o FOLDER")) << error;
    EXPECT_EQ(times_loaded("gtr_1.25_E_S_beta_outside"), 0);
}

TEST_F(Library, a_table_baked_for_one_gamma_is_found)
{
    for (const std::string& name : luts::dielectric_table_names("gtr", 1.75))
        luts::write_table(file(name), small(info_of(name)));
    EXPECT_TRUE(luts::dielectric_tables("gtr", TransmissionShadowing::correlated, 1.75));
    EXPECT_THROW(luts::dielectric_tables("gtr", TransmissionShadowing::correlated, 1.76),
                 std::runtime_error);

    DielectricTables tables;
    EXPECT_THROW(luts::add_later_split(tables, "gtr", 1.75), std::runtime_error);
    EXPECT_EQ(luts::later_split_table_names("gtr", 1.75).front(), "gtr_1.75_R_later_outside");
    for (const std::string& name : luts::later_split_table_names("gtr", 1.75))
        luts::write_table(file(name), small(info_of(name)));
    luts::add_later_split(tables, "gtr", 1.75);
    EXPECT_TRUE(tables.later[0] && tables.later[1]);
    EXPECT_NEAR(tables.later_reflected_share(0.3, 1.5, 0.4), 0.5, 1e-5);
}

TEST_F(Library, stale_cut_and_mistaken_files_are_refused_by_name)
{
    const std::string name = "gtr_1.25_E_S_beta_inside";
    luts::write_table(file(name), as("E_S", luts::table_definition + 1));
    const std::string stale = error_of(name);
    EXPECT_TRUE(contains(stale, file(name).string())) << stale;
    EXPECT_TRUE(contains(stale, "bake it again")) << stale;
    EXPECT_TRUE(contains(stale, "regain bake " + name)) << stale;

    luts::write_table(file(name), as("R_share"));
    EXPECT_TRUE(contains(error_of(name), "it holds 'gtr_1.25_R_share_beta_inside'"));

    luts::write_table(file(name), as("E_S"));
    fs::resize_file(file(name), fs::file_size(file(name)) / 2);
    EXPECT_TRUE(contains(error_of(name), file(name).string()));

    for (std::string luts::TableInfo::*field :
         {&luts::TableInfo::axis_x, &luts::TableInfo::axis_y, &luts::TableInfo::axis_z,
          &luts::TableInfo::transform})
    {
        luts::TableInfo other = as("E_S").info();
        other.*field = "eta";
        luts::write_table(file(name), small(other));
        EXPECT_TRUE(contains(error_of(name), "over other axes")) << error_of(name);
        EXPECT_TRUE(contains(error_of(name), "regain bake " + name)) << error_of(name);
    }

    // What was refused may be put right while the process runs.
    luts::write_table(file(name), as("E_S"));
    EXPECT_EQ(error_of(name), "");
}

TEST_F(Library, the_environment_names_folders_too)
{
    ::setenv("REGAIN_LUTS", "/one::/two", 1);
    const std::vector<fs::path> folders = luts::table_folders();
    ::unsetenv("REGAIN_LUTS");
    ASSERT_GE(folders.size(), 3u);
    EXPECT_EQ(folders[1], "/one");
    EXPECT_EQ(folders[2], "/two");
}

TEST_F(Library, names_of_no_table_are_refused)
{
    EXPECT_THROW(luts::microfacet_tables("phong"), std::invalid_argument);
    for (const char* name : {"ggx_E", "ggx_", "gtr_E_S_beta_inside", "gtr_1.3", "gtr_1.3_E_S",
                             "gtr_1.3x_E_S_beta_inside", "std_1.5_E_S_beta_inside"})
        EXPECT_THROW(luts::table_named(name), std::invalid_argument) << name;
    EXPECT_THROW(luts::dielectric_tables("gtr", TransmissionShadowing::beta, 20),
                 std::invalid_argument);
}

}  // namespace
