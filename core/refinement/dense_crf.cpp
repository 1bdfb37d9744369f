// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/refinement/dense_crf.hpp"

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/refinement/neighbour_messages.hpp"
#include "core/refinement/permutohedral_lattice.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mapscore {
namespace {

constexpr std::size_t kVoxelsARun = 4096;

void check_in(double value, double least, double most, const char* name) {
  if (!(value >= least && value <= most))
    throw Error(std::string("crf: ") + name + ": is " + std::to_string(value) +
                "; give a number from " + std::to_string(least) + " to " + std::to_string(most));
}

void check_sizes(const CrfVoxels& voxels, const Crf& params) {
  const auto count = static_cast<std::size_t>(voxels.probability.cols());
  if (voxels.keys.size() != count)
    throw Error("crf: " + std::to_string(voxels.keys.size()) + " keys for " +
                std::to_string(count) + " distributions; give one each a voxel");
  const bool colours_needed = params.appearance_weight > 0 || !voxels.colours.empty();
  if (colours_needed && voxels.colours.size() != count)
    throw Error("crf: " + std::to_string(voxels.colours.size()) + " colours for " +
                std::to_string(count) +
                " voxels; give one each a voxel, or appearance_weight 0 and none");
  if (count > 0 && voxels.probability.rows() == 0)
    throw Error("crf: voxels without labels; give at least one label");
}

void check_values(const CrfVoxels& voxels) {
  if (!voxels.keys.empty()) check_in(voxels.voxel_m, 1e-6, 1000, "voxel_m");
  for (Eigen::Index i = 0; i < voxels.probability.cols(); ++i) {
    const auto column = voxels.probability.col(i);
    if (!(column.minCoeff() >= 0.0f && std::abs(column.sum() - 1.0f) <= 1e-3f))
      throw Error("crf: voxel " + std::to_string(i) +
                  ": its probabilities are no distribution; give numbers >= 0 that add up to 1");
  }
}

constexpr std::int64_t kMostVoxelsAlong = 1 << 20;

/// The keys from the map's first corner, so that where the map lies does not matter.
std::vector<VoxelKey> from_corner(const std::vector<VoxelKey>& keys) {
  VoxelKey low = keys.front(), high = low;
  for (const VoxelKey& key : keys) {
    low = {std::min(low.i, key.i), std::min(low.j, key.j), std::min(low.k, key.k)};
    high = {std::max(high.i, key.i), std::max(high.j, key.j), std::max(high.k, key.k)};
  }
  for (const auto axis : {&VoxelKey::i, &VoxelKey::j, &VoxelKey::k})
    if (std::int64_t{high.*axis} - low.*axis >= kMostVoxelsAlong)
      throw Error("crf: a map " + std::to_string(std::int64_t{high.*axis} - low.*axis + 1) +
                  " voxels wide; give at most " + std::to_string(kMostVoxelsAlong));
  std::vector<VoxelKey> from_low;
  from_low.reserve(keys.size());
  for (const VoxelKey& key : keys)
    from_low.push_back({key.i - low.i, key.j - low.j, key.k - low.k});
  return from_low;
}

/// Beyond it, lattice coordinates come near the ends of an int.
constexpr double kMostSigmas = 1e7;

std::vector<std::array<float, 3>> places(const CrfVoxels& voxels, double sigma_m) {
  const double sigmas_a_voxel = voxels.voxel_m / sigma_m;
  std::vector<std::array<float, 3>> features;
  for (const VoxelKey& key : voxels.keys) {
    const Eigen::Vector3d p = Eigen::Vector3d(key.i, key.j, key.k) * sigmas_a_voxel;
    if (p.maxCoeff() > kMostSigmas)
      throw Error("crf: a sigma of " + std::to_string(sigma_m) + " m in a map more than " +
                  std::to_string(kMostSigmas * sigma_m) + " m wide; give a larger one");
    features.push_back(
        {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())});
  }
  return features;
}

std::vector<std::array<float, 6>> appearances(const CrfVoxels& voxels, const Crf& params) {
  const auto sigma = static_cast<float>(params.appearance_sigma_colour);
  std::vector<std::array<float, 6>> features;
  for (const std::array<float, 3>& p : places(voxels, params.appearance_sigma_m)) {
    const Colour& colour = voxels.colours[features.size()];
    features.push_back({p[0], p[1], p[2], static_cast<float>(colour.r) / sigma,
                        static_cast<float>(colour.g) / sigma,
                        static_cast<float>(colour.b) / sigma});
  }
  return features;
}

/// The CRF's messages by permutohedral lattices, one a kernel, without a cut-off and approximately.
class LatticeMessages {
 public:
  LatticeMessages(const CrfVoxels& voxels, const Crf& params, int jobs) {
    if (params.smoothness_weight > 0)
      smoothness_ = kernel<3>(places(voxels, params.smoothness_sigma_m), params.smoothness_weight,
                              params.normalised, jobs);
    if (params.appearance_weight > 0)
      appearance_ =
          kernel<6>(appearances(voxels, params), params.appearance_weight, params.normalised, jobs);
  }

  void operator()(const Eigen::MatrixXf& q, Eigen::MatrixXf& messages, int jobs) const {
    messages.setZero();
    add(smoothness_, q, messages, jobs);
    add(appearance_, q, messages, jobs);
  }

 private:
  /// One kernel with its weight: sqrt(w / n_i), and what of a filtered value is the voxel's own.
  template <int D>
  struct Kernel {
    PermutohedralLattice<D> lattice;
    Eigen::VectorXf scale, own;
  };

  template <int D>
  static Kernel<D> kernel(const std::vector<std::array<float, D>>& features, double weight,
                          bool normalised, int jobs) {
    Kernel<D> made{PermutohedralLattice<D>(features), {}, {}};
    const auto count = static_cast<Eigen::Index>(features.size());
    const auto w = static_cast<float>(weight);
    made.scale = Eigen::VectorXf::Constant(count, std::sqrt(w));
    if (normalised) {
      const Eigen::MatrixXf n = made.lattice.filtered(Eigen::MatrixXf::Ones(1, count), jobs);
      made.scale = (w / n.row(0).transpose().array()).sqrt();
    }
    made.own.resize(count);
    for (Eigen::Index i = 0; i < count; ++i)
      made.own[i] = made.lattice.own_kernel(static_cast<std::size_t>(i)) * made.scale[i];
    return made;
  }

  template <int D>
  static void add(const std::optional<Kernel<D>>& kernel, const Eigen::MatrixXf& q,
                  Eigen::MatrixXf& messages, int jobs) {
    if (!kernel) return;
    const Eigen::MatrixXf filtered = kernel->lattice.filtered(q * kernel->scale.asDiagonal(), jobs);
    messages += filtered * kernel->scale.asDiagonal();
    messages -= q * kernel->scale.cwiseProduct(kernel->own).asDiagonal();
  }

  std::optional<Kernel<3>> smoothness_;
  std::optional<Kernel<6>> appearance_;
};

/// Column i becomes exp(unary + messages) / Z_i, unless its voxel is alone; returns the largest
/// change. Column by column, so threads do not matter.
float normalised_step(const Eigen::MatrixXf& log_p, const Eigen::MatrixXf& messages,
                      const std::vector<bool>& alone, Eigen::MatrixXf& q, int jobs) {
  const auto count = static_cast<std::size_t>(q.cols());
  const std::size_t runs = (count + kVoxelsARun - 1) / kVoxelsARun;
  std::vector<float> change(runs, 0.0f);
  for_each_in_parallel(runs, jobs, [&](std::size_t run) {
    const std::size_t last = std::min(count, (run + 1) * kVoxelsARun);
    Eigen::VectorXf next(q.rows());
    for (std::size_t voxel = run * kVoxelsARun; voxel < last; ++voxel) {
      if (alone[voxel]) continue;
      const auto i = static_cast<Eigen::Index>(voxel);
      next = log_p.col(i) + messages.col(i);
      const float most = next.maxCoeff();
      for (float& value : next) value = std::exp(value - most);
      next /= next.sum();
      change[run] = std::max(change[run], (next - q.col(i)).cwiseAbs().maxCoeff());
      q.col(i) = next;
    }
  });
  return *std::max_element(change.begin(), change.end());
}

/// Changes the columns of the voxels that are not alone.
void mean_field(const Messages& send, const Crf& params, int jobs, CrfResult& result) {
  Eigen::MatrixXf& q = result.probability;
  const Eigen::MatrixXf log_p =
      q.cwiseMax(static_cast<float>(params.probability_floor)).array().log();
  Eigen::MatrixXf messages = Eigen::MatrixXf::Zero(q.rows(), q.cols());
  normalised_step(log_p, messages, result.alone, q, jobs);
  while (result.iterations < params.iterations) {
    send(q, messages, jobs);
    result.last_change = normalised_step(log_p, messages, result.alone, q, jobs);
    ++result.iterations;
    if (result.last_change <= params.tolerance) break;
  }
}

}  // namespace

void check_parameters(const Crf& params) {
  check_ranges(params);
  constexpr double kLeastSigma_m = 1e-4,
                   kLeastSigmaOfColour = 0.1;  // the lattices' keys are 32 bits
  check_in(params.smoothness_sigma_m, kLeastSigma_m, 10, "smoothness_sigma_m");
  check_in(params.appearance_sigma_m, kLeastSigma_m, 10, "appearance_sigma_m");
  check_in(params.appearance_sigma_colour, kLeastSigmaOfColour, 1000, "appearance_sigma_colour");
  check_in(params.tolerance, 0, 1, "tolerance");
  check_in(params.probability_floor, 1e-9, 0.5, "probability_floor");
  check_in(params.cutoff_sigmas, 0.5, 6, "cutoff_sigmas");
}

CrfResult refine(const CrfVoxels& voxels, const Crf& params, int jobs) {
  check_parameters(params);
  check_sizes(voxels, params);
  check_values(voxels);
  CrfResult result{voxels.probability, std::vector<bool>(voxels.keys.size(), true)};
  if (voxels.keys.empty() || (params.smoothness_weight == 0 && params.appearance_weight == 0))
    return result;
  const CrfVoxels placed{from_corner(voxels.keys), voxels.voxel_m, voxels.colours, {}};
  Messages send;
  if (params.filter == CrfFilter::lattice) {
    result.alone.assign(voxels.keys.size(), false);
    send = LatticeMessages(placed, params, jobs);
  } else {
    NeighbourMessages neighbours = neighbour_messages(placed, params, jobs);
    result.alone = std::move(neighbours.alone);
    send = std::move(neighbours.send);
  }
  if (std::ranges::find(result.alone, false) != result.alone.end())
    mean_field(send, params, jobs, result);
  return result;
}

}  // namespace mapscore
