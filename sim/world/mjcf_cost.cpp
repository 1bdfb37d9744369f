// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "sim/world/costly_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mapscore::sim {
namespace {

namespace fs = std::filesystem;

/// More than this, in bytes, is much.
constexpr double kMuch = 512.0 * 1024 * 1024;
/// A picture for one side of a cube texture is stored for six, of three bytes a pixel.
constexpr double kBytesPerPixel = 18;
/// Vertices, normals, faces and the convex hull of a mesh, and the parsed text, against their
/// files.
constexpr double kBytesPerFileByte = 32;

/// Elements that cost about what their text and the files they name weigh.
constexpr auto kHarmless = std::to_array<std::string_view>(
    {"mujoco",    "compiler",  "option", "flag",     "statistic", "visual", "global",    "quality",
     "headlight", "map",       "scale",  "rgba",     "default",   "asset",  "texture",   "mesh",
     "material",  "worldbody", "body",   "frame",    "geom",      "joint",  "freejoint", "inertial",
     "site",      "camera",    "light",  "actuator", "velocity"});

struct Element {
  std::string_view name;
  std::vector<std::pair<std::string_view, std::string_view>> attributes;  ///< name and value
};

/// Walks over the opening tags of an XML text.
class Tags {
 public:
  explicit Tags(std::string_view text) : rest_(text) {}

  /// None at the end, and where the text is no plain XML.
  std::optional<Element> next() {
    while (true) {
      const std::size_t open = rest_.find('<');
      if (open == rest_.npos) return std::nullopt;
      rest_.remove_prefix(open);
      if (rest_.starts_with("<!--")) {
        plain_ = skip(4, "-->");
      } else if (rest_.starts_with("<?")) {
        plain_ = skip(2, "?>");
      } else if (rest_.starts_with("</")) {  // may not hold quotes, in which tags could hide
        plain_ =
            rest_.substr(0, rest_.find('>')).find_first_of("=\"'") == rest_.npos && skip(2, ">");
      } else {
        return element();
      }
      if (!plain_) return std::nullopt;
    }
  }

  [[nodiscard]] bool plain() const { return plain_; }

 private:
  /// Past the first `end` after `start` characters; false where there is none.
  bool skip(std::size_t start, std::string_view end) {
    const std::size_t at = rest_.find(end, start);
    if (at == rest_.npos) return false;
    rest_.remove_prefix(at + end.size());
    return true;
  }
  void skip_blanks() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(kBlanks), rest_.size()));
  }
  /// Up to one of `ends`.
  std::string_view take_until(std::string_view ends) {
    const std::string_view taken = rest_.substr(0, rest_.find_first_of(ends));
    rest_.remove_prefix(taken.size());
    return taken;
  }

  std::optional<Element> element() {
    rest_.remove_prefix(1);
    Element element{take_until(" \t\r\n\v\f/>"), {}};
    plain_ = false;
    while (true) {
      skip_blanks();
      if (rest_.starts_with('/')) rest_.remove_prefix(1);
      if (rest_.empty()) return std::nullopt;
      if (rest_.starts_with('>')) break;
      const std::string_view name = take_until(" \t\r\n\v\f=/>\"'");
      skip_blanks();
      if (name.empty() || !rest_.starts_with('=')) return std::nullopt;
      rest_.remove_prefix(1);
      skip_blanks();
      if (!rest_.starts_with('"') && !rest_.starts_with('\'')) return std::nullopt;
      const char quote = rest_.front();
      rest_.remove_prefix(1);
      const std::string_view value = take_until({&quote, 1});
      if (rest_.empty() || value.find('&') != value.npos) return std::nullopt;
      rest_.remove_prefix(1);
      element.attributes.emplace_back(name, value);
    }
    plain_ = true;
    return element;
  }

  static constexpr std::string_view kBlanks = " \t\r\n\v\f";
  std::string_view rest_;
  bool plain_ = true;
};

/// None unless all of the text is one.
std::optional<double> whole_number(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < 0) return std::nullopt;
  return value;
}

/// Pixels of a PNG file as its header says; none for other files.
std::optional<double> png_pixels(const fs::path& file) {
  std::array<unsigned char, 24> head{};
  std::ifstream(file, std::ios::binary).read(reinterpret_cast<char*>(head.data()), head.size());
  constexpr std::array<unsigned char, 4> kSignature = {0x89, 'P', 'N', 'G'};
  if (!std::equal(kSignature.begin(), kSignature.end(), head.begin())) return std::nullopt;
  const auto number = [&](std::size_t at) {
    return ((head[at] * 256.0 + head[at + 1]) * 256.0 + head[at + 2]) * 256.0 + head[at + 3];
  };
  return number(16) * number(20);
}

/// What an MJCF text makes MuJoCo do, as far as it can be told without MuJoCo.
class Cost {
 public:
  explicit Cost(const fs::path& file) : file_(file), folders_{file.parent_path()} {}

  void add(const Element& element) {
    if (std::ranges::find(kHarmless, element.name) == kHarmless.end()) unbounded_ = true;
    double area_px = 1;
    bool builtin = false;
    for (const auto& [name, value] : element.attributes) {
      if (name == "meshdir" || name == "texturedir" || name == "assetdir") {
        folders_.push_back(file_.parent_path() / value);
      } else if (name == "file" && !value.empty()) {
        named_.emplace_back(value);
      } else if (name == "builtin") {
        builtin = true;
      } else if (name == "width" || name == "height") {
        const std::optional<double> side_px = whole_number(value);
        unbounded_ = unbounded_ || !side_px;
        area_px *= side_px.value_or(0);
      } else if (name == "user" || name == "nsample" || name == "strippath" ||
                 name == "content_type" || name.starts_with("file")) {
        unbounded_ = true;
      }
    }
    if (builtin) bytes_ += kBytesPerPixel * area_px;
    unbounded_ = unbounded_ || (builtin && element.name == "mesh");
  }

  /// Once all elements are there, since folders may stand after the files in them.
  [[nodiscard]] bool much(std::size_t text_bytes) {
    bytes_ += kBytesPerFileByte * static_cast<double>(text_bytes);
    for (const std::string& name : named_)
      for (const fs::path& folder : folders_) add_file(folder / name);
    return unbounded_ || bytes_ > kMuch;
  }

 private:
  void add_file(const fs::path& file) {
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    if (!fs::exists(status) || fs::is_directory(status)) return;  // MuJoCo will say so
    if (!fs::is_regular_file(status))
      throw Error(fmt::format("{}: it names {}, which is a pipe or a device; name a regular file",
                              file_.string(), file.string()));
    const std::string kind = file.extension().string();
    if (kind == ".obj" || kind == ".stl" || kind == ".OBJ" || kind == ".STL") {
      bytes_ += kBytesPerFileByte * static_cast<double>(fs::file_size(file));
      return;
    }
    const std::optional<double> area_px = png_pixels(file);
    bytes_ += kBytesPerPixel * area_px.value_or(0);
    unbounded_ = unbounded_ || !area_px;
  }

  const fs::path& file_;
  std::vector<fs::path> folders_;
  std::vector<std::string> named_;
  double bytes_ = 0;
  bool unbounded_ = false;  ///< something there is not in `bytes_`
};

}  // namespace

bool may_cost_much(const fs::path& file) {
  if (!fs::is_regular_file(file)) return false;
  std::ifstream in(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  Tags tags(text);
  Cost cost(file);
  while (const std::optional<Element> element = tags.next()) cost.add(*element);
  return cost.much(text.size()) || !tags.plain();
}

}  // namespace mapscore::sim
