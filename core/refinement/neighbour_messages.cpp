// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/refinement/neighbour_messages.hpp"

#include "core/error.hpp"
#include "core/geometry/voxel.hpp"
#include "core/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace mapscore {
namespace {

constexpr std::int32_t kCellsAReach = 2;
constexpr double kMostCellsAlong = 1 << 20;

float square(float x) {
  return x * x;
}

float per_square(double sigma) {
  return static_cast<float>(1.0 / (sigma * sigma));
}

/// The farthest pair that any kernel in use joins.
double reach_m(const Crf& params) {
  const double smoothness = params.smoothness_weight > 0 ? params.smoothness_sigma_m : 0.0;
  const double appearance = params.appearance_weight > 0 ? params.appearance_sigma_m : 0.0;
  const double sigma = std::max(smoothness, appearance);
  return params.cutoff_sigmas * (sigma > 0 ? sigma : params.smoothness_sigma_m);
}

/// exp(-x / 2) for x in [0, limit], 0 above; from a table, within 2e-6 of the truth.
class TruncatedGaussian {
 public:
  explicit TruncatedGaussian(float limit) : limit_(limit) {
    constexpr std::size_t kSteps = 4096;
    steps_per_unit_ = static_cast<float>(kSteps) / limit;
    table_.resize(kSteps + 2);
    for (std::size_t step = 0; step < table_.size(); ++step)
      table_[step] =
          static_cast<float>(std::exp(-0.5 * limit * static_cast<double>(step) / kSteps));
  }
  [[nodiscard]] float operator()(float squared) const {
    if (squared > limit_) return 0.0f;
    const float place = squared * steps_per_unit_;
    const auto step = static_cast<std::size_t>(place);
    const float rest = place - static_cast<float>(step);
    return table_[step] + rest * (table_[step + 1] - table_[step]);
  }

 private:
  float limit_, steps_per_unit_;
  std::vector<float> table_;
};

/// Holds positions, not pairs: memory grows with the voxels alone.
class NeighbourMessages {
 public:
  NeighbourMessages(const CrfVoxels& voxels, const Crf& params, int jobs)
      : smoothness_weight_(static_cast<float>(params.smoothness_weight)),
        appearance_weight_(static_cast<float>(params.appearance_weight)),
        per_smoothness_m2_(per_square(params.smoothness_sigma_m)),
        per_appearance_m2_(per_square(params.appearance_sigma_m)),
        per_colour2_(per_square(params.appearance_sigma_colour)),
        reach_m_(static_cast<float>(reach_m(params))),
        cell_m_(reach_m(params) / kCellsAReach),
        gaussian_(static_cast<float>(params.cutoff_sigmas * params.cutoff_sigmas)) {
    sort_into_cells(voxels);
    if (params.normalised) normalise(jobs);
  }

  void operator()(const Eigen::MatrixXf& q, Eigen::MatrixXf& messages, int jobs) const {
    const Eigen::Index labels = q.rows();
    Eigen::MatrixXf by_site(labels, q.cols());
    for (std::size_t site = 0; site < sites_.size(); ++site)
      by_site.col(static_cast<Eigen::Index>(site)) = q.col(voxel_of_[site]);
    for_each_in_parallel(cells_.size(), jobs, [&](std::size_t c) {
      for (std::uint32_t i = cells_[c].first; i < cells_[c].last; ++i)
        messages.col(voxel_of_[i]).setZero();
      for_each_pair(cells_[c], [&](std::uint32_t i, std::uint32_t j, const Kernels& k) {
        const float weight = smoothness_weight_ * k.smoothness * sites_[i].smoothness_scale *
                                 sites_[j].smoothness_scale +
                             appearance_weight_ * k.appearance * sites_[i].appearance_scale *
                                 sites_[j].appearance_scale;
        if (weight == 0.0f) return;
        const float* from = by_site.data() + static_cast<Eigen::Index>(j) * labels;
        float* to = messages.data() + static_cast<Eigen::Index>(voxel_of_[i]) * labels;
        for (Eigen::Index label = 0; label < labels; ++label) to[label] += weight * from[label];
      });
    });
  }

 private:
  /// A voxel, by cell and then by index. Positions in metres from the map's first corner.
  struct Site {
    float x, y, z, r, g, b;
    float smoothness_scale = 1.0f, appearance_scale = 1.0f;  ///< 1 / sqrt(n), or 1
  };
  struct Cell {
    std::uint64_t key;
    std::uint32_t first, last;  ///< of the sites, without `last`
  };
  /// Sites that may lie within the cut-off of a cell's: whole cells, in order.
  struct Span {
    std::uint32_t first, last;
  };
  struct Kernels {
    float smoothness, appearance;
  };

  void sort_into_cells(const CrfVoxels& voxels) {
    const std::size_t count = voxels.centres_m.size();
    Eigen::Vector3d low = voxels.centres_m.front(), high = low;
    for (const Eigen::Vector3d& centre : voxels.centres_m) {
      low = low.cwiseMin(centre);
      high = high.cwiseMax(centre);
    }
    if ((high - low).maxCoeff() / cell_m_ > kMostCellsAlong - 2 * kCellsAReach)
      throw Error("crf: sigmas of " + std::to_string(cell_m_) + " m and less in a map of " +
                  std::to_string((high - low).maxCoeff()) + " m; give larger ones");
    std::vector<std::pair<std::uint64_t, std::uint32_t>> order(count);
    for (std::size_t i = 0; i < count; ++i)
      order[i] = {pack(voxel_of(voxels.centres_m[i] - low, cell_m_)),
                  static_cast<std::uint32_t>(i)};
    std::sort(order.begin(), order.end());
    for (const auto& [key, voxel] : order) {
      if (cells_.empty() || cells_.back().key != key) {
        const auto first = static_cast<std::uint32_t>(sites_.size());
        cells_.push_back({key, first, first});
      }
      ++cells_.back().last;
      voxel_of_.push_back(voxel);
      const Eigen::Vector3f p = (voxels.centres_m[voxel] - low).cast<float>();
      const Colour colour = voxels.colours.empty() ? Colour{} : voxels.colours[voxel];
      sites_.push_back({p.x(), p.y(), p.z(), static_cast<float>(colour.r),
                        static_cast<float>(colour.g), static_cast<float>(colour.b)});
    }
  }

  [[nodiscard]] std::vector<Span> spans_about(const Cell& cell) const {
    std::vector<Span> spans;
    const VoxelKey at = unpack(cell.key);
    for (int di = -kCellsAReach; di <= kCellsAReach; ++di) {
      for (int dj = -kCellsAReach; dj <= kCellsAReach; ++dj) {
        const std::uint64_t low = pack({at.i + di, at.j + dj, at.k - kCellsAReach});
        const auto first = std::ranges::lower_bound(cells_, low, {}, &Cell::key);
        const auto last = std::ranges::lower_bound(first, cells_.end(), low + 2 * kCellsAReach + 1,
                                                   {}, &Cell::key);
        if (first != last) spans.push_back({first->first, (last - 1)->last});
      }
    }
    return spans;
  }

  /// Both kernels, without weights and norms.
  [[nodiscard]] Kernels kernels(const Site& a, const Site& b, float squared_m2) const {
    const float colour2 = square(a.r - b.r) + square(a.g - b.g) + square(a.b - b.b);
    return {gaussian_(squared_m2 * per_smoothness_m2_),
            gaussian_(squared_m2 * per_appearance_m2_ + colour2 * per_colour2_)};
  }

  /// Calls `use(i, j, kernels)` for each i of the cell and each j != i within the cut-off, j
  /// ascending for each i.
  template <class Use>
  void for_each_pair(const Cell& cell, const Use& use) const {
    const std::vector<Span> spans = spans_about(cell);
    const float reach2 = square(reach_m_);
    for (std::uint32_t i = cell.first; i < cell.last; ++i) {
      const Site& here = sites_[i];
      for (const Span& span : spans) {
        for (std::uint32_t j = span.first; j < span.last; ++j) {
          const Site& there = sites_[j];
          const float squared =
              square(here.x - there.x) + square(here.y - there.y) + square(here.z - there.z);
          if (squared <= reach2 && i != j) use(i, j, kernels(here, there, squared));
        }
      }
    }
  }

  void normalise(int jobs) {
    for_each_in_parallel(cells_.size(), jobs, [&](std::size_t c) {
      std::vector<Kernels> sums(cells_[c].last - cells_[c].first, {1.0f, 1.0f});  // k_ii = 1
      for_each_pair(cells_[c], [&](std::uint32_t i, std::uint32_t, const Kernels& k) {
        sums[i - cells_[c].first].smoothness += k.smoothness;
        sums[i - cells_[c].first].appearance += k.appearance;
      });
      for (std::uint32_t i = cells_[c].first; i < cells_[c].last; ++i) {
        sites_[i].smoothness_scale = 1.0f / std::sqrt(sums[i - cells_[c].first].smoothness);
        sites_[i].appearance_scale = 1.0f / std::sqrt(sums[i - cells_[c].first].appearance);
      }
    });
  }

  float smoothness_weight_, appearance_weight_;
  float per_smoothness_m2_, per_appearance_m2_, per_colour2_;  ///< 1 / sigma^2
  float reach_m_;
  double cell_m_;
  TruncatedGaussian gaussian_;
  std::vector<Site> sites_;
  std::vector<std::uint32_t> voxel_of_;  ///< by site
  std::vector<Cell> cells_;              ///< ascending by key
};

}  // namespace

Messages neighbour_messages(const CrfVoxels& voxels, const Crf& params, int jobs) {
  return NeighbourMessages(voxels, params, jobs);
}

}  // namespace mapscore
