// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"

#include <yaml-cpp/yaml.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mapscore {

/// A YAML value that knows where it was written and the dotted path of its key. Every reader throws
/// Error "SOURCE:LINE: path: what stands there; what to write" when the value is not what is asked
/// for. Not thread-safe: nodes of a document share their memory.
struct YamlValue {
  YAML::Node node;
  std::string source;  ///< a file, or a flag; may be empty
  int line = 0;        ///< from 1; 0: the source has no lines
  std::string path;

  /// Throws Error "SOURCE:LINE: path: PROBLEM", in one line that holds nothing a terminal obeys.
  /// `problem` says what is wrong and how to mend it.
  [[noreturn]] void fail(std::string_view problem) const;
  /// Fails with what stands here, asking for `wanted`.
  [[noreturn]] void ask_for(std::string_view wanted) const;

  /// Key and value of each entry, in the order of the file; values have the lines of their keys.
  /// Throws Error when this is no map, a key is no plain word or a key stands twice.
  [[nodiscard]] std::vector<std::pair<std::string, YamlValue>> entries() const;
  /// Throws as `entries`, and for a key beyond `keys`.
  void only(const std::vector<std::string>& keys) const;
  /// Value of a key that must be there, with its own line.
  [[nodiscard]] YamlValue at(const std::string& key) const;
  /// Whether this is a map with that key.
  [[nodiscard]] bool has(const std::string& key) const;
  /// Elements of a list.
  [[nodiscard]] std::vector<YamlValue> elements() const;

  /// Text of a single value that is not null; `wanted` is what to ask for otherwise.
  [[nodiscard]] std::string scalar(std::string_view wanted) const;
  /// Text of a single value written without quotes.
  [[nodiscard]] std::string plain_scalar(std::string_view wanted) const;
  [[nodiscard]] std::string text() const;
  /// A text that is fit as a name (files/text.hpp).
  [[nodiscard]] std::string name() const;
  /// Six hexadecimal digits, RRGGBB.
  [[nodiscard]] Colour colour() const;
  [[nodiscard]] bool boolean() const;
  /// A finite number.
  [[nodiscard]] double number() const;
  [[nodiscard]] double positive() const;
  [[nodiscard]] std::uint64_t whole(std::uint64_t low, std::uint64_t high) const;
};

/// The only document in a text. Throws Error naming the line on a syntax error, a tab that indents,
/// a control character, an empty text or a second document; and, before parsing, where a text could
/// have more than half a million values: yaml-cpp takes some 500 bytes for each, be it two bytes in
/// the text. The largest recording.yaml, of 65536 instances, has fewer.
[[nodiscard]] YamlValue parse_yaml(const std::string& text, const std::string& source);

/// The value of a flag `path=text`. Throws as parse_yaml, but for an empty text, without lines.
[[nodiscard]] YamlValue parse_yaml_value(const std::string& text, const std::string& source,
                                         const std::string& path);

/// The whole file, which must be a map. Throws as parse_yaml, and when it cannot be read.
[[nodiscard]] YamlValue load_yaml(const std::filesystem::path& file);

/// Where the value at a dotted path stands below `root`; where nothing stands there, its nearest
/// parent. The last key may hold dots itself. The result's path is the whole path.
[[nodiscard]] YamlValue find(const YamlValue& root, std::string_view path);

/// The text as a YAML scalar that `scalar` reads back: in double quotes unless it is a plain word.
[[nodiscard]] std::string yaml_text(std::string_view text);

/// "head.tail", or "tail" when head is empty.
[[nodiscard]] std::string join_path(std::string_view head, std::string_view tail);

}  // namespace mapscore
