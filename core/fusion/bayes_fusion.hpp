// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/fusion/fusion_rule.hpp"

namespace mapscore {

// The product of distributions, of which Bayes and top-3 are made. Every distribution that is
// returned adds up to 1, kOtherClasses included; an empty one says nothing.

/// p(c | z) of one frame: the mean over its draws. A draw that class c won with mean score s says
/// s for c, and 1 - s for the others in proportion to their priors; a draw that missed the voxel
/// says the prior. s is kept within [doubt, 1 - doubt].
[[nodiscard]] ClassBeliefs observed(const BayesRule& rule, std::span<const VoxelHit> hits,
                                    int draws);
/// The same with equal priors, and no more than its three most probable classes by name.
[[nodiscard]] ClassBeliefs observed(const Top3Rule& rule, std::span<const VoxelHit> hits,
                                    int draws);

/// Proportional to a(c) b(c) / p(c), over the classes that either names and the others as one. A
/// class that one side does not name has its share of that side's others by the priors.
[[nodiscard]] ClassBeliefs product(const BayesRule& rule, const ClassBeliefs& a,
                                   const ClassBeliefs& b);
/// [R, algorithm 1]: classes that one side lacks are split off its rest by lambda, the most
/// probable first; then a(c) b(c), normalised, of which the best three stay.
[[nodiscard]] ClassBeliefs product(const Top3Rule& rule, const ClassBeliefs& a,
                                   const ClassBeliefs& b);

}  // namespace mapscore
