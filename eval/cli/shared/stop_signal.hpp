// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

namespace mapscore::eval {

/// While it exists, the first SIGINT (Ctrl-C) or SIGTERM asks this process to stop instead of
/// ending it; the second one of a kind ends it at once. One at a time.
class StopSignal {
 public:
  StopSignal();
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;

  /// The signal that came, 0 for none. Safe from several threads.
  [[nodiscard]] int taken() const;
};

}  // namespace mapscore::eval
