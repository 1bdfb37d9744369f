// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "files/yaml_value.hpp"

#include "core/error.hpp"
#include "files/file_bytes.hpp"
#include "files/suggestion.hpp"
#include "files/text.hpp"
#include "files/text_rows.hpp"

#include <fmt/format.h>
#include <yaml-cpp/anchor.h>
#include <yaml-cpp/eventhandler.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <set>
#include <sstream>

namespace mapscore {
namespace {

std::string describe(const YAML::Node& node) {
  if (node.IsMap()) return "is a section";
  if (node.IsSequence()) return "is a list";
  return node.IsScalar() ? fmt::format("is {}", yaml_text(node.Scalar())) : "has no value";
}

int line_of(const YAML::Mark& mark) {
  return mark.is_null() ? 0 : mark.line + 1;
}

/// Line of a key or a value below `parent`.
int line_below(const YamlValue& parent, const YAML::Node& node) {
  return parent.line > 0 ? line_of(node.Mark()) : 0;
}

std::string located(const std::string& source, int line) {
  if (source.empty()) return "";
  return line > 0 ? fmt::format("{}:{}: ", shown(source), line) : shown(source) + ": ";
}

void refuse_large(const std::string& text, const std::string& source) {
  constexpr std::ptrdiff_t kMostValues = 1 << 19;
  const auto separates = [](char letter) {
    return std::string_view(",:\n[{").find(letter) != std::string_view::npos;
  };
  if (std::ranges::count_if(text, separates) > kMostValues)
    throw Error(fmt::format("{}more than {} values; is it the right file? Else shorten it",
                            located(source, 0), kMostValues));
}

/// What the parser would pass over in silence or report in the dark.
void refuse_hidden_characters(const std::string& text, const std::string& source) {
  int line = 1;
  bool indenting = true;
  for (const char c : text) {
    if (c == '\t' && indenting)
      throw Error(located(source, line) + "a tab indents this line; indent with spaces");
    if (static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n' && c != '\r')
      throw Error(fmt::format("{}control character 0x{:02x}; remove it", located(source, line),
                              static_cast<int>(c)));
    if (c == '\n') ++line;
    indenting = c == '\n' || (indenting && c == ' ');
  }
}

/// Hears where documents start and nothing else.
class DocumentStarts : public YAML::EventHandler {
 public:
  void OnDocumentStart(const YAML::Mark& mark) override { last_ = mark; }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t,
                const std::string&) override {}
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {}
  void OnMapEnd() override {}

  [[nodiscard]] const YAML::Mark& last() const { return last_; }

 private:
  YAML::Mark last_;
};

/// Stops at the second document: YAML::Load passes over it, and YAML::LoadAll of yaml-cpp 0.7 never
/// ends on a stray comma where a document begins.
void refuse_second_document(const std::string& text, const std::string& source, bool lines) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  DocumentStarts starts;
  if (!parser.HandleNextDocument(starts) || !parser.HandleNextDocument(starts)) return;
  throw Error(located(source, lines ? line_of(starts.last()) : 0) +
              "a second document begins, or a stray character ends the first; keep one document");
}

/// Null when there is nothing in the text.
YAML::Node load_one(const std::string& text, const std::string& source, bool lines) {
  refuse_large(text, source);
  refuse_hidden_characters(text, source);
  try {
    refuse_second_document(text, source, lines);
    return YAML::Load(text);
  } catch (const YAML::Exception& error) {
    throw Error(fmt::format("{}not YAML: {}; mend the syntax near here",
                            located(source, lines ? line_of(error.mark) : 0), shown(error.msg)));
  }
}

/// Whether YAML reads the text as itself: no mark, no null.
bool is_plain_word(std::string_view text) {
  return is_word(text, "_-./") && text.front() != '-' && text != "null" && text != "Null" &&
         text != "NULL" && text != "...";
}

/// The number of digits alone that is the whole of `text`.
std::optional<std::uint64_t> digits_of(std::string_view text, int base) {
  std::uint64_t value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value, base);
  return error == std::errc() && stop == end ? std::optional(value) : std::nullopt;
}

}  // namespace

void YamlValue::fail(std::string_view problem) const {
  const std::string key = path.empty() ? "" : shown(path) + ": ";
  throw Error(located(source, line) + key + shown(problem));
}

void YamlValue::ask_for(std::string_view wanted) const {
  fail(fmt::format("{}; write {}", describe(node), wanted));
}

std::vector<std::pair<std::string, YamlValue>> YamlValue::entries() const {
  if (!node.IsMap()) ask_for("a section, key: value");
  std::vector<std::pair<std::string, YamlValue>> result;
  std::set<std::string_view> seen;
  for (const auto& entry : node) {
    if (!entry.first.IsScalar()) fail("a key is not a word; write key: value");
    const std::string& key = entry.first.Scalar();
    YamlValue value{entry.second, source, line_below(*this, entry.first), join_path(path, key)};
    if (!seen.insert(key).second) value.fail(fmt::format("key '{}' stands twice; keep one", key));
    result.emplace_back(key, std::move(value));
  }
  return result;
}

void YamlValue::only(const std::vector<std::string>& keys) const {
  for (const auto& [key, value] : entries())
    if (std::ranges::find(keys, key) == keys.end())
      value.fail(fmt::format("unknown key '{}'; {}", key, suggestion(key, keys)));
}

YamlValue YamlValue::at(const std::string& key) const {
  if (!node.IsMap()) ask_for("a section, key: value");
  const YAML::Node child = node[key];
  if (!child) fail(fmt::format("'{0}' is missing; write {0}: ...", key));
  // Where there is no value, the parser's mark is of what comes next.
  YAML::Node placed = child;
  if (child.IsNull())
    for (const auto& member : node)
      if (member.first.Scalar() == key) placed.reset(member.first);
  return {child, source, line_below(*this, placed), join_path(path, key)};
}

bool YamlValue::has(const std::string& key) const {
  return node.IsMap() && node[key].IsDefined();
}

std::vector<YamlValue> YamlValue::elements() const {
  if (!node.IsSequence()) ask_for("a list, [a, b, ...]");
  std::vector<YamlValue> result;
  for (const auto& element : node)
    result.push_back(
        {element, source, line_below(*this, element), fmt::format("{}[{}]", path, result.size())});
  return result;
}

std::string YamlValue::scalar(std::string_view wanted) const {
  if (!node.IsScalar()) ask_for(wanted);
  return node.Scalar();
}

std::string YamlValue::plain_scalar(std::string_view wanted) const {
  std::string text = scalar(wanted);
  if (node.Tag() == "!")  // as quotes leave it
    fail(fmt::format("is the text {}; write {}, without quotes", yaml_text(text), wanted));
  return text;
}

std::string YamlValue::text() const {
  return scalar("a text");
}

std::string YamlValue::name() const {
  std::string name = scalar("a name");
  if (const auto unfit = unfit_as_name(name)) fail(*unfit);
  return name;
}

Colour YamlValue::colour() const {
  constexpr const char* kWanted = "six hexadecimal digits in quotes, like \"FF0000\"";
  const std::string digits = scalar(kWanted);
  const auto rgb = digits_of(digits, 16);
  if (digits.size() != 6 || !rgb) ask_for(kWanted);
  return {static_cast<std::uint8_t>(*rgb >> 16), static_cast<std::uint8_t>(*rgb >> 8 & 255),
          static_cast<std::uint8_t>(*rgb & 255)};
}

bool YamlValue::boolean() const {
  const std::string word = scalar("true or false");
  if (word != "true" && word != "false") ask_for("true or false");
  return word == "true";
}

double YamlValue::number() const {
  const auto number = parse_number(scalar("a finite number"));
  if (!number) ask_for("a finite number");
  return *number;
}

double YamlValue::positive() const {
  const double value = number();
  if (value <= 0.0) fail(fmt::format("{} is not above 0; write a greater number", value));
  return value;
}

std::uint64_t YamlValue::whole(std::uint64_t low, std::uint64_t high) const {
  const std::string wanted = fmt::format("a whole number from {} to {}", low, high);
  const auto value = digits_of(scalar(wanted), 10);
  if (!value || *value < low || *value > high) ask_for(wanted);
  return *value;
}

YamlValue parse_yaml(const std::string& text, const std::string& source) {
  const YAML::Node node = load_one(text, source, true);
  if (node.IsNull()) throw Error(located(source, 1) + "the file is empty; write key: value");
  return {node, source, std::max(1, line_of(node.Mark())), ""};
}

YamlValue parse_yaml_value(const std::string& text, const std::string& source,
                           const std::string& path) {
  // A plain word is itself: a sweep reads every value of every cell here.
  if (is_plain_word(text)) return {YAML::Node(text), source, 0, path};
  return {load_one(text, source, false), source, 0, path};
}

YamlValue load_yaml(const std::filesystem::path& file) {
  YamlValue root = parse_yaml(read_file(file), file.string());
  if (!root.node.IsMap()) root.ask_for("a section, key: value");
  return root;
}

YamlValue find(const YamlValue& root, std::string_view path) {
  YamlValue at = root;
  std::string_view rest = path;
  while (!rest.empty() && at.node.IsMap()) {
    const auto children = at.entries();
    const auto child = std::ranges::find_if(children, [&](const auto& entry) {
      return entry.first == rest || entry.first == rest.substr(0, rest.find('.'));
    });
    if (child == children.end()) break;
    at = child->second;
    rest.remove_prefix(std::min(rest.size(), child->first.size() + 1));
  }
  at.path = path;
  return at;
}

std::string yaml_text(std::string_view text) {
  return is_plain_word(text) ? std::string(text) : yaml_quoted(text);
}

std::string join_path(std::string_view head, std::string_view tail) {
  return head.empty() ? std::string(tail) : fmt::format("{}.{}", head, tail);
}

}  // namespace mapscore
