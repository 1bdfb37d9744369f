// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/faults/label_noise.hpp"

#include "core/random_stream.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace mapscore::sim {
namespace {

/// Beyond so many standard deviations the boundary does not waver outwards.
constexpr double kFarthest = 4.0;

/// What is drawn of one frame.
struct Draws {
  std::uint64_t seed, frame;
};

/// Nodes 0 .. count - 1 of one row of the lattice.
std::vector<double> node_row(const Draws& draws, InstanceId id, int row, int count) {
  RandomStream stream(draws.seed, "labels.ragged",
                      {draws.frame, id, static_cast<std::uint64_t>(row)});
  std::vector<double> nodes;
  for (int i = 0; i < count; ++i) nodes.push_back(stream.normal());
  return nodes;
}

/// A random field over the pixels of `window`, standard normal at every pixel and smooth over
/// `pitch_px`: standard normals at the nodes of a lattice anchored at pixel (0, 0), interpolated
/// bilinearly with weights of unit sum of squares. The draws are fixed by (seed, "labels.ragged",
/// frame, instance) and the node's place. `window` lies in the image.
cv::Mat1f ragged_field(const cv::Rect& window, double pitch_px, const Draws& draws, InstanceId id) {
  cv::Mat1f field(window.size());
  const int columns = static_cast<int>(window.br().x / pitch_px) + 2;
  std::vector<double> above, below;
  int above_row = -1;
  for (int v = 0; v < window.height; ++v) {
    const double y = (window.y + v) / pitch_px, fy = y - std::floor(y);
    const int row = static_cast<int>(y);
    if (row != above_row) {
      above = node_row(draws, id, row, columns);
      below = node_row(draws, id, row + 1, columns);
      above_row = row;
    }
    for (int u = 0; u < window.width; ++u) {
      const double x = (window.x + u) / pitch_px, fx = x - std::floor(x);
      const auto i = static_cast<std::size_t>(x);
      const double sum = (1 - fy) * ((1 - fx) * above[i] + fx * above[i + 1]) +
                         fy * ((1 - fx) * below[i] + fx * below[i + 1]);
      const double squares = ((1 - fy) * (1 - fy) + fy * fy) * ((1 - fx) * (1 - fx) + fx * fx);
      field(v, u) = static_cast<float>(sum / std::sqrt(squares));
    }
  }
  return field;
}

/// Makes rows and columns left of and above the image whole numbers from 0.
constexpr int kOrigin = 1 << 20;

std::vector<cv::Point> disc_of(double radius_px) {
  const int reach = static_cast<int>(radius_px);
  std::vector<cv::Point> disc;
  for (int dy = -reach; dy <= reach; ++dy)
    for (int dx = -reach; dx <= reach; ++dx)
      if (dx * dx + dy * dy <= radius_px * radius_px) disc.emplace_back(dx, dy);
  return disc;
}

/// 255 on the pixels of `window` that random discs cover; of the window's size. Every pixel of the
/// plane is the centre of a disc (dx^2 + dy^2 <= radius^2, n pixels) with the chance 1 - (1 -
/// share)^(1/n), so that every pixel is covered with the chance `share`, 0 to 1. A centre's draw is
/// fixed by (seed, purpose, frame, instance) and its place: it depends on neither window nor share.
/// Row and column of the window are above -2^20.
cv::Mat1b random_discs(const cv::Rect& window, double share, double radius_px, const Draws& draws,
                       std::string_view purpose, InstanceId id) {
  cv::Mat1b covered(window.size(), std::uint8_t{0});
  if (share <= 0.0) return covered;
  const std::vector<cv::Point> disc = disc_of(radius_px);
  const double chance =
      share >= 1.0 ? 1.0 : 1.0 - std::pow(1.0 - share, 1.0 / static_cast<double>(disc.size()));
  const cv::Rect inside({0, 0}, window.size());
  const int reach = static_cast<int>(radius_px);
  for (int v = -reach; v < window.height + reach; ++v) {
    RandomStream row(draws.seed, purpose,
                     {draws.frame, id, static_cast<std::uint64_t>(kOrigin + window.y + v)});
    row.skip(static_cast<std::uint64_t>(kOrigin + window.x - reach));
    for (int u = -reach; u < window.width + reach; ++u) {
      if (row.uniform() >= chance) continue;
      for (const cv::Point& offset : disc) {
        const cv::Point pixel = cv::Point(u, v) + offset;
        if (inside.contains(pixel)) covered(pixel) = 255;
      }
    }
  }
  return covered;
}

/// Signed distance to the boundary of a mask in pixels, positive inside. The boundary runs between
/// pixels, half a pixel from the centres to both sides; beyond the image the mask goes on.
cv::Mat1f signed_distance(const cv::Mat1b& mask) {
  cv::Mat1f inside, outside;
  cv::distanceTransform(mask, inside, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  const cv::Mat1b around = ~mask;
  cv::distanceTransform(around, outside, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  cv::Mat1f distance(mask.size());
  for (int v = 0; v < mask.rows; ++v)
    for (int u = 0; u < mask.cols; ++u)
      distance(v, u) = mask(v, u) != 0 ? inside(v, u) - 0.5F : 0.5F - outside(v, u);
  return distance;
}

/// A label image under change: whose pixels are whose, and how far beyond them the mask that holds
/// them reaches.
class Canvas {
 public:
  Canvas(const cv::Mat1w& label, const ClassTable& table)
      : label_(label.clone()),
        owned_(label.size(), std::uint8_t{0}),
        reach_(label.size(), -1.0F),
        table_(table) {}

  void miss(const Detection& detection) { label_(detection.box.rect()).setTo(0, detection.mask); }
  /// To be called for all that are not missed before any of them is redrawn.
  void own(const Detection& detection) { owned_(detection.box.rect()).setTo(255, detection.mask); }
  /// Gives the pixels of `window` where `margin` >= 0 to the instance, and takes its others.
  void redraw(const cv::Mat1w& truth, InstanceId id, const cv::Rect& window,
              const cv::Mat1f& margin) {
    for (int v = 0; v < window.height; ++v) {
      for (int u = 0; u < window.width; ++u) {
        const cv::Point at = window.tl() + cv::Point(u, v);
        if (truth(at) == id) {
          if (margin(v, u) < 0.0F) label_(at) = 0;
        } else if (owned_(at) == 0 && margin(v, u) >= 0.0F && margin(v, u) > reach_(at)) {
          label_(at) = id;
          reach_(at) = margin(v, u);
        }
      }
    }
  }
  void cut(InstanceId id, const cv::Rect& window, const cv::Mat1b& holes) {
    cv::Mat1w part = label_(window);
    part.setTo(0, holes & (part == id));
  }
  /// Islands go where no detected instance is.
  void add(InstanceId id, const cv::Rect& window, const cv::Mat1b& islands) {
    for (int v = 0; v < window.height; ++v) {
      for (int u = 0; u < window.width; ++u) {
        const cv::Point at = window.tl() + cv::Point(u, v);
        const bool free = owned_(at) == 0 && !table_.detected(table_.class_of(label_(at)));
        if (islands(v, u) != 0 && free) label_(at) = id;
      }
    }
  }
  [[nodiscard]] const cv::Mat1w& label() const { return label_; }

 private:
  cv::Mat1w label_;
  cv::Mat1b owned_;
  cv::Mat1f reach_;
  const ClassTable& table_;
};

/// The instance's box, so much wider on each side, within the image.
cv::Rect widened(const Detection& detection, double by_px, const cv::Size& image) {
  const int by = static_cast<int>(std::ceil(by_px)) + 2;
  const cv::Rect box = detection.box.rect();
  return cv::Rect(box.x - by, box.y - by, box.width + 2 * by, box.height + 2 * by) &
         cv::Rect({0, 0}, image);
}

void move_boundary(const Detection& detection, const cv::Mat1w& truth, const LabelDose& dose,
                   const Draws& draws, Canvas& canvas) {
  const double reach_px = std::max(0.0, dose.boundary_px) + kFarthest * dose.ragged_px;
  const cv::Rect window = widened(detection, reach_px, truth.size());
  cv::Mat1f margin = signed_distance(truth(window) == detection.instance);
  margin += dose.boundary_px;
  if (dose.ragged_px > 0.0)
    margin +=
        dose.ragged_px * ragged_field(window, dose.ragged_length_px, draws, detection.instance);
  canvas.redraw(truth, detection.instance, window, margin);
}

void cut_holes(const Detection& detection, const cv::Mat1w& truth, const LabelDose& dose,
               const Draws& draws, Canvas& canvas) {
  const double grown_px = std::max(0.0, dose.boundary_px) + kFarthest * dose.ragged_px;
  const cv::Rect window = widened(detection, grown_px, truth.size());
  canvas.cut(detection.instance, window,
             random_discs(window, dose.holes, dose.disc_radius_px, draws, "labels.holes",
                          detection.instance));
}

void add_islands(const Detection& detection, const cv::Mat1w& truth, const LabelDose& dose,
                 const Draws& draws, Canvas& canvas) {
  const cv::Rect window = widened(detection, dose.island_reach_px, truth.size());
  const cv::Mat1f distance = signed_distance(truth(window) == detection.instance);
  const cv::Mat1b around =
      (distance >= -dose.island_reach_px) & (distance <= -0.25 * dose.island_reach_px);
  canvas.add(detection.instance, window,
             around & random_discs(window, dose.islands, dose.disc_radius_px, draws,
                                   "labels.islands", detection.instance));
}

}  // namespace

double miss_chance(const LabelDose& dose, double area_px) {
  return std::min(1.0, dose.miss) * dose.miss_area_px / (dose.miss_area_px + area_px);
}

cv::Mat1w corrupt_labels(const cv::Mat1w& label, const ClassTable& table, const LabelDose& dose,
                         std::uint64_t seed, int frame) {
  check(dose);
  if (keeps_masks(dose)) return label;
  const Draws draws{seed, static_cast<std::uint64_t>(frame)};
  Canvas canvas(label, table);
  std::vector<Detection> kept;
  for (const Detection& detection : detections_of(label, table)) {
    RandomStream stream(seed, "labels.miss", {draws.frame, detection.instance});
    if (stream.uniform() < miss_chance(dose, cv::countNonZero(detection.mask))) {
      canvas.miss(detection);
    } else {
      canvas.own(detection);
      kept.push_back(detection);
    }
  }
  if (dose.boundary_px != 0.0 || dose.ragged_px > 0.0)
    for (const Detection& detection : kept) move_boundary(detection, label, dose, draws, canvas);
  if (dose.holes > 0.0)
    for (const Detection& detection : kept) cut_holes(detection, label, dose, draws, canvas);
  if (dose.islands > 0.0)
    for (const Detection& detection : kept) add_islands(detection, label, dose, draws, canvas);
  return canvas.label();
}

std::vector<Detection> corrupt_detections(const cv::Mat1w& label, const ClassTable& table,
                                          const LabelDose& dose, std::uint64_t seed, int frame) {
  std::vector<Detection> detections =
      detections_of(corrupt_labels(label, table, dose, seed, frame), table);
  corrupt_verdicts(detections, table, dose, seed, frame);
  return detections;
}

}  // namespace mapscore::sim
