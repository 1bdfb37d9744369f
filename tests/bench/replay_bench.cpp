// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

// Recording and replaying the demo's apartment at 640 x 480. One evaluation of a frame: corrupt,
// register, segment all detections, place, fuse (5 cm, N = 1, misregistration of 20 mm), on one
// thread.

#include "eval/experiment/plan.hpp"
#include "eval/experiment/study_recording.hpp"
#include "eval/experiment/study_store.hpp"
#include "eval/experiment/trial_run.hpp"
#include "eval/recording/frame_cache.hpp"

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <unistd.h>

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

  [[nodiscard]] Task task(const std::string& method) const {
    for (const TrialSpec& spec : trials(study_))
      if (spec.method == method)
        return task_of(study_, spec, Labels::detected, recording_.content_hash());
    throw std::logic_error("no such method: " + method);
  }
  [[nodiscard]] std::unique_ptr<TrialRun> start(const Task& task) {
    return std::make_unique<TrialRun>(task, recording_, table_, truths_, poses_);
  }
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

void replay(benchmark::State& state, const std::string& method) {
  static Replay replay;
  const Task task = replay.task(method);
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
