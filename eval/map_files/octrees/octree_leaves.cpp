// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/map_files/octrees/octree_leaves.hpp"

#include "core/fusion/class_beliefs.hpp"
#include "core/mapping/semantic_octree.hpp"
#include "eval/map_files/refusal.hpp"

#include <fmt/format.h>
#include <octomap/OcTree.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace mapscore::eval {
namespace {

constexpr int kLevels = 16;

/// What rounding may add to a sum of probabilities.
constexpr double kRounding = 1e-6;

/// A node's cube: 2^level finest voxels on each side.
struct Cube {
  VoxelKey low{-(1 << (kLevels - 1)), -(1 << (kLevels - 1)), -(1 << (kLevels - 1))};
  int level = kLevels;

  /// OctoMap's order of children: bit 0 is x, bit 1 is y, bit 2 is z.
  [[nodiscard]] Cube child(int index) const {
    const std::int32_t half = 1 << (level - 1);
    return {{low.i + half * (index & 1), low.j + half * (index >> 1 & 1),
             low.k + half * (index >> 2 & 1)},
            level - 1};
  }
};

/// The nodes' bytes, front to back, and the count of nodes.
class NodeReader {
 public:
  NodeReader(std::string_view bytes, const OctreeHeader& header, const std::filesystem::path& file,
             const std::function<void(const OctreeLeaf&)>& on_leaf)
      : bytes_(bytes), header_(header), file_(file), on_leaf_(on_leaf) {}

  void read_all() {
    if (header_.kind == OctreeKind::binary) {
      count_node();
      read_binary_node(Cube{});
    } else {
      read_node(Cube{});
    }
    if (nodes_ != header_.nodes)
      damaged(fmt::format("it holds {} nodes, its header says {}", nodes_, header_.nodes));
    if (!bytes_.empty()) damaged(fmt::format("{} bytes stand after its last node", bytes_.size()));
  }

 private:
  [[noreturn]] void damaged(const std::string& what) const {
    refuse(file_, fmt::format("{}; copy it anew or write it again", what));
  }

  void count_node() {
    if (++nodes_ > header_.nodes)
      damaged(fmt::format("it holds more than the {} nodes its header says", header_.nodes));
  }

  /// OctoMap writes numbers as they lie in memory.
  template <class Number>
  Number take() {
    if (bytes_.size() < sizeof(Number))
      damaged(fmt::format("truncated after {} of {} nodes", nodes_, header_.nodes));
    Number number;
    std::memcpy(&number, bytes_.data(), sizeof number);
    bytes_.remove_prefix(sizeof number);
    return number;
  }

  /// A node of an .ot file: its data, a bit for each child that there is, and these children.
  void read_node(const Cube& cube) {
    count_node();
    const OctreeLeaf leaf = take_data(cube);
    const auto children = take<std::uint8_t>();
    if (children == 0) return on_leaf_(leaf);
    check_depth(cube);
    for (int index = 0; index < 8; ++index)
      if (children >> index & 1) read_node(cube.child(index));
  }

  /// An inner node of a .bt file: two bits for each child, then the inner ones among them.
  void read_binary_node(const Cube& cube) {
    check_depth(cube);
    const auto children = take<std::uint16_t>();
    if (children == 0) damaged("an inner node has no children");
    const auto state_of = [&](int index) { return children >> (2 * index) & 3; };
    for (int index = 0; index < 8; ++index) {
      const int state = state_of(index);
      if (state == kUnknown) continue;
      count_node();
      if (state == kInner) continue;
      const Cube child = cube.child(index);
      const bool occupied = state == kOccupied;
      on_leaf_({child.low, 1 << child.level, occupied, occupied ? most_ : least_, 0});
    }
    for (int index = 0; index < 8; ++index)
      if (state_of(index) == kInner) read_binary_node(cube.child(index));
  }

  void check_depth(const Cube& cube) const {
    if (cube.level == 0) damaged(fmt::format("a node is deeper than {} levels", kLevels));
  }

  OctreeLeaf take_data(const Cube& cube) {
    const auto log_odds = take<float>();
    if (!std::isfinite(log_odds)) damaged(fmt::format("node {} has odds of {}", nodes_, log_odds));
    OctreeLeaf leaf{cube.low, 1 << cube.level, log_odds >= 0.0f, octomap::probability(log_odds), 0};
    if (header_.kind == OctreeKind::colour) {
      const auto r = take<std::uint8_t>(), g = take<std::uint8_t>(), b = take<std::uint8_t>();
      leaf.label = static_cast<std::uint32_t>(r << 16 | g << 8 | b);
    }
    if (header_.kind == OctreeKind::semantic) take_best_class(leaf);
    return leaf;
  }

  void take_best_class(OctreeLeaf& leaf) {
    const auto head = take<std::uint16_t>();
    std::vector<ClassProbability> entries(head & ~kHasColour);
    for (ClassProbability& entry : entries) {
      entry.class_id = take<ClassId>();
      entry.probability = take<double>();
      if (!(entry.probability >= 0.0) || !std::isfinite(entry.probability))
        damaged(fmt::format("node {} has a class of weight {}", nodes_, entry.probability));
    }
    if (head & kHasColour) pass_colour();
    const ClassProbability best = ClassBeliefs(std::move(entries)).best();
    if (best.probability > 1.0 + kRounding)
      damaged(fmt::format("node {} has a class of probability {}", nodes_, best.probability));
    leaf.label = best.class_id;
    leaf.probability = std::min(best.probability, 1.0);
  }

  /// A semantic voxel's sums of red, green and blue and their number; labels are its classes.
  void pass_colour() {
    const auto r = take<std::uint32_t>(), g = take<std::uint32_t>(), b = take<std::uint32_t>();
    const std::uint64_t most = std::uint64_t{255} * take<std::uint32_t>();
    if (most == 0 || r > most || g > most || b > most)
      damaged(fmt::format("node {} has colours that exceed their number", nodes_));
  }

  enum State { kUnknown = 0, kFree = 1, kOccupied = 2, kInner = 3 };

  std::string_view bytes_;
  const OctreeHeader& header_;
  const std::filesystem::path& file_;
  const std::function<void(const OctreeLeaf&)>& on_leaf_;
  std::size_t nodes_ = 0;
  /// The limits at which OctoMap clamps: what it makes of a .bt file's bits.
  const octomap::OcTree limits_{1.0};
  const double most_ = limits_.getClampingThresMax(), least_ = limits_.getClampingThresMin();
};

}  // namespace

void for_each_leaf(std::string_view bytes, const OctreeHeader& header,
                   const std::filesystem::path& file,
                   const std::function<void(const OctreeLeaf&)>& on_leaf) {
  NodeReader(bytes.substr(header.bytes), header, file, on_leaf).read_all();
}

}  // namespace mapscore::eval
