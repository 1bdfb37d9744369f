// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/lab/frame_boxes.hpp"

#include "eval/score/box_score.hpp"

namespace mapscore::eval {

FrameBoxes::FrameBoxes(const Recording& recording)
    : calibration_(recording.info().calibration),
      instance_count_(recording.info().table.instances.size()),
      entries_(static_cast<std::size_t>(recording.depth_count())) {}

const std::vector<Eigen::AlignedBox3d>& FrameBoxes::of(const Frame& frame) {
  Entry& entry = entries_.at(static_cast<std::size_t>(frame.depth_index));
  std::call_once(entry.made,
                 [&] { entry.boxes = truth_boxes(frame, calibration_, instance_count_); });
  return entry.boxes;
}

}  // namespace mapscore::eval
