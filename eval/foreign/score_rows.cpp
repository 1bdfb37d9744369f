// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/foreign/score_rows.hpp"

#include "files/csv.hpp"
#include "files/file_bytes.hpp"
#include "files/refusal.hpp"
#include "files/text.hpp"
#include "files/text_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

class ScoreReader {
 public:
  ScoreReader(const fs::path& file, const std::vector<fs::path>& images,
              const std::vector<double>& stamps_s, double max_offset_s)
      : file_(file),
        images_(images),
        stamps_s_(stamps_s),
        max_offset_s_(max_offset_s),
        scores_(images.size()) {
    for (std::size_t frame = 0; frame < images.size(); ++frame)
      frame_of_name_.try_emplace(images[frame].filename().string(), frame);
  }

  std::vector<ScoreOfValue> read() {
    const std::string text = read_file(file_);
    TextLines lines(text);
    for (bool is_head = true; const auto line = lines.next();) {
      line_ = lines.number();
      const auto cells = csv_cells(*line, kCells);
      if (cells && cells->size() == 1 && cells->front().empty()) continue;
      if (!cells || cells->size() != kCells) refuse_row("expected three cells, {}", kHeads);
      if (is_head)
        take_head(*cells);
      else
        take_row(*cells);
      is_head = false;
    }
    if (line_ == 0) refuse(file_, "is empty; write {}", kHeads);
    return std::move(scores_);
  }

 private:
  static constexpr std::size_t kCells = 3;
  static constexpr const char* kHeads = "image,id,score or stamp_s,id,score";

  template <class... Args>
  [[noreturn]] void refuse_row(fmt::format_string<Args...> what, Args&&... args) const {
    refuse(file_, line_, what, std::forward<Args>(args)...);
  }

  void take_head(const std::vector<std::string>& cells) {
    by_stamp_ = cells[0] == "stamp_s";
    if ((!by_stamp_ && cells[0] != "image") || cells[1] != "id" || cells[2] != "score")
      refuse_row("the first line names other columns; write {}", kHeads);
  }

  void take_row(const std::vector<std::string>& cells) {
    const std::size_t frame = by_stamp_ ? frame_at(cells[0]) : frame_named(cells[0]);
    const auto id = parse_count(cells[1]);
    if (!id || *id > std::numeric_limits<std::uint16_t>::max())
      refuse_row("id '{}' is no pixel value; write a whole number up to 65535", shown(cells[1]));
    const auto score = parse_number(cells[2]);
    if (!score || *score < 0.0 || *score > 1.0)
      refuse_row("score '{}' is no number from 0 to 1", shown(cells[2]));
    if (!scores_[frame].emplace(static_cast<std::uint16_t>(*id), *score).second)
      refuse_row("id {} of this image stands twice; keep one", *id);
  }

  [[nodiscard]] std::size_t frame_named(const std::string& name) const {
    const auto found = frame_of_name_.find(name);
    if (found == frame_of_name_.end())
      refuse_row("there is no label image '{}'; name one as it stands in the folder, such as {}",
                 shown(name), shown(images_.front().filename().string()));
    return found->second;
  }

  /// The nearest; of two as near the earlier.
  [[nodiscard]] std::size_t frame_at(const std::string& text) const {
    const auto stamp_s = parse_number(text);
    if (!stamp_s) refuse_row("stamp '{}' is no number", shown(text));
    const auto offset_s = [&](auto stamp) { return std::abs(*stamp - *stamp_s); };
    auto nearest = std::ranges::lower_bound(stamps_s_, *stamp_s);
    if (nearest == stamps_s_.end() ||
        (nearest != stamps_s_.begin() && offset_s(nearest - 1) <= offset_s(nearest)))
      --nearest;
    if (!(offset_s(nearest) < max_offset_s_))
      refuse_row("there is no colour image within {} s of stamp {}", max_offset_s_, *stamp_s);
    return static_cast<std::size_t>(nearest - stamps_s_.begin());
  }

  const fs::path& file_;
  const std::vector<fs::path>& images_;
  const std::vector<double>& stamps_s_;
  double max_offset_s_;
  std::map<std::string, std::size_t> frame_of_name_;
  std::vector<ScoreOfValue> scores_;
  std::size_t line_ = 0;
  bool by_stamp_ = false;
};

}  // namespace

std::vector<ScoreOfValue> read_scores(const fs::path& file, const std::vector<fs::path>& images,
                                      const std::vector<double>& stamps_s, double max_offset_s) {
  return ScoreReader(file, images, stamps_s, max_offset_s).read();
}

}  // namespace mapscore::eval
