// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/rivals/geometric_segments.hpp"

#include "core/wide_vectors.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace mapscore {
namespace {

constexpr int kConcaveReach_px = 2;      // a window of 5 x 5
constexpr float kConcaveRise_m = 5e-4F;  // above the tangent plane
constexpr int kFillReach_px = 4;         // a window of 9 x 9
constexpr float kFillReach_m = 0.05F;

/// Depth steps: in 3 x 3 pixels, of which those without depth count as 0, the farthest or the
/// nearest is off by more than this share of the pixel's own depth.
cv::Mat1b discontinuities(const cv::Mat1f& depth_m, double share) {
  const cv::Mat window = cv::Mat1b::ones(3, 3);
  cv::Mat1f farthest, nearest;
  cv::dilate(depth_m, farthest, window);
  cv::erode(depth_m, nearest, window);
  cv::Mat1b steps(depth_m.size());
  const auto ratio = static_cast<float>(share);
  for (int v = 0; v < depth_m.rows; ++v) {
    const float *z = depth_m[v], *far = farthest[v], *near = nearest[v];
    std::uint8_t* step = steps[v];
    for (int u = 0; u < depth_m.cols; ++u)
      step[u] = std::max(far[u] - z[u], z[u] - near[u]) > ratio * z[u] ? 255 : 0;
  }
  return steps;
}

/// Rows of points and normals of pixels, some of which are compared with others.
struct Row {
  const float *x, *y, *z, *nx, *ny, *nz;
  const std::int32_t* has_normal;
};

/// Marks the pixels p of a row that a row of pixels q shows to be concave: q rises above the
/// tangent plane at p, and their normals differ. Without a normal, which is (0, 0, 0), p has no q
/// above it.
MAPSCORE_WIDE_VECTORS
void mark_concave(const Row& p, const Row& q, int count, float convexity, std::int32_t* concave) {
  const Row a = p, b = q;
  for (int u = 0; u < count; ++u) {
    const float rise =
        (b.x[u] - a.x[u]) * a.nx[u] + (b.y[u] - a.y[u]) * a.ny[u] + (b.z[u] - a.z[u]) * a.nz[u];
    const float cosine = a.nx[u] * b.nx[u] + a.ny[u] * b.ny[u] + a.nz[u] * b.nz[u];
    concave[u] |= static_cast<std::int32_t>(rise >= kConcaveRise_m) &
                  static_cast<std::int32_t>(cosine <= convexity) & b.has_normal[u];
  }
}

/// Concave pixels: one of the pixels within kConcaveReach_px shows it.
cv::Mat1b concavities(const VectorImage& points, const VectorImage& normals, double convexity) {
  constexpr int kReach = kConcaveReach_px;
  const int columns = points.z.cols, rows = points.z.rows;
  cv::Mat1b marked(rows, columns, std::uint8_t{0});
  if (columns == 0) return marked;
  cv::Mat1i has_normal(rows, columns);
  for (int v = 0; v < rows; ++v)
    for (int u = 0; u < columns; ++u)
      has_normal(v, u) = (normals.x(v, u) != 0) | (normals.y(v, u) != 0) | (normals.z(v, u) != 0);
  std::vector<std::int32_t> concave(static_cast<std::size_t>(columns));
  const auto row_at = [&](int v, int u) {
    return Row{points.x[v] + u,  points.y[v] + u,  points.z[v] + u,  normals.x[v] + u,
               normals.y[v] + u, normals.z[v] + u, has_normal[v] + u};
  };
  for (int v = 0; v < rows; ++v) {
    std::ranges::fill(concave, 0);
    for (int dv = -kReach; dv <= kReach; ++dv)
      for (int du = -kReach; du <= kReach; ++du) {
        if (v + dv < 0 || v + dv >= rows || (du == 0 && dv == 0)) continue;
        const int first = std::max(0, -du), last = std::min(columns, columns - du);
        if (first < last)
          mark_concave(row_at(v, first), row_at(v + dv, first + du), last - first,
                       static_cast<float>(convexity), concave.data() + first);
      }
    for (int u = 0; u < columns; ++u)
      marked(v, u) = concave[static_cast<std::size_t>(u)] != 0 ? 255 : 0;
  }
  return marked;
}

/// Fills gaps of up to two pixels.
void close_gaps(cv::Mat1b& edges) {
  cv::morphologyEx(edges, edges, cv::MORPH_CLOSE, cv::Mat1b::ones(3, 3));
}

/// The connected pieces (8 neighbours) between the edges of at least so many pixels.
GeometricSegments pieces_between(const cv::Mat1b& edges, int least_px) {
  GeometricSegments pieces;
  const int numbers = cv::connectedComponents(edges == 0, pieces.labels, 8, CV_32S);
  std::vector<int> sizes(static_cast<std::size_t>(numbers), 0), kept(sizes.size(), 0);
  for (const int label : pieces.labels) ++sizes[static_cast<std::size_t>(label)];
  for (std::size_t label = 1; label < sizes.size(); ++label)
    if (sizes[label] >= least_px) kept[label] = ++pieces.count;
  for (int& label : pieces.labels) label = kept[static_cast<std::size_t>(label)];
  return pieces;
}

/// The piece of the nearest point within reach of pixel (u, v), the first of equally near ones in
/// row-major order; 0 where there is none.
int nearest_piece(const cv::Mat1i& pieces, const VectorImage& points, int u, int v) {
  const float x = points.x(v, u), y = points.y(v, u), z = points.z(v, u);
  const int left = std::max(0, u - kFillReach_px);
  const int right = std::min(pieces.cols - 1, u + kFillReach_px);
  const int bottom = std::min(pieces.rows - 1, v + kFillReach_px);
  float nearest = kFillReach_m * kFillReach_m;
  int piece = 0;
  for (int row = std::max(0, v - kFillReach_px); row <= bottom; ++row) {
    const int* of_row = pieces[row];
    const float *xs = points.x[row], *ys = points.y[row], *zs = points.z[row];
    for (int column = left; column <= right; ++column) {
      if (of_row[column] == 0) continue;
      const float dx = xs[column] - x, dy = ys[column] - y, dz = zs[column] - z;
      const float distance = dx * dx + dy * dy + dz * dz;
      if (distance >= nearest) continue;
      nearest = distance;
      piece = of_row[column];
    }
  }
  return piece;
}

}  // namespace

cv::Mat1b geometric_edges(const VectorImage& points, const CameraModel& camera,
                          const GeometricParams& params) {
  cv::Mat1b edges = discontinuities(points.z, params.discontinuity);
  cv::Mat1b concave = concavities(
      points, surface_normals(points.z, camera, params.normal_window_px), params.convexity);
  close_gaps(edges);
  close_gaps(concave);
  edges |= concave;
  edges.setTo(255, points.z == 0);
  return edges;
}

GeometricSegments geometric_segments(const cv::Mat1f& depth_m, const CameraModel& camera,
                                     const GeometricParams& params) {
  const VectorImage points = points_of(depth_m, camera);
  const GeometricSegments pieces =
      pieces_between(geometric_edges(points, camera, params), params.min_segment_px);
  GeometricSegments segments{pieces.labels.clone(), pieces.count};
  for (int v = 0; v < depth_m.rows; ++v)
    for (int u = 0; u < depth_m.cols; ++u)
      if (pieces.labels(v, u) == 0 && depth_m(v, u) > 0)
        segments.labels(v, u) = nearest_piece(pieces.labels, points, u, v);
  return segments;
}

}  // namespace mapscore
