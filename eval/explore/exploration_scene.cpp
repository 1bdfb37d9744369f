// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/explore/exploration_scene.hpp"

#include "core/error.hpp"

#ifdef MAPSCORE_SIMULATOR
#include "core/random_stream.hpp"
#include "eval/explore/standing_floor.hpp"
#include "eval/lab/map_frame.hpp"
#include "eval/lab/shared_cache.hpp"
#include "eval/render/replay_check.hpp"
#include "eval/render/study_drive.hpp"
#include "eval/render/study_recording.hpp"
#include "eval/results/build_identity.hpp"
#include "eval/results/plan.hpp"
#include "eval/results/study_store.hpp"
#include "files/file_bytes.hpp"
#include "sim/render/renderer.hpp"
#include "sim/robot/clearance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <variant>
#endif

namespace mapscore::eval {

namespace fs = std::filesystem;

#ifdef MAPSCORE_SIMULATOR

namespace {

constexpr std::size_t kReachRoom = 1, kStartRoom = 3;  ///< steps of StandingFloor
constexpr double kViewGridM = 0.5;  ///< between places of the dense views, at most
constexpr int kViewHeadings = 8;    ///< at each
constexpr std::size_t kLeastPlaces = 4;
constexpr double kCloudShare = 0.4;                  ///< edge of the cloud's cubes, of a voxel
constexpr std::size_t kScenes = 64, kSurfaces = 32;  ///< kept at once

/// A scene with the robot in it.
struct Scene {
  sim::World world;
  sim::DriveModel drive;
  StandingFloor floor;  ///< with room for a controller's error
  StandingFloor roomy;  ///< with more, to start from
};

/// What of a configuration decides a Scene.
std::string scene_key(const Study& config) {
  Study deciding;
  deciding.scene =
      config.scene ? std::optional(resolve_path(config, *config.scene).string()) : std::nullopt;
  deciding.classes = config.classes;
  deciding.robot = robot_path(config).string();
  deciding.cameras = config.cameras;
  deciding.trajectory.drive = config.trajectory.drive;
  return to_yaml(deciding);
}

Eigen::AlignedBox2d floor_bounds(const sim::DriveModel& drive) {
  const mjModel& model = *drive.model;
  const sim::DataPtr data(mj_makeData(&model));
  mj_kinematics(&model, data.get());
  Eigen::AlignedBox2d bounds;
  for (int geom = 0; geom < model.ngeom; ++geom) {
    if (drive.role[static_cast<std::size_t>(geom)] != sim::GeomRole::scene) continue;
    const Eigen::Vector2d middle(data->geom_xpos[3 * geom], data->geom_xpos[3 * geom + 1]);
    const double reach_m = model.geom_rbound[geom];
    bounds.extend(middle - Eigen::Vector2d::Constant(reach_m));
    bounds.extend(middle + Eigen::Vector2d::Constant(reach_m));
  }
  return bounds;
}

std::shared_ptr<const Scene> make_scene(const Study& config) {
  sim::World world = world_of(config);
  sim::DriveModel drive =
      sim::make_drive_model(world, robot_path(config), drive_settings(config).clearance_m);
  const StandingFloor floor(drive, floor_bounds(drive));
  StandingFloor reachable = floor.with_room(kReachRoom), roomy = floor.with_room(kStartRoom);
  return std::make_shared<const Scene>(
      Scene{std::move(world), std::move(drive), std::move(reachable), std::move(roomy)});
}

PlanarPose given_start(const std::array<double, 3>& start_m_deg, const sim::DriveModel& drive) {
  const PlanarPose start{start_m_deg[0], start_m_deg[1], start_m_deg[2] * std::numbers::pi / 180.0};
  sim::Clearance clearance(drive);
  if (const auto obstacle = clearance.obstacle_at(start))
    throw Error(fmt::format(
        "exploration.start_m_deg: the robot would stand in `{}` at ({:.2f}, {:.2f} m); move the "
        "start away from it, or leave it out",
        obstacle->body, obstacle->x_m, obstacle->y_m));
  if (!clearance.floor_at(start))
    throw Error(
        "exploration.start_m_deg: no floor near z = 0 under the wheels; move the start onto the "
        "floor, or leave it out");
  if (clearance.ends_at(start))
    throw Error(fmt::format(
        "exploration.start_m_deg: the floor ends less than {:g} m before or behind the axle, where "
        "the robot would tip over; move the start away from the edge, or leave it out",
        sim::kEdgeSensorM));
  return start;
}

/// Stream (trial seed, "exploration start"): a place of the largest floor, and a heading.
PlanarPose drawn_start(const Scene& scene, const Study& config, int seed_index) {
  const std::vector<Eigen::Vector2d> places = scene.roomy.largest();
  if (places.empty())
    throw Error(fmt::format(
        "{}: no place where the robot can stand: it needs floor near z = 0 and {:.2f} m to each "
        "side up to {:.2f} m; explore another scene, or with a smaller robot",
        config.scene.value(), extent_of(scene.drive).radius_m + drive_settings(config).clearance_m,
        extent_of(scene.drive).height_m));
  RandomStream draws(trial_seed(config.seed, seed_index), "exploration start");
  const auto n = static_cast<std::size_t>(draws.uniform() * static_cast<double>(places.size()));
  return {places[n].x(), places[n].y(), (2.0 * draws.uniform() - 1.0) * std::numbers::pi};
}

/// Where the dense views stand: every kViewGridM of the floor that is connected with the start, and
/// the start itself.
std::vector<Eigen::Vector2d> view_places(const Scene& scene, const PlanarPose& start) {
  const Eigen::Vector2d p_start(start.x_m, start.y_m);
  const std::vector<Eigen::Vector2d> floor = scene.floor.connected_to(p_start);
  std::vector<Eigen::Vector2d> places = scene.floor.thinned(floor, kViewGridM, kLeastPlaces);
  if (places.empty()) places.push_back(p_start);
  return places;
}

std::vector<SurfacePoint> dense_views(const Scene& scene,
                                      const std::vector<Eigen::Vector2d>& places, double cell_m) {
  sim::Renderer renderer(scene.world, false);
  sim::Clearance clearance(scene.drive);
  VisibleCloud cloud(cell_m);
  for (const Eigen::Vector2d& p : places) {
    const double floor_m = clearance.floor_at({p.x(), p.y(), 0.0}).value_or(0.0);
    for (int n = 0; n < kViewHeadings; ++n) {
      Pose T_world_base = planar_pose(p.x(), p.y(), 2.0 * std::numbers::pi * n / kViewHeadings);
      T_world_base.pretranslate(Eigen::Vector3d(0.0, 0.0, floor_m));
      Frame frame;
      renderer.render_depth({0.0, T_world_base}, frame);
      cloud.add(frame, scene.world.calibration());
    }
  }
  return cloud.points();
}

/// Hash of what decides a cloud: scene, cameras, and the floor that it is seen from.
std::string cloud_name(const Scene& scene, const Study& config,
                       const std::vector<Eigen::Vector2d>& places, double cell_m) {
  Study deciding;
  deciding.cameras = config.cameras;
  std::string text = fmt::format("{}\n{}\n{}\n{}\n", scene.world.hash(), sim::mujoco_version(),
                                 cell_m, to_yaml(deciding));
  for (const Eigen::Vector2d& p : places) text += fmt::format("{} {}\n", p.x(), p.y());
  return hash_of(text).substr(0, 16) + ".cloud";
}

PlannerChoice with_waypoints(PlannerChoice planner, const Study& config, const Pose& T_map_world) {
  auto* drawn = std::get_if<DrawnWaypoints>(&planner);
  if (drawn == nullptr) return planner;
  for (const auto& [x, y, yaw_deg] : config.trajectory.waypoints_m_deg)
    drawn->T_map_waypoints.push_back(
        planar(T_map_world * planar_pose(x, y, yaw_deg * std::numbers::pi / 180.0)));
  return planner;
}

std::unique_ptr<Explorer> explorer_of(const PlannerChoice& planner, const ExploringRobot& robot,
                                      std::uint64_t seed) {
  return std::visit(
      [&]<class Kind>(const Kind& kind) -> std::unique_ptr<Explorer> {
        if constexpr (std::same_as<Kind, NoExploration>)
          throw Error("exploration.planner: is none; choose one");
        else
          return make_explorer(kind, robot, seed);
      },
      planner);
}

Task task_of(const PlannedExploration& planned, const std::string& world_hash) {
  TrialSpec spec = planned.spec;
  spec.cell.doses.clear();
  return eval::task_of(planned.config, spec, Labels::detected, world_hash);
}

}  // namespace

struct ExplorationScenes::State {
  explicit State(fs::path its_folder) : folder(std::move(its_folder)) {}

  using Surface = std::shared_ptr<const VisibleSurface>;
  using Cloud = std::shared_ptr<const std::vector<SurfacePoint>>;

  std::shared_ptr<const Scene> scene(const Study& config) {
    return scenes.get(scene_key(config), [&] { return make_scene(config); });
  }

  Cloud cloud(const Scene& scene, const Study& config, const PlanarPose& start) {
    const std::vector<Eigen::Vector2d> places = view_places(scene, start);
    const double cell_m = kCloudShare * config.voxel_m;
    const std::string name = cloud_name(scene, config, places, cell_m);
    return clouds.get(name, [&] {
      return std::make_shared<const std::vector<SurfacePoint>>(kept_cloud(
          folder / "surfaces" / name, [&] { return dense_views(scene, places, cell_m); }));
    });
  }

  Surface surface(const Scene& scene, const Study& config, const ClassTable& table, int seed_index,
                  const PlanarPose& start) {
    const MapFrame frame = map_frame(config, seed_index);
    const Cloud points = cloud(scene, config, start);
    std::string key = fmt::format("{} {} {} {} {} {} {}", static_cast<const void*>(points.get()),
                                  frame.edge_m, frame.origin_m.x(), frame.origin_m.y(),
                                  frame.origin_m.z(), frame.yaw_rad, config.score.epsilon_m);
    for (const SemanticClass& c : table.classes) key += c.detect ? '1' : '0';
    return surfaces.get(key, [&] {
      return std::make_shared<const VisibleSurface>(
          *points,
          surface_truth(scene.world.shapes(), table, frame.T_map_world(),
                        {frame.edge_m, config.score.epsilon_m, 1}),
          table, frame.T_map_world());
    });
  }

  fs::path folder;
  SharedCache<std::string, std::shared_ptr<const Scene>> scenes{kScenes};
  SharedCache<std::string, Cloud> clouds{kScenes};
  SharedCache<std::string, Surface> surfaces{kSurfaces};
};

ExplorationScenes::ExplorationScenes(fs::path folder)
    : state_(std::make_unique<State>(std::move(folder))) {}

ExplorationScenes::Ready ExplorationScenes::ready(const PlannedExploration& planned, bool records) {
  const Study& config = planned.config;
  const std::shared_ptr<const Scene> scene = state_->scene(config);
  check_classes(config, scene->world.classes());
  Study deciding = config;
  deciding.name.clear();
  deciding.seeds = 1;
  deciding.methods.front().name = "method";
  const std::string settings = to_yaml(without_titles(deciding));
  const auto key = [&](bool recorded) {
    return hash_of(fmt::format("{}\n{}\n{}\n{}\n{}\n{}", scene->world.hash(), sim::mujoco_version(),
                               build_identity(), planned.spec.seed_index,
                               recorded ? "recorded" : "scored", settings));
  };
  const auto& given = config.exploration.start_m_deg;
  return {key(records), key(!records),
          given ? given_start(*given, scene->drive)
                : drawn_start(*scene, config, planned.spec.seed_index),
          records};
}

void ExplorationScenes::run(const PlannedExploration& planned, const Ready& ready,
                            const fs::path& folder,
                            const std::function<void(const CoveragePoint&)>& progress) {
  const Study& config = planned.config;
  const std::shared_ptr<const Scene> scene = state_->scene(config);
  const ClassTable table = detected_table(config, scene->world.classes());
  const auto surface = state_->surface(*scene, config, table, planned.spec.seed_index, ready.start);
  const Task task = task_of(planned, scene->world.hash());
  std::optional<RecordingWriter> writer;
  if (ready.records) {
    RecordingInfo info = info_of(config, scene->world);
    info.color_rate_hz = info.depth_rate_hz = config.trajectory.frames_per_s;
    writer.emplace(folder / "recording", std::move(info));
  }
  const auto made = [&](const ExploringRobot& robot, const Pose& T_map_world) {
    return explorer_of(with_waypoints(config.exploration.planner, config, T_map_world), robot,
                       trial_seed(task));
  };
  const ExplorationResult result =
      explore({scene->world, scene->drive, table, *surface}, task, ready.start, made,
              {.recording = writer ? &*writer : nullptr,
               .progress = progress,
               .map = [&](const SemanticMap& map) { map.save(folder / kMapFile); }});
  if (writer) writer->finish();
  write_exploration(result, ready.key, folder);
}

#else

struct ExplorationScenes::State {};

ExplorationScenes::ExplorationScenes(fs::path) {
  throw Error(
      "explore: this mapscore was built without the simulator; build with "
      "-DMAPSCORE_SIMULATOR=ON");
}

ExplorationScenes::Ready ExplorationScenes::ready(const PlannedExploration&, bool) {
  return {};
}

void ExplorationScenes::run(const PlannedExploration&, const Ready&, const fs::path&,
                            const std::function<void(const CoveragePoint&)>&) {}

#endif

ExplorationScenes::~ExplorationScenes() = default;

}  // namespace mapscore::eval
