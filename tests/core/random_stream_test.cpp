// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/random_stream.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace mapscore {
namespace {

/// One stream as docs/methods.md lists it: its name, and what it gives first.
struct ListedStream {
  std::uint64_t seed = 0;
  std::string purpose;
  std::vector<std::uint64_t> indices, words;
  std::vector<double> uniforms, normals;
};

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

std::vector<std::uint64_t> whole_numbers(const std::string& cell) {
  std::vector<std::uint64_t> numbers;
  if (cell.find("none") != std::string::npos) return numbers;
  for (const std::string& number : split(cell, ','))
    numbers.push_back(std::stoull(number, nullptr, 0));
  return numbers;
}

std::vector<double> reals(const std::string& cell) {
  std::vector<double> numbers;
  for (const std::string& number : split(cell, ',')) numbers.push_back(std::stod(number));
  return numbers;
}

/// The table under "Randomness".
std::vector<ListedStream> listed_streams() {
  std::ifstream page(std::string(MAPSCORE_SOURCE_DIR) + "/docs/methods.md");
  std::vector<ListedStream> streams;
  std::string line;
  while (std::getline(page, line) && !line.starts_with("| seed | purpose | indices |")) continue;
  std::getline(page, line);
  while (std::getline(page, line) && line.starts_with("|")) {
    const std::vector<std::string> cells = split(line, '|');
    streams.push_back({std::stoull(cells.at(1)), split(cells.at(2), '`').at(1),
                       whole_numbers(cells.at(3)), whole_numbers(cells.at(4)), reals(cells.at(5)),
                       reals(cells.at(6))});
  }
  return streams;
}

RandomStream made(const ListedStream& listed) {
  const std::vector<std::uint64_t>& i = listed.indices;
  if (i.empty()) return {listed.seed, listed.purpose};
  if (i.size() == 1) return {listed.seed, listed.purpose, {i[0]}};
  return {listed.seed, listed.purpose, {i.at(0), i.at(1), i.at(2)}};
}

TEST(RandomStream, GivesWhatThePageLists) {
  const std::vector<ListedStream> streams = listed_streams();
  ASSERT_EQ(streams.size(), 4u);
  for (const ListedStream& listed : streams) {
    SCOPED_TRACE(listed.purpose);
    ASSERT_EQ(listed.words.size(), 3u);
    ASSERT_EQ(listed.uniforms.size(), 2u);
    ASSERT_EQ(listed.normals.size(), 3u);
    RandomStream words = made(listed), uniforms = made(listed), normals = made(listed);
    for (const std::uint64_t word : listed.words) EXPECT_EQ(words.bits(), word);
    for (const double uniform : listed.uniforms) EXPECT_EQ(uniforms.uniform(), uniform);
    // Mathematical libraries may differ in the last bit.
    for (const double normal : listed.normals) EXPECT_DOUBLE_EQ(normals.normal(), normal);
  }
}

TEST(RandomStream, KeepsTheSecondNormalWhileUniformsAreDrawn) {
  RandomStream plain(1, "belief", {0}), mixed(1, "belief", {0}), words(1, "belief", {0});
  EXPECT_EQ(plain.normal(), mixed.normal());
  words.skip(2);
  EXPECT_EQ(mixed.uniform(), words.uniform());
  EXPECT_EQ(plain.normal(), mixed.normal());
}

}  // namespace
}  // namespace mapscore
