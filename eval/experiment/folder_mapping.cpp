// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/experiment/folder_mapping.hpp"

#include "core/mapping/observation.hpp"
#include "core/mapping/placement.hpp"
#include "core/refinement/map_refinement.hpp"
#include "core/segmentation/detection.hpp"
#include "core/segmentation/frame_segmentation.hpp"
#include "eval/experiment/frame_fusion.hpp"

#include <utility>

namespace mapscore::eval {
namespace {

Observation observe(const Frame& frame, const ClassTable& table, const Calibration& calibration,
                    const FolderMapping& mapping, MappedCounts& counts) {
  const std::vector<Detection> detections = detections_of(frame.label, table);
  Observation observation;
  for (Segment& found : segment_frame(detections, frame.depth, calibration, mapping.voxel_m,
                                      mapping.segmentation, mapping.place_voxels)) {
    ++counts.detections;
    counts.points += static_cast<std::int64_t>(found.points.size());
    counts.empty += found.skipped == SkipReason::none ? 0 : 1;
    observation.push_back({found.class_id, found.score,
                           std::move(mapping.place_voxels ? found.voxel_centres : found.points)});
  }
  return observation;
}

}  // namespace

SemanticMap map_folder(const LabelledFolder& folder, const std::vector<int>& frames,
                       const FolderMapping& mapping, MappedCounts& counts,
                       const std::function<void(int, int)>& shown) {
  SemanticMap map = empty_map(mapping.voxel_m, mapping.occupancy);
  const Calibration& calibration = folder.calibration();
  for (const int index : frames) {
    ClassTable table;
    const Frame frame = folder.read(index, table);
    const Observation observation = observe(frame, table, calibration, mapping, counts);
    const Pose T_map_depth = mapping.T_map_world * frame.T_world_base * calibration.T_base_depth;
    const PosedDepth seen{calibration.depth, T_map_depth, calibration.range_min_m,
                          calibration.range_max_m, frame.depth};
    fuse_frame(map, seen, place(observation, {&T_map_depth, 1}, mapping.voxel_m), 1, mapping.fusion,
               folder.table().classes.size());
    ++counts.frames;
    shown(static_cast<int>(counts.frames), static_cast<int>(frames.size()));
  }
  counts.hits_beyond_span = static_cast<std::int64_t>(map.hits_beyond_span());
  if (mapping.refinement) refine(map, mapping.refinement->rest, mapping.refinement->params);
  return map;
}

}  // namespace mapscore::eval
