// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "rules.h"

#include <map>
#include <mutex>

REGAIN_NAMESPACE_BEGIN
namespace luts {

const QuadratureRule& rule_of(int nodes)
{
    static std::mutex mutex;
    static std::map<int, QuadratureRule> rules;
    const std::lock_guard<std::mutex> lock(mutex);
    const auto at = rules.find(nodes);
    return at != rules.end() ? at->second
                             : rules.emplace(nodes, gauss_legendre(nodes)).first->second;
}

}  // namespace luts
REGAIN_NAMESPACE_END
