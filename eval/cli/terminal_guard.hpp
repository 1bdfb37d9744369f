// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <ostream>
#include <streambuf>
#include <string>

namespace mapscore::eval {

/// Stands between a stream and its terminal while it lives: whatever is printed, names out of
/// strangers' files among it, passes through shown_lines(). One thread at a time.
class TerminalGuard : public std::streambuf {
 public:
  explicit TerminalGuard(std::ostream& stream) : stream_(stream), inner_(stream.rdbuf(this)) {}
  ~TerminalGuard() override;
  TerminalGuard(const TerminalGuard&) = delete;
  TerminalGuard& operator=(const TerminalGuard&) = delete;

 protected:
  int_type overflow(int_type letter) override;
  std::streamsize xsputn(const char* bytes, std::streamsize count) override;
  int sync() override;

 private:
  /// Hands on what has come, but for a character whose last bytes have not.
  bool hand_on(std::size_t bytes);

  std::ostream& stream_;
  std::streambuf* inner_;
  std::string pending_;
};

}  // namespace mapscore::eval
