// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "closure_model.h"
#include "closures_by_distribution.h"

namespace regain::tools {

std::unique_ptr<AnyClosure> make_plain_closure(const ClosureSpec& spec)
{
    const auto make = [&](auto strength) {
        return spec.plain->with_closure(
            strength, [&](const auto& closure) -> std::unique_ptr<AnyClosure> {
                return std::make_unique<ClosureModel<std::decay_t<decltype(closure)>>>(
                    closure, spec.transport == Transport::radiance);
            });
    };
    if (spec.precision == Precision::twice) return make(1.0);
    return make(1.0f);
}

}  // namespace regain::tools
