// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/results/tracking_counts.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <tuple>

namespace mapscore::eval {
namespace {

constexpr std::size_t kTrackingWords = names_of(Tracking{}).size();
/// The counts begin with the verdicts, in their order.
static_assert(std::tuple_size_v<decltype(TrackingCounts::counts())> == kTrackingWords + 1);

}  // namespace

TrackingCounts TrackingCounts::of(const VisualTrajectory& visual) {
  TrackingCounts counts;
  const auto frames = visual.frames_by_tracking();
  const auto fields = TrackingCounts::counts();
  for (std::size_t n = 0; n < kTrackingWords; ++n) counts.*fields[n].member = frames[n];
  counts.loops_closed = static_cast<std::int64_t>(visual.loops);
  return counts;
}

std::int64_t TrackingCounts::images() const {
  std::int64_t sum = 0;
  const auto fields = counts();
  for (std::size_t n = 0; n < kTrackingWords; ++n) sum += this->*fields[n].member;
  return sum;
}

std::int64_t TrackingCounts::untracked() const {
  std::int64_t sum = 0;
  const auto fields = counts();
  for (std::size_t n = 0; n < kTrackingWords; ++n)
    if (is_untracked(static_cast<Tracking>(n))) sum += this->*fields[n].member;
  return sum;
}

std::vector<std::string> TrackingCounts::untracked_names() const {
  std::vector<std::string> names;
  const auto fields = counts();
  for (std::size_t n = 0; n < kTrackingWords; ++n)
    if (is_untracked(static_cast<Tracking>(n)) && this->*fields[n].member > 0)
      names.emplace_back(fields[n].name);
  return names;
}

std::string TrackingCounts::text() const {
  std::string text;
  const auto fields = counts();
  for (std::size_t n = 0; n < kTrackingWords; ++n)
    if (const std::int64_t images = this->*fields[n].member; images > 0)
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", images, names_of(Tracking{})[n]);
  return fmt::format("{} of {} depth images; {} loops closed", text, images(), loops_closed);
}

}  // namespace mapscore::eval
