// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/rivals/depth_segments.hpp"

#include "core/error.hpp"
#include "core/geometry/depth_rays.hpp"
#include "core/segmentation/rivals/geometric_segments.hpp"
#include "core/segmentation/rivals/surface_normals.hpp"
#include "core/segmentation/segmentation.hpp"
#include "core/wide_vectors.hpp"

#include <cstddef>
#include <cstdint>
#include <utility>

namespace mapscore {
namespace {

constexpr std::int32_t kNoPixel = -1;  ///< beyond the colour image

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

/// The believed colour camera, as plain numbers.
struct ColorProjection {
  explicit ColorProjection(const Calibration& believed)
      : R(believed.T_color_depth.linear()),
        t(believed.T_color_depth.translation()),
        color(believed.color) {}

  [[nodiscard]] double z_of(const Eigen::Vector3d& p) const {
    return R(2, 0) * p.x() + R(2, 1) * p.y() + R(2, 2) * p.z() + t.z();
  }

  Eigen::Matrix3d R;
  Eigen::Vector3d t;
  CameraModel color;
};

/// The colour pixels that the pixels of a row of the depth image project to, or kNoPixel.
MAPSCORE_WIDE_VECTORS
void project_row(const ColorProjection& projection, const std::uint16_t* depth, const double* ray_x,
                 double ray_y, std::size_t width, std::int32_t* pixels) {
  const ColorProjection camera = projection;  // a copy: what is written cannot change it
  const double columns = camera.color.width_px, rows = camera.color.height_px;
  for (std::size_t u = 0; u < width; ++u) {
    const double z = depth[u] / kDepthUnitsPerMetre, x = z * ray_x[u], y = z * ray_y;
    const double x_color =
        camera.R(0, 0) * x + camera.R(0, 1) * y + camera.R(0, 2) * z + camera.t.x();
    const double y_color =
        camera.R(1, 0) * x + camera.R(1, 1) * y + camera.R(1, 2) * z + camera.t.y();
    const double z_color =
        camera.R(2, 0) * x + camera.R(2, 1) * y + camera.R(2, 2) * z + camera.t.z();
    // Half a pixel more, so that cutting off the fraction rounds.
    double column = camera.color.fx_px * x_color / z_color + camera.color.cx_px + 0.5;
    double row = camera.color.fy_px * y_color / z_color + camera.color.cy_px + 0.5;
    const bool seen =
        (z_color > 0) & (column >= 0) & (column < columns) & (row >= 0) & (row < rows);
    column = seen ? column : 0.0;
    row = seen ? row : 0.0;
    const std::int32_t pixel =
        static_cast<std::int32_t>(row) * camera.color.width_px + static_cast<std::int32_t>(column);
    pixels[u] = seen ? pixel : kNoPixel;
  }
}

/// Where the colour camera sees the depth pixels of a frame, by the believed calibration.
class ColorView {
 public:
  explicit ColorView(const Sight& sight)
      : depth_(sight.depth()),
        sources_(sight.cloud().sources()),
        projection_(sight.believed()),
        rays_(sight.believed().depth) {}

  /// The colour pixel of each pixel of a row of the depth image, or kNoPixel.
  void read_row(int v, std::vector<std::int32_t>& pixels) const {
    pixels.resize(static_cast<std::size_t>(depth_.cols));
    project_row(projection_, depth_[v], rays_.x().data(), rays_.y()[static_cast<std::size_t>(v)],
                pixels.size(), pixels.data());
  }
  /// Whether that colour pixel, of a mask, sees something nearer than this depth pixel.
  [[nodiscard]] bool hides(std::int32_t color_pixel, int v, int u) const {
    const int source = sources_.ptr<int>()[color_pixel];
    if (source == RegisteredCloud::kNone || source == v * depth_.cols + u) return false;
    return z_color(v, u) > (1 + static_cast<double>(kOneSurface)) *
                               z_color(source / depth_.cols, source % depth_.cols);
  }

 private:
  [[nodiscard]] double z_color(int v, int u) const {
    return projection_.z_of(rays_.point(u, v, depth_(v, u) / kDepthUnitsPerMetre));
  }

  cv::Mat1w depth_;
  cv::Mat1i sources_;
  ColorProjection projection_;
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
    std::vector<std::int32_t> pixels;
    for (int v = 0; v < segments_.labels.rows; ++v) {
      view.read_row(v, pixels);
      for (int u = 0; u < segments_.labels.cols; ++u) {
        const std::int32_t pixel = pixels[static_cast<std::size_t>(u)];
        if (segments_.labels(v, u) != 0 && pixel != kNoPixel) find_masks(v, u, pixel, view, layers);
      }
    }
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
  /// Counts a depth pixel that projects into the colour image, and notes the masks that hold it.
  void find_masks(int v, int u, std::int32_t pixel, const ColorView& view,
                  const std::vector<cv::Mat1w>& layers) {
    const int segment = segments_.labels(v, u);
    ++overlaps_.in_view(segment);
    for (std::size_t layer = 0; layer < layers.size(); ++layer) {
      const std::uint16_t owner = layers[layer].ptr<std::uint16_t>()[pixel];
      if (owner == 0 || (layer == 0 && view.hides(pixel, v, u))) return;
      masks_[layer](v, u) = owner;
      ++overlaps_.shared(segment, owner - std::size_t{1});
    }
  }
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
