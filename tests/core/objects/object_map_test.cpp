// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/objects/object_map.hpp"

#include "core/error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <initializer_list>
#include <limits>

namespace mapscore {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr ClassId kChair = 1, kTable = 2;

ObjectDetection seen(ClassId class_id, const Eigen::Vector3d& low, const Eigen::Vector3d& high,
                     double score = 1.0) {
  return {class_id, oriented(Eigen::AlignedBox3d(low, high)), score, {}};
}

ObjectChanges integrate(ObjectMap& map, const std::vector<ObjectDetection>& frame, double stamp_s) {
  return map.integrate(frame, stamp_s);
}

std::vector<ObjectId> ids(const std::vector<const MapObject*>& objects) {
  std::vector<ObjectId> ids;
  for (const MapObject* object : objects) ids.push_back(object->id);
  return ids;
}

TEST(ObjectMap, AddsThenUpdatesTheNearestOfTheClass) {
  ObjectMap map(3);
  const ObjectChanges first = integrate(
      map, {seen(kChair, {0, 0, 0}, {0.5, 0.5, 1}), seen(kTable, {0, 0, 0}, {0.5, 0.5, 1})}, 1.0);
  EXPECT_THAT(first.added, ElementsAre(1, 2));
  const ObjectChanges second = integrate(map, {seen(kTable, {0.1, 0, 0}, {0.6, 0.5, 1})}, 2.0);
  EXPECT_THAT(second.added, IsEmpty());
  EXPECT_THAT(second.updated, ElementsAre(2));
  EXPECT_EQ(map.find(1)->observations, 1);
  EXPECT_EQ(map.find(2)->observations, 2);
  EXPECT_EQ(map.find(2)->last_seen_s, 2.0);
  EXPECT_NEAR(map.find(2)->box.size_m.x(), 0.6, 1e-12);  // hull
  EXPECT_NEAR(map.find(2)->box.centre().x(), 0.3, 1e-12);
}

TEST(ObjectMap, EachObjectTakesOneDetectionOfAFrame) {
  ObjectMap map(3);
  integrate(map, {seen(kChair, {0, 0, 0}, {0.4, 0.4, 1})}, 0.0);
  const ObjectChanges both = integrate(
      map, {seen(kChair, {0.2, 0, 0}, {0.6, 0.4, 1}), seen(kChair, {0.05, 0, 0}, {0.45, 0.4, 1})},
      1.0);
  EXPECT_THAT(both.updated, ElementsAre(1));  // by the second, which is nearer
  EXPECT_THAT(both.added, ElementsAre(2));
  EXPECT_NEAR(map.find(1)->box.bounds().max().x(), 0.45, 1e-12);
  EXPECT_THAT(both.merged, IsEmpty());  // overlap, but were two in one frame
  EXPECT_THAT(integrate(map, {}, 2.0).merged, IsEmpty());
}

TEST(ObjectMap, MeanWeighsFacesByObservations) {
  ObjectMapParams params;
  params.update.rule = BoxUpdate::mean;
  ObjectMap map(2, params);
  integrate(map, {seen(1, {0, 0, 0}, {1, 1, 1})}, 0.0);
  integrate(map, {seen(1, {0, 0, 0}, {1.3, 1, 1})}, 0.0);
  integrate(map, {seen(1, {0.3, 0, 0}, {1, 1, 1})}, 0.0);
  // x faces: lower 0, 0, then (2 * 0 + 0.3) / 3; upper 1, 1.15, then (2 * 1.15 + 1) / 3.
  EXPECT_NEAR(map.find(1)->box.bounds().min().x(), 0.1, 1e-12);
  EXPECT_NEAR(map.find(1)->box.bounds().max().x(), 1.1, 1e-12);
}

TEST(ObjectMap, QuantileLeavesTheFewWrongViewsAway) {
  ObjectMap map(2);  // share 0.75
  const auto upper_x = [&] { return map.find(1)->box.bounds().max().x(); };
  integrate(map, {seen(1, {0, 0, 0}, {1, 1, 1})}, 0.0);
  integrate(map, {seen(1, {0, 0, 0}, {3, 1, 1})}, 0.0);  // leaked
  EXPECT_NEAR(upper_x(), 3.0, 1e-12);                    // ceil(1.5) = 2nd of 1 3
  integrate(map, {seen(1, {0, 0, 0}, {1.1, 1, 1})}, 0.0);
  EXPECT_NEAR(upper_x(), 3.0, 1e-12);                        // ceil(2.25) = 3rd of 1 1.1 3
  integrate(map, {seen(1, {0.4, 0, 0}, {0.6, 1, 1})}, 0.0);  // a part
  EXPECT_NEAR(upper_x(), 1.1, 1e-12);                        // 3rd of 0.6 1 1.1 3
  EXPECT_NEAR(map.find(1)->box.bounds().min().x(), 0.0, 1e-12);
  EXPECT_EQ(map.find(1)->views.size(), 4u);
}

TEST(ObjectMap, BoxOfAFileCountsAsItsObservations) {
  ObjectMap map(2);
  MapObject known;
  known.class_id = 1;
  known.box = oriented({Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 1, 1)});
  known.observations = 3;
  map.add(known);
  integrate(map, {seen(1, {0, 0, 0}, {2, 1, 1})}, 1.0);
  EXPECT_NEAR(map.find(1)->box.size_m.x(), 1.0, 1e-12);  // 3rd of 1 1 1 2
  integrate(map, {seen(1, {0, 0, 0}, {2, 1, 1})}, 2.0);
  EXPECT_NEAR(map.find(1)->box.size_m.x(), 2.0, 1e-12);  // 4th of 1 1 1 2 2
}

TEST(ObjectMap, QuantileOfATurnedBoxIsAlongItsAxes) {
  ObjectMap map(2);
  ObjectDetection turned = seen(1, {-0.5, -0.2, -0.1}, {0.5, 0.2, 0.1});
  turned.box = moved(exp_pose((Vector6() << 2, 1, 0.5, 0, 0, 0.6).finished()), turned.box);
  for (int frame = 0; frame < 5; ++frame) integrate(map, {turned}, frame);
  const ObjectBox& box = map.find(1)->box;
  EXPECT_TRUE(box.T_frame_box.isApprox(turned.box.T_frame_box, 1e-12));
  EXPECT_TRUE(box.size_m.isApprox(turned.box.size_m, 1e-12));
}

TEST(ObjectMap, PartsThatCameToOverlapAreMerged) {
  ObjectMap map(2);
  integrate(map, {seen(1, {0, 0, 0}, {0.4, 1, 1})}, 0.0);
  integrate(map, {seen(1, {1.6, 0, 0}, {2, 1, 1}, 0.5)}, 1.0);
  ASSERT_EQ(map.objects().size(), 2u);
  const ObjectChanges whole = integrate(map, {seen(1, {0, 0, 0}, {2, 1, 1})}, 2.0);
  EXPECT_THAT(whole.merged, ElementsAre(2));
  ASSERT_EQ(map.objects().size(), 1u);
  const MapObject& object = map.objects().front();
  EXPECT_EQ(object.id, 1u);
  EXPECT_EQ(object.observations, 3);
  EXPECT_NEAR((object.box.size_m - Eigen::Vector3d(2, 1, 1)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(object.confidence, (1 + 1 + 0.5 + 1) / 5.0, 1e-12);
  EXPECT_EQ(object.last_seen_s, 2.0);
}

TEST(ObjectMap, IdsAreNeverGivenTwice) {
  ObjectMap map(2);
  integrate(map, {seen(1, {0, 0, 0}, {1, 1, 1})}, 0.0);
  map.remove(1);
  EXPECT_EQ(map.find(1), nullptr);
  EXPECT_THAT(integrate(map, {seen(1, {0, 0, 0}, {1, 1, 1})}, 0.0).added, ElementsAre(2));
  MapObject later = map.objects().front();
  later.id = 9;
  EXPECT_EQ(map.add(later), 9u);
  later.id = 4;
  EXPECT_THROW((void)map.add(later), Error);
  EXPECT_THROW(map.remove(3), Error);
  EXPECT_THROW(map.update(3, seen(1, {0, 0, 0}, {1, 1, 1}), 0.0), Error);
}

TEST(ObjectMap, QueriesByClassAndPlace) {
  ObjectMap map(3);
  integrate(map,
            {seen(kChair, {0, 0, 0}, {1, 1, 1}), seen(kTable, {3, 0, 0}, {4, 1, 1}),
             seen(kChair, {6, 0, 0}, {7, 1, 1})},
            0.0);
  EXPECT_THAT(ids(map.of_class(kChair)), ElementsAre(1, 3));
  EXPECT_THAT(ids(map.in_box({Eigen::Vector3d(0.9, 0, 0), Eigen::Vector3d(3, 1, 1)})),
              ElementsAre(1, 2));
  EXPECT_THAT(ids(map.in_box({Eigen::Vector3d(0.9, 0, 0), Eigen::Vector3d(3, 1, 1)}, kTable)),
              ElementsAre(2));
  EXPECT_THAT(ids(map.in_box({})), IsEmpty());
  EXPECT_THAT(ids(map.within({5.5, 0.5, 0.5}, 2.0)), ElementsAre(3, 2));
  EXPECT_THAT(ids(map.within({5.5, 0.5, 0.5}, 9.0, kChair)), ElementsAre(3, 1));
  EXPECT_EQ(map.nearest({2.0, 0.5, 0.5})->id, 1u);  // as near as 2
  EXPECT_EQ(map.nearest({2.0, 0.5, 0.5}, kTable)->id, 2u);
  EXPECT_EQ(ObjectMap(3).nearest({0, 0, 0}), nullptr);
}

TEST(ObjectMap, BadDetectionsLeaveTheMapAsItWas) {
  ObjectMap map(3);
  integrate(map, {seen(kChair, {0, 0, 0}, {1, 1, 1})}, 0.0);
  const ObjectDetection good = seen(kChair, {0, 0, 0}, {2, 2, 2});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  ObjectDetection bad_box = good;
  bad_box.box.size_m.x() = nan;
  for (const ObjectDetection& bad : {seen(3, {0, 0, 0}, {1, 1, 1}), seen(0, {0, 0, 0}, {1, 1, 1}),
                                     seen(kChair, {0, 0, 0}, {1, 1, 1}, 0.0),
                                     seen(kChair, {0, 0, 0}, {1, 1, 1}, nan), bad_box}) {
    EXPECT_THROW(integrate(map, {good, bad}, 1.0), Error);
    EXPECT_EQ(map.find(1)->observations, 1);
    EXPECT_EQ(map.find(1)->box.size_m, Eigen::Vector3d(1, 1, 1));
  }
}

TEST(ObjectMap, RefusesStampsRotationsAndCountsThatAreNone) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  ObjectMap map(3);
  const ObjectDetection good = seen(kChair, {0, 0, 0}, {1, 1, 1});
  integrate(map, {good}, 1.0);
  const auto unchanged = [&] {
    return map.objects().size() == 1 && map.find(1)->observations == 1 &&
           map.find(1)->last_seen_s == 1.0;
  };
  EXPECT_THROW(integrate(map, {good}, nan), Error);
  EXPECT_THROW(map.update(1, good, nan), Error);
  for (const double bad : {0.0, 2.0, -1.0, 1.01}) {  // times the x axis
    ObjectDetection turned = good;
    turned.box.T_frame_box.linear().col(0) *= bad;
    EXPECT_THROW(integrate(map, {turned}, 2.0), Error) << bad;
    EXPECT_THROW(map.update(1, turned, 2.0), Error) << bad;
  }
  MapObject object;
  object.class_id = kChair;
  object.box = good.box;
  for (const auto& spoil : std::initializer_list<void (*)(MapObject&)>{
           [](MapObject& o) { o.last_seen_s = std::numeric_limits<double>::infinity(); },
           [](MapObject& o) { o.observations = -1; },
           [](MapObject& o) { o.confidence = std::numeric_limits<double>::quiet_NaN(); },
           [](MapObject& o) { o.box.T_frame_box.linear().setZero(); }}) {
    MapObject bad = object;
    spoil(bad);
    EXPECT_THROW((void)map.add(bad), Error);
  }
  EXPECT_TRUE(unchanged());
  EXPECT_EQ(map.add(object), 2u);
}

TEST(ObjectMap, RefusesParametersOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(ObjectMap(0), Error);
  ObjectMapParams params;
  params.max_age = 0;
  EXPECT_THROW(ObjectMap(3, params), Error);
  params = {};
  params.update.share = 0.0;
  EXPECT_THROW(ObjectMap(3, params), Error);
  params = {};
  params.gate.max_distance_m = nan;
  EXPECT_THROW(ObjectMap(3, params), Error);
  params = {};
  params.gate.margin_m = std::numeric_limits<double>::infinity();
  EXPECT_THROW(ObjectMap(3, params), Error);
}

}  // namespace
}  // namespace mapscore
