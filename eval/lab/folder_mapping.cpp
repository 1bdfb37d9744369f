// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/lab/folder_mapping.hpp"

#include "core/refinement/map_refinement.hpp"
#include "core/segmentation/detection.hpp"

#include <utility>

namespace mapscore::eval {

SemanticMap map_folder(const LabelledFolder& folder, const std::vector<int>& frames,
                       const FolderMapping& mapping, MappedCounts& counts,
                       const std::function<void(int, int)>& shown) {
  Mapper mapper(mapping.mapping, folder.table().classes.size());
  RandomStream draws(0, "belief");  // of a pose that is known; nothing is drawn
  for (const int index : frames) {
    ClassTable table;
    const Frame frame = folder.read(index, table);
    const Sight sight(folder.calibration(), frame.depth, detections_of(frame.label, table));
    for (const Segment& found :
         mapper.integrate(sight, {mapping.T_map_world, frame.T_world_base}, draws)) {
      ++counts.detections;
      counts.points += static_cast<std::int64_t>(found.points.size());
      counts.empty += found.skipped == SkipReason::none ? 0 : 1;
    }
    ++counts.frames;
    shown(static_cast<int>(counts.frames), static_cast<int>(frames.size()));
  }
  counts.hits_beyond_span = static_cast<std::int64_t>(mapper.map().hits_beyond_span());
  if (const auto* crf = std::get_if<Crf>(&mapping.refinement)) refine(mapper.map(), *crf);
  return std::move(mapper.map());
}

}  // namespace mapscore::eval
