// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/map_files/map_file.hpp"
#include "files/csv.hpp"
#include "files/file_bytes.hpp"
#include "files/refusal.hpp"
#include "files/text.hpp"
#include "files/text_rows.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <unordered_map>

namespace mapscore::eval {
namespace {

enum Column { kI, kJ, kK, kX, kY, kZ, kClass, kProbability, kInstance, kTouchOnly, kSamples };
constexpr std::array<std::string_view, 11> kColumns{
    "i", "j", "k", "x", "y", "z", "class", "probability", "instance", "touch_only", "samples"};

/// As many as a class table can have. Each takes some twenty times its bytes in the file.
constexpr std::size_t kMostNames = 1 << 16;
/// What a file without a header may have wanted.
constexpr std::string_view kHeaders =
    "the file has no header: write x,y,z,class above points in metres, i,j,k,class above voxels";
/// `1,1,1` and the line's end.
constexpr std::size_t kFewestRowBytes = 6;

using Cells = std::vector<std::string>;

/// One row of the file, before doubled voxels and classes are looked at.
struct Row {
  std::size_t line = 0;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  double probability = 1.0;
  VoxelKey voxel;
  std::uint32_t name = 0;
  std::uint32_t instance = 0;
  bool sampled = false;
};

class CsvReader {
 public:
  explicit CsvReader(const std::filesystem::path& file) : file_(file) {}

  MapFile read(NotFinite not_finite) {
    const std::string bytes = read_file(file_);
    std::string_view text = bytes;
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    rows_.reserve(std::min(static_cast<std::size_t>(std::ranges::count(text, '\n')) + 1,
                           text.size() / kFewestRowBytes + 1));
    TextLines lines(text);
    while (const auto line = lines.next()) {
      line_ = lines.number();
      const auto cells = csv_cells(*line, kColumns.size());
      if (!cells) refuse_row("a quote is not closed, or text follows it");
      if (cells->size() > kColumns.size())
        refuse_row("more than {} cells; the columns of a map are {}", kColumns.size(),
                   fmt::join(kColumns, ", "));
      if (cells->size() == 1 && cells->front().empty()) continue;
      if (!has_columns_ && take_columns(*cells)) continue;
      take_row(*cells);
    }
    if (rows_.empty() && has_header_) throw EmptyMap(file_.string() + ": the map is empty");
    if (rows_.empty()) refuse(file_, "the map is empty");
    if (has(kI)) drop_doubled();
    if (has(kX)) drop_not_finite(not_finite);
    return map();
  }

 private:
  template <class... Args>
  [[noreturn]] void refuse_row(fmt::format_string<Args...> what, Args&&... args) const {
    refuse(file_, line_, what, std::forward<Args>(args)...);
  }
  [[nodiscard]] bool has(Column column) const { return column_[column] >= 0; }
  [[nodiscard]] const std::string& cell(const Cells& cells, Column column) const {
    return cells[static_cast<std::size_t>(column_[column])];
  }

  /// Takes the first line's columns; false when it is a row already.
  bool take_columns(const Cells& cells) {
    has_columns_ = true;
    column_count_ = cells.size();
    column_.fill(-1);
    has_header_ = !parse_real(cells[0]);
    if (has_header_) {
      for (std::size_t n = 0; n < cells.size(); ++n) take_column(cells[n], static_cast<int>(n));
    } else {
      constexpr std::array kInOrder{kI, kJ, kK, kClass, kProbability, kInstance};
      if (cells.size() < 3 || cells.size() > kInOrder.size())
        refuse_row("{} cells, and {}, each with probability and instance if wanted", cells.size(),
                   kHeaders);
      for (std::size_t n = 0; n < cells.size(); ++n) column_[kInOrder[n]] = static_cast<int>(n);
    }
    const bool voxels = has(kI) && has(kJ) && has(kK), points = has(kX) && has(kY) && has(kZ);
    if (voxels == points || has(kI) != voxels || has(kX) != points)
      refuse_row("the header needs i,j,k of voxels or x,y,z of points");
    return has_header_;
  }

  void take_column(const std::string& name, int n) {
    const auto found = std::ranges::find(kColumns, lower_case(name));
    if (found == kColumns.end())
      refuse_row("unknown column {}; known are {}", excerpt(name), fmt::join(kColumns, ", "));
    int& column = column_[static_cast<std::size_t>(found - kColumns.begin())];
    if (column >= 0) refuse_row("column {} stands twice", excerpt(name));
    column = n;
  }

  void take_row(const Cells& cells) {
    if (cells.size() != column_count_)
      refuse_row("{} cells, the first line has {}", cells.size(), column_count_);
    Row row;
    row.line = line_;
    if (has(kI))
      row.voxel = {index(cells, kI), index(cells, kJ), index(cells, kK)};
    else
      row.point = {number(cells, kX), number(cells, kY), number(cells, kZ)};
    if (has(kClass)) row.name = name(cell(cells, kClass));
    if (has(kProbability)) row.probability = probability(cells);
    if (has(kInstance)) row.instance = whole(cells, kInstance);
    if (has(kSamples)) row.sampled = whole(cells, kSamples) > 0;
    if (has(kTouchOnly) && whole(cells, kTouchOnly) > 1) refuse_row("touch_only is 0 or 1");
    rows_.push_back(row);
  }

  [[nodiscard]] double number(const Cells& cells, Column column) const {
    const auto value = parse_real(cell(cells, column));
    if (!value) refuse_row("{} {} is no number", kColumns[column], excerpt(cell(cells, column)));
    return *value;
  }
  [[nodiscard]] std::int32_t index(const Cells& cells, Column column) const {
    const auto value = parse_whole(cell(cells, column));
    if (!value || *value < -kFarthestIndex || *value > kFarthestIndex)
      refuse_row("{} {} is no whole number within +-{}{}{}", kColumns[column],
                 excerpt(cell(cells, column)), kFarthestIndex, has_header_ ? "" : "; ",
                 has_header_ ? "" : kHeaders);
    return static_cast<std::int32_t>(*value);
  }
  [[nodiscard]] std::uint32_t whole(const Cells& cells, Column column) const {
    const auto value = parse_count(cell(cells, column));
    if (!value || *value > std::numeric_limits<std::uint32_t>::max())
      refuse_row("{} {} is no whole number from 0 up", kColumns[column],
                 excerpt(cell(cells, column)));
    return static_cast<std::uint32_t>(*value);
  }
  [[nodiscard]] double probability(const Cells& cells) const {
    const double value = number(cells, kProbability);
    if (!(value >= 0.0 && value <= 1.0)) refuse_row("probability {} is not in [0, 1]", value);
    return value;
  }
  [[nodiscard]] std::uint32_t name(const std::string& text) {
    if (text.empty()) refuse_row("the class is empty; write background where there is none");
    const auto next = static_cast<std::uint32_t>(names_.size());
    const auto [entry, is_new] = index_of_name_.try_emplace(text, next);
    if (is_new) names_.push_back(text);
    if (names_.size() > kMostNames)
      refuse_row("more than {} different classes; is the column `class` one of classes?",
                 kMostNames);
    return entry->second;
  }

  /// Keeps one row a voxel.
  void drop_doubled() {
    std::vector<std::size_t> order(rows_.size());
    for (std::size_t n = 0; n < order.size(); ++n) order[n] = n;
    std::ranges::stable_sort(order, {}, [&](std::size_t n) { return rows_[n].voxel; });
    std::vector<bool> dropped(rows_.size(), false);
    std::size_t kept = order[0];
    for (std::size_t n = 1; n < order.size(); ++n) {
      if (rows_[order[n]].voxel != rows_[kept].voxel) {
        kept = order[n];
        continue;
      }
      const bool later = owner_is_later(rows_[kept], rows_[order[n]]);
      dropped[later ? kept : order[n]] = true;
      if (later) kept = order[n];
    }
    std::size_t n = 0;
    std::erase_if(rows_, [&](const Row&) { return dropped[n++]; });
  }

  /// Of two rows of one voxel in the truth's table. Throws Error for other tables.
  [[nodiscard]] bool owner_is_later(const Row& kept, const Row& later) const {
    if (!has(kSamples) || kept.name == later.name || (kept.sampled && later.sampled)) {
      const VoxelKey& v = later.voxel;
      refuse(file_, later.line, "voxel {},{},{} stands at {}:{} already; keep one", v.i, v.j, v.k,
             file_.string(), kept.line);
    }
    return later.sampled;
  }

  void drop_not_finite(NotFinite not_finite) {
    const std::size_t all = rows_.size();
    std::erase_if(rows_, [](const Row& row) { return !row.point.allFinite(); });
    const std::size_t dropped = all - rows_.size();
    if (dropped > 0 && not_finite == NotFinite::refuse)
      refuse(file_, "{} of {} points are not finite; leave them out with --skip_nan", dropped, all);
    if (rows_.empty()) refuse(file_, "the map is empty: none of its {} points is finite", all);
  }

  [[nodiscard]] MapFile map() {
    MapFile map;
    for (const Row& row : rows_) {
      if (has(kI)) map.voxels.push_back(row.voxel);
      if (has(kX)) map.points.push_back(row.point);
      if (has(kProbability)) map.probabilities.push_back(row.probability);
      if (has(kInstance)) map.instances.push_back(row.instance);
      if (has(kClass)) map.labels.push_back(row.name);
    }
    if (has(kClass)) give_labels_their_kind(map);
    return map;
  }

  /// Ids when every name in the file is a whole number, else names.
  void give_labels_their_kind(MapFile& map) {
    std::vector<std::uint32_t> ids;
    for (const std::string& text : names_) {
      const auto id = parse_id(text);
      if (!id) break;
      ids.push_back(*id);
    }
    if (ids.size() == names_.size()) {
      map.label_kind = LabelKind::id;
      for (std::uint32_t& label : map.labels) label = ids[label];
    } else {
      map.label_kind = LabelKind::name;
      map.names = std::move(names_);
    }
  }

  const std::filesystem::path& file_;
  std::size_t line_ = 0;
  bool has_columns_ = false, has_header_ = false;
  std::size_t column_count_ = 0;
  std::array<int, kColumns.size()> column_{};
  std::vector<Row> rows_;
  std::vector<std::string> names_;
  std::unordered_map<std::string, std::uint32_t> index_of_name_;
};

}  // namespace

MapFile read_voxel_csv(const std::filesystem::path& file, NotFinite not_finite) {
  return CsvReader(file).read(not_finite);
}

}  // namespace mapscore::eval
