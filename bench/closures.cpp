// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Closures with microfacets, of REGAIN_BENCH_DISTRIBUTION and REGAIN_BENCH_NUMBER.

#include "closure_list.h"
#include "measure.h"

#include <cstdlib>

namespace regain::bench {

template <template <class> class Distribution, class Real>
void add_microfacets()
{
    visit_microfacets<Distribution, Real>([](const std::string& lobe, const std::string& method,
                                             std::size_t bytes, const auto& make) {
        for (const char* alpha : alphas)
            add_closure<Real>(
                std::string(Named<Distribution>::name) + "/" + lobe + "/" + method + "/" + alpha,
                make, std::strtof(alpha, nullptr), bytes);
    });
}

template void add_microfacets<REGAIN_BENCH_DISTRIBUTION, REGAIN_BENCH_NUMBER>();

}  // namespace regain::bench
