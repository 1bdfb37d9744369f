// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/parameters.hpp"
#include "eval/score/class_curve.hpp"
#include "eval/score/distance_tally.hpp"
#include "eval/score/label_counts.hpp"
#include "eval/score/metric.hpp"
#include "eval/score/part_counts.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace mapscore::eval {

/// Version of everything between a frame and its counts; part of every key, so that results of
/// different definitions never stand side by side. Raise it when a definition changes, or when a
/// count is added that every study has.
inline constexpr int kScoringVersion = 3;

/// The parts of a score that a study must ask for, by their names in ClassCounts::parts().
struct AskedParts {
  bool instances = false, thin = false, labels = false, poses = false;

  static void fields(auto& s, auto&& visit) {
    const auto part = [&](auto& member, std::string_view key, std::string_view meaning) {
      visit(member, Field{.key = key, .meaning = meaning, .later = true, .swept = false});
    };
    part(s.instances, "instances",
         "score instances too, the connected pieces of each class: PQ and AP");
    part(s.thin, "thin", "count the voxels of thin parts (chair legs) by themselves too");
    part(s.labels, "labels",
         "score detections in the image too: pixels, edges, instances, how sure they were");
    part(s.poses, "poses",
         "score the poses that are mapped from too: ATE, RPE, and NEES of their covariances");
  }
  bool operator==(const AskedParts&) const = default;
};

/// What is counted beside the plain voxel counts.
struct ScoreOptions {
  std::vector<int> tolerances{1};                           ///< voxels, each in 1..5, ascending
  std::vector<double> distances_m{0.01, 0.02, 0.05, 0.10};  ///< tau of the F-score, ascending
  AskedParts asked{};
};

/// Throws Error when a list is not ascending or a value is out of range.
void check(const ScoreOptions& options);

/// Samples from which on a voxel of V_c is in visible_4.
inline constexpr std::uint32_t kManySamples = 4;

/// Counts at one tolerance t: predicted voxels within t voxels of S_c, visible ones within t of
/// P_c.
struct ToleranceCounts {
  int voxels = 1;
  std::int64_t true_predicted = 0, found = 0;

  bool operator==(const ToleranceCounts&) const = default;
};

/// Everything counted for one class: integers that add over frames and trials. Pool them with +=,
/// then form ratios (metrics.hpp). With P_c predicted, S_c surface truth, V_c visible truth.
struct ClassCounts {
  std::int64_t predicted = 0;       ///< |P_c|
  std::int64_t true_predicted = 0;  ///< |P_c in S_c|
  std::int64_t visible = 0;         ///< |V_c|
  std::int64_t found = 0;           ///< |V_c in P_c|

  /// Causes of the false voxels; they add up to predicted - true_predicted.
  std::int64_t false_near = 0;      ///< one of the 26 neighbours is in S_c
  std::int64_t false_leak = 0;      ///< else: on the surface of another class, background included
  std::int64_t false_floating = 0;  ///< else

  /// Causes of the missed voxels; they add up to visible - found.
  std::int64_t missed_mislabelled = 0;  ///< another class is predicted there
  std::int64_t missed_unlabelled = 0;   ///< in the map, but nothing is predicted there
  std::int64_t missed_unmapped = 0;     ///< not in the map

  /// Of the voxels of V_c with 4 samples and more; of all where the truth has no samples.
  std::int64_t visible_4 = 0;
  std::int64_t found_4 = 0;

  std::vector<ToleranceCounts> at_tolerance;
  DistanceTally accuracy;      ///< predicted cubes to the class's exact surface
  DistanceTally completeness;  ///< noise-free samples of the class to the nearest predicted cube
  ClassCurve curve;            ///< the counts at every threshold
  BoxCounts boxes;             ///< of detections; none where a map is all there is
  std::optional<InstanceCounts> instances;  ///< where instances were scored
  std::optional<ThinCounts> thin;           ///< where thin parts were scored
  std::optional<LabelCounts> labels;        ///< where detections were scored in the image
  std::optional<PoseCounts> poses;          ///< where poses were scored; of no class, see Counts

  static auto counts() {
    return std::to_array<CountField<ClassCounts>>({
        {"predicted", &ClassCounts::predicted},
        {"true_predicted", &ClassCounts::true_predicted},
        {"visible", &ClassCounts::visible},
        {"found", &ClassCounts::found},
        {"false_near", &ClassCounts::false_near},
        {"false_leak", &ClassCounts::false_leak},
        {"false_floating", &ClassCounts::false_floating},
        {"missed_mislabelled", &ClassCounts::missed_mislabelled},
        {"missed_unlabelled", &ClassCounts::missed_unlabelled},
        {"missed_unmapped", &ClassCounts::missed_unmapped},
        {"visible_4", &ClassCounts::visible_4},
        {"found_4", &ClassCounts::found_4},
    });
  }
  /// The parts that are counted by themselves: structs with `counts()`, `metrics()` and +=. Each is
  /// written once, here; pooling, store, tidy CSV and figures follow, in this order.
  static auto parts() {
    return std::tuple{
        std::pair{"boxes", &ClassCounts::boxes}, std::pair{"thin", &ClassCounts::thin},
        std::pair{"instances", &ClassCounts::instances}, std::pair{"labels", &ClassCounts::labels},
        std::pair{"poses", &ClassCounts::poses}};
  }

  /// Pools. Throws Error when tolerances or distances differ, or one alone has an optional part.
  ClassCounts& operator+=(const ClassCounts& other);
  bool operator==(const ClassCounts&) const = default;
};

/// Calls act(name, part) for each part of `counts` that was counted.
void for_each_part(const ClassCounts& counts, auto&& act) {
  const auto visit = [&]<class Part>(const char* name, const Part& part) {
    if constexpr (requires { part.has_value(); }) {
      if (part) act(name, *part);
    } else {
      act(name, part);
    }
  };
  std::apply([&](const auto&... part) { (visit(part.first, counts.*part.second), ...); },
             ClassCounts::parts());
}

/// Indexed by class id; entry 0 (background) stays zero, since background is never predicted, but
/// for the pixels of `labels`, and for `poses`: those of a trial are of no class, and stand there
/// once.
using Counts = std::vector<ClassCounts>;

/// Zero counts for every class, with tolerances and parts as asked for and no distances.
[[nodiscard]] Counts zero_counts(std::size_t class_count, const ScoreOptions& options);

/// Pools class by class; an empty `total` takes `counts`. Throws Error when sizes or options
/// differ.
void pool_into(Counts& total, const Counts& counts);

/// Counts pooled over the detected classes of the table, and the background's pixels. Throws Error
/// when sizes differ.
[[nodiscard]] ClassCounts pool_detected(const Counts& counts, const ClassTable& table);

}  // namespace mapscore::eval
