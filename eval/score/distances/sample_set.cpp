// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/distances/sample_set.hpp"

#include "core/parallel.hpp"

#include <algorithm>
#include <utility>

namespace mapscore::eval {
namespace {

/// Less than half an edge by more than rounding moves a point within 2^20 voxels of the origin.
constexpr double kSurelyInside = 0.5 - 1e-6;

/// Appends by moving when there is nothing to append to.
template <class T>
void move_behind(std::vector<T>&& from, std::vector<T>& to) {
  if (to.empty()) {
    to = std::move(from);
  } else {
    to.insert(to.end(), from.begin(), from.end());
  }
  from = {};
}

}  // namespace

void SampleCollector::add(ClassId class_id, const Eigen::Vector3d& p_map) {
  ClassSamples& samples = classes_[class_id];
  const auto offset_from = [&](const VoxelKey& key) -> Eigen::Vector3d {
    return p_map - centre_of(key, edge_m_);
  };
  if (!samples.groups.empty()) {  // neighbours mostly share a voxel, which takes no division to see
    const Eigen::Vector3d offset = offset_from(samples.groups.back().key);
    if ((offset.array().abs() < kSurelyInside * edge_m_).all()) {
      ++samples.groups.back().count;
      samples.offsets.emplace_back(offset.cast<float>());
      return;
    }
  }
  const VoxelKey key = voxel_of(p_map, edge_m_);
  if (samples.groups.empty() || samples.groups.back().key != key)
    samples.groups.push_back({key, samples.offsets.size(), 0});
  ++samples.groups.back().count;
  samples.offsets.emplace_back(offset_from(key).cast<float>());
}

void SampleCollector::append(SampleCollector&& later) {
  for (std::size_t c = 0; c < classes_.size(); ++c) {
    ClassSamples &here = classes_[c], &there = later.classes_[c];
    for (SampleSet::Group& run : there.groups) run.first += here.offsets.size();
    move_behind(std::move(there.groups), here.groups);
    move_behind(std::move(there.offsets), here.offsets);
  }
}

SampleSet SampleCollector::take(int jobs) {
  SampleSet set;
  set.edge_m_ = edge_m_;
  set.classes_.resize(classes_.size());
  for_each_in_parallel(classes_.size(), jobs, [&](std::size_t c) {
    set.classes_[c] = grouped(std::exchange(classes_[c], {}));
  });
  return set;
}

SampleCollector::ClassSamples SampleCollector::grouped(ClassSamples&& runs) {
  using Group = SampleSet::Group;
  std::ranges::sort(runs.groups, {},
                    [](const Group& g) { return std::pair(pack(g.key), g.first); });
  ClassSamples samples;
  samples.offsets.reserve(runs.offsets.size());
  for (const Group& run : runs.groups) {
    if (samples.groups.empty() || samples.groups.back().key != run.key) {
      samples.groups.push_back({run.key, samples.offsets.size(), 0});
    }
    samples.groups.back().count += run.count;
    const auto first = runs.offsets.begin() + static_cast<std::ptrdiff_t>(run.first);
    samples.offsets.insert(samples.offsets.end(), first,
                           first + static_cast<std::ptrdiff_t>(run.count));
  }
  return samples;
}

}  // namespace mapscore::eval
