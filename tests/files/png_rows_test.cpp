// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "files/png_rows.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace mapscore::eval {
namespace {

/// Two rows of three one-byte pixels: 10 20 30 / 13 19 44, the second under each filter; the
/// differences are worked out by hand from the specification.
struct Case {
  const char* name;
  std::vector<std::uint8_t> second;  ///< filter, three differences
};
void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

class EveryFilter : public ::testing::TestWithParam<Case> {};

TEST_P(EveryFilter, IsUndone) {
  std::vector<std::uint8_t> rows{0, 10, 20, 30};
  rows.insert(rows.end(), GetParam().second.begin(), GetParam().second.end());
  ASSERT_TRUE(unfilter_rows(rows.data(), {2, 3, 1}));
  EXPECT_EQ(std::vector<std::uint8_t>(rows.begin() + 5, rows.end()),
            (std::vector<std::uint8_t>{13, 19, 44}));
}

INSTANTIATE_TEST_SUITE_P(
    Png, EveryFilter,
    ::testing::Values(
        Case{"none", {0, 13, 19, 44}}, Case{"sub", {1, 13, 6, 25}},
        Case{"up", {2, 3, 255, 14}},  // 19 - 20 wraps
        // average: 13 - 10/2, 19 - (13 + 20)/2, 44 - (19 + 30)/2
        Case{"average", {3, 8, 3, 20}},
        // paeth: above 10; p = 13 + 20 - 10 = 23 is nearest 20; p = 19 + 30 - 20 = 29, 30
        Case{"paeth", {4, 3, 255, 14}}));

TEST(PngRows, UnknownFilterIsNoticed) {
  std::vector<std::uint8_t> rows{5, 1, 2, 3};
  EXPECT_FALSE(unfilter_rows(rows.data(), {1, 3, 1}));
}

TEST(PngRows, FilteringIsUndone) {
  const std::string image("\x10\xff\x03\x80\x7f\x00", 6);
  std::string filtered = filter_rows(image, {3, 2, 1});
  ASSERT_EQ(filtered.size(), 9u);
  ASSERT_TRUE(unfilter_rows(reinterpret_cast<std::uint8_t*>(filtered.data()), {3, 2, 1}));
  EXPECT_EQ(filtered.substr(1, 2) + filtered.substr(4, 2) + filtered.substr(7, 2), image);
}

}  // namespace
}  // namespace mapscore::eval
