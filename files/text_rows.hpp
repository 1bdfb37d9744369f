// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mapscore {

/// Most words of a line, and most numbers of a point, that are read: cut into its words, a line of
/// short words takes eight times its bytes.
inline constexpr std::size_t kMostWords = 1 << 20;

/// Lines of a text, one after the other, with their numbers. Ends of lines are LF or CR LF.
class TextLines {
 public:
  /// `number` is that of the first line; the text outlives this.
  explicit TextLines(std::string_view text, std::size_t number = 1)
      : text_(text), number_(number - 1) {}

  /// The next line without its end; nothing after the last.
  [[nodiscard]] std::optional<std::string_view> next();
  /// The next line that is not blank, cut into `words` at blanks; false after the last. Of a line
  /// with more words the first `most` + 1 are given.
  [[nodiscard]] bool next_words(std::vector<std::string_view>& words,
                                std::size_t most = kMostWords);

  /// Number of the line last taken.
  [[nodiscard]] std::size_t number() const { return number_; }
  /// Bytes taken so far, ends of lines included.
  [[nodiscard]] std::size_t taken() const { return taken_; }

 private:
  std::string_view text_;
  std::size_t taken_ = 0;
  std::size_t number_;
};

/// The number that is the whole of `text`; `nan`, `inf` and a leading + are read too. Nothing where
/// it is none, or beyond a double.
[[nodiscard]] std::optional<double> parse_real(std::string_view text);
/// As above in single precision, whose bits count where colours are packed into a float.
[[nodiscard]] std::optional<float> parse_float(std::string_view text);
/// The whole number from 0 to 2^63 - 1 that is the whole of `text`.
[[nodiscard]] std::optional<std::size_t> parse_count(std::string_view text);
/// The whole number that is the whole of `text`.
[[nodiscard]] std::optional<long long> parse_whole(std::string_view text);

/// The whole number of 32 bits that is the whole of `text`; negative ones in two's complement.
[[nodiscard]] std::optional<std::uint32_t> parse_id(std::string_view text);

/// Shortest texts that read back as the same doubles, with `separator` between them.
[[nodiscard]] std::string join_numbers(std::span<const double> numbers, std::string_view separator);

/// The finite number that is the whole of `text`.
[[nodiscard]] std::optional<double> parse_number(std::string_view text);
/// Finite numbers with commas between, the first `most`; nothing where one is none. A comma at the
/// end is passed over.
[[nodiscard]] std::optional<std::vector<double>> parse_numbers(std::string_view text,
                                                               std::size_t most);

}  // namespace mapscore
