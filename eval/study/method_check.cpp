// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/study/method_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

namespace mapscore::eval {
namespace {

void check_command(const Study& study, const MethodSettings& method, const Blame& blame) {
  const auto blame_key = [&](const char* key, const std::string& problem) {
    blame(fmt::format("methods.{}.{}", method.name, key), problem);
  };
  const std::vector<std::string>& words = method.command->command;
  if (words.empty() || words.front().empty())
    blame_key("command",
              "names no program; write its words, [\"python3\", \"my_mapper.py\", \"{trial}\", "
              "\"{map}\"]");
  if (std::ranges::none_of(words,
                           [](const std::string& word) { return word.find("{map}") != word.npos; }))
    blame_key("command",
              "does not name {map}; write it where the program expects the path of the map");
  const std::string& map = method.command->map;
  if (map.find('/') != map.npos || map.starts_with('.'))
    blame_key("map",
              fmt::format("'{}' is no name of a file; write one without / that does not begin with "
                          "a dot, as voxels.csv",
                          map));
  if (study.score.unit == ScoreUnit::frame)
    blame("score.unit",
          fmt::format("frame scores each frame by itself, but methods.{}.command gives one map; "
                      "write unit: map, or leave the method out",
                      method.name));
}

}  // namespace

void check_methods(const Study& study, const Blame& blame) {
  if (study.methods.empty())
    blame("methods", "there is no method; write methods: {direct: {segmentation: {direct: {}}}}");
  for (const MethodSettings& method : study.methods)
    if (method.command) check_command(study, method, blame);
}

}  // namespace mapscore::eval
