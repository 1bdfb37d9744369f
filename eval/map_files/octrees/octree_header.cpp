// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/map_files/octrees/octree_header.hpp"

#include "eval/map_files/refusal.hpp"
#include "files/text_rows.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <vector>

namespace mapscore::eval {
namespace {

using Words = std::vector<std::string_view>;

class HeaderParser {
 public:
  HeaderParser(std::string_view bytes, const std::filesystem::path& file)
      : lines_(bytes), file_(file) {}

  OctreeHeader parse() {
    take_first_line();
    bool ended = false;
    for (Words words; !ended && lines_.next_words(words);) {
      if (words[0] == "data")
        ended = true;
      else if (words[0] == "id")
        take_id(words);
      else if (words[0] == "size")
        take_size(words);
      else if (words[0] == "res")
        take_res(words);
    }
    if (!ended) refuse(file_, "its header has no line 'data'; is the file truncated?");
    if (!has_id_ || !has_size_ || header_.edge_m == 0.0)
      refuse(file_, "its header lacks 'id', 'size' or 'res'; write it again");
    if (header_.nodes == 0) refuse(file_, "the map is empty; give one that holds something");
    header_.bytes = lines_.taken();
    return header_;
  }

 private:
  void take_first_line() {
    const std::string_view line = lines_.next().value_or("");
    is_binary_ = line.starts_with("# Octomap OcTree binary file");
    if (!is_binary_ && !line.starts_with("# Octomap OcTree file"))
      refuse(file_,
             "no octree: its first line is none of OctoMap's; older files are brought up to date "
             "by OctoMap's convert_octree");
  }

  void take_id(const Words& words) {
    if (words.size() != 2) refuse(file_, lines_.number(), "expected 'id TYPE'");
    header_.kind = is_binary_ ? OctreeKind::binary : kind_of(words[1]);
    has_id_ = true;
  }

  [[nodiscard]] OctreeKind kind_of(std::string_view id) const {
    if (id == "OcTree" || id == "OcTreeStamped") return OctreeKind::plain;
    if (id == "ColorOcTree") return OctreeKind::colour;
    if (id == "SemanticOcTree") return OctreeKind::semantic;
    refuse(file_, lines_.number(),
           fmt::format("octrees of type {} are not read; write an OcTree, OcTreeStamped, "
                       "ColorOcTree or SemanticOcTree, or a .bt file",
                       shown(id)));
  }

  void take_size(const Words& words) {
    const auto nodes = words.size() == 2 ? parse_count(words[1]) : std::nullopt;
    if (!nodes) refuse(file_, lines_.number(), "expected 'size' and the number of nodes");
    header_.nodes = *nodes;
    has_size_ = true;
  }

  void take_res(const Words& words) {
    const auto edge_m = words.size() == 2 ? parse_real(words[1]) : std::nullopt;
    if (!edge_m || !(*edge_m > 0.0) || !std::isfinite(*edge_m))
      refuse(file_, lines_.number(), "expected 'res' and the edge of a voxel in metres, above 0");
    header_.edge_m = *edge_m;
  }

  TextLines lines_;
  const std::filesystem::path& file_;
  OctreeHeader header_;
  bool is_binary_ = false, has_id_ = false, has_size_ = false;
};

}  // namespace

OctreeHeader parse_octree_header(std::string_view bytes, const std::filesystem::path& file) {
  return HeaderParser(bytes, file).parse();
}

}  // namespace mapscore::eval
