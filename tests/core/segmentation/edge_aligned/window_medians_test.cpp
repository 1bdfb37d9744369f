// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/window_medians.hpp"

#include "core/random_stream.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace mapscore {
namespace {

/// Windows of all sizes; values far apart, with outliers, in steps with many equal ones.
TEST(WindowMedians, EqualTheMiddleOfTheSortedValues) {
  RandomStream random(3, "medians", {});
  for (int trial = 0; trial < 300; ++trial) {
    WindowValues values;
    std::vector<std::vector<float>> all(WindowValues::kWindows);
    const double filled = trial % 10 == 0 ? 0.02 : trial % 10 == 1 ? 1.0 : random.uniform();
    const bool all_equal = trial % 20 == 3;
    for (std::size_t place = 0; place < WindowValues::kPlaces; ++place)
      for (std::size_t n = 0; n < WindowValues::kWindows; ++n) {
        auto value = static_cast<float>(random.normal());
        if (trial % 3 == 1) value = std::round(value);
        if (trial % 3 == 2 && random.uniform() < 0.1) value *= 1e6F;
        if (all_equal) value = 0.5F;
        const bool has_value = random.uniform() < filled;
        values.at[place][n] = has_value ? value : WindowValues::kNone;
        if (has_value) all[n].push_back(value);
      }
    const WindowValues::Row medians = medians_of(values);
    for (std::size_t n = 0; n < all.size(); ++n) {
      std::sort(all[n].begin(), all[n].end());
      EXPECT_EQ(medians[n], all[n].empty() ? 0.0F : all[n][all[n].size() / 2]) << trial;
    }
  }
}

}  // namespace
}  // namespace mapscore
