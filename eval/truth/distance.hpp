// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "eval/truth/shapes/shape_tests.hpp"

#include <limits>
#include <span>
#include <vector>

namespace mapscore::eval {

inline constexpr double kNoCap = std::numeric_limits<double>::infinity();

/// Euclidean distance in metres from a closed box to the surface: the boundary of a solid, all of a
/// plane or triangle. 0 when they meet; for a box inside a solid, the distance to the boundary from
/// within. Exact to 1e-9 m.
[[nodiscard]] double distance(const PreparedShape& shape, const Box& box);

/// The least distance to any of the surfaces, or `cap_m` when none is nearer. Parts of a surface
/// that lie inside other solids count. Looks at every piece; for many, or for many boxes, see
/// SurfaceDistance.
[[nodiscard]] double distance_to_surface(std::span<const PreparedShape> pieces, const Box& box,
                                         double cap_m = kNoCap);

/// Pieces of the shapes of one class, in the order given.
[[nodiscard]] std::vector<PreparedShape> pieces_of(std::span<const PreparedShape> pieces,
                                                   const ClassTable& table, ClassId class_id);

/// The same as distance_to_surface, by a tree of bounding boxes over the pieces. Immutable, safe to
/// share between threads.
class SurfaceDistance {
 public:
  explicit SurfaceDistance(std::vector<PreparedShape> pieces);

  [[nodiscard]] double operator()(const Box& box, double cap_m = kNoCap) const;

 private:
  struct Node {
    Box bounds;
    int first, last;            ///< its pieces
    int left = -1, right = -1;  ///< its halves; none for a leaf
  };

  int build(int first, int last);
  void search(int node, const Box& box, double& least) const;

  std::vector<PreparedShape> pieces_;
  std::vector<Node> nodes_;  ///< the root is the first
};

}  // namespace mapscore::eval
