// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/lab/trial_run.hpp"
#include "eval/report/figures/script.hpp"
#include "eval/report/tables/table.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace mapscore::eval {

/// One frame as one method mapped it.
struct FrameFigures {
  int frame = 0;  ///< index in the recording
  double stamp_s = 0.0;
  std::int64_t predicted = 0, true_predicted = 0, visible = 0, found = 0;  ///< detected classes
  FrameTimes times;
};

[[nodiscard]] FrameFigures figures_of(const FrameResult& frame, const ClassTable& table);

/// What one method made of each frame of a recording.
struct MethodFrames {
  std::string method;
  std::vector<FrameFigures> frames;
};

/// Number of voxels, precision, recall and processor time of every frame over the time of the
/// recording, one curve for each method: figures 8 to 10 of [M], with accuracy added. Pooled over
/// the detected classes; tolerance 0.
[[nodiscard]] FigureSheet frames_figure(const Study& study, const ClassTable& table,
                                        std::span<const MethodFrames> methods,
                                        const FigureStyle& style = {});

/// Greatest, mean, least and standard deviation of the processor time of a frame (milliseconds), as
/// in table 1 of [M], voxels of a frame, and precision, recall and F1 of all frames together.
/// Frames without a detection count.
[[nodiscard]] Table frames_table(std::span<const MethodFrames> methods);

}  // namespace mapscore::eval
