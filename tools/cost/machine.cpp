// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "machine.h"

#include <algorithm>
#include <fstream>
#include <thread>

namespace regain::tools::cost {

std::string processor()
{
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
        if (line.rfind("model name", 0) == 0)
        {
            const std::size_t colon = line.find(": ");
            if (colon != std::string::npos) return line.substr(colon + 2);
        }
    return "unknown";
}

int processors() { return static_cast<int>(std::max(1u, std::thread::hardware_concurrency())); }

std::string compiler()
{
#if defined(__clang__)
    return "clang " __clang_version__;
#elif defined(__GNUC__)
    return "gcc " __VERSION__;
#else
    return "unknown";
#endif
}

}  // namespace regain::tools::cost
