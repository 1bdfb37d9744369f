// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/study/method_check.hpp"

#include "files/suggestion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <string>
#include <vector>

namespace mapscore::eval {
namespace {

/// A misspelt one would reach the program as it is.
std::string placeholder_trouble(const std::string& word) {
  static const std::regex braced(R"(\{[A-Za-z_]+\})");
  const std::vector<std::string> known{"{trial}", "{map}", "{threads}"};
  for (std::sregex_iterator found(word.begin(), word.end(), braced), end; found != end; ++found) {
    const std::string name = found->str();
    if (std::ranges::find(known, name) != known.end()) continue;
    if (const std::string near = suggestion(name, known); near.starts_with("did you mean"))
      return fmt::format("has {}, which stands for nothing; {}", name, near);
  }
  return {};
}

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
  for (const std::string& word : words) {
    if (word.find('\0') != word.npos)
      blame_key("command", "holds a NUL byte, at which a program would end the word; remove it");
    if (const std::string trouble = placeholder_trouble(word); !trouble.empty())
      blame_key("command", trouble);
  }
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
  for (const MethodSettings& method : study.methods) {
    if (method.command) check_command(study, method, blame);
    if (study.score.unit == ScoreUnit::frame && !std::holds_alternative<AllFrames>(method.frames))
      blame(fmt::format("methods.{}.frames", method.name),
            "chooses frames of a map, and score.unit frame scores each frame by itself; leave it "
            "out, or write unit: map");
  }
}

}  // namespace mapscore::eval
