// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Work in parts: which of n programs, on as many machines, does what.

#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace regain::tools {

/// Part `number` of `of`, from 1 on.
struct Part
{
    std::size_t number = 1, of = 1;

    static constexpr std::size_t most = 100000;

    /// Whether it does piece i, from 0 on, of pieces that lie in rows of `across`. Every piece is
    /// one part's, and no part has two pieces more than another. Neighbours, which cost alike, go
    /// to different parts, also where rows are as long as there are parts.
    bool holds(std::size_t i, std::size_t across = 1) const;

    /// "3/7".
    std::string text() const;
};

/// The part that --part names. Throws BadInput, which says what is accepted, for anything but K/N
/// with 1 <= K <= N <= Part::most.
Part part_named(const std::string& text);

/// "gold.part-3-of-7", of "gold": where a part is written.
std::filesystem::path part_file_name(const std::filesystem::path& stem, const Part& part);

}  // namespace regain::tools
