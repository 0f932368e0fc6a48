// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "line_reader.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace regain::tools {
namespace {

constexpr std::size_t chunk = 1 << 16;

}  // namespace

LineReader::LineReader(int descriptor, std::size_t longest, std::function<void()> before_waiting)
    : _descriptor(descriptor), _longest(longest), _before_waiting(std::move(before_waiting))
{}

bool LineReader::read_more()
{
    if (_begin > 0)
    {
        std::memmove(_buffer.data(), _buffer.data() + _begin, _end - _begin);
        _end -= _begin;
        _begin = 0;
    }
    if (_buffer.size() < _end + chunk) _buffer.resize(2 * _buffer.size() + chunk);

    _before_waiting();
    for (;;)
    {
        const ssize_t n = ::read(_descriptor, _buffer.data() + _end, _buffer.size() - _end);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) throw std::runtime_error(std::strerror(errno));
        _end += static_cast<std::size_t>(n);
        return n > 0;
    }
}

std::optional<LineReader::Line> LineReader::next()
{
    std::size_t searched = 0;
    bool too_long = false;
    for (;;)
    {
        const char* start = _buffer.data() + _begin;
        const std::size_t size = _end - _begin;
        const void* found =
            size > searched ? std::memchr(start + searched, '\n', size - searched) : nullptr;
        if (found)
        {
            const std::size_t length =
                static_cast<std::size_t>(static_cast<const char*>(found) - start);
            _begin += length + 1;
            if (too_long || length > _longest) return Line{{}, true};
            return Line{{start, length}, false};
        }

        searched = size;
        if (size > _longest)
        {
            // The rest of it is read, but not kept.
            too_long = true;
            _begin = _end = searched = 0;
        }
        if (read_more()) continue;

        // The last line may lack its end.
        if (too_long) return Line{{}, true};
        if (_begin == _end) return std::nullopt;
        const Line last{{_buffer.data() + _begin, _end - _begin}, false};
        _begin = _end;
        return last;
    }
}

}  // namespace regain::tools
