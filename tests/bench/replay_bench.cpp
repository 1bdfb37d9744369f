// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

// Recording and replaying the demo's apartment at 640 x 480. One evaluation of a frame: corrupt,
// register, segment all detections, place, fuse (5 cm, N = 1, misregistration of 20 mm), on one
// thread; then the same with 100 draws. What placing alone costs against plain passes, for 1 to 100
// draws and three sizes of voxels.

#include "core/placement/placement.hpp"
#include "core/placement/pose_belief.hpp"
#include "eval/lab/trial_run.hpp"
#include "eval/lab/truth_cache.hpp"
#include "eval/recording/frame_cache.hpp"
#include "eval/render/study_recording.hpp"
#include "eval/results/plan.hpp"
#include "eval/results/study_store.hpp"
#include "sim/faults/label_noise.hpp"
#include "tests/core/placement/counted_draws.hpp"

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <unistd.h>

#include <ctime>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>

#ifdef MAPSCORE_SIMULATOR

namespace mapscore::eval {
namespace {

Study demo(const std::string& frames_per_s) {
  return load_study(MAPSCORE_SOURCE_DIR "/configs/demo.yaml",
                    {"trajectory.frames_per_s=" + frames_per_s, "seeds=1",
                     "sweep={faults.misregistration.magnitude_m: [0.02]}"});
}

std::filesystem::path temporary_folder(const std::string& name) {
  return std::filesystem::temp_directory_path() /
         fmt::format("mapscore_bench_{}_{}", name, getpid());
}

constexpr double kEdge_m = 0.05;

/// A recording of 18 frames spread over the demo's drive, made once and removed at the end.
class Replay {
 public:
  Replay()
      : study_(demo("0.35")),
        folder_(temporary_folder("replay")),
        recording_(make()),
        table_(recording_.info().table),
        frames_(recording_, Channels{.label = true, .depth = true, .depth_label = true},
                std::size_t{1} << 30),
        truths_(recording_, table_, frames_, 1),
        poses_(recording_) {}
  ~Replay() { std::filesystem::remove_all(folder_); }

  [[nodiscard]] Task task(const std::string& method,
                          const std::vector<std::string>& changes = {}) const {
    Study study = study_;
    set_leaves(study, changes);
    for (const TrialSpec& spec : trials(study))
      if (spec.method == method)
        return task_of(study, spec, Labels::detected, recording_.content_hash());
    throw std::logic_error("no such method: " + method);
  }
  [[nodiscard]] std::unique_ptr<TrialRun> start(const Task& task) {
    return std::make_unique<TrialRun>(task, recording_, table_, truths_, poses_);
  }
  /// Every pixel with depth and its class, background included.
  [[nodiscard]] Observation observe_all(int index) {
    const auto frame = frames_.get(index);
    Observation observation;
    for (std::size_t id = 0; id < table_.classes.size(); ++id)
      observation.push_back({static_cast<ClassId>(id), 1.0, {}});
    for (int v = 0; v < frame->depth.rows; ++v)
      for (int u = 0; u < frame->depth.cols; ++u)
        if (const double z = frame->depth(v, u) / kDepthUnitsPerMetre; z > 0)
          observation[table_.class_of(frame->depth_label(v, u))].positions.push_back(
              calibration().depth.back_project(u, v, z));
    return observation;
  }
  /// What the method `direct` sees without faults.
  [[nodiscard]] Observation observe(int index) {
    const auto frame = frames_.get(index);
    const auto detections = sim::corrupt_detections(frame->label, table_, {}, 1, index);
    const RegisteredCloud cloud =
        register_depth(frame->depth, recording_.info().calibration,
                       pixels_wanted(detections, frame->label.cols, frame->label.rows));
    Observation observation;
    for (const Detection& detection : detections) {
      Segment found = segment(detection, cloud, kEdge_m, Direct{}, false);
      observation.push_back({found.class_id, found.score, std::move(found.points)});
    }
    return observation;
  }
  [[nodiscard]] const Calibration& calibration() const { return recording_.info().calibration; }
  [[nodiscard]] int frame_count() const { return recording_.frame_count(); }
  [[nodiscard]] std::shared_ptr<const Frame> frame(int index) { return frames_.get(index); }

 private:
  [[nodiscard]] Recording make() const {
    std::filesystem::remove_all(folder_);
    record_study(study_, folder_, static_cast<int>(std::thread::hardware_concurrency()), {});
    return Recording::open(folder_);
  }

  Study study_;
  std::filesystem::path folder_;
  Recording recording_;
  ClassTable table_;
  FrameCache frames_;
  TruthCache truths_;
  PoseSources poses_;
};

Replay& the_replay() {
  static Replay replay;
  return replay;
}

void replay(benchmark::State& state, const std::string& method,
            const std::vector<std::string>& changes = {}) {
  Replay& replay = the_replay();
  const Task task = replay.task(method, changes);
  const auto trial = replay.start(task);
  for (int index = 0; index < replay.frame_count(); ++index) (void)replay.frame(index);
  int index = 0;
  for (auto _ : state) {
    trial->advance(*replay.frame(index));
    index = (index + 1) % replay.frame_count();
  }
  state.counters["evaluations_per_s_and_core"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}
BENCHMARK_CAPTURE(replay, direct, "direct")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(replay, erosion, "erosion")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(replay, region_growing, "region_growing")->Unit(benchmark::kMillisecond);

const std::vector<std::string> kManyDraws{"fusion.blend.N=100", "faults.pose.sigma_xy_m=0.02",
                                          "faults.pose.sigma_yaw_deg=1"};
BENCHMARK_CAPTURE(replay, direct_100_draws, "direct", kManyDraws)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(replay, region_growing_100_draws, "region_growing", kManyDraws)
    ->Unit(benchmark::kMillisecond);

double cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Poses of the depth camera, 2 cm and 1 degree apart, somewhere on the drive.
std::vector<Pose> sensor_draws(int frame, int draws, const Calibration& calibration) {
  PoseBelief belief;
  belief.T_odom_base = planar_pose(0.3 * frame, 2.0 - 0.1 * frame, 0.4 * frame);
  belief.covariance.diagonal() << 4e-4, 4e-4, 0, 0, 0, 3.046e-4;
  RandomStream stream(1, "bench", {static_cast<std::uint64_t>(frame)});
  auto poses = draw_poses(belief, Draws{draws, NoiseAt::base, CovarianceUse::diagonal}, stream);
  for (Pose& pose : poses) pose = pose * calibration.T_base_depth;
  return poses;
}

/// Placing alone, of detected objects or of all that is seen, N draws on voxels of some
/// millimetres, in turn with plain passes in the same run: `plain_to_place` is how many times
/// longer the passes take, in processor time, and `equal` is 1 where all hits agreed to the bit.
void place_draws(benchmark::State& state, bool all_classes) {
  Replay& replay = the_replay();
  const int draws = static_cast<int>(state.range(0)), step = all_classes ? 6 : 1;
  const double edge_m = 1e-3 * static_cast<double>(state.range(1));
  double place_s = 0.0, plain_s = 0.0;
  int frames = 0;
  bool equal = true;
  for (auto _ : state)
    for (int index = 0; index < replay.frame_count(); index += step, ++frames) {
      const Observation observation =
          all_classes ? replay.observe_all(index) : replay.observe(index);
      const std::vector<Pose> poses = sensor_draws(index, draws, replay.calibration());
      const double before_s = cpu_s();
      const auto placed = place(observation, poses, edge_m);
      const double between_s = cpu_s();
      const auto plain = mapscore::testing::counted_place(observation, poses, edge_m);
      plain_s += cpu_s() - between_s;
      place_s += between_s - before_s;
      equal = equal && placed == plain;
    }
  state.counters["place_ms_a_frame"] = 1e3 * place_s / frames;
  state.counters["plain_ms_a_frame"] = 1e3 * plain_s / frames;
  state.counters["plain_to_place"] = plain_s / place_s;
  state.counters["equal"] = equal ? 1 : 0;
}
BENCHMARK_CAPTURE(place_draws, objects, false)
    ->ArgNames({"N", "mm"})
    ->ArgsProduct({{1, 4, 10, 30, 100}, {50, 20, 10}})
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(place_draws, all_classes, true)
    ->ArgNames({"N", "mm"})
    ->ArgsProduct({{1, 5, 10}, {50, 20, 10}})
    ->Unit(benchmark::kMillisecond);

/// Both cameras, all files, PNGs encoded, on all cores; loading the scene included.
void record(benchmark::State& state, bool shadows) {
  Study study = demo("0.7");
  study.cameras.shadows = shadows;
  const std::filesystem::path folder = temporary_folder("record");
  int frames = 0;
  for (auto _ : state) {
    std::filesystem::remove_all(folder);
    record_study(study, folder, static_cast<int>(std::thread::hardware_concurrency()),
                 {.images = [&](int, int images) { frames = images / 2; }});
  }
  std::filesystem::remove_all(folder);
  state.counters["frames_per_s"] = benchmark::Counter(
      static_cast<double>(frames), benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK_CAPTURE(record, without_shadows, false)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(record, with_shadows, true)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace mapscore::eval

#endif
