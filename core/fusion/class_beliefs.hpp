// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"

#include <span>
#include <vector>

namespace mapscore {

/// Stands in a voxel's beliefs for all classes that it does not name. No class table reaches it.
inline constexpr ClassId kOtherClasses = 0xffff;

/// What a voxel keeps of one class: its probability, or under the vote its count.
struct ClassProbability {
  ClassId class_id = kBackground;
  double probability = 0.0;
  bool operator==(const ClassProbability&) const = default;
};

/// What a map believes of the class of one voxel: a weight for each class that it names, ascending
/// by class, kOtherClasses last where the fusion rule keeps one. Weights that add up to at most 1.5
/// are probabilities, whose sum is 1 at most up to rounding; a greater sum means counts, to be
/// divided by it (docs/fusion.md). So a map file can be read without knowing the rule that made it.
/// Reads are safe from several threads.
class ClassBeliefs {
 public:
  ClassBeliefs() = default;
  /// Takes entries that ascend by class, each class once.
  explicit ClassBeliefs(std::vector<ClassProbability> entries) : entries_(std::move(entries)) {}

  /// Whether classes ascend, each once, and all weights are finite and at least 0.
  [[nodiscard]] bool well_formed() const;
  [[nodiscard]] bool empty() const { return entries_.empty(); }
  [[nodiscard]] std::span<const ClassProbability> entries() const { return entries_; }
  /// For changing weights in place; the classes stay.
  [[nodiscard]] std::span<ClassProbability> entries() { return entries_; }

  /// The class's weight; 0 when it is not named.
  [[nodiscard]] double weight(ClassId class_id) const;
  /// The class's weight to be changed, named with 0 if it was not. Ends earlier references.
  [[nodiscard]] double& weight_of(ClassId class_id);
  /// Forgets the classes whose weight is below `least`.
  void forget_below(double least);

  /// What a weight is divided by to give a probability: 1, or the sum of the counts.
  [[nodiscard]] double divisor() const;
  /// Most probable class by name, ties to the lower id; background with 0 when there is none.
  [[nodiscard]] ClassProbability best() const;

  bool operator==(const ClassBeliefs&) const = default;

 private:
  std::vector<ClassProbability> entries_;
};

}  // namespace mapscore
