// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/truth/distance.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace mapscore::eval {
namespace {

constexpr int kLeafPieces = 4;

/// From a box inside a solid to its boundary. Depth is concave within a convex body, so the box
/// comes nearest at a corner.
double inner_distance(const PreparedShape& shape, const Box& box) {
  double least = kNoCap;
  for (int corner = 0; corner < 8; ++corner) {
    const auto depth_of = [&](const auto& form) { return depth(form, corner_of(box, corner)); };
    least = std::min(least, std::visit(depth_of, shape.form()));
  }
  return least;
}

}  // namespace

double distance(const PreparedShape& shape, const Box& box) {
  if (inside_open(shape, box)) return inner_distance(shape, box);
  if (meets_surface(shape, box)) return 0;
  return std::visit([&](const auto& form) { return gap(form, box); }, shape.form());
}

double distance_to_surface(std::span<const PreparedShape> pieces, const Box& box, double cap_m) {
  double least = cap_m;
  for (const PreparedShape& piece : pieces) {
    if (least <= 0) break;
    if (piece.bounds().exteriorDistance(box) < least) least = std::min(least, distance(piece, box));
  }
  return least;
}

std::vector<PreparedShape> pieces_of(std::span<const PreparedShape> pieces, const ClassTable& table,
                                     ClassId class_id) {
  std::vector<PreparedShape> chosen;
  std::copy_if(pieces.begin(), pieces.end(), std::back_inserter(chosen),
               [&](const PreparedShape& p) { return table.class_of(p.instance()) == class_id; });
  return chosen;
}

SurfaceDistance::SurfaceDistance(std::vector<PreparedShape> pieces) : pieces_(std::move(pieces)) {
  if (!pieces_.empty()) build(0, static_cast<int>(pieces_.size()));
}

double SurfaceDistance::operator()(const Box& box, double cap_m) const {
  double least = cap_m;
  if (!nodes_.empty()) search(0, box, least);
  return least;
}

/// Halves the pieces at the median of their centres along the longest side.
int SurfaceDistance::build(int first, int last) {
  const int node = static_cast<int>(nodes_.size());
  Box bounds;
  for (int i = first; i < last; ++i) bounds.extend(pieces_[i].bounds());
  nodes_.push_back({bounds, first, last});
  if (last - first <= kLeafPieces) return node;

  int axis = 0;
  bounds.sizes().maxCoeff(&axis);
  const int middle = first + (last - first) / 2;
  const auto begin = pieces_.begin();
  std::nth_element(begin + first, begin + middle, begin + last,
                   [axis](const PreparedShape& a, const PreparedShape& b) {
                     return a.bounds().center()[axis] < b.bounds().center()[axis];
                   });
  const int left = build(first, middle);
  const int right = build(middle, last);
  nodes_[node].left = left;
  nodes_[node].right = right;
  return node;
}

/// Nearer half first; a node that is not nearer than the least so far is passed over.
void SurfaceDistance::search(int index, const Box& box, double& least) const {
  const Node& node = nodes_[index];
  if (node.left < 0) {
    const std::span all(pieces_);
    least = distance_to_surface(all.subspan(node.first, node.last - node.first), box, least);
    return;
  }
  std::array<std::pair<double, int>, 2> halves{
      {{nodes_[node.left].bounds.exteriorDistance(box), node.left},
       {nodes_[node.right].bounds.exteriorDistance(box), node.right}}};
  if (halves[1].first < halves[0].first) std::swap(halves[0], halves[1]);
  for (const auto& [bound, half] : halves) {
    if (bound < least) search(half, box, least);
  }
}

}  // namespace mapscore::eval
