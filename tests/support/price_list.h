// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Errors and prices of methods that are made up, in the form of `regain cost --planner-data`:
/// errors rise with the square of alpha and, of metals, with F0. A method costs its time for an
/// eval and as much for a sample, at any alpha.

#pragma once

#include <sstream>
#include <string>
#include <vector>

namespace regain::tests {

struct Price
{
    const char* method;
    double error, time;  ///< the error at alpha 1 and F0 1
};

namespace detail {

inline std::string listed(const std::vector<double>& all)
{
    std::ostringstream text;
    text.precision(12);
    for (std::size_t i = 0; i < all.size(); ++i) text << (i ? "," : "") << all[i];
    return "[" + text.str() + "]";
}

inline std::string entry(const std::string& kind, const std::string& law, const std::string& axis,
                         const std::vector<double>& places, const Price& p)
{
    const std::vector<double> alphas{0.05, 0.1, 0.2, 0.5, 1};
    std::string errors;
    for (const double a : alphas)
    {
        std::vector<double> row;
        for (const double x : places) row.push_back(p.error * a * a * (axis == "F0" ? x : 1));
        errors += (errors.empty() ? "" : ",") + listed(row);
    }
    const std::string times = listed(std::vector<double>(alphas.size(), p.time));
    return "{\"class\":\"" + kind + "\",\"distribution\":" + law + ",\"method\":\"" + p.method +
           "\",\"alpha\":" + listed(alphas) + ",\"" + axis + "\":" + listed(places) +
           ",\"error\":[" + errors + "],\"noise\":1e-5,\"eval\":" + times + ",\"sample\":" + times +
           ",\"table_bytes\":0}";
}

}  // namespace detail

inline std::string price_list()
{
    const Price metals[] = {{"none", 0.6, 1},          {"turquin", 0.06, 1.3},
                            {"directional", 0.004, 2}, {"balanced", 0.01, 1.9},
                            {"tail", 0.004, 4},        {"walk", 0.0002, 6}};
    const Price glasses[] = {
        {"none", 0.8, 1.5}, {"turquin", 0.4, 2}, {"tail", 0.02, 5}, {"walk", 0, 8}};
    const Price coats[] = {{"none", 0.02, 1.2}, {"turquin", 0.004, 1.6}, {"tail", 0.001, 4}};
    std::string all;
    const auto add = [&](const std::string& one) { all += (all.empty() ? "" : ",\n") + one; };
    for (const char* law :
         {"\"ggx\"", "\"beckmann\"", "\"gtr\",\"gamma\":1.5", "\"gtr\",\"gamma\":3"})
    {
        for (const Price& p : metals)
        {
            add(detail::entry("metal", law, "F0", {0.04, 0.5, 1}, p));
            // A colour makes all but single scattering twice as far off.
            Price of_colour = p;
            if (p.error < 0.5) of_colour.error *= 2;
            add(detail::entry("coloured-metal", law, "material", {0, 1}, of_colour));
        }
        for (const Price& p : glasses)
            for (const char* kind : {"glass-outside", "glass-inside"})
                add(detail::entry(kind, law, "eta", {1.1, 1.5, 2}, p));
        for (const Price& p : coats) add(detail::entry("plastic", law, "eta", {1.1, 1.5, 2}, p));
    }
    return "{\"schema\":1,\"transmission_shadowing\":\"beta\",\"entries\":[" + all + "]}";
}

}  // namespace regain::tests
