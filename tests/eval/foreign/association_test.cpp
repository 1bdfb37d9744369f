// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/foreign/association.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mapscore::eval {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<Association> pairs(const std::vector<double>& a, const std::vector<double>& b,
                               double most) {
  return associate(a, b, most);
}

TEST(Association, NearestPairsFirstEachStampOnce) {
  // 1.00 is nearer to 1.01 than 1.03 is, so 1.03 has to do with 1.06.
  EXPECT_THAT(pairs({1.00, 1.03}, {1.01, 1.06}, 0.05),
              ElementsAre(Association{0, 0}, Association{1, 1}));
  // 1.02 takes 1.01; nothing within the tolerance is left for 1.00.
  EXPECT_THAT(pairs({0.98, 1.01}, {1.005}, 0.03), ElementsAre(Association{1, 0}));
}

TEST(Association, ToleranceIsLeftOut) {
  EXPECT_THAT(pairs({1.0}, {1.5}, 0.5), IsEmpty());
  EXPECT_THAT(pairs({1.0}, {1.4999}, 0.5), ElementsAre(Association{0, 0}));
  EXPECT_THAT(pairs({1.5}, {1.0}, 0.5), IsEmpty());
  EXPECT_THAT(pairs({}, {1.0}, 0.5), IsEmpty());
}

TEST(Association, TiesGoToTheEarlierStamp) {
  EXPECT_THAT(pairs({1.0}, {0.75, 1.25}, 0.5), ElementsAre(Association{0, 0}));
  EXPECT_THAT(pairs({0.75, 1.25}, {1.0}, 0.5), ElementsAre(Association{0, 0}));
}

}  // namespace
}  // namespace mapscore::eval
