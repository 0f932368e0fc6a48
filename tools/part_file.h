// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What a part has found, as a file: a line that says that it is one, a line of JSON that says
/// which part of which job, and numbers as they lie in memory. Parts are put together on the
/// architecture that made them.

#pragma once

#include "job_description.h"
#include "part.h"

#include <cstddef>
#include <cstring>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace regain::tools {

/// Whole or not at all; throws std::runtime_error that names the file.
void write_part(const std::filesystem::path& file, const JobDescription& job, const Part& part,
                std::string_view payload);

/// One that is there, by its first lines.
struct PartFile
{
    std::filesystem::path file;
    Part part;
    std::uint64_t payload_begin = 0, payload_size = 0, payload_hash = 0;

    /// Throws BadInput where it is not what was written.
    std::string payload() const;
};

/// All parts of one job, by their numbers. Throws BadInput, which says what is missing, twice
/// there, no part, damaged, or of another job and in what it differs.
std::vector<PartFile> all_parts(const std::vector<std::string>& files, const JobDescription& job);

/// Numbers, one after the other.
class Payload
{
public:
    template <class T>
    void put(const T* values, std::size_t count)
    {
        static_assert(std::is_trivially_copyable_v<T>);
        _bytes.append(reinterpret_cast<const char*>(values), count * sizeof(T));
    }
    void put_text(std::string_view text)
    {
        const std::uint64_t size = text.size();
        put(&size, 1);
        _bytes.append(text);
    }
    const std::string& bytes() const { return _bytes; }

private:
    std::string _bytes;
};

/// The same again.
class PayloadReader
{
public:
    /// There is less than is asked for, or more.
    struct Error : std::runtime_error
    {
        using std::runtime_error::runtime_error;
    };

    explicit PayloadReader(std::string_view bytes) : _left(bytes) {}

    template <class T>
    void take(T* values, std::size_t count)
    {
        static_assert(std::is_trivially_copyable_v<T>);
        if (_left.size() / sizeof(T) < count) throw Error("there is less than it says");
        std::memcpy(values, _left.data(), count * sizeof(T));
        _left.remove_prefix(count * sizeof(T));
    }
    std::string take_text()
    {
        std::uint64_t size = 0;
        take(&size, 1);
        if (size > _left.size()) throw Error("there is less than it says");
        std::string text(_left.substr(0, size));
        _left.remove_prefix(size);
        return text;
    }
    void finish() const
    {
        if (!_left.empty()) throw Error("there is more than it says");
    }

private:
    std::string_view _left;
};

/// Calls read for each of all_parts, which takes what the part has, to its end. Throws as all_parts
/// does.
void read_parts(const std::vector<std::string>& files, const JobDescription& job,
                const std::function<void(const Part&, PayloadReader&)>& read);

}  // namespace regain::tools
