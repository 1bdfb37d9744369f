// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "core/mapping/semantic_map.hpp"
#include "tests/core/not_finite.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace mapscore {
namespace {

using testing::kInf;
using testing::kNan;

const std::string kHeader = "# Octomap OcTree file\nid SemanticOcTree\nsize 17\nres 0.1\ndata\n";

/// The chain of nodes of a map of one voxel, which holds these log-odds and beliefs.
std::string nodes_of(float log_odds, const std::vector<ClassProbability>& entries) {
  std::string bytes;
  const auto append = [&](auto value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  for (int depth = 0; depth < 16; ++depth)
    append(0.5f), append(std::uint16_t{0}), append(std::uint8_t{1});
  append(log_odds), append(static_cast<std::uint16_t>(entries.size()));
  for (const ClassProbability& entry : entries) append(entry.class_id), append(entry.probability);
  append(std::uint8_t{0});
  return bytes;
}

/// What reading these bytes says; nothing where they are taken.
std::string refusal_of(const std::string& bytes) {
  std::istringstream stream(bytes);
  try {
    (void)SemanticOcTree::read_whole(stream);
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

::testing::AssertionResult refused(const std::string& bytes, const std::string& why) {
  const std::string line = refusal_of(bytes);
  if (line.find(why) == std::string::npos || std::count(line.begin(), line.end(), '\n') > 0)
    return ::testing::AssertionFailure() << "says \"" << line << "\", not \"" << why << '"';
  return ::testing::AssertionSuccess();
}

TEST(DamagedMap, OneThatIsWholeIsTaken) {
  EXPECT_EQ(refusal_of(kHeader + nodes_of(0.5f, {{1, 0.25}, {7, 0.0}, {kOtherClasses, 0.5}})), "");
}

TEST(DamagedMap, WeightsAreNumbersOfAtLeastZero) {
  for (const double weight : {kNan, -0.25, kInf})
    EXPECT_TRUE(refused(kHeader + nodes_of(0.5f, {{7, weight}}), "weight")) << weight;
}

TEST(DamagedMap, ClassesAscend) {
  EXPECT_TRUE(refused(kHeader + nodes_of(0.5f, {{7, 0.25}, {7, 0.25}}), "ascend"));
  EXPECT_TRUE(refused(kHeader + nodes_of(0.5f, {{7, 0.25}, {3, 0.25}}), "ascend"));
}

TEST(DamagedMap, LogOddsAreFinite) {
  for (const double log_odds : {kNan, kInf, -kInf})
    EXPECT_TRUE(refused(kHeader + nodes_of(static_cast<float>(log_odds), {}), "log-odds"));
}

TEST(DamagedMap, SaysWhenItIsCutShort) {
  const std::string nodes = nodes_of(0.5f, {{7, 0.25}});
  for (std::size_t kept = 0; kept < nodes.size(); ++kept)
    EXPECT_TRUE(refused(kHeader + nodes.substr(0, kept), "cut short")) << kept;
  EXPECT_TRUE(refused(kHeader + nodes + "x", "do not fit its header"));
}

TEST(DamagedMap, SaysWhenItsHeaderNamesNoType) {
  std::string header = kHeader;
  header.erase(header.find("id "), std::string("id SemanticOcTree\n").size());
  EXPECT_TRUE(refused(header + nodes_of(0.5f, {}), "no line `id`"));
  header = kHeader;
  header.replace(header.find("Semantic"), 8, "Color");
  EXPECT_TRUE(refused(header + nodes_of(0.5f, {}), "a ColorOcTree, not a semantic map"));
}

TEST(Beliefs, ThatAreNoneAreRefusedAndTheMapStays) {
  SemanticMap map(0.1);
  map.fuse(std::vector<VoxelHit>{{{0, 0, 0}, 1, 1, 1.0}}, 1, VoteRule{});
  for (const std::vector<ClassProbability>& bad :
       {std::vector<ClassProbability>{{1, kNan}}, {{1, -1.0}}, {{1, kInf}}, {{2, 0.5}, {1, 0.5}}})
    EXPECT_THROW(map.set_beliefs({0, 0, 0}, ClassBeliefs(bad)), Error);
  ASSERT_EQ(map.classes_at({0, 0, 0}).size(), 1u);
  EXPECT_EQ(map.classes_at({0, 0, 0})[0], (ClassProbability{1, 1.0}));
}

TEST(Export, ClassesBeyondTheTableAreRefusedAndNothingIsWritten) {
  const auto file = std::filesystem::path(::testing::TempDir()) / "mapscore_beyond_table.ot";
  SemanticMap map(0.1);
  map.fuse(std::vector<VoxelHit>{{{0, 0, 0}, 4, 1, 1.0}}, 1, VoteRule{});
  EXPECT_THROW(map.export_color(file, ClassTable{}, 0.2), Error);
  EXPECT_FALSE(std::filesystem::exists(file));
}

}  // namespace
}  // namespace mapscore
