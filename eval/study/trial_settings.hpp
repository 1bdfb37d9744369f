// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/calibration/calibrator_settings.hpp"
#include "core/fusion/fusion_rule.hpp"
#include "core/mapping/mapped_frames.hpp"
#include "core/mapping/mapper.hpp"
#include "core/parameters.hpp"
#include "core/refinement/dense_crf.hpp"
#include "core/segmentation/segmentation.hpp"
#include "eval/foreign/label_classes.hpp"
#include "eval/networks/network_model.hpp"
#include "eval/score/counts.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace mapscore::eval {

// What a trial does with a recording: where its detections come from, by which method they become a
// map, and how the map is scored.

/// Detections come from the label images of the recording.
struct LabelPerception : NoFields {
  static constexpr std::string_view kKind = "labels";
  static constexpr std::string_view kMeaning = "the recording's label images";
};

/// What simulated perception knows of the truth: a box about each instance, or about each of its
/// drawn surfaces.
enum class PerceivedBoxes { instances, surfaces };
constexpr auto names_of(PerceivedBoxes) {
  return std::to_array<std::string_view>({"instances", "surfaces"});
}

/// Boxes of models, voted for by the depth image.
struct SimulatedPerception {
  static constexpr std::string_view kKind = "simulated";
  static constexpr std::string_view kMeaning =
      "boxes in view, voted for by the points of the depth image (docs/objects.md)";
  std::optional<std::string> objects;  ///< empty: the recording's truth
  PerceivedBoxes boxes = PerceivedBoxes::instances;
  double tolerance_m = 0.01;
  int min_pixels = 1;

  static void fields(auto& s, auto&& visit) {
    visit(s.objects, Field{"objects",
                           "object map (YAML) whose boxes are perceived, from the study file's "
                           "folder; default: the recording's truth"});
    visit(s.boxes, Field{"boxes",
                         "of the truth: one about each instance, along the axes of the scene's "
                         "world, or one about each of its drawn surfaces, along the surface's"});
    visit(s.tolerance_m, Field{"tolerance_m", "widening of the boxes on each side", {0, 1}});
    visit(s.min_pixels, Field{"min_pixels", "depth pixels that make an object seen", {1, 1000000}});
  }
  bool operator==(const SimulatedPerception&) const = default;
};

/// A network's label images in place of the recording's.
struct ImagePerception {
  static constexpr std::string_view kKind = "images";
  static constexpr std::string_view kMeaning =
      "label images of a network, one for each colour image (docs/foreign_recordings.md)";
  std::optional<std::string> folder, classes, scores, confidence;
  ClassMasks masks = ClassMasks::components;

  static void fields(auto& s, auto&& visit) {
    visit(s.folder, Field{"folder",
                          "folder of the label images, named as the colour images or listed with "
                          "stamps in its label.txt, from the study file's folder"});
    visit(s.classes,
          Field{"classes",
                "file that names the recording's classes of their pixels, from the study "
                "file's folder"});
    visit(s.masks,
          Field{"masks",
                "a detection for each connected component of a class, for each class, or for each "
                "pixel value, 256 class + instance"});
    visit(s.scores,
          Field{"scores",
                "CSV of scores, image,id,score or stamp_s,id,score, from the study file's "
                "folder; default: all are 1"});
    visit(s.confidence,
          Field{"confidence",
                "folder of images of the same names, from the study file's folder: how sure the "
                "network was of each pixel, in thousandths (docs/metrics.md)"});
  }
  bool operator==(const ImagePerception&) const = default;
};

/// A network that runs over the recording's images.
struct NetworkPerception {
  static constexpr std::string_view kKind = "network";
  static constexpr std::string_view kMeaning =
      "a segmentation network, run on each colour image (docs/networks_in_the_loop.md)";
  std::optional<std::string> model, classes;
  ChannelOrder channels = ChannelOrder::rgb;
  double scale = 1;
  std::vector<double> mean, std;
  NetworkOutput output = NetworkOutput::logits;

  static void fields(auto& s, auto&& visit) {
    visit(s.model, Field{.key = "model",
                         .meaning = "ONNX file of the network: an image in, of 3 channels or, with "
                                    "depth, 4; classes by pixel out; from the study file's folder",
                         .figure = "network"});
    visit(s.classes, Field{"classes",
                           "file that names the recording's classes of the output's channels, from "
                           "the study file's folder"});
    visit(s.channels, Field{"channels", "order of the colours in the input"});
    visit(s.scale,
          Field{"scale", "factor of the colours, 0 to 255, before mean and std", above(0)});
    UnlessEmpty mean_unless_empty{s.mean};
    visit(mean_unless_empty, Field{.key = "mean",
                                   .meaning = "taken off each channel of the input; of depth in "
                                              "metres; default: 0",
                                   .swept = false});
    UnlessEmpty std_unless_empty{s.std};
    visit(std_unless_empty, Field{.key = "std",
                                  .meaning = "then divides each channel of the input; default: 1",
                                  .range = above(0),
                                  .swept = false});
    visit(s.output, Field{"output", "what the output holds for each class"});
  }
  bool operator==(const NetworkPerception&) const = default;
};

/// Where the detections of a study come from.
using PerceptionSettings =
    std::variant<LabelPerception, SimulatedPerception, ImagePerception, NetworkPerception>;

/// What a study's faults leave of the true calibration.
struct BelievedCalibration : NoFields {
  static constexpr std::string_view kKind = "believed";
  static constexpr std::string_view kMeaning = "the true one with the faults of the study";
};
/// What the methods of a study believe of the cameras.
using CalibrationSettings = std::variant<BelievedCalibration, CalibratorSettings>;

struct StudyFusion : NoFields {
  static constexpr std::string_view kKind = "study";
  static constexpr std::string_view kMeaning = "as the study's `fusion`";
};
/// Fusion of one method: the study's, or its own.
using MethodFusion = DrawnOf<FusionRule>::With<StudyFusion>;

struct NoRefinement : NoFields {
  static constexpr std::string_view kKind = "none";
  static constexpr std::string_view kMeaning = "the map as it was fused";
};
/// What happens to the finished map before it is scored.
using Refinement = std::variant<NoRefinement, Crf>;

/// A mapper of others: a program that makes a map file of a trial folder.
struct CommandMethod {
  std::vector<std::string>
      command;  ///< words; {trial} and {map} stand for paths, {threads} for a number
  std::string map;
  double timeout_s = 600;
  int threads = 1;
  /// Files beside those that the command names; in a trial's key the hashes of what all hold.
  std::vector<std::string> depends{};

  static void fields(auto& s, auto&& visit) {
    visit(s.command, Field{.key = "command",
                           .meaning = "a program that maps a trial, and its arguments, which no "
                                      "shell reads: {trial} is the folder of the trial, {map} the "
                                      "file to write, {threads} its threads "
                                      "(docs/external_methods.md); in place of segmentation, "
                                      "place, fusion and refinement",
                           .required = true,
                           .swept = false});
    visit(s.map, Field{.key = "map",
                       .meaning = "name of that file, whose ending says its format",
                       .required = true,
                       .swept = false});
    visit(s.timeout_s, Field{.key = "timeout_s",
                             .meaning = "seconds after which it is ended, and its trial failed",
                             .range = above(0, 1e6),
                             .swept = false});
    visit(s.threads, Field{.key = "threads",
                           .meaning = "how many of --jobs it takes up; {threads} tells it",
                           .range = {1, 1024},
                           .swept = false});
    UnlessEmpty depends_unless_empty{s.depends};
    visit(depends_unless_empty,
          Field{.key = "depends",
                .meaning = "further files whose content is part of a trial's key, as that of files "
                           "that the command names: a changed one makes its trials new",
                .swept = false});
  }
  bool operator==(const CommandMethod&) const = default;
};

struct MethodSettings {
  std::string name;  ///< letters, digits, _ and -
  Segmentation segmentation;
  std::optional<Place> place{};  ///< empty: the study's
  MethodFusion fusion{};
  Refinement refinement{};
  MappedFrames frames{};
  std::optional<std::string> title{};      ///< for people; changes no result
  std::optional<CommandMethod> command{};  ///< in place of all above but the name

  /// Of a command its own keys, else those of a method of ours.
  static void fields(auto& s, auto&& visit) {
    if (s.command)
      CommandMethod::fields(*s.command, visit);
    else
      own_fields(s, visit);
    visit(s.title, Field{.key = "title",
                         .meaning = "its name in figures, and in tables for papers",
                         .swept = false});
  }
  static void own_fields(auto& s, auto&& visit) {
    visit(s.segmentation, Field{.key = "segmentation",
                                .meaning = "from a detection and a registered cloud to points",
                                .required = true});
    visit(s.place, Field{"place", "as the study's `place`, for this method alone"});
    visit(s.fusion, later({"fusion", "how this method's observations change the map"}));
    visit(s.refinement,
          later({"refinement", "what happens to this method's map before it is scored"}));
    visit(s.frames, later({"frames", "which of the frames this method maps", {}, "mapped frames"}));
  }
  bool operator==(const MethodSettings&) const = default;
};

/// What is scored: the fused map, or each frame's observation by itself.
enum class ScoreUnit { map, frame };
constexpr auto names_of(ScoreUnit) {
  return std::to_array<std::string_view>({"map", "frame"});
}

/// A number, or `auto` (empty).
struct AutoNumber {
  std::optional<double> value;
  bool operator==(const AutoNumber&) const = default;
};

struct ScoreSettings {
  ScoreUnit unit = ScoreUnit::map;
  std::optional<double> at_s;  ///< empty: nothing moves, or each frame at its own time
  AutoNumber threshold;
  int min_samples = 1;
  double epsilon_m = 0.0005;
  std::vector<int> tolerances{0, 1};
  std::vector<double> distances_m{0.01, 0.02, 0.05, 0.1};
  AskedParts asked;

  static void fields(auto& s, auto&& visit) {
    visit(s.unit,
          Field{"unit", "score the fused map, or each frame's observation against its own truth"});
    visit(s.at_s, Field{"at_s",
                        "with unit map, where the scene moves: the time whose surfaces a map is "
                        "scored against"});
    visit(s.threshold,
          Field{"threshold",
                "least probability of a predicted voxel; auto: half of what a first full hit gives",
                {0, 1}});
    visit(s.min_samples,
          Field{"min_samples", "depth samples that make a voxel visible", {1, 1000000}});
    visit(s.epsilon_m, Field{"epsilon_m", "widening of voxels in the surface test", {0, 0.1}});
    visit(s.tolerances,
          Field{"tolerances", "tolerances of the match, in voxels; 0 is always counted", {0, 5}});
    visit(s.distances_m, Field{"distances_m", "distances of the F-score", above(0, 10)});
    AskedParts::fields(s.asked, visit);
  }
  bool operator==(const ScoreSettings&) const = default;
};

}  // namespace mapscore::eval
