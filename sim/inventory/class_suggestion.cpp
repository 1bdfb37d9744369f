// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/inventory/class_suggestion.hpp"

#include "files/text.hpp"
#include "sim/world/class_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>

namespace mapscore::sim {
namespace {

/// Endings that say what a body is for, not what it is.
constexpr std::array<std::string_view, 14> kRoles{"main",   "body",   "root",  "base",  "link",
                                                  "geom",   "visual", "vis",   "mesh",  "obj",
                                                  "object", "model",  "frame", "corpus"};
constexpr std::string_view kRoot = "root";
/// Words of what a scene is made of rather than furnished with.
constexpr std::array<std::string_view, 12> kBuilding{"wall",    "walls",   "floor",     "ground",
                                                     "ceiling", "terrain", "backwall",  "skirting",
                                                     "room",    "roof",    "baseboard", "arena"};

std::vector<std::string> words_of(std::string_view stem) {
  std::vector<std::string> words(1);
  for (const char c : stem) {
    if (c == '_')
      words.emplace_back();
    else
      words.back() += c;
  }
  return words;
}

bool number(std::string_view word) {
  return std::ranges::all_of(word, [](unsigned char c) { return std::isdigit(c) != 0; });
}

/// A counter such as 3, g0 or v12.
bool counter(std::string_view word) {
  return number(word) || (word.size() > 1 && number(word.substr(1)));
}

std::string without_number(std::string word) {
  while (word.size() > 1 && std::isdigit(static_cast<unsigned char>(word.back()))) word.pop_back();
  return word;
}

bool building(const std::string& stem) {
  return std::ranges::any_of(words_of(stem), [](const std::string& word) {
    return std::ranges::find(kBuilding, word) != kBuilding.end();
  });
}

/// The bodies of a scene as a tree.
class BodyTree {
 public:
  explicit BodyTree(const std::vector<BodyEntry>& bodies)
      : bodies_(bodies), children_(bodies.size()), drawn_(bodies.size()) {
    for (std::size_t body = bodies.size(); body-- > 0;) {  // children come after their parents
      drawn_[body] += bodies[body].drawn_geoms;
      const auto parent = static_cast<std::size_t>(bodies[body].parent);
      if (body == 0) continue;
      drawn_[parent] += drawn_[body];
      children_[parent].push_back(body);
    }
    for (auto& children : children_) std::ranges::reverse(children);
  }

  std::vector<std::size_t> objects() const {
    std::vector<std::size_t> found;
    for (const std::size_t child : children_.at(0)) add_objects(child, found);
    return found;
  }

  void add_parts(std::size_t body, std::vector<std::string>& parts) const {
    for (const std::size_t child : children_[body]) {
      if (!bodies_[child].name.empty() && bodies_[child].drawn_geoms > 0)
        parts.push_back(bodies_[child].name);
      add_parts(child, parts);
    }
  }

 private:
  void add_objects(std::size_t body, std::vector<std::size_t>& found) const {
    if (drawn_[body] == 0) return;
    if (!bodies_[body].name.empty() && !only_holds(body)) return found.push_back(body);
    for (const std::size_t child : children_[body]) add_objects(child, found);
  }

  /// True for a body without geoms and joints of its own around several that are seen.
  bool only_holds(std::size_t body) const {
    if (bodies_[body].drawn_geoms > 0 || bodies_[body].jointed) return false;
    return std::ranges::count_if(children_[body],
                                 [&](std::size_t child) { return drawn_[child] > 0; }) > 1;
  }

  const std::vector<BodyEntry>& bodies_;
  std::vector<std::vector<std::size_t>> children_;
  std::vector<int> drawn_;  ///< geoms of a body and all below it
};

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (std::string_view("*?[]\\").find(c) != std::string_view::npos) result += '\\';
    result += c;
  }
  return result;
}

/// One glob where the bodies' common beginning tells them from all others, else their names.
std::vector<std::string> patterns_for(const std::vector<std::string>& names,
                                      const std::vector<BodyEntry>& bodies) {
  std::vector<std::string> each;
  for (const std::string& name : names) each.push_back(escaped(name));
  if (names.size() < 2) return each;
  std::string_view common = names.front();
  for (const std::string& name : names) {
    const auto [end, other] = std::ranges::mismatch(common, name);
    common = common.substr(0, static_cast<std::size_t>(end - common.begin()));
  }
  while (!common.empty() && std::isdigit(static_cast<unsigned char>(common.back())))
    common.remove_suffix(1);  // chair_1, chair_12: chair_*
  if (common.empty()) return each;
  ClassRule rule;
  rule.bodies = {escaped(common) + "*"};
  const auto matched = std::ranges::count_if(
      bodies, [&](const BodyEntry& body) { return !body.name.empty() && rule.matches(body.name); });
  return static_cast<std::size_t>(matched) == names.size() ? rule.bodies : each;
}

/// What hangs on no body: most often floor and walls.
SuggestedClass world_class(const std::vector<SuggestedClass>& others) {
  SuggestedClass world;
  const bool taken = std::ranges::any_of(others, [](const auto& c) { return c.name == "world"; });
  world.name = taken ? "world_geoms" : "world";
  world.detect = std::ranges::none_of(others, &SuggestedClass::detect);
  world.bodies = {"world"};
  return world;
}

/// CIE L*a*b* of an sRGB colour, white D65 (CIE 15, IEC 61966-2-1).
Eigen::Vector3d lab_of(const Colour& colour) {
  const auto linear = [](std::uint8_t byte) {
    const double c = byte / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  Eigen::Matrix3d to_xyz;
  to_xyz << 0.4124, 0.3576, 0.1805, 0.2126, 0.7152, 0.0722, 0.0193, 0.1192, 0.9505;
  const Eigen::Vector3d rgb(linear(colour.r), linear(colour.g), linear(colour.b));
  const Eigen::Vector3d xyz = (to_xyz * rgb).cwiseQuotient(Eigen::Vector3d(0.9505, 1.0, 1.089));
  const Eigen::Vector3d f = xyz.unaryExpr([](double t) {
    return t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0;
  });
  return {116.0 * f.y() - 16.0, 500.0 * (f.x() - f.y()), 200.0 * (f.y() - f.z())};
}

struct Candidate {
  Colour colour;
  Eigen::Vector3d lab;
  double distance;  ///< to the nearest colour that is taken
};

std::vector<Candidate> candidates() {
  constexpr int kStep = 17;
  std::vector<Candidate> found;
  for (int r = 0; r < 256; r += kStep)
    for (int g = 0; g < 256; g += kStep)
      for (int b = 0; b < 256; b += kStep) {
        const Colour colour{static_cast<std::uint8_t>(r), static_cast<std::uint8_t>(g),
                            static_cast<std::uint8_t>(b)};
        const Eigen::Vector3d lab = lab_of(colour);
        if (lab.x() > 25.0 && lab.x() < 90.0) found.push_back({colour, lab, 1e9});
      }
  return found;
}

void take(const Eigen::Vector3d& lab, std::vector<Candidate>& among) {
  for (Candidate& candidate : among)
    candidate.distance = std::min(candidate.distance, (candidate.lab - lab).norm());
}

}  // namespace

std::string stem_of_body(std::string_view body) {
  const std::size_t space = body.find_last_of("/:");
  if (space != std::string_view::npos && space + 1 < body.size()) body = body.substr(space + 1);
  std::string plain;
  for (const unsigned char c : body)
    plain += std::isalnum(c) != 0 ? static_cast<char>(std::tolower(c)) : '_';
  std::vector<std::string> words = words_of(plain);
  std::erase(words, "");
  if (words.empty()) return "object";
  const auto role = [](const std::string& word) {
    return counter(word) || std::ranges::find(kRoles, without_number(word)) != kRoles.end();
  };
  while (words.size() > 1 && role(words.back())) words.pop_back();
  words.back() = without_number(words.back());
  if (words.back().size() > kRoot.size() && words.back().ends_with(kRoot))
    words.back().resize(words.back().size() - kRoot.size());  // ovenroot
  return fmt::format("{}", fmt::join(words, "_"));
}

std::vector<SuggestedClass> suggest_classes(const std::vector<BodyEntry>& bodies) {
  std::vector<SuggestedClass> classes;
  std::map<std::string, std::size_t> index;
  const BodyTree tree(bodies);
  for (const std::size_t object : tree.objects()) {
    std::string stem = stem_of_body(bodies[object].name);
    if (stem == "background") stem = "background_object";  // the name of what no class claims
    const auto [entry, fresh] = index.try_emplace(stem, classes.size());
    if (fresh) {
      classes.emplace_back();
      classes.back().name = stem;
      classes.back().detect = !building(stem);
    }
    SuggestedClass& suggested = classes[entry->second];
    suggested.bodies.push_back(bodies[object].name);
    tree.add_parts(object, suggested.parts);
  }
  if (bodies.front().drawn_geoms > 0) classes.push_back(world_class(classes));
  const std::vector<Colour> colours = separated_colours(classes.size());
  for (std::size_t i = 0; i < classes.size(); ++i) {
    classes[i].colour = colours[i];
    classes[i].patterns = patterns_for(classes[i].bodies, bodies);
  }
  return classes;
}

std::vector<Colour> separated_colours(std::size_t count) {
  std::vector<Candidate> left = candidates();
  for (const std::uint8_t grey : {0, 64, 128, 192, 255}) take(lab_of({grey, grey, grey}), left);
  std::vector<Colour> colours;
  while (colours.size() < count) {
    const auto farthest = std::ranges::max_element(left, {}, &Candidate::distance);
    colours.push_back(farthest->colour);
    take(Eigen::Vector3d(farthest->lab), left);
  }
  return colours;
}

std::string class_file_text(const std::vector<SuggestedClass>& classes, const std::string& scene) {
  std::string text = fmt::format(
      "# Classes of {}, suggested from the names of its bodies: join, rename, set `detect`.\n"
      "# A body belongs to the class that its name matches, or else to that of the body it hangs "
      "on.\n",
      shown(scene));
  if (classes.empty()) return text + "# No named body is seen.\nclasses: []\n";
  text += "classes:\n";
  for (const SuggestedClass& suggested : classes) {
    std::vector<std::string> patterns;
    for (const std::string& pattern : suggested.patterns) patterns.push_back(yaml_quoted(pattern));
    text += fmt::format("  # {}\n", shown(fmt::format("{}", fmt::join(suggested.bodies, ", "))));
    if (!suggested.parts.empty())
      text += fmt::format("  #   with {}\n",
                          shown(fmt::format("{}", fmt::join(suggested.parts, ", "))));
    text +=
        fmt::format("  - {{name: {}, colour: \"{:02X}{:02X}{:02X}\", detect: {}, bodies: [{}]}}\n",
                    yaml_quoted(suggested.name), suggested.colour.r, suggested.colour.g,
                    suggested.colour.b, suggested.detect, fmt::join(patterns, ", "));
  }
  return text;
}

}  // namespace mapscore::sim
