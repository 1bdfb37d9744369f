// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/unseen_occluders.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace mapscore {
namespace {

/// Depths at which a near object is tried, in least ranges.
constexpr std::array kNearDepths{1.0, 0.85, 0.7, 0.6, 0.5};
constexpr double kHeld = 0.8;                 // of a run of a hole that is a whole object
constexpr double kRunsOnFrom = 1.3;           // in least ranges: a farther surface does not run on,
constexpr double kRunsOnUntil = 1.05;         // and one that does ends nearer than this
constexpr std::array kBesideRim_px{1, 4, 7};  // where masks are compared; two of three must agree
constexpr int kHoleRim_px = 11;               // near holes leave out 4 pixels at their rims

class Occluders {
 public:
  Occluders(const DepthEdges& edges, const cv::Mat1i& cells, const OutlineField& field,
            const OutlineAlignment& alignment, const Calibration& believed)
      : edges_(edges),
        cells_(cells),
        field_(field),
        offset_px_(alignment.offset_px),
        mended_(alignment.corrected(believed)) {
    const Eigen::Vector3d& t = mended_.T_color_depth.translation();
    in_rows_ = std::abs(t.x()) >= std::abs(t.y());
  }

  /// 255 on what near objects cover in the colour image.
  [[nodiscard]] cv::Mat1b covered() const {
    const cv::Mat1b& hole = edges_.near_holes;
    cv::Mat1b hit(field_.masks.rows, field_.masks.cols, std::uint8_t{0});
    const int lines = in_rows_ ? hole.rows : hole.cols, length = in_rows_ ? hole.cols : hole.rows;
    for (int line = 0; line < lines; ++line) {
      const auto is_hole = [&](int n) { return hole(place(line, n)) != 0; };
      for (int begin = 0, end = 0; begin < length; begin = end) {
        end = begin + 1;
        if (!is_hole(begin)) continue;
        while (end < length && is_hole(end)) ++end;
        if (!is_shadow(line, begin, end)) cover(line, begin, end, hit);
      }
    }
    cv::dilate(hit, hit, cv::Mat(3, 3, CV_8U, cv::Scalar(1)));
    return hit;
  }

  /// 255 on surfaces that run on into a near hole.
  [[nodiscard]] cv::Mat1b running_on() const {
    const cv::Mat1f& w = edges_.inverse_depth;
    cv::Mat1b beside, ends;
    cv::dilate(edges_.near_holes, beside, cv::Mat(kHoleRim_px, kHoleRim_px, CV_8U, cv::Scalar(1)));
    ends = (w > 1.0 / (kRunsOnUntil * mended_.range_min_m)) & beside;
    cv::Mat1b marked = ends.clone();
    const Eigen::Vector3d& t = mended_.T_color_depth.translation();
    const double nearness = (1 / kNearDepths.back() - 1 / kRunsOnFrom) / mended_.range_min_m;
    const int reach_px = static_cast<int>(std::ceil(mended_.depth.fx_px * t.norm() * nearness));
    const cv::Mat1f& on = in_rows_ ? edges_.right : edges_.down;
    const cv::Point next = place(0, 1);
    for (int v = 0; v < w.rows; ++v)
      for (int u = 0; u < w.cols; ++u) {
        if (ends(v, u) == 0) continue;
        cv::Point at(u, v);
        for (int n = 0; n < reach_px && on(at) >= 1.0F; ++n) marked(at += next) = 255;
        at = {u, v};
        for (int n = 0; n < reach_px && (in_rows_ ? at.x : at.y) > 0 && on(at - next) >= 1.0F; ++n)
          marked(at -= next) = 255;
      }
    return marked;
  }

  /// Marks what objects beside the view may hide: `from_border` pixels from where they may stand.
  void mark_beside_view(cv::Mat1b& hidden) const {
    const cv::Mat1f &w = edges_.inverse_depth, &on = in_rows_ ? edges_.right : edges_.down;
    const Eigen::Vector3d color = mended_.T_color_depth.inverse().translation();
    const double parallax_px =  // of a point at 1 m; what is nearer lies farther this way
        in_rows_ ? mended_.depth.fx_px * color.x() : mended_.depth.fy_px * color.y();
    const double nearest = 1 / mended_.range_min_m;
    const int lines = in_rows_ ? w.rows : w.cols, length = in_rows_ ? w.cols : w.rows;
    const int widest = std::min(length - 1, static_cast<int>(std::abs(parallax_px) * nearest) + 1);
    for (int line = 0; line < lines; ++line) {
      bool is_free = false;  // the surface has no mask where nothing beside the view may hide it
      for (int from_border = widest; from_border >= 0; --from_border) {
        const int n = parallax_px > 0 ? length - 1 - from_border : from_border;
        const cv::Point at = place(line, n);
        const cv::Point link = parallax_px > 0 ? place(line, n - 1) : at;  // to the pixel before
        if (from_border == widest || !(on(link) >= 1.0F)) is_free = false;
        if (!(w(at) > 0)) continue;
        if (std::abs(parallax_px) * (nearest - static_cast<double>(w(at))) <= from_border)
          is_free = owner_at(cells_(at)) == 0;
        else if (is_free && owner_at(cells_(at)) != 0)
          hidden(at) = 255;
      }
    }
  }

 private:
  /// The n-th pixel of a line along the baseline.
  [[nodiscard]] cv::Point place(int line, int n) const {
    return in_rows_ ? cv::Point(n, line) : cv::Point(line, n);
  }

  /// Whether the run [begin, end) of a hole may be a projector's shadow. Something near would
  /// cover, in the colour image, the surface on the side that the colour camera sees past it, but
  /// no more of it than a reach: the mask there is the same as beyond.
  [[nodiscard]] bool is_shadow(int line, int begin, int end) const {
    if (!is_noisy(edges_)) return false;
    const cv::Mat1f& w = edges_.inverse_depth;
    const int length = in_rows_ ? w.cols : w.rows;
    const Eigen::Vector3d& t = mended_.T_color_depth.translation();
    const double shift_px = in_rows_ ? mended_.depth.fx_px * t.x() : mended_.depth.fy_px * t.y();
    const int way = shift_px < 0 ? -1 : 1;
    const auto is_inside = [&](int n) { return n >= 0 && n < length; };
    int rim = shift_px < 0 ? begin - 1 : end;
    const int last = rim + way * kHoleRim_px;
    while (is_inside(rim) && rim != last && !(w(place(line, rim)) > 0)) rim += way;
    if (!is_inside(rim) || !(w(place(line, rim)) > 0)) return false;
    const double nearest = 1 / (kNearDepths.back() * mended_.range_min_m);
    const double reach_px =
        std::abs(shift_px) * (nearest - static_cast<double>(w(place(line, rim))));
    const int reach = static_cast<int>(std::ceil(reach_px)) + 2;
    if (!is_inside(rim + way * (kBesideRim_px.back() + reach))) return false;
    return std::ranges::count_if(kBesideRim_px, [&](int n) {
             const cv::Point near = place(line, rim + way * n),
                             beyond = place(line, rim + way * (n + reach));
             return w(near) > 0 && w(beyond) > 0 &&
                    owner_at(cells_(near)) == owner_at(cells_(beyond));
           }) > 1;
  }

  /// Marks what the run [begin, end) of a hole covers.
  void cover(int line, int begin, int end, cv::Mat1b& hit) const {
    const auto count = static_cast<std::size_t>(end - begin);
    std::vector<Eigen::Vector3d> rays;  // at 1 m, in the colour camera's axes
    for (int n = begin; n < end; ++n) {
      const cv::Point pixel = place(line, n);
      rays.emplace_back(mended_.T_color_depth.linear() *
                        mended_.depth.back_project(pixel.x, pixel.y, 1.0));
    }
    std::vector<int> cells(count), far_owners(count);
    const auto find_cells = [&](double z_m) {
      std::transform(rays.begin(), rays.end(), cells.begin(), [&](const Eigen::Vector3d& ray) {
        return cell_of(z_m * ray + mended_.T_color_depth.translation());
      });
    };
    find_cells(mended_.range_max_m);
    std::transform(cells.begin(), cells.end(), far_owners.begin(),
                   [&](int cell) { return owner_at(cell); });
    for (const double depth : kNearDepths) {
      find_cells(depth * mended_.range_min_m);
      const int middle = owner_at(cells[count / 2]);
      const auto held = static_cast<double>(std::count_if(
          cells.begin(), cells.end(), [&](int cell) { return owner_at(cell) == middle; }));
      const int whole = held >= kHeld * static_cast<double>(count) ? middle : 0;
      for (std::size_t n = 0; n < count; ++n) {
        const int owner = owner_at(cells[n]);
        if (owner != 0 && (owner == far_owners[n] || owner == whole)) hit[0][cells[n]] = 255;
      }
    }
  }

  /// The colour pixel that a point in the colour camera's frame lies in; -1 beyond the image.
  [[nodiscard]] int cell_of(const Eigen::Vector3d& point) const {
    const Eigen::Vector2d at = mended_.color.project(point);
    const double u = at.x() + 0.5, v = at.y() + 0.5;
    const cv::Size image = field_.masks.size();
    const bool within = u >= 0 && v >= 0 && u < image.width && v < image.height;
    return within ? static_cast<int>(v) * image.width + static_cast<int>(u) : -1;
  }

  /// Whose mask holds a cell, as large as its object is; 0 for none.
  [[nodiscard]] int owner_at(int cell) const {
    return cell >= 0 && field_.mask_distance[0][cell] < offset_px_ ? field_.masks[0][cell] : 0;
  }

  const DepthEdges& edges_;
  const cv::Mat1i& cells_;
  const OutlineField& field_;
  float offset_px_;
  Calibration mended_;
  bool in_rows_ = true;  ///< the baseline
};

}  // namespace

cv::Mat1b unseen_occluders(const DepthEdges& edges, const cv::Mat1i& cells,
                           const OutlineField& field, const OutlineAlignment& alignment,
                           const Calibration& believed) {
  const Occluders occluders(edges, cells, field, alignment, believed);
  cv::Mat1b hidden(cells.size(), std::uint8_t{0});
  if (!(believed.range_min_m > 0)) return hidden;
  occluders.mark_beside_view(hidden);
  if (cv::countNonZero(edges.near_holes) == 0) return hidden;
  const cv::Mat1b covered = occluders.covered();
  if (cv::countNonZero(covered) == 0) return hidden;
  const cv::Mat1b running_on = occluders.running_on();
  const std::uint8_t* const cover = covered[0];
  for (int v = 0; v < cells.rows; ++v) {
    const int* const cell = cells[v];
    const std::uint8_t* const on = running_on[v];
    std::uint8_t* const to = hidden[v];
    for (int u = 0; u < cells.cols; ++u)
      if (on[u] == 0 && cell[u] >= 0 && cover[cell[u]] != 0) to[u] = 255;
  }
  return hidden;
}

}  // namespace mapscore
