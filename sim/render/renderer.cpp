// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/render/renderer.hpp"

#include "sim/render/offscreen.hpp"
#include "sim/render/picture.hpp"
#include "sim/render/scene_view.hpp"

#include <algorithm>
#include <cmath>

namespace mapscore::sim {
namespace {

/// Instance ids of a segmentation pass (colour = id + 1, black = nothing), row 0 at the top.
cv::Mat1w instance_ids(const cv::Mat3b& bgr_from_bottom) {
  cv::Mat1w ids(bgr_from_bottom.size());
  for (int row = 0; row < ids.rows; ++row) {
    const cv::Vec3b* source = bgr_from_bottom[ids.rows - 1 - row];
    std::uint16_t* target = ids[row];
    for (int column = 0; column < ids.cols; ++column) {
      const int colour = source[column][2] | source[column][1] << 8 | source[column][0] << 16;
      target[column] = static_cast<std::uint16_t>(colour > 0 ? colour - 1 : 0);
    }
  }
  return ids;
}

cv::Mat1f metric_depth(const cv::Mat1f& buffer_from_bottom, const DepthScale& scale) {
  cv::Mat1f metres(buffer_from_bottom.size());
  for (int row = 0; row < metres.rows; ++row) {
    const float* source = buffer_from_bottom[metres.rows - 1 - row];
    float* target = metres[row];
    for (int column = 0; column < metres.cols; ++column)
      target[column] = scale.metres(source[column]);
  }
  return metres;
}

/// Depth as it is stored, in 1/5000 m, rounded to the nearest; 0 outside the range, limits
/// included.
cv::Mat1w stored_depth(const cv::Mat1f& metres, double range_min_m, double range_max_m) {
  const long lowest = std::lround(range_min_m * kDepthUnitsPerMetre);
  const long highest = std::lround(range_max_m * kDepthUnitsPerMetre);
  cv::Mat1w depth(metres.size());
  for (int row = 0; row < depth.rows; ++row) {
    for (int column = 0; column < depth.cols; ++column) {
      const long units = std::lround(metres(row, column) * kDepthUnitsPerMetre);
      const bool in_range = units >= lowest && units <= highest;
      depth(row, column) = static_cast<std::uint16_t>(in_range ? units : 0);
    }
  }
  return depth;
}

}  // namespace

struct Renderer::State {
  State(const World& drawn_world, bool with_shadows, bool coarse)
      : world(drawn_world),
        shadows(with_shadows),
        offscreen(drawn_world.model(), coarse),
        scene(drawn_world),
        buffer(drawn_world.model(), drawn_world.drawn(), drawn_world.drawn().geoms.size()) {}

  void move_to(double stamp_s) {
    scene.move_to(stamp_s);
    buffer.light_as(scene.drawn());
  }

  Pose T_world_depth(const Pose& T_world_base) const {
    return T_world_base * world.calibration().T_base_depth;
  }
  Pose T_world_color(const Pose& T_world_base) const {
    return T_world_depth(T_world_base) * world.calibration().T_color_depth.inverse();
  }

  /// Fills the buffer with the geoms that can be seen, or cast a visible shadow.
  void look(const CameraModel& camera, const Pose& T_world_optical, bool with_shades) {
    const Frustum frustum(camera, T_world_optical);
    buffer.clear();
    for (const mjvGeom& geom : scene.drawn().geoms) {
      const Eigen::Vector3d centre = Eigen::Map<const Eigen::Vector3f>(geom.pos).cast<double>();
      const bool unbounded = geom.modelrbound <= 0;
      if (unbounded || frustum.may_see(centre, geom.modelrbound) ||
          (with_shades && shades(frustum, centre, geom)))
        buffer.add(geom);
    }
    buffer.look_through(gl_camera(camera, T_world_optical));
  }

  bool shades(const Frustum& frustum, const Eigen::Vector3d& centre, const mjvGeom& geom) const {
    const std::vector<mjvLight>& lights = scene.drawn().lights;
    return std::any_of(lights.begin(), lights.end(), [&](const mjvLight& light) {
      return light.castshadow && frustum.may_shade(centre, geom.modelrbound, light);
    });
  }

  cv::Mat3b colour(const CameraModel& camera, const Pose& T_world_optical) {
    look(camera, T_world_optical, shadows);
    buffer.show_colours(shadows);
    offscreen.draw(camera.width_px, camera.height_px, buffer.scene());
    offscreen.read(pixels);
    cv::Mat3b image;
    cv::flip(pixels, image, 0);
    return image;
  }

  cv::Mat1w ids(const CameraModel& camera, const Pose& T_world_optical, cv::Mat1f* metres) {
    look(camera, T_world_optical, false);
    buffer.show_ids();
    offscreen.draw(camera.width_px, camera.height_px, buffer.scene());
    offscreen.read(pixels, metres ? &depth_buffer : nullptr);
    if (metres) *metres = metric_depth(depth_buffer, offscreen.depth_scale());
    return instance_ids(pixels);
  }

  World world;  // shares its state
  bool shadows;
  Offscreen offscreen;
  MovingScene scene;
  SceneBuffer buffer;
  cv::Mat3b pixels;        ///< as read, row 0 at the bottom
  cv::Mat1f depth_buffer;  ///< as read, row 0 at the bottom
};

Renderer::Renderer(const World& world, bool shadows, bool coarse)
    : state_(std::make_unique<State>(world, shadows, coarse)) {}
Renderer::~Renderer() = default;

void Renderer::render_color(const StampedPose& instant, Frame& frame) {
  const CameraModel& camera = state_->world.calibration().color;
  const Pose T_world_color = state_->T_world_color(instant.T_world_base);
  state_->move_to(instant.stamp_s);
  frame.color = state_->colour(camera, T_world_color);
  frame.label = state_->ids(camera, T_world_color, nullptr);
}

void Renderer::render_label(const StampedPose& instant, Frame& frame) {
  state_->move_to(instant.stamp_s);
  frame.label = state_->ids(state_->world.calibration().color,
                            state_->T_world_color(instant.T_world_base), nullptr);
}

void Renderer::render_depth(const StampedPose& instant, Frame& frame) {
  const Calibration& calibration = state_->world.calibration();
  state_->move_to(instant.stamp_s);
  frame.stamp_s = instant.stamp_s;
  frame.T_world_base = instant.T_world_base;
  cv::Mat1f metres;
  frame.depth_label =
      state_->ids(calibration.depth, state_->T_world_depth(instant.T_world_base), &metres);
  frame.depth = stored_depth(metres, calibration.range_min_m, calibration.range_max_m);
  frame.depth_label.setTo(0, frame.depth == 0);
}

cv::Mat1f Renderer::render_metric_depth(const Pose& T_world_base) {
  cv::Mat1f metres;
  state_->ids(state_->world.calibration().depth, state_->T_world_depth(T_world_base), &metres);
  return metres;
}

cv::Mat3b Renderer::picture(const View& view, std::span<const Cube> cubes) {
  return draw_picture(state_->world, state_->offscreen, view, cubes);
}

}  // namespace mapscore::sim
