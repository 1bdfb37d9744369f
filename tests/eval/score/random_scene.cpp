// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/eval/score/random_scene.hpp"

#include "core/random_stream.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace mapscore::eval::testing {
namespace {

using Eigen::Vector3d;

constexpr int kLastClass = kClasses - 1;
constexpr int kInstances = 7;
constexpr double kGrain_m = 1.0 / (1 << 20);

int whole(RandomStream& random, int low, int high) {
  return low + static_cast<int>(random.uniform() * (high - low + 1));
}

Vector3d vector_in(RandomStream& random, double low, double high) {
  const double x = random.uniform(), y = random.uniform(), z = random.uniform();
  return (Vector3d(x, y, z) * (high - low)).array() + low;
}

Vector3d rounded(const Vector3d& v, double grain) {
  return (v / grain).array().round().matrix() * grain;
}

Eigen::Matrix3d any_rotation(RandomStream& random) {
  const Vector3d axis = vector_in(random, -1, 1).normalized();
  return Eigen::AngleAxisd(2 * std::numbers::pi * random.uniform(), axis).toRotationMatrix();
}

ClassTable three_detected_classes() {
  ClassTable table;
  for (ClassId c = 1; c < kClasses; ++c) table.classes.push_back({c, "class", {}, true});
  for (InstanceId n = 1; n < kInstances; ++n) {
    table.instances.push_back({n, "instance", static_cast<ClassId>(1 + (n - 1) / 2)});
  }
  return table;
}

void add_triangles(RandomStream& random, double edge_m, bool on_lattice, Shape& shape) {
  std::vector<Vector3d> corners;
  for (int n = whole(random, 3, 6); n > 0; --n) {
    const Vector3d corner = vector_in(random, -0.25, 0.25);
    corners.push_back(rounded(corner, on_lattice ? edge_m : kGrain_m));
  }
  for (std::size_t n = 2; n < corners.size(); ++n) {
    shape.triangles.push_back({corners[n - 2], corners[n - 1], corners[n]});
  }
}

/// On the lattice or anywhere.
Shape free_shape(RandomStream& random, double edge_m) {
  Shape shape;
  shape.kind = static_cast<ShapeKind>(whole(random, 0, 6));
  shape.instance = static_cast<InstanceId>(whole(random, 0, kInstances - 1));
  const bool on_lattice = random.uniform() < 0.4;
  shape.T_world_shape.translation() =
      rounded(vector_in(random, -0.3, 0.3), on_lattice ? edge_m / 2 : kGrain_m);
  shape.size = rounded(vector_in(random, 0.03, 0.2), on_lattice ? edge_m / 2 : kGrain_m)
                   .cwiseMax(Vector3d::Constant(on_lattice ? edge_m / 2 : 0.03));
  if (!on_lattice) shape.T_world_shape.linear() = any_rotation(random);
  if (shape.kind == ShapeKind::mesh) add_triangles(random, edge_m, on_lattice, shape);
  return shape;
}

/// A box that touches, fills a part of, or goes through the box around the shape before.
Shape box_beside(const Shape& before, RandomStream& random) {
  Shape shape;
  shape.kind = ShapeKind::box;
  shape.instance = static_cast<InstanceId>(whole(random, 0, kInstances - 1));
  shape.T_world_shape = before.T_world_shape;
  const Vector3d half = before.size.cwiseMax(Vector3d::Constant(0.03125));
  shape.size = half;
  const double manner = random.uniform();
  if (manner < 0.4) {
    shape.T_world_shape.translation() += shape.T_world_shape.linear().col(0) * (2 * half.x());
  } else if (manner < 0.7) {
    shape.size = half / 2;
  } else {
    shape.size = Vector3d(half.x() / 2, half.y() / 2, 2 * half.z());
  }
  return shape;
}

/// Camera at `eye` that looks to the origin: z forward, x right.
Pose looking_inwards(const Vector3d& eye) {
  const Vector3d z = -eye.normalized();
  const Vector3d x = z.cross(Vector3d(0.1, 0.2, 1).normalized()).normalized();
  Pose pose = Pose::Identity();
  pose.linear() << x, z.cross(x), z;
  pose.translation() = eye;
  return pose;
}

/// Planar z of the first point of the ray in a voxel of the surface, 0 without; the voxel too.
double first_hit(const SurfaceTruth& surface, const Pose& T_map_camera, const Vector3d& ray,
                 VoxelKey& voxel) {
  const Calibration calibration = view_calibration();
  const double step = surface.edge_m() / 3;
  for (double z = calibration.range_min_m + step; z < calibration.range_max_m; z += step) {
    const double stored = std::round(z * kDepthUnitsPerMetre) / kDepthUnitsPerMetre;
    voxel = voxel_of(T_map_camera * (stored * ray), surface.edge_m());
    if (surface.touches_any(voxel)) return stored;
  }
  return 0.0;
}

}  // namespace

SurfaceTruth RandomScene::surface() const {
  return surface_truth(shapes, table, Pose::Identity(), {edge_m, epsilon_m, 1});
}

RandomScene random_scene(std::uint64_t seed, bool dyadic) {
  RandomStream random(seed, "random scene");
  RandomScene scene;
  scene.table = three_detected_classes();
  scene.edge_m = dyadic ? whole(random, 3, 8) / 64.0 : 0.045 + 0.08 * random.uniform();
  scene.epsilon_m = random.uniform() < 0.5 ? 0.0 : 0.0005;
  for (int n = whole(random, 2, 6); n > 0; --n) {
    const bool beside = !scene.shapes.empty() && random.uniform() < 0.4;
    scene.shapes.push_back(beside ? box_beside(scene.shapes.back(), random)
                                  : free_shape(random, scene.edge_m));
  }
  return scene;
}

Calibration view_calibration() {
  Calibration calibration;
  calibration.depth = CameraModel::from_hfov(20, 15, 0.9);
  calibration.range_min_m = 0.3;
  calibration.range_max_m = 2.5;
  return calibration;
}

std::vector<RandomView> random_views(const SurfaceTruth& surface, std::uint64_t seed,
                                     bool one_class) {
  RandomStream random(seed, "random views");
  const CameraModel camera = view_calibration().depth;
  std::vector<RandomView> views(4);
  for (RandomView& view : views) {
    view.T_map_camera = looking_inwards(1.3 * vector_in(random, -1, 1).normalized());
    view.frame.depth = cv::Mat1w(camera.height_px, camera.width_px, std::uint16_t{0});
    view.frame.depth_label = cv::Mat1w(camera.height_px, camera.width_px, std::uint16_t{0});
    for (int v = 0; v < camera.height_px; ++v) {
      for (int u = 0; u < camera.width_px; ++u) {
        VoxelKey voxel;
        const double z =
            first_hit(surface, view.T_map_camera, camera.back_project(u, v, 1.0), voxel);
        const auto rows = surface.classes_at(voxel);
        if (z == 0.0 || (one_class && rows.size() > 1)) continue;
        const ClassId c = rows[random.bits() % rows.size()].class_id;
        const bool wrong = !one_class && random.uniform() < 0.1;
        view.frame.depth(v, u) = static_cast<std::uint16_t>(std::lround(z * kDepthUnitsPerMetre));
        view.frame.depth_label(v, u) =
            static_cast<std::uint16_t>(wrong              ? whole(random, 0, kInstances)
                                       : c == kBackground ? 0
                                                          : 2 * c - whole(random, 0, 1));
      }
    }
  }
  return views;
}

SampleCounter counted(const RandomScene& scene, const std::vector<RandomView>& views) {
  SampleCounter counter(scene.edge_m);
  for (const RandomView& view : views) {
    counter.add(view.frame, view_calibration(), scene.table, view.T_map_camera);
  }
  return counter;
}

Points points_of(const RandomScene& scene, const std::vector<RandomView>& views) {
  Points points(scene.table.classes.size());
  for (const RandomView& view : views) {
    for (int v = 0; v < view.frame.depth.rows; ++v) {
      for (int u = 0; u < view.frame.depth.cols; ++u) {
        const double z = view.frame.depth(v, u) / kDepthUnitsPerMetre;
        const ClassId c = scene.table.class_of(view.frame.depth_label(v, u));
        if (z == 0.0 || c == kBackground) continue;
        points[c].push_back(view.T_map_camera * view_calibration().depth.back_project(u, v, z));
      }
    }
  }
  return points;
}

std::vector<MapVoxel> random_map(const SurfaceTruth& surface, std::uint64_t seed) {
  RandomStream random(seed, "random map");
  const double dropped = random.uniform(), moved = 0.5 * random.uniform(),
               relabelled = 0.3 * random.uniform(), added = 0.2 * random.uniform(),
               free = 0.2 * random.uniform();
  std::map<VoxelKey, MapVoxel> map;
  const auto put = [&](const VoxelKey& key, ClassId c) {
    const double probability = whole(random, 0, 8) / 8.0;
    map[key] = {key, c, probability, random.uniform() >= free};
  };
  for (const SurfaceVoxel& row : surface.voxels()) {
    VoxelKey key = row.key;
    if (random.uniform() < added) {
      const int i = whole(random, -9, 9), j = whole(random, -9, 9), k = whole(random, -9, 9);
      put({i, j, k}, static_cast<ClassId>(whole(random, 0, kLastClass)));
    }
    if (random.uniform() < dropped) continue;
    if (random.uniform() < moved) {
      key.i += whole(random, -3, 3);
      key.j += whole(random, -3, 3);
      key.k += whole(random, -3, 3);
    }
    const bool other = random.uniform() < relabelled;
    put(key, other ? static_cast<ClassId>(whole(random, 0, kLastClass)) : row.class_id);
  }
  std::vector<MapVoxel> voxels;
  for (const auto& [key, voxel] : map) voxels.push_back(voxel);
  return voxels;
}

SurfaceTruth of_one_class(const SurfaceTruth& surface) {
  std::vector<SurfaceVoxel> rows;
  std::copy_if(surface.voxels().begin(), surface.voxels().end(), std::back_inserter(rows),
               [&](const SurfaceVoxel& row) { return surface.classes_at(row.key).size() == 1; });
  return {std::move(rows), surface.edge_m()};
}

}  // namespace mapscore::eval::testing
