// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/outline_alignment.hpp"

#include "core/geometry/pose.hpp"
#include "core/segmentation/edge_aligned/coarse_outlines.hpp"
#include "core/segmentation/edge_aligned/edge_matching.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace mapscore {
namespace {

constexpr std::size_t kCoarseEdges = 800, kFineEdges = 4000;
constexpr float kStepPx = 4.0F;   // between turns that are tried
constexpr float kStepM = 0.005F;  // between shifts that are tried
constexpr float kReachM = 0.06F;
constexpr float kSame_px = 0.1F, kSame_m = 0.0004F;  // between starts that are one
constexpr float kApartPx = 8.0F;  // between the turns that are kept for the fine fit

constexpr float kNearest_m = 0.05F;     // from the colour camera
constexpr float kLeastScore = 0.15F;    // below, the edges show nothing of the masks,
constexpr float kLeastLength_px = 100;  // unless they lie on so much of a long outline
constexpr float kLabelOffset_px = 3.5F;
constexpr float kPrior = 3.0F;
constexpr float kLeastPrior = 0.01F;       // of it, where exact edges say nothing of a correction
constexpr float kToldOffset = 0.5F;        // share of the outlines that tells the offset by itself
constexpr float kMostUnexplained = 10.0F;  // times the prior and the cost of an offset
constexpr float kCost = 0.03F;       // share of the outline that 20 px, or an offset of 4 px, cost
constexpr float kShort_px = 150.0F;  // and as much of an outline of this length again

using Parameters = Eigen::Matrix<float, 5, 1>;  // rx ry (px at the image's middle) tx ty (m) offset

class Aligner {
 public:
  Aligner(const DepthEdges& edges, const OutlineField& field, const Calibration& believed,
          double search_px)
      : field_(field), project_(believed.color), search_px_(static_cast<float>(search_px)) {
    const Eigen::Matrix3f R = believed.T_color_depth.linear().cast<float>();
    const Eigen::Vector3f t = believed.T_color_depth.translation().cast<float>();
    for (std::size_t way = 0; way < 4; ++way) votes_[way] = field.elements[way].clone();
    for (const DepthEdge& edge : edges.steps) {
      const Eigen::Vector3f p = R * edge.point + t;
      if (!(p.z() > kNearest_m)) continue;
      const Eigen::Vector2f at = project_(p);
      if (distance_near(at) > 1.3F * search_px_ + 12.0F) continue;
      edges_.push_back(
          {p, direction_of(edge.outward), static_cast<std::uint8_t>(edge.outward), edge.strength});
    }
  }

  OutlineAlignment align() {
    return edges_.empty() || field_.length_px == 0 ? OutlineAlignment{}
                                                   : fit(candidates(), Parameters::Ones());
  }

  OutlineAlignment fit_size() {
    return edges_.empty() || field_.length_px == 0
               ? OutlineAlignment{}
               : fit(sizes(Family::none), Parameters::Unit(Parameters::RowsAtCompileTime - 1));
  }

 private:
  enum class Family { none, turn, shift };
  struct Candidate : OutlineAlignment {
    Family family = Family::none;
  };

  /// The best of the candidates, each refined where it starts; `free`: 1 for what may change.
  OutlineAlignment fit(const std::vector<Candidate>& candidates, const Parameters& free) {
    OutlineAlignment best;
    float most = -1e9F;
    std::vector<Parameters> tried;
    for (Candidate candidate : candidates) {
      if (candidate.family != Family::none) {
        refine(candidate, 5.0F, 4, kCoarseEdges, free_of(candidate.family, 0));
        refine(candidate, 3.0F, 3, kCoarseEdges, free_of(candidate.family, 1));
      }
      const Parameters at = parameters_of(candidate);
      if (std::ranges::any_of(tried, [&](const auto& other) { return are_same(at, other); }))
        continue;
      tried.push_back(at);
      refine(candidate, 2.0F, 4, kCoarseEdges, free);
      candidate.score = fine_score(candidate, 1.5F);
      const float value = candidate.score - penalty(candidate);
      if (value > most) most = value, best = static_cast<OutlineAlignment>(candidate);
    }
    refine(best, 2.0F, 2, kFineEdges, free);
    refine(best, 1.2F, 4, kFineEdges, free);
    best.score = fine_score(best, 1.5F);
    if (best.score < kLeastScore &&
        best.score * static_cast<float>(field_.length_px) < kLeastLength_px)
      return {};
    best.sharpness = fine_score(best, 1.2F) / std::max(fine_score(best, 4.0F), 1e-6F);
    return best;
  }

  /// Distance to the nearest outline; beyond the image that of the nearest pixel, and the way to
  /// it.
  [[nodiscard]] float distance_near(const Eigen::Vector2f& at) const {
    const float u = std::clamp(at.x(), 0.0F, static_cast<float>(field_.distance.cols - 1));
    const float v = std::clamp(at.y(), 0.0F, static_cast<float>(field_.distance.rows - 1));
    return std::abs(field_.distance(static_cast<int>(v), static_cast<int>(u))) +
           std::abs(u - at.x()) + std::abs(v - at.y());
  }

  /// What large corrections cost: they need evidence, and a short outline holds little, since it
  /// fits somewhere by chance.
  [[nodiscard]] float penalty(const OutlineAlignment& a) const {
    const Eigen::Vector2f turn(project_.fx * a.rotation(0, 2), project_.fy * a.rotation(1, 2));
    const Eigen::Vector2f shift = a.translation.head<2>() * project_.fx / 2.0F;
    return kCost * (1.0F + kShort_px / static_cast<float>(field_.length_px)) *
           ((turn.squaredNorm() + shift.squaredNorm()) / (20.0F * 20.0F) +
            unexplained(a.score) * a.offset_px * a.offset_px / (4.0F * 4.0F));
  }

  /// How much more an offset of all outlines must be shown where edges explain less than half of
  /// them: most of the others, as between flush fronts, would show it if they were steps.
  [[nodiscard]] static float unexplained(float share) {
    return std::clamp(square(kToldOffset / std::max(share, 1e-3F)), 1.0F, kMostUnexplained);
  }

  /// What the fit may change at its first stages: turns alone, or shifts alone.
  [[nodiscard]] static Parameters free_of(Family family, int stage) {
    const float turns = family == Family::shift ? 0.0F : 1.0F;
    Parameters free;
    free << turns, turns, 1.0F - turns, 1.0F - turns, stage > 0 ? 1.0F : 0.0F;
    return free;
  }

  [[nodiscard]] OutlineAlignment turned(float du_px, float dv_px) const {
    OutlineAlignment a;
    const Eigen::Vector3d turn(-std::atan(dv_px / project_.fy), std::atan(du_px / project_.fx),
                               0.0);
    a.rotation = exp_rotation(turn).cast<float>();
    return a;
  }

  /// No correction, of masks that are right, too small and too large.
  [[nodiscard]] static std::vector<Candidate> sizes(Family family) {
    std::vector<Candidate> starts(3);
    for (Candidate& start : starts) start.family = family;
    starts[1].offset_px = kLabelOffset_px;
    starts[2].offset_px = -kLabelOffset_px;
    return starts;
  }

  /// The alignments that the fine fit starts from: none, which is believed unless something better
  /// is found; none from farther away, with offsets; the best turns; the best shifts.
  [[nodiscard]] std::vector<Candidate> candidates() const {
    CoarseOutlines coarse(edges_, field_, project_);
    std::vector<Candidate> starts{Candidate{}};
    const std::vector<Candidate> far = sizes(Family::turn);
    starts.insert(starts.end(), far.begin(), far.end());
    std::vector<Candidate> tried;
    for (float dv = -search_px_; dv <= search_px_; dv += kStepPx)
      for (float du = -search_px_; du <= search_px_; du += kStepPx)
        if (du * du + dv * dv <= search_px_ * search_px_)
          tried.push_back({turned(du, dv), Family::turn});
    keep_best(std::move(tried), 5, coarse, starts);
    tried.clear();
    for (float ty = -kReachM; ty <= kReachM; ty += kStepM)
      for (float tx = -kReachM; tx <= kReachM; tx += kStepM)
        if (tx * tx + ty * ty <= kReachM * kReachM) {
          OutlineAlignment a;
          a.translation = {tx, ty, 0};
          tried.push_back({a, Family::shift});
        }
    keep_best(std::move(tried), 4, coarse, starts);
    return starts;
  }

  void keep_best(std::vector<Candidate> tried, std::size_t most, CoarseOutlines& coarse,
                 std::vector<Candidate>& starts) const {
    for (Candidate& a : tried) a.score = coarse.score(a.rotation, a.translation) - penalty(a);
    std::stable_sort(tried.begin(), tried.end(),
                     [](const auto& a, const auto& b) { return a.score > b.score; });
    std::vector<Eigen::Vector2f> kept;
    for (const Candidate& a : tried) {
      const Eigen::Vector2f middle =
          project_(a.rotation * Eigen::Vector3f(0, 0, 2) + a.translation);
      const bool near = std::any_of(kept.begin(), kept.end(), [&](const Eigen::Vector2f& other) {
        return (middle - other).norm() < kApartPx;
      });
      if (near) continue;
      kept.push_back(middle);
      starts.push_back(a);
      if (kept.size() == most) return;
    }
  }

  /// A match, and the point that it was found for.
  struct Match : EdgeMatch {
    Eigen::Vector3f p;
  };
  [[nodiscard]] Match match(const ProjectedEdge& edge, const OutlineAlignment& a,
                            float sigma) const {
    const Eigen::Vector3f p = a.rotation * edge.p + a.translation;
    if (!(p.z() > kNearest_m)) return {{}, p};
    return {match_edge(field_, project_(p), edge.outward, edge.strength, a.offset_px, sigma), p};
  }

  /// Share of the outline elements that edges lie on. However many edges crowd around an element,
  /// it counts once.
  [[nodiscard]] float fine_score(const OutlineAlignment& a, float sigma) {
    for (std::size_t way = 0; way < 4; ++way) votes_[way].setTo(0.0F);
    const std::size_t stride = 1 + edges_.size() / kFineEdges;
    const float weight = static_cast<float>(stride);
    for (std::size_t n = 0; n < edges_.size(); n += stride) {
      const Match m = match(edges_[n], a, sigma);
      if (m.weight <= 0) continue;
      const Eigen::Vector2f foot = project_(m.p) - m.distance * m.gradient;
      const int u = static_cast<int>(foot.x() / OutlineField::kCell_px),
                v = static_cast<int>(foot.y() / OutlineField::kCell_px);
      if (foot.x() < 0 || foot.y() < 0 || u >= votes_[0].cols || v >= votes_[0].rows) continue;
      const bool same_way = m.gradient.dot(edges_[n].outward) > 0;
      votes_[same_way ? edges_[n].way : edges_[n].way ^ 1U](v, u) += weight * m.weight;
    }
    double sum = 0;
    for (std::size_t way = 0; way < 4; ++way)
      sum += cv::sum(cv::min(votes_[way], field_.elements[way]))[0];
    return static_cast<float>(sum) / static_cast<float>(field_.length_px);
  }

  /// Gauss-Newton with weights of the last step (Welsch), pulled weakly to no correction at all.
  void refine(OutlineAlignment& a, float sigma, int steps, std::size_t most_edges,
              const Parameters& free) const {
    const std::size_t stride = 1 + edges_.size() / most_edges;
    for (int step = 0; step < steps; ++step) {
      Eigen::Matrix<float, 5, 5> H = Eigen::Matrix<float, 5, 5>::Zero();
      Parameters b = Parameters::Zero();
      float matched = 0, squares = 0;  // of weights, of weighted squared residuals
      for (std::size_t n = 0; n < edges_.size(); n += stride) {
        const Match m = match(edges_[n], a, sigma);
        if (m.weight <= 0) continue;
        const float x = m.p.x() / m.p.z(), y = m.p.y() / m.p.z();
        const float gu = m.gradient.x() * project_.fx, gv = m.gradient.y() * project_.fy;
        Parameters J;
        J << (-gu * x * y - gv * (1 + y * y)) / project_.fx,
            (gu * (1 + x * x) + gv * x * y) / project_.fx, gu / m.p.z(), gv / m.p.z(),
            m.at_border ? 0.0F : -1.0F;
        matched += m.weight, squares += m.weight * m.residual * m.residual;
        H.noalias() += m.weight * J * J.transpose();
        b.noalias() -= m.weight * m.residual * J;
      }
      const float scale = static_cast<float>(stride);
      H *= scale, b *= scale;
      const Parameters now = parameters_of(a);
      Parameters prior;
      prior << 1 / square(20.0F), 1 / square(20.0F), 1 / square(0.03F), 1 / square(0.03F),
          1 / square(4.0F);
      prior[4] *= unexplained(scale * matched / static_cast<float>(field_.length_px));
      // Outlines that scatter about the edges, as ragged masks do, measure less than sharp ones.
      const float scatter = matched > 0 ? squares / (matched * square(sigma)) : 1.0F;
      prior *= kPrior * (square(scatter) + kLeastPrior) * (scale * matched + kShort_px);
      H.diagonal() += prior;
      b -= prior.cwiseProduct(now);
      H = free.asDiagonal() * H * free.asDiagonal();
      H.diagonal() += Parameters::Ones() - free;
      b = b.cwiseProduct(free);
      Parameters change = H.ldlt().solve(b);
      if (!change.allFinite()) return;
      const Eigen::Vector3d step_turn(change[0] / project_.fx, change[1] / project_.fx, 0);
      const Eigen::Matrix3f R = exp_rotation(step_turn).cast<float>();
      a.rotation = R * a.rotation;
      a.translation = R * a.translation + Eigen::Vector3f(change[2], change[3], 0);
      a.offset_px = std::clamp(a.offset_px + change[4], -6.0F, 6.0F);
    }
  }

  [[nodiscard]] Parameters parameters_of(const OutlineAlignment& a) const {
    const Eigen::Vector3f turn = rotation_vector(a.rotation);
    Parameters all;
    all << project_.fx * turn.x(), project_.fx * turn.y(), a.translation.x(), a.translation.y(),
        a.offset_px;
    return all;
  }

  /// Two starts from which the same fit is found.
  [[nodiscard]] static bool are_same(const Parameters& a, const Parameters& b) {
    Parameters least;
    least << kSame_px, kSame_px, kSame_m, kSame_m, kSame_px;
    return ((a - b).cwiseAbs().array() < least.array()).all();
  }

  static float square(float x) { return x * x; }
  static Eigen::Vector3f rotation_vector(const Eigen::Matrix3f& R) {
    return 0.5F * Eigen::Vector3f(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
  }

  const OutlineField& field_;
  Projection project_;
  float search_px_;
  std::vector<ProjectedEdge> edges_;
  std::array<cv::Mat1f, 4> votes_;
};

}  // namespace

double confidence_of(const OutlineAlignment& fit, int outline_px) {
  const double score = fit.score, explained_px = std::max(score * outline_px, 10.0);
  const double sharpness = std::min(static_cast<double>(fit.sharpness), 1.0);
  const double logit =
      -2.45 + 0.95 * std::log(explained_px / 100.0) + 4.4 * score + 3.64 * sharpness;
  return 1.0 / (1.0 + std::exp(-logit));
}

OutlineAlignment align_outlines(const DepthEdges& edges, const OutlineField& field,
                                const Calibration& believed, double search_px) {
  return Aligner(edges, field, believed, search_px).align();
}

OutlineAlignment fit_mask_size(const DepthEdges& edges, const OutlineField& field,
                               const Calibration& believed) {
  return Aligner(edges, field, believed, 0.0).fit_size();
}

}  // namespace mapscore
