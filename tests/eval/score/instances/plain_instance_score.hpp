// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/score/instances/instance_score.hpp"
#include "tests/eval/score/instances/instance_cases.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <utility>
#include <vector>

namespace mapscore::eval::testing {

/// The definitions, read out one by one over all voxels.
class PlainInstanceScore {
 public:
  PlainInstanceScore(const InstanceCase& made, const PredictedInstances& predicted)
      : made_(made), predicted_(predicted) {
    for (const auto& [key, owner] : made.owners) ++visible_[owner];
  }

  InstanceCounts of(ClassId class_id) const {
    InstanceCounts counts;
    std::vector<std::uint32_t> kept;
    for (std::uint32_t p = 0; p < predicted_.instances.size(); ++p) {
      if (predicted_.instances[p].class_id != class_id) continue;
      if (is_void(p))
        ++counts.void_predicted;
      else
        kept.push_back(p);
    }
    std::vector<InstanceId> truths;
    for (const auto& [instance, voxels] : visible_)
      if (table_.class_of(instance) == class_id) truths.push_back(instance);
    match(kept, truths, counts);
    rank(kept, truths, counts);
    return counts;
  }

 private:
  std::vector<VoxelKey> voxels_of(std::uint32_t p) const {
    std::vector<VoxelKey> voxels;
    for (std::size_t n = 0; n < predicted_.voxels.size(); ++n)
      if (predicted_.members[n] == p) voxels.push_back(predicted_.voxels[n]);
    return voxels;
  }
  bool owned_by(const VoxelKey& key, InstanceId instance) const {
    const auto owner = made_.owners.find(key);
    return owner != made_.owners.end() && owner->second == instance;
  }
  double iou(std::uint32_t p, InstanceId instance) const {
    int hits = 0, outside = 0;
    for (const VoxelKey& key : voxels_of(p)) {
      hits += owned_by(key, instance);
      outside += !made_.surface.contains({key, instance});
    }
    return static_cast<double>(hits) / (visible_.at(instance) + outside);
  }
  bool is_void(std::uint32_t p) const {
    int on_class = 0, all = 0;
    for (const VoxelKey& key : voxels_of(p)) {
      bool on = false;
      for (const Instance& instance : table_.instances) {
        if (instance.class_id != predicted_.instances[p].class_id) continue;
        if (owned_by(key, instance.id)) return false;
        on |= made_.surface.contains({key, instance.id});
      }
      on_class += on;
      ++all;
    }
    return 2 * on_class >= all;
  }

  void match(std::vector<std::uint32_t> kept, std::vector<InstanceId> truths,
             InstanceCounts& counts) const {
    while (true) {
      double best = 0.5;
      std::pair<std::uint32_t, InstanceId> taken;
      for (const InstanceId i : truths)  // ascending, so that ties fall to the lower
        for (const std::uint32_t p : kept)
          if (iou(p, i) > best) {
            best = iou(p, i);
            taken = {p, i};
          }
      if (best == 0.5) break;
      std::erase(kept, taken.first);
      std::erase(truths, taken.second);
      ++counts.true_positive;
      counts.iou_sum_nano += std::llround(best * 1e9);
    }
    counts.false_positive = static_cast<std::int64_t>(kept.size());
    counts.false_negative = static_cast<std::int64_t>(truths.size());
  }

  void rank(std::vector<std::uint32_t> kept, const std::vector<InstanceId>& truths,
            InstanceCounts& counts) const {
    const auto& all = predicted_.instances;
    std::stable_sort(kept.begin(), kept.end(), [&](std::uint32_t a, std::uint32_t b) {
      if (all[a].score != all[b].score) return all[a].score > all[b].score;
      return all[a].voxels > all[b].voxels;
    });
    std::map<int, InstanceStep, std::greater<>> steps;
    for (const std::uint32_t p : kept) {
      InstanceStep& step = steps[all[p].score];
      step.score = all[p].score;
      ++step.predicted;
    }
    for (std::size_t t = 0; t < kInstancePercents.size(); ++t) {
      std::vector<InstanceId> left = truths;
      for (const std::uint32_t p : kept) {
        double best = kInstancePercents[t] / 100.0 - 1e-12;
        InstanceId taken = 0;
        for (const InstanceId i : left)
          if (iou(p, i) > best) {
            best = iou(p, i);
            taken = i;
          }
        if (taken == 0) continue;
        std::erase(left, taken);
        ++steps[all[p].score].true_predicted[t];
      }
    }
    for (const auto& [score, step] : steps) counts.steps.push_back(step);
  }

  const InstanceCase& made_;
  const PredictedInstances& predicted_;
  const ClassTable table_ = cups_and_chairs();
  std::map<InstanceId, int> visible_;
};

}  // namespace mapscore::eval::testing
