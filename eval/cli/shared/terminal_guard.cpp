// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/shared/terminal_guard.hpp"

#include "files/text.hpp"

namespace mapscore::eval {

TerminalGuard::~TerminalGuard() {
  hand_on(pending_.size());
  stream_.rdbuf(inner_);
}

bool TerminalGuard::hand_on(std::size_t bytes) {
  const std::string text = shown_lines(std::string_view(pending_).substr(0, bytes));
  pending_.erase(0, bytes);
  const auto size = static_cast<std::streamsize>(text.size());
  return inner_->sputn(text.data(), size) == size;
}

TerminalGuard::int_type TerminalGuard::overflow(int_type letter) {
  if (traits_type::eq_int_type(letter, traits_type::eof())) return traits_type::not_eof(letter);
  const char byte = traits_type::to_char_type(letter);
  return xsputn(&byte, 1) == 1 ? letter : traits_type::eof();
}

std::streamsize TerminalGuard::xsputn(const char* bytes, std::streamsize count) {
  pending_.append(bytes, static_cast<std::size_t>(count));
  return hand_on(pending_.size() - unfinished_tail(pending_)) ? count : 0;
}

int TerminalGuard::sync() {
  return inner_->pubsync();
}

}  // namespace mapscore::eval
