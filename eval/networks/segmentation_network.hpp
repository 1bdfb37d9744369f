// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/networks/network_model.hpp"

#include <opencv2/core.hpp>
#include <opencv2/dnn.hpp>

#include <string>

namespace mapscore::eval {

/// What a network says of an image, pixel by pixel.
struct Segmented {
  cv::Mat1w label;        ///< the channel with the greatest output, of equal ones the lowest
  cv::Mat1f probability;  ///< of that channel: the softmax of the logits, or the output itself
};

/// A network that gives each pixel of an image a class, run by OpenCV's DNN module on one core. One
/// thread at a time; each thread loads its own.
class SegmentationNetwork {
 public:
  /// For images of `size`. Throws Error, with the file and both shapes, where the network is
  /// damaged, of an operator set or of operators that OpenCV does not read, has weights that are
  /// not finite, or takes or gives another shape.
  SegmentationNetwork(const NetworkModel& network, cv::Size size);

  /// Whether the input has depth as its fourth channel.
  [[nodiscard]] bool needs_depth() const { return channels_ == 4; }
  /// Classes that it tells apart: channels of its output.
  [[nodiscard]] int class_count() const { return class_count_; }
  /// Width and height of its input.
  [[nodiscard]] cv::Size input_size() const { return input_; }

  /// The output itself, 1 x class_count() x rows x columns, for an input of its own size: `image`
  /// 1 x channels x rows x columns, as it enters the network. Throws Error where it holds numbers
  /// that are not finite; `name` says of what image.
  [[nodiscard]] cv::Mat forward(const cv::Mat& image, const std::string& name);

  /// `color` of the size given, BGR; `depth_m`: metres at its pixels, 0 where there is none, or
  /// empty where the network needs none. Both are resized to the input where that is of another
  /// size (colour bilinearly, depth by the nearest pixel), and the output bilinearly to the image,
  /// pixel centres at (u + 1/2) / width. Throws Error as forward, and where an output that is said
  /// to be probabilities is none, or one said to be logits is.
  [[nodiscard]] Segmented segment(const cv::Mat3b& color, const cv::Mat1f& depth_m,
                                  const std::string& name);

  /// The input for `segment`, for which it is described: 1 x channels x rows x columns.
  [[nodiscard]] cv::Mat input_of(const cv::Mat3b& color, const cv::Mat1f& depth_m) const;

 private:
  void check_outline(std::string_view bytes);
  void check_settings() const;
  void load(std::string_view bytes);
  void check_kind(const cv::Mat& output, const std::string& name) const;

  NetworkModel network_;
  cv::Size size_, input_;
  int channels_ = 0, class_count_ = 0;
  cv::dnn::Net net_;
};

}  // namespace mapscore::eval
