// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/alignment_starts.hpp"

#include "core/geometry/pose.hpp"
#include "core/wide_vectors.hpp"

#include <opencv2/imgproc.hpp>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <utility>

namespace mapscore {
namespace {

using Family = AlignmentStart::Family;

constexpr float kStepPx = 4.0F;   // between turns that are tried
constexpr float kStepM = 0.005F;  // between shifts that are tried
constexpr float kReachM = 0.06F;
/// Rolls that are tried, in pixels as far from the image's middle as the focal length, each with
/// turns on a lattice.
constexpr float kRollStep_px = 20.0F, kMostRoll_px = 60.0F;
constexpr float kRolledStep_px = 8.0F, kRolledReach_px = 16.0F;
constexpr std::size_t kCompared = 48;  // of those that few edges find best, by more
constexpr float kApartPx = 8.0F;       // between the turns that are kept for the fine fit
constexpr float kLabelOffset_px = 3.5F;

constexpr float kToldOffset = 0.5F;        // share of the outlines that tells the offset by itself
constexpr float kMostUnexplained = 10.0F;  // times the prior and the cost of an offset
constexpr float kCost = 0.03F;       // share of the outline that 20 px, or an offset of 4 px, cost
constexpr float kMostOfRoll = 0.5F;  // of that, for roll and focal length, however large

float squared(float x) {
  return x * x;
}

AlignmentStart turned(const Projection& project, float du_px, float dv_px, float roll_px) {
  AlignmentStart start;
  start.family = Family::turn;
  const Eigen::Vector3d turn(-std::atan(dv_px / project.fy), std::atan(du_px / project.fx),
                             roll_px / project.fx);
  start.rotation = exp_rotation(turn).cast<float>();
  return start;
}

/// Calls use(a, b) with the places of a square lattice that lie within a disc.
void for_each_in_disc(float radius, float step, auto&& use) {
  for (float b = -radius; b <= radius; b += step)
    for (float a = -radius; a <= radius; a += step)
      if (a * a + b * b <= radius * radius) use(a, b);
}

/// The outlines of a field at quarter size: how well edges lie on them after any of the many
/// motions that a search tries.
class CoarseOutlines {
 public:
  CoarseOutlines(const OutlineField& field, const Projection& project)  ///< `field` must outlive it
      : field_(field), project_(project), cells_(field.coarse[0].total(), 0) {
    for (int way = 0; way < 4; ++way) {
      const std::uint8_t* const map = field.coarse[static_cast<std::size_t>(way)][0];
      for (std::size_t n = 0; n < cells_.size(); ++n) cells_[n] |= map[n] << (kBits * way);
    }
  }

  /// Share of the outlines that edges lie on where they go from p to R p + t (m). Sums in kTogether
  /// lanes, and over these at last, in order.
  [[nodiscard]] float score(const EdgeColumns& edges, const Eigen::Matrix3f& R,
                            const Eigen::Vector3f& t) {
    weights_.resize(edges.x.size());
    weigh(edges, R, t);
    std::array<float, EdgeColumns::kTogether> sums{};
    for (std::size_t first = 0; first < weights_.size(); first += sums.size())
      for (std::size_t lane = 0; lane < sums.size(); ++lane) sums[lane] += weights_[first + lane];
    return std::accumulate(sums.begin(), sums.end(), 0.0F) * static_cast<float>(edges.stride) /
           (kBest * static_cast<float>(field_.length_px));
  }

 private:
  static constexpr int kBits = 8, kBest = 255;  // of how well an edge of one way fits a cell

  /// Finds what each edge weighs after a motion.
  void weigh(const EdgeColumns& edges, const Eigen::Matrix3f& R, const Eigen::Vector3f& t);

  const OutlineField& field_;
  Projection project_;
  std::vector<int> cells_;  ///< the field's maps of all ways, side by side in each cell
  std::vector<float> weights_;
};

MAPSCORE_WIDE_VECTORS
void CoarseOutlines::weigh(const EdgeColumns& edges, const Eigen::Matrix3f& R,
                           const Eigen::Vector3f& t) {
  const int count = static_cast<int>(edges.x.size()), columns = field_.coarse[0].cols;
  const float *xs = edges.x.data(), *ys = edges.y.data(), *zs = edges.z.data(),
              *strengths = edges.strength.data();
  const int* const cells = cells_.data();
  const std::uint8_t* const ways = edges.way.data();
  float* const weights = weights_.data();
  const float right = static_cast<float>(columns),
              bottom = static_cast<float>(field_.coarse[0].rows);
  const float fx = project_.fx, fy = project_.fy, cx = project_.cx, cy = project_.cy;
  const float xx = R(0, 0), xy = R(0, 1), xz = R(0, 2), yx = R(1, 0), yy = R(1, 1), yz = R(1, 2),
              zx = R(2, 0), zy = R(2, 1), zz = R(2, 2), tx = t.x(), ty = t.y(), tz = t.z();
  constexpr float kCells = 1.0F / OutlineField::kCell_px;
  MAPSCORE_NO_OVERLAPS
  for (int n = 0; n < count; ++n) {
    const float x = xs[n], y = ys[n], z = zs[n];
    const float X = xx * x + xy * y + xz * z + tx;
    const float Y = yx * x + yy * y + yz * z + ty;
    const float Z = zx * x + zy * y + zz * z + tz;
    const float nearness = 1.0F / Z;
    const float u = (fx * X * nearness + cx) * kCells, v = (fy * Y * nearness + cy) * kCells;
    const bool within = (u >= 0) & (v >= 0) & (u < right) & (v < bottom);
    const int column = static_cast<int>(std::min(std::max(0.0F, u), right - 1));
    const int row = static_cast<int>(std::min(std::max(0.0F, v), bottom - 1));
    const float counts = within ? strengths[n] : 0.0F;
    const int fit = (cells[row * columns + column] >> (kBits * ways[n])) & kBest;
    weights[n] = counts * static_cast<float>(fit);
  }
}

}  // namespace

Levers levers_of(const OutlineField& field, const Projection& project) {
  const Eigen::Vector2d middle = Eigen::Vector2f(project.cx, project.cy).cast<double>();
  Eigen::Matrix3d to_px;  // from a cell's place to that of its middle
  to_px << 1, 0, 0, 1.5 - middle.x(), OutlineField::kCell_px, 0, 1.5 - middle.y(), 0,
      OutlineField::kCell_px;
  Eigen::Matrix<double, 5, 5> H = Eigen::Matrix<double, 5, 5>::Zero();
  cv::Mat1b cells;
  for (std::size_t way = 0; way < 4; ++way) {
    field.elements[way].convertTo(cells, CV_8U);  // moments of these are quicker
    const cv::Moments m = cv::moments(cells);
    Eigen::Matrix3d moments;  // of (1, column, row), then of (1, x, y) from the image's middle
    moments << m.m00, m.m10, m.m01, m.m10, m.m20, m.m11, m.m01, m.m11, m.m02;
    moments = to_px * moments * to_px.transpose();
    const Eigen::Vector2d n = direction_of(static_cast<Outward>(way)).cast<double>();
    Eigen::Matrix<double, 5, 3> J;
    J << n.x(), 0, 0, n.y(), 0, 0, 0, n.y(), -n.x(), 0, n.x(), n.y(), 1, 0, 0;
    H += J * moments * J.transpose();
  }
  const double length = field.length_px;
  H.diagonal().array() += 1e-9 * length;
  const Eigen::Matrix<double, 5, 5> covariance = H.inverse();
  const auto lever = [&](int n) {
    return static_cast<float>(1.0 / std::sqrt(covariance(n, n) * length));
  };
  return {lever(2), lever(3)};
}

float CorrectionCost::unexplained(float share) {
  return std::clamp(squared(kToldOffset / std::max(share, 1e-3F)), 1.0F, kMostUnexplained);
}

float CorrectionCost::operator()(const OutlineAlignment& a) const {
  constexpr float kTurn_px = 20.0F, kOffset_px = 4.0F;
  const Eigen::Vector2f turn(project_.fx * a.rotation(0, 2), project_.fy * a.rotation(1, 2));
  const Eigen::Vector2f shift = a.translation.head<2>() * project_.fx / 2.0F;
  const Eigen::Vector2f wide(project_.fx * a.rotation(1, 0), project_.fx * std::log(a.focal));
  const float of_wide = wide.squaredNorm() / squared(kTurn_px);
  return kCost * (1.0F + kShort_px / outline_px_) *
         ((turn.squaredNorm() + shift.squaredNorm()) / squared(kTurn_px) +
          unexplained(a.score) *
              (of_wide / (1.0F + of_wide / kMostOfRoll) + squared(a.offset_px / kOffset_px)));
}

std::vector<AlignmentStart> mask_size_starts(Family family) {
  std::vector<AlignmentStart> starts(3);
  for (AlignmentStart& start : starts) start.family = family;
  starts[1].offset_px = kLabelOffset_px;
  starts[2].offset_px = -kLabelOffset_px;
  return starts;
}

std::vector<AlignmentStart> alignment_starts(const EdgeColumns& few_edges, const EdgeColumns& edges,
                                             const OutlineField& field, const Projection& project,
                                             const CorrectionCost& cost, float search_px,
                                             bool with_roll) {
  CoarseOutlines coarse(field, project);
  std::vector<AlignmentStart> starts{AlignmentStart{}};
  const std::vector<AlignmentStart> far = mask_size_starts(Family::turn);
  starts.insert(starts.end(), far.begin(), far.end());

  const auto keep_best = [&](std::vector<AlignmentStart> tried, std::size_t most) {
    for (const EdgeColumns* some : {&few_edges, &edges}) {
      for (AlignmentStart& a : tried) {
        a.score = coarse.score(*some, a.rotation, a.translation);
        a.score -= cost(a);
      }
      std::ranges::stable_sort(tried, std::greater(), &AlignmentStart::score);
      tried.resize(std::min(tried.size(), kCompared));
    }
    std::vector<Eigen::Vector3f> kept;  // where a point at 2 m lies, and the roll, all in pixels
    for (const AlignmentStart& a : tried) {
      const Eigen::Vector2f middle = project(a.rotation * Eigen::Vector3f(0, 0, 2) + a.translation);
      const Eigen::Vector3f at(middle.x(), middle.y(), project.fx * a.rotation(1, 0));
      const bool near = std::ranges::any_of(
          kept, [&](const Eigen::Vector3f& other) { return (at - other).norm() < kApartPx; });
      if (near) continue;
      kept.push_back(at);
      starts.push_back(a);
      if (kept.size() == most) return;
    }
  };

  std::vector<AlignmentStart> turns, shifts, rolls;
  for_each_in_disc(search_px, kStepPx,
                   [&](float du, float dv) { turns.push_back(turned(project, du, dv, 0)); });
  keep_best(std::move(turns), 5);
  for_each_in_disc(kReachM, kStepM, [&](float tx, float ty) {
    AlignmentStart& start = shifts.emplace_back();
    start.family = Family::shift;
    start.translation = {tx, ty, 0};
  });
  keep_best(std::move(shifts), 4);
  if (!with_roll) return starts;
  for (float roll = kRollStep_px; roll <= kMostRoll_px; roll += kRollStep_px)
    for_each_in_disc(kRolledReach_px, kRolledStep_px, [&](float du, float dv) {
      for (const float way : {-1.0F, 1.0F}) rolls.push_back(turned(project, du, dv, way * roll));
    });
  keep_best(std::move(rolls), 2);
  return starts;
}

}  // namespace mapscore
