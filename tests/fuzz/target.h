// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What a fuzz target is: libFuzzer's entry point, which AFL++ and the driver of this folder call,
/// too. It returns 0, and ends the process where an input shows a fault.

#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace regain::fuzz {

/// Says what is wrong and stops the process, as a fuzzer expects it of a fault.
[[noreturn]] inline void fault(const std::string& what)
{
    std::fprintf(stderr, "fault: %s\n", what.c_str());
    std::abort();
}

}  // namespace regain::fuzz
