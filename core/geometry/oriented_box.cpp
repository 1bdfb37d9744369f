// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/geometry/oriented_box.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace mapscore {
namespace {

using Points2 = std::vector<Eigen::Vector2d>;

/// Twice the area of a, b, c; positive when they turn left.
double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// Corners of the convex hull, anticlockwise (Andrew's monotone chain).
Points2 convex_hull(Points2 points) {
  std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  Points2 hull;
  const auto add_chain = [&](auto first, auto last) {
    const std::size_t base = hull.size();
    for (; first != last; ++first) {
      while (hull.size() >= base + 2 && !(turn(hull[hull.size() - 2], hull.back(), *first) > 0))
        hull.pop_back();
      hull.push_back(*first);
    }
    hull.pop_back();  // the other chain starts with it
  };
  add_chain(points.begin(), points.end());
  add_chain(points.rbegin(), points.rend());
  return hull;
}

struct Rectangle {
  Eigen::Vector2d along = Eigen::Vector2d::UnitX();  ///< unit vector of one side
  Eigen::Vector2d low = Eigen::Vector2d::Zero(), high = Eigen::Vector2d::Zero();  ///< in its axes
  [[nodiscard]] Eigen::Vector2d size() const { return high - low; }
};

Rectangle rectangle_along(const Points2& hull, const Eigen::Vector2d& along) {
  Rectangle rectangle;
  rectangle.along = along;
  rectangle.low.setConstant(std::numeric_limits<double>::infinity());
  rectangle.high = -rectangle.low;
  for (const Eigen::Vector2d& p : hull) {
    const Eigen::Vector2d q(along.dot(p), along.x() * p.y() - along.y() * p.x());
    rectangle.low = rectangle.low.cwiseMin(q);
    rectangle.high = rectangle.high.cwiseMax(q);
  }
  return rectangle;
}

/// The rectangle of least area has a side along an edge of the hull (Freeman and Shapira, 1975).
Rectangle least_rectangle(const Points2& hull) {
  Rectangle best = rectangle_along(hull, Eigen::Vector2d::UnitX());
  if (hull.size() == 1) return best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < hull.size(); ++n) {
    const Eigen::Vector2d edge = hull[(n + 1) % hull.size()] - hull[n];
    const Rectangle rectangle = rectangle_along(hull, edge.normalized());
    if (const double area = rectangle.size().prod(); area < least) {
      least = area;
      best = rectangle;
    }
  }
  return best;
}

/// The same rectangle with its longer side along `along`, which points to the right, or up.
Rectangle longer_side_first(Rectangle r) {
  if (r.size().y() > r.size().x())  // a quarter turn to the left: (x, y) -> (y, -x)
    r = {{-r.along.y(), r.along.x()}, {r.low.y(), -r.high.x()}, {r.high.y(), -r.low.x()}};
  if (r.along.x() < 0 || (r.along.x() == 0 && r.along.y() < 0)) r = {-r.along, -r.high, -r.low};
  return r;
}

/// Axes across `up` (a unit vector) and `up` itself as columns; the identity for z.
Eigen::Matrix3d axes_about(const Eigen::Vector3d& up) {
  Eigen::Index least = 0;
  up.cwiseAbs().minCoeff(&least);
  Eigen::Matrix3d axes;
  axes.col(0) = (Eigen::Vector3d::Unit(least) - up[least] * up).normalized();
  axes.col(1) = up.cross(axes.col(0));
  axes.col(2) = up;
  return axes;
}

}  // namespace

std::optional<OrientedBox> upright_box(std::span<const Eigen::Vector3d> points,
                                       const Eigen::Vector3d& up) {
  if (!up.allFinite() || !(up.norm() > 0))
    throw Error("oriented box: up has no direction; give a vector that is finite and not zero");
  const Eigen::Matrix3d axes = axes_about(up.normalized());
  Points2 across;
  double bottom = std::numeric_limits<double>::infinity(), top = -bottom;
  for (const Eigen::Vector3d& p : points) {
    if (!p.allFinite()) continue;
    const Eigen::Vector3d q = axes.transpose() * p;
    across.emplace_back(q.x(), q.y());
    bottom = std::min(bottom, q.z());
    top = std::max(top, q.z());
  }
  if (across.empty()) return std::nullopt;
  const Rectangle base = longer_side_first(least_rectangle(convex_hull(std::move(across))));
  Eigen::Matrix3d turned = Eigen::Matrix3d::Identity();
  turned.topLeftCorner<2, 1>() = base.along;
  turned.block<2, 1>(0, 1) << -base.along.y(), base.along.x();
  const Eigen::Vector2d middle = 0.5 * (base.low + base.high);
  OrientedBox box;
  box.T_frame_box.linear() = axes * turned;
  box.T_frame_box.translation() =
      box.T_frame_box.linear() * Eigen::Vector3d(middle.x(), middle.y(), 0.5 * (bottom + top));
  box.size_m << base.size(), top - bottom;
  return box;
}

}  // namespace mapscore
