// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <malloc.h>

#include <cstddef>
#include <fstream>
#include <string>

namespace mapscore::bench {

/// A line of /proc/self/status that counts kibibytes, in bytes; 0 where there is none.
inline std::size_t status_bytes(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    std::size_t kibibytes = 0;
    if (word == name + ":" && status >> kibibytes) return kibibytes * 1024;
  }
  return 0;
}

/// How far the resident memory of the process rises above where it stood when this was made, which
/// takes time: what was freed is given back first, since it would hide as much of the rise.
class PeakMemory {
 public:
  PeakMemory() {
    malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << "5";  // the peak starts anew
    before_ = status_bytes("VmRSS");
  }

  /// Mebibytes at the peak.
  [[nodiscard]] double peak_MiB() const { return risen_MiB(status_bytes("VmHWM")); }
  /// Mebibytes that are still held.
  [[nodiscard]] double held_MiB() const {
    malloc_trim(0);
    return risen_MiB(status_bytes("VmRSS"));
  }

 private:
  [[nodiscard]] double risen_MiB(std::size_t now) const {
    return static_cast<double>(now > before_ ? now - before_ : 0) / (1 << 20);
  }

  std::size_t before_ = 0;
};

}  // namespace mapscore::bench
