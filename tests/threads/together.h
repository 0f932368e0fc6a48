// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#pragma once

#include <atomic>
#include <thread>
#include <vector>

namespace regain::tests {

/// work(i) on several threads that all begin at once.
template <class Work>
void together(int threads, const Work& work)
{
    std::atomic<int> waiting{threads};
    std::vector<std::thread> all;
    for (int i = 0; i < threads; ++i)
        all.emplace_back([&, i] {
            --waiting;
            while (waiting > 0) std::this_thread::yield();
            work(i);
        });
    for (std::thread& t : all) t.join();
}

}  // namespace regain::tests
