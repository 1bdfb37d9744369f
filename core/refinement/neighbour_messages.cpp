// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/refinement/neighbour_messages.hpp"

#include "core/geometry/voxel.hpp"
#include "core/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

namespace mapscore {
namespace {

/// Sites that a thread takes at once, at least; whole columns.
constexpr std::uint32_t kSitesARun = 256;
constexpr std::int64_t kMostColour2 = 3 * 255 * 255;
constexpr std::int64_t kMostDistance2 = std::int64_t{3} << 40;  ///< of a map's voxels
constexpr double kTieTolerance = 1e-9;

std::int64_t square_of(std::int64_t n) {
  return n * n;
}

/// One term of a Mahalanobis sum, `per_unit` n with a whole number n, and exp(-per_unit n / 2), by
/// a table where n is small.
class GaussianTerm {
 public:
  GaussianTerm(double per_unit, double limit, std::int64_t most)
      : per_unit_(per_unit),
        last_(static_cast<std::int64_t>(
            std::clamp(std::floor(limit / per_unit) + 1, -1.0, static_cast<double>(most)))) {
    while (last_ >= 0 && !(squared(last_) <= limit)) --last_;
    table_.resize(static_cast<std::size_t>(std::min(last_, kMostColour2) + 1));
    for (std::size_t n = 0; n < table_.size(); ++n) table_[n] = computed(static_cast<double>(n));
  }

  /// The largest n within the limit, `most` at most; -1: none.
  [[nodiscard]] std::int64_t last() const { return last_; }
  [[nodiscard]] double squared(std::int64_t n) const { return static_cast<double>(n) * per_unit_; }
  /// For n in 0 .. last().
  [[nodiscard]] double operator()(std::int64_t n) const {
    const auto at = static_cast<std::size_t>(n);
    return at < table_.size() ? table_[at] : computed(static_cast<double>(n));
  }

 private:
  [[nodiscard]] double computed(double n) const { return std::exp(-0.5 * (n * per_unit_)); }

  double per_unit_;
  std::int64_t last_;
  std::vector<double> table_;
};

/// Both kernels of a pair, without weights and norms; 0 beyond the cut-off.
struct Kernels {
  float smoothness, appearance;
};

/// The kernels by whole numbers: squared distances in voxels and in levels. One that is off reaches
/// nothing.
class PairKernels {
 public:
  PairKernels(double voxel_m, const Crf& params)
      : limit_(params.cutoff_sigmas * params.cutoff_sigmas * (1.0 + kTieTolerance)),
        smoothness_(square(voxel_m / params.smoothness_sigma_m),
                    params.smoothness_weight > 0 ? limit_ : -1.0, kMostDistance2),
        appearance_(square(voxel_m / params.appearance_sigma_m),
                    params.appearance_weight > 0 ? limit_ : -1.0, kMostDistance2),
        colour_(1.0 / square(params.appearance_sigma_colour), limit_, kMostColour2) {}

  /// The largest squared distance at which some kernel is not 0.
  [[nodiscard]] std::int64_t reach2() const {
    return std::max(smoothness_.last(), appearance_.last());
  }
  [[nodiscard]] Kernels operator()(std::int64_t distance2, std::int64_t colour2) const {
    Kernels kernels{0.0f, 0.0f};
    if (distance2 <= smoothness_.last())
      kernels.smoothness = static_cast<float>(smoothness_(distance2));
    if (distance2 <= appearance_.last() && colour2 <= colour_.last() &&
        appearance_.squared(distance2) + colour_.squared(colour2) <= limit_)
      kernels.appearance = static_cast<float>(appearance_(distance2) * colour_(colour2));
    return kernels;
  }

 private:
  static double square(double x) { return x * x; }

  double limit_;
  GaussianTerm smoothness_, appearance_, colour_;
};

/// Holds voxels, not pairs: memory grows with the voxels alone. Voxels stand in columns along k,
/// ascending by (i, j, k), and so do the neighbours of each, whatever else is in the map.
class NeighbourSearch {
 public:
  NeighbourSearch(const CrfVoxels& voxels, const Crf& params, int jobs)
      : smoothness_weight_(static_cast<float>(params.smoothness_weight)),
        appearance_weight_(static_cast<float>(params.appearance_weight)),
        kernels_(voxels.voxel_m, params),
        alone_(voxels.keys.size(), true) {
    sort_into_columns(voxels);
    std::vector<char> has_neighbour = sum_kernels(params.normalised, jobs);
    for (std::size_t site = 0; site < sites_.size(); ++site)
      alone_[voxel_of_[site]] = has_neighbour[site] == 0;
  }

  [[nodiscard]] const std::vector<bool>& alone() const { return alone_; }

  void operator()(const Eigen::MatrixXf& q, Eigen::MatrixXf& messages, int jobs) const {
    const Eigen::Index labels = q.rows();
    Eigen::MatrixXf by_site(labels, q.cols());
    for (std::size_t site = 0; site < sites_.size(); ++site)
      by_site.col(static_cast<Eigen::Index>(site)) = q.col(voxel_of_[site]);
    messages.setZero();
    for_each_pair(jobs, [&](std::uint32_t i, std::uint32_t j, const Kernels& k) {
      const float weight = smoothness_weight_ * k.smoothness * sites_[i].smoothness_scale *
                               sites_[j].smoothness_scale +
                           appearance_weight_ * k.appearance * sites_[i].appearance_scale *
                               sites_[j].appearance_scale;
      const float* from = by_site.data() + static_cast<Eigen::Index>(j) * labels;
      float* to = messages.data() + static_cast<Eigen::Index>(voxel_of_[i]) * labels;
      for (Eigen::Index label = 0; label < labels; ++label) to[label] += weight * from[label];
    });
  }

 private:
  /// A voxel, by key and then by index.
  struct Site {
    std::int32_t k, r, g, b;
    float smoothness_scale = 1.0f, appearance_scale = 1.0f;  ///< 1 / sqrt(n), or 1
  };
  /// The sites of one i and j. `place` orders columns by them.
  struct Column {
    std::int64_t place;
    std::uint32_t first, last;  ///< of the sites, without `last`
  };
  static constexpr std::int64_t kPlacesARow = std::int64_t{1} << 32;
  struct Run {
    std::uint32_t first, last;  ///< of the columns, without `last`
  };
  /// A column within reach of the one that is looked at.
  struct NearColumn {
    std::uint32_t from, last;  ///< of its sites: all before `from` are too low
    std::int64_t room2;        ///< what is left of the reach along k
    std::int64_t distance2;    ///< of the columns
  };
  /// Columns of one i, at di from the column that is looked at.
  struct NearRow {
    std::int64_t di2, dj, offset;  ///< |dj| at most; place of the first, from the column's own
    std::uint32_t from;            ///< all columns before it come before the first
  };

  void sort_into_columns(const CrfVoxels& voxels) {
    voxel_of_.resize(voxels.keys.size());
    std::iota(voxel_of_.begin(), voxel_of_.end(), 0u);
    std::ranges::sort(voxel_of_, [&](std::uint32_t a, std::uint32_t b) {
      return std::pair(voxels.keys[a], a) < std::pair(voxels.keys[b], b);
    });
    for (const std::uint32_t voxel : voxel_of_) {
      const VoxelKey& key = voxels.keys[voxel];
      extent_ = std::max<std::int64_t>({extent_, key.i, key.j});
      const std::int64_t place = key.i * kPlacesARow + key.j;
      const auto site = static_cast<std::uint32_t>(sites_.size());
      if (columns_.empty() || columns_.back().place != place) {
        if (runs_.empty() || site - columns_[runs_.back().first].first >= kSitesARun)
          runs_.push_back({static_cast<std::uint32_t>(columns_.size()), 0});
        columns_.push_back({place, site, site});
      }
      columns_.back().last = site + 1;
      runs_.back().last = static_cast<std::uint32_t>(columns_.size());
      const Colour colour = voxels.colours.empty() ? Colour{} : voxels.colours[voxel];
      sites_.push_back({key.k, colour.r, colour.g, colour.b});
    }
  }

  /// The rows within reach, for a run's first column.
  [[nodiscard]] std::vector<NearRow> rows_about(const Column& column) const {
    // Squares are far below 2^52, where the root of a whole number rounds down rightly.
    const auto root = [](std::int64_t square) {
      return static_cast<std::int64_t>(std::sqrt(static_cast<double>(square)));
    };
    const std::int64_t reach = std::min(root(kernels_.reach2()), extent_);
    std::vector<NearRow> rows;
    for (std::int64_t di = -reach; di <= reach; ++di) {
      const std::int64_t dj = std::min(root(kernels_.reach2() - square_of(di)), extent_);
      const std::int64_t offset = di * kPlacesARow - dj;
      const auto first =
          std::ranges::lower_bound(columns_, column.place + offset, {}, &Column::place);
      rows.push_back(
          {square_of(di), dj, offset, static_cast<std::uint32_t>(first - columns_.begin())});
    }
    return rows;
  }

  /// The columns within reach, ascending; moves the rows on to this column.
  void find_near(const Column& column, std::vector<NearRow>& rows,
                 std::vector<NearColumn>& near) const {
    near.clear();
    for (NearRow& row : rows) {
      const std::int64_t first = column.place + row.offset, middle = first + row.dj;
      while (row.from < columns_.size() && columns_[row.from].place < first) ++row.from;
      for (std::size_t n = row.from; n < columns_.size(); ++n) {
        const std::int64_t dj = columns_[n].place - middle;
        if (dj > row.dj) break;
        const std::int64_t distance2 = row.di2 + square_of(dj);
        near.push_back(
            {columns_[n].first, columns_[n].last, kernels_.reach2() - distance2, distance2});
      }
    }
  }

  /// Calls `use(i, j, kernels)` for each site i and each j != i within the cut-off of a kernel, j
  /// ascending for each i.
  template <class Use>
  void for_each_pair(int jobs, const Use& use) const {
    for_each_in_parallel(runs_.size(), jobs, [&](std::size_t run) {
      std::vector<NearRow> rows = rows_about(columns_[runs_[run].first]);
      std::vector<NearColumn> near;
      for (std::uint32_t c = runs_[run].first; c < runs_[run].last; ++c) {
        find_near(columns_[c], rows, near);
        for (std::uint32_t i = columns_[c].first; i < columns_[c].last; ++i)
          for (NearColumn& column : near) for_each_pair_of(i, column, use);
      }
    });
  }

  template <class Use>
  void for_each_pair_of(std::uint32_t i, NearColumn& column, const Use& use) const {
    const Site& here = sites_[i];
    const auto rise2 = [&](std::uint32_t j) {
      return square_of(std::int64_t{sites_[j].k} - here.k);
    };
    while (column.from < column.last && sites_[column.from].k < here.k &&
           rise2(column.from) > column.room2)
      ++column.from;
    for (std::uint32_t j = column.from; j < column.last; ++j) {
      const std::int64_t dk2 = rise2(j);
      if (dk2 > column.room2) break;
      if (i == j) continue;
      const Site& there = sites_[j];
      const Kernels kernels = kernels_(
          column.distance2 + dk2,
          square_of(here.r - there.r) + square_of(here.g - there.g) + square_of(here.b - there.b));
      if (kernels.smoothness > 0.0f || kernels.appearance > 0.0f) use(i, j, kernels);
    }
  }

  /// Sets the scales where `normalised`; by site, whether it has a neighbour.
  [[nodiscard]] std::vector<char> sum_kernels(bool normalised, int jobs) {
    std::vector<char> has_neighbour(sites_.size(), 0);
    std::vector<Kernels> sums(sites_.size(), {1.0f, 1.0f});  // k_ii = 1
    for_each_pair(jobs, [&](std::uint32_t i, std::uint32_t, const Kernels& k) {
      has_neighbour[i] = 1;
      sums[i].smoothness += k.smoothness;
      sums[i].appearance += k.appearance;
    });
    for (std::size_t i = 0; normalised && i < sites_.size(); ++i) {
      sites_[i].smoothness_scale = 1.0f / std::sqrt(sums[i].smoothness);
      sites_[i].appearance_scale = 1.0f / std::sqrt(sums[i].appearance);
    }
    return has_neighbour;
  }

  float smoothness_weight_, appearance_weight_;
  PairKernels kernels_;
  std::int64_t extent_ = 0;  ///< largest i or j
  std::vector<Site> sites_;
  std::vector<std::uint32_t> voxel_of_;  ///< by site
  std::vector<Column> columns_;
  std::vector<Run> runs_;
  std::vector<bool> alone_;  ///< by voxel
};

}  // namespace

NeighbourMessages neighbour_messages(const CrfVoxels& voxels, const Crf& params, int jobs) {
  auto search = std::make_shared<const NeighbourSearch>(voxels, params, jobs);
  std::vector<bool> alone = search->alone();
  return {[search](const Eigen::MatrixXf& q, Eigen::MatrixXf& messages, int threads) {
            (*search)(q, messages, threads);
          },
          std::move(alone)};
}

}  // namespace mapscore
