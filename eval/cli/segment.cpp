// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "core/geometry/oriented_box.hpp"
#include "core/segmentation/segmentation.hpp"
#include "core/whole_file.hpp"
#include "eval/cli/shared/choice_flags.hpp"
#include "eval/cli/shared/options.hpp"
#include "eval/cli/verbs.hpp"
#include "eval/map_files/clouds/cloud_file.hpp"
#include "eval/recording/recording.hpp"
#include "files/csv.hpp"
#include "files/folder_lock.hpp"
#include "files/text.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <iostream>
#include <numbers>
#include <variant>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

struct SegmentFlags {
  std::string recording, output;
  ChoiceFlags<Segmentation> segmentation{"--method", Direct{}};
  int frame = 0;
  double voxel_m = 0.05;
};

std::vector<std::string> columns() {
  return {"instance", "name",        "class",        "score",       "skipped",
          "points",   "voxels",      "x_min_m",      "y_min_m",     "z_min_m",
          "x_max_m",  "y_max_m",     "z_max_m",      "box_x_m",     "box_y_m",
          "box_z_m",  "box_yaw_deg", "box_length_m", "box_width_m", "box_height_m"};
}

/// One line of segments.csv; cells of boxes are empty where nothing was kept.
std::vector<std::string> cells_of(const Segment& segment, const ClassTable& table,
                                  const Pose& T_base_depth) {
  std::vector<std::string> cells{std::to_string(segment.instance),
                                 table.instances.at(segment.instance).name,
                                 table.classes.at(segment.class_id).name,
                                 fmt::format("{}", segment.score),
                                 std::string(word_of(segment.skipped)),
                                 std::to_string(segment.points.size()),
                                 std::to_string(segment.voxel_centres.size())};
  const auto box = upright_box(segment.points, up_in_depth(T_base_depth));
  if (!box) {
    cells.resize(columns().size());
    return cells;
  }
  const auto add = [&](double x) { cells.push_back(fmt::format("{:.6f}", x)); };
  for (const double x : segment.box.min()) add(x);
  for (const double x : segment.box.max()) add(x);
  const Pose T_base_box = T_base_depth * box->T_frame_box;
  for (const double x : T_base_box.translation()) add(x);
  const Eigen::Vector3d along = T_base_box.linear().col(0);
  add(std::remainder(std::atan2(along.y(), along.x()) * 180.0 / std::acos(-1.0), 180.0));
  for (const double x : box->size_m) add(x);
  return cells;
}

void write_segment(const Segment& segment, const fs::path& folder) {
  if (segment.points.empty()) return;
  const std::string stem = fmt::format("instance_{:05}", segment.instance);
  for (const char* ending : {".pcd", ".ply"}) {
    write_cloud(folder / (stem + ending), segment.points, segment.class_id, segment.instance);
    write_cloud(folder / (stem + "_voxels" + ending), segment.voxel_centres, segment.class_id,
                segment.instance);
  }
}

/// Writes and prints all segments of a frame.
void write_all(const std::vector<Segment>& segments, const ClassTable& table,
               const Pose& T_base_depth, const fs::path& folder) {
  std::string csv = csv_line(columns());
  std::cout << fmt::format("{:<8} {:<16} {:>8} {:>8}  {}\n", "instance", "class", "points",
                           "voxels", "skipped");
  for (const Segment& found : segments) {
    write_segment(found, folder);
    csv += csv_line(cells_of(found, table, T_base_depth));
    std::cout << fmt::format("{:<8} {:<16} {:>8} {:>8}  {}\n", found.instance,
                             table.classes.at(found.class_id).name, found.points.size(),
                             found.voxel_centres.size(), word_of(found.skipped));
  }
  write_whole_file(folder / "segments.csv", csv);
  std::cout << shown(folder / "segments.csv") << '\n';
}

/// What edge_aligned mended, of a frame with detections.
std::string fit_text(const LabelledDepth& labelled, OutlineFit fitted) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  const OutlineAlignment& fit = labelled.alignment;
  if (fit.score == 0)
    return "fit: none, too few depth edges lie about outlines; masks lie as the calibration has "
           "them\n";
  std::string text = "fit: ";
  if (fitted == OutlineFit::calibration) {
    const Eigen::AngleAxisf turn(fit.rotation);
    const Eigen::Vector3d degrees = (turn.angle() * turn.axis()).cast<double>() / kDegree;
    text += fmt::format(
        "turned by {:.2f}, {:.2f} and {:.2f} degrees about x, y and z of color_optical, shifted by "
        "{:.1f} and {:.1f} mm along x and y, focal length {:+.2f} %; ",
        degrees.x(), degrees.y(), degrees.z(), 1e3 * fit.translation.x(), 1e3 * fit.translation.y(),
        100 * (fit.focal - 1));
  }
  text +=
      fmt::format("objects end {:.1f} px {} their masks; depth edges lie on {:.2f} of the outlines",
                  std::abs(fit.offset_px), fit.offset_px < 0 ? "within" : "beyond", fit.score);
  if (labelled.confidence)
    text += fmt::format("; right within 2 px with a probability of {:.2f}", *labelled.confidence);
  return text + '\n';
}

void write_segments(const SegmentFlags& flags) {
  const Segmentation segmentation = flags.segmentation.value();
  const Recording recording = Recording::open(flags.recording);
  if (flags.frame < 0 || flags.frame >= recording.frame_count())
    throw Error(
        fmt::format("no frame {}; frames: 0 to {}", flags.frame, recording.frame_count() - 1));
  const Frame frame = recording.read(
      flags.frame, {.color = false, .label = true, .depth = true, .depth_label = false});
  const Calibration& calibration = recording.info().calibration;
  const ClassTable& table = recording.info().table;
  const Sight sight(calibration, frame.depth, detections_of(frame.label, table));
  const std::vector<Segment> segments = segment(sight, segmentation, flags.voxel_m, true);
  const fs::path folder = flags.output;
  const FolderLock lock(folder);
  if (fs::exists(folder) && !(fs::is_directory(folder) && fs::is_empty(folder)))
    throw Error(folder.string() +
                ": is not an empty folder, and files of two frames would lie side by side; give "
                "another, or remove it");
  fs::create_directories(folder);
  if (sight.detections().empty())
    std::cout << "no object is detected in this frame\n";
  else if (const auto* edge_aligned = std::get_if<EdgeAligned>(&segmentation))
    std::cout << fit_text(label_surfaces(sight, *edge_aligned), edge_aligned->fit);
  try {
    write_all(segments, table, calibration.T_base_depth, folder);
  } catch (...) {  // a part of the files would keep the next run out
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
      fs::remove_all(entry.path());
    throw;
  }
}

}  // namespace

void add_segment(CLI::App& program) {
  const auto [verb, flags] = add_verb<SegmentFlags>(
      program, "segment", "Write the points, voxels and boxes of a frame's objects",
      write_segments);
  flags->segmentation.add_to(*verb);
  verb->add_option("RECORDING", flags->recording, "Folder of a recording")->required();
  verb->add_option("-o,--output", flags->output, "Folder for the files, new or empty")->required();
  verb->add_option("--frame", flags->frame, "Index of the frame [0]");
  verb->add_option("--voxel_m", flags->voxel_m, "Edge of a voxel")
      ->check(finite_within(1e-4, 10))
      ->capture_default_str();
  verb->footer(
      "Writes for each instance its points and voxels' centres in depth_optical (.pcd and .ply), "
      "and\nsegments.csv: axis-aligned box in depth_optical, upright box in base_footprint.\n"
      "Examples:\n"
      "  mapscore segment results/demo/recordings/apartment-* --frame 12 -o segments\n"
      "  mapscore segment /data/home --method region_growing --seed depth_mode --voxel_m 0.02 -o "
      "segments");
}

}  // namespace mapscore::eval
