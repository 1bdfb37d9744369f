// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/instances/instance_pieces.hpp"

#include "eval/score/metric.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace mapscore::eval {
namespace {

constexpr std::int64_t kBillionthsAThousandth = 1'000'000;

/// Sets of rows; the least row of a set stands for it.
class DisjointRows {
 public:
  explicit DisjointRows(std::size_t rows) : parents_(rows) {
    std::iota(parents_.begin(), parents_.end(), 0u);
  }

  [[nodiscard]] std::uint32_t least(std::uint32_t row) {
    while (parents_[row] != row) row = parents_[row] = parents_[parents_[row]];
    return row;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t of_a = least(a), of_b = least(b);
    parents_[std::max(of_a, of_b)] = std::min(of_a, of_b);
  }

 private:
  std::vector<std::uint32_t> parents_;
};

/// Columns (i + di, j + dj) that hold the neighbours with a lower key, the voxel's own last.
constexpr std::array<std::pair<int, int>, 5> kColumnsBefore{
    {{-1, -1}, {-1, 0}, {-1, 1}, {0, -1}, {0, 0}}};

/// Joins each voxel with its neighbours of the same class that come before it. Each column has a
/// place in the list that only moves on.
DisjointRows connect(const std::vector<PredictedVoxel>& voxels) {
  DisjointRows rows(voxels.size());
  std::array<std::uint32_t, kColumnsBefore.size()> places{};
  for (std::uint32_t row = 0; row < voxels.size(); ++row) {
    const VoxelKey& key = voxels[row].key;
    for (std::size_t c = 0; c < kColumnsBefore.size(); ++c) {
      const auto [di, dj] = kColumnsBefore[c];
      const VoxelKey low{key.i + di, key.j + dj, key.k - 1};
      const VoxelKey high{key.i + di, key.j + dj, key.k + 1};
      while (voxels[places[c]].key < low) ++places[c];
      for (std::uint32_t other = places[c]; other < row && voxels[other].key <= high; ++other) {
        if (voxels[other].class_id == voxels[row].class_id) rows.join(other, row);
      }
    }
  }
  return rows;
}

/// Fills everything but the classes. `number_of(row)`: which object a voxel belongs to, 0: none.
template <class NumberOf>
PredictedInstances group(const std::vector<PredictedVoxel>& voxels, NumberOf number_of) {
  PredictedInstances objects;
  std::unordered_map<std::uint32_t, std::uint32_t> index_of;
  std::vector<std::int64_t> sums;
  for (std::uint32_t row = 0; row < voxels.size(); ++row) {
    const PredictedVoxel& voxel = voxels[row];
    const std::uint32_t number = number_of(row);
    objects.voxels.push_back(voxel.key);
    objects.members.push_back(PredictedInstances::kNone);
    if (number == 0) continue;
    const auto index = static_cast<std::uint32_t>(objects.instances.size());
    const auto [entry, is_new] = index_of.try_emplace(number, index);
    if (is_new) {
      objects.instances.push_back({voxel.class_id, 0, 0, voxel.key});
      sums.push_back(0);
    }
    objects.members.back() = entry->second;
    ++objects.instances[entry->second].voxels;
    sums[entry->second] += std::llround(voxel.probability * kBillion);
  }
  for (std::size_t n = 0; n < sums.size(); ++n) {
    PredictedInstance& instance = objects.instances[n];
    instance.score = static_cast<int>(sums[n] / (instance.voxels * kBillionthsAThousandth));
  }
  return objects;
}

/// Gives every object the class of most of its voxels.
void vote(const std::vector<PredictedVoxel>& voxels, PredictedInstances& objects) {
  std::map<std::pair<std::uint32_t, ClassId>, std::int64_t> votes;
  for (std::size_t row = 0; row < voxels.size(); ++row) {
    const std::uint32_t member = objects.members[row];
    if (member != PredictedInstances::kNone) ++votes[{member, voxels[row].class_id}];
  }
  std::vector<std::int64_t> most(objects.instances.size(), 0);
  for (const auto& [vote, count] : votes) {
    const auto& [member, class_id] = vote;
    if (count <= most[member]) continue;
    most[member] = count;
    objects.instances[member].class_id = class_id;
  }
}

}  // namespace

PredictedInstances pieces_of(const MapSnapshot& map, double threshold) {
  const std::vector<PredictedVoxel> voxels = prediction_of(map, threshold);
  DisjointRows rows = connect(voxels);
  return group(voxels, [&rows](std::uint32_t row) { return rows.least(row) + 1; });
}

PredictedInstances objects_of(const MapSnapshot& map, double threshold,
                              std::span<const NumberedVoxel> numbers) {
  std::unordered_map<VoxelKey, std::uint32_t> number_of;
  for (const NumberedVoxel& voxel : numbers) number_of.emplace(voxel.key, voxel.number);
  const std::vector<PredictedVoxel> voxels = prediction_of(map, threshold);
  PredictedInstances objects = group(voxels, [&](std::uint32_t row) {
    const auto found = number_of.find(voxels[row].key);
    return found == number_of.end() ? 0u : found->second;
  });
  vote(voxels, objects);
  return objects;
}

}  // namespace mapscore::eval
