// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Closures without microfacets, and one of a layer, of REGAIN_BENCH_NUMBER.

#include "closure_list.h"
#include "measure.h"

#include <cstdlib>

namespace regain::bench {

template <class Real>
void add_plain()
{
    visit_plain<Real>([](const std::string& lobe, const std::string& method, std::size_t bytes,
                         const auto& make) {
        for (const char* alpha : alphas)
            add_closure<Real>("plain/" + lobe + "/" + method + "/" + alpha, make,
                              std::strtof(alpha, nullptr), bytes);
    });
}

template void add_plain<REGAIN_BENCH_NUMBER>();

}  // namespace regain::bench
