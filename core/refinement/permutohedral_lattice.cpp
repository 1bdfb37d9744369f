// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/refinement/permutohedral_lattice.hpp"

#include "core/geometry/voxel.hpp"
#include "core/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace mapscore {
namespace {

constexpr std::size_t kColumnsARun = 1024;

template <std::size_t D>
struct VertexHash {
  std::size_t operator()(const std::array<std::int32_t, D>& vertex) const {
    std::uint64_t hash = 0;
    for (const std::int32_t c : vertex) hash = mix_bits(hash + static_cast<std::uint32_t>(c));
    return hash;
  }
};

/// Calls `work(column)` for all columns, in runs from up to `jobs` threads.
template <class Work>
void for_each_column(std::size_t columns, int jobs, const Work& work) {
  for_each_in_parallel((columns + kColumnsARun - 1) / kColumnsARun, jobs, [&](std::size_t run) {
    const std::size_t last = std::min(columns, (run + 1) * kColumnsARun);
    for (std::size_t column = run * kColumnsARun; column < last; ++column)
      work(static_cast<Eigen::Index>(column));
  });
}

/// The feature in the hyperplane of D + 1 coordinates that add up to 0, scaled so that spreading,
/// blurring and gathering together have unit variance along each axis [section 3.1].
template <std::size_t D>
std::array<double, D + 1> elevated(const std::array<float, D>& feature) {
  std::array<double, D + 1> y;
  double sum = 0.0;
  for (int axis = D; axis > 0; --axis) {
    const double scale = std::sqrt(2.0 / 3.0) * (D + 1) / std::sqrt(axis * (axis + 1.0));
    const double x = feature[static_cast<std::size_t>(axis - 1)] * scale;
    y[static_cast<std::size_t>(axis)] = sum - axis * x;
    sum += x;
  }
  y[0] = sum;
  return y;
}

}  // namespace

template <int D>
typename PermutohedralLattice<D>::Simplex PermutohedralLattice<D>::simplex_about(
    const Feature& feature) {
  const std::array<double, kCorners> y = elevated<D>(feature);
  std::array<int, kCorners> nearest, rank;  // of the point of remainder 0; of y - nearest, falling
  int excess = 0;
  for (int a = 0; a < kCorners; ++a) {
    const int multiple = static_cast<int>(std::lround(y[a] / kCorners));
    nearest[a] = multiple * kCorners;
    excess += multiple;
  }
  for (int a = 0; a < kCorners; ++a) {
    rank[a] = excess;
    for (int b = 0; b < kCorners; ++b) {
      const double of_a = y[a] - nearest[a], of_b = y[b] - nearest[b];
      if (of_b > of_a || (of_b == of_a && b < a)) ++rank[a];
    }
  }
  Simplex simplex;
  std::array<double, kCorners + 1> share{};
  for (int a = 0; a < kCorners; ++a) {
    const int turns = rank[a] < 0 ? 1 : rank[a] > D ? -1 : 0;  // back to a sum of 0
    nearest[a] += turns * kCorners;
    rank[a] += turns * kCorners;
    const double part = (y[a] - nearest[a]) / kCorners;
    share[D - rank[a]] += part;
    share[kCorners - rank[a]] -= part;
  }
  share[0] += 1.0 + share[kCorners];
  for (int remainder = 0; remainder < kCorners; ++remainder) {
    simplex.shares[remainder] = static_cast<float>(share[remainder]);
    for (int a = 0; a < D; ++a)
      simplex.corners[remainder][a] =
          nearest[a] + remainder - (rank[a] > D - remainder ? kCorners : 0);
  }
  return simplex;
}

template <int D>
PermutohedralLattice<D>::PermutohedralLattice(const std::vector<Feature>& features) {
  std::unordered_map<Vertex, std::uint32_t, VertexHash<D>> index;
  std::vector<Vertex> vertices;
  corners_.resize(features.size());
  for (std::size_t i = 0; i < features.size(); ++i) {
    const Simplex simplex = simplex_about(features[i]);
    for (int corner = 0; corner < kCorners; ++corner) {
      const auto [entry, is_new] =
          index.try_emplace(simplex.corners[corner], static_cast<std::uint32_t>(vertices.size()));
      if (is_new) vertices.push_back(simplex.corners[corner]);
      corners_[i][corner] = {entry->second, simplex.shares[corner]};
    }
  }
  vertices_ = vertices.size();
  const auto at = [&](const Vertex& vertex) {
    const auto found = index.find(vertex);
    return found == index.end() ? kNone : found->second;
  };
  for (int direction = 0; direction < kCorners; ++direction) {
    for (const Vertex& vertex : vertices) {
      Vertex before = vertex, after = vertex;
      for (int a = 0; a < D; ++a) {
        before[a] -= a == direction ? -D : 1;
        after[a] += a == direction ? -D : 1;
      }
      sides_[direction].push_back({at(before), at(after)});
    }
  }
  index_spread();
}

template <int D>
void PermutohedralLattice<D>::index_spread() {
  first_of_.assign(vertices_ + 1, 0);
  for (const auto& corners : corners_)
    for (const Corner& corner : corners) ++first_of_[corner.vertex + 1];
  for (std::size_t v = 0; v < vertices_; ++v) first_of_[v + 1] += first_of_[v];
  std::vector<std::uint32_t> next(first_of_.begin(), first_of_.end() - 1);
  spread_.resize(first_of_.back());
  for (std::size_t i = 0; i < corners_.size(); ++i)
    for (const Corner& corner : corners_[i])
      spread_[next[corner.vertex]++] = {static_cast<std::uint32_t>(i), corner.share};
}

template <int D>
Eigen::MatrixXf PermutohedralLattice<D>::spread(const Eigen::MatrixXf& values, int jobs) const {
  Eigen::MatrixXf at_vertex =
      Eigen::MatrixXf::Zero(values.rows(), static_cast<Eigen::Index>(vertices_));
  for_each_column(vertices_, jobs, [&](Eigen::Index v) {
    for (std::uint32_t e = first_of_[v]; e < first_of_[v + 1]; ++e)
      at_vertex.col(v) += spread_[e].share * values.col(spread_[e].vertex);
  });
  return at_vertex;
}

template <int D>
Eigen::MatrixXf PermutohedralLattice<D>::filtered(const Eigen::MatrixXf& values, int jobs) const {
  Eigen::MatrixXf at_vertex = spread(values, jobs), blurred = at_vertex;
  for (const std::vector<Sides>& sides : sides_) {
    for_each_column(vertices_, jobs, [&](Eigen::Index v) {
      blurred.col(v) = at_vertex.col(v);
      if (sides[v].before != kNone) blurred.col(v) += 0.5f * at_vertex.col(sides[v].before);
      if (sides[v].after != kNone) blurred.col(v) += 0.5f * at_vertex.col(sides[v].after);
    });
    std::swap(at_vertex, blurred);
  }
  const float peak = 1.0f + std::ldexp(1.0f, -D);  // of a feature that lies on a vertex
  Eigen::MatrixXf out = Eigen::MatrixXf::Zero(values.rows(), values.cols());
  for_each_column(corners_.size(), jobs, [&](Eigen::Index i) {
    for (const Corner& corner : corners_[static_cast<std::size_t>(i)])
      out.col(i) += corner.share / peak * at_vertex.col(corner.vertex);
  });
  return out;
}

template <int D>
float PermutohedralLattice<D>::own_kernel(std::size_t feature) const {
  // Corners r remainders apart: one step along r directions, or one back along the others.
  const auto& corners = corners_[feature];
  float sum = 0.0f;
  for (int a = 0; a < kCorners; ++a) {
    for (int b = 0; b < kCorners; ++b) {
      const int apart = std::abs(a - b);
      const float blur = apart == 0 ? 1.0f + std::ldexp(1.0f, -D)
                                    : std::ldexp(1.0f, -apart) + std::ldexp(1.0f, apart - kCorners);
      sum += corners[a].share * corners[b].share * blur;
    }
  }
  return sum / (1.0f + std::ldexp(1.0f, -D));
}

template class PermutohedralLattice<3>;
template class PermutohedralLattice<6>;

}  // namespace mapscore
