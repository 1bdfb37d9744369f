// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/color_places.hpp"

#include "core/segmentation/edge_aligned/edge_matching.hpp"

#include <cstdint>

namespace mapscore {
namespace {

/// From a depth pixel to the colour image.
struct RayMotion {
  Eigen::Matrix3f R;
  Eigen::Vector3f t;
  Projection color, depth;
};

/// Projects the pixels of a row of inverse depths w: with p = z ray, p_color / z = R ray + t w.
MAPSCORE_WIDE_VECTORS
void project_row(const RayMotion& motion, int v, const float* w, int columns, float* us,
                 float* vs) {
  const Eigen::Matrix3f& R = motion.R;
  const Projection &color = motion.color, &depth = motion.depth;
  const float y = (static_cast<float>(v) - depth.cy) / depth.fy, inverse_f = 1.0F / depth.fx;
  const float xx = R(0, 0), xy = R(0, 1) * y, xz = R(0, 2), yx = R(1, 0), yy = R(1, 1) * y,
              yz = R(1, 2), zx = R(2, 0), zy = R(2, 1) * y, zz = R(2, 2);
  const float tx = motion.t.x(), ty = motion.t.y(), tz = motion.t.z();
  const float fx = color.fx, fy = color.fy, cx = color.cx, cy = color.cy, centre = depth.cx;
  for (int u = 0; u < columns; ++u) {
    const float x = (static_cast<float>(u) - centre) * inverse_f;
    const float X = xx * x + xy + xz + tx * w[u];
    const float Y = yx * x + yy + yz + ty * w[u];
    const float Z = zx * x + zy + zz + tz * w[u];
    const float inverse_z = 1.0F / Z;
    us[u] = fx * X * inverse_z + cx;
    vs[u] = fy * Y * inverse_z + cy;
  }
}

/// The pixels of an image, row-major, that hold some places; -1 beyond it.
MAPSCORE_WIDE_VECTORS
void find_pixels(const float* us, const float* vs, int count, const cv::Size& image, int* pixels) {
  const int columns = image.width;
  const float right = static_cast<float>(columns), bottom = static_cast<float>(image.height);
  for (int n = 0; n < count; ++n) {
    const float u = us[n] + 0.5F, v = vs[n] + 0.5F;
    const bool within = (u >= 0) & (v >= 0) & (u < right) & (v < bottom);
    const int column = static_cast<int>(within ? u : 0.0F);
    const int row = static_cast<int>(within ? v : 0.0F);
    pixels[n] = within ? row * columns + column : -1;
  }
}

/// Marks the pixels of a row that do not lie beside the one before, in an image that holds both.
MAPSCORE_WIDE_VECTORS
void mark_jumps(const int* cells, int count, std::uint8_t* marks) {
  for (int u = 1; u < count; ++u)
    marks[u] = static_cast<std::uint8_t>((cells[u - 1] < 0) | (cells[u] != cells[u - 1] + 1));
}

}  // namespace

void ColorPlaces::add_runs(int v, Marks& jumps) {
  const int* const cells = cells_[v];
  mark_jumps(cells, cells_.cols, jumps.data());
  first_run_.push_back(runs_.size());
  int begin = 0;
  const auto end_at = [&](int u) {
    if (u > begin && cells[begin] >= 0) runs_.push_back({begin, u - begin, cells[begin]});
    begin = u;
  };
  for_each_marked(jumps, end_at);
  end_at(cells_.cols);
}

ColorPlaces color_places(const cv::Mat1f& inverse_depth, const Calibration& mended,
                         const OutlineShifts& shifts) {
  const Eigen::Isometry3f T_color_depth = mended.T_color_depth.cast<float>();
  const RayMotion motion{T_color_depth.linear(), T_color_depth.translation(),
                         Projection(mended.color), Projection(mended.depth)};
  const cv::Size image(mended.color.width_px, mended.color.height_px);
  std::vector<float> us(static_cast<std::size_t>(inverse_depth.cols)), vs(us.size());
  const auto find_row = [&](int v, int* cells) {
    project_row(motion, v, inverse_depth[v], inverse_depth.cols, us.data(), vs.data());
    if (!shifts.nodes.empty())
      for (std::size_t u = 0; u < us.size(); ++u) {
        const cv::Vec2f by = shifts.at(us[u], vs[u]);
        us[u] += by[0], vs[u] += by[1];
      }
    find_pixels(us.data(), vs.data(), inverse_depth.cols, image, cells);
  };
  return {inverse_depth.size(), find_row};
}

}  // namespace mapscore
