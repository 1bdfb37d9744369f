// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace mapscore {

/// A frame whose masks' outlines were fitted to its depth edges, with the correction of the
/// believed calibration that explains most of them and without one. Safe to read from several
/// threads.
class FittedFrame {
 public:
  FittedFrame(double mended_px, double believed_px)
      : mended_px_(mended_px), believed_px_(believed_px) {}
  virtual ~FittedFrame() = default;
  FittedFrame(const FittedFrame&) = delete;
  FittedFrame& operator=(const FittedFrame&) = delete;

  /// Length of the outlines on which edges lie with the correction, px.
  [[nodiscard]] double mended_px() const { return mended_px_; }
  /// Without one, with the masks' size fitted alone, px.
  [[nodiscard]] double believed_px() const { return believed_px_; }
  /// With the correction of another frame, and with that one's size of masks, px; 0 if another
  /// method fitted it. Both must believe the same calibration.
  [[nodiscard]] virtual double explained_px(const FittedFrame& other) const = 0;
  /// This frame with its correction refined on all of these together; none where that cannot be
  /// done. All must believe the same calibration.
  [[nodiscard]] virtual std::shared_ptr<const FittedFrame> refined_on(
      const std::vector<std::shared_ptr<const FittedFrame>>& /*frames*/) const {
    return nullptr;
  }

 private:
  double mended_px_, believed_px_;
};

/// Which correction of the believed calibration a frame takes: its own, unless one of these.
struct FrameVerdict {
  bool stands = false;                             ///< none: the calibration is as believed
  std::shared_ptr<const FittedFrame> agreed = {};  ///< that of this one, which serves all frames
};

/// Frames that tell each other whether the believed calibration stands, and what it is where it
/// does not: a wrong correction fits by chance in a single frame, but not in the others
/// (docs/segmentation.md, "Other frames"). Copies share the frames. Safe to read from several
/// threads.
class CalibrationEvidence {
 public:
  static constexpr std::size_t kMostFrames = 8;  ///< that are kept, each of about 2 MB at 640 x 480

  /// Takes a frame into account, if there is one, unless it is closed. Of many it keeps some,
  /// spread evenly over all that were added.
  void add(std::shared_ptr<const FittedFrame> frame);
  /// Takes no more: all frames that tell something were added.
  void close() { is_closed_ = true; }

  /// Which correction a frame takes. A frame is no witness of itself.
  [[nodiscard]] FrameVerdict judge(const FittedFrame& frame) const;

 private:
  /// A frame, and what the correction that serves all explains of it.
  struct Kept {
    std::shared_ptr<const FittedFrame> frame;
    double by_agreed_px = 0;
  };

  void agree();

  std::vector<Kept> frames_;
  std::shared_ptr<const FittedFrame> agreed_;  ///< with the correction that serves all
  double served_ = 0;  ///< share of the others' outlines that it explained before it was refined
  std::size_t added_ = 0, step_ = 1;  ///< every so-manieth is kept
  bool is_closed_ = false;
};

}  // namespace mapscore
