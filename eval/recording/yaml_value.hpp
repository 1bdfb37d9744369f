// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"

#include <yaml-cpp/yaml.h>

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace mapscore::eval {

/// Throws Error naming `source` where a text of YAML could have more than half a million values:
/// yaml-cpp takes some 500 bytes for each, be it two bytes in the text. The largest recording.yaml,
/// of 65536 instances, has fewer. To be asked before parsing.
void refuse_large_yaml(std::string_view text, const std::string& source);

/// A value of a YAML file that knows where it stands. Every reader throws Error with file, line,
/// key path and mend when the value is not what is asked for.
class YamlValue {
 public:
  /// The whole file, which must be a map.
  [[nodiscard]] static YamlValue load(const std::filesystem::path& file);

  /// Value of a key that must be there.
  [[nodiscard]] YamlValue at(const std::string& key) const;
  [[nodiscard]] bool has(const std::string& key) const;
  /// Refuses keys beyond `keys`, and a key that stands twice.
  void only(std::initializer_list<std::string_view> keys) const;
  [[nodiscard]] std::vector<YamlValue> items() const;

  [[nodiscard]] std::string text() const;
  /// A text that is fit as a name (files/text.hpp).
  [[nodiscard]] std::string name() const;
  /// Six hexadecimal digits, RRGGBB.
  [[nodiscard]] Colour colour() const;
  [[nodiscard]] bool boolean() const;
  [[nodiscard]] double number() const;
  [[nodiscard]] double positive() const;
  [[nodiscard]] std::uint64_t whole(std::uint64_t low, std::uint64_t high) const;

  [[noreturn]] void refuse(const std::string& what) const;

 private:
  YamlValue(std::string file, std::string path, YAML::Node node)
      : file_(std::move(file)), path_(std::move(path)), node_(std::move(node)) {}

  std::string file_, path_;
  YAML::Node node_;
};

}  // namespace mapscore::eval
