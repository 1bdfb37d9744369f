// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/alignment/point_tree.hpp"

#include <nanoflann.hpp>

#include <array>
#include <utility>

namespace mapscore::eval {
namespace {

/// Points as nanoflann reads them.
struct TreePoints {
  std::vector<Eigen::Vector3d> points;

  [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
  [[nodiscard]] double kdtree_get_pt(std::size_t point, std::size_t axis) const {
    return points[point][static_cast<Eigen::Index>(axis)];
  }
  template <class BoundingBox>
  bool kdtree_get_bbox(BoundingBox&) const {
    return false;
  }
};

constexpr std::size_t kLeafPoints = 12;

}  // namespace

struct PointTree::Index {
  TreePoints points;
  nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, TreePoints>, TreePoints,
                                      3, std::size_t>
      tree;

  explicit Index(std::vector<Eigen::Vector3d> all)
      : points{std::move(all)}, tree(3, points, {kLeafPoints}) {
    tree.buildIndex();
  }
};

PointTree::PointTree(std::vector<Eigen::Vector3d> points)
    : index_(std::make_unique<const Index>(std::move(points))) {}
PointTree::~PointTree() = default;
PointTree::PointTree(PointTree&&) noexcept = default;

std::optional<std::size_t> PointTree::nearest(const Eigen::Vector3d& p, double reach_m) const {
  std::size_t number = 0;
  double squared = reach_m * reach_m;
  nanoflann::KNNResultSet<double> result(1);
  result.init(&number, &squared);
  // A candidate within the reach from the start keeps the search from looking
  // farther.
  squared = reach_m * reach_m;
  index_->tree.findNeighbors(result, p.data(), {});
  if (result.size() == 0 || squared >= reach_m * reach_m) return std::nullopt;
  return number;
}

std::optional<std::size_t> PointTree::next_to(std::size_t number) const {
  std::array<std::size_t, 2> numbers{};
  std::array<double, 2> squared{};
  if (index_->tree.knnSearch(index_->points.points[number].data(), 2, numbers.data(),
                             squared.data()) < 2)
    return std::nullopt;
  return numbers[0] == number ? numbers[1] : numbers[0];
}

std::vector<std::size_t> PointTree::within(const Eigen::Vector3d& p, double reach_m) const {
  std::vector<std::pair<std::size_t, double>> found;
  index_->tree.radiusSearch(p.data(), reach_m * reach_m, found,
                            nanoflann::SearchParams{32, 0, false});
  std::vector<std::size_t> numbers;
  numbers.reserve(found.size());
  for (const auto& [number, squared] : found) numbers.push_back(number);
  return numbers;
}

}  // namespace mapscore::eval
