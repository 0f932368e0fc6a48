// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Parts of any job: every piece is one part's, and only what belongs together is put together.

#include "part_file.h"

#include "../support/temporary_folder.h"
#include "errors.h"
#include "loaded_program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace regain::tools { namespace {

template <class Call>
std::string refusal(const Call& call)
{
    try
    {
        call();
    }
    catch (const BadInput& e)
    {
        return e.what();
    }
    return {};
}

bool says(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

TEST(Part, is_named_by_two_numbers)
{
    const Part part = part_named("3/7");
    EXPECT_EQ(part.number, 3u);
    EXPECT_EQ(part.of, 7u);
    EXPECT_EQ(part.text(), "3/7");
    EXPECT_EQ(part_file_name("a/gold.v2", part), "a/gold.v2.part-3-of-7");
    EXPECT_EQ(part_named("1/1").of, 1u);
    EXPECT_EQ(part_named("100000/100000").of, Part::most);
}

TEST(Part, anything_else_is_refused_with_the_range)
{
    for (const char* given : {"",
                              "/",
                              "3",
                              "3/",
                              "/7",
                              "0/7",
                              "8/7",
                              "-1/7",
                              "1/-7",
                              "+1/7",
                              " 1/7",
                              "1/7 ",
                              "1.5/7",
                              "1/7/9",
                              "3:7",
                              "1/0",
                              "0/0",
                              "1/100001",
                              "99999999999999999999/7",
                              "1/x"})
    {
        const std::string what = refusal([&] { part_named(given); });
        EXPECT_TRUE(says(what, std::string("'") + given + "'")) << what;
        EXPECT_TRUE(says(what, "1 <= K <= N <= 100000")) << given << ": " << what;
    }
}

TEST(Part, every_piece_is_one_part_s_and_parts_are_even)
{
    for (const std::size_t pieces : {1u, 5u, 90u, 360u, 1620u})
        for (const std::size_t across : {1u, 6u, 90u})
            for (const std::size_t of : {1u, 2u, 6u, 7u, 13u, 90u, 2000u})
            {
                std::vector<int> owners(pieces, 0);
                std::size_t least = pieces, most = 0;
                for (std::size_t number = 1; number <= of; ++number)
                {
                    std::size_t has = 0;
                    for (std::size_t i = 0; i < pieces; ++i)
                        if (Part{number, of}.holds(i, across)) ++owners[i], ++has;
                    least = std::min(least, has);
                    most = std::max(most, has);
                }
                EXPECT_EQ(std::count(owners.begin(), owners.end(), 1),
                          static_cast<std::ptrdiff_t>(pieces))
                    << pieces << " pieces, " << across << " across, of " << of;
                EXPECT_LE(most - least, pieces % of == 0 ? 0u : 1u)
                    << pieces << " pieces, " << across << " across, of " << of;
            }
}

// Six objects side by side, six parts: a part that had one of them alone would take longer.
TEST(Part, columns_are_shared_out_where_rows_are_as_long_as_there_are_parts)
{
    for (std::size_t number = 1; number <= 6; ++number)
        for (std::size_t column = 0; column < 6; ++column)
        {
            int has = 0;
            for (std::size_t row = 0; row < 6; ++row)
                has += Part{number, 6}.holds(row * 6 + column, 6);
            EXPECT_EQ(has, 1) << number << ", column " << column;
        }
}

TEST(JobDescription, tells_jobs_apart_and_says_by_what)
{
    JobDescription a = describe_job("render");
    a.add("seed", "1");
    JobDescription b = a;
    EXPECT_EQ(difference(a, b), "");
    EXPECT_EQ(fingerprint(a), fingerprint(b));
    b.entries.back().second = "2";
    EXPECT_EQ(difference(a, b), "seed: '2' there, '1' here");
    EXPECT_NE(fingerprint(a), fingerprint(b));
    b = a;
    b.add("method", "tail");
    EXPECT_EQ(difference(a, b), "method: 'tail' there, nothing here");
    EXPECT_EQ(difference(b, a), "method: nothing there, 'tail' here");
    b = a;
    b.command = "bake";
    EXPECT_EQ(difference(a, b), "command: 'bake' there, 'render' here");
    EXPECT_NE(fingerprint(a), fingerprint(b));
}

TEST(JobDescription, files_are_told_by_their_contents)
{
    const test::TemporaryFolder folder;
    const auto contents = [&](const std::string& text) {
        JobDescription job;
        job.add_contents("file", folder.write("file", text));
        return job.entries.front().second;
    };
    EXPECT_EQ(contents("gold"), contents("gold"));
    EXPECT_NE(contents("gold"), contents("bold"));
    EXPECT_NE(contents(std::string(100000, 'a')), contents(std::string(100000, 'a') + "b"));
    JobDescription none;
    none.add_contents("file", folder / "none");
    EXPECT_EQ(none.entries.front().second, "not readable");
}

TEST(JobDescription, a_program_is_the_same_as_itself)
{
    EXPECT_EQ(loaded_program(), loaded_program());
    EXPECT_EQ(instruction_set(), instruction_set());
    EXPECT_FALSE(instruction_set().empty());
}

class PartFiles : public testing::Test
{
protected:
    std::string write(int number, int of, const JobDescription& its_job)
    {
        const Part part{static_cast<std::size_t>(number), static_cast<std::size_t>(of)};
        const auto file = part_file_name(folder / "job", part);
        write_part(file, its_job, part, "payload " + part.text());
        return file.string();
    }
    std::string write(int number, int of) { return write(number, of, job); }
    std::string refused(const std::vector<std::string>& files)
    {
        return refusal([&] { all_parts(files, job); });
    }
    static std::string text_of(const std::string& file)
    {
        std::ostringstream text;
        text << std::ifstream(file, std::ios::binary).rdbuf();
        return text.str();
    }

    const test::TemporaryFolder folder;
    JobDescription job = describe_job("render");
};

TEST_F(PartFiles, come_back_in_order)
{
    const std::string third = write(3, 3), first = write(1, 3), second = write(2, 3);
    const auto parts = all_parts({third, first, second}, job);
    ASSERT_EQ(parts.size(), 3u);
    EXPECT_EQ(parts[0].payload(), "payload 1/3");
    EXPECT_EQ(parts[1].payload(), "payload 2/3");
    EXPECT_EQ(parts[2].payload(), "payload 3/3");
    EXPECT_EQ(parts[2].file, third);
}

TEST_F(PartFiles, what_is_missing_twice_there_or_of_other_numbers_is_said)
{
    const std::string a = write(1, 4), c = write(3, 4), other = write(2, 5);
    EXPECT_EQ(refused({a, c}), "--merge: of 4 parts 2 are not given: 2, 4");
    EXPECT_EQ(refused({write(1, 2)}), "--merge: of 2 parts 1 is not given: 2");
    EXPECT_TRUE(says(refused({a, c, a}), "is part 1/4, as is '" + a + "'")) << refused({a, c, a});
    EXPECT_TRUE(says(refused({a, other}), "is of 5 parts, and '" + a + "' of 4"));
    EXPECT_TRUE(says(refused({write(7, 1000)}), "999 are not given: 1, 2, 3, 4, 5, 6, 8"));
}

TEST_F(PartFiles, of_another_seed_program_or_machine_are_refused)
{
    const std::string a = write(1, 2);
    for (const auto& entry : job.entries)
    {
        JobDescription foreign = job;
        std::find(foreign.entries.begin(), foreign.entries.end(), entry)->second = "other";
        const std::string why = refused({a, write(2, 2, foreign)});
        EXPECT_TRUE(says(why, "part-2-of-2' is of another job: " + entry.first + ": 'other' there"))
            << why;
    }
    JobDescription foreign = job;
    foreign.command = "bake";
    EXPECT_TRUE(says(refused({a, write(2, 2, foreign)}), "command: 'bake' there"));
}

TEST_F(PartFiles, that_are_damaged_are_refused)
{
    const std::string a = write(1, 1), whole = text_of(a);
    EXPECT_TRUE(says(refused({(folder / "none").string()}), "cannot be read"));
    EXPECT_TRUE(says(refused({folder.write("text", "no part").string()}), "is no part"));
    EXPECT_TRUE(says(refused({folder.write("empty", "").string()}), "is no part"));
    for (std::size_t size = whole.find('\n') + 1; size < whole.size(); ++size)
    {
        const std::string cut = folder.write("cut", whole.substr(0, size)).string();
        EXPECT_TRUE(says(refused({cut}), "is damaged")) << size << ": " << refused({cut});
    }
    EXPECT_TRUE(says(refused({folder.write("long", whole + "x").string()}), "is damaged"));
    std::string changed = whole;
    changed.back() ^= 1;
    const auto parts = all_parts({folder.write("changed", changed).string()}, job);
    EXPECT_TRUE(says(refusal([&] { parts.front().payload(); }), "its numbers were changed"));
    std::string header = whole;
    header.replace(header.find("\"fingerprint\":\"") + 15, 4, "????");
    EXPECT_TRUE(says(refused({folder.write("header", header).string()}), "header was changed"));
}

TEST(PartPayload, reads_back_what_was_put_and_no_more)
{
    const double numbers[] = {1.5, -0.0};
    const std::uint32_t count = 7;
    Payload payload;
    payload.put(numbers, 2);
    payload.put(&count, 1);
    payload.put_text(std::string("a\0b", 3));
    PayloadReader reader(payload.bytes());
    double back[8];
    std::uint32_t again = 0;
    reader.take(back, 2);
    EXPECT_THROW(reader.finish(), PayloadReader::Error);
    EXPECT_THROW(reader.take(back, 8), PayloadReader::Error);
    reader.take(&again, 1);
    EXPECT_EQ(again, count);
    EXPECT_EQ(reader.take_text(), std::string("a\0b", 3));
    EXPECT_THROW(reader.take_text(), PayloadReader::Error);
    EXPECT_TRUE(std::signbit(back[1]));
    reader.finish();
}

}}  // namespace regain::tools
