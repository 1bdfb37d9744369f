// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/refinement/dense_crf.hpp"

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/refinement/neighbour_messages.hpp"
#include "core/refinement/permutohedral_lattice.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

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
  if (voxels.centres_m.size() != count)
    throw Error("crf: " + std::to_string(voxels.centres_m.size()) + " centres for " +
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
  for (std::size_t i = 0; i < voxels.centres_m.size(); ++i) {
    if (!voxels.centres_m[i].allFinite())
      throw Error("crf: voxel " + std::to_string(i) + ": its centre is not finite; leave it out");
    const auto column = voxels.probability.col(static_cast<Eigen::Index>(i));
    if (!(column.minCoeff() >= 0.0f && std::abs(column.sum() - 1.0f) <= 1e-3f))
      throw Error("crf: voxel " + std::to_string(i) +
                  ": its probabilities are no distribution; give numbers >= 0 that add up to 1");
  }
}

/// Beyond it, lattice coordinates come near the ends of an int.
constexpr double kMostSigmas = 1e7;

std::vector<std::array<float, 3>> places(const CrfVoxels& voxels, double sigma_m) {
  Eigen::Vector3d low = voxels.centres_m.front();  // of the map, whatever the order of its voxels
  for (const Eigen::Vector3d& centre : voxels.centres_m) low = low.cwiseMin(centre);
  std::vector<std::array<float, 3>> features;
  for (const Eigen::Vector3d& centre : voxels.centres_m) {
    const Eigen::Vector3d p = (centre - low) / sigma_m;
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

/// Column i becomes exp(unary + messages) / Z_i; returns the largest change. Column by column, so
/// threads do not matter.
float normalised_step(const Eigen::MatrixXf& log_p, const Eigen::MatrixXf& messages,
                      Eigen::MatrixXf& q, int jobs) {
  const auto count = static_cast<std::size_t>(q.cols());
  const std::size_t runs = (count + kVoxelsARun - 1) / kVoxelsARun;
  std::vector<float> change(runs, 0.0f);
  for_each_in_parallel(runs, jobs, [&](std::size_t run) {
    const std::size_t last = std::min(count, (run + 1) * kVoxelsARun);
    Eigen::VectorXf next(q.rows());
    for (std::size_t voxel = run * kVoxelsARun; voxel < last; ++voxel) {
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

CrfResult mean_field(const Eigen::MatrixXf& log_p, const Messages& send, const Crf& params,
                     int jobs) {
  CrfResult result;
  Eigen::MatrixXf messages = Eigen::MatrixXf::Zero(log_p.rows(), log_p.cols());
  result.probability = messages;
  normalised_step(log_p, messages, result.probability, jobs);
  while (result.iterations < params.iterations) {
    send(result.probability, messages, jobs);
    result.last_change = normalised_step(log_p, messages, result.probability, jobs);
    ++result.iterations;
    if (result.last_change <= params.tolerance) break;
  }
  return result;
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
  if (voxels.centres_m.empty()) return {voxels.probability, 0, 0.0};
  const Eigen::MatrixXf log_p =
      voxels.probability.cwiseMax(static_cast<float>(params.probability_floor)).array().log();
  const Messages messages = params.filter == CrfFilter::lattice
                                ? LatticeMessages(voxels, params, jobs)
                                : neighbour_messages(voxels, params, jobs);
  return mean_field(log_p, messages, params, jobs);
}

}  // namespace mapscore
