// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "line_reader.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <string>

using namespace regain::tools;

namespace {

// The lines of a text that a pipe holds; "<too long>" for such a line.
std::vector<std::string> lines_of(const std::string& text, std::size_t longest = 10)
{
    int ends[2];
    EXPECT_EQ(::pipe(ends), 0);
    EXPECT_EQ(::write(ends[1], text.data(), text.size()), static_cast<ssize_t>(text.size()));
    ::close(ends[1]);
    LineReader reader(ends[0], longest, [] {});
    std::vector<std::string> lines;
    while (const auto line = reader.next())
        lines.push_back(line->too_long ? "<too long>" : std::string(line->text));
    ::close(ends[0]);
    return lines;
}

using Lines = std::vector<std::string>;

}  // namespace

TEST(line_reader, nothing_has_no_lines) { EXPECT_EQ(lines_of(""), Lines{}); }

TEST(line_reader, the_last_line_may_lack_its_end)
{
    EXPECT_EQ(lines_of("a\nb"), (Lines{"a", "b"}));
    EXPECT_EQ(lines_of("a\nb\n"), (Lines{"a", "b"}));
}

TEST(line_reader, empty_lines_count) { EXPECT_EQ(lines_of("\n\na\n"), (Lines{"", "", "a"})); }

TEST(line_reader, a_line_may_be_as_long_as_the_limit)
{
    EXPECT_EQ(lines_of("0123456789\nb\n"), (Lines{"0123456789", "b"}));
    EXPECT_EQ(lines_of("a\n0123456789"), (Lines{"a", "0123456789"}));
}

TEST(line_reader, a_longer_line_is_skipped_to_its_end)
{
    EXPECT_EQ(lines_of("a\n01234567890\nb\n"), (Lines{"a", "<too long>", "b"}));
    EXPECT_EQ(lines_of("a\n" + std::string(50000, 'x')), (Lines{"a", "<too long>"}));
    EXPECT_EQ(lines_of("a\n01234567890"), (Lines{"a", "<too long>"}));
}

TEST(line_reader, lines_across_reads_are_whole)
{
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    int waits = 0;
    LineReader reader(ends[0], 100, [&] {
        const std::string part = waits == 0 ? "fir" : waits == 1 ? "st\nsec" : "ond";
        ++waits;
        if (waits <= 3)
            EXPECT_EQ(::write(ends[1], part.data(), part.size()),
                      static_cast<ssize_t>(part.size()));
        else
            ::close(ends[1]);
    });
    EXPECT_EQ(reader.next()->text, "first");
    EXPECT_EQ(reader.next()->text, "second");
    EXPECT_FALSE(reader.next());
    ::close(ends[0]);
}

TEST(line_reader, a_descriptor_that_cannot_be_read_is_an_error)
{
    LineReader reader(-1, 10, [] {});
    EXPECT_THROW(reader.next(), std::runtime_error);
}
