// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/world/world.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

// What scenes/README.md promises of the two homes.
namespace mapscore::sim {
namespace {

const std::filesystem::path kScenes = std::filesystem::path(MAPSCORE_SOURCE_DIR) / "scenes";

World load_home(const std::string& name) {
  return World::load({kScenes / (name + ".xml"), std::nullopt, kScenes / "robot.xml"}, {});
}

std::map<std::string, int> instances_by_class(const World& world) {
  std::map<std::string, int> count;
  const ClassTable& table = world.classes();
  for (const Instance& instance : table.instances)
    ++count[table.classes.at(table.class_of(instance.id)).name];
  return count;
}

/// The middle of all that is drawn of an instance.
Eigen::Vector3d middle_of(const World& world, const std::string& name) {
  const auto& instances = world.classes().instances;
  const auto found = std::find_if(instances.begin(), instances.end(),
                                  [&](const Instance& instance) { return instance.name == name; });
  if (found == instances.end()) throw std::runtime_error(name + " is not in the scene");
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int shapes = 0;
  for (const Shape& shape : world.shapes()) {
    if (shape.instance != found->id) continue;
    sum += shape.T_world_shape.translation();
    ++shapes;
  }
  return sum / shapes;
}

struct Room {
  Eigen::AlignedBox2d floor;
  std::vector<std::string> things;
};

void expect_furnished(const World& world, const std::vector<Room>& rooms) {
  for (const Room& room : rooms) {
    for (const std::string& thing : room.things) {
      const Eigen::Vector3d middle = middle_of(world, thing);
      EXPECT_TRUE(room.floor.contains(middle.head<2>()))
          << thing << " stands at " << middle.transpose();
    }
  }
}

Eigen::AlignedBox2d floor_of(double x0, double x1, double y0, double y1) {
  return {Eigen::Vector2d(x0, y0), Eigen::Vector2d(x1, y1)};
}

class Homes : public ::testing::TestWithParam<std::string> {};

TEST_P(Homes, HaveThePapersFiveClassesSeveralTimesOver) {
  std::map<std::string, int> count = instances_by_class(load_home(GetParam()));
  EXPECT_GE(count["cup"], 8);
  EXPECT_GE(count["bottle"], 8);
  EXPECT_GE(count["chair"], 5);
  EXPECT_GE(count["oven"], 2);
  EXPECT_GE(count["tv"], 3);
}

TEST_P(Homes, HaveEverythingOfAHome) {
  std::map<std::string, int> count = instances_by_class(load_home(GetParam()));
  for (const char* name :
       {"table", "sofa", "bed", "fridge", "sink", "lamp", "book", "plant", "door", "window",
        "curtain", "picture", "toilet", "bath", "wardrobe", "shelf", "rug"}) {
    EXPECT_GE(count[name], 1) << name;
  }
}

TEST_P(Homes, LeaveNoBodyWithoutAClass) {
  const World world = load_home(GetParam());
  EXPECT_THAT(world.unmatched_bodies(), ::testing::IsEmpty());
  std::vector<std::string> detected;
  for (const SemanticClass& c : world.classes().classes)
    if (c.detect) detected.push_back(c.name);
  EXPECT_THAT(detected, ::testing::ElementsAre("cup", "bottle", "chair", "oven", "tv"));
}

INSTANTIATE_TEST_SUITE_P(Both, Homes, ::testing::Values("home", "cottage"),
                         [](const auto& suite) { return suite.param; });

TEST(Home, HoldsAsManyAsPromised) {
  const World world = load_home("home");
  EXPECT_GE(world.classes().instances.size(), 180u);
  EXPECT_GE(instances_by_class(world).size(), 45u);
}

TEST(Cottage, HoldsAsManyAsPromised) {
  const World world = load_home("cottage");
  EXPECT_GE(world.classes().instances.size(), 130u);
  EXPECT_GE(instances_by_class(world).size(), 45u);
}

TEST(Home, HasFiveFurnishedRooms) {
  expect_furnished(
      load_home("home"),
      {{floor_of(0.013, 4.713, 0.027, 4.127), {"sofa_1", "tv_1", "table_1", "shelf_1"}},
       {floor_of(0.013, 4.713, 4.225, 7.427), {"fridge_1", "oven_1", "oven_2", "chair_1", "hob_1"}},
       {floor_of(4.811, 6.013, 0.027, 7.427), {"shelf_2", "mirror_1"}},
       {floor_of(6.111, 9.613, 2.325, 7.427), {"bed_1", "wardrobe_1", "laptop_1"}},
       {floor_of(6.111, 9.613, 0.027, 2.227), {"toilet_1", "bath_1", "washing_machine_1"}}});
}

TEST(Cottage, HasFourFurnishedRooms) {
  expect_furnished(load_home("cottage"),
                   {{floor_of(0.021, 7.921, 2.915, 6.715),
                     {"sofa_1", "tv_1", "shelf_1", "fridge_1", "oven_1", "oven_2", "chair_1"}},
                    {floor_of(3.621, 5.119, 0.015, 2.817), {"mirror_1", "basket_1"}},
                    {floor_of(0.021, 3.523, 0.015, 2.817), {"bed_1", "wardrobe_1", "laptop_1"}},
                    {floor_of(5.217, 7.921, 0.015, 2.817), {"toilet_1", "bath_1", "towel_1"}}});
}

TEST(HomesClasses, BearTheSameIdsInBoth) {
  const World home = load_home("home"), cottage = load_home("cottage");
  const auto& a = home.classes().classes;
  const auto& b = cottage.classes().classes;
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].name, b[i].name);
    EXPECT_EQ(a[i].id, b[i].id);
  }
}

}  // namespace
}  // namespace mapscore::sim
