// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/hole_shadows.hpp"

#include <opencv2/imgproc.hpp>

#include <array>
#include <cmath>
#include <cstdint>

namespace mapscore {
namespace {

/// Depths at which a near object is tried, in least ranges.
constexpr std::array kNearDepths{1.0, 0.85, 0.7, 0.6, 0.5};
constexpr double kRunsOnFrom = 1.3;    // in least ranges: a farther surface does not run on,
constexpr double kRunsOnUntil = 1.05;  // and one that does ends nearer than this
constexpr int kHoleRim_px = 11;        // near holes leave out 4 pixels at their rims

class Shadows {
 public:
  Shadows(const DepthEdges& edges, const OutlineField& field, const OutlineAlignment& alignment,
          const Calibration& believed)
      : edges_(edges), field_(field), offset_px_(alignment.offset_px), mended_(believed) {
    mended_.T_color_depth = alignment.corrected<double>(believed.T_color_depth);
  }

  /// 255 on what near objects cover in the colour image.
  [[nodiscard]] cv::Mat1b covered() const {
    const cv::Mat1b& hole = edges_.near_holes;
    cv::Mat1b hit(field_.owner.rows, field_.owner.cols, std::uint8_t{0});
    for (int v = 0; v < hole.rows; ++v)
      for (int u = 0; u < hole.cols; ++u) {
        if (hole(v, u) == 0) continue;
        const int far = cell_of(u, v, mended_.range_max_m);
        if (far < 0 || !is_inside(far)) continue;
        for (const double depth : kNearDepths) {
          const int near = cell_of(u, v, depth * mended_.range_min_m);
          if (near >= 0 && is_inside(near) && field_.owner[0][near] == field_.owner[0][far])
            hit[0][near] = 255;
        }
      }
    cv::dilate(hit, hit, cv::Mat(3, 3, CV_8U, cv::Scalar(1)));
    return hit;
  }

  /// 255 on surfaces that run on into a near hole.
  [[nodiscard]] cv::Mat1b running_on() const {
    const cv::Mat1f& w = edges_.inverse_depth;
    cv::Mat1b beside, ends;
    cv::dilate(edges_.near_holes, beside, cv::Mat(kHoleRim_px, kHoleRim_px, CV_8U, cv::Scalar(1)));
    ends = (w > 1.0 / (kRunsOnUntil * mended_.range_min_m)) & beside;
    cv::Mat1b marked = ends.clone();
    const Eigen::Vector3d& t = mended_.T_color_depth.translation();
    const double nearness = (1 / kNearDepths.back() - 1 / kRunsOnFrom) / mended_.range_min_m;
    const int reach_px = static_cast<int>(std::ceil(mended_.depth.fx_px * t.norm() * nearness));
    const bool in_rows = std::abs(t.x()) >= std::abs(t.y());
    const cv::Mat1f& on = in_rows ? edges_.right : edges_.down;
    const cv::Point next = in_rows ? cv::Point(1, 0) : cv::Point(0, 1);
    for (int v = 0; v < w.rows; ++v)
      for (int u = 0; u < w.cols; ++u) {
        if (ends(v, u) == 0) continue;
        cv::Point at(u, v);
        for (int n = 0; n < reach_px && on(at) >= 1.0F; ++n) marked(at += next) = 255;
        at = {u, v};
        for (int n = 0; n < reach_px && (in_rows ? at.x : at.y) > 0 && on(at - next) >= 1.0F; ++n)
          marked(at -= next) = 255;
      }
    return marked;
  }

 private:
  /// The colour pixel of a depth pixel at a depth; -1 beyond the image.
  [[nodiscard]] int cell_of(int u, int v, double z_m) const {
    const Eigen::Vector2d at =
        mended_.color.project(mended_.T_color_depth * mended_.depth.back_project(u, v, z_m));
    const int c = static_cast<int>(std::floor(at.x() + 0.5)),
              r = static_cast<int>(std::floor(at.y() + 0.5));
    const bool within = c >= 0 && r >= 0 && c < field_.owner.cols && r < field_.owner.rows;
    return within ? r * field_.owner.cols + c : -1;
  }

  [[nodiscard]] bool is_inside(int cell) const {
    return field_.owner[0][cell] != 0 && field_.distance[0][cell] < offset_px_;
  }

  const DepthEdges& edges_;
  const OutlineField& field_;
  float offset_px_;
  Calibration mended_;
};

}  // namespace

cv::Mat1b hole_shadows(const DepthEdges& edges, const cv::Mat1i& cells, const OutlineField& field,
                       const OutlineAlignment& alignment, const Calibration& believed) {
  if (cv::countNonZero(edges.near_holes) == 0) return {};
  const Shadows shadows(edges, field, alignment, believed);
  const cv::Mat1b covered = shadows.covered();
  if (cv::countNonZero(covered) == 0) return {};
  const cv::Mat1b running_on = shadows.running_on();
  cv::Mat1b hidden(cells.size(), std::uint8_t{0});
  for (int v = 0; v < cells.rows; ++v)
    for (int u = 0; u < cells.cols; ++u)
      if (cells(v, u) >= 0 && covered[0][cells(v, u)] != 0 && running_on(v, u) == 0)
        hidden(v, u) = 255;
  return hidden;
}

}  // namespace mapscore
