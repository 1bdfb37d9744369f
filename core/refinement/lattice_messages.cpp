// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/refinement/lattice_messages.hpp"

#include "core/error.hpp"

#include <string>

namespace mapscore {
namespace {

/// Beyond it, lattice coordinates come near the ends of an int.
constexpr double kMostSigmas = 1e7;

/// Low corner of the map, whatever the order of its voxels.
Eigen::Vector3d low_corner(const CrfVoxels& voxels) {
  Eigen::Vector3d low = voxels.centres_m.front();
  for (const Eigen::Vector3d& centre : voxels.centres_m) low = low.cwiseMin(centre);
  return low;
}

std::vector<std::array<float, 3>> places(const CrfVoxels& voxels, double sigma_m) {
  const Eigen::Vector3d low = low_corner(voxels);
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

}  // namespace

template <int D>
LatticeMessages::Kernel<D> LatticeMessages::kernel(
    const std::vector<std::array<float, D>>& features, double weight, bool normalised, int jobs) {
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
void LatticeMessages::add(const std::optional<Kernel<D>>& kernel, const Eigen::MatrixXf& q,
                          Eigen::MatrixXf& messages, int jobs) {
  if (!kernel) return;
  const Eigen::MatrixXf filtered = kernel->lattice.filtered(q * kernel->scale.asDiagonal(), jobs);
  messages += filtered * kernel->scale.asDiagonal();
  messages -= q * kernel->scale.cwiseProduct(kernel->own).asDiagonal();
}

LatticeMessages::LatticeMessages(const CrfVoxels& voxels, const Crf& params, int jobs) {
  if (params.smoothness_weight > 0)
    smoothness_ = kernel<3>(places(voxels, params.smoothness_sigma_m), params.smoothness_weight,
                            params.normalised, jobs);
  if (params.appearance_weight > 0)
    appearance_ =
        kernel<6>(appearances(voxels, params), params.appearance_weight, params.normalised, jobs);
}

void LatticeMessages::send(const Eigen::MatrixXf& q, Eigen::MatrixXf& messages, int jobs) const {
  messages.setZero();
  add(smoothness_, q, messages, jobs);
  add(appearance_, q, messages, jobs);
}

}  // namespace mapscore
