// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "core/geometry/pose.hpp"
#include "core/mapping/semantic_map.hpp"
#include "core/placement/placement.hpp"
#include "core/placement/pose_belief.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <octomap/ColorOcTree.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <string>

namespace mapscore {
namespace {

constexpr double kFineEdge = 0.05;
const Pose kHere = Pose::Identity();

ObservedObject object(ClassId class_id, std::vector<Eigen::Vector3d> positions,
                      double score = 1.0) {
  return {class_id, score, std::move(positions)};
}

double probability(const SemanticMap& map, const VoxelKey& key, ClassId class_id) {
  for (const ClassProbability& entry : map.classes_at(key))
    if (entry.class_id == class_id) return entry.probability;
  return 0.0;
}

TEST(Place, ClassOfMostPositionsWinsAndTiesGoToTheLowerId) {
  const Observation observation{
      object(2, {{0.01, 0.01, 0.01}, {0.02, 0.01, 0.01}, {0.06, 0.01, 0.01}}),
      object(1, {{0.03, 0.01, 0.01}, {0.07, 0.01, 0.01}})};
  const auto hits = place(observation, {&kHere, 1}, kFineEdge);
  ASSERT_EQ(hits.size(), 2u);
  EXPECT_EQ(hits[0].key, (VoxelKey{0, 0, 0}));
  EXPECT_EQ(hits[0].class_id, 2);
  EXPECT_EQ(hits[1].key, (VoxelKey{1, 0, 0}));
  EXPECT_EQ(hits[1].class_id, 1);
}

TEST(Place, CountsPositionsOfAllObjectsOfAClassTogether) {
  const Observation observation{object(3, {{0.01, 0, 0}}), object(2, {{0.02, 0, 0}, {0.02, 0, 0}}),
                                object(3, {{0.03, 0, 0}, {0.04, 0, 0}}, 0.5)};
  const auto hits = place(observation, {&kHere, 1}, kFineEdge);
  ASSERT_EQ(hits.size(), 1u);
  EXPECT_EQ(hits[0].class_id, 3);
  EXPECT_DOUBLE_EQ(hits[0].score_sum, 1.0);
}

TEST(Place, NegativeCoordinatesFloorDownwards) {
  const auto hits = place({object(1, {{-0.001, -0.05, 0.05}})}, {&kHere, 1}, kFineEdge);
  ASSERT_EQ(hits.size(), 1u);
  EXPECT_EQ(hits[0].key, (VoxelKey{-1, -1, 1}));
}

TEST(Place, CountsTheDrawsThatEachClassWon) {
  Pose shifted = Pose::Identity();
  shifted.translation() = Eigen::Vector3d(0.05, 0, 0);
  const std::vector<Pose> draws{kHere, shifted, shifted};
  const Observation observation{object(1, {{0.01, 0, 0}}), object(2, {{0.06, 0, 0}, {0.06, 0, 0}})};
  const auto hits = place(observation, draws, kFineEdge);
  ASSERT_EQ(hits.size(),
            4u);  // voxel 0: class 1 once; voxel 1: class 1 twice, class 2 once; voxel 2: class 2
  EXPECT_EQ(hits[0].draws, 1);
  EXPECT_EQ(hits[1].class_id, 1);
  EXPECT_EQ(hits[1].draws, 2);
  EXPECT_EQ(hits[2].class_id, 2);
  EXPECT_EQ(hits[2].draws, 1);
  EXPECT_EQ(hits[3].key, (VoxelKey{2, 0, 0}));
  EXPECT_EQ(hits[3].draws, 2);
}

TEST(Blend, FirstFullHitGivesOneMinusK) {
  SemanticMap map(kFineEdge);
  map.fuse(std::vector<VoxelHit>{{{0, 0, 0}, 1, 1, 1.0}}, 1, BlendRule{0.3});
  EXPECT_DOUBLE_EQ(probability(map, {0, 0, 0}, 1), 0.7);
}

TEST(Blend, ThirtyOfThirtyDrawsGiveExactlyAHalf) {
  SemanticMap map(kFineEdge);
  map.fuse(std::vector<VoxelHit>{{{0, 0, 0}, 1, 30, 30.0}, {{1, 0, 0}, 1, 15, 15.0}}, 30,
           BlendRule{0.5});
  EXPECT_EQ(probability(map, {0, 0, 0}, 1), 0.5);
  EXPECT_EQ(probability(map, {1, 0, 0}, 1), 0.25);
}

TEST(Blend, FollowsTheFormulaByHandOverThreeFrames) {
  SemanticMap map(kFineEdge);  // K = 0.8, N = 4
  const VoxelKey key{3, -2, 7};
  map.fuse(std::vector<VoxelHit>{{key, 1, 4, 4.0}}, 4, BlendRule{0.8});
  map.fuse(std::vector<VoxelHit>{{key, 1, 1, 1.0}, {key, 2, 2, 1.8}}, 4, BlendRule{0.8});
  map.fuse(std::vector<VoxelHit>{{key, 2, 4, 4.0}}, 4, BlendRule{0.8});
  EXPECT_NEAR(probability(map, key, 1), 0.8 * (0.8 * 0.2 + 0.2 * 0.25), 1e-15);
  EXPECT_NEAR(probability(map, key, 2), 0.8 * (0.2 * 0.45) + 0.2, 1e-15);
}

TEST(Blend, VoxelsThatNoDrawHitKeepTheirValue) {
  SemanticMap map(kFineEdge);
  map.fuse(std::vector<VoxelHit>{{{0, 0, 0}, 1, 1, 1.0}}, 1, BlendRule{0.5});
  map.fuse(std::vector<VoxelHit>{{{9, 0, 0}, 1, 1, 1.0}}, 1, BlendRule{0.5});
  EXPECT_EQ(probability(map, {0, 0, 0}, 1), 0.5);
}

TEST(Blend, CountsHitsBeyondTheOctreeAndKeepsTheRest) {
  SemanticMap map(kFineEdge);
  map.fuse(std::vector<VoxelHit>{{{40000, 0, 0}, 1, 1, 1.0}, {{40001, 0, 0}, 1, 1, 1.0}}, 1,
           BlendRule{0.5});
  map.fuse(std::vector<VoxelHit>{{{32767, -32768, 0}, 1, 1, 1.0}}, 1, BlendRule{0.5});
  EXPECT_EQ(map.hits_beyond_span(), 2u);
  ASSERT_EQ(map.voxels().size(), 1u);
  EXPECT_EQ(map.voxels()[0].key, (VoxelKey{32767, -32768, 0}));
}

class MapFile : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(::testing::TempDir()) /
              ::testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::create_directories(folder_);
    for (int i = 0; i < 8; ++i)  // a full block of eight, which pruning would merge
      map_.fuse(std::vector<VoxelHit>{{{i & 1, i >> 1 & 1, i >> 2}, 1, 1, 1.0}}, 1, BlendRule{0.5});
    map_.fuse(std::vector<VoxelHit>{{{5, -3, 2}, 2, 1, 0.8}}, 1, BlendRule{0.5});
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_;
  SemanticMap map_{kFineEdge};
};

TEST_F(MapFile, LoadsWhatWasSaved) {
  map_.save(folder_ / "map.ot");
  const SemanticMap loaded = SemanticMap::load(folder_ / "map.ot");
  EXPECT_EQ(loaded.edge_m(), kFineEdge);
  const auto before = map_.voxels(), after = loaded.voxels();
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(after[i].key, before[i].key);
    EXPECT_EQ(after[i].best_class, before[i].best_class);
    EXPECT_EQ(after[i].probability, before[i].probability);
  }
}

TEST_F(MapFile, ColourExportIsAnOrdinaryColorOcTree) {
  ClassTable table;
  table.classes.push_back({1, "cup", {255, 0, 0}, true});
  table.classes.push_back({2, "bottle", {0, 255, 0}, true});
  map_.export_color(folder_ / "colour.ot", table, 0.45);
  const std::unique_ptr<octomap::AbstractOcTree> read(
      octomap::AbstractOcTree::read((folder_ / "colour.ot").string()));
  auto* tree = dynamic_cast<octomap::ColorOcTree*>(read.get());
  ASSERT_NE(tree, nullptr);
  const auto* cup = tree->search(octree_key({1, 1, 0}));
  ASSERT_NE(cup, nullptr);
  EXPECT_EQ(cup->getColor(), octomap::ColorOcTreeNode::Color(255, 0, 0));
  EXPECT_TRUE(tree->isNodeOccupied(cup));
  EXPECT_EQ(tree->search(octree_key({5, -3, 2})), nullptr) << "0.4 lies below the threshold";
}

TEST_F(MapFile, RefusesEveryTruncation) {
  map_.save(folder_ / "map.ot");
  const auto size = std::filesystem::file_size(folder_ / "map.ot");
  for (std::uintmax_t kept = 0; kept < size; ++kept) {
    std::filesystem::resize_file(folder_ / "map.ot", kept);
    EXPECT_THROW((void)SemanticMap::load(folder_ / "map.ot"), Error) << kept << " bytes";
    map_.save(folder_ / "map.ot");
  }
}

/// A semantic map's file, by hand: nodes one below the other, without classes.
std::string chain_of(int nodes) {
  std::string bytes = "# Octomap OcTree file\nid SemanticOcTree\nsize " + std::to_string(nodes) +
                      "\nres 0.1\ndata\n";
  for (int n = 0; n < nodes; ++n) {
    bytes.append(6, '\0');  // log-odds and number of classes
    bytes.push_back(n + 1 < nodes ? '\1' : '\0');
  }
  return bytes;
}

TEST_F(MapFile, RefusesNodesBelowTheFinestAndLeavesThatCoverTooMuch) {
  const auto load = [&](int nodes) {
    std::ofstream(folder_ / "map.ot", std::ios::binary) << chain_of(nodes);
    return SemanticMap::load(folder_ / "map.ot").voxels().size();
  };
  EXPECT_EQ(load(17), 1u);
  EXPECT_EQ(load(15), 64u);
  EXPECT_THROW((void)load(18), Error);
  EXPECT_THROW((void)load(1'000'000), Error) << "each node would be a call";
  EXPECT_THROW((void)load(1), Error) << "the root alone covers 2^48 voxels";
  EXPECT_THROW((void)load(8), Error) << "2^27 voxels";
}

TEST_F(MapFile, AnEmptyMapIsSavedLoadedAndExported) {
  const SemanticMap empty(kFineEdge);
  empty.save(folder_ / "empty.ot");
  EXPECT_TRUE(SemanticMap::load(folder_ / "empty.ot").voxels().empty());
  empty.export_color(folder_ / "colour.ot", ClassTable{}, 0.25);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "colour.ot"));
}

TEST_F(MapFile, RefusesAnotherTypeOfTree) {
  map_.export_color(folder_ / "colour.ot", ClassTable{}, 0.9);
  EXPECT_THROW((void)SemanticMap::load(folder_ / "colour.ot"), Error);
}

TEST_F(MapFile, RefusesAFolderThatIsNotThere) {
  EXPECT_THROW(map_.save(folder_ / "no" / "map.ot"), Error);
}

TEST(DrawPoses, ZeroCovarianceGivesTheMeanBitForBit) {
  PoseBelief belief;
  belief.T_map_odom = planar_pose(1.0, 2.0, 0.3);
  belief.T_odom_base = planar_pose(-4.0, 0.1, 1.1);
  RandomStream stream(1, "test");
  const auto poses = draw_poses(belief, Draws{3, NoiseAt::base, CovarianceUse::full}, stream);
  const Pose mean = belief.T_map_odom * belief.T_odom_base;
  for (const Pose& pose : poses) EXPECT_EQ(pose.matrix(), mean.matrix());
}

/// Covariance of log(T_mean^-1 T_drawn) over many draws.
Covariance6 sampled_covariance(const PoseBelief& belief, NoiseAt noise_at, CovarianceUse use) {
  constexpr int kDraws = 40000;
  RandomStream stream(7, "covariance");
  const Pose mean = belief.T_map_odom * belief.T_odom_base;
  Covariance6 sum = Covariance6::Zero();
  for (const Pose& pose : draw_poses(belief, Draws{kDraws, noise_at, use}, stream)) {
    const Vector6 xi = log_pose(mean.inverse() * pose);
    sum += xi * xi.transpose();
  }
  return sum / kDraws;
}

class CovarianceAtDistance : public ::testing::TestWithParam<double> {};

TEST_P(CovarianceAtDistance, SampledEqualsInjected) {
  PoseBelief belief;
  belief.T_odom_base = planar_pose(GetParam(), -GetParam(), 0.7);
  Vector6 sigma;
  sigma << 0.02, 0.03, 0.01, 0.005, 0.008, 0.02;
  belief.covariance = sigma.cwiseAbs2().asDiagonal();
  belief.covariance(0, 5) = belief.covariance(5, 0) = 0.5 * sigma[0] * sigma[5];
  const Covariance6 sampled = sampled_covariance(belief, NoiseAt::base, CovarianceUse::full);
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column < 6; ++column)
      EXPECT_NEAR(sampled(row, column), belief.covariance(row, column),
                  0.03 * sigma[row] * sigma[column]);
}

INSTANTIATE_TEST_SUITE_P(FromTheOrigin, CovarianceAtDistance, ::testing::Values(0.0, 10.0));

TEST(DrawPoses, NoiseAtOdomTurnsAboutTheOdomOrigin) {
  PoseBelief belief;
  belief.T_odom_base = planar_pose(10.0, 0.0, 0.0);
  belief.covariance(5, 5) = 0.01 * 0.01;
  const Covariance6 at_odom = sampled_covariance(belief, NoiseAt::odom, CovarianceUse::diagonal);
  EXPECT_NEAR(std::sqrt(at_odom(1, 1)), 0.1, 0.003) << "0.01 rad at 10 m";
  const Covariance6 at_base = sampled_covariance(belief, NoiseAt::base, CovarianceUse::diagonal);
  EXPECT_LT(std::sqrt(at_base(1, 1)), 1e-9);
}

TEST(DrawPoses, DiagonalUseDropsTheCorrelation) {
  PoseBelief belief;
  belief.covariance.diagonal() << 0.01, 0.01, 0, 0, 0, 0;
  belief.covariance(0, 1) = belief.covariance(1, 0) = 0.0099;
  const Covariance6 sampled = sampled_covariance(belief, NoiseAt::base, CovarianceUse::diagonal);
  EXPECT_LT(std::abs(sampled(0, 1)), 3e-4);
}

TEST(DrawPoses, RefusesBadInputHoweverTheCovarianceIsUsed) {
  RandomStream stream(1, "test");
  const std::uint64_t next = RandomStream(stream).bits();
  for (const CovarianceUse use : {CovarianceUse::full, CovarianceUse::diagonal}) {
    const auto refused = [&](int row, int column, double value) {
      PoseBelief belief;
      belief.covariance.diagonal().setConstant(1e-4);
      belief.covariance(row, column) = value;
      if (value > 1.0) belief.covariance(column, row) = value;  // symmetric, but beyond +-1e-4
      EXPECT_THROW((void)draw_poses(belief, Draws{1, NoiseAt::base, use}, stream), Error) << value;
    };
    EXPECT_THROW((void)draw_poses({}, Draws{0, NoiseAt::base, use}, stream), Error);
    refused(0, 0, -1e-4);
    refused(0, 1, 1e-5);
    refused(0, 1, 2.0);
    refused(3, 2, std::numeric_limits<double>::quiet_NaN());
  }
  EXPECT_EQ(stream.bits(), next) << "nothing was drawn";
}

}  // namespace
}  // namespace mapscore
