// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT
//
// What a frame costs `edge_aligned`: processor time of label_surfaces on the frames of trials'
// folders (`mapscore trial`), of which all share what a first look tells, as in a map. Prints of
// each folder the mean over its frames with objects, each counted with the least of REPEATS times,
// in milliseconds.

#include "core/segmentation/edge_aligned/edge_aligned.hpp"
#include "eval/foreign/trial_folder.hpp"
#include "eval/lab/sights.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <limits>
#include <numeric>
#include <vector>

namespace {

using namespace mapscore;

void print_times(const char* path, int repeats) {
  const eval::TrialFolder folder(path);
  std::vector<int> frames(static_cast<std::size_t>(folder.frame_count()));
  std::iota(frames.begin(), frames.end(), 0);
  const auto sight = [&](int n) { return folder.sight(n); };
  const CalibrationEvidence told =
      eval::first_look(EdgeAligned(), MappedFrames(), folder.sheet().believed, frames, sight);
  std::vector<Sight> shown;
  for (const int n : frames)
    if (Sight one = sight(n).among(told); !one.detections().empty()) shown.push_back(one);
  std::vector<double> least_ms(shown.size(), std::numeric_limits<double>::max());
  std::size_t objects = 0, pixels = 0;
  for (int repeat = 0; repeat < repeats; ++repeat)
    for (std::size_t n = 0; n < shown.size(); ++n) {
      const std::clock_t start = std::clock();
      pixels += static_cast<std::size_t>(
          cv::countNonZero(label_surfaces(shown[n], EdgeAligned()).labels));
      least_ms[n] = std::min(least_ms[n],
                             1000.0 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
      objects += shown[n].detections().size();
    }
  const auto count = static_cast<double>(shown.size());
  fmt::print(
      "{:6.2f} ms a frame, at most {:6.2f}; {} frames, {:.1f} objects and {} pixels in each: {}\n",
      std::accumulate(least_ms.begin(), least_ms.end(), 0.0) / count,
      *std::ranges::max_element(least_ms), shown.size(),
      static_cast<double>(objects) / count / repeats,
      pixels / shown.size() / static_cast<std::size_t>(repeats), path);
  std::fflush(stdout);
}

}  // namespace

int main(int count, char** words) try {
  const int repeats = count < 3 ? 0 : std::atoi(words[1]);
  if (repeats < 1) {
    std::fprintf(stderr, "usage: mapscore_frame_times REPEATS TRIAL...\n");
    return 2;
  }
  for (int n = 2; n < count; ++n) print_times(words[n], repeats);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
