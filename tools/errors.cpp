// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "errors.h"

#include <fmt/format.h>

#include <cstdio>

namespace regain::tools {

int run_reporting(const std::function<int()>& command)
{
    try
    {
        return command();
    }
    catch (const CheckFailed& e)
    {
        fmt::print(stderr, "regain: {}\n", e.what());
        return kCheckFailed;
    }
    catch (const std::exception& e)
    {
        // Files that cannot be read or written are the user's to mend, as is a wrong argument.
        fmt::print(stderr, "regain: {}\n", e.what());
        return kBadInput;
    }
}

}  // namespace regain::tools
