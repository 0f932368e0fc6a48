// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "command.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

using test::says;

namespace {

using QueryCommand = test::Command;

const std::string mirror = R"({"op":"eval","closure":"conductor","alpha":0,"mu":1,"wi":[0,0,1]})";
const std::string black = R"({"value":[0,0,0]})";

}  // namespace

TEST_F(QueryCommand, answers_in_order_and_goes_on_after_a_bad_line)
{
    const auto o = run("query -", mirror + "\n{\"op\":\n" + mirror + "\nnonsense\n" + mirror);
    ASSERT_EQ(o.lines().size(), 5u) << o.out;
    for (std::size_t i : {0u, 2u, 4u}) EXPECT_EQ(o.lines()[i], black);
    for (std::size_t i : {1u, 3u}) EXPECT_TRUE(says(o.lines()[i], "{\"error\": \"")) << o.out;
    EXPECT_EQ(o.code, 2);
    EXPECT_TRUE(says(o.err, "2 of 5 lines could not be answered, line 2 the first")) << o.err;
}

TEST_F(QueryCommand, reads_a_file)
{
    write("questions", mirror + "\n");
    const auto o = run("query FOLDER/questions");
    EXPECT_EQ(o.out, black + "\n");
    EXPECT_EQ(o.code, 0);
    EXPECT_EQ(o.err, "");
}

TEST_F(QueryCommand, nothing_in_nothing_out)
{
    const auto o = run("query");
    EXPECT_EQ(o.out + o.err, "");
    EXPECT_EQ(o.code, 0);
}

TEST_F(QueryCommand, takes_line_ends_of_other_systems_blank_lines_and_a_byte_order_mark)
{
    const auto o = run("query", "\xef\xbb\xbf" + mirror + "\r\n\r\n \t\n" + mirror + "\r\n");
    EXPECT_EQ(o.out, black + "\n" + black + "\n");
    EXPECT_EQ(o.code, 0);
}

TEST_F(QueryCommand, a_very_long_line_is_refused_and_the_next_one_answered)
{
    const std::string padded = mirror + std::string(1000000, ' ');
    const auto o = run("query", padded + "\n" + std::string(3000000, 'x') + "\n" + mirror + "\n");
    ASSERT_EQ(o.lines().size(), 3u);
    EXPECT_EQ(o.lines()[0], black);
    EXPECT_TRUE(says(o.lines()[1], "longer than 1048576 bytes"));
    EXPECT_EQ(o.lines()[2], black);
    EXPECT_EQ(o.code, 2);
}

TEST_F(QueryCommand, deep_nesting_is_refused)
{
    const auto o = run("query", std::string(1000000, '[') + "\n" + mirror);
    ASSERT_EQ(o.lines().size(), 2u);
    EXPECT_TRUE(says(o.lines()[0], "nested too deep"));
    EXPECT_EQ(o.lines()[1], black);
}

TEST_F(QueryCommand, a_file_that_is_not_there_is_named)
{
    const auto o = run("query FOLDER/none");
    EXPECT_EQ(o.code, 2);
    EXPECT_TRUE(says(o.err, "cannot read '")) << o.err;
    EXPECT_TRUE(says(o.err, "/none': No such file")) << o.err;
}

TEST_F(QueryCommand, a_folder_is_no_file)
{
    const auto o = run("query FOLDER");
    EXPECT_EQ(o.code, 2);
    EXPECT_TRUE(says(o.err, "directory")) << o.err;
}

TEST_F(QueryCommand, a_full_disk_is_told)
{
    if (::access("/dev/full", W_OK) != 0) GTEST_SKIP() << "no /dev/full";
    write("questions", mirror + "\n");
    const auto o = run("query FOLDER/questions >/dev/full 2>FOLDER/errors #");
    EXPECT_EQ(o.code, 2);
    EXPECT_TRUE(says(read("errors"), "cannot write the answers")) << read("errors");
}

TEST_F(QueryCommand, a_hundred_thousand_lines_keep_their_order)
{
    std::string questions;
    const int n = 100000;
    for (int i = 0; i < n; ++i)
        questions += R"({"op":"fresnel","precision":"double","mu":1,"fresnel":{"constant":[)" +
                     std::to_string(i) + "e-6,0,0]}}\n";
    const auto o = run("query", questions);
    EXPECT_EQ(o.code, 0);
    const auto lines = o.lines();
    ASSERT_EQ(lines.size(), static_cast<std::size_t>(n));
    for (int i = 0; i < n; i += 997)
        EXPECT_DOUBLE_EQ(
            nlohmann::json::parse(lines[static_cast<std::size_t>(i)])["value"][0].get<double>(),
            i * 1e-6);
}

TEST_F(QueryCommand, holds_a_conversation)
{
    int in[2], out[2];
    ASSERT_EQ(::pipe2(in, O_CLOEXEC), 0);
    ASSERT_EQ(::pipe2(out, O_CLOEXEC), 0);
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0)
    {
        ::dup2(in[0], 0);
        ::dup2(out[1], 1);
        ::execl(REGAIN_BINARY, REGAIN_BINARY, "query", static_cast<char*>(nullptr));
        ::_exit(127);
    }
    ::close(in[0]);
    ::close(out[1]);
    for (int turn = 0; turn < 3; ++turn)
    {
        const std::string question = mirror + "\n";
        ASSERT_EQ(::write(in[1], question.data(), question.size()),
                  static_cast<ssize_t>(question.size()));
        // The answer has to come while the question's end of the pipe is still open.
        pollfd ready{out[0], POLLIN, 0};
        ASSERT_EQ(::poll(&ready, 1, 20000), 1) << "no answer";
        char answer[200];
        const ssize_t size = ::read(out[0], answer, sizeof answer);
        ASSERT_GT(size, 0);
        EXPECT_EQ(std::string(answer, static_cast<std::size_t>(size)), black + "\n");
    }
    ::close(in[1]);
    int status = -1;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
    ::close(out[0]);
}

TEST_F(QueryCommand, unknown_options_are_bad_input)
{
    EXPECT_EQ(run("query --fast").code, 2);
    EXPECT_EQ(run("query a b").code, 2);
}

TEST_F(QueryCommand, help_has_examples_that_run)
{
    const auto help = run("query --help");
    EXPECT_EQ(help.code, 0);
    const std::string mark = "echo '";
    int examples = 0;
    for (std::size_t at = 0; (at = help.out.find(mark, at)) != std::string::npos; ++examples)
    {
        at += mark.size();
        const auto o = run("query", help.out.substr(at, help.out.find('\'', at) - at));
        EXPECT_EQ(o.code, 0) << o.out;
    }
    EXPECT_EQ(examples, 3);
}
