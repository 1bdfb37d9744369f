// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mapscore::eval {

/// A YAML value together with where it was written and the dotted path of its key, so that whoever
/// finds it wrong can say so. Not thread-safe: nodes of a document share their memory.
struct YamlAt {
  YAML::Node node;
  std::string source;  ///< a file, or a flag; may be empty
  int line = 0;        ///< from 1; 0: the source has no lines
  std::string path;

  /// Throws Error "SOURCE:LINE: path: PROBLEM". `problem` says what is wrong and how to mend it.
  [[noreturn]] void fail(std::string_view problem) const;

  /// Key and value of each entry, in the order of the file. Throws Error when this is no map, a key
  /// is no plain word or a key stands twice.
  [[nodiscard]] std::vector<std::pair<std::string, YamlAt>> entries() const;

  /// Elements of a list. Throws Error when this is none.
  [[nodiscard]] std::vector<YamlAt> elements() const;

  /// Text of a single value that is not null. Throws Error otherwise, asking for `wanted`.
  [[nodiscard]] std::string scalar(std::string_view wanted) const;

  /// Text of a single value written without quotes. Throws as `scalar`.
  [[nodiscard]] std::string plain_scalar(std::string_view wanted) const;
};

/// The only document in a text. Throws Error naming the line on a syntax error, a tab that indents,
/// a control character, an empty text or a second document.
[[nodiscard]] YamlAt parse_yaml(const std::string& text, const std::string& source);

/// The value of a flag `path=text`.
[[nodiscard]] YamlAt parse_yaml_value(const std::string& text, const std::string& source,
                                      const std::string& path);

/// Where the value at a dotted path stands below `root`; where nothing stands there, its nearest
/// parent. The last key may hold dots itself. The result's path is the whole path.
[[nodiscard]] YamlAt find(const YamlAt& root, std::string_view path);

/// The text as a YAML scalar that `scalar` reads back: in double quotes unless it is a plain word.
[[nodiscard]] std::string yaml_text(std::string_view text);

/// "did you mean 'NEAREST'?", or the choices when none is near.
[[nodiscard]] std::string suggestion(std::string_view word,
                                     const std::vector<std::string>& choices);

/// "head.tail", or "tail" when head is empty.
[[nodiscard]] std::string join_path(std::string_view head, std::string_view tail);

}  // namespace mapscore::eval
