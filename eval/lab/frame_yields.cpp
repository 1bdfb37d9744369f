// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/lab/frame_yields.hpp"

#include "eval/results/plan.hpp"

#include <algorithm>
#include <functional>
#include <list>
#include <memory>
#include <utility>

namespace mapscore::eval {
namespace {

/// The study with each frame scored by itself, and nothing but voxels.
Study by_frame(Study study) {
  study.score.unit = ScoreUnit::frame;
  study.score.at_s.reset();
  study.score.tolerances = {0};
  study.score.distances_m.clear();
  study.score.asked = {};
  return study;
}

/// A trial under way, and what its frames gave so far.
struct Walk {
  Task task;
  std::unique_ptr<TrialRun> run = {};
  TrialYields yields = {};
};

std::map<std::string, FrameYield> yields_of(const FrameResult& frame, const ClassTable& table) {
  std::map<std::string, FrameYield> yields;
  for (const SemanticClass& c : table.classes) {
    const ClassCounts& counts = frame.counts.at(c.id);
    const FrameYield yield{counts.found, counts.predicted - counts.true_predicted};
    if (c.detect && yield != FrameYield{}) yields[c.name] = yield;
  }
  return yields;
}

FrameYield sum_of(const TrialYields& trial, std::size_t frame,
                  const std::vector<std::string>& classes) {
  FrameYield sum;
  for (const std::string& name : classes)
    if (const auto of = trial.frames[frame].find(name); of != trial.frames[frame].end()) {
      sum.found += of->second.found;
      sum.falses += of->second.falses;
    }
  return sum;
}

}  // namespace

std::vector<TrialYields> yields_of(const Study& study, const std::vector<TrialSpec>& specs,
                                   Bench& bench) {
  const Study alone = by_frame(study);
  const Recording& recording = bench.recording();
  std::vector<TrialYields> yields;
  for (auto first = specs.begin(); first != specs.end();) {
    const auto end = std::find_if(first, specs.end(),
                                  [&](const TrialSpec& spec) { return spec.cell != first->cell; });
    std::list<Walk> walks;  // side by side, since they share the truth of a frame
    for (; first != end; ++first) {
      Walk& walk =
          walks.emplace_back(task_of(alone, *first, Labels::detected, recording.content_hash()));
      walk.run = bench.start(walk.task);
      walk.run->keep_frames();
      walk.yields = {first->method, first->cell, {}};
    }
    for (int frame = 0; frame < recording.frame_count(); ++frame)
      for (Walk& walk : walks) {
        walk.run->advance(*bench.frame(frame, walk.run->depth_of(frame)));
        for (const FrameResult& result : walk.run->take_frames())
          walk.yields.frames.push_back(yields_of(result, bench.table()));
      }
    for (Walk& walk : walks) yields.push_back(std::move(walk.yields));
  }
  return yields;
}

std::vector<FrameLoss> frame_losses(const TrialYields& before, const TrialYields& after,
                                    const std::vector<std::string>& classes) {
  std::vector<FrameLoss> losses;
  for (std::size_t n = 0; n < std::min(before.frames.size(), after.frames.size()); ++n) {
    const FrameLoss loss{static_cast<int>(n), sum_of(before, n, classes),
                         sum_of(after, n, classes)};
    if (loss.voxels() > 0) losses.push_back(loss);
  }
  std::ranges::stable_sort(losses, std::ranges::greater{}, &FrameLoss::voxels);
  return losses;
}

}  // namespace mapscore::eval
