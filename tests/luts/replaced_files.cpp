// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// A file appears whole or not at all, whatever goes wrong while it is written.

#include "../support/temporary_folder.h"

#include <regain/luts/replace_file.h>

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

using namespace regain;
namespace fs = std::filesystem;

namespace {

class ReplacedFiles : public testing::Test
{
protected:
    ReplacedFiles() : target(_folder.write("target.txt", "old")) {}

    std::string error_of(const fs::path& path, const std::function<void(const fs::path&)>& write)
    {
        try
        {
            luts::replace_file(path, write);
        }
        catch (const std::runtime_error& e)
        {
            return e.what();
        }
        return "";
    }
    static void write_new(const fs::path& path) { std::ofstream(path) << "new"; }
    std::string text() const
    {
        std::ifstream in(target);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    auto files() const { return std::distance(fs::directory_iterator(_folder.path()), {}); }

private:
    const test::TemporaryFolder _folder;

protected:
    const fs::path target;
};

TEST_F(ReplacedFiles, what_was_written_replaces_what_was_there)
{
    luts::replace_file(target, [&](const fs::path& temporary) {
        EXPECT_EQ(temporary.parent_path(), target.parent_path());
        EXPECT_EQ(temporary.extension(), target.extension());
        write_new(temporary);
        EXPECT_EQ(text(), "old");
    });
    EXPECT_EQ(text(), "new");
    EXPECT_EQ(files(), 1);
}

TEST_F(ReplacedFiles, a_writer_that_fails_or_writes_nothing_changes_nothing)
{
    EXPECT_EQ(error_of(target,
                       [](const fs::path& temporary) {
                           write_new(temporary);
                           throw std::runtime_error("half-way");
                       }),
              "half-way");
    const std::string nothing = error_of(target, [](const fs::path&) {});
    EXPECT_NE(nothing.find("nothing was written"), std::string::npos) << nothing;
    EXPECT_NE(nothing.find(target.string()), std::string::npos) << nothing;
    EXPECT_EQ(text(), "old");
    EXPECT_EQ(files(), 1);
}

TEST_F(ReplacedFiles, a_folder_is_no_target_whenever_it_appears)
{
    const fs::path folder = target.parent_path() / "folder";
    const std::string late = error_of(folder, [&](const fs::path& temporary) {
        write_new(temporary);
        fs::create_directory(folder);
    });
    EXPECT_NE(late.find(folder.string()), std::string::npos) << late;
    const std::string before = error_of(folder, write_new);
    EXPECT_NE(before.find("it is a folder"), std::string::npos) << before;
    EXPECT_TRUE(fs::is_empty(folder));
    EXPECT_EQ(files(), 2);
}

// Permissions do not stop a superuser, but no one makes a file in there.
TEST_F(ReplacedFiles, a_folder_that_takes_no_files_is_said_to_be_one)
{
    if (!fs::exists("/proc/self")) GTEST_SKIP() << "this system has no /proc";
    const std::string error = error_of("/proc/self/target.txt", write_new);
    EXPECT_NE(error.find("the folder takes no file"), std::string::npos) << error;
}

TEST_F(ReplacedFiles, a_name_without_a_folder_is_in_the_current_one)
{
    const fs::path before = fs::current_path();
    fs::current_path(target.parent_path());
    luts::replace_file("target.txt", write_new);
    fs::current_path(before);
    EXPECT_EQ(text(), "new");
}

}  // namespace
