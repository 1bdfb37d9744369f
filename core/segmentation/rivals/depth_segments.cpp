// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/rivals/depth_segments.hpp"

#include "core/error.hpp"
#include "core/geometry/depth_rays.hpp"
#include "core/segmentation/rivals/geometric_segments.hpp"
#include "core/segmentation/rivals/surface_normals.hpp"
#include "core/segmentation/segmentation.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace mapscore {
namespace {

constexpr int kNoPixel = -1;  ///< beyond the colour image

/// Detections, 1 + index, in the colour image; more than one image where masks overlap.
std::vector<cv::Mat1w> mask_layers(const std::vector<Detection>& detections, cv::Size color_px) {
  std::vector<cv::Mat1w> layers;
  const auto paint = [&](std::size_t layer, int v, int u, std::uint16_t owner) {
    while (layer < layers.size() && layers[layer](v, u) != 0) ++layer;
    if (layer == layers.size()) layers.emplace_back(color_px, std::uint16_t{0});
    layers[layer](v, u) = owner;
  };
  for (std::size_t n = 0; n < detections.size(); ++n) {
    const auto& [u_min, v_min, u_max, v_max] = detections[n].box;
    for (int v = v_min; v <= v_max; ++v)
      for (int u = u_min; u <= u_max; ++u)
        if (detections[n].mask(v - v_min, u - u_min) != 0)
          paint(0, v, u, static_cast<std::uint16_t>(n + 1));
  }
  return layers;
}

/// Where the colour camera sees the depth pixels of a frame, by the believed calibration.
class ColorView {
 public:
  explicit ColorView(const Sight& sight)
      : sight_(sight),
        believed_(sight.believed()),
        R_(believed_.T_color_depth.linear()),
        t_(believed_.T_color_depth.translation()),
        rays_(believed_.depth) {}

  /// Index of the colour pixel that a depth pixel projects to, or kNoPixel.
  [[nodiscard]] int pixel_of(int v, int u) const {
    const Eigen::Vector3d p = in_color(v, u);
    if (!(p.z() > 0)) return kNoPixel;
    const CameraModel& camera = believed_.color;
    const Eigen::Vector2d at = camera.project(p) + Eigen::Vector2d::Constant(0.5);
    if (!(at.x() >= 0 && at.x() < camera.width_px && at.y() >= 0 && at.y() < camera.height_px))
      return kNoPixel;
    return static_cast<int>(at.y()) * camera.width_px + static_cast<int>(at.x());
  }
  /// Whether that colour pixel, of a mask, sees something nearer than this depth pixel.
  [[nodiscard]] bool hides(int color_pixel, int v, int u) const {
    const int source = sight_.cloud().sources().ptr<int>()[color_pixel];
    if (source == RegisteredCloud::kNone) return false;
    const int columns = sight_.depth().cols;
    const double nearest = in_color(source / columns, source % columns).z();
    return in_color(v, u).z() > (1 + static_cast<double>(kOneSurface)) * nearest;
  }

 private:
  [[nodiscard]] Eigen::Vector3d in_color(int v, int u) const {
    return R_ * rays_.point(u, v, sight_.depth()(v, u) / kDepthUnitsPerMetre) + t_;
  }

  const Sight& sight_;
  const Calibration& believed_;
  Eigen::Matrix3d R_;
  Eigen::Vector3d t_;
  DepthRays rays_;
};

/// How many pixels of each segment the colour camera has in view, and how many each mask holds.
class Overlaps {
 public:
  Overlaps(int segments, std::size_t masks)
      : masks_(masks),
        in_view_(static_cast<std::size_t>(segments) + 1, 0),
        shared_(in_view_.size() * masks, 0) {}

  [[nodiscard]] int& in_view(int segment) { return in_view_[static_cast<std::size_t>(segment)]; }
  [[nodiscard]] int& shared(int segment, std::size_t mask) {
    return shared_[static_cast<std::size_t>(segment) * masks_ + mask];
  }

 private:
  std::size_t masks_;
  std::vector<int> in_view_, shared_;
};

/// The frame's depth pixels with their segments and the masks that hold them.
class SegmentedFrame {
 public:
  SegmentedFrame(const Sight& sight, const DepthSegments& params)
      : sight_(sight),
        segments_(geometric_segments(depth_in_range(sight.depth(), sight.believed()),
                                     sight.believed().depth,
                                     {params.discontinuity, params.convexity,
                                      params.normal_window_px, params.min_segment_px})),
        overlaps_(segments_.count, sight.detections().size()),
        share_(params.least_share()) {
    const CameraModel& camera = sight.believed().color;
    const std::vector<cv::Mat1w> layers =
        mask_layers(sight.detections(), {camera.width_px, camera.height_px});
    const ColorView view(sight);
    masks_.assign(layers.size(), cv::Mat1w());
    for (cv::Mat1w& of_layer : masks_) of_layer = cv::Mat1w(sight.depth().size(), std::uint16_t{0});
    for_segmented([&](int v, int u, int segment) {
      const int pixel = view.pixel_of(v, u);
      if (pixel == kNoPixel) return;
      ++overlaps_.in_view(segment);
      for (std::size_t layer = 0; layer < layers.size(); ++layer) {
        const std::uint16_t owner = layers[layer].ptr<std::uint16_t>()[pixel];
        if (owner == 0 || (layer == 0 && view.hides(pixel, v, u))) return;
        masks_[layer](v, u) = owner;
        ++overlaps_.shared(segment, owner - std::size_t{1});
      }
    });
  }

  /// Calls take(detection, v, u) for the pixels of segments that a mask covers; of several masks
  /// the one that covers most has it, the first of equals.
  void take_covered(const auto& take) {
    std::vector<std::size_t> owner(static_cast<std::size_t>(segments_.count) + 1,
                                   0);  // 1 + detection
    for (int segment = 1; segment <= segments_.count; ++segment)
      for (std::size_t mask = 0; mask < sight_.detections().size(); ++mask) {
        std::size_t& of_segment = owner[static_cast<std::size_t>(segment)];
        if (holds(mask, segment) &&
            (of_segment == 0 ||
             overlaps_.shared(segment, mask) > overlaps_.shared(segment, of_segment - 1)))
          of_segment = mask + 1;
      }
    for_segmented([&](int v, int u, int segment) {
      const std::size_t mask = owner[static_cast<std::size_t>(segment)];
      if (mask != 0) take(mask - 1, v, u);
    });
  }

  /// Calls take(detection, v, u) for the pixels of a mask on segments that lie in it.
  void take_voted(const auto& take) {
    for_segmented([&](int v, int u, int segment) {
      for (const cv::Mat1w& of_layer : masks_) {
        const std::size_t owner = of_layer(v, u);
        if (owner == 0) return;
        if (holds(owner - 1, segment)) take(owner - 1, v, u);
      }
    });
  }

 private:
  [[nodiscard]] bool holds(std::size_t mask, int segment) {
    return overlaps_.shared(segment, mask) > share_ * overlaps_.in_view(segment);
  }
  void for_segmented(const auto& act) const {
    for (int v = 0; v < segments_.labels.rows; ++v)
      for (int u = 0; u < segments_.labels.cols; ++u)
        if (const int segment = segments_.labels(v, u); segment != 0) act(v, u, segment);
  }

  const Sight& sight_;
  GeometricSegments segments_;
  Overlaps overlaps_;
  double share_;
  std::vector<cv::Mat1w> masks_;  ///< by layer, in the depth image: 1 + detection
};

}  // namespace

std::vector<Segment> DepthSegments::segment(const Sight& sight, double voxel_m,
                                            bool with_voxels) const {
  check_ranges(*this);
  if (normal_window_px % 2 == 0) throw Error("normal_window_px: is even; give an odd number");
  std::vector<std::vector<Eigen::Vector3d>> points(sight.detections().size());
  if (!points.empty()) {
    SegmentedFrame frame(sight, *this);
    const DepthRays rays(sight.believed().depth);
    const auto take = [&](std::size_t detection, int v, int u) {
      points[detection].push_back(rays.point(u, v, sight.depth()(v, u) / kDepthUnitsPerMetre));
    };
    rule == SegmentRule::covers ? frame.take_covered(take) : frame.take_voted(take);
  }
  std::vector<Segment> segments;
  for (std::size_t n = 0; n < points.size(); ++n)
    segments.push_back(
        described(segment_of(std::move(points[n]), voxel_m, with_voxels), sight.detections()[n]));
  return segments;
}

}  // namespace mapscore
