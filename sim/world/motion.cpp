// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/world/motion.hpp"

#include "core/error.hpp"
#include "files/file_bytes.hpp"
#include "files/text.hpp"
#include "files/text_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>

namespace mapscore::sim {
namespace {

constexpr const char* kStamp = "stamp_s";

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || !std::filesystem::is_regular_file(file))
    throw Error(fmt::format("{}: no such motion file; check the path", file.string()));
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<std::string> cells_of(std::string_view line) {
  std::vector<std::string> cells(1);
  for (const char letter : line) {
    if (letter == ',')
      cells.emplace_back();
    else if (letter != '\r')
      cells.back() += letter;
  }
  return cells;
}

/// What is read of a file, line by line.
class MotionReader {
 public:
  MotionReader(const std::filesystem::path& file, std::string_view text)
      : file_(file), lines_(text) {}

  Motion read() {
    while (const auto line = lines_.next()) {
      if (line->empty() || line->front() == '#') continue;
      if (motion_.joints.empty())
        take_header(cells_of(*line));
      else
        take_row(cells_of(*line));
    }
    if (motion_.stamps_s.empty()) refuse("no rows; write a row of numbers for each stamp");
    return std::move(motion_);
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw Error(fmt::format("{}:{}: {}", file_.string(), lines_.number(), what));
  }

  void take_header(std::vector<std::string> cells) {
    if (cells.front() != kStamp || cells.size() < 2)
      refuse(fmt::format("the header is not '{},JOINT,...'; name the joints there", kStamp));
    cells.erase(cells.begin());
    for (auto name = cells.begin(); name != cells.end(); ++name)
      if (name->empty() || std::find(cells.begin(), name, *name) != name)
        refuse(fmt::format("joint '{}' stands twice or has no name; name each once", *name));
    motion_.joints = std::move(cells);
  }

  void take_row(const std::vector<std::string>& cells) {
    if (cells.size() != motion_.joints.size() + 1)
      refuse(fmt::format("{} columns, the header has {}; write a number for each joint",
                         cells.size(), motion_.joints.size() + 1));
    const double stamp_s = number(cells.front());
    if (!motion_.stamps_s.empty() && !(stamp_s > motion_.stamps_s.back()))
      refuse(fmt::format("stamp {} does not come after {}; sort the rows", stamp_s,
                         motion_.stamps_s.back()));
    motion_.stamps_s.push_back(stamp_s);
    for (std::size_t i = 1; i < cells.size(); ++i) motion_.values.push_back(number(cells[i]));
  }

  [[nodiscard]] double number(const std::string& cell) const {
    const std::optional<double> value = parse_number(cell);
    if (!value)
      refuse(fmt::format("'{}' is not a finite number; write radians or metres",
                         shown(cell.substr(0, 40))));
    return *value;
  }

  const std::filesystem::path& file_;
  TextLines lines_;
  Motion motion_;
};

}  // namespace

std::vector<double> Motion::at(double stamp_s) const {
  const auto row = [this](std::size_t n) { return values.data() + n * joints.size(); };
  const auto after = static_cast<std::size_t>(
      std::upper_bound(stamps_s.begin(), stamps_s.end(), stamp_s) - stamps_s.begin());
  const std::size_t first = after > 0 ? after - 1 : 0;
  const std::size_t second = std::min(after, stamps_s.size() - 1);
  std::vector<double> result(row(first), row(first + 1));
  if (first == second) return result;
  const double share = (stamp_s - stamps_s[first]) / (stamps_s[second] - stamps_s[first]);
  for (std::size_t joint = 0; joint < result.size(); ++joint)
    result[joint] += share * (row(second)[joint] - result[joint]);
  return result;
}

Motion read_motion(const std::filesystem::path& file) {
  const std::string bytes = bytes_of(file);
  Motion motion = MotionReader(file, bytes).read();
  motion.file = file.filename().string();
  motion.hash = hash_of(bytes);
  return motion;
}

}  // namespace mapscore::sim
