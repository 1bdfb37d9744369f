// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/calibration/outline_evidence.hpp"

#include "core/segmentation/edge_aligned/matched_edges.hpp"

#include <algorithm>
#include <cmath>

namespace mapscore {
namespace {

constexpr float kSame_px = 2.0F;      // between two outlines that are the same
constexpr float kAgainst = 0;         // weight of edges that face against their outline
constexpr std::size_t kSamples = 64;  // of an object's outline, roughly

/// By owner, pixels of its mask that touch another owner's or none's, evenly thinned.
std::vector<std::vector<cv::Point>> outline_samples(const cv::Mat1w& owner, std::size_t objects) {
  std::vector<std::vector<cv::Point>> all(objects + 1);
  for (int v = 0; v + 1 < owner.rows; ++v)
    for (int u = 0; u + 1 < owner.cols; ++u) {
      const std::uint16_t here = owner(v, u), right = owner(v, u + 1), low = owner(v + 1, u);
      if (here != right && here != 0) all[here].emplace_back(u, v);
      if (here != right && right != 0) all[right].emplace_back(u + 1, v);
      if (here != low && here != 0) all[here].emplace_back(u, v);
      if (here != low && low != 0) all[low].emplace_back(u, v + 1);
    }
  for (std::vector<cv::Point>& outline : all) {
    const std::size_t stride = 1 + outline.size() / kSamples;
    std::size_t kept = 0;
    for (std::size_t n = 0; n < outline.size(); n += stride) outline[kept++] = outline[n];
    outline.resize(kept);
  }
  return all;
}

}  // namespace

OutlineEvidence::OutlineEvidence(const Sight& sight, const std::optional<FrameMotion>& motion,
                                 double reach_px)
    : color_(sight.believed().color),
      field_(outline_field(sight.detections(), color_.width_px, color_.height_px,
                           static_cast<int>(std::ceil(reach_px)))),
      outlines_(outline_samples(field_.owner, sight.detections().size())) {
  const Pose& T_color_depth = sight.believed().T_color_depth;
  if (motion) {
    motion_ = adjoint(T_color_depth) * motion->velocity;
    lag_s_ = motion->lag_s;
  }
  if (field_.length_px == 0) return;
  edges_ = edges_near_outlines(find_depth_edges(sight.depth(), sight.believed(), kCalibrationEdges),
                               field_, sight.believed(), static_cast<float>(reach_px));
}

std::vector<std::size_t> OutlineEvidence::repeated_in(const OutlineEvidence& other) const {
  std::vector<std::size_t> same(outlines_.size(), 0), votes(other.outlines_.size());
  for (std::size_t object = 1; object < outlines_.size(); ++object) {
    std::ranges::fill(votes, 0U);
    std::size_t near = 0;
    for (const cv::Point& at : outlines_[object]) {
      if (!(std::abs(other.field_.distance(at)) <= kSame_px)) continue;
      ++near;
      ++votes[other.field_.owner(at)];
    }
    votes[0] = 0;
    const auto most = std::ranges::max_element(votes);
    if (2 * near > outlines_[object].size() && *most > 0)
      same[object] = static_cast<std::size_t>(most - votes.begin());
  }
  return same;
}

double OutlineEvidence::mean_inverse_depth() const {
  double sum = 0;
  for (const ProjectedEdge& edge : edges_) sum += 1.0 / static_cast<double>(edge.p.z());
  return edges_.empty() ? 0.0 : sum / static_cast<double>(edges_.size());
}

double OutlineEvidence::speed_px() const {
  if (!motion_) return 0.0;
  const Vector6& m = *motion_;
  return color_.fx_px * std::hypot(m[0] / 2 + m[4], m[1] / 2 - m[3]);
}

OutlineEvidence::Seen::Seen(const OutlineEvidence& frame, const CalibrationCorrection& correction)
    : pivot(correction.rigid.translation().cast<float>()),
      velocity(Eigen::Vector3f::Zero()),
      spin(Eigen::Vector3f::Zero()),
      offset_px(static_cast<float>(correction.offset_px)) {
  Pose moved = correction.rigid;
  if (frame.motion_) {
    if (const double seconds = frame.lag_s_ + correction.time_s; seconds != 0)
      moved = correction.rigid * exp_pose(-seconds * *frame.motion_);
    const Vector6 seen_motion = adjoint(correction.rigid) * *frame.motion_;
    velocity = -seen_motion.head<3>().cast<float>();
    spin = -seen_motion.tail<3>().cast<float>();
  }
  R = moved.linear().cast<float>();
  t = moved.translation().cast<float>();
  const double scale = std::exp(correction.log_focal);
  fx = static_cast<float>(frame.color_.fx_px * scale);
  fy = static_cast<float>(frame.color_.fy_px * scale);
  cx = static_cast<float>(frame.color_.cx_px + correction.centre_px.x());
  cy = static_cast<float>(frame.color_.cy_px + correction.centre_px.y());
}

double OutlineEvidence::coarse_match(const CalibrationCorrection& correction,
                                     std::size_t stride) const {
  const Seen seen(*this, correction);
  const cv::Mat1b& any = field_.coarse[0];
  float sum = 0;
  for (std::size_t n = 0; n < edges_.size(); n += stride) {
    const ProjectedEdge& edge = edges_[n];
    const Eigen::Vector2f at = seen.project(seen.R * edge.p + seen.t) / OutlineField::kCell_px;
    if (!(at.x() >= 0 && at.y() >= 0 && at.x() < static_cast<float>(any.cols) &&
          at.y() < static_cast<float>(any.rows)))
      continue;
    sum += edge.strength * static_cast<float>(field_.coarse[edge.way](static_cast<int>(at.y()),
                                                                      static_cast<int>(at.x())));
  }
  return static_cast<double>(sum) * static_cast<double>(stride) / 255.0;
}

double OutlineEvidence::explained(const CalibrationCorrection& correction, float sigma_px) const {
  const Seen seen(*this, correction);
  std::array<cv::Mat1f, 4> votes;
  for (std::size_t way = 0; way < 4; ++way)
    votes[way] = cv::Mat1f(field_.elements[way].size(), 0.0F);
  for (const ProjectedEdge& edge : edges_) {
    const Eigen::Vector3f p = seen.R * edge.p + seen.t;
    if (!(p.z() > MatchedEdges::kNearest_m)) continue;
    const Eigen::Vector2f at = seen.project(p);
    const EdgeMatch match =
        match_edge(field_, {at.x(), at.y(), edge.outward.x(), edge.outward.y(), edge.strength},
                   {seen.offset_px, sigma_px, kAgainst});
    if (match.weight <= 0) continue;
    const Eigen::Vector2f foot = at - match.distance * match.gradient();
    const int u = static_cast<int>(foot.x() / OutlineField::kCell_px),
              v = static_cast<int>(foot.y() / OutlineField::kCell_px);
    if (foot.x() < 0 || foot.y() < 0 || u >= votes[0].cols || v >= votes[0].rows) continue;
    votes[edge.way](v, u) += match.weight;
  }
  double sum = 0;
  for (std::size_t way = 0; way < 4; ++way)
    sum += cv::sum(cv::min(votes[way], field_.elements[way]))[0];
  return sum;
}

OutlineEquation OutlineEvidence::equation_of(const ProjectedEdge& edge, const Seen& seen,
                                             float sigma_px) const {
  OutlineEquation equation;
  const Eigen::Vector3f p = seen.R * edge.p + seen.t;
  if (!(p.z() > MatchedEdges::kNearest_m)) return equation;
  const Eigen::Vector2f at = seen.project(p);
  const EdgeMatch match =
      match_edge(field_, {at.x(), at.y(), edge.outward.x(), edge.outward.y(), edge.strength},
                 {seen.offset_px, sigma_px, kAgainst});
  if (match.weight <= 0) return equation;
  equation.weight = static_cast<double>(match.weight);
  equation.residual = static_cast<double>(match.residual);
  const Eigen::Vector2f inside = at - (match.distance + 1.0F) * match.gradient();
  const int u = std::clamp(static_cast<int>(inside.x() + 0.5F), 0, field_.owner.cols - 1),
            v = std::clamp(static_cast<int>(inside.y() + 0.5F), 0, field_.owner.rows - 1);
  equation.object = field_.owner(v, u);
  // The residual changes by `g` with the point in the colour camera, in pixels a metre.
  const double x = static_cast<double>(p.x() / p.z()), y = static_cast<double>(p.y() / p.z());
  const double z = static_cast<double>(p.z());
  const double gu = static_cast<double>(match.slope_u * seen.fx),
               gv = static_cast<double>(match.slope_v * seen.fy);
  const Eigen::Vector3d g(gu / z, gv / z, -(gu * x + gv * y) / z);
  const Eigen::Vector3d turned = (p - seen.pivot).cast<double>();
  const Eigen::Vector3d moving = (seen.velocity + seen.spin.cross(p)).cast<double>();
  using Axis = CalibrationCorrection::Axis;
  const Eigen::Vector3d turning = turned.cross(g);
  equation.slope.segment<3>(Axis::turn_x) = turning;
  equation.slope.segment<3>(Axis::shift_x) = g;
  equation.slope[Axis::focal] = gu * x + gv * y;
  equation.slope[Axis::centre_u] = static_cast<double>(match.slope_u);
  equation.slope[Axis::centre_v] = static_cast<double>(match.slope_v);
  equation.slope[Axis::time] = g.dot(moving);
  equation.slope[CalibrationCorrection::kMaskSize] = match.at_border ? 0.0 : -1.0;
  return equation;
}

}  // namespace mapscore
