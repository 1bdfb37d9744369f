// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/outline_alignment.hpp"

#include "core/segmentation/edge_aligned/alignment_starts.hpp"
#include "core/segmentation/edge_aligned/edge_matching.hpp"
#include "core/segmentation/edge_aligned/matched_edges.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace mapscore {
namespace {

using Family = AlignmentStart::Family;

constexpr std::size_t kFewEdges = 200, kCoarseEdges = 800, kFineEdges = 4000;
constexpr float kOne_px = 0.4F, kOne_m = 0.0016F;    // between starts that are one
constexpr float kStep_px = 0.1F, kStep_m = 0.0004F;  // of a step that changes nothing to speak of

constexpr float kScored_px = 1.5F;       // sigma of a score
constexpr float kLeastScore = 0.15F;     // below, the edges show nothing of the masks,
constexpr float kLeastLength_px = 100;   // unless they lie on so much of a long outline
constexpr float kLeastLever_px = 40.0F;  // for roll and focal length to be fitted
/// Masks that seem to be smaller than their objects by more than this may be right, and what the
/// objects are set into may end close around them.
constexpr float kSetIn_px = 1.0F;
constexpr float kSetInGain_px = 100;  // of outline, that show such a fit,
constexpr float kSetInShare = 0.2F;   // unless what is believed explains no more than this part
constexpr float kPrior = 3.0F, kDamping = 0.03F;  // of a frame's fit, of one by all frames
constexpr float kLeastPrior = 0.01F;  // of it, where exact edges say nothing of a correction
/// How firmly corrections are held: shifts in 1/m^2, all others in 1/px^2.
const Parameters kFirmness =
    Parameters{{20.0F, 20.0F, 60.0F, 20.0F, 0.03F, 0.03F, 4.0F}}.array().square().inverse();

/// What is kept of a frame to try corrections on it, and its own.
class KeptOutlines final : public FittedFrame {
 public:
  KeptOutlines(const OutlineField& field, EdgeColumns edges, const Projection& project,
               const OutlineAlignment& mended, float mended_px, float believed_px)
      : FittedFrame(static_cast<double>(mended_px), static_cast<double>(believed_px)),
        field_(field),
        edges_(std::move(edges)),
        project_(project),
        mended_(mended) {
    field_.owner.release();  // edges are matched without it
  }

  [[nodiscard]] double explained_px(const FittedFrame& other) const override {
    const std::optional<OutlineAlignment> correction = correction_of(other);
    return correction ? static_cast<double>(explained_px(*correction)) : 0;
  }

  /// Gauss-Newton over the outlines of all frames, with one size of masks; the focal length stays.
  [[nodiscard]] std::shared_ptr<const FittedFrame> refined_on(
      const std::vector<std::shared_ptr<const FittedFrame>>& frames) const override {
    const Parameters free = Parameters::Ones() - Parameters::Unit(kFocal);
    OutlineAlignment a = mended_;
    for (const float sigma : {3.0F, 2.0F, 2.0F, 2.0F, 2.0F, 1.2F, 1.2F, 1.2F, 1.2F}) {
      const Projection project = project_.scaled(a.focal);
      NormalEquations all{decltype(all.H)::Zero(), Parameters::Zero()};
      for (const auto& frame : frames) {
        const auto* kept = dynamic_cast<const KeptOutlines*>(frame.get());
        if (kept == nullptr) return nullptr;
        MatchedEdges matched(kept->field_);
        matched.match(kept->edges_, a, project, sigma);
        const NormalEquations sums = add_up(matched, project, project_.fx);
        const float scale = static_cast<float>(kept->edges_.stride);
        all.H += scale * sums.H, all.b += scale * sums.b, all.matched += scale * sums.matched;
      }
      all.H.diagonal() += kDamping * (all.matched + kLeastLength_px) * kFirmness;
      const Parameters step = solved(all.H, all.b, free);
      if (!step.allFinite()) return nullptr;
      a = stepped(a, step, project_.fx);
    }
    const float px = explained_px(a);
    return std::make_shared<const KeptOutlines>(field_, edges_, project_, a, px, px);
  }

  [[nodiscard]] const OutlineAlignment& mended() const { return mended_; }

 private:
  [[nodiscard]] float explained_px(const OutlineAlignment& a) const {
    return ExplainedOutlines(field_, edges_, project_).px(a, kScored_px);
  }

  OutlineField field_;
  EdgeColumns edges_;
  Projection project_;
  OutlineAlignment mended_;
};

class Aligner {
 public:
  Aligner(const DepthEdges& edges, const OutlineField& field, const Calibration& believed,
          double search_px)
      : field_(field),
        project_(believed.color),
        cost_(project_, field.length_px),
        search_px_(static_cast<float>(search_px)) {
    const std::vector<ProjectedEdge> projected =
        edges_near_outlines(edges, field, believed, 1.3F * search_px_ + 12.0F);
    few_ = EdgeColumns(projected, kFewEdges);
    coarse_ = EdgeColumns(projected, kCoarseEdges);
    fine_ = EdgeColumns(projected, kFineEdges);
  }

  OutlineFits align() {
    if (fine_.x.empty() || field_.length_px == 0) return {};
    const Levers levers = levers_of(field_, project_);
    Parameters free = Parameters::Ones();
    free[kRoll] = levers.roll_px > kLeastLever_px ? 1.0F : 0.0F;
    free[kFocal] = levers.focal_px > kLeastLever_px ? 1.0F : 0.0F;
    OutlineFits fits;
    fits.mended =
        fit(alignment_starts(few_, coarse_, field_, project_, cost_, search_px_, free[kRoll] > 0),
            free);
    const OutlineAlignment& all = fits.mended;
    fits.believed = moved_px(all) > kOne_px ? judged(as_believed())
                                            : OutlineAlignment{.offset_px = all.offset_px,
                                                               .sharpness = all.sharpness,
                                                               .score = all.score};
    if (all.score > 0)
      fits.frame = std::make_shared<const KeptOutlines>(field_, fine_, project_, all,
                                                        explained_.px(all, kScored_px),
                                                        explained_.px(fits.believed, kScored_px));
    return fits;
  }

  OutlineAlignment fit_size() {
    if (fine_.x.empty() || field_.length_px == 0) return {};
    return fit(mask_size_starts(Family::none), Parameters::Unit(kOffset));
  }

 private:
  /// The best of the fits, each refined where it starts; `free`: 1 for what may change.
  OutlineAlignment fit(const std::vector<AlignmentStart>& starts, const Parameters& free) {
    OutlineAlignment best;
    float most = -1e9F;
    std::vector<std::pair<Family, Parameters>> met;
    const auto is_new = [&](const AlignmentStart& start, Family family) {
      const Parameters at = parameters_of(start, project_.fx);
      for (const auto& [other, place] : met)
        if (other == family && are_same(at, place, kOne_px, kOne_m)) return false;
      met.emplace_back(family, at);
      return true;
    };
    for (AlignmentStart candidate : starts) {
      if (candidate.family != Family::none) {
        const Parameters first = free_of(candidate.family, 0), then = free_of(candidate.family, 1);
        refine(candidate, 5.0F, 4, coarse_, free.cwiseProduct(first));
        if (!is_new(candidate, candidate.family)) continue;
        refine(candidate, 3.0F, 3, coarse_, free.cwiseProduct(then));
      }
      if (!is_new(candidate, Family::none)) continue;
      refine(candidate, 2.0F, 4, coarse_, free);
      candidate.score = fine_score(candidate, kScored_px);
      const float value = candidate.score - cost_(candidate);
      if (value > most) most = value, best = static_cast<OutlineAlignment>(candidate);
    }
    finish(best, free);
    if (best.offset_px > kSetIn_px) {
      const OutlineAlignment& believed = as_believed();
      const float gain = (best.score - believed.score) * static_cast<float>(field_.length_px);
      if (gain < kSetInGain_px && believed.score > kSetInShare * best.score) best = believed;
    }
    return judged(best);
  }

  /// No correction, with the masks' size fitted from where it is.
  [[nodiscard]] const OutlineAlignment& as_believed() {
    if (!believed_) {
      const Parameters size = Parameters::Unit(kOffset);
      believed_.emplace();
      refine(*believed_, 2.0F, 4, coarse_, size);
      finish(*believed_, size);
    }
    return *believed_;
  }

  /// A fit with its sharpness; nothing where the edges show nothing of the masks.
  [[nodiscard]] OutlineAlignment judged(OutlineAlignment fit) {
    if (fit.score < kLeastScore &&
        fit.score * static_cast<float>(field_.length_px) < kLeastLength_px)
      return {};
    fit.sharpness = fine_score(fit, 1.2F) / std::max(fine_score(fit, 4.0F), 1e-6F);
    return fit;
  }

  [[nodiscard]] float moved_px(const OutlineAlignment& a) const {
    const Projection project = project_.scaled(a.focal);
    float squares = 0;
    for (std::size_t n = 0; n < coarse_.x.size(); ++n) {
      const Eigen::Vector3f p(coarse_.x[n], coarse_.y[n], coarse_.z[n]);
      squares += (project(a.rotation * p + a.translation) - project_(p)).squaredNorm();
    }
    return std::sqrt(squares / static_cast<float>(coarse_.x.size()));
  }

  /// The last refinements, by all edges, and the score.
  void finish(OutlineAlignment& a, const Parameters& free) {
    refine(a, 2.0F, 2, fine_, free);
    refine(a, 1.2F, 4, fine_, free);
    a.score = fine_score(a, kScored_px);
  }

  /// What the fit may change at its first stages: turns alone, or shifts alone, then all but the
  /// other of these.
  [[nodiscard]] static Parameters free_of(Family family, int stage) {
    const float turns = family == Family::shift ? 0.0F : 1.0F;
    Parameters free = Parameters::Constant(stage > 0 ? 1.0F : 0.0F);
    free[kTurnX] = free[kTurnY] = turns;
    free[kShiftX] = free[kShiftY] = 1.0F - turns;
    return free;
  }

  /// Share of the outline elements that edges lie on.
  [[nodiscard]] float fine_score(const OutlineAlignment& a, float sigma) {
    return explained_.px(a, sigma) / static_cast<float>(field_.length_px);
  }

  /// Gauss-Newton with weights of the last step (Welsch), pulled weakly to no correction at all, of
  /// `steps` steps or until one changes nothing to speak of.
  void refine(OutlineAlignment& a, float sigma, int steps, const EdgeColumns& edges,
              const Parameters& free) {
    for (int n = 0; n < steps; ++n) {
      const Projection project = project_.scaled(a.focal);
      matched_.match(edges, a, project, sigma);
      const auto [H_sum, b_sum, matched, squares] = add_up(matched_, project, project_.fx);
      const float scale = static_cast<float>(edges.stride);
      const float share = scale * matched / static_cast<float>(field_.length_px);
      Parameters b = scale * b_sum;
      Eigen::Matrix<float, kParameters, kParameters> H = scale * H_sum;
      const Parameters now = parameters_of(a, project_.fx);
      Parameters prior = kFirmness;
      prior[kOffset] *= CorrectionCost::unexplained(share);
      // Outlines that scatter about the edges, as ragged masks do, measure less than sharp ones.
      const float scatter = matched > 0 ? squares / (matched * square(sigma)) : 1.0F;
      prior *=
          kPrior * (square(scatter) + kLeastPrior) * (scale * matched + CorrectionCost::kShort_px);
      H.diagonal() += prior;
      b -= prior.cwiseProduct(now);
      const Parameters step = solved(H, b, free);
      if (!step.allFinite()) return;
      a = stepped(a, step, project_.fx);
      if (are_same(step, Parameters::Zero(), kStep_px, kStep_m)) return;
    }
  }

  [[nodiscard]] static bool are_same(const Parameters& a, const Parameters& b, float within_px,
                                     float within_m) {
    Parameters least = Parameters::Constant(within_px);
    least[kShiftX] = least[kShiftY] = within_m;
    return ((a - b).cwiseAbs().array() < least.array()).all();
  }

  static float square(float x) { return x * x; }

  const OutlineField& field_;
  Projection project_;
  CorrectionCost cost_;
  float search_px_;
  EdgeColumns few_, coarse_, fine_;
  MatchedEdges matched_{field_};
  std::optional<OutlineAlignment> believed_;
  ExplainedOutlines explained_{field_, fine_, project_};
};

}  // namespace

double confidence_of(const OutlineAlignment& fit, int outline_px) {
  const double score = fit.score, explained_px = std::max(score * outline_px, 10.0);
  const double sharpness = std::min(static_cast<double>(fit.sharpness), 1.0);
  const double logit =
      -2.45 + 0.95 * std::log(explained_px / 100.0) + 4.4 * score + 3.64 * sharpness;
  return 1.0 / (1.0 + std::exp(-logit));
}

std::optional<OutlineAlignment> correction_of(const FittedFrame& frame) {
  const auto* kept = dynamic_cast<const KeptOutlines*>(&frame);
  return kept != nullptr ? std::optional(kept->mended()) : std::nullopt;
}

OutlineFits align_outlines(const DepthEdges& edges, const OutlineField& field,
                           const Calibration& believed, double search_px) {
  return Aligner(edges, field, believed, search_px).align();
}

OutlineAlignment fit_mask_size(const DepthEdges& edges, const OutlineField& field,
                               const Calibration& believed) {
  return Aligner(edges, field, believed, 0.0).fit_size();
}

}  // namespace mapscore
