// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/localization/planar_pose.hpp"
#include "core/parameters.hpp"
#include "core/random_stream.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace mapscore {

/// How many particles a belief needs: D. Fox, Adapting the Sample Size in Particle Filters Through
/// KLD-Sampling, International Journal of Robotics Research 22 (2003).
struct KldParams {
  double epsilon = 0.05;     ///< bound of the Kullback-Leibler divergence from the true belief
  double z_quantile = 2.33;  ///< standard normal quantile: the bound holds with probability 99 %
  double bin_m = 0.1, bin_rad = 0.0873;  ///< edges of the bins (5 degrees)
  std::size_t min_particles = 500, max_particles = 20000;

  static void fields(auto& s, auto&& visit) {
    constexpr Range kCount{1, 1000000};
    visit(s.min_particles, Field{"least_particles", "however narrow the belief is", kCount});
    visit(s.max_particles,
          Field{"most_particles", "however wide it is; those of a global start", kCount});
    visit(s.epsilon, Field{"kld_epsilon", "error of the belief that sets the number of particles",
                           above(0, 1)});
  }
  bool operator==(const KldParams&) const = default;
};

/// Equation 14: (k-1)/(2 epsilon) (1 - 2/(9(k-1)) + sqrt(2/(9(k-1))) z)^3 for k bins with support,
/// rounded up and kept within the least and most particles.
[[nodiscard]] std::size_t kld_bound(std::size_t bins, const KldParams& params);

/// Number of particles at which Fox's algorithm stops when it draws from this belief: draws one by
/// one by the weights (sum 1) until as many are drawn as the bins hit so far ask for.
[[nodiscard]] std::size_t kld_particles(std::span<const PlanarPose> poses,
                                        std::span<const double> weights, const KldParams& params,
                                        RandomStream& stream);

/// Low-variance resampling (Thrun, Burgard, Fox, table 4.4): a comb of `count` teeth, 1/count
/// apart, offset/count from 0 (offset in [0, 1)), over the running sum of the weights (sum 1).
/// Returns which particle each tooth meets, ascending; particle i is met floor or ceil of (count
/// weights[i]) times.
[[nodiscard]] std::vector<std::size_t> low_variance_picks(std::span<const double> weights,
                                                          std::size_t count, double offset);

/// (sum w)^2 / sum w^2, from 1 to the number of particles.
[[nodiscard]] double effective_sample_size(std::span<const double> weights);

/// exp(log_weights), scaled to sum 1; the largest logarithm is taken out first, so that nothing
/// overflows and something remains. The logarithms must hold a finite one and no NaN.
[[nodiscard]] std::vector<double> normalised_weights(std::span<const double> log_weights);

}  // namespace mapscore
