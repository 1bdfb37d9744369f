// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/world/class_file.hpp"

#include "core/error.hpp"
#include "files/text.hpp"

#include <fmt/format.h>
#include <fnmatch.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace mapscore::sim {
namespace {

/// Reads one class file; knows file and line of what it refuses.
class Reader {
 public:
  explicit Reader(const std::filesystem::path& file) : file_(file) {}

  std::vector<ClassRule> read() {
    const YAML::Node root = parse();
    if (!root.IsMap()) refuse(root, "", "must be a map with the key `classes`");
    check_keys(root, "", {"classes"});
    const YAML::Node list = root["classes"];
    if (!list || !list.IsSequence()) refuse(root, "classes", "must be a list of classes");
    std::vector<ClassRule> rules;
    for (const YAML::Node& node : list) {
      rules.push_back(rule(node, static_cast<ClassId>(rules.size() + 1)));
    }
    return rules;
  }

 private:
  YAML::Node parse() const {
    if (!std::filesystem::exists(file_)) {
      throw Error(fmt::format("{}: no such class file; check the path", file_.string()));
    }
    try {
      return YAML::LoadFile(file_.string());
    } catch (const YAML::Exception& error) {
      throw Error(
          fmt::format("{}:{}: not valid YAML: {}", file_.string(), error.mark.line + 1, error.msg));
    }
  }

  ClassRule rule(const YAML::Node& node, ClassId id) {
    const std::string key = fmt::format("classes[{}]", id - 1);
    if (!node.IsMap()) refuse(node, key, "must be a map like {name: cup, bodies: [\"cup_*\"]}");
    check_keys(node, key, {"name", "colour", "detect", "bodies", "opaque"});
    ClassRule result;
    SemanticClass& semantic_class = result.semantic_class;
    semantic_class.id = id;
    semantic_class.name = name(node, key);
    semantic_class.colour = colour(node["colour"], key + ".colour", id);
    semantic_class.detect = flag(node["detect"], key + ".detect", true);
    result.opaque = flag(node["opaque"], key + ".opaque", false);
    result.bodies = bodies(node, key + ".bodies", semantic_class.name);
    if (const YAML::Node patterns = node["bodies"]) result.line = patterns.Mark().line + 1;
    return result;
  }

  std::string name(const YAML::Node& node, const std::string& key) {
    const YAML::Node name = node["name"];
    if (!name || !name.IsScalar()) refuse(node, key + ".name", "is missing; give the class a name");
    if (const auto unfit = unfit_as_name(name.Scalar())) refuse(name, key + ".name", *unfit);
    if (name.Scalar() == "background") {
      refuse(name, key + ".name", "`background` is what no class claims; choose another name");
    }
    if (!names_.insert(name.Scalar()).second) {
      refuse(name, key + ".name", fmt::format("class `{}` stands twice; join them", name.Scalar()));
    }
    return name.Scalar();
  }

  Colour colour(const YAML::Node& node, const std::string& key, ClassId id) const {
    if (!node) return palette_colour(id);
    const std::string text = node.IsScalar() ? node.Scalar() : "";
    const bool hex =
        text.size() == 6 && text.find_first_not_of("0123456789abcdefABCDEF") == std::string::npos;
    if (!hex) refuse(node, key, "must be six hexadecimal digits in quotes, like \"FF0000\"");
    const unsigned long rgb = std::stoul(text, nullptr, 16);
    return {static_cast<std::uint8_t>(rgb >> 16), static_cast<std::uint8_t>(rgb >> 8 & 255),
            static_cast<std::uint8_t>(rgb & 255)};
  }

  bool flag(const YAML::Node& node, const std::string& key, bool fallback) const {
    bool value = fallback;
    if (node && !YAML::convert<bool>::decode(node, value))
      refuse(node, key, "must be true or false");
    return value;
  }

  std::vector<std::string> bodies(const YAML::Node& node, const std::string& key,
                                  const std::string& name) {
    const YAML::Node list = node["bodies"];
    std::vector<std::string> patterns;
    if (!list) {
      patterns = {name, name + "_*"};
    } else if (list.IsScalar()) {
      patterns = {list.Scalar()};
    } else {
      for (const YAML::Node& item : list) {
        if (!item.IsScalar()) refuse(item, key, "must be a glob or a list of globs");
        patterns.push_back(item.Scalar());
      }
    }
    if (patterns.empty()) refuse(list, key, "is empty; name the bodies of this class");
    for (const std::string& pattern : patterns) {
      if (pattern.empty()) refuse(list, key, "holds an empty pattern; name a body");
      if (!patterns_.insert(pattern).second) {
        refuse(list ? list : node, key,
               fmt::format("pattern `{}` stands twice; keep one", pattern));
      }
    }
    return patterns;
  }

  void check_keys(const YAML::Node& node, const std::string& key,
                  const std::vector<std::string>& known) const {
    std::set<std::string> seen;
    for (const auto& entry : node) {
      const std::string name = entry.first.IsScalar() ? entry.first.Scalar() : "?";
      if (!seen.insert(name).second)
        refuse(entry.first, key.empty() ? name : key + "." + name, "stands twice; keep one");
      if (std::find(known.begin(), known.end(), name) != known.end()) continue;
      refuse(entry.first, key.empty() ? name : key + "." + name,
             fmt::format("is not a key; known here: {}", fmt::join(known, ", ")));
    }
  }

  [[noreturn]] void refuse(const YAML::Node& at, const std::string& key,
                           const std::string& why) const {
    throw Error(fmt::format("{}:{}: {}{}{}", file_.string(), at.Mark().line + 1, key,
                            key.empty() ? "" : ": ", why));
  }

  std::filesystem::path file_;
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
  return Reader(file).read();
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
