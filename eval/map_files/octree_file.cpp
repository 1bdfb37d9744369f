// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/fusion/class_beliefs.hpp"
#include "core/mapping/semantic_octree.hpp"
#include "eval/map_files/map_file.hpp"
#include "files/file_bytes.hpp"
#include "files/little_endian.hpp"
#include "files/refusal.hpp"
#include "files/text.hpp"
#include "files/text_rows.hpp"

#include <octomap/OcTree.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

namespace mapscore::eval {
namespace {

/// What the nodes of an octree file hold.
enum class OctreeKind {
  binary,   ///< two bits a child: free, occupied or inner; OctoMap's .bt
  plain,    ///< log-odds
  colour,   ///< log-odds and three bytes of colour
  semantic  ///< log-odds and class probabilities
};

/// What the text at the head of an octree file says.
struct OctreeHeader {
  OctreeKind kind = OctreeKind::plain;
  std::size_t nodes = 0;  ///< inner ones and leaves; above 0
  double edge_m = 0.0;    ///< positive and finite
  std::size_t bytes = 0;  ///< of the header, after which the nodes stand
};

OctreeKind kind_of(std::string_view id, const std::filesystem::path& file, std::size_t line) {
  if (id == "OcTree" || id == "OcTreeStamped") return OctreeKind::plain;
  if (id == "ColorOcTree") return OctreeKind::colour;
  if (id == "SemanticOcTree") return OctreeKind::semantic;
  refuse(file, line,
         "octrees of type {} are not read; write an OcTree, OcTreeStamped, ColorOcTree or "
         "SemanticOcTree, or a .bt file",
         excerpt(id));
}

/// Reads the head of an .ot or .bt file as OctoMap does: lines of comment, id, size and res, in any
/// order, up to the line `data`.
OctreeHeader parse_header(std::string_view bytes, const std::filesystem::path& file) {
  TextLines lines(bytes);
  const std::string_view first = lines.next().value_or("");
  const bool is_binary = first.starts_with("# Octomap OcTree binary file");
  if (!is_binary && !first.starts_with("# Octomap OcTree file"))
    refuse(file,
           "no octree: its first line is none of OctoMap's; older files are brought up to date by "
           "OctoMap's convert_octree");
  std::optional<OctreeKind> kind;
  std::optional<std::size_t> nodes;
  double edge_m = 0.0;
  const auto expect = [&](const char* line, bool is_there) {
    if (!is_there) refuse(file, lines.number(), "expected {}", line);
  };
  bool ended = false;
  for (std::vector<std::string_view> words; !ended && lines.next_words(words);) {
    const std::string_view key = words[0], value = words.size() == 2 ? words[1] : "";
    ended = key == "data";
    if (key == "id") {
      expect("'id TYPE'", !value.empty());
      kind = is_binary ? OctreeKind::binary : kind_of(value, file, lines.number());
    } else if (key == "size") {
      nodes = parse_count(value);
      expect("'size' and the number of nodes", nodes.has_value());
    } else if (key == "res") {
      edge_m = parse_real(value).value_or(0.0);
      expect("'res' and the edge of a voxel in metres, above 0",
             edge_m > 0.0 && std::isfinite(edge_m));
    }
  }
  if (!ended) refuse(file, "its header has no line 'data'; is the file truncated?");
  if (!kind || !nodes || edge_m == 0.0)
    refuse(file, "its header lacks 'id', 'size' or 'res'; write it again");
  if (*nodes == 0)
    throw EmptyMap(file.string() + ": the map is empty; give one that holds something");
  return {*kind, *nodes, edge_m, lines.taken()};
}

/// A leaf of an octree file: the cube of span^3 finest voxels that begins at `low`.
struct OctreeLeaf {
  VoxelKey low;
  std::int32_t span = 1;
  bool occupied = false;
  double probability = 0.0;  ///< of the label's class where the file has classes, else of occupancy
  std::uint32_t label = 0;   ///< class, 0xRRGGBB, or 0 where the file has neither
};

constexpr int kLevels = 16;

/// What rounding may add to a sum of probabilities.
constexpr double kSumRounding = 1e-6;

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

/// Calls `on_leaf` for each leaf in the order of the nodes' bytes. Checks as it goes, so what was
/// handed out before an Error is of no use. Takes no memory that grows with the file. Refuses nodes
/// deeper than OctoMap's 16 levels, missing or spare nodes and bytes, log-odds that are not finite,
/// and probabilities outside [0, 1].
class NodeReader {
 public:
  NodeReader(std::string_view bytes, const OctreeHeader& header, const std::filesystem::path& file,
             std::function<void(const OctreeLeaf&)> on_leaf)
      : bytes_(bytes), header_(header), file_(file), on_leaf_(std::move(on_leaf)) {}

  void read_all() {
    if (header_.kind == OctreeKind::binary) {
      count_node();
      read_binary_node(Cube{});
    } else {
      read_node(Cube{});
    }
    if (nodes_ != header_.nodes)
      damaged("it holds {} nodes, its header says {}", nodes_, header_.nodes);
    if (!bytes_.empty()) damaged("{} bytes stand after its last node", bytes_.size());
  }

 private:
  template <class... Args>
  [[noreturn]] void damaged(fmt::format_string<Args...> what, Args&&... args) const {
    refuse(file_, "{}; copy it anew or write it again",
           fmt::format(what, std::forward<Args>(args)...));
  }

  void count_node() {
    if (++nodes_ > header_.nodes)
      damaged("it holds more than the {} nodes its header says", header_.nodes);
  }

  /// OctoMap writes numbers as they lie in memory.
  template <class Number>
  Number take() {
    if (bytes_.size() < sizeof(Number))
      damaged("truncated after {} of {} nodes", nodes_, header_.nodes);
    return take_little_endian<Number>(bytes_);
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
    if (cube.level == 0) damaged("a node is deeper than {} levels", kLevels);
  }

  OctreeLeaf take_data(const Cube& cube) {
    const auto log_odds = take<float>();
    if (!std::isfinite(log_odds)) damaged("node {} has odds of {}", nodes_, log_odds);
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
        damaged("node {} has a class of weight {}", nodes_, entry.probability);
    }
    if (head & kHasColour) pass_colour();
    const ClassProbability best = ClassBeliefs(std::move(entries)).best();
    if (best.probability > 1.0 + kSumRounding)
      damaged("node {} has a class of probability {}", nodes_, best.probability);
    leaf.label = best.class_id;
    leaf.probability = std::min(best.probability, 1.0);
  }

  /// A semantic voxel's sums of red, green and blue and their number; labels are its classes.
  void pass_colour() {
    const auto r = take<std::uint32_t>(), g = take<std::uint32_t>(), b = take<std::uint32_t>();
    const std::uint64_t most = std::uint64_t{255} * take<std::uint32_t>();
    if (most == 0 || r > most || g > most || b > most)
      damaged("node {} has colours that exceed their number", nodes_);
  }

  enum State { kUnknown = 0, kFree = 1, kOccupied = 2, kInner = 3 };

  std::string_view bytes_;
  const OctreeHeader& header_;
  const std::filesystem::path& file_;
  const std::function<void(const OctreeLeaf&)> on_leaf_;
  std::size_t nodes_ = 0;
  /// The limits at which OctoMap clamps: what it makes of a .bt file's bits.
  const octomap::OcTree limits_{1.0};
  const double most_ = limits_.getClampingThresMax(), least_ = limits_.getClampingThresMin();
};

/// A pruned leaf of a few bits covers any number of voxels. A .bt of an empty room, the most that
/// honest maps have, comes to 20 a byte at 5 cm and 60 at 2 cm.
constexpr std::size_t kMostVoxelsAByte = 128;
constexpr std::size_t kAlwaysSpread = 1 << 21;

/// Adds the finest voxels that a leaf covers, and what they share.
void spread(const OctreeLeaf& leaf, MapFile& map) {
  for (std::int32_t i = 0; i < leaf.span; ++i)
    for (std::int32_t j = 0; j < leaf.span; ++j)
      for (std::int32_t k = 0; k < leaf.span; ++k)
        map.voxels.push_back({leaf.low.i + i, leaf.low.j + j, leaf.low.k + k});
  map.occupied.resize(map.voxels.size(), leaf.occupied ? 1 : 0);
  map.probabilities.resize(map.voxels.size(), leaf.probability);
  if (map.label_kind != LabelKind::none) map.labels.resize(map.voxels.size(), leaf.label);
}

LabelKind label_kind_of(OctreeKind kind) {
  if (kind == OctreeKind::colour) return LabelKind::colour;
  return kind == OctreeKind::semantic ? LabelKind::id : LabelKind::none;
}

}  // namespace

MapFile read_octree(const std::filesystem::path& file) {
  const std::string bytes = read_file(file);
  const OctreeHeader header = parse_header(bytes, file);
  const std::string_view nodes = std::string_view(bytes).substr(header.bytes);
  std::size_t voxels = 0;  // the whole file is checked before anything is spread out
  NodeReader(nodes, header, file, [&](const OctreeLeaf& leaf) {
    const auto span = static_cast<std::size_t>(leaf.span);
    voxels += span * span * span;
  }).read_all();
  if (voxels > kMostMapVoxels)
    refuse(file,
           "its leaves cover {} voxels, at most {} are read; cut the map down to the part in "
           "question or write it with larger voxels",
           voxels, kMostMapVoxels);
  if (voxels > kAlwaysSpread && voxels / kMostVoxelsAByte >= bytes.size())
    refuse(file,
           "{} bytes whose leaves cover {} voxels, more than {} a byte; cut empty space off the "
           "map, or write it with larger voxels",
           bytes.size(), voxels, kMostVoxelsAByte);
  MapFile map;
  map.edge_m = header.edge_m;
  map.label_kind = label_kind_of(header.kind);
  map.voxels.reserve(voxels);
  map.occupied.reserve(voxels);
  map.probabilities.reserve(voxels);
  if (map.label_kind != LabelKind::none) map.labels.reserve(voxels);
  NodeReader(nodes, header, file, [&](const OctreeLeaf& leaf) { spread(leaf, map); }).read_all();
  return map;
}

}  // namespace mapscore::eval
