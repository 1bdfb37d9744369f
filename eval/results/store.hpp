// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/segmentation/segment.hpp"
#include "eval/results/build_identity.hpp"
#include "eval/results/calibration_counts.hpp"
#include "eval/results/tracking_counts.hpp"
#include "eval/score/counts.hpp"
#include "eval/score/metric.hpp"

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

struct sqlite3;

namespace mapscore::eval {

/// What became of the frames and detections of a trial. Every one is accounted for.
struct Accounting {
  std::int64_t frames = 0;
  std::int64_t detections = 0;
  std::int64_t skipped_no_points = 0;        ///< no registered depth on the mask
  std::int64_t skipped_no_seed_point = 0;    ///< no registered depth at the seed pixel
  std::int64_t skipped_seed_off_object = 0;  ///< no point of the mask near the seed point
  std::int64_t skipped_eroded_away = 0;
  std::int64_t points = 0;            ///< kept by the segmentation
  std::int64_t map_voxels = 0;        ///< in the map at the end; of single frames, their sum
  std::int64_t hits_beyond_span = 0;  ///< hits on voxels that the octree cannot hold; left out
  std::int64_t frames_left_out = 0;   ///< of `frames`: no key frames, so not mapped
  std::int64_t frames_unsure = 0;     ///< with a Segment::confidence below 0.5
  std::optional<TrackingCounts> tracking = {};        ///< where the poses come from depth images
  std::optional<CalibrationCounts> calibration = {};  ///< where it is estimated

  static auto counts() {
    return std::to_array<CountField<Accounting>>({
        {"frames", &Accounting::frames},
        {"detections", &Accounting::detections},
        {"skipped_no_points", &Accounting::skipped_no_points},
        {"skipped_no_seed_point", &Accounting::skipped_no_seed_point},
        {"skipped_seed_off_object", &Accounting::skipped_seed_off_object},
        {"skipped_eroded_away", &Accounting::skipped_eroded_away},
        {"points", &Accounting::points},
        {"map_voxels", &Accounting::map_voxels},
        {"hits_beyond_span", &Accounting::hits_beyond_span},
        {"frames_left_out", &Accounting::frames_left_out},
        {"frames_unsure", &Accounting::frames_unsure},
    });
  }
  Accounting& operator+=(const Accounting& other);
  /// The count of the detections that were skipped for a reason; nullptr for none.
  static std::int64_t Accounting::*of(SkipReason reason) {
    constexpr auto kSkipped = std::to_array<std::int64_t Accounting::*>(
        {nullptr, &Accounting::skipped_no_points, &Accounting::skipped_eroded_away,
         &Accounting::skipped_no_seed_point, &Accounting::skipped_seed_off_object});
    static_assert(kSkipped.size() == names_of(SkipReason{}).size());
    return kSkipped[static_cast<std::size_t>(reason)];
  }
  bool operator==(const Accounting&) const = default;
};

/// What the command of a trial took. Measured, so not the same twice.
struct TrialCost {
  int exit_code = 0;  ///< 128 and its number where a signal ended it
  double wall_s = 0.0, processor_s = 0.0;
  std::uint64_t peak_bytes = 0;  ///< of memory, of the largest of its processes
};

/// One finished trial.
struct TrialResult {
  Counts counts;  ///< by class id
  Accounting accounting;
};

/// A trial's result as one line of JSON: raw counts only, exact, same result same bytes.
[[nodiscard]] std::string to_json(const TrialResult& result);
/// Throws Error when the text is not what to_json writes.
[[nodiscard]] TrialResult result_from_json(const std::string& text);

/// Results of a study: one row a trial, keyed by the content hash of everything that determines it,
/// with the identity of the build that made it (build_identity.hpp).
/// One transaction a trial, so that a killed sweep loses nothing that was done. Members may be
/// called from several threads, one at a time.
class ResultStore {
 public:
  /// Opens or creates. Throws Error when the file is not a store, is of another format version,
  /// holds a trigger, a view or any table but a store's two, or cannot be written. `build`: who
  /// adds trials.
  [[nodiscard]] static ResultStore open(const std::filesystem::path& file,
                                        std::string_view build = build_identity());
  /// Opens for reading only. Throws Error when it is not there, and as above.
  [[nodiscard]] static ResultStore open_existing(const std::filesystem::path& file);

  /// Free texts about the study (its resolved configuration, class table, recording, version).
  void set_text(const std::string& name, const std::string& value);
  /// Several at once, so that no reader ever sees a part of them.
  void set_texts(const std::vector<std::pair<std::string, std::string>>& texts);
  [[nodiscard]] std::string text(const std::string& name) const;

  /// Keys of all trials, or of those that one build made.
  [[nodiscard]] std::unordered_set<std::string> keys(
      std::optional<std::string_view> build = std::nullopt) const;
  /// The build that made each trial, by the trial's key; empty for trials that a mapscore made
  /// which did not tell.
  [[nodiscard]] std::unordered_map<std::string, std::string> builds() const;
  /// A trial that the same build made already stays as it is, one of another build is replaced.
  /// `description` is the YAML of what the key was made from.
  void add(const std::string& key, const std::string& description, const TrialResult& result);
  [[nodiscard]] std::optional<TrialResult> find(const std::string& key) const;
  /// Keeps why a trial failed until it is added.
  void add_failure(const std::string& key, const std::string& reason);
  /// Reasons by key.
  [[nodiscard]] std::map<std::string, std::string> failures() const;
  /// Keeps what a trial's command took, whether it failed or not.
  void add_cost(const std::string& key, const TrialCost& cost);
  /// By key.
  [[nodiscard]] std::map<std::string, TrialCost> costs() const;
  /// Takes over the trials of another store that are not here yet, or that this build made there
  /// and another here. Returns how many; all or, where it throws, none.
  int merge(const ResultStore& other);

 private:
  struct Close {
    void operator()(sqlite3* database) const;
  };
  /// `refusal`: what to say of a file that SQLite does not open with these flags.
  ResultStore(const std::filesystem::path& file, int flags, const char* refusal);
  void execute(const std::string& sql, const std::vector<std::string>& texts = {});
  void refuse_foreign_schema();
  void tell_builds();
  void add_row(std::vector<std::string> row);
  /// Texts whose names begin with `prefix`, by what follows it.
  [[nodiscard]] std::map<std::string, std::string> texts_after(const std::string& prefix) const;

  std::unique_ptr<sqlite3, Close> database_;
  std::filesystem::path file_;
  bool tells_builds_ = true;  ///< else its table is from before there was a column for them
  std::string build_;
};

/// results.sqlite of a results folder, or the file itself.
[[nodiscard]] std::filesystem::path store_file(const std::filesystem::path& results);

}  // namespace mapscore::eval
