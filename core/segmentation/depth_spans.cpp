// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/depth_spans.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace mapscore {
namespace {

/// Pixels that stand for all that rounding may move.
constexpr double kSlack_px = 1.0;

/// Rows of the colour image that are looked at together.
constexpr int kBandRows = 8;

/// A rectangle in an image, pixel coordinates.
struct ImageBox {
  double left, right, top, bottom;

  [[nodiscard]] std::array<Eigen::Vector2d, 4> corners() const {
    return {Eigen::Vector2d(left, top), Eigen::Vector2d(right, top), Eigen::Vector2d(left, bottom),
            Eigen::Vector2d(right, bottom)};
  }
};

/// Which depth pixels may see what a colour pixel sees. All points in question lie between two
/// planes z = near and z = far of the depth camera; what is linear, or a quotient of such over a
/// positive one, is least and greatest at the corners of a convex body of them.
class Reach {
 public:
  explicit Reach(const Calibration& believed)
      : color_(believed.color),
        depth_(believed.depth),
        T_color_depth_(believed.T_color_depth),
        T_depth_color_(believed.T_color_depth.inverse()),
        limits_m_{std::max(believed.range_min_m, 1 / kDepthUnitsPerMetre),
                  std::min(believed.range_max_m, 65535 / kDepthUnitsPerMetre)} {}

  /// How far from its projection a depth pixel covers colour pixels, at most; nothing where a
  /// point may lie beside or behind the colour camera.
  [[nodiscard]] std::optional<double> cover_px() const {
    const double ratio = std::max(color_.fx_px / depth_.fx_px, color_.fy_px / depth_.fy_px);
    const ImageBox all{-0.5, depth_.width_px - 0.5, -0.5, depth_.height_px - 0.5};
    double greatest = 1.0;
    for (const double z : limits_m_)
      for (const Eigen::Vector2d& pixel : all.corners()) {
        const double z_color = (T_color_depth_ * depth_.back_project(pixel.x(), pixel.y(), z)).z();
        if (!(z_color > 0)) return std::nullopt;
        greatest = std::max(greatest, ratio * z / z_color);
      }
    return 0.5 * greatest + kSlack_px;
  }

  /// Where the depth camera sees all that the colour camera sees in a box.
  [[nodiscard]] std::optional<ImageBox> seen_in(const ImageBox& box) const {
    const Eigen::Vector3d centre = T_depth_color_.translation();
    if (!(centre.z() < limits_m_[0])) return std::nullopt;
    ImageBox seen{1e9, -1e9, 1e9, -1e9};
    for (const Eigen::Vector2d& corner : box.corners()) {
      const Eigen::Vector3d ray =
          T_depth_color_.linear() * color_.back_project(corner.x(), corner.y(), 1.0);
      if (!(ray.z() > 0)) return std::nullopt;
      for (const double z : limits_m_) {
        const Eigen::Vector2d at = depth_.project(centre + (z - centre.z()) / ray.z() * ray);
        seen = {std::min(seen.left, at.x()), std::max(seen.right, at.x()),
                std::min(seen.top, at.y()), std::max(seen.bottom, at.y())};
      }
    }
    return ImageBox{seen.left - kSlack_px, seen.right + kSlack_px, seen.top - kSlack_px,
                    seen.bottom + kSlack_px};
  }

 private:
  CameraModel color_, depth_;
  Pose T_color_depth_, T_depth_color_;
  std::array<double, 2> limits_m_;
};

/// The box around the wanted pixels of some rows; nothing without any.
std::optional<ImageBox> box_of(const cv::Mat1b& wanted, int first_row, int end_row) {
  std::optional<ImageBox> box;
  for (int v = first_row; v < end_row; ++v) {
    const std::uint8_t* row = wanted[v];
    const std::uint8_t* end = row + wanted.cols;
    const std::uint8_t* first = std::find_if(row, end, [](std::uint8_t p) { return p != 0; });
    if (first == end) continue;
    while (end[-1] == 0) --end;
    const double left = static_cast<double>(first - row);
    const double right = static_cast<double>(end - 1 - row);
    if (!box) box = ImageBox{left, right, double(v), double(v)};
    *box = {std::min(box->left, left), std::max(box->right, right), box->top, double(v)};
  }
  return box;
}

/// Whole numbers from 0 to size - 1 within [low, high].
ColumnSpan within(double low, double high, int size) {
  return {static_cast<int>(std::ceil(std::clamp(low, 0.0, double(size)))),
          static_cast<int>(std::floor(std::clamp(high, -1.0, size - 1.0)))};
}

}  // namespace

std::vector<ColumnSpan> spans_that_may_cover(const cv::Mat1b& wanted, const Calibration& believed) {
  const CameraModel& depth = believed.depth;
  const std::vector<ColumnSpan> all(static_cast<std::size_t>(depth.height_px),
                                    {0, depth.width_px - 1});
  const Reach reach(believed);
  const std::optional<double> cover_px = reach.cover_px();
  if (wanted.empty() || !cover_px) return all;
  std::vector<ColumnSpan> spans(all.size(), {depth.width_px, -1});
  for (int first = 0; first < wanted.rows; first += kBandRows) {
    const auto box = box_of(wanted, first, std::min(first + kBandRows, wanted.rows));
    if (!box) continue;
    const auto seen = reach.seen_in({box->left - *cover_px, box->right + *cover_px,
                                     box->top - *cover_px, box->bottom + *cover_px});
    if (!seen) return all;
    const ColumnSpan columns = within(seen->left, seen->right, depth.width_px);
    const ColumnSpan rows = within(seen->top, seen->bottom, depth.height_px);
    for (int v = rows.first; v <= rows.last; ++v) {
      ColumnSpan& span = spans[static_cast<std::size_t>(v)];
      span = {std::min(span.first, columns.first), std::max(span.last, columns.last)};
    }
  }
  return spans;
}

}  // namespace mapscore
