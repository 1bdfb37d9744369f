// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/segmentation/detection.hpp"
#include "sim/faults/image_doses.hpp"

#include <opencv2/core.hpp>

#include <cstdint>
#include <vector>

namespace mapscore::sim {

/// Chance that an instance of so many pixels is missed: min(1, miss) A0 / (A0 + area), A0 =
/// miss_area_px.
[[nodiscard]] double miss_chance(const LabelDose& dose, double area_px);

/// The label image (instance ids) as a network would have drawn it. Only instances of detected
/// classes change; in this order: some are missed; boundaries move by boundary_px and waver by
/// ragged_px; holes are cut, islands added. A pixel whose true owner is detected and not missed
/// never goes to another instance: touching masks keep their common border. Pixels that several
/// would grow into go to the one that reaches farthest beyond them (the nearest, where nothing
/// wavers), ties to the lower id; islands take what is left, the lower id first. Draws come from
/// streams (seed, "labels.EFFECT", frame, instance); the draws of one effect depend on no dose.
/// When keeps_masks(dose) `label` itself is returned. Thread-safe. Throws Error on a bad dose.
[[nodiscard]] cv::Mat1w corrupt_labels(const cv::Mat1w& label, const ClassTable& table,
                                       const LabelDose& dose, std::uint64_t seed, int frame);

/// Classes and scores as a network would have given them, in place. The named class is drawn from
/// the true class's row of the matrix, or is wrong with the chance min(1, confusion), evenly over
/// the other detected classes (none: the class stays). Scores follow Beta(a, b), a = c m, b =
/// c (1 - m), c = score_concentration, m = score_mean or the chance r of a right class: of a right
/// class the score is drawn from Beta(a + 1, b), of a wrong one from Beta(a, b + 1), but from
/// Beta(a, b) with the chance (r - m) / (r (1 - m)) of a right class where m < r, and with (m - r)
/// / (m (1 - r)) of a wrong one where m > r. So P(right | score s) is s where m = r, else 1 - (1 -
/// r) / (1 - m) (1 - s) or r / m s. The reported score is 1 - min(1, scores) (1 - score). Streams
/// (seed, "labels.class", "labels.blind" or "labels.score", frame, instance). Throws Error on a bad
/// dose, and when the matrix has not a row for each detected class.
void corrupt_verdicts(std::vector<Detection>& detections, const ClassTable& table,
                      const LabelDose& dose, std::uint64_t seed, int frame);

/// detections_of the corrupted label image, with corrupted verdicts.
[[nodiscard]] std::vector<Detection> corrupt_detections(const cv::Mat1w& label,
                                                        const ClassTable& table,
                                                        const LabelDose& dose, std::uint64_t seed,
                                                        int frame);

}  // namespace mapscore::sim
