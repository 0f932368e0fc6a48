// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What is measured: classes of materials, distributions and widths, and what of them is chosen.

#pragma once

#include "subject.h"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace regain::tools::cost {

enum class Class { metal, coloured, glass_outside, glass_inside, plastic };
constexpr Class all_classes[] = {Class::metal, Class::coloured, Class::glass_outside,
                                 Class::glass_inside, Class::plastic};
std::string_view name(Class);

/// The words of a sentence: "glass seen from inside".
std::string_view words(Class);

struct Law
{
    shaders::DistributionKind kind = shaders::DistributionKind::ggx;
    double gamma = 2;  ///< of gtr and std

    /// "ggx", "gtr 1.5"
    std::string label() const;
};

/// Which channels of a closure are one material: metals of three greys share a closure, since one
/// channel of a lobe says what any channel does.
struct Part
{
    std::string label;  ///< "F0 0.04", "gold", "eta 1.5"
    double axis = 0;    ///< the F0, the eta; of coloured metals their place in the list
    int first = 0, last = 2;
};

/// One closure at one width, by every method.
struct Case
{
    Class kind = Class::metal;
    Law law;
    double alpha = 0.5;
    Surface surface;    ///< but for the method
    double side = 1;    ///< -1: seen from inside
    bool timed = true;  ///< not where another case of equal cost is
    std::vector<Part> parts;
};

/// What is asked for.
struct Choice
{
    std::vector<Class> classes;
    std::vector<Law> laws;
    std::vector<shaders::Compensation> methods;
    std::vector<double> alphas, etas;
};

/// Everything; `quick`: three widths and one eta.
Choice everything(bool quick);

/// Leaves of a choice what is named; an empty list leaves all. Throws BadInput, which lists what
/// there is, for a name that is none.
void keep_classes(Choice&, const std::vector<std::string>&);
void keep_distributions(Choice&, const std::vector<std::string>&);
void keep_methods(Choice&, const std::vector<std::string>&);

/// By class, distribution, alpha and material, in that order.
std::vector<Case> cases_of(const Choice&);

/// Of sums: |mu| of wo.
constexpr std::array<double, 8> cosines{0.05, 0.1, 0.2, 0.35, 0.5, 0.7, 0.9, 1};

/// At which of these the shape of the lobe is compared.
constexpr std::array<std::size_t, 3> shape_cosines{2, 4, 6};

}  // namespace regain::tools::cost
