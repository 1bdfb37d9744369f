// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "files/text_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace mapscore {
namespace {

constexpr std::string_view kBlanks = " \t\r\v\f";

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

bool TextLines::next_words(std::vector<std::string_view>& words, std::size_t most) {
  words.clear();
  while (words.empty()) {
    const auto line = next();
    if (!line) return false;
    for (std::size_t end = 0; words.size() <= most;) {
      const std::size_t from = line->find_first_not_of(kBlanks, end);
      if (from == line->npos) break;
      end = std::min(line->find_first_of(kBlanks, from), line->size());
      words.push_back(line->substr(from, end - from));
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

std::optional<std::uint32_t> parse_id(std::string_view text) {
  const auto number = parse<long long>(text);
  if (!number || *number < std::numeric_limits<std::int32_t>::min() ||
      *number > std::numeric_limits<std::uint32_t>::max())
    return std::nullopt;
  return static_cast<std::uint32_t>(*number);
}

std::string join_numbers(std::span<const double> numbers, std::string_view separator) {
  return fmt::format("{}", fmt::join(numbers, separator));
}

std::optional<double> parse_number(std::string_view text) {
  const auto number = text.starts_with('+') ? std::nullopt : parse<double>(text);
  return number && std::isfinite(*number) ? number : std::nullopt;
}

std::optional<std::vector<double>> parse_numbers(std::string_view text, std::size_t most) {
  std::vector<double> numbers;
  while (!text.empty() && numbers.size() < most) {
    const std::size_t comma = std::min(text.find(','), text.size());
    const auto number = parse_number(text.substr(0, comma));
    if (!number) return std::nullopt;
    numbers.push_back(*number);
    text.remove_prefix(std::min(comma + 1, text.size()));
  }
  return numbers;
}

}  // namespace mapscore
