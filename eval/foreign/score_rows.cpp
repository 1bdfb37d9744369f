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
  ScoreReader(const fs::path& file, const std::vector<fs::path>& images, cv::Size size,
              const std::vector<double>& stamps_s, double max_offset_s)
      : file_(file),
        images_(images),
        size_(size),
        stamps_s_(stamps_s),
        max_offset_s_(max_offset_s),
        scores_(images.size()) {
    for (std::size_t frame = 0; frame < images.size(); ++frame)
      frame_of_name_.try_emplace(images[frame].filename().string(), frame);
  }

  std::vector<FrameScores> read() {
    const std::string text = read_file(file_);
    TextLines lines(text);
    for (bool is_head = true; const auto line = lines.next();) {
      line_ = lines.number();
      const auto cells = csv_cells(*line, kMostCells);
      if (cells && cells->size() == 1 && cells->front().empty()) continue;
      if (is_head) by_pixel_ = cells && cells->size() == kMostCells;
      if (!cells || cells->size() != (by_pixel_ ? kMostCells : kMostCells - 1))
        refuse_row("expected {} cells, {}", by_pixel_ ? "four" : "three", kHeads);
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
  static constexpr std::size_t kMostCells = 4;
  static constexpr const char* kHeads =
      "image,id,score or image,u,v,score, or with stamp_s in place of image";

  template <class... Args>
  [[noreturn]] void refuse_row(fmt::format_string<Args...> what, Args&&... args) const {
    refuse(file_, line_, what, std::forward<Args>(args)...);
  }

  void take_head(const std::vector<std::string>& cells) {
    by_stamp_ = cells[0] == "stamp_s";
    const bool named = by_pixel_ ? cells[1] == "u" && cells[2] == "v" : cells[1] == "id";
    if ((!by_stamp_ && cells[0] != "image") || !named || cells.back() != "score")
      refuse_row("the first line names other columns; write {}", kHeads);
  }

  void take_row(const std::vector<std::string>& cells) {
    FrameScores& scores = scores_[by_stamp_ ? frame_at(cells[0]) : frame_named(cells[0])];
    const auto score = parse_number(cells.back());
    if (!score || *score < 0.0 || *score > 1.0)
      refuse_row("score '{}' is no number from 0 to 1", shown(cells.back()));
    if (by_pixel_)
      scores.at_pixels.push_back(
          {place(cells[1], size_.width, "column"), place(cells[2], size_.height, "row"), *score});
    else
      take_value(cells[1], *score, scores);
  }

  void take_value(const std::string& text, double score, FrameScores& scores) const {
    const auto id = parse_count(text);
    if (!id || *id > std::numeric_limits<std::uint16_t>::max())
      refuse_row("id '{}' is no pixel value; write a whole number up to 65535", shown(text));
    if (!scores.of_value.emplace(static_cast<std::uint16_t>(*id), score).second)
      refuse_row("id {} of this image stands twice; keep one", *id);
  }

  /// A column or a row of the image.
  [[nodiscard]] int place(const std::string& text, int count, const char* what) const {
    const auto number = parse_count(text);
    if (!number || *number >= static_cast<std::uint64_t>(count))
      refuse_row("'{}' is no {} of the image; write a whole number up to {}", shown(text), what,
                 count - 1);
    return static_cast<int>(*number);
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
  cv::Size size_;
  const std::vector<double>& stamps_s_;
  double max_offset_s_;
  std::map<std::string, std::size_t> frame_of_name_;
  std::vector<FrameScores> scores_;
  std::size_t line_ = 0;
  bool by_stamp_ = false, by_pixel_ = false;
};

}  // namespace

std::vector<FrameScores> read_scores(const fs::path& file, const std::vector<fs::path>& images,
                                     cv::Size size, const std::vector<double>& stamps_s,
                                     double max_offset_s) {
  return ScoreReader(file, images, size, stamps_s, max_offset_s).read();
}

}  // namespace mapscore::eval
