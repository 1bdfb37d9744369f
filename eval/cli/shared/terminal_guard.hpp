// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <ostream>
#include <streambuf>
#include <string>

namespace mapscore::eval {

/// While it exists, escapes all that a stream prints by shown_lines(), so that names from
/// strangers' files cannot control the terminal. One thread at a time.
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
  /// Passes on the first `bytes` of the pending text, escaped; false when the stream fails.
  bool hand_on(std::size_t bytes);

  std::ostream& stream_;
  std::streambuf* inner_;
  std::string pending_;
};

}  // namespace mapscore::eval
