// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What colour tests leave no trace of: a folder, the environment variable OCIO. And what they ask
/// of errors and colours.

#pragma once

#include "../support/temporary_folder.h"

#include <Imath/ImathColor.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <exception>
#include <optional>
#include <string>

namespace test {

/// Sets OCIO, or unsets it; puts it back.
class OcioVariable
{
public:
    explicit OcioVariable(const std::optional<std::string>& value)
    {
        if (const char* before = ::getenv("OCIO")) _before = before;
        set(value);
    }
    OcioVariable(const OcioVariable&) = delete;
    OcioVariable& operator=(const OcioVariable&) = delete;
    ~OcioVariable() { set(_before); }

private:
    static void set(const std::optional<std::string>& value)
    {
        if (value)
            ::setenv("OCIO", value->c_str(), 1);
        else
            ::unsetenv("OCIO");
    }
    std::optional<std::string> _before;
};

/// The message of what `call` throws; "" if it does not.
template <class Call>
std::string message_of(const Call& call)
{
    try
    {
        call();
    }
    catch (const std::exception& e)
    {
        return e.what();
    }
    return "";
}

inline bool says(const std::string& message, const std::string& part)
{
    return message.find(part) != std::string::npos;
}

template <class T, class U>
void expect_near(const Imath::Color3<T>& a, const Imath::Color3<U>& b, double tolerance)
{
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance) << "channel " << c;
}

}  // namespace test
