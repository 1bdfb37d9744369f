// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/support/mutations.hpp"

#include "core/random_stream.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

namespace mapscore::testing {
namespace {

constexpr std::size_t kLongestRun = 200;

/// Where a piece of a file lies.
struct Slice {
  std::size_t start, length;
};

std::size_t below(RandomStream& random, std::size_t count) {
  return static_cast<std::size_t>(random.bits() % count);
}

/// Of at least one byte, if there is one.
Slice any_slice(RandomStream& random, const std::string& bytes) {
  const std::size_t start = below(random, bytes.size());
  const std::size_t most = std::min(kLongestRun, bytes.size() - start);
  return {start, 1 + below(random, most)};
}

void flip_bits(RandomStream& random, std::string& bytes) {
  const std::size_t count = 1 + below(random, 8);
  for (std::size_t i = 0; i < count; ++i) {
    char& letter = bytes[below(random, bytes.size())];
    letter = static_cast<char>(letter ^ (1 << below(random, 8)));
  }
}

void overwrite(RandomStream& random, std::string& bytes) {
  const Slice slice = any_slice(random, bytes);
  const std::size_t with = below(random, 3);
  for (std::size_t i = 0; i < slice.length; ++i) {
    const std::uint64_t noise = random.bits() & 0xff;
    const std::uint64_t value = with == 0 ? 0 : with == 1 ? 0xff : noise;
    bytes[slice.start + i] = static_cast<char>(value);
  }
}

void double_slice(RandomStream& random, std::string& bytes) {
  const Slice slice = any_slice(random, bytes);
  const std::string copy = bytes.substr(slice.start, slice.length);
  bytes.insert(below(random, bytes.size() + 1), copy);
}

bool is_text(char letter) {
  return (letter >= 0x20 && letter < 0x7f) || letter == '\n' || letter == '\r' || letter == '\t';
}

bool is_in_number(char letter) {
  return std::string_view("0123456789+-.eE").find(letter) != std::string_view::npos;
}

/// The numbers of the text that the file begins with, as runs of digits, signs, points and e.
std::vector<Slice> numbers_of(const std::string& bytes) {
  std::vector<Slice> numbers;
  const auto text_end = std::find_if_not(bytes.begin(), bytes.end(), is_text);
  for (auto letter = bytes.begin(); letter != text_end;) {
    const auto start = std::find_if(letter, text_end, is_in_number);
    letter = std::find_if_not(start, text_end, is_in_number);
    const bool has_digit = std::any_of(start, letter, [](char c) { return c >= '0' && c <= '9'; });
    if (has_digit)
      numbers.push_back({static_cast<std::size_t>(start - bytes.begin()),
                         static_cast<std::size_t>(letter - start)});
  }
  return numbers;
}

void replace_number(RandomStream& random, std::string& bytes) {
  constexpr std::array<std::string_view, 14> kNumbers{"",           "0",
                                                      "-1",         "-0.5",
                                                      "nan",        "inf",
                                                      "1e999",      "2147483648",
                                                      "4294967297", "1000000000",
                                                      "1e-320",     "1.5e300",
                                                      "65536",      "18446744073709551616"};
  const std::vector<Slice> numbers = numbers_of(bytes);
  if (numbers.empty()) return flip_bits(random, bytes);
  const Slice number = numbers[below(random, numbers.size())];
  bytes.replace(number.start, number.length, kNumbers[below(random, kNumbers.size())]);
}

}  // namespace

std::string mutate(const std::string& bytes, std::uint64_t n) {
  if (bytes.empty()) return bytes;
  RandomStream random(n, "mutation");
  std::string mutated = bytes;
  switch (n % 6) {
    case 0:
      flip_bits(random, mutated);
      break;
    case 1:
      mutated.resize(below(random, mutated.size()));
      break;
    case 2:
      overwrite(random, mutated);
      break;
    case 3:
      double_slice(random, mutated);
      break;
    case 4: {
      const Slice slice = any_slice(random, mutated);
      mutated.erase(slice.start, slice.length);
      break;
    }
    default:
      replace_number(random, mutated);
  }
  return mutated;
}

}  // namespace mapscore::testing
