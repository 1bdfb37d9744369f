// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/render/picture.hpp"

#include "core/error.hpp"
#include "sim/render/scene_view.hpp"
#include "sim/world/facets.hpp"
#include "sim/world/shape_bounds.hpp"

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace mapscore::sim {
namespace {

constexpr int kSupersampling = 2;
/// How much of a cube's colour depends on how it is lit.
constexpr float kLitShare = 0.4f;

void check(const View& view) {
  if (view.width_px < 1 || view.height_px < 1 || view.vfov_deg <= 0 || view.vfov_deg >= 180)
    throw Error(fmt::format("view: {} x {} px, vfov_deg {}: give a size and an angle below 180",
                            view.width_px, view.height_px, view.vfov_deg));
  if ((view.target_m - view.eye_m).norm() < 1e-9)
    throw Error("view: eye_m and target_m are the same point; move one");
}

CameraModel camera_of(const View& view) {
  const int width = kSupersampling * view.width_px, height = kSupersampling * view.height_px;
  const double focal = 0.5 * height / std::tan(view.vfov_deg * M_PI / 360.0);
  return {width, height, focal, focal, 0.5 * (width - 1), 0.5 * (height - 1)};
}

/// Optical frame at the eye, upright in the picture; looking straight down, y of the world is up.
Pose pose_of(const View& view) {
  const Eigen::Vector3d forward = (view.target_m - view.eye_m).normalized();
  const bool vertical = std::abs(forward.z()) > 1.0 - 1e-9;
  const Eigen::Vector3d up = vertical ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ();
  Pose pose = Pose::Identity();
  pose.linear().col(0) = forward.cross(up).normalized();
  pose.linear().col(1) = forward.cross(pose.linear().col(0));
  pose.linear().col(2) = forward;
  pose.translation() = view.eye_m;
  return pose;
}

/// Large buildings are looked at from far away.
void see_as_far_as(const View& view, mjvGLCamera& eye) {
  constexpr double kBehindTarget = 3.0;
  const double far_m = kBehindTarget * (view.target_m - view.eye_m).norm();
  eye.frustum_far = std::max(eye.frustum_far, static_cast<float>(far_m));
}

std::vector<bool> hidden_classes(const ClassTable& table, const std::vector<std::string>& names) {
  std::vector<bool> hidden(table.classes.size(), false);
  for (const std::string& name : names) {
    const auto found = std::find_if(table.classes.begin(), table.classes.end(),
                                    [&](const SemanticClass& c) { return c.name == name; });
    if (found == table.classes.end())
      throw Error(fmt::format("view: hidden_classes: no class `{}` in this scene", name));
    hidden[found->id] = true;
  }
  return hidden;
}

/// Mean colour of a texture, 0 to 1.
Eigen::Array3f mean_colour(const mjModel& model, int texture) {
  const int channels = model.tex_nchannel[texture];
  const int texels = model.tex_width[texture] * model.tex_height[texture];
  const mjtByte* texel = model.tex_data + model.tex_adr[texture];
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  for (int i = 0; i < texels; ++i, texel += channels)
    for (int c = 0; c < 3; ++c) sum[c] += texel[channels < 3 ? 0 : c];
  return (sum / (255.0 * std::max(texels, 1))).cast<float>();
}

/// Draws geoms pale and plain, so that cubes stand out: under plain light black things get greys
/// from 0.57 to 0.71, white ones from 0.78 to 0.97.
class Ghosts {
 public:
  explicit Ghosts(const mjModel& model) : model_(model) {
    for (int texture = 0; texture < model.ntex; ++texture)
      textures_.push_back(mean_colour(model, texture));
  }

  [[nodiscard]] mjvGeom of(mjvGeom geom) const {
    Eigen::Map<Eigen::Array3f> rgb(geom.rgba);
    rgb = 0.28f + 0.1f * (rgb * texture_of(geom)).max(0.0f).min(1.0f);
    geom.matid = geom.texid = -1;
    geom.specular = 0.0f;
    geom.emission = 1.55f;
    return geom;
  }

 private:
  [[nodiscard]] Eigen::Array3f texture_of(const mjvGeom& geom) const {
    const int texture =
        geom.matid < 0 ? -1 : model_.mat_texid[mjNTEXROLE * geom.matid + mjTEXROLE_RGB];
    return texture < 0 ? Eigen::Array3f::Ones().eval()
                       : textures_[static_cast<std::size_t>(texture)];
  }

  const mjModel& model_;
  std::vector<Eigen::Array3f> textures_;
};

/// Makes a geom show one colour, lightest where it faces a light.
void paint(const Colour& colour, mjvGeom& geom) {
  const std::uint8_t rgb[3] = {colour.r, colour.g, colour.b};
  for (int channel = 0; channel < 3; ++channel)
    geom.rgba[channel] = kLitShare * static_cast<float>(rgb[channel]) / 255.0f;
  geom.rgba[3] = 1.0f;
  geom.matid = geom.texid = -1;
  geom.emission = (1.0f - kLitShare) / kLitShare;
  geom.specular = 0.0f;
}

/// See View::class_colours.
mjvGeom in_class_colour(mjvGeom geom, const SemanticClass& semantic_class) {
  constexpr Colour kGrey{176, 176, 176};
  paint(semantic_class.id == kBackground ? kGrey : semantic_class.colour, geom);
  return geom;
}

mjvGeom box_of(const Cube& cube) {
  mjvGeom geom =
      box_geom(Eigen::Vector3d::Constant(0.5 * cube.edge_m), cube.centre_world, cube.R_world_cube);
  paint(cube.colour, geom);
  return geom;
}

/// See View::open_ceiling.
bool covers_room(const Shape& shape, const View& view) {
  constexpr double kWide_m = 1.0, kOverhead_m = 0.9;
  const Eigen::AlignedBox3d box = bounds_of(shape);
  return box.sizes().x() > kWide_m && box.sizes().y() > kWide_m &&
         box.min().z() > view.target_m.z() + kOverhead_m && box.max().z() < view.eye_m.z();
}

void add_scene(const World& world, const View& view, SceneBuffer& buffer) {
  const std::vector<bool> hidden = hidden_classes(world.classes(), view.hidden_classes);
  const Ghosts ghosts(world.model());
  for (std::size_t i = 0; i < world.drawn().geoms.size(); ++i) {
    const mjvGeom& geom = world.drawn().geoms[i];
    const InstanceId instance = world.geom_instances()[geom.objid];
    const ClassId class_id = world.classes().class_of(instance);
    if (hidden[class_id]) continue;
    if (view.open_ceiling && covers_room(world.shapes()[i], view)) continue;
    if (view.class_colours)
      buffer.add(in_class_colour(geom, world.classes().classes[class_id]));
    else
      buffer.add(view.ghost_scene ? ghosts.of(geom) : geom);
  }
}

}  // namespace

cv::Mat3b draw_picture(const World& world, Offscreen& offscreen, const View& view,
                       std::span<const Cube> cubes) {
  check(view);
  const CameraModel camera = camera_of(view);
  SceneBuffer buffer(world.model(), world.drawn(), world.drawn().geoms.size() + cubes.size());
  add_scene(world, view, buffer);
  for (const Cube& cube : cubes) buffer.add(box_of(cube));
  mjvGLCamera eye = gl_camera(camera, pose_of(view));
  see_as_far_as(view, eye);
  buffer.show_colours(false);
  if (view.ghost_scene || view.class_colours) buffer.light_plainly();
  buffer.look_through(eye);
  buffer.hide_sky();
  offscreen.draw(camera.width_px, camera.height_px, buffer.scene());
  cv::Mat3b large, picture;
  cv::Mat1f depth;
  offscreen.read(large, &depth);
  large.setTo(cv::Scalar::all(255), depth == 0);
  cv::resize(large, picture, {view.width_px, view.height_px}, 0, 0, cv::INTER_AREA);
  cv::flip(picture, picture, 0);
  return picture;
}

}  // namespace mapscore::sim
