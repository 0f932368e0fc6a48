// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Sums are means of what was added, and what is not finite never enters them.

#include "preview/film.h"

#include <gtest/gtest.h>

#include <limits>

namespace regain::tools::preview { namespace {

using Imath::C3f;

TEST(Film, MeanOfSamples)
{
    Film film(3, 2);
    film.add(2, 1, C3f(1.0f, 2.0f, 3.0f));
    film.add(2, 1, C3f(3.0f, 2.0f, 1.0f));
    EXPECT_EQ(film.mean(2, 1), C3f(2.0f));
    EXPECT_EQ(film.samples(2, 1), 2u);
    EXPECT_EQ(film.mean(0, 0), C3f(0.0f));
}

TEST(Film, CountsWhatIsNotFinite)
{
    Film film(1, 1);
    film.add(0, 0, C3f(1.0f));
    film.add(0, 0, C3f(std::numeric_limits<float>::quiet_NaN()));
    film.add(0, 0, C3f(std::numeric_limits<float>::infinity(), 0.0f, 0.0f));
    EXPECT_EQ(film.non_finite(), 2u);
    EXPECT_FLOAT_EQ(film.mean(0, 0).x, 1.0f / 3.0f);
}

TEST(Film, KeepsSmallSamplesBesideLargeOnes)
{
    Film film(1, 1);
    film.add(0, 0, C3f(1e6f));
    for (int i = 0; i < 999999; ++i) film.add(0, 0, C3f(1e-3f));
    EXPECT_NEAR(film.mean(0, 0).x, 1.001f, 1e-6f);
}

}}  // namespace regain::tools::preview
