// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/world/class_file.hpp"

#include "core/error.hpp"
#include "files/yaml_value.hpp"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace mapscore::sim {
namespace {

std::vector<std::string> globs_of(const YamlValue& bodies) {
  if (bodies.node.IsScalar()) return {bodies.text()};
  std::vector<std::string> globs;
  for (const YamlValue& glob : bodies.elements()) globs.push_back(glob.scalar("a glob"));
  if (globs.empty()) bodies.fail("is empty; name the bodies of this class");
  return globs;
}

/// Reads the classes of one file; knows the names and patterns that are taken.
class Reader {
 public:
  ClassRule rule(const YamlValue& item, ClassId id) {
    if (!item.node.IsMap()) item.fail("must be a map like {name: cup, bodies: [\"cup_*\"]}");
    item.only({"name", "colour", "detect", "bodies", "opaque"});
    ClassRule result;
    result.semantic_class = {id, name_of(item.at("name")), palette_colour(id), true};
    if (item.has("colour")) result.semantic_class.colour = item.at("colour").colour();
    if (item.has("detect")) result.semantic_class.detect = item.at("detect").boolean();
    if (item.has("opaque")) result.opaque = item.at("opaque").boolean();
    take_bodies(item, result);
    return result;
  }

 private:
  std::string name_of(const YamlValue& value) {
    const std::string name = value.name();
    if (name == "background")
      value.fail("`background` is what no class claims; choose another name");
    if (!names_.insert(name).second)
      value.fail(fmt::format("class `{}` stands twice; join them", name));
    return name;
  }

  void take_bodies(const YamlValue& item, ClassRule& rule) {
    const bool is_given = item.has("bodies");
    const YamlValue bodies = is_given ? item.at("bodies") : item;
    const std::string& name = rule.semantic_class.name;
    rule.bodies = is_given ? globs_of(bodies) : std::vector{name, name + "_*"};
    if (is_given) rule.line = bodies.line;
    for (const std::string& pattern : rule.bodies) {
      if (pattern.empty()) bodies.fail("holds an empty pattern; name a body");
      if (!patterns_.insert(pattern).second)
        bodies.fail(fmt::format("pattern `{}` stands twice; keep one", pattern));
    }
  }

  std::set<std::string> names_, patterns_;
};

}  // namespace

bool matches(const std::string& pattern, const std::string& body) {
  return body == "world" ? pattern == body : fnmatch(pattern.c_str(), body.c_str(), 0) == 0;
}

bool ClassRule::matches(const std::string& body) const {
  return std::ranges::any_of(
      bodies, [&](const std::string& pattern) { return sim::matches(pattern, body); });
}

std::vector<ClassRule> read_class_file(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file))
    throw Error(fmt::format("{}: no such class file; check the path", file.string()));
  const YamlValue root = load_yaml(file);
  root.only({"classes"});
  Reader reader;
  std::vector<ClassRule> rules;
  for (const YamlValue& item : root.at("classes").elements())
    rules.push_back(reader.rule(item, static_cast<ClassId>(rules.size() + 1)));
  return rules;
}

std::optional<std::filesystem::path> class_file_beside(const std::filesystem::path& scene) {
  std::filesystem::path beside = scene;
  beside.replace_extension(".classes.yaml");
  return std::filesystem::exists(beside) ? std::optional(beside) : std::nullopt;
}

std::string class_name_of_body(std::string_view body) {
  const std::size_t underscore = body.rfind('_');
  const bool numbered = underscore != std::string_view::npos && underscore > 0 &&
                        underscore + 1 < body.size() &&
                        body.find_first_not_of("0123456789", underscore + 1) == body.npos;
  return std::string(numbered ? body.substr(0, underscore) : body);
}

Colour palette_colour(ClassId id) {
  constexpr double kGoldenRatio = 0.6180339887498949;
  const double hue = 6.0 * std::fmod((id - 1) * kGoldenRatio, 1.0);
  const double value = id % 2 == 1 ? 230.0 : 170.0;
  const auto channel = [&](double centre) {
    const double away = std::abs(std::remainder(hue - centre, 6.0));
    return static_cast<std::uint8_t>(std::lround(value * std::clamp(2.0 - away, 0.15, 1.0)));
  };
  return {channel(0.0), channel(2.0), channel(4.0)};
}

}  // namespace mapscore::sim
