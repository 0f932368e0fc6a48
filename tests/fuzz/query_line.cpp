// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Lines of `regain query`: whatever stands in one, the answer is a line of JSON, an error names
// what is wrong, and nothing is thrown.

#include "target.h"

#include "query_answer.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <string_view>

using namespace regain;

namespace {

// A line may ask for a million samples or a long walk, which is work, not a fault.
bool asks_for_much(std::string_view line)
{
    int digits = 0;
    for (const char c : line)
    {
        digits = c >= '0' && c <= '9' ? digits + 1 : 0;
        if (digits > 3) return true;
    }
    return line.find_first_of("eE") != std::string_view::npos &&
           line.find("\"n\"") != std::string_view::npos;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string_view line(reinterpret_cast<const char*>(data), size);
    if (asks_for_much(line)) return 0;
    fmt::memory_buffer out;
    bool answered = false;
    try
    {
        answered = tools::answer_line(line, out);
    }
    catch (const std::exception& e)
    {
        fuzz::fault(std::string("a line made the answer throw: ") + e.what());
    }
    const std::string_view answer(out.data(), out.size());
    if (answer.find('\n') != std::string_view::npos) fuzz::fault("the answer is not one line");
    const auto json = nlohmann::json::parse(answer, nullptr, false);
    if (!json.is_object()) fuzz::fault("the answer is no JSON object: " + std::string(answer));
    if (answered == json.contains("error"))
        fuzz::fault("an error is not told from an answer: " + std::string(answer));
    return 0;
}
