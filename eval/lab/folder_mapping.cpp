// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/lab/folder_mapping.hpp"

#include "core/refinement/map_refinement.hpp"
#include "core/segmentation/detection.hpp"
#include "eval/lab/sights.hpp"

#include <utility>

namespace mapscore::eval {
namespace {

/// Of one frame.
struct Given {
  Sight sight;
  PoseBelief belief;
  RandomStream draws;
  cv::Mat3b color = {};  ///< empty where no refinement reads it
};

void take_into(Given& given, Mapper& mapper, MappedCounts& counts) {
  if (!mapper.takes(given.sight, given.belief)) {
    ++counts.left_out;
    return;
  }
  const std::vector<Segment> segments = mapper.integrate(given.sight, given.belief, given.draws);
  if (is_unsure(segments)) ++counts.unsure;
  for (const Segment& found : segments) {
    ++counts.detections;
    counts.points += static_cast<std::int64_t>(found.points.size());
    counts.empty += found.skipped == SkipReason::none ? 0 : 1;
  }
  if (!given.color.empty()) mapper.add_colours(given.sight, given.color, given.belief);
}

SemanticMap map_frames(const std::vector<int>& frames, const std::function<Given(int)>& give,
                       CalibrationEvidence told, std::size_t class_count,
                       const FolderMapping& mapping, MappedCounts& counts,
                       const FramesDone& shown) {
  Mapper mapper(mapping.mapping, class_count, std::move(told));
  for (const int position : frames) {
    Given given = give(position);
    take_into(given, mapper, counts);
    ++counts.frames;
    shown(static_cast<int>(counts.frames), static_cast<int>(frames.size()));
  }
  counts.hits_beyond_span = static_cast<std::int64_t>(mapper.map().hits_beyond_span());
  if (const auto* crf = std::get_if<Crf>(&mapping.refinement)) refine(mapper.map(), *crf);
  return std::move(mapper.map());
}

}  // namespace

Sight sight_of(const LabelledFolder& folder, int index) {
  ClassTable table;
  const Frame frame = folder.read(index, table);
  return {folder.calibration(), frame.depth, detections_of(frame.label, table)};
}

SemanticMap map_folder(const LabelledFolder& folder, const std::vector<int>& frames,
                       const FolderMapping& mapping, MappedCounts& counts,
                       const FramesDone& shown) {
  const auto give = [&](int index) -> Given {
    return {sight_of(folder, index),
            {mapping.T_map_world, folder.T_world_base(index)},
            RandomStream(0, "belief")};  // of a pose that is known; nothing is drawn
  };
  const Mapping& how = mapping.mapping;
  CalibrationEvidence told = first_look(how.segmentation, how.frames, folder.calibration(), frames,
                                        [&](int index) { return sight_of(folder, index); });
  return map_frames(frames, give, std::move(told), folder.table().classes.size(), mapping, counts,
                    shown);
}

SemanticMap map_trial(const TrialFolder& folder, const std::vector<int>& frames,
                      const FolderMapping& mapping, MappedCounts& counts, const FramesDone& shown) {
  const auto* crf = std::get_if<Crf>(&mapping.refinement);
  const bool reads_colour = crf != nullptr && crf->reads_colour();
  const auto give = [&](int position) -> Given {
    const TrialFrame& frame = folder.frame(position);
    return {
        folder.sight(position), frame.belief,
        RandomStream(folder.sheet().draw_seed, "belief", {static_cast<std::uint64_t>(frame.index)}),
        reads_colour ? folder.color(position) : cv::Mat3b()};
  };
  const Mapping& how = mapping.mapping;
  CalibrationEvidence told =
      first_look(how.segmentation, how.frames, folder.sheet().believed, frames,
                 [&](int position) { return folder.sight(position); });
  return map_frames(frames, give, std::move(told), folder.sheet().classes.size(), mapping, counts,
                    shown);
}

}  // namespace mapscore::eval
