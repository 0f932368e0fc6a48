// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Lines of a file descriptor, without copying them and with a limit to their length.

#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

namespace regain::tools {

class LineReader
{
public:
    struct Line
    {
        std::string_view text;  ///< without its end; valid until the next call
        bool too_long;          ///< then `text` is empty
    };

    /// `before_waiting` is called whenever more input has to be asked for, which may block. The
    /// descriptor stays the caller's.
    LineReader(int descriptor, std::size_t longest, std::function<void()> before_waiting);

    /// The next line, or nothing at the end. Throws std::runtime_error where reading fails.
    std::optional<Line> next();

private:
    bool read_more();

    int _descriptor;
    std::size_t _longest;
    std::function<void()> _before_waiting;
    std::vector<char> _buffer;
    std::size_t _begin = 0, _end = 0;  // what has been read and not handed out
};

}  // namespace regain::tools
