// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/lab/folder_poses.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace mapscore::eval {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::string odd(const std::vector<double>& stamps_s) {
  std::vector<StampedImage> images;
  for (const double stamp_s : stamps_s) images.push_back({stamp_s, "depth.png"});
  return odd_stamps(images);
}

TEST(OddStamps, AreThoseOfAnotherUnitAndALongGap) {
  EXPECT_EQ(odd({}), "");
  EXPECT_EQ(odd({5.0}), "");
  EXPECT_EQ(odd({0.0, 0.1, 0.2, 60.2}), "");
  EXPECT_EQ(odd({0.0, 0.0001, 0.1, 0.2}), "") << "one pair alone may be close";
  EXPECT_THAT(odd({0.0, 0.1, 60.2, 900.0}), HasSubstr("60.2 s comes 60.1 s after"));
  EXPECT_THAT(odd({7.0, 7.0000001, 7.0000002, 7.0000003}),
              AllOf(HasSubstr("from 7 s on"), HasSubstr("1e-07 s apart"), HasSubstr("seconds")));
  EXPECT_THAT(odd({0.0, 100.0, 200.0}), HasSubstr("100 s comes 100 s after")) << "milliseconds";
}

}  // namespace
}  // namespace mapscore::eval
