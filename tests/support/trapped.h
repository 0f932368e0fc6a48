// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Invalid operations and divisions by zero stop the program while a Trapped lives.

#pragma once

#include <cfenv>

namespace regain::tests {

class Trapped
{
public:
    Trapped()
    {
        // What was raised before must not trap now, as it would in the next long double.
        feclearexcept(FE_ALL_EXCEPT);
        feenableexcept(FE_INVALID | FE_DIVBYZERO);
    }
    Trapped(const Trapped&) = delete;
    Trapped& operator=(const Trapped&) = delete;
    ~Trapped()
    {
        feclearexcept(FE_ALL_EXCEPT);
        fedisableexcept(FE_INVALID | FE_DIVBYZERO);
    }
};

}  // namespace regain::tests
