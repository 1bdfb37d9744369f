// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/recording/stamped_lines.hpp"

#include "core/error.hpp"
#include "eval/recording/pose_text.hpp"
#include "files/file_bytes.hpp"
#include "files/text.hpp"
#include "files/text_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <sstream>

namespace mapscore::eval {

void StampedLine::refuse(const std::string& what) const {
  throw Error(fmt::format("{}:{}: {}", file, number, shown(what)));
}

double StampedLine::number_at(std::size_t word) const {
  const auto value = parse_number(words[word]);
  if (!value) refuse(fmt::format("'{}' is not a finite number; mend the line", words[word]));
  return *value;
}

Pose StampedLine::pose() const {
  PoseNumbers numbers{};
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = number_at(i + 1);
  const auto pose = pose_of(numbers);
  if (!pose) refuse("quaternion qx qy qz qw is not of length 1; normalise it");
  return *pose;
}

void read_stamped_lines(const std::filesystem::path& file, const LineFormat& format,
                        const std::function<void(const StampedLine&)>& take) {
  const std::size_t most_words = std::ranges::max(format.words);
  std::istringstream text(read_file(file));
  std::optional<double> before_s;
  std::string line;
  for (int number = 1; std::getline(text, line); ++number) {
    StampedLine cut{file.string(), number, 0.0, {}};
    std::istringstream words(line);
    for (std::string word; cut.words.size() <= most_words && words >> word;)
      cut.words.push_back(word);
    if (cut.words.empty() || cut.words[0][0] == '#') continue;
    if (std::ranges::find(format.words, cut.words.size()) == format.words.end())
      cut.refuse(fmt::format("expected {}; mend the line", format.text));
    const auto stamp_s = parse_number(cut.words[0]);
    if (!stamp_s)
      cut.refuse(
          fmt::format("'{}' is no time stamp; give seconds as a finite number", cut.words[0]));
    if (before_s && *stamp_s <= *before_s)
      cut.refuse(fmt::format("stamp {} does not come after {}; sort the lines by time", *stamp_s,
                             *before_s));
    cut.stamp_s = *stamp_s;
    before_s = stamp_s;
    take(cut);
  }
  if (!before_s) throw Error(fmt::format("{}: no lines; {}", file.string(), format.mend_empty));
}

}  // namespace mapscore::eval
