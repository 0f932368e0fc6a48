// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "rules.h"

#include <map>
#include <mutex>
#include <vector>

REGAIN_NAMESPACE_BEGIN
namespace luts {

const QuadratureRule& rule_of(int nodes)
{
    // Each thread knows the rules that it has met, so that it need not wait for the others.
    thread_local std::vector<const QuadratureRule*> met;
    const auto n = static_cast<std::size_t>(nodes);
    if (n < met.size() && met[n]) return *met[n];

    static std::mutex mutex;
    static std::map<int, QuadratureRule> rules;
    const std::lock_guard<std::mutex> lock(mutex);
    auto at = rules.find(nodes);
    if (at == rules.end()) at = rules.emplace(nodes, gauss_legendre(nodes)).first;
    if (n >= met.size()) met.resize(n + 1, nullptr);
    met[n] = &at->second;
    return at->second;
}

}  // namespace luts
REGAIN_NAMESPACE_END
