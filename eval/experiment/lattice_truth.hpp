// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "eval/experiment/map_frame.hpp"
#include "eval/recording/frame_cache.hpp"
#include "eval/recording/recording.hpp"
#include "eval/score/distance_score.hpp"
#include "eval/score/sample_set.hpp"
#include "eval/truth/surface_truth.hpp"
#include "eval/truth/visible_truth.hpp"

#include <future>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace mapscore::eval {

/// What could be seen: of all frames of a recording, or of one.
struct ViewTruth {
  VisibleTruth visible;
  SampleSet samples;  ///< of the detected classes; empty where no distances are asked for
};

/// What a truth is made with besides its lattice.
struct TruthOptions {
  double epsilon_m = 0.0005;
  int min_samples = 1;
  bool by_frame = false;  ///< a ViewTruth for each frame instead of one for all
  bool distances = true;  ///< keep samples for the F-score at a distance
  bool operator==(const TruthOptions&) const = default;
};

/// Truth of one recording on one lattice. Immutable, shared by all trials that are scored on it.
struct LatticeTruth {
  SurfaceTruth surface;
  CubeDistance distance_to_class;
  std::vector<ViewTruth> views;  ///< one for all frames, or one for each

  /// Counts of a map against this truth and one of its views; distances where the options name
  /// some.
  [[nodiscard]] Counts score(const MapSnapshot& map, double threshold, const ViewTruth& view,
                             std::size_t class_count, const ScoreOptions& options) const;

  [[nodiscard]] const ViewTruth& view(int frame) const {
    return views.size() == 1 ? views.front() : views.at(static_cast<std::size_t>(frame));
  }
};

/// The surfaces alone, without any view.
[[nodiscard]] LatticeTruth make_surface_truth(const std::vector<Shape>& shapes,
                                              const ClassTable& table, const MapFrame& map_frame,
                                              const TruthOptions& options, int jobs);

/// Makes the truth of a recording; `frames` must decode depth and depth_label. Result independent
/// of `jobs`.
[[nodiscard]] LatticeTruth make_lattice_truth(const Recording& recording, const ClassTable& table,
                                              FrameCache& frames, const MapFrame& map_frame,
                                              const TruthOptions& options, int jobs);

/// Truths of the lattices in use, each made once; the oldest goes when more than `capacity` are
/// held. Safe to use from several threads: whoever asks for a truth that is being made waits for
/// it.
class TruthCache {
 public:
  TruthCache(const Recording& recording, const ClassTable& table, FrameCache& frames,
             std::size_t capacity);

  [[nodiscard]] std::shared_ptr<const LatticeTruth> get(const MapFrame& map_frame,
                                                        const TruthOptions& options);

 private:
  using Truth = std::shared_ptr<const LatticeTruth>;
  struct Entry {
    MapFrame map_frame;
    TruthOptions options;
    std::shared_future<Truth> truth;
  };

  const Recording& recording_;
  const ClassTable& table_;
  FrameCache& frames_;
  std::size_t capacity_;
  std::mutex mutex_;
  std::list<Entry> entries_;  ///< most recently made first
};

}  // namespace mapscore::eval
