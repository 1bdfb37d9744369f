// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/mapping/semantic_octree.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cmath>
#include <istream>
#include <limits>
#include <mutex>
#include <new>
#include <ostream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace mapscore {
namespace {

constexpr const char* kMisfit = "its data do not fit its header; write it again";
constexpr const char* kCutShort = "it is cut short; copy it whole or write it again";

template <class T>
void write_raw(std::ostream& stream, const T& value) {
  stream.write(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class T>
T read_raw(std::istream& stream) {
  T value{};
  stream.read(reinterpret_cast<char*>(&value), sizeof value);
  return value;
}

/// What stands before the data of an .ot file.
struct OcTreeHeader {
  std::string type;
  std::size_t nodes = 0;
  double edge_m = 0.0;
};

OcTreeHeader read_header(std::istream& stream) {
  std::string line, key;
  std::getline(stream, line);
  if (line != "# Octomap OcTree file") throw Error("not an OctoMap .ot file");
  OcTreeHeader header;
  while (std::getline(stream, line) && line != "data") {
    std::istringstream words(line);
    words >> key;
    if (key == "id") words >> header.type;
    if (key == "size") words >> header.nodes;
    if (key == "res") words >> header.edge_m;
  }
  if (line != "data" || !(header.edge_m > 0.0))
    throw Error("its header is damaged; write it again");
  return header;
}

/// Memory for very many nodes, without an allocator's overhead for each. Slots given back are
/// reused by the same thread, after its end by any thread; they never return to the system. Safe
/// from all threads.
class NodePool {
 public:
  static void* take() {
    List& list = mine();
    if (list.head == nullptr) list.head = shared().take_all();
    Slot* slot = list.head;
    list.head = slot->next;
    return slot;
  }
  static void give(void* memory) noexcept {
    List& list = mine();
    list.head = new (memory) Slot{list.head};
  }

 private:
  struct Slot {
    Slot* next;
  };
  static constexpr std::size_t kBytes = sizeof(SemanticOcTreeNode);
  static_assert(kBytes >= sizeof(Slot) && kBytes % alignof(Slot) == 0);
  static constexpr std::size_t kSlotsAtOnce = 4096;

  /// What ended threads gave back, and memory from the system.
  struct Shared {
    std::mutex mutex;
    Slot* head = nullptr;

    Slot* take_all() {
      const std::lock_guard lock(mutex);
      if (Slot* all = head) {
        head = nullptr;
        return all;
      }
      auto* bytes = static_cast<std::byte*>(::operator new(kSlotsAtOnce* kBytes));
      Slot* first = nullptr;
      for (std::size_t n = kSlotsAtOnce; n > 0; --n)
        first = new (bytes + (n - 1) * kBytes) Slot{first};
      return first;
    }
    void give_all(Slot* first) {
      Slot* last = first;
      while (last->next != nullptr) last = last->next;
      const std::lock_guard lock(mutex);
      last->next = head;
      head = first;
    }
  };
  /// Outlives every thread.
  static Shared& shared() {
    static Shared& shared = *new Shared;
    return shared;
  }

  struct List {
    Slot* head = nullptr;
    ~List() {
      if (head != nullptr) shared().give_all(head);
      head = nullptr;
    }
  };
  static List& mine() {
    thread_local List list;
    return list;
  }
};

}  // namespace

void* SemanticOcTreeNode::operator new(std::size_t bytes) {
  if (bytes != sizeof(SemanticOcTreeNode)) throw std::bad_alloc();
  return NodePool::take();
}
void SemanticOcTreeNode::operator delete(void* node) noexcept {
  if (node != nullptr) NodePool::give(node);
}

const ClassBeliefs& SemanticOcTreeNode::beliefs() const {
  static const ClassBeliefs kNone;
  return surface_ ? surface_->beliefs : kNone;
}

const ColourSum& SemanticOcTreeNode::colour() const {
  static const ColourSum kNone;
  return surface_ ? surface_->colour : kNone;
}

SemanticOcTreeNode::Surface& SemanticOcTreeNode::surface() {
  if (!surface_) surface_ = std::make_unique<Surface>();
  return *surface_;
}

bool SemanticOcTreeNode::operator==(const SemanticOcTreeNode& other) const {
  if (value != other.value) return false;
  if (surface_ == other.surface_) return true;
  return beliefs() == other.beliefs() && colour() == other.colour();
}

void SemanticOcTreeNode::copyData(const SemanticOcTreeNode& from) {
  OcTreeNode::copyData(from);
  surface_ = from.surface_ ? std::make_unique<Surface>(*from.surface_) : nullptr;
}

std::istream& SemanticOcTreeNode::readData(std::istream& stream) {
  OcTreeNode::readData(stream);
  const auto head = read_raw<std::uint16_t>(stream);
  if (!stream) throw Error(kCutShort);
  if (!std::isfinite(value))
    throw Error("a voxel's log-odds are not finite; it is damaged, write it again");
  if (head == 0) return stream;
  std::vector<ClassProbability> entries(head & ~kHasColour);
  for (ClassProbability& entry : entries) {
    entry.class_id = read_raw<ClassId>(stream);
    entry.probability = read_raw<double>(stream);
  }
  const ColourSum sum = (head & kHasColour) ? read_raw<ColourSum>(stream) : ColourSum{};
  if (!stream) throw Error(kCutShort);
  const std::uint64_t most = std::uint64_t{255} * sum.count;
  if (((head & kHasColour) && sum.count == 0) || sum.r > most || sum.g > most || sum.b > most)
    throw Error("a voxel's colours exceed their number; write it again");
  ClassBeliefs beliefs(std::move(entries));
  if (!beliefs.well_formed())
    throw Error(
        "a voxel's classes do not ascend, or a weight is not a number of 0 or more; it is damaged, "
        "write it again");
  surface() = {std::move(beliefs), sum};
  return stream;
}

std::ostream& SemanticOcTreeNode::write_as(float log_odds, std::ostream& stream) const {
  write_raw(stream, log_odds);
  const bool coloured = colour().count > 0;
  const std::size_t classes = beliefs().entries().size();
  write_raw(stream, static_cast<std::uint16_t>(classes | (coloured ? kHasColour : 0)));
  for (const ClassProbability& entry : beliefs().entries()) {
    write_raw(stream, entry.class_id);
    write_raw(stream, entry.probability);
  }
  if (coloured) write_raw(stream, colour());
  return stream;
}

SemanticOcTree::SemanticOcTree(double edge_m)
    : octomap::OccupancyOcTreeBase<SemanticOcTreeNode>(edge_m) {}

std::unique_ptr<SemanticOcTree> SemanticOcTree::read_whole(std::istream& stream) {
  const OcTreeHeader header = read_header(stream);
  if (header.type.empty())
    throw Error(
        "its header has no line `id`, so it is no map of a known type; write one with `mapscore "
        "run`");
  if (header.type != "SemanticOcTree")
    throw Error("a " + header.type + ", not a semantic map; write one with `mapscore run`");
  auto tree = std::make_unique<SemanticOcTree>(header.edge_m);
  if (header.nodes > 0) {
    tree->root = new SemanticOcTreeNode;
    tree->tree_size = 1;
    const std::size_t voxels =
        tree->read_node(stream, tree->root, tree->getTreeDepth(), header.nodes);
    if (voxels > kMostMapVoxels)
      throw Error("its leaves cover " + std::to_string(voxels) + " voxels, at most " +
                  std::to_string(kMostMapVoxels) + " are read; write it with larger voxels");
  }
  if (tree->size() != header.nodes || !stream || stream.peek() != std::istream::traits_type::eof())
    throw Error(kMisfit);
  return tree;
}

std::size_t SemanticOcTree::read_node(std::istream& stream, SemanticOcTreeNode* node,
                                      unsigned level, std::size_t most_nodes) {
  node->readData(stream);
  const auto children = read_raw<std::uint8_t>(stream);
  if (!stream) throw Error(kCutShort);
  if (children == 0) return std::size_t{1} << (3 * level);
  if (level == 0) throw Error(kMisfit);
  std::size_t voxels = 0;
  for (unsigned index = 0; index < 8; ++index) {
    if ((children >> index & 1) == 0) continue;
    if (tree_size == most_nodes) throw Error(kMisfit);
    voxels += read_node(stream, createNodeChild(node, index), level - 1, most_nodes);
  }
  return voxels;
}

float SemanticOcTree::gather_log_odds(const SemanticOcTreeNode* node,
                                      std::vector<float>& log_odds) const {
  const std::size_t place = log_odds.size();
  log_odds.push_back(node->getLogOdds());
  if (!nodeHasChildren(node)) return log_odds[place];
  float most = std::numeric_limits<float>::lowest();
  for (unsigned index = 0; index < 8; ++index)
    if (nodeChildExists(node, index))
      most = std::max(most, gather_log_odds(getNodeChild(node, index), log_odds));
  return log_odds[place] = most;
}

void SemanticOcTree::write_node(const SemanticOcTreeNode* node, const float*& next,
                                std::ostream& stream) const {
  node->write_as(*next++, stream);
  unsigned children = 0;
  for (unsigned index = 0; index < 8; ++index)
    children |= static_cast<unsigned>(nodeChildExists(node, index)) << index;
  write_raw(stream, static_cast<std::uint8_t>(children));
  for (unsigned index = 0; index < 8; ++index)
    if ((children >> index & 1) != 0) write_node(getNodeChild(node, index), next, stream);
}

std::ostream& SemanticOcTree::writeData(std::ostream& stream) const {
  if (root == nullptr) return stream;
  std::vector<float> log_odds;
  log_odds.reserve(tree_size);
  gather_log_odds(root, log_odds);
  const float* next = log_odds.data();
  write_node(root, next, stream);
  return stream;
}

const bool SemanticOcTree::kKnown = [] {
  auto* prototype = new SemanticOcTree(0.1);  // OctoMap's registry keeps it to the program's end
  prototype->clearKeyRays();
  registerTreeType(prototype);
  return true;
}();

}  // namespace mapscore
