// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "eval/experiment/frame_boxes.hpp"
#include "eval/experiment/map_frame.hpp"
#include "eval/recording/frame_cache.hpp"
#include "eval/recording/frame_selection.hpp"
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

/// What could be seen: of frames of a recording together, of one, or of a scene as a whole.
struct ViewTruth {
  VisibleTruth visible;
  SampleSet samples;  ///< of the detected classes; empty where no distances are asked for
};

/// The view of a scene that no camera saw: all of its surface (see whole_surface) and no samples,
/// so that completeness is undefined.
[[nodiscard]] ViewTruth whole_surface_view(const SurfaceTruth& surface, std::size_t class_count);

/// What a truth is made with besides its lattice.
struct TruthOptions {
  double epsilon_m = 0.0005;
  int min_samples = 1;
  bool by_frame = false;       ///< a ViewTruth for each frame instead of one for all
  bool distances = true;       ///< keep samples for the F-score at a distance
  FrameSelection frames{};     ///< those that the views are made of
  double time_offset_s = 0.0;  ///< of the depth images whose views are made
  bool operator==(const TruthOptions&) const = default;
};

/// Truth of one recording on one lattice. Immutable, shared by all trials that are scored on it.
struct LatticeTruth {
  SurfaceTruth surface;
  CubeDistance distance_to_class;
  std::vector<ViewTruth> views;  ///< one for all selected frames, or one for each in their order

  /// Counts of a map against this truth and one of its views; distances where the options name
  /// some. They do not depend on `jobs`.
  [[nodiscard]] Counts score(const MapSnapshot& map, double threshold, const ViewTruth& view,
                             std::size_t class_count, const ScoreOptions& options,
                             int jobs = 1) const;

  /// `frame`: its place among the selected ones.
  [[nodiscard]] const ViewTruth& view(int frame) const {
    return views.size() == 1 ? views.front() : views.at(static_cast<std::size_t>(frame));
  }
};

/// The surfaces alone, without any view.
[[nodiscard]] LatticeTruth make_surface_truth(const std::vector<Shape>& shapes,
                                              const ClassTable& table, const MapFrame& map_frame,
                                              const TruthOptions& options, int jobs);

/// What the selected frames of a recording saw of `surface`, which lies on the lattice of
/// `map_frame`; `frames` must decode depth and depth_label. Works on `jobs` threads, on which the
/// result does not depend. Throws Error when a frame cannot be read or the selection is not one of
/// this recording.
[[nodiscard]] std::vector<ViewTruth> make_views(const Recording& recording, const ClassTable& table,
                                                FrameCache& frames, const MapFrame& map_frame,
                                                const TruthOptions& options,
                                                const SurfaceTruth& surface, int jobs);

/// Makes the truth of a recording: its surfaces and its views.
[[nodiscard]] LatticeTruth make_lattice_truth(const Recording& recording, const ClassTable& table,
                                              FrameCache& frames, const MapFrame& map_frame,
                                              const TruthOptions& options, int jobs);

/// Truths of the lattices in use, each made once; the oldest goes when more than `capacity` of a
/// kind are held. Safe to use from several threads: whoever asks for a truth that is being made
/// waits for it.
class TruthCache {
 public:
  TruthCache(const Recording& recording, const ClassTable& table, FrameCache& frames,
             std::size_t capacity);

  [[nodiscard]] std::shared_ptr<const LatticeTruth> get(const MapFrame& map_frame,
                                                        const TruthOptions& options);
  /// As get, with every instance a class of its own (see instance_table) and without distances.
  [[nodiscard]] std::shared_ptr<const LatticeTruth> of_instances(const MapFrame& map_frame,
                                                                 TruthOptions options);
  /// What every trial compares its detections' boxes with; on no lattice.
  [[nodiscard]] FrameBoxes& boxes() { return boxes_; }

 private:
  using Truth = std::shared_ptr<const LatticeTruth>;
  struct Entry {
    MapFrame map_frame;
    TruthOptions options;
    std::shared_future<Truth> truth;
  };
  using Entries = std::list<Entry>;  ///< most recently made first

  [[nodiscard]] Truth get(Entries& entries, const ClassTable& table, const MapFrame& map_frame,
                          const TruthOptions& options);

  const Recording& recording_;
  const ClassTable& table_;
  ClassTable instance_table_;
  FrameCache& frames_;
  std::size_t capacity_;
  std::mutex mutex_;
  Entries entries_, instance_entries_;
  FrameBoxes boxes_;
};

}  // namespace mapscore::eval
