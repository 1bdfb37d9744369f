// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace mapscore::eval {

/// Points, searched by a KD-tree. Immutable, safe to share between threads.
class PointTree {
 public:
  explicit PointTree(std::vector<Eigen::Vector3d> points);
  ~PointTree();
  PointTree(PointTree&&) noexcept;

  /// The number of the nearest point, if any lies within `reach_m`.
  [[nodiscard]] std::optional<std::size_t> nearest(const Eigen::Vector3d& p, double reach_m) const;
  /// The number of the point nearest to a point of the tree, if there is another one.
  [[nodiscard]] std::optional<std::size_t> next_to(std::size_t number) const;
  /// The numbers of all points within `reach_m`, in no promised order.
  [[nodiscard]] std::vector<std::size_t> within(const Eigen::Vector3d& p, double reach_m) const;

 private:
  struct Index;
  std::unique_ptr<const Index> index_;
};

}  // namespace mapscore::eval
