// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/tables/accounting_counts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdint>

namespace mapscore::eval {
namespace {

constexpr std::string_view kFramesMapped = "frames_mapped";

std::vector<Accounting> accountings_of(const ResultLine& line) {
  if (line.digest) return line.digest->accountings();
  std::vector<Accounting> all;
  for (const TrialResult& result : line.results) all.push_back(result.accounting);
  return all;
}

/// The count of an owner that has one of the name.
template <class Owner>
std::optional<double> count_named(const Owner& owner, std::string_view name) {
  for (const CountField<Owner>& field : Owner::counts())
    if (field.name == name) return static_cast<double>(owner.*field.member);
  return std::nullopt;
}

std::string tracking_note(const StudySummary& summary) {
  std::int64_t trials = 0, with_guesses = 0;
  TrackingCounts all;
  for (const ResultLine& line : summary.trials)
    for (const Accounting& accounting : accountings_of(line)) {
      if (!accounting.tracking) continue;
      ++trials;
      all += *accounting.tracking;
      with_guesses += accounting.tracking->untracked() > 0 ? 1 : 0;
    }
  if (all.untracked() == 0) return "";
  return fmt::format(
      "the pose of {} of {} depth images is a guess (unsure, blind, lost, restarted or "
      "relocated), in {} of the {} trials whose poses come from them; --metric {} shows where",
      all.untracked(), all.images(), with_guesses, trials, fmt::join(all.untracked_names(), ","));
}

std::string calibration_note(const StudySummary& summary) {
  CalibrationCounts all;
  for (const ResultLine& line : summary.trials)
    for (const Accounting& accounting : accountings_of(line))
      if (accounting.calibration) all += *accounting.calibration;
  if (all.calibrations_refused == 0) return "";
  return fmt::format(
      "{} of {} estimates of the calibration were refused, and their trials mapped with what was "
      "believed before; --metric calibrations_refused shows where",
      all.calibrations_refused, all.calibrations);
}

}  // namespace

std::vector<std::string> accounting_names() {
  std::vector<std::string> names{std::string(kFramesMapped)};
  for (const CountField<Accounting>& field : Accounting::counts()) names.emplace_back(field.name);
  for (const CountField<TrackingCounts>& field : TrackingCounts::counts())
    names.emplace_back(field.name);
  for (const CountField<CalibrationCounts>& field : CalibrationCounts::counts())
    names.emplace_back(field.name);
  return names;
}

std::optional<double> accounting_figure(const Accounting& accounting, std::string_view name) {
  if (name == kFramesMapped)
    return static_cast<double>(accounting.frames - accounting.frames_left_out);
  if (const auto count = count_named(accounting, name)) return count;
  std::optional<double> count;
  if (accounting.tracking) count = count_named(*accounting.tracking, name);
  if (count || !accounting.calibration) return count;
  count = count_named(*accounting.calibration, name);
  if (count && name.starts_with("calibration_error") && accounting.calibration->calibrations > 0)
    *count /= static_cast<double>(accounting.calibration->calibrations);  // the mean of scenes
  return count;
}

Estimate accounting_estimate(const ResultLine& line, std::string_view name) {
  Estimate estimate;
  double sum = 0.0;
  int defined = 0;
  for (const Accounting& accounting : accountings_of(line)) {
    estimate.by_seed.push_back(accounting_figure(accounting, name));
    sum += estimate.by_seed.back().value_or(0.0);
    defined += estimate.by_seed.back() ? 1 : 0;
  }
  if (defined > 0) estimate.pooled = sum / defined;
  estimate.over_seeds = summarise(estimate.by_seed, ValueLimits{.low = 0.0});
  return estimate;
}

std::vector<std::string> accounting_notes(const StudySummary& summary) {
  std::vector<std::string> notes;
  for (std::string note : {tracking_note(summary), calibration_note(summary)})
    if (!note.empty()) notes.push_back("note: " + std::move(note));
  return notes;
}

}  // namespace mapscore::eval
