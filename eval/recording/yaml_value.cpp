// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/recording/yaml_value.hpp"

#include "core/error.hpp"
#include "eval/recording/file_bytes.hpp"
#include "eval/recording/pose_text.hpp"
#include "files/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>

namespace mapscore::eval {

void refuse_large_yaml(std::string_view text, const std::string& source) {
  constexpr std::ptrdiff_t kMostValues = 1 << 19;
  const auto separates = [](char letter) {
    return std::string_view(",:\n[{").find(letter) != std::string_view::npos;
  };
  if (std::ranges::count_if(text, separates) > kMostValues)
    throw Error(fmt::format("{}: more than {} values; is it the right file? Else shorten it",
                            source, kMostValues));
}

YamlValue YamlValue::load(const std::filesystem::path& file) {
  try {
    const std::string text = read_file(file);
    refuse_large_yaml(text, file.string());
    YamlValue value(file.string(), "", YAML::Load(text));
    if (!value.node_.IsMap()) value.refuse("not a map of keys; write key: value lines");
    return value;
  } catch (const YAML::Exception& error) {
    throw Error(fmt::format("{}:{}: broken YAML ({}); mend the line or make the file anew",
                            file.string(), std::max(error.mark.line, 0) + 1, shown(error.msg)));
  }
}

YamlValue YamlValue::at(const std::string& key) const {
  if (!node_.IsMap()) refuse(fmt::format("expected a map with key '{}'", key));
  const YAML::Node child = node_[key];
  if (!child) refuse(fmt::format("key '{}' is missing; add it", key));
  return {file_, path_.empty() ? key : path_ + "." + key, child};
}

bool YamlValue::has(const std::string& key) const {
  return node_.IsMap() && node_[key].IsDefined();
}

void YamlValue::only(std::initializer_list<std::string_view> keys) const {
  if (!node_.IsMap()) refuse("expected a map");
  std::set<std::string> seen;
  for (const auto& entry : node_) {
    const std::string& key = entry.first.Scalar();
    if (std::find(keys.begin(), keys.end(), key) == keys.end())
      refuse(fmt::format("unknown key '{}'; known are {}", key, fmt::join(keys, ", ")));
    if (!seen.insert(key).second) refuse(fmt::format("key '{}' stands twice; remove one", key));
  }
}

std::vector<YamlValue> YamlValue::items() const {
  if (!node_.IsSequence()) refuse("expected a list");
  std::vector<YamlValue> items;
  for (std::size_t i = 0; i < node_.size(); ++i)
    items.push_back({file_, fmt::format("{}[{}]", path_, i), node_[i]});
  return items;
}

std::string YamlValue::text() const {
  if (!node_.IsScalar()) refuse("expected a text");
  return node_.Scalar();
}

std::string YamlValue::name() const {
  if (const auto unfit = unfit_as_name(text())) refuse(*unfit);
  return text();
}

Colour YamlValue::colour() const {
  const std::string digits = text();
  std::uint32_t rgb = 0;
  const char* end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, rgb, 16);
  if (digits.size() != 6 || error != std::errc() || stop != end)
    refuse("expected a colour as six hexadecimal digits, \"RRGGBB\"");
  return {static_cast<std::uint8_t>(rgb >> 16), static_cast<std::uint8_t>(rgb >> 8 & 255),
          static_cast<std::uint8_t>(rgb & 255)};
}

bool YamlValue::boolean() const {
  if (!node_.IsScalar() || (node_.Scalar() != "true" && node_.Scalar() != "false"))
    refuse("expected true or false");
  return node_.Scalar() == "true";
}

double YamlValue::number() const {
  const auto number = node_.IsScalar() ? parse_number(node_.Scalar()) : std::nullopt;
  if (!number) refuse("expected a finite number; write one");
  return *number;
}

double YamlValue::positive() const {
  if (number() <= 0.0) refuse(fmt::format("{} is not above 0; write a greater number", number()));
  return number();
}

std::uint64_t YamlValue::whole(std::uint64_t low, std::uint64_t high) const {
  std::uint64_t value = 0;
  const std::string text = node_.IsScalar() ? node_.Scalar() : "";
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || stop != text.data() + text.size() || value < low ||
      value > high)
    refuse(fmt::format("expected a whole number from {} to {}", low, high));
  return value;
}

void YamlValue::refuse(const std::string& what) const {
  const std::string key = path_.empty() ? "" : path_ + ": ";
  const int line = std::max(node_.Mark().line, 0) + 1;  // an empty file has no place
  throw Error(fmt::format("{}:{}: {}{}", file_, line, key, shown(what)));
}

}  // namespace mapscore::eval
