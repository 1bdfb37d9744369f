// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "files/text_rows.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace mapscore {
namespace {

constexpr std::string_view kBlanks = " \t\r\v\f";

bool is_blank(char letter) {
  return kBlanks.find(letter) != std::string_view::npos;
}

template <class Number>
std::optional<Number> parse(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  Number number{};
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || stop != end) return std::nullopt;
  return number;
}

}  // namespace

std::optional<std::string_view> TextLines::next() {
  if (taken_ >= text_.size()) return std::nullopt;
  const std::size_t end = text_.find('\n', taken_);
  std::string_view line = text_.substr(taken_, end == text_.npos ? text_.npos : end - taken_);
  taken_ = end == text_.npos ? text_.size() : end + 1;
  ++number_;
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

bool TextLines::next_words(std::vector<std::string_view>& words) {
  words.clear();
  while (words.empty()) {
    const auto line = next();
    if (!line) return false;
    for (std::size_t from = 0; from < line->size() && words.size() <= kMostWords;) {
      if (is_blank((*line)[from])) {
        ++from;
        continue;
      }
      std::size_t end = from;
      while (end < line->size() && !is_blank((*line)[end])) ++end;
      words.push_back(line->substr(from, end - from));
      from = end;
    }
  }
  return true;
}

std::optional<double> parse_real(std::string_view text) {
  return parse<double>(text);
}

std::optional<float> parse_float(std::string_view text) {
  return parse<float>(text);
}

std::optional<std::size_t> parse_count(std::string_view text) {
  const auto number = parse<long long>(text);
  if (!number || *number < 0) return std::nullopt;
  return static_cast<std::size_t>(*number);
}

std::optional<long long> parse_whole(std::string_view text) {
  return parse<long long>(text);
}

std::string join_numbers(std::span<const double> numbers, std::string_view separator) {
  return fmt::format("{}", fmt::join(numbers, separator));
}

std::optional<double> parse_number(std::string_view text) {
  double number = 0.0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || stop != end || !std::isfinite(number)) return std::nullopt;
  return number;
}

}  // namespace mapscore
