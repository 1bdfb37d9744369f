// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mapscore::eval {

/// A selection of a recording's frames, independent of their number: all of them, or those of a
/// list of single frames and slices, `3,7,9`, `0:50:2`, `:10,40:`. A slice is first:end:step as in
/// Python, without `end`; first is 0, end the number of frames and step 1 where left out. Frames
/// count from 0. Unlike in Python, no number is negative, the step is at least 1, and a number
/// beyond the recording is an error.
class FrameSelection {
 public:
  /// All frames.
  FrameSelection() = default;
  /// Throws Error naming the part that is not a frame or a slice.
  explicit FrameSelection(std::string_view text);

  [[nodiscard]] bool all() const { return slices_.empty(); }
  /// The selected frames, ascending, each once however often it is named. Throws Error saying how
  /// many frames there are when a number lies beyond them or no frame is selected.
  [[nodiscard]] std::vector<int> of(int frame_count) const;

  bool operator==(const FrameSelection&) const = default;

 private:
  struct Slice {
    std::string text;
    std::int64_t first = 0;
    std::optional<std::int64_t> end;  ///< none: the number of frames
    std::int64_t step = 1;
    bool operator==(const Slice&) const = default;
  };
  [[nodiscard]] static Slice slice_of(std::string_view text);

  std::vector<Slice> slices_;
};

/// Of ascending frames so many at most that are fit, spread evenly: they are asked in the order of
/// the binary van der Corput sequence. Ascending.
[[nodiscard]] std::vector<int> spread_over(const std::vector<int>& frames, int most,
                                           const std::function<bool(int)>& is_fit);

}  // namespace mapscore::eval
