// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/fusion/class_beliefs.hpp"

#include <algorithm>
#include <cmath>

namespace mapscore {
namespace {

/// Probabilities that were added up in doubles stay below it; the least sum of counts above 1 is 2.
constexpr double kMostProbability = 1.5;

}  // namespace

bool ClassBeliefs::well_formed() const {
  for (std::size_t n = 0; n < entries_.size(); ++n) {
    if (n > 0 && entries_[n - 1].class_id >= entries_[n].class_id) return false;
    if (!(entries_[n].probability >= 0.0) || !std::isfinite(entries_[n].probability)) return false;
  }
  return true;
}

double ClassBeliefs::weight(ClassId class_id) const {
  const auto place = std::ranges::lower_bound(entries_, class_id, {}, &ClassProbability::class_id);
  return place != entries_.end() && place->class_id == class_id ? place->probability : 0.0;
}

double& ClassBeliefs::weight_of(ClassId class_id) {
  auto place = std::ranges::lower_bound(entries_, class_id, {}, &ClassProbability::class_id);
  if (place == entries_.end() || place->class_id != class_id)
    place = entries_.insert(place, {class_id, 0.0});
  return place->probability;
}

void ClassBeliefs::forget_below(double least) {
  std::erase_if(entries_, [&](const ClassProbability& e) { return e.probability < least; });
}

double ClassBeliefs::divisor() const {
  double total = 0.0;
  for (const ClassProbability& entry : entries_) total += entry.probability;
  return total > kMostProbability ? total : 1.0;
}

ClassProbability ClassBeliefs::best() const {
  ClassProbability best;
  for (const ClassProbability& candidate : entries_)
    if (candidate.probability > best.probability && candidate.class_id != kOtherClasses)
      best = candidate;
  best.probability /= divisor();
  return best;
}

}  // namespace mapscore
