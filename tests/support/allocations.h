// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Counts what a program that has allocations.cpp compiled in takes from the heap by new.

#pragma once

namespace regain::tests {

/// Since the program's start, of all threads.
long allocations();

}  // namespace regain::tests
