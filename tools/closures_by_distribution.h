// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// make_closure by distribution. Each compiles for seconds, in a file of its own.

#pragma once

#include "any_closure.h"

namespace regain::tools {

/// The material is the specification's, of this distribution, with its tables bound.
std::unique_ptr<AnyClosure> make_ggx_closure(const shaders::MicrofacetMaterial&,
                                             const ClosureSpec&);
std::unique_ptr<AnyClosure> make_beckmann_closure(const shaders::MicrofacetMaterial&,
                                                  const ClosureSpec&);
std::unique_ptr<AnyClosure> make_gtr_closure(const shaders::MicrofacetMaterial&,
                                             const ClosureSpec&);
std::unique_ptr<AnyClosure> make_std_closure(const shaders::MicrofacetMaterial&,
                                             const ClosureSpec&);
/// Of a closure without microfacets.
std::unique_ptr<AnyClosure> make_plain_closure(const ClosureSpec&);

}  // namespace regain::tools
