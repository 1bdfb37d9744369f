// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/localization/scan_parameters.hpp"

#include "core/error.hpp"

#include <cmath>
#include <initializer_list>
#include <string>

namespace mapscore {
namespace {

void check_positive(double value, const char* name) {
  if (!(std::isfinite(value) && value > 0))
    throw Error(std::string(name) + ": is " + std::to_string(value) + "; give a number above 0");
}

void check_beams(std::size_t beams) {
  if (beams < 1) throw Error("beams: is 0; use at least one beam of a scan");
}

/// z_rand must be positive: without it one beam that fits nowhere ends every particle.
void check_shares(std::initializer_list<double> shares, double z_rand) {
  double sum = 0.0;
  for (const double share : shares) {
    if (!(share >= 0 && share <= 1)) throw Error("z_*: the shares of a scan model lie in 0 to 1");
    sum += share;
  }
  if (std::abs(sum - 1.0) > 1e-6)
    throw Error("z_*: the shares of a scan model add up to " + std::to_string(sum) +
                "; make them 1");
  if (z_rand <= 0) throw Error("z_rand: is 0; give a share above 0, some beams fit nothing");
}

}  // namespace

void check_parameters(const LikelihoodFieldParams& params, double range_max_m) {
  check_beams(params.beams);
  check_positive(params.sigma_hit_m, "sigma_hit_m");
  check_positive(params.temper, "temper");
  check_positive(range_max_m, "range_max_m");
  check_shares({params.z_hit, params.z_rand}, params.z_rand);
}

void check_parameters(const BeamModelParams& params, double range_max_m) {
  check_beams(params.beams);
  check_positive(params.sigma_hit_m, "sigma_hit_m");
  check_positive(params.lambda_short_per_m, "lambda_short_per_m");
  check_positive(params.temper, "temper");
  check_positive(range_max_m, "range_max_m");
  check_shares({params.z_hit, params.z_short, params.z_max, params.z_rand}, params.z_rand);
  if (params.z_max <= 0)
    throw Error("z_max: is 0; give a share above 0, some beams return nothing");
}

}  // namespace mapscore
