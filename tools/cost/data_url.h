// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Pictures within a page.

#pragma once

#include "../picture.h"

#include <string>

namespace regain::tools::cost {

/// RFC 4648, with padding.
std::string base64(const std::string& bytes);

/// A PNG as what stands in src="...": the page needs no other file.
std::string data_url(const DisplayPicture&);

}  // namespace regain::tools::cost
