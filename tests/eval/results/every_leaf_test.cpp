// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT
//
// Every leaf of the reference, set to another value, makes a trial another one, or stands in a
// short list with the reason why it does not.

#include "core/error.hpp"
#include "eval/results/plan.hpp"
#include "eval/study/study.hpp"
#include "files/file_bytes.hpp"
#include "tests/support/tiny_recording.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace mapscore::eval {
namespace {

/// Leaves that change no key. A path that ends with a dot stands for all below it.
const std::map<std::string, std::string> kReasons{
    {"name", "names a folder"},
    {"seeds", "more of the same trials"},
    {"scene", "the recording's hash stands for it"},
    {"classes", "the recording's hash stands for it"},
    {"robot", "the recording's hash stands for it"},
    {"motion", "the recording's hash stands for it"},
    {"recording", "its hash is in the key, wherever it lies"},
    {"trajectory.", "the recording's hash stands for it"},
    {"cameras.", "the recording's hash stands for it"},
    {"lidar.", "the recording's hash stands for it"},
    {"exploration.", "the recording's hash stands for it"},
    {"methods.NAME.title", "of figures and tables, which only show"},
    {"methods.NAME.timeout_s", "a trial that takes longer fails, and has no result"},
    {"methods.NAME.threads", "of the sweep's own work"},
    {"methods.NAME.depends", "the content of the files is in the key (command_method_test)"},
    {"class_titles", "of figures and tables, which only show"},
    {"picture_view", "of pictures, which are not scored"},
    {"localization.trajectory", "the content of the file is in the key (pose_sources_test)"},
    {"localization.grid", "the content of the file is in the key (pose_sources_test)"},
    {"perception.simulated.objects", "the content of the file is in the key (object_run_test)"},
    {"perception.images.folder", "the content is in the key (network_perception_test)"},
    {"perception.images.classes", "the content of the file is in the key (likewise)"},
    {"perception.images.scores", "the content of the file is in the key (likewise)"},
    {"perception.images.confidence", "the content of the files is in the key (likewise)"},
    {"perception.network.model", "the content is in the key (network_perception_test)"},
    {"perception.network.classes", "the content of the file is in the key (likewise)"}};

bool has_reason(const std::string& path) {
  for (const auto& [known, reason] : kReasons)
    if (path == known || (known.ends_with('.') && path.starts_with(known))) return true;
  return false;
}

/// The keys of the reference that are leaves, but for those that choose cells.
std::vector<std::string> leaves() {
  std::vector<std::string> paths;
  std::istringstream lines(config_reference());
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("| `")) continue;
    const std::size_t end = line.find('`', 3);
    const std::string type = line.substr(end + 4, line.find(" |", end + 4) - end - 4);
    const std::string path = line.substr(3, end - 3);
    if (type != "section" && type != "map" && !type.starts_with("one of") && path != "sweep.PATH" &&
        !path.starts_with("sampling."))
      paths.push_back(path);
  }
  return paths;
}

/// The kind that a path asks for of a choice, else the other one.
std::string kind_at(const std::string& path, const std::string& choice, const std::string& other) {
  if (!path.starts_with(choice + '.')) return other;
  const std::size_t start = choice.size() + 1;
  return path.substr(start, path.find('.', start) - start);
}

/// Faults that leave no key without effect, and sources of poses that read all there is.
const std::vector<std::string> kBases{
    "faults: {pose: {sigma_xy_m: 0.02}, depth: {preset: astra}, labels: {preset: typical}}\n",
    "localization: {source: odometry}\n",
    "localization: {source: particle_filter}\nfaults: {lidar: {preset: rplidar_a2}}\n",
    "localization: {source: particle_filter, filter: {scan_model: beam}}\n",
    "localization: {source: visual_slam}\n"};

/// A kind of perception; a network's needs files, whose content is in the key.
std::string perception_at(const std::string& path) {
  const std::string kind = kind_at(path, "perception", "labels");
  if (kind != "images" && kind != "network") return kind;
  static const testing::TemporaryFolder folder;
  write_file(folder.path() / "0.png", "an image");
  write_file(folder.path() / "classes.yaml", "classes");
  if (kind == "network")
    return fmt::format("{{network: {{model: {0}/0.png, classes: {0}/classes.yaml}}}}",
                       folder.path().string());
  return fmt::format("{{images: {{folder: {0}, classes: {0}/classes.yaml}}}}",
                     folder.path().string());
}

/// A method as a command, for its keys.
constexpr const char* kCopyCommand =
    "{command: [cp, \"{trial}/frames.csv\", \"{map}\"], map: map.csv}";

bool is_of_command(const std::string& path) {
  bool found = false;
  CommandMethod command;
  CommandMethod::fields(command, [&](const auto&, const Field& field) {
    found = found || path == fmt::format("methods.NAME.{}", field.key);
  });
  return found;
}

Study study_for(const std::string& path, const std::string& base) {
  if (is_of_command(path))
    return parse_study(
        fmt::format("recording: tiny\nmethods: {{NAME: {}}}\n{}", kCopyCommand, base),
        "study.yaml");
  return parse_study(
      fmt::format(
          "recording: tiny\nmap_yaw_deg: 1\nmethods: {{NAME: {{segmentation: {}, fusion: {}, "
          "refinement: {}, frames: {}}}}}\nfusion: {}\nperception: {}\ncalibration: "
          "{}\ntrajectory: {{drive: "
          "{}}}\nexploration: {{planner: {}}}\n{}",
          kind_at(path, "methods.NAME.segmentation", "direct"),
          kind_at(path, "methods.NAME.fusion", "study"),
          kind_at(path, "methods.NAME.refinement", "none"),
          kind_at(path, "methods.NAME.frames", "all"), kind_at(path, "fusion", "blend"),
          perception_at(path), kind_at(path, "calibration", "believed"),
          kind_at(path, "trajectory.drive", "wheels"), kind_at(path, "exploration.planner", "none"),
          path.starts_with("perception.network") ? kBases[1] : base),  // it scores its detections
      "study.yaml");
}

std::string first_key_of(const Study& study) {
  return task_of(study, trials(study)[0], Labels::detected, "recording").key;
}

/// Texts of which some fits any leaf; each is tried until one changes it.
const std::vector<std::string> kTexts{
    "0.3",
    "0.7",
    "0.8",
    "2",
    "3",
    "7",
    "0.02",
    "30",
    "640",
    "0",
    "true",
    "false",
    "\"other\"",
    "[7]",
    "[2]",
    "[0.1, 0.2]",
    "[0.1, 0.2, 0.3]",
    "[[0, 0, 0]]",
    "[[0.5, 0.5], [0.5, 0.5]]",
    "[[1,0,0,0,0,0],[0,1,0,0,0,0],[0,0,1,0,0,0],[0,0,0,1,0,0],[0,0,0,0,1,0],[0,0,0,0,0,1]]",
    "[crate]",
    "points",
    "masks",
    "voxels",
    "box_centre",
    "depth_mode",
    "base",
    "odom",
    "diagonal",
    "full",
    "hit",
    "view",
    "apart",
    "label",
    "neighbours",
    "lattice",
    "instances",
    "surfaces",
    "classes",
    "gaussian",
    "truth",
    "tracking",
    "global",
    "all",
    "votes",
    "likelihood_field",
    "beam",
    "white",
    "walk",
    "depth",
    "color",
    "ideal",
    "kinect_v1",
    "typical",
    "rplidar_a2",
    "map",
    "frame",
    "bgr",
    "probabilities",
    "[1, 2, 3, 4, 5, 6]",
    "{crate: box}"};

/// Whether some other value of the leaf makes the first trial of the base another one.
bool changes_key(const std::string& path, const std::string& base, bool& was_set) {
  const Study study = study_for(path, base);
  const std::string key = first_key_of(study), before = leaf_text(study, path);
  for (const std::string& text : kTexts) {
    Study changed = study;
    try {
      set_leaf(changed, path, text);
    } catch (const Error&) {
      continue;
    }
    if (leaf_text(changed, path) == before) continue;
    was_set = true;
    try {
      if (first_key_of(changed) != key) return true;
    } catch (const Error&) {  // a file that is not there: its content would be in the key
    }
  }
  return false;
}

TEST(EveryLeaf, ChangesTheKeyOrHasAReason) {
  const std::vector<std::string> paths = leaves();
  EXPECT_GE(paths.size(), 190u);
  for (const std::string& path : paths) {
    if (has_reason(path)) continue;
    bool changed = false, was_set = false;
    for (const std::string& base : kBases) changed = changed || changes_key(path, base, was_set);
    EXPECT_TRUE(was_set) << path << ": no text of this test fits it";
    EXPECT_TRUE(changed) << path << ": is read and changes no key";
  }
}

TEST(EveryLeaf, ReasonsAreOfLeavesThatAreThereAndChangeNothing) {
  const std::vector<std::string> paths = leaves();
  for (const auto& [known, reason] : kReasons) {
    bool found = false;
    for (const std::string& path : paths) {
      if (path != known && !(known.ends_with('.') && path.starts_with(known))) continue;
      found = true;
      bool was_set = false;
      EXPECT_FALSE(changes_key(path, kBases[0], was_set)) << path << ": " << reason;
    }
    EXPECT_TRUE(found) << known;
  }
}

}  // namespace
}  // namespace mapscore::eval
