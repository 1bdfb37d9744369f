// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/reduced_tables.hpp"

#include "tests/eval/score/instances/instance_cases.hpp"

#include <gtest/gtest.h>

namespace mapscore::eval {
namespace {

using testing::cups_and_chairs;

TEST(ReducedTables, EveryInstanceIsAClass) {
  const ClassTable reduced = instance_table(cups_and_chairs());
  ASSERT_EQ(reduced.classes.size(), 6u);
  ASSERT_EQ(reduced.instances.size(), 6u);
  for (ClassId id = 0; id < 6; ++id) {
    EXPECT_EQ(reduced.classes[id].id, id);
    EXPECT_EQ(reduced.class_of(id), id);
    EXPECT_EQ(reduced.detected(id), id >= 1 && id <= 4) << id;
  }
  EXPECT_EQ(reduced.classes[4].name, "chair_2");
  EXPECT_EQ(reduced.class_of(99), kBackground);
}

TEST(ReducedTables, EverySurfaceIsOneClass) {
  const ClassTable reduced = geometry_table(cups_and_chairs());
  ASSERT_EQ(reduced.classes.size(), 2u);
  EXPECT_EQ(reduced.classes[1].name, "surface");
  EXPECT_FALSE(reduced.detected(0));
  EXPECT_TRUE(reduced.detected(kSurfaceClass));
  for (InstanceId id = 0; id < 6; ++id) EXPECT_EQ(reduced.class_of(id), kSurfaceClass);
}

}  // namespace
}  // namespace mapscore::eval
