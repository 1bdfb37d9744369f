// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/geometry/voxel.hpp"
#include "core/parameters.hpp"

#include <Eigen/Core>
#include <array>
#include <string_view>
#include <vector>

namespace mapscore {

/// How the sums over all other voxels are made.
enum class CrfFilter {
  neighbours,  ///< every pair within the cut-off, each with its exact kernel
  lattice,     ///< permutohedral lattice of [Adams et al. 2010]: all pairs, approximately
};

/// What a voxel's beliefs leave over for classes that it does not name (1 - their sum).
enum class CrfRest {
  apart,  ///< stays as much in each voxel; the CRF shares out only what is named
  label,  ///< a label like any class: `unknown` spreads and is outvoted too
};

constexpr auto names_of(CrfFilter) {
  return std::to_array<std::string_view>({"neighbours", "lattice"});
}
constexpr auto names_of(CrfRest) {
  return std::to_array<std::string_view>({"apart", "label"});
}

/// Fully connected CRF of [Krähenbühl and Koltun 2011] with the Potts model over a map's voxels,
/// docs/refinement.md. Each weight is what unanimous neighbours add to the log-odds of their class
/// when kernels are `normalised`.
struct Crf {
  static constexpr std::string_view kKind = "crf";
  static constexpr std::string_view kMeaning =
      "a fully connected conditional random field over the map's voxels (docs/refinement.md)";
  double smoothness_weight = 3, smoothness_sigma_m = 0.06;
  double appearance_weight = 3, appearance_sigma_m = 0.12, appearance_sigma_colour = 20;
  bool normalised = true;   ///< k_ij / sqrt(n_i n_j), n_i = sum_j k_ij; false: k_ij as it is
  int iterations = 10;      ///< at most
  double tolerance = 1e-4;  ///< ends when no probability changed by more; 0: all iterations
  double probability_floor = 1e-3;  ///< least p of the unary -log p, in (0, 1)
  CrfRest rest = CrfRest::apart;    ///< of a map's beliefs (refine_beliefs)
  CrfFilter filter = CrfFilter::neighbours;
  double cutoff_sigmas = 3.0;  ///< neighbours only: a kernel's last Mahalanobis distance

  [[nodiscard]] bool reads_colour() const { return appearance_weight > 0.0; }

  static void fields(auto& s, auto&& visit) {
    visit(s.smoothness_weight,
          Field{"smoothness_weight", "of the position kernel; 0: off", {0, 1000}});
    visit(s.smoothness_sigma_m,
          Field{"smoothness_sigma_m", "reach of the position kernel", above(0, 10)});
    visit(s.appearance_weight,
          Field{"appearance_weight", "of the kernel of position and colour; 0: off", {0, 1000}});
    visit(s.appearance_sigma_m,
          Field{"appearance_sigma_m", "reach in space of the kernel with colour", above(0, 10)});
    visit(s.appearance_sigma_colour,
          Field{"appearance_sigma_colour", "reach in colour, levels of 0 to 255", above(0, 1000)});
    visit(s.iterations, Field{"iterations", "of the mean field, at most", {1, 1000}});
    visit(s.rest, Field{"rest", "what no class claims stays apart, or is a label like any class"});
    visit(s.filter, Field{"filter", "exact kernels to nearby voxels, or a permutohedral lattice"});
  }
  bool operator==(const Crf&) const = default;
};

/// What the CRF looks at: one entry, or one column, a voxel, all in the same order.
struct CrfVoxels {
  std::vector<VoxelKey> keys;   ///< any lattice: only their differences count
  double voxel_m = 0.0;         ///< edge of a voxel
  std::vector<Colour> colours;  ///< mean colours; empty where appearance_weight is 0
  Eigen::MatrixXf probability;  ///< labels x voxels; columns add up to 1 within 1e-3
};

struct CrfResult {
  Eigen::MatrixXf probability;  ///< labels x voxels, columns add up to 1
  /// By voxel: no other within any kernel's reach, so that its column is the input's, bit for bit.
  std::vector<bool> alone;
  int iterations = 0;        ///< made
  double last_change = 0.0;  ///< largest |change| of a probability in the last of them
};

/// Mean-field inference of [Krähenbühl and Koltun 2011, algorithm 1], all voxels at once, from
/// Q_i(l) ~ max(p_i(l), floor):
///   Q_i(l) <- exp(log max(p_i(l), floor) + sum_m w_m sum_{j != i} k_m(i, j) Q_j(l)) / Z_i
/// A voxel that is alone takes no part and keeps its column; without a kernel all are. Uses up to
/// `jobs` threads; the result does not depend on how many. No voxels: an empty result. Throws Error
/// on sizes that differ, parameters or voxel_m out of range, keys more than 2^20 apart on an axis,
/// columns that are no distribution.
[[nodiscard]] CrfResult refine(const CrfVoxels& voxels, const Crf& params, int jobs = 1);

/// Throws Error naming the parameter that is out of range.
void check_parameters(const Crf& params);

}  // namespace mapscore
