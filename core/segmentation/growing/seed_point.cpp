// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/growing/seed_point.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace mapscore {
namespace {

std::optional<Eigen::Vector3d> point_at(const RegisteredCloud& cloud, int u, int v) {
  const int source = cloud.source(u, v);
  if (source == RegisteredCloud::kNone) return std::nullopt;
  return cloud.point(source);
}

/// Mask pixels of one detection, in coordinates of its box.
struct MaskedCloud {
  const Detection& detection;
  const RegisteredCloud& cloud;

  [[nodiscard]] std::optional<Eigen::Vector3d> point(const cv::Point& pixel) const {
    return point_at(cloud, pixel.x + detection.box.u_min, pixel.y + detection.box.v_min);
  }
  /// Depth of every mask pixel with a point, 0 elsewhere.
  [[nodiscard]] cv::Mat1d depths() const {
    cv::Mat1d depths(detection.mask.size(), 0.0);
    for (int v = 0; v < depths.rows; ++v)
      for (int u = 0; u < depths.cols; ++u)
        if (detection.mask(v, u))
          depths(v, u) = point({u, v}).value_or(Eigen::Vector3d::Zero()).z();
    return depths;
  }
};

/// Mean of the pixels that are not 0.
cv::Point2d centroid_of(const cv::Mat1b& pixels) {
  double sum_u = 0, sum_v = 0, count = 0;
  for (int v = 0; v < pixels.rows; ++v)
    for (int u = 0; u < pixels.cols; ++u)
      if (pixels(v, u)) sum_u += u, sum_v += v, count += 1;
  return {sum_u / count, sum_v / count};
}

/// Point of the pixel with a point that is nearest to the centroid of `pixels`, ties in row-major
/// order.
std::optional<Eigen::Vector3d> point_near_centroid(const MaskedCloud& cloud,
                                                   const cv::Mat1b& pixels) {
  const cv::Point2d centroid = centroid_of(pixels);
  std::optional<Eigen::Vector3d> nearest;
  double least = std::numeric_limits<double>::infinity();
  for (int v = 0; v < pixels.rows; ++v) {
    for (int u = 0; u < pixels.cols; ++u) {
      const double du = u - centroid.x, dv = v - centroid.y;
      if (!pixels(v, u) || du * du + dv * dv >= least) continue;
      const auto point = cloud.point({u, v});
      if (!point) continue;
      least = du * du + dv * dv;
      nearest = point;
    }
  }
  return nearest;
}

bool continuous(double a_m, double b_m) {
  return a_m > 0 && b_m > 0 && std::abs(a_m - b_m) <= kPieceStep * std::min(a_m, b_m);
}

/// The pixels of `start`'s piece; those that belong to a piece are noted in `seen`.
std::vector<cv::Point> piece_of(const cv::Mat1d& depths, const cv::Point& start, cv::Mat1b& seen) {
  std::vector<cv::Point> piece{start};
  seen(start) = 255;
  for (std::size_t next = 0; next < piece.size(); ++next) {
    const cv::Point at = piece[next];
    for (const cv::Point& step :
         {cv::Point(0, -1), cv::Point(-1, 0), cv::Point(1, 0), cv::Point(0, 1)}) {
      const cv::Point other = at + step;
      if (other.x < 0 || other.y < 0 || other.x >= depths.cols || other.y >= depths.rows) continue;
      if (seen(other) || !continuous(depths(at), depths(other))) continue;
      seen(other) = 255;
      piece.push_back(other);
    }
  }
  return piece;
}

/// The piece of most pixels, ties to the one that comes first in row-major order; empty when no
/// mask pixel has a point.
cv::Mat1b largest_piece(const cv::Mat1d& depths) {
  cv::Mat1b seen(depths.size(), std::uint8_t{0});
  std::vector<cv::Point> largest;
  for (int v = 0; v < depths.rows; ++v) {
    for (int u = 0; u < depths.cols; ++u) {
      if (seen(v, u) || !(depths(v, u) > 0)) continue;
      std::vector<cv::Point> piece = piece_of(depths, {u, v}, seen);
      if (piece.size() > largest.size()) largest = std::move(piece);
    }
  }
  if (largest.empty()) return {};
  cv::Mat1b pixels(depths.size(), std::uint8_t{0});
  for (const cv::Point& pixel : largest) pixels(pixel) = 255;
  return pixels;
}

/// Chessboard distance of each mask pixel to the nearest pixel outside, 0 outside. Beyond the
/// image's edge the mask goes on; without any pixel outside it is the box's longer side.
cv::Mat1f distances_inside(const Detection& detection, const RegisteredCloud& cloud) {
  const PixelBox& box = detection.box;
  const int left = box.u_min > 0, top = box.v_min > 0;
  const int right = box.u_max < cloud.width_px() - 1, bottom = box.v_max < cloud.height_px() - 1;
  cv::Mat1b padded;
  cv::copyMakeBorder(detection.mask, padded, top, bottom, left, right, cv::BORDER_CONSTANT, 0);
  cv::Mat1f distances;
  cv::distanceTransform(padded, distances, cv::DIST_C, 3);
  const cv::Mat1f inside = distances(cv::Rect({left, top}, detection.mask.size()));
  return cv::min(inside, static_cast<float>(std::max(box.width(), box.height())));
}

/// A pixel of the medial axis: none of its 4 neighbours lies deeper inside.
struct AxisPixel {
  cv::Point at;
  double depth_m;
  double inside_px;
};

std::vector<AxisPixel> medial_axis(const cv::Mat1f& distances, const cv::Mat1d& depths) {
  cv::Mat1f greatest;
  cv::dilate(distances, greatest, cv::getStructuringElement(cv::MORPH_CROSS, {3, 3}));
  std::vector<AxisPixel> axis;
  for (int v = 0; v < depths.rows; ++v)
    for (int u = 0; u < depths.cols; ++u)
      if (depths(v, u) > 0 && distances(v, u) >= greatest(v, u))
        axis.push_back({{u, v}, depths(v, u), distances(v, u)});
  return axis;
}

/// Of the window of depth that weighs most, each pixel by how deep inside it lies, the pixel that
/// lies deepest; of equal windows the nearest, of equal pixels the first in row-major order.
std::optional<cv::Point> mode_pixel(std::vector<AxisPixel> axis) {
  if (axis.empty()) return std::nullopt;
  std::stable_sort(axis.begin(), axis.end(),
                   [](const AxisPixel& a, const AxisPixel& b) { return a.depth_m < b.depth_m; });
  double weight = 0, most = -1;
  std::size_t end = 0, best_first = 0, best_end = 0;
  for (std::size_t first = 0; first < axis.size(); ++first) {
    for (; end < axis.size() && axis[end].depth_m <= (1 + kModeWidth) * axis[first].depth_m; ++end)
      weight += axis[end].inside_px;
    if (weight > most) most = weight, best_first = first, best_end = end;
    weight -= axis[first].inside_px;
  }
  const AxisPixel* best = &axis[best_first];
  const auto before = [](const cv::Point& a, const cv::Point& b) {
    return a.y != b.y ? a.y < b.y : a.x < b.x;
  };
  for (std::size_t n = best_first; n < best_end; ++n)
    if (axis[n].inside_px > best->inside_px ||
        (axis[n].inside_px == best->inside_px && before(axis[n].at, best->at)))
      best = &axis[n];
  return best->at;
}

}  // namespace

std::optional<Eigen::Vector3d> seed_point(const Detection& detection, const RegisteredCloud& cloud,
                                          SeedRule rule) {
  const PixelBox& box = detection.box;
  const MaskedCloud masked{detection, cloud};
  switch (rule) {
    case SeedRule::box_centre:
      return point_at(cloud, (box.u_min + box.u_max) / 2, (box.v_min + box.v_max) / 2);
    case SeedRule::mask_centroid:
      return point_near_centroid(masked, detection.mask);
    case SeedRule::largest_piece:
      return point_near_centroid(masked, largest_piece(masked.depths()));
    case SeedRule::depth_mode: {
      const auto axis = medial_axis(distances_inside(detection, cloud), masked.depths());
      const auto pixel = mode_pixel(axis);
      return pixel ? masked.point(*pixel) : std::nullopt;
    }
  }
  return std::nullopt;
}

}  // namespace mapscore
