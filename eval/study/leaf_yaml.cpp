// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/study/leaf_yaml.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

namespace mapscore::eval {
namespace {

/// The whole text as a number; a leading + is allowed, as in YAML. The error code tells why not.
template <class Number>
std::errc parse_number(std::string_view text, Number& number) {
  if (text.starts_with('+')) {
    text.remove_prefix(1);
    if (text.starts_with('-')) return std::errc::invalid_argument;
  }
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc{}) return error;
  return stop == end ? std::errc{} : std::errc::invalid_argument;
}

/// ".nan", "-.inf" as in YAML, and "nan", "inf", "infinity".
bool spells_non_finite(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of("+-."), text.size()));
  double number = 0;
  return parse_number(text, number) == std::errc{} && !std::isfinite(number);
}

void refuse_outside(const YamlValue& at, double value, const std::string& text,
                    const Range& range) {
  if (range.holds(value)) return;
  at.fail(fmt::format("{} is out of range; write a number {}", text, range.text()));
}

}  // namespace

double Leaf<double>::read(const YamlValue& at, const Range& range) {
  double number = 0;
  const std::string text = at.plain_scalar("a number");
  const std::errc error = parse_number(text, number);
  if (spells_non_finite(text)) at.fail(fmt::format("is {}; write a finite number", text));
  if (error == std::errc::result_out_of_range)
    at.fail(fmt::format("{} is beyond what a double holds; write a finite number", text));
  if (error != std::errc{}) at.ask_for("a number");
  refuse_outside(at, number, text, range);
  return number == 0 ? 0 : number;  // -0 and 0 are one
}

template <WholeNumber Number>
Number Leaf<Number>::read(const YamlValue& at, const Range& range) {
  Number number = 0;
  const std::string written = at.plain_scalar("a whole number");
  const std::errc error = parse_number(written, number);
  if (error == std::errc::result_out_of_range)
    at.fail(fmt::format("{} is too great; write a whole number up to {}", written,
                        std::numeric_limits<Number>::max()));
  if (error != std::errc{}) at.ask_for("a whole number");
  refuse_outside(at, static_cast<double>(number), text(number), range);
  return number;
}
template struct Leaf<int>;
template struct Leaf<std::uint64_t>;

std::string Leaf<std::string>::read(const YamlValue& at, const Range&) {
  std::string text = at.scalar("a text");
  if (text.empty()) at.fail("is empty; write a text, or leave the key out");
  return text;
}

DetectedSet Leaf<DetectedSet>::read(const YamlValue& at, const Range& range) {
  if (at.node.IsScalar()) {
    if (at.node.Scalar() == "all") return {true, {}};
    at.ask_for("all, or a list of class names");
  }
  DetectedSet result{false, Leaf<std::vector<std::string>>::read(at, range)};
  if (result.classes.empty()) at.fail("names no class; write all, or a list of class names");
  return result;
}

std::string Leaf<DetectedSet>::text(const DetectedSet& detected) {
  return detected.all ? "all" : list_text(detected.classes);
}

ClassTitles Leaf<ClassTitles>::read(const YamlValue& at, const Range&) {
  ClassTitles titles;
  for (const auto& [name, title] : at.entries()) titles[name] = title.name();
  if (titles.empty()) at.fail("names no class; write {CLASS: TITLE, ...}, or leave the key out");
  return titles;
}

std::string Leaf<ClassTitles>::text(const ClassTitles& titles) {
  std::string text;
  for (const auto& [name, title] : titles)
    text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", yaml_text(name), yaml_text(title));
  return text.empty() ? "-" : '{' + text + '}';
}

}  // namespace mapscore::eval
