// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/error.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <exception>
#include <string>

namespace mapscore::testing {

/// The n-th way to damage a file, the same on every machine: flipped bits, a cut, a run overwritten
/// with 00, FF or noise, a slice doubled, a slice left out, or a number of its text (the file up to
/// its first byte that is not text) replaced by a huge, negative, odd or empty one. May by chance
/// return the bytes as they were.
[[nodiscard]] std::string mutate(const std::string& bytes, std::uint64_t n);

/// What became of a number of mutations.
struct MutationTally {
  int read = 0, refused = 0;
};

/// Reads mutations 0 to count - 1 of `bytes` with `read`, which takes a mutated file's bytes: each
/// must be read, or be refused with an Error of one line; anything else fails the test.
template <class Read>
[[nodiscard]] MutationTally read_mutations(const std::string& bytes, std::uint64_t count,
                                           Read&& read) {
  MutationTally tally;
  for (std::uint64_t n = 0; n < count; ++n) try {
      read(mutate(bytes, n));
      ++tally.read;
    } catch (const Error& error) {
      ++tally.refused;
      const std::string message = error.what();
      EXPECT_FALSE(message.empty()) << "mutation " << n;
      EXPECT_EQ(message.find_first_of("\r\n"), std::string::npos)
          << "mutation " << n << ": " << message;
    } catch (const std::exception& other) {
      ADD_FAILURE() << "mutation " << n << " throws another exception: " << other.what();
    }
  return tally;
}

}  // namespace mapscore::testing
