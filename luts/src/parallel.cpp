// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "parallel.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

REGAIN_NAMESPACE_BEGIN
namespace luts {

void parallel_for(std::size_t count, const BakeProgress& progress,
                  const std::function<void(std::size_t)>& body)
{
    std::atomic<std::size_t> next{0}, done{0};
    std::atomic<bool> stop{false};
    std::mutex mutex;
    std::condition_variable finished;
    std::exception_ptr failure;
    std::size_t running =
        std::max<std::size_t>(1, std::min<std::size_t>(std::thread::hardware_concurrency(), count));

    std::vector<std::thread> threads;
    const auto work = [&] {
        try
        {
            for (std::size_t i; !stop && (i = next++) < count; ++done) body(i);
        }
        catch (...)
        {
            const std::lock_guard<std::mutex> lock(mutex);
            failure = std::current_exception();
            stop = true;
        }
        const std::lock_guard<std::mutex> lock(mutex);
        if (--running == 0) finished.notify_all();
    };
    for (std::size_t n = running; n > 0; --n) threads.emplace_back(work);

    // The callback runs without the lock: it may take its time, or throw.
    try
    {
        for (bool all_ended = false; !all_ended;)
        {
            if (progress && !progress(static_cast<double>(done) / static_cast<double>(count)))
                throw BakeStopped();
            std::unique_lock<std::mutex> lock(mutex);
            all_ended = finished.wait_for(lock, std::chrono::milliseconds(50),
                                          [&] { return running == 0; });
        }
    }
    catch (...)
    {
        stop = true;
        for (std::thread& t : threads) t.join();
        throw;
    }
    for (std::thread& t : threads) t.join();
    if (failure) std::rethrow_exception(failure);
    if (progress && !progress(1)) throw BakeStopped();
}

}  // namespace luts
REGAIN_NAMESPACE_END
