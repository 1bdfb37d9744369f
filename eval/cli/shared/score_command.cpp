// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/shared/score_command.hpp"

#include "eval/lab/map_frame.hpp"
#include "files/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <regex>
#include <string>
#include <vector>

namespace mapscore::eval {

std::string score_command(const std::filesystem::path& map, const Study& study,
                          const Recording& recording, const ClassTable& table, const Task& task,
                          double threshold) {
  const MapFrame frame = map_frame(task.config, task.seed_index);
  std::string command = fmt::format(
      "# mapscore score {} --truth {} --voxel_m {} --origin_m {} {} {} --yaw_deg {} --threshold {}",
      shell_word(map.native()), shell_word(recording.folder().native()), frame.edge_m,
      frame.origin_m.x(), frame.origin_m.y(), frame.origin_m.z(), task.config.map_yaw_deg,
      threshold);
  const ScoreSettings &score = task.config.score, usual;
  if (score.epsilon_m != usual.epsilon_m)
    command += fmt::format(" --epsilon_m {}", score.epsilon_m);
  if (score.min_samples != usual.min_samples)
    command += fmt::format(" --min_samples {}", score.min_samples);
  if (score.at_s) command += fmt::format(" --at_s {}", *score.at_s);
  if (score.unit == ScoreUnit::frame)
    command += fmt::format(" --frames {}", recording.frame_count() - 1);
  if (study.detect) {
    std::vector<std::string> names;
    for (const SemanticClass& c : table.classes)
      if (c.detect) names.push_back(std::regex_replace(c.name, std::regex(","), "\\,"));
    command += " --detect " + shell_word(fmt::format("{}", fmt::join(names, ",")));
  }
  return shown(command) + '\n';
}

}  // namespace mapscore::eval
