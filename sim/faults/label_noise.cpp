// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/faults/label_noise.hpp"

#include "core/random_stream.hpp"
#include "sim/faults/ragged_field.hpp"
#include "sim/faults/random_discs.hpp"

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
  [[nodiscard]] RandomStream stream(std::string_view purpose, InstanceId id) const {
    return {seed, purpose, {frame, id}};
  }
};

cv::Rect rect_of(const PixelBox& box) {
  return {box.u_min, box.v_min, box.width(), box.height()};
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

  void miss(const Detection& detection) { label_(rect_of(detection.box)).setTo(0, detection.mask); }
  /// To be called for all that are not missed before any of them is redrawn.
  void own(const Detection& detection) {
    owned_(rect_of(detection.box)).setTo(255, detection.mask);
  }
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
  const cv::Rect box = rect_of(detection.box);
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
    margin += dose.ragged_px * ragged_field(window, dose.ragged_length_px, draws.seed, draws.frame,
                                            detection.instance);
  canvas.redraw(truth, detection.instance, window, margin);
}

void cut_holes(const Detection& detection, const cv::Mat1w& truth, const LabelDose& dose,
               const Draws& draws, Canvas& canvas) {
  const double grown_px = std::max(0.0, dose.boundary_px) + kFarthest * dose.ragged_px;
  const cv::Rect window = widened(detection, grown_px, truth.size());
  canvas.cut(detection.instance, window,
             random_discs(window, dose.holes, dose.disc_radius_px,
                          {draws.seed, "labels.holes", draws.frame, detection.instance}));
}

void add_islands(const Detection& detection, const cv::Mat1w& truth, const LabelDose& dose,
                 const Draws& draws, Canvas& canvas) {
  const cv::Rect window = widened(detection, dose.island_reach_px, truth.size());
  const cv::Mat1f distance = signed_distance(truth(window) == detection.instance);
  const cv::Mat1b around =
      (distance >= -dose.island_reach_px) & (distance <= -0.25 * dose.island_reach_px);
  canvas.add(
      detection.instance, window,
      around & random_discs(window, dose.islands, dose.disc_radius_px,
                            {draws.seed, "labels.islands", draws.frame, detection.instance}));
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
    const double chance = draws.stream("labels.miss", detection.instance).uniform();
    const bool missed = chance < miss_chance(dose, cv::countNonZero(detection.mask));
    if (missed) canvas.miss(detection);
    if (!missed) kept.push_back(detection);
  }
  for (const Detection& detection : kept) canvas.own(detection);
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
