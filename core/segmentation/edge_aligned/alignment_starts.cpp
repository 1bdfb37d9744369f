// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/alignment_starts.hpp"

#include "core/geometry/pose.hpp"
#include "core/segmentation/edge_aligned/coarse_outlines.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <utility>

namespace mapscore {
namespace {

using Family = AlignmentStart::Family;

constexpr float kStepPx = 4.0F;   // between turns that are tried
constexpr float kStepM = 0.005F;  // between shifts that are tried
constexpr float kReachM = 0.06F;
/// Rolls that are tried, in pixels as far from the image's middle as the focal length, each with
/// turns on a lattice.
constexpr float kRollStep_px = 20.0F, kMostRoll_px = 60.0F;
constexpr float kRolledStep_px = 8.0F, kRolledReach_px = 16.0F;
constexpr std::size_t kCompared = 80;  // of those that few edges find best, by more
constexpr float kApartPx = 8.0F;       // between the turns that are kept for the fine fit
constexpr float kLabelOffset_px = 3.5F;

constexpr float kToldOffset = 0.5F;        // share of the outlines that tells the offset by itself
constexpr float kMostUnexplained = 10.0F;  // times the prior and the cost of an offset
constexpr float kCost = 0.03F;       // share of the outline that 20 px, or an offset of 4 px, cost
constexpr float kMostOfRoll = 0.5F;  // of that, for roll and focal length, however large

float squared(float x) {
  return x * x;
}

AlignmentStart turned(const Projection& project, float du_px, float dv_px, float roll_px) {
  AlignmentStart start;
  start.family = Family::turn;
  const Eigen::Vector3d turn(-std::atan(dv_px / project.fy), std::atan(du_px / project.fx),
                             roll_px / project.fx);
  start.rotation = exp_rotation(turn).cast<float>();
  return start;
}

/// Calls use(a, b) with the places of a square lattice that lie within a disc.
void for_each_in_disc(float radius, float step, auto&& use) {
  for (float b = -radius; b <= radius; b += step)
    for (float a = -radius; a <= radius; a += step)
      if (a * a + b * b <= radius * radius) use(a, b);
}

}  // namespace

float CorrectionCost::unexplained(float share) {
  return std::clamp(squared(kToldOffset / std::max(share, 1e-3F)), 1.0F, kMostUnexplained);
}

float CorrectionCost::operator()(const OutlineAlignment& a) const {
  constexpr float kTurn_px = 20.0F, kOffset_px = 4.0F;
  const Eigen::Vector2f turn(project_.fx * a.rotation(0, 2), project_.fy * a.rotation(1, 2));
  const Eigen::Vector2f shift = a.translation.head<2>() * project_.fx / 2.0F;
  const Eigen::Vector2f wide(project_.fx * a.rotation(1, 0), project_.fx * std::log(a.focal));
  const float of_wide = wide.squaredNorm() / squared(kTurn_px);
  return kCost * (1.0F + kShort_px / outline_px_) *
         ((turn.squaredNorm() + shift.squaredNorm()) / squared(kTurn_px) +
          unexplained(a.score) *
              (of_wide / (1.0F + of_wide / kMostOfRoll) + squared(a.offset_px / kOffset_px)));
}

std::vector<AlignmentStart> mask_size_starts(Family family) {
  std::vector<AlignmentStart> starts(3);
  for (AlignmentStart& start : starts) start.family = family;
  starts[1].offset_px = kLabelOffset_px;
  starts[2].offset_px = -kLabelOffset_px;
  return starts;
}

std::vector<AlignmentStart> alignment_starts(const EdgeColumns& few_edges, const EdgeColumns& edges,
                                             const OutlineField& field, const Projection& project,
                                             const CorrectionCost& cost, float search_px,
                                             bool with_roll) {
  CoarseOutlines few(few_edges, field, project), all(edges, field, project);
  std::vector<AlignmentStart> starts{AlignmentStart{}};
  const std::vector<AlignmentStart> far = mask_size_starts(Family::turn);
  starts.insert(starts.end(), far.begin(), far.end());

  const auto keep_best = [&](std::vector<AlignmentStart> tried, std::size_t most) {
    for (CoarseOutlines* outlines : {&few, &all}) {
      for (AlignmentStart& a : tried) {
        a.score = outlines->score(a.rotation, a.translation);
        a.score -= cost(a);
      }
      std::ranges::stable_sort(tried, std::greater(), &AlignmentStart::score);
      tried.resize(std::min(tried.size(), kCompared));
    }
    std::vector<Eigen::Vector3f> kept;  // where a point at 2 m lies, and the roll, all in pixels
    for (const AlignmentStart& a : tried) {
      const Eigen::Vector2f middle = project(a.rotation * Eigen::Vector3f(0, 0, 2) + a.translation);
      const Eigen::Vector3f at(middle.x(), middle.y(), project.fx * a.rotation(1, 0));
      const bool near = std::ranges::any_of(
          kept, [&](const Eigen::Vector3f& other) { return (at - other).norm() < kApartPx; });
      if (near) continue;
      kept.push_back(at);
      starts.push_back(a);
      if (kept.size() == most) return;
    }
  };

  std::vector<AlignmentStart> turns, shifts, rolls;
  for_each_in_disc(search_px, kStepPx,
                   [&](float du, float dv) { turns.push_back(turned(project, du, dv, 0)); });
  keep_best(std::move(turns), 5);
  for_each_in_disc(kReachM, kStepM, [&](float tx, float ty) {
    AlignmentStart& start = shifts.emplace_back();
    start.family = Family::shift;
    start.translation = {tx, ty, 0};
  });
  keep_best(std::move(shifts), 4);
  if (!with_roll) return starts;
  for (float roll = kRollStep_px; roll <= kMostRoll_px; roll += kRollStep_px)
    for_each_in_disc(kRolledReach_px, kRolledStep_px, [&](float du, float dv) {
      for (const float way : {-1.0F, 1.0F}) rolls.push_back(turned(project, du, dv, way * roll));
    });
  keep_best(std::move(rolls), 2);
  return starts;
}

}  // namespace mapscore
