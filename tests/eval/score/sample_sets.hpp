// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/score/distances/sample_set.hpp"

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace mapscore::eval::testing {

/// `points_by_class[c]`: p_map of the samples of class c, metres.
inline SampleSet sample_set_of(const std::vector<std::vector<Eigen::Vector3d>>& points_by_class,
                               double edge_m) {
  SampleCollector collector(points_by_class.size(), edge_m);
  for (std::size_t c = 0; c < points_by_class.size(); ++c)
    for (const Eigen::Vector3d& p_map : points_by_class[c])
      collector.add(static_cast<ClassId>(c), p_map);
  return collector.take();
}

inline std::size_t sample_count(const SampleSet& samples, ClassId class_id) {
  std::size_t count = 0;
  for (const SampleSet::Group& group : samples.groups(class_id)) count += group.count;
  return count;
}

}  // namespace mapscore::eval::testing
