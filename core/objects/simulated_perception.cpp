// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/objects/simulated_perception.hpp"

#include "core/geometry/depth_rays.hpp"
#include "core/objects/box_depth.hpp"

#include <algorithm>
#include <limits>

namespace mapscore {
namespace {

/// A widened box in the camera's frame.
struct Part {
  InstanceId instance = 0;
  ObjectBox box;
};

/// Those that the camera frames, the largest first; of equal ones the last first, so that what is
/// painted later wins.
std::vector<Part> framed_parts(std::span<const PerceivedModel> models, const PosedDepth& view,
                               double tolerance_m) {
  const Frustum frustum(view.camera, view.range_min_m, view.range_max_m);
  const Pose T_camera_map = view.T_map_camera.inverse();
  std::vector<Part> parts;
  for (const PerceivedModel& model : models)
    for (const ObjectBox& part : model.parts)
      if (const ObjectBox box = moved(T_camera_map, part.widened(tolerance_m)); frustum.meets(box))
        parts.push_back({model.instance, box});
  std::reverse(parts.begin(), parts.end());
  std::stable_sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) {
    return a.box.volume_m3() > b.box.volume_m3();
  });
  return parts;
}

/// Labels the pixels whose measured point lies in the box.
void paint(const Part& part, const PosedDepth& view, const DepthRays& slopes, cv::Mat1w& label) {
  const BoxRays rays(part.box, view.range_min_m, view.range_max_m);
  const PixelBox pixels = pixels_of(part.box, view.camera, view.range_min_m);
  for (int v = pixels.v_min; v <= pixels.v_max; ++v) {
    const std::uint16_t* depth = view.depth[v];
    std::uint16_t* instance = label[v];
    const double y = slopes.y()[static_cast<std::size_t>(v)];
    for (int u = pixels.u_min; u <= pixels.u_max; ++u) {
      const double z = depth[u] / kDepthUnitsPerMetre;
      const DepthInterval in_box = rays.at(slopes.x()[static_cast<std::size_t>(u)], y);
      if (in_box.in_m <= z && z <= in_box.out_m) instance[u] = part.instance;
    }
  }
}

void forget_below(int min_pixels, cv::Mat1w& label) {
  if (min_pixels <= 1) return;
  std::vector<int> votes(std::numeric_limits<InstanceId>::max() + 1);
  for (const InstanceId instance : label) ++votes[instance];
  for (InstanceId& instance : label)
    if (votes[instance] < min_pixels) instance = 0;
}

}  // namespace

cv::Mat1w perceive(std::span<const PerceivedModel> models, const PosedDepth& view,
                   double tolerance_m, int min_pixels) {
  check(view);
  const DepthRays slopes(view.camera);
  cv::Mat1w label = cv::Mat1w::zeros(view.depth.size());
  for (const Part& part : framed_parts(models, view, tolerance_m)) paint(part, view, slopes, label);
  forget_below(min_pixels, label);
  return label;
}

cv::Mat1w labels_in_color(const cv::Mat1w& depth_label, const RegisteredCloud& cloud) {
  cv::Mat1w label = cv::Mat1w::zeros(cloud.height_px(), cloud.width_px());
  for (int v = 0; v < label.rows; ++v)
    for (int u = 0; u < label.cols; ++u)
      if (const int source = cloud.source(u, v); source != RegisteredCloud::kNone)
        label(v, u) = depth_label(source / depth_label.cols, source % depth_label.cols);
  return label;
}

}  // namespace mapscore
