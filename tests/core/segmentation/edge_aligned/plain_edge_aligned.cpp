// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "plain_edge_aligned.hpp"

#include "core/segmentation/edge_aligned/edge_matching.hpp"
#include "core/segmentation/edge_aligned/near_holes.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace mapscore::testing {
namespace {

constexpr int kGap = 24;  // px, the widest that is stepped over

/// A line of pixels of an image: a row, or a column.
struct PixelLine {
  const cv::Mat1f& image;
  bool row;
  int index;

  [[nodiscard]] int size() const { return row ? image.cols : image.rows; }
  [[nodiscard]] float at(int n) const {
    if (n < 0 || n >= size()) return 0.0F;
    return row ? image(index, n) : image(n, index);
  }
  /// The last with a value before a place, -1 for none.
  [[nodiscard]] int last_before(int n) const {
    do --n;
    while (n >= 0 && !(at(n) > 0));
    return n;
  }
};

class PlainSteps {
 public:
  PlainSteps(const DepthEdges& given, const Calibration& believed, const DepthEdgeRules& rules)
      : believed_(believed), rules_(rules), edges_(given) {
    edges_.right = cv::Mat1f(given.inverse_depth.size(), 0.0F);
    edges_.down = cv::Mat1f(given.inverse_depth.size(), 0.0F);
    edges_.steps.clear();
  }

  DepthEdges find() {
    const cv::Mat1f& w = edges_.inverse_depth;
    for (int v = 0; v < w.rows; ++v) {
      for (int u = 0; u < w.cols; ++u) {
        if (!(w(v, u) > 0)) continue;
        look_back({w, true, v}, u);
        look_back({w, false, u}, v);
      }
      beside_hole({w, true, v}, w.cols);
    }
    for (int u = 0; u < w.cols; ++u) beside_hole({w, false, u}, w.rows);
    for (const Found& one : found_)
      if (!has_outer(one)) edges_.steps.push_back(one.step);
    return edges_;
  }

 private:
  void look_back(const PixelLine& line, int q) {
    const int p = line.last_before(q);
    beside_hole(line, q);
    if (p < 0) return;
    const float tau = std::max(0.002F, 4 * edges_.noise), rise = line.at(q) - line.at(p);
    const float gap = static_cast<float>(q - p);
    float strength = 0;
    if (std::abs(rise) > tau && q - p <= kGap) {
      const float before = line.at(p - 1), after = line.at(q + 1);
      const float slope_p = before > 0 ? line.at(p) - before : 0.0F;
      const float slope_q = after > 0 ? after - line.at(q) : 0.0F;
      const float step = std::min(std::abs(rise - gap * slope_p), std::abs(rise - gap * slope_q));
      strength = std::clamp((step - tau) / (2 * tau), 0.0F, 1.0F);
    }
    if (q == p + 1)
      (line.row ? edges_.right(line.index, p) : edges_.down(p, line.index)) = 1.0F - strength;
    if (strength > 0) add(line, line.at(p) > line.at(q) ? p : q, line.at(p) > line.at(q), strength);
  }

  /// What ends at a hole before a place.
  void beside_hole(const PixelLine& line, int q) {
    const int p = line.last_before(q), middle = (p + q) / 2;
    const float farthest = static_cast<float>(1.0 / (0.9 * believed_.range_max_m));
    if (q - p <= kGap) return;
    if ((line.row ? edges_.near_holes(line.index / 2, middle / 2)
                  : edges_.near_holes(middle / 2, line.index / 2)) == kNearHole) {
      if (!rules_.shadow_ends || !line.row || !is_noisy(edges_) || p < 0 || q == line.size())
        return;
      const float step = line.at(q) - line.at(p);
      const float widest = 0.08F * static_cast<float>(believed_.depth.fx_px) * step + 4;
      if (step > std::max(0.002F, 4 * edges_.noise) && static_cast<float>(q - p - 1) <= widest)
        add(line, q, false, 1.0F);
      return;
    }
    if (p >= 0 && line.at(p) > farthest) add(line, p, true, 1.0F);
    if (q < line.size() && line.at(q) > farthest) add(line, q, false, 1.0F);
  }

  void add(const PixelLine& line, int n, bool ends, float strength) {
    const double at = n + (ends ? 0.5 : -0.5);
    const double z = 1.0 / static_cast<double>(line.at(n));
    const auto point = line.row ? believed_.depth.back_project(at, line.index, z)
                                : believed_.depth.back_project(line.index, at, z);
    const Outward way =
        line.row ? (ends ? Outward::right : Outward::left) : (ends ? Outward::down : Outward::up);
    of_line_[{way, line.index}].push_back(found_.size());
    found_.push_back({{point.cast<float>(), way, strength}, line.index, n, line.at(n)});
  }

  struct Found {
    DepthEdge step;
    int line, at;
    float inverse;
  };
  /// Whether the next step outward of the same line belongs to the same surface.
  [[nodiscard]] bool has_outer(const Found& one) const {
    const bool up = one.step.outward == Outward::right || one.step.outward == Outward::down;
    const Found* next = nullptr;
    int least = 7;
    for (const std::size_t number : of_line_.at({one.step.outward, one.line})) {
      const Found& other = found_[number];
      const int beyond = up ? other.at - one.at : one.at - other.at;
      if (beyond > 0 && beyond < least) next = &other, least = beyond;
    }
    return next != nullptr && std::abs(next->inverse - one.inverse) <=
                                  rules_.same_depth * std::max(next->inverse, one.inverse);
  }

  const Calibration& believed_;
  DepthEdgeRules rules_;
  DepthEdges edges_;
  std::vector<Found> found_;
  std::map<std::pair<Outward, int>, std::vector<std::size_t>> of_line_;  ///< numbers of found_
};

class PlainShifts {
 public:
  PlainShifts(const DepthEdges& edges, const OutlineField& field, const OutlineAlignment& alignment,
              const Calibration& believed)
      : field_(field), offset_px_(alignment.offset_px) {
    const Calibration mended = alignment.corrected(believed);
    const Eigen::Matrix3f R = mended.T_color_depth.linear().cast<float>();
    const Eigen::Vector3f t = mended.T_color_depth.translation().cast<float>();
    const Projection project(mended.color);
    std::vector<Placed> placed;
    for (const DepthEdge& edge : edges.steps) {
      const Eigen::Vector3f p = R * edge.point + t;
      const Eigen::Vector2f at = project(p);
      const bool within = at.x() >= 0 && at.y() >= 0 &&
                          at.x() < static_cast<float>(field.distance.cols) &&
                          at.y() < static_cast<float>(field.distance.rows);
      if (!(p.z() > 0.05F) || !within) continue;
      const float distance = field.distance(static_cast<int>(at.y()), static_cast<int>(at.x()));
      if (std::abs(distance) <= 27.0F)
        placed.push_back({at, direction_of(edge.outward), edge.strength, 0});
    }
    // The core keeps them by cell: so that sums are added up in its order.
    const auto cell = [](const Placed& edge) {
      return std::pair(static_cast<int>(edge.at.y()) / kPitch,
                       static_cast<int>(edge.at.x()) / kPitch);
    };
    std::stable_sort(placed.begin(), placed.end(),
                     [&](const Placed& a, const Placed& b) { return cell(a) < cell(b); });
    edges_ = placed;
  }

  OutlineShifts find() {
    const int rows = field_.distance.rows / kPitch + 2, columns = field_.distance.cols / kPitch + 2;
    OutlineShifts shifts;
    shifts.nodes = cv::Mat2f(rows, columns, cv::Vec2f(0, 0));
    bool any = false;
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column) {
        const float length = length_about(row, column);
        near_.clear();
        for (Placed edge : edges_) {
          edge.support = support(edge.at, row, column);
          if (edge.support > 0) near_.push_back(edge);
        }
        if (length < 12.0F || near_.empty()) continue;
        const Eigen::Vector2f shift = shift_of(length);
        shifts.nodes(row, column) = {shift.x(), shift.y()};
        any = any || shift.squaredNorm() > 0;
      }
    if (!any) shifts.nodes.release();
    return shifts;
  }

 private:
  static constexpr int kPitch = OutlineShifts::kPitch_px;
  struct Placed {
    Eigen::Vector2f at, outward;
    float strength, support;
  };

  static float support(const Eigen::Vector2f& at, int row, int column) {
    const float du = at.x() - static_cast<float>(column * kPitch);
    const float dv = at.y() - static_cast<float>(row * kPitch);
    return std::max(0.0F, 1 - std::abs(du) / (1.5F * kPitch)) *
           std::max(0.0F, 1 - std::abs(dv) / (1.5F * kPitch));
  }

  [[nodiscard]] float length_about(int row, int column) const {
    float length = 0;
    for (const cv::Mat1f& elements : field_.elements)
      for (int r = 0; r < elements.rows; ++r)
        for (int c = 0; c < elements.cols; ++c)
          if (elements(r, c) > 0)
            length += elements(r, c) *
                      support({static_cast<float>(4 * c) + 1.5F, static_cast<float>(4 * r) + 1.5F},
                              row, column);
    return length;
  }

  [[nodiscard]] EdgeMatch match(const Placed& edge, const Eigen::Vector2f& shift,
                                float sigma) const {
    const Eigen::Vector2f at = edge.at + shift;
    return plain_match(field_, {at.x(), at.y(), edge.outward.x(), edge.outward.y(), edge.strength},
                       {offset_px_, sigma});
  }

  [[nodiscard]] float score(const Eigen::Vector2f& shift, float sigma) const {
    float sum = 0;
    for (const Placed& edge : near_) sum += edge.support * match(edge, shift, sigma).weight;
    return sum;
  }

  [[nodiscard]] Eigen::Vector2f refined(Eigen::Vector2f shift, float length) const {
    const Eigen::Vector2f start = shift;
    for (int step = 0; step < 5; ++step) {
      Eigen::Matrix2f H = Eigen::Matrix2f::Identity() * (0.02F * length);
      Eigen::Vector2f b = -0.02F * length * (shift - start);
      for (const Placed& edge : near_) {
        const EdgeMatch m = match(edge, shift, 1.5F);
        const float weight = edge.support * m.weight;
        H += weight * m.gradient() * m.gradient().transpose();
        b -= weight * m.residual * m.gradient();
      }
      shift += H.inverse() * b;
    }
    return shift;
  }

  [[nodiscard]] Eigen::Vector2f shift_of(float length) const {
    const Eigen::Vector2f none(0, 0), near = refined(none, length);
    const float unshifted = score(none, 1.5F);
    const Eigen::Vector2f fallback = score(near, 1.5F) > 1.08F * unshifted ? near : none;
    if (unshifted > 0.6F * length) return fallback;
    Eigen::Vector2f best = none;
    float most = score(none, 3.0F);
    for (float dv = -15; dv <= 15; dv += 3)
      for (float du = -15; du <= 15; du += 3) {
        const Eigen::Vector2f shift(du, dv);
        if (shift.squaredNorm() > 15 * 15) continue;
        const float value =
            score(shift, 3.0F) - 0.15F * length * shift.squaredNorm() / (15.0F * 15.0F);
        if (value > most) most = value, best = shift;
      }
    best = refined(best, length);
    const float shifted = score(best, 1.5F);
    return shifted > 1.5F * score(none, 3.0F) && shifted > 0.5F * 0.6F * length ? best : fallback;
  }

  const OutlineField& field_;
  float offset_px_;
  std::vector<Placed> edges_, near_;
};

}  // namespace

EdgeMatch plain_match(const OutlineField& field, const EdgeAt& edge, const MatchRules& rules) {
  EdgeMatch match;
  const int columns = field.distance.cols, rows = field.distance.rows;
  const auto u = static_cast<int>(edge.u), v = static_cast<int>(edge.v);
  if (!(edge.u >= 0 && edge.v >= 0 && edge.u < static_cast<float>(columns - 1) &&
        edge.v < static_cast<float>(rows - 1)))
    return match;
  cv::Mat1f corners = field.distance(cv::Rect(u, v, 2, 2)).clone();
  match.at_border = std::ranges::all_of(corners, border_of);
  if (match.at_border) std::ranges::transform(corners, corners.begin(), beyond_border);
  const float a = edge.u - static_cast<float>(u), b = edge.v - static_cast<float>(v);
  const float upper = (1 - a) * corners(0, 0) + a * corners(0, 1);
  const float lower = (1 - a) * corners(1, 0) + a * corners(1, 1);
  Eigen::Vector2f slope(
      (1 - b) * (corners(0, 1) - corners(0, 0)) + b * (corners(1, 1) - corners(1, 0)),
      (1 - a) * (corners(1, 0) - corners(0, 0)) + a * (corners(1, 1) - corners(0, 1)));
  match.distance = (1 - b) * upper + b * lower;
  match.facing = slope.x() * edge.outward_u + slope.y() * edge.outward_v;
  if (match.at_border && match.facing < 0) {  // the object of the higher number ends here
    match.distance = -match.distance, match.facing = -match.facing, slope = -slope;
  }
  match.slope_u = slope.x(), match.slope_v = slope.y();
  match.residual = match.at_border ? match.distance : match.distance - rules.offset_px;
  if (std::abs(match.residual) > 3 * rules.sigma_px) return match;
  if (match.at_border && slope.squaredNorm() >= kMostSquaredSlope) return match;
  match.weight =
      edge.strength * (match.facing > 0 ? match.facing : -rules.against * match.facing) *
      exp_of_part(-0.5F / (rules.sigma_px * rules.sigma_px) * (match.residual * match.residual));
  return match;
}

DepthEdges plain_steps(const DepthEdges& given, const Calibration& believed,
                       const DepthEdgeRules& rules) {
  return PlainSteps(given, believed, rules).find();
}

OutlineShifts plain_shifts(const DepthEdges& edges, const OutlineField& field,
                           const OutlineAlignment& alignment, const Calibration& believed) {
  if (alignment.sharpness > 0.85F || alignment.score < 0.25F) return {};
  return PlainShifts(edges, field, alignment, believed).find();
}

namespace {

struct PlainPlane {
  float rise, error;
};

/// w with planes fitted about labelled pixels, and its standard errors.
std::pair<cv::Mat1f, cv::Mat1f> fit_planes_plainly(const cv::Mat1f& w, float noise, float band_m,
                                                   cv::Mat1w& labels) {
  const cv::Mat1w given = labels.clone();
  cv::Mat1f settled(w.size(), 0.0F), error(w.size(), 0.0F);
  for (int v = 0; v < w.rows; ++v)
    for (int u = 0; u < w.cols; ++u) {
      if (given(v, u) == 0) continue;
      const float within = std::clamp(band_m * w(v, u) * w(v, u), 1.5F * noise, 4 * noise);
      const auto same = [&](int y, int x) {
        return y >= 0 && x >= 0 && y < w.rows && x < w.cols && std::abs(y - v) <= 4 &&
               std::abs(x - u) <= 4 && given(y, x) == given(v, u);
      };
      const auto fit = [&](float slope_u, float slope_v) -> std::optional<PlainPlane> {
        int labelled = 0;
        Eigen::Matrix3f A = Eigen::Matrix3f::Zero();
        Eigen::Vector3f b = Eigen::Vector3f::Zero();
        for (int y = v - 4; y <= v + 4; ++y)
          for (int x = u - 4; x <= u + 4; ++x) {
            if (!same(y, x)) continue;
            ++labelled;
            const Eigen::Vector3f at(1, static_cast<float>(x - u), static_cast<float>(y - v));
            const float rise = w(y, x) - w(v, u);
            if (std::abs(rise - slope_u * at[1] - slope_v * at[2]) > within) continue;
            A += at * at.transpose();
            b += rise * at;
          }
        if (A(0, 0) < 4 || A(0, 0) < 0.5F * static_cast<float>(labelled)) return {};
        const float determinant = A.determinant();
        if (determinant < 1.0F) return PlainPlane{b[0] / A(0, 0), 1.0F / std::sqrt(A(0, 0))};
        const float variance = (A(1, 1) * A(2, 2) - A(1, 2) * A(2, 1)) / determinant;
        A.col(0) = b;
        return PlainPlane{A.determinant() / determinant, std::sqrt(variance)};
      };
      std::optional<PlainPlane> plane = fit(0, 0);
      if (!plane) {
        std::vector<float> across, down;
        for (int y = v - 4; y <= v + 4; ++y)
          for (int x = u - 4; x <= u + 4; ++x) {
            if (same(y, x) && same(y, x + 1)) across.push_back(w(y, x + 1) - w(y, x));
            if (same(y, x) && same(y + 1, x)) down.push_back(w(y + 1, x) - w(y, x));
          }
        const auto median = [](std::vector<float>& all) {
          std::sort(all.begin(), all.end());
          return all.empty() ? 0.0F : all[all.size() / 2];
        };
        plane = fit(median(across), median(down));
      }
      if (plane) {
        settled(v, u) = w(v, u) + plane->rise;
        error(v, u) = noise * plane->error;
      } else {
        labels(v, u) = 0;
      }
    }
  return {settled, error};
}

}  // namespace

cv::Mat1f settle_plainly(const DepthEdges& edges, cv::Mat1w& labels) {
  const cv::Mat1f once = fit_planes_plainly(edges.inverse_depth, edges.noise, 1e6F, labels).first;
  auto [settled, error] = fit_planes_plainly(once, edges.noise, 0.02F, labels);
  for (int v = 0; v < labels.rows; ++v)
    for (int u = 0; u < labels.cols; ++u)
      if (error(v, u) > 0.009F * settled(v, u) * settled(v, u))
        settled(v, u) = 0.0F, labels(v, u) = 0;
  return settled;
}

}  // namespace mapscore::testing
