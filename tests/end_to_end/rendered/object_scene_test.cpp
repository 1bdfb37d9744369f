// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/end_to_end/program.hpp"
#include "tests/end_to_end/tiny_study.hpp"

#include <gmock/gmock.h>

namespace mapscore::testing {
namespace {

using ObjectScene = TinyStudy;
using ::testing::HasSubstr;

TEST_F(ObjectScene, IsLoadedAsAScene) {
  expect_done(mapscore({"objects", path("tiny"), "-o", path("map"), "-q"}));
  const Outcome info = mapscore({"info", path("map/objects.xml"), "--no_picture"});
  expect_done(info);
  EXPECT_THAT(info.out, HasSubstr("scene of 1 drawn surfaces"));
  EXPECT_THAT(info.out, HasSubstr("crate"));
}

}  // namespace
}  // namespace mapscore::testing
