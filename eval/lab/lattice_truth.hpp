// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/lab/recorded_surfaces.hpp"
#include "eval/recording/frame_cache.hpp"
#include "eval/recording/frame_selection.hpp"
#include "eval/score/distances/sample_set.hpp"
#include "eval/truth/visible_truth.hpp"

#include <optional>

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
  std::optional<double> at_s{};      ///< the time whose surfaces count, where things move
  bool distances = true;             ///< keep samples for the F-score at a distance
  FrameSelection frames{};           ///< those that the view is made of
  std::optional<int> depth_image{};  ///< the view is made of it alone, in place of the frames
  bool operator==(const TruthOptions&) const = default;
};

/// Truth of one recording on one lattice. Immutable, shared by all trials that are scored on it.
struct LatticeTruth : SurfacesAt {
  ViewTruth view;  ///< of all selected frames together; empty until it is made

  /// Counts of a map against this truth and a view of it; distances where the options name
  /// some. They do not depend on `jobs`.
  [[nodiscard]] Counts score(const MapSnapshot& map, double threshold, const ViewTruth& view,
                             std::size_t class_count, const ScoreOptions& options,
                             int jobs = 1) const;
};

/// What the selected frames of a recording saw together of `surface`, which lies on the lattice of
/// `map_frame`; `frames` must decode depth and depth_label. Works on `jobs` threads, on which the
/// result does not depend. Throws Error when a frame cannot be read or the selection is not one of
/// this recording.
[[nodiscard]] ViewTruth make_view(const Recording& recording, const ClassTable& table,
                                  FrameCache& frames, const MapFrame& map_frame,
                                  const TruthOptions& options, const SurfaceTruth& surface,
                                  int jobs);

}  // namespace mapscore::eval
