// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/geometry/shape.hpp"
#include "eval/alignment/surface_aligner.hpp"
#include "eval/cli/shared/options.hpp"
#include "eval/lab/lattice_truth.hpp"
#include "eval/lab/map_frame.hpp"
#include "eval/study/study.hpp"
#include "eval/truth/occupancy_truth.hpp"

#include <CLI/CLI.hpp>

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mapscore::eval {

/// `--yes`: a truth is made however much memory it takes.
void add_yes_flag(CLI::App& verb, bool& yes,
                  const char* help = "Make a truth that takes much memory without asking");

/// Flags that say on which lattice the truth is taken, and of what.
struct LatticeFlags {
  double voxel_m = 0.05;
  std::vector<double> origin_m{0, 0, 0};
  double yaw_deg = 0.0;
  double epsilon_m = 0.0005;
  int min_samples = 1;
  std::optional<std::string> frames;  ///< as FrameSelection reads them; none: all

  std::optional<double> at_s;  ///< where things move: the time whose surfaces count
  std::optional<int> frame;    ///< the same, as a frame
  bool yes = false;            ///< make a truth of any size

  void add_to(CLI::App& verb);
  /// All but --voxel_m, for maps that have their own.
  void add_without_voxel_to(CLI::App& verb);
  [[nodiscard]] MapFrame map_frame() const;
};

/// A scene or a recording, opened once, of which truths are made by any class table.
class TruthSource {
 public:
  /// `source`: an MJCF file or a recording's folder. Throws Error when it is neither, or a
  /// recording without truth.
  TruthSource(const std::string& source, const LatticeFlags& lattice, const WorkFlags& work);

  /// Detects these classes in place of the source's own; {"all"}: every one. Throws Error naming a
  /// class that is not there.
  void detect(const std::vector<std::string>& classes);
  [[nodiscard]] const ClassTable& table() const { return table_; }
  /// Drawn surfaces in the world frame, at the flags' time where they move.
  [[nodiscard]] const std::vector<Shape>& shapes() const { return shapes_; }
  /// Nothing for a scene, which no camera saw.
  [[nodiscard]] const Recording* recording() const { return recording_ ? &*recording_ : nullptr; }
  /// Indices of the recording's frames that count; none for a scene.
  [[nodiscard]] std::vector<int> frames() const {
    return recording_ ? selection_.of(recording_->frame_count()) : std::vector<int>{};
  }

  /// The surfaces of the source's own classes, without any view.
  [[nodiscard]] SurfaceTruth surface() const;
  /// Surfaces, and one view: what the frames saw, or all of a scene's surface. `table`: that of the
  /// source, or another reading of its instances; depth samples are kept of its detected classes
  /// where `distances` are asked for.
  [[nodiscard]] LatticeTruth truth(const ClassTable& table, bool distances);
  /// The same, made once for maps that ask for it one after the other: the last one with distances
  /// is kept, and the last one without.
  [[nodiscard]] std::shared_ptr<const LatticeTruth> kept_truth(const ClassTable& table,
                                                               bool distances);
  /// Brings maps onto all surfaces, frame map; made once.
  [[nodiscard]] const SurfaceAligner& aligner();
  /// What the frames know to be occupied and free. Needs a recording.
  [[nodiscard]] OccupancyTruth occupancy(const SurfaceTruth& surface);

 private:
  /// Where frames of all the recording, whichever are selected, measured surfaces, frame map,
  /// thinned, in no promised order; none for a scene.
  [[nodiscard]] std::vector<Eigen::Vector3d> seen_points();
  /// Throws Error when the flags do not allow a truth of this size, with a view of all of it.
  [[nodiscard]] LatticeTruth surfaces(const ClassTable& table, const TruthOptions& options,
                                      bool whole_view) const;

  struct Kept {
    ClassTable table;
    std::shared_ptr<const LatticeTruth> truth;
  };

  const LatticeFlags& lattice_;
  int jobs_;
  FrameSelection selection_;
  ClassTable table_;
  std::vector<Shape> shapes_;
  std::optional<Recording> recording_;
  std::optional<FrameCache> frames_;
  std::array<Kept, 2> kept_;  ///< without and with distances
  std::optional<SurfaceAligner> aligner_;
};

/// Throws Error, stating the cost, when the finest truth of a study would take too much memory
/// (refuse_too_large); never with `yes`. `trials`: how many it scores, which say how many lattices
/// are held at once.
void check_truth_size(const Study& study, const Recording& recording, std::size_t trials, bool yes);

}  // namespace mapscore::eval
