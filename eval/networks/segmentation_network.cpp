// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/networks/segmentation_network.hpp"

#include "eval/networks/onnx_outline.hpp"
#include "files/file_bytes.hpp"
#include "files/png.hpp"
#include "files/refusal.hpp"
#include "files/text.hpp"

#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgproc.hpp>

#include <array>
#include <cmath>
#include <limits>

namespace mapscore::eval {
namespace {

/// Operator sets of ONNX whose operators OpenCV 4.6 reads as they are meant.
constexpr std::int64_t kFirstOpset = 9, kLastOpset = 13;

/// Greatest difference of width to height between image and input, as a share.
constexpr double kMostAspect = 0.01;

/// What OpenCV says of a network, in one line.
std::string reason_of(const cv::Exception& error) {
  constexpr std::string_view kBegin = "of type \"";
  const std::string& text = error.err;
  if (const std::size_t begin = text.find(kBegin); begin != text.npos) {
    const std::size_t name = begin + kBegin.size();
    return fmt::format("it has no operator {}",
                       shown(text.substr(name, text.find('"', name) - name)));
  }
  constexpr std::string_view kNode = "Node [";  // of ONNX: "Node [Clip@ai.onnx]:(name) parse error"
  if (const std::size_t node = text.find(kNode);
      node != text.npos && text.find("parse error", node) != text.npos) {
    const std::size_t name = node + kNode.size();
    return fmt::format("it does not read operator {} in this form",
                       shown(text.substr(name, text.find_first_of("@]", name) - name)));
  }
  std::string line;
  for (const char letter : text) line += letter == '\n' || letter == '>' ? ' ' : letter;
  const std::size_t first = line.find_first_not_of(' ');
  return first == line.npos ? "it says no reason" : shown(line.substr(first));
}

/// The plane of a 1 x C x H x W array; shares its memory.
cv::Mat1f plane(const cv::Mat& array, int channel) {
  return {array.size[2], array.size[3], const_cast<float*>(array.ptr<float>(0, channel))};
}

void resize_into(const cv::Mat1f& from, cv::Mat1f to, int how) {
  if (from.size() == to.size())
    from.copyTo(to);
  else
    cv::resize(from, to, to.size(), 0, 0, how);
}

/// The array with planes of another size.
cv::Mat resized(const cv::Mat& array, cv::Size size) {
  if (cv::Size(array.size[3], array.size[2]) == size) return array;
  const std::array<int, 4> shape{1, array.size[1], size.height, size.width};
  cv::Mat result(4, shape.data(), CV_32F);
  for (int channel = 0; channel < shape[1]; ++channel)
    resize_into(plane(array, channel), plane(result, channel), cv::INTER_LINEAR);
  return result;
}

/// The channel with the greatest value, and 1 / sum of exp(value - greatest).
Segmented greatest(const cv::Mat& values, NetworkOutput kind) {
  const cv::Size size(values.size[3], values.size[2]);
  Segmented found{cv::Mat1w::zeros(size), plane(values, 0).clone()};
  const int channels = values.size[1];
  const auto at = [&](int channel, int v) { return values.ptr<float>(0, channel, v); };
  std::vector<float> sum(static_cast<std::size_t>(size.width));
  for (int v = 0; v < size.height; ++v) {
    float* const best = found.probability[v];
    for (int channel = 1; channel < channels; ++channel)
      for (int u = 0; u < size.width; ++u)
        if (at(channel, v)[u] > best[u]) {
          best[u] = at(channel, v)[u];
          found.label(v, u) = static_cast<std::uint16_t>(channel);
        }
    if (kind == NetworkOutput::probabilities) continue;
    std::ranges::fill(sum, 0.0F);
    for (int channel = 0; channel < channels; ++channel)
      for (int u = 0; u < size.width; ++u)
        sum[static_cast<std::size_t>(u)] += std::exp(at(channel, v)[u] - best[u]);
    for (int u = 0; u < size.width; ++u) best[u] = 1.0F / sum[static_cast<std::size_t>(u)];
  }
  return found;
}

constexpr double kUnitSlack = 1e-3;

/// Whether all channels lie in 0..1 at every pixel.
bool are_in_unit(const cv::Mat& output) {
  for (int channel = 0; channel < output.size[1]; ++channel)
    if (!cv::checkRange(plane(output, channel), true, nullptr, -kUnitSlack, 1.0 + kUnitSlack))
      return false;
  return true;
}

/// Whether they add up to 1, too.
bool are_probabilities(const cv::Mat& output) {
  cv::Mat1f sum = cv::Mat1f::zeros(output.size[2], output.size[3]);
  for (int channel = 0; channel < output.size[1]; ++channel) sum += plane(output, channel);
  return are_in_unit(output) &&
         cv::checkRange(sum, true, nullptr, 1.0 - kUnitSlack, 1.0 + kUnitSlack);
}

}  // namespace

SegmentationNetwork::SegmentationNetwork(const NetworkModel& network, cv::Size size)
    : network_(network), size_(size) {
  const std::string bytes = read_file(network.model);
  check_outline(bytes);
  check_settings();
  load(bytes);
}

void SegmentationNetwork::check_outline(std::string_view bytes) {
  const std::filesystem::path& file = network_.model;
  const OnnxOutline outline = read_onnx_outline(bytes, file);
  if (outline.opset < kFirstOpset || outline.opset > kLastOpset)
    refuse(file, "is of operator set {}, and {} to {} are read; export it with opset_version=11",
           outline.opset, kFirstOpset, kLastOpset);
  if (!outline.not_finite.empty())
    refuse(file, "its weights '{}' hold numbers that are not finite; train it again",
           shown(outline.not_finite));
  if (outline.inputs.size() != 1 || outline.outputs.size() != 1)
    refuse(file, "has {} inputs and {} outputs; export one image and one output",
           outline.inputs.size(), outline.outputs.size());
  const std::vector<std::int64_t>& shape = outline.inputs.front().shape;
  const std::string wanted =
      fmt::format("1 x 3 x {0} x {1}, or 1 x 4 x {0} x {1} with depth", size_.height, size_.width);
  if (shape.size() != 4 || (shape[0] != 1 && shape[0] != -1) || (shape[1] != 3 && shape[1] != 4) ||
      shape[2] > kMostImageSide_px || shape[3] > kMostImageSide_px ||
      shape[2] * shape[3] > kMostImagePixels)
    refuse(file, "takes an input of {}, and the images give {}; export it for one image of these",
           shape_text(shape), wanted);
  const auto side = [](std::int64_t of_model, int of_image) {
    return of_model < 0 ? of_image : static_cast<int>(of_model);
  };
  channels_ = static_cast<int>(shape[1]);
  input_ = {side(shape[3], size_.width), side(shape[2], size_.height)};
  const double across = static_cast<double>(input_.width) * size_.height;
  const double along = static_cast<double>(input_.height) * size_.width;
  if (std::abs(across - along) > kMostAspect * std::max(across, along))
    refuse(file,
           "takes an input of {}, and the images are {} x {} (height x width), of another shape; "
           "export it for theirs",
           shape_text(shape), size_.height, size_.width);
}

void SegmentationNetwork::check_settings() const {
  const auto channels = static_cast<std::size_t>(channels_);
  for (const auto& [key, numbers] : {std::pair("mean", network_.mean), {"std", network_.std}})
    if (!numbers.empty() && numbers.size() != channels)
      refuse(network_.model,
             "takes {} channels, and perception.network.{} has {} numbers; write one for each",
             channels_, key, numbers.size());
}

void SegmentationNetwork::load(std::string_view bytes) {
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);  // it is thrown, too
  try {
    net_ = cv::dnn::readNetFromONNX(bytes.data(), bytes.size());
    net_.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
    net_.setPreferableTarget(cv::dnn::DNN_TARGET_CPU);
  } catch (const cv::Exception& error) {
    refuse(
        network_.model,
        "OpenCV {} cannot read this network: {}; docs/networks_in_the_loop.md says what it reads",
        CV_VERSION, reason_of(error));
  }
  const std::array<int, 4> shape{1, channels_, input_.height, input_.width};
  const cv::Mat output = forward(cv::Mat(4, shape.data(), CV_32F, cv::Scalar(0)), "a black image");
  std::vector<std::int64_t> given;
  for (int side = 0; side < output.dims; ++side) given.push_back(output.size[side]);
  if (output.dims != 4 || output.size[0] != 1 || output.size[1] < 2 ||
      output.size[1] > std::numeric_limits<std::uint16_t>::max())
    refuse(network_.model,
           "gives an output of {}, and 1 x CLASSES x ROWS x COLUMNS is read; export a segmentation",
           shape_text(given));
  class_count_ = output.size[1];
}

cv::Mat SegmentationNetwork::forward(const cv::Mat& image, const std::string& name) {
  cv::Mat output;
  try {
    net_.setInput(image);
    output = net_.forward();
  } catch (const cv::Exception& error) {
    refuse(network_.model,
           "OpenCV {} cannot run this network on an input of 1 x {} x {} x {}: {}; export it for "
           "that shape",
           CV_VERSION, channels_, input_.height, input_.width, reason_of(error));
  }
  if (output.type() != CV_32F || !cv::checkRange(output))
    refuse(network_.model, "its output for {} is not of finite numbers; train or export it again",
           name);
  return output;
}

cv::Mat SegmentationNetwork::input_of(const cv::Mat3b& color, const cv::Mat1f& depth_m) const {
  const std::array<int, 4> shape{1, channels_, input_.height, input_.width};
  cv::Mat input(4, shape.data(), CV_32F);
  for (int channel = 0; channel < channels_; ++channel) {
    const bool is_depth = channel == 3;
    cv::Mat1f values;
    if (is_depth) {
      values = depth_m;
    } else {
      cv::Mat1b of_color;
      cv::extractChannel(color, of_color,
                         network_.channels == ChannelOrder::bgr ? channel : 2 - channel);
      of_color.convertTo(values, CV_32F);
    }
    const cv::Mat1f into = plane(input, channel);
    resize_into(values, into, is_depth ? cv::INTER_NEAREST_EXACT : cv::INTER_LINEAR);
    const auto number = [&](const std::vector<double>& list, double otherwise) {
      return list.empty() ? otherwise : list[static_cast<std::size_t>(channel)];
    };
    const double divisor = number(network_.std, 1.0), scale = is_depth ? 1.0 : network_.scale;
    into.convertTo(into, CV_32F, scale / divisor, -number(network_.mean, 0.0) / divisor);
  }
  return input;
}

void SegmentationNetwork::check_kind(const cv::Mat& output, const std::string& name) const {
  const bool said = network_.output == NetworkOutput::probabilities;
  if (said == are_probabilities(output)) return;
  if (said && are_in_unit(output))
    refuse(
        network_.model,
        "its output for {} lies in 0..1 and does not add up to 1, as of a sigmoid for each class; "
        "end it with a softmax, or export what goes into the sigmoid and write "
        "perception.network.output: logits",
        name);
  refuse(network_.model,
         "its output for {} is {} probabilities that add up to 1; write "
         "perception.network.output: {}",
         name, said ? "not of" : "of", said ? "logits" : "probabilities");
}

Segmented SegmentationNetwork::segment(const cv::Mat3b& color, const cv::Mat1f& depth_m,
                                       const std::string& name) {
  const cv::Mat output = forward(input_of(color, depth_m), name);
  check_kind(output, name);
  return greatest(resized(output, size_), network_.output);
}

}  // namespace mapscore::eval
