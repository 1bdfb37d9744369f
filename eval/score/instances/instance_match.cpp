// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/instances/instance_match.hpp"

#include "core/error.hpp"
#include "eval/score/map_snapshot.hpp"
#include "eval/score/voxel_window.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

namespace mapscore::eval {
namespace {

/// What is counted of a prediction and an instance on the way.
struct Shared {
  std::int64_t hits = 0;        ///< |p in V_i|
  std::int64_t in_surface = 0;  ///< |p in S_i|
};

std::uint64_t pair_of(std::uint32_t prediction, InstanceId instance) {
  return std::uint64_t{prediction} << 16 | instance;
}

void check(const PredictedInstances& predicted, const SurfaceTruth& surface,
           const VisibleTruth& visible, const ClassTable& table) {
  check_same_lattice(surface, visible);
  for (const PredictedInstance& instance : predicted.instances)
    check_class(instance.least, instance.class_id, table.classes.size());
  const std::size_t instances = table.instances.size();
  const auto is_known = [=](const auto& row, ClassId instance) {
    if (instance < instances) return;
    throw Error(
        fmt::format("voxel {},{},{}: instance {} is not in the table of {} instances; make the "
                    "truth of instances with instance_table",
                    row.key.i, row.key.j, row.key.k, instance, instances));
  };
  for (const SurfaceVoxel& row : surface.voxels()) is_known(row, row.class_id);
  for (const VisibleVoxel& row : visible.voxels()) is_known(row, row.owner);
}

/// What the predicted instances share with the truth.
struct Tally {
  std::unordered_map<std::uint64_t, Shared> shared;  ///< by pair_of
  std::vector<std::int64_t> hits_of_class;           ///< by prediction: voxels in V of its class
  std::vector<std::int64_t> on_class;                ///< by prediction: voxels in S of its class
};

/// Walks through the predicted voxels once.
Tally tally_of(const PredictedInstances& predicted, const SurfaceTruth& surface,
               const VisibleTruth& visible, const ClassTable& table) {
  const std::size_t predictions = predicted.instances.size();
  Tally tally{{}, std::vector<std::int64_t>(predictions), std::vector<std::int64_t>(predictions)};
  VoxelWindow<SurfaceVoxel> rows(surface.voxels(), 0);
  for (std::size_t row = 0; row < predicted.voxels.size(); ++row) {
    const std::uint32_t prediction = predicted.members[row];
    if (prediction == PredictedInstances::kNone) continue;
    const ClassId class_id = predicted.instances[prediction].class_id;
    bool on_class = false;
    for (const SurfaceVoxel& there : rows.at(predicted.voxels[row])) {
      if (table.class_of(there.class_id) != class_id) continue;
      ++tally.shared[pair_of(prediction, there.class_id)].in_surface;
      on_class = true;
    }
    tally.on_class[prediction] += on_class;
    const auto owner = visible.owner_of(predicted.voxels[row]);
    if (!owner || table.class_of(*owner) != class_id) continue;
    ++tally.shared[pair_of(prediction, *owner)].hits;
    ++tally.hits_of_class[prediction];
  }
  return tally;
}

/// True when the first pair has the greater IoU; exact.
bool greater_iou(const InstancePair& a, const InstancePair& b) {
  return a.hits * b.whole > b.hits * a.whole;
}

}  // namespace

InstanceOverlap overlap_of(const PredictedInstances& predicted, const SurfaceTruth& surface,
                           const VisibleTruth& visible, const ClassTable& table) {
  check(predicted, surface, visible, table);
  const Tally tally = tally_of(predicted, surface, visible, table);
  InstanceOverlap overlap;
  overlap.visible.resize(table.instances.size());
  for (const VisibleVoxel& voxel : visible.voxels()) ++overlap.visible[voxel.owner];
  for (const auto& [pair, shared] : tally.shared) {
    if (shared.hits == 0) continue;
    const auto prediction = static_cast<std::uint32_t>(pair >> 16);
    const auto instance = static_cast<InstanceId>(pair & 0xffff);
    const std::int64_t outside = predicted.instances[prediction].voxels - shared.in_surface;
    overlap.pairs.push_back(
        {prediction, instance, shared.hits, overlap.visible[instance] + outside});
  }
  std::ranges::sort(overlap.pairs, {}, [](const InstancePair& pair) {
    return pair_of(pair.prediction, pair.instance);
  });
  for (std::uint32_t p = 0; p < predicted.instances.size(); ++p) {
    overlap.is_void.push_back(tally.hits_of_class[p] == 0 &&
                              2 * tally.on_class[p] >= predicted.instances[p].voxels);
  }
  return overlap;
}

std::vector<std::size_t> match_by_iou(const std::vector<InstancePair>& pairs) {
  std::vector<std::size_t> order;
  for (std::size_t n = 0; n < pairs.size(); ++n) {
    if (2 * pairs[n].hits > pairs[n].whole) order.push_back(n);
  }
  std::sort(order.begin(), order.end(), [&pairs](std::size_t m, std::size_t n) {
    const InstancePair &a = pairs[m], &b = pairs[n];
    if (greater_iou(a, b) || greater_iou(b, a)) return greater_iou(a, b);
    return a.instance != b.instance ? a.instance < b.instance : a.prediction < b.prediction;
  });
  std::unordered_set<std::uint32_t> predictions, instances;
  std::vector<std::size_t> matched;
  for (const std::size_t n : order) {
    if (predictions.contains(pairs[n].prediction) || instances.contains(pairs[n].instance))
      continue;
    predictions.insert(pairs[n].prediction);
    instances.insert(pairs[n].instance);
    matched.push_back(n);
  }
  return matched;
}

std::vector<bool> match_by_score(const std::vector<InstancePair>& pairs,
                                 const std::vector<std::uint32_t>& predictions, int percent) {
  std::unordered_set<std::uint32_t> taken;
  std::vector<bool> matched;
  for (const std::uint32_t prediction : predictions) {
    const InstancePair* best = nullptr;
    for (const InstancePair& pair :
         std::ranges::equal_range(pairs, prediction, {}, &InstancePair::prediction)) {
      if (100 * pair.hits < percent * pair.whole || taken.contains(pair.instance)) continue;
      if (best == nullptr || greater_iou(pair, *best)) best = &pair;
    }
    if (best != nullptr) taken.insert(best->instance);
    matched.push_back(best != nullptr);
  }
  return matched;
}

}  // namespace mapscore::eval
