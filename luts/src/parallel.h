// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#pragma once

#include <regain/luts/bake.h>

#include <cstddef>
#include <functional>

REGAIN_NAMESPACE_BEGIN
namespace luts {

/// Calls body(0) to body(count - 1), each once, in any order and on all cores, while this thread
/// reports progress. Every call writes to a place of its own, so the result does not depend on how
/// many threads there are. Throws BakeStopped when the callback says stop, and what a body throws.
void parallel_for(std::size_t count, const BakeProgress& progress,
                  const std::function<void(std::size_t)>& body);

}  // namespace luts
REGAIN_NAMESPACE_END
