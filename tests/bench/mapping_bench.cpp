// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

// Carving against OctoMap's own insertPointCloud (discretised), on one thread, frame by frame in
// one run: counters `octomap_ms` and `ours_ms` a frame, their `ratio` (bar: 3), and `equal`, 1 when
// every leaf of both maps is. Frames of a synthetic room; with MAPSCORE_BENCH_RECORDINGS, folders
// with colons between them, also of these, of which the second set of benchmarks maps every frame
// with all classes: memory that the map holds and the sizes of [R, table 3]
// (results/notes/octree.md).

#include "core/mapping/free_space.hpp"
#include "core/mapping/semantic_map.hpp"
#include "core/placement/placement.hpp"
#include "eval/recording/recording.hpp"
#include "tests/bench/peak_memory.hpp"
#include "tests/core/mapping/voxel_filter.hpp"

#include <benchmark/benchmark.h>
#include <octomap/OcTree.h>

#include <chrono>
#include <cstdlib>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace mapscore::eval {
namespace {

/// A frame's points in the map, in single precision as OctoMap has them.
struct Scan {
  Eigen::Vector3d origin;
  std::vector<Eigen::Vector3d> points;
};

Eigen::Vector3d single(const Eigen::Vector3d& p) {
  return p.cast<float>().cast<double>();
}

/// Depth of a room of 6 m x 5 m x 2.5 m with two boxes in it, seen from one of its places.
Scan room_scan(int place) {
  using Box = Eigen::AlignedBox3d;
  using Corner = Eigen::Vector3d;
  const Box room(Corner(0, 0, 0), Corner(6, 5, 2.5));
  const Box boxes[] = {Box(Corner(2, 2, 0), Corner(3, 2.6, 0.8)),
                       Box(Corner(4.5, 0.5, 0), Corner(5, 1, 2))};
  const auto camera = CameraModel::from_hfov(640, 480, 1.02);
  Pose T_map_camera = planar_pose(1.0 + 0.13 * place, 1.2 + 0.09 * place, 0.7 * place);
  T_map_camera.translation().z() = 1.113;
  Eigen::Matrix3d optical;
  optical << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  const Eigen::Matrix3d R = T_map_camera.linear() * optical;
  Scan scan{single(T_map_camera.translation()), {}};
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u) {
      const Eigen::Vector3d ray = R * camera.back_project(u, v, 1.0);
      const auto slabs = [&](const Eigen::AlignedBox3d& box) {
        const Eigen::Array3d a = (box.min() - scan.origin).array() / ray.array();
        const Eigen::Array3d b = (box.max() - scan.origin).array() / ray.array();
        return std::pair(a.min(b).maxCoeff(), a.max(b).minCoeff());
      };
      double z = slabs(room).second;
      for (const auto& box : boxes)
        if (const auto [in, out] = slabs(box); in < out && in > 0) z = std::min(z, in);
      scan.points.push_back(single(scan.origin + z * ray));
    }
  }
  return scan;
}

std::vector<Scan> room_scans() {
  std::vector<Scan> scans;
  for (int place = 0; place < 9; ++place) scans.push_back(room_scan(place));
  return scans;
}

Pose sensor_pose(const Recording& recording, int frame) {
  return recording.T_world_base(frame) * recording.info().calibration.T_base_depth;
}

/// Calls act(pixel u, v, point in depth_optical) where there is depth within the camera's range.
template <class Act>
void for_each_point(const Frame& frame, const Calibration& calibration, Act&& act) {
  for (int v = 0; v < frame.depth.rows; ++v)
    for (int u = 0; u < frame.depth.cols; ++u)
      if (const double z = frame.depth(v, u) / kDepthUnitsPerMetre;
          z > 0 && z >= calibration.range_min_m && z <= calibration.range_max_m)
        act(u, v, calibration.depth.back_project(u, v, z));
}

Scan scan_of(const Recording& recording, int index, const Frame& frame) {
  const Pose T_map_sensor = sensor_pose(recording, index);
  Scan scan{single(T_map_sensor.translation()), {}};
  for_each_point(frame, recording.info().calibration, [&](int, int, const Eigen::Vector3d& p) {
    scan.points.push_back(single(T_map_sensor * p));
  });
  return scan;
}

/// Twenty frames spread over a recording.
std::vector<Scan> recorded_scans(const std::string& folder) {
  const Recording recording = Recording::open(folder);
  std::vector<Scan> scans;
  for (int n = 0; n < 20; ++n) {
    const int index = n * (recording.frame_count() - 1) / 19;
    scans.push_back(scan_of(recording, index, recording.read(index, {.label = false})));
  }
  return scans;
}

octomap::point3d point3d(const Eigen::Vector3d& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}

template <class Tree, class Other>
bool equal_leaves(const Tree& a, const Other& b) {
  auto leaf = a.begin_leafs();
  auto other = b.begin_leafs();
  for (; leaf != a.end_leafs() && other != b.end_leafs(); ++leaf, ++other)
    if (leaf.getKey() != other.getKey() || leaf.getDepth() != other.getDepth() ||
        leaf->getLogOdds() != other->getLogOdds())
      return false;
  return leaf == a.end_leafs() && other == b.end_leafs();
}

void carve(benchmark::State& state, const std::vector<Scan>& scans, double edge_m) {
  using Clock = std::chrono::steady_clock;
  using Milliseconds = std::chrono::duration<double, std::milli>;
  Milliseconds octomap_ms{}, ours_ms{};
  bool equal = true;
  for (auto _ : state) {
    octomap::OcTree theirs(edge_m);
    SemanticMap ours(edge_m, {.carve = true});
    for (const Scan& scan : scans) {
      octomap::Pointcloud cloud;
      for (const Eigen::Vector3d& p : scan.points) cloud.push_back(point3d(p));
      const auto start = Clock::now();
      theirs.insertPointCloud(cloud, point3d(scan.origin), -1, false, true);
      const auto middle = Clock::now();
      ours.see(scan.origin, scan.points);
      const auto end = Clock::now();
      octomap_ms += middle - start;
      ours_ms += end - middle;
    }
    equal = equal && equal_leaves(theirs, ours.tree());
  }
  const double frames = static_cast<double>(state.iterations() * scans.size());
  state.counters["octomap_ms"] = octomap_ms.count() / frames;
  state.counters["ours_ms"] = ours_ms.count() / frames;
  state.counters["ratio"] = octomap_ms / ours_ms;
  state.counters["equal"] = equal ? 1 : 0;
}

/// Maps of a whole recording: all that a frame shows, background's occupancy included.
class WholeMap {
 public:
  WholeMap(const Recording& recording, double edge_m)
      : recording_(recording), map_(edge_m, {.carve = true}) {}

  void add(int index) {
    const Frame frame =
        recording_.read(index, {.color = true, .label = false, .depth_label = true});
    const Calibration& cameras = recording_.info().calibration;
    const Pose T_map_sensor = sensor_pose(recording_, index);
    std::vector<Eigen::Vector3d> points;
    std::vector<ColouredPoint> coloured;
    std::map<ClassId, ObservedObject> objects;
    for_each_point(frame, cameras, [&](int u, int v, const Eigen::Vector3d& p) {
      points.push_back(T_map_sensor * p);
      coloured.push_back({points.back(), colour_of(frame, cameras.T_color_depth * p)});
      const ClassId id = recording_.info().table.class_of(frame.depth_label(v, u));
      if (id != kBackground) objects[id].positions.push_back(p);
    });
    Observation observation;
    for (auto& [id, object] : objects) {
      object.class_id = id;
      observation.push_back(std::move(object));
    }
    const auto hits = place(observation, {&T_map_sensor, 1}, map_.edge_m());
    map_.see(T_map_sensor.translation(), points, hits);
    map_.fuse(hits, 1, BlendRule{});
    std::vector<ColouredPoint> kept;
    for (const std::size_t n : mapscore::testing::voxel_filter(points, map_.edge_m()))
      kept.push_back(coloured[n]);
    map_.add_colours(kept);
    raw_points_ += points.size();
  }

  [[nodiscard]] SemanticMap& map() { return map_; }
  [[nodiscard]] std::size_t raw_points() const { return raw_points_; }

 private:
  [[nodiscard]] Colour colour_of(const Frame& frame, const Eigen::Vector3d& p_color) const {
    const Eigen::Vector2d pixel = recording_.info().calibration.color.project(p_color);
    const int u = static_cast<int>(std::lround(pixel.x())),
              v = static_cast<int>(std::lround(pixel.y()));
    if (u < 0 || v < 0 || u >= frame.color.cols || v >= frame.color.rows) return {};
    const cv::Vec3b bgr = frame.color(v, u);
    return {bgr[2], bgr[1], bgr[0]};
  }

  const Recording& recording_;
  SemanticMap map_;
  std::size_t raw_points_ = 0;
};

std::size_t bytes_of(const auto& write) {
  std::ostringstream stream;
  write(stream);
  return stream.str().size();
}

/// [R, table 3]: a cloud of x, y, z, rgb (16 bytes a point, as binary .pcd) of all points and of
/// one a voxel; the .bt of a plain OctoMap; the .ot of the semantic octree.
void storage(benchmark::State& state, const std::string& folder, double edge_m) {
  const Recording recording = Recording::open(folder);
  for (auto _ : state) {
    const bench::PeakMemory memory;
    WholeMap whole(recording, edge_m);
    for (int frame = 0; frame < recording.frame_count(); ++frame) whole.add(frame);
    whole.map().prune();
    state.counters["map_MiB"] = memory.held_MiB();
    const SemanticOcTree& tree = whole.map().tree();
    state.counters["nodes"] = static_cast<double>(tree.size());
    state.counters["leaves"] = static_cast<double>(tree.getNumLeafNodes());
    std::size_t surface = 0, occupied = 0;
    for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
      occupied += tree.isNodeOccupied(*leaf);
      surface += leaf->colour().count > 0;
    }
    state.counters["occupied"] = static_cast<double>(occupied);
    state.counters["surface_voxels"] = static_cast<double>(surface);
    state.counters["cloud_KB"] = static_cast<double>(whole.raw_points()) * 16 / 1e3;
    state.counters["cloud_filtered_KB"] = static_cast<double>(surface) * 16 / 1e3;
    state.counters["ot_KB"] =
        static_cast<double>(bytes_of([&](std::ostream& s) { tree.write(s); })) / 1e3;
    std::stringstream stream;
    tree.write(stream);
    const auto plain = SemanticOcTree::read_whole(stream);
    for (auto leaf = plain->begin_leafs(); leaf != plain->end_leafs(); ++leaf)
      leaf->clear_surface();
    state.counters["bt_KB"] =
        static_cast<double>(bytes_of([&](std::ostream& s) { plain->writeBinary(s); })) / 1e3;
  }
}

void register_recording(const std::string& folder) {
  const std::string name = folder.substr(folder.find_last_of('/') + 1);
  for (const double edge_m : {0.05, 0.02}) {
    const std::string at = name + (edge_m == 0.05 ? "/5cm" : "/2cm");
    benchmark::RegisterBenchmark(("carve/" + at).c_str(), [=](benchmark::State& state) {
      carve(state, recorded_scans(folder), edge_m);
    })->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark(("storage/" + at).c_str(),
                                 [=](benchmark::State& state) { storage(state, folder, edge_m); })
        ->Unit(benchmark::kMillisecond)
        ->Iterations(1);
  }
}

const bool kRegistered = [] {
  for (const double edge_m : {0.05, 0.02})
    benchmark::RegisterBenchmark(edge_m == 0.05 ? "carve/room/5cm" : "carve/room/2cm",
                                 [=](benchmark::State& state) {
                                   static const std::vector<Scan> scans = room_scans();
                                   carve(state, scans, edge_m);
                                 })
        ->Unit(benchmark::kMillisecond);
  if (const char* folders = std::getenv("MAPSCORE_BENCH_RECORDINGS")) {
    std::istringstream list(folders);
    for (std::string folder; std::getline(list, folder, ':');) register_recording(folder);
  }
  return true;
}();

}  // namespace
}  // namespace mapscore::eval
