// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/foreign/trial_folder.hpp"
#include "eval/lab/bench.hpp"
#include "eval/lab/folder_mapping.hpp"
#include "eval/lab/trial_writer.hpp"
#include "eval/results/study_store.hpp"
#include "files/file_bytes.hpp"
#include "files/png.hpp"
#include "tests/eval/lab/driven_recording.hpp"
#include "tests/eval/lab/tiny_experiment.hpp"
#include "tests/support/expect_error.hpp"

#include <gmock/gmock.h>

#include <functional>
#include <numeric>
#include <set>

// A trial written as a folder and read back gives the map of the trial, to the bit, whatever the
// fault.

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;
using mapscore::testing::expect_error;
using testing::study_of;

class FaultyTrial : public ::testing::Test {
 protected:
  FaultyTrial() : recording_(opened()) {}

  [[nodiscard]] const Recording& recording() const { return recording_; }
  [[nodiscard]] fs::path path(const std::string& name) const { return temporary_.path() / name; }

  [[nodiscard]] Task task(const std::string& lines, int seed = 0) const {
    const Study study = study_of(lines + "seeds: 3\n");
    return task_of(study, {0, "direct", cells(study)[0], seed}, Labels::detected,
                   recording().content_hash());
  }
  [[nodiscard]] ClassTable table(const Task& task) const {
    return detected_table(task.config, recording().info().table);
  }

  /// The folder of a trial, emptied before.
  [[nodiscard]] fs::path written(const Task& task) const {
    const fs::path folder = path("trial");
    fs::remove_all(folder);
    make_folder(folder);
    const ClassTable classes = table(task);
    const Sights sights(task, recording(), classes);
    PoseSources poses(recording());
    const auto beliefs = poses.beliefs(task, sights.depth_of_frames());
    write_trial({task, recording(), sights, beliefs, recording().folder(),
                 [&](int index, int depth_index) {
                   return std::make_shared<const Frame>(recording().read(index, depth_index));
                 }},
                folder);
    return folder;
  }

  /// Bytes of the map that the folder gives.
  [[nodiscard]] std::string map_of(const fs::path& folder) const {
    const TrialFolder trial(folder);
    const Study study = load_study(folder / "method.yaml");
    const FolderMapping mapping{
        mapping_of(study, {trial.sheet().classes}), {}, study.methods.front().refinement};
    std::vector<int> frames(static_cast<std::size_t>(trial.frame_count()));
    std::iota(frames.begin(), frames.end(), 0);
    MappedCounts counts;
    return bytes_of(map_trial(trial, frames, mapping, counts, [](int, int) {}));
  }

  /// Bytes of the map of the trial itself.
  [[nodiscard]] std::string map_of(const Task& task) const {
    const ClassTable classes = table(task);
    Bench bench(recording(), classes, true, std::size_t{1} << 24);
    const auto run = bench.start(task);
    bench.run(*run);
    static_cast<void>(run->finish());
    return bytes_of(run->map());
  }

 private:
  [[nodiscard]] Recording opened() const {
    testing::write_driven_recording(path("tiny"), true);
    return Recording::open(path("tiny"));
  }
  [[nodiscard]] std::string bytes_of(const SemanticMap& map) const {
    map.save(path("map.ot"));
    return read_file(path("map.ot"));
  }

  mapscore::testing::TemporaryFolder temporary_;
  Recording recording_;
};

/// Lines of a study, each a fault or a way to map.
const std::vector<std::string> kTrials{
    "",
    "faults: {misregistration: {magnitude_m: 0.03}}",
    "faults: {misregistration: {translation_m: [0.01, -0.02, 0.003]}}",
    "faults: {misregistration: {angle_deg: 2}}",
    "faults: {misregistration: {focal_error_percent: 5}}",
    "faults: {misregistration: {principal_point_px: [2, -3]}}",
    "faults: {mount: {magnitude_m: 0.05}}",
    "faults: {mount: {angle_deg: 3}}",
    "faults: {pose: {sigma_xy_m: 0.05}}",
    "faults: {pose: {sigma_z_m: 0.04, sigma_roll_pitch_deg: 1}}",
    "faults: {pose: {sigma_yaw_deg: 3, kind: walk}}",
    "faults: {pose: {sigma_xy_m: 0.05, sigma_yaw_deg: 2}}\n"
    "fusion: {blend: {N: 4, noise_at: odom, covariance: full}}",
    "faults: {pose: {sigma_xy_m: 0.05, stamp: depth}, time_offset_ms: 500}",
    "faults: {time_offset_ms: 500}",
    "faults: {time_offset_ms: -500}",
    "faults: {depth: {axial: 3}}",
    "faults: {depth: {lateral: 1}}",
    "faults: {depth: {quantisation: 10}}",
    "faults: {depth: {grazing: 1, grazing_from_deg: 5, grazing_to_deg: 30}}",
    "faults: {depth: {flying: 5}}",
    "faults: {depth: {range: 1, range_min_m: 1.5}}",
    "faults: {depth: {shadow: 3}}",
    "faults: {depth: {preset: astra}}",
    "faults: {labels: {boundary_px: 2}}",
    "faults: {labels: {boundary_px: -2}}",
    "faults: {labels: {ragged_px: 2}}",
    "faults: {labels: {miss: 1, miss_area_px: 2000}}",
    "faults: {labels: {holes: 0.3, disc_radius_px: 1}}",
    "faults: {labels: {islands: 0.5, disc_radius_px: 1}}",
    "faults: {labels: {confusion: 1}}\ndetect: all",
    "faults: {labels: {scores: 1, score_mean: 0.5}}",
    "faults: {labels: {preset: typical}}\ndetect: all",
    "perception: {simulated: {}}",
    "perception: {simulated: {boxes: surfaces}}\nfaults: {labels: {confusion: 1}}\ndetect: all",
    "localization: {source: truth}",
    "localization: {source: odometry}\nfusion: {blend: {N: 3, noise_at: odom}}",
    "localization: {source: particle_filter}\nfaults: {lidar: {preset: rplidar_a2}}",
    "map_origin_m: [0.013, -0.4, 0.02]\nmap_yaw_deg: 33",
    "voxel_m: 0.03\nplace: voxels",
    "occupancy: {carve: true}",
    "fusion: {vote: {N: 5}}\nfaults: {pose: {sigma_yaw_deg: 4}}",
};

TEST_F(FaultyTrial, IsMappedFromItsFolderToTheBit) {
  std::set<std::string> maps;
  for (const std::string& lines : kTrials)
    for (const int seed : {0, 2}) {
      const Task of = task(lines + "\n", seed);
      const std::string expected = map_of(of);
      EXPECT_EQ(map_of(written(of)), expected) << lines << " seed " << seed;
      maps.insert(expected);
    }
  EXPECT_GT(maps.size(), kTrials.size()) << "the trials are hardly apart";
}

TEST_F(FaultyTrial, TakesSegmentationAndRefinementFromMethodYaml) {
  for (const std::string method : {"{segmentation: {region_growing: {radius_factor: 0.5}}}",
                                   "{segmentation: {erosion: {radius_px: 1}}, place: voxels}",
                                   "{segmentation: {direct: {}}, fusion: {bayes: {}}}",
                                   "{segmentation: {direct: {}}, refinement: {crf: {}}}"}) {
    Study study = parse_study("recording: tiny\nmethods: {mine: " + method + "}\n", "study.yaml");
    study.faults.labels.own.values.boundary_px = 1;
    study.faults.labels.own.given.insert("boundary_px");
    const Task of = task_of(study, trials(study)[0], Labels::detected, recording().content_hash());
    EXPECT_EQ(map_of(written(of)), map_of(of)) << method;
  }
}

TEST_F(FaultyTrial, OfANetworksLabelImagesIsMappedToo) {
  make_folder(path("labels"));
  for (int index = 0; index < recording().frame_count(); ++index) {
    cv::Mat1w image = cv::Mat1w::zeros(recording().read(index).label.size());
    image.setTo(56, recording().read(index).label == 1);
    image(cv::Rect(index, 2, 9, 7)).setTo(56);  // another piece
    write_file(path("labels") / fs::path(recording().color_path(index)).filename(),
               encode_png(image));
  }
  write_file(path("classes.yaml"), "classes: [{name: crate, label: 56}]\n");
  for (const char* more : {"", "faults: {labels: {scores: 1}, pose: {sigma_xy_m: 0.02}}\n",
                           "faults: {labels: {boundary_px: 1}, depth: {axial: 2}}\n"}) {
    const Task of = task("perception: {images: {folder: " + path("labels").string() +
                         ", classes: " + path("classes.yaml").string() + "}}\n" + more);
    EXPECT_EQ(map_of(written(of)), map_of(of)) << more;
  }
}

TEST_F(FaultyTrial, HoldsNothingOfTheTruth) {
  const fs::path folder =
      written(task("faults: {labels: {confusion: 1, miss: 0.2}, pose: {sigma_xy_m: 0.1}}\n"));
  std::set<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().lexically_relative(folder).string();
    files.insert(name.substr(0, name.find('/')));
    const fs::path ending = entry.path().extension();
    if (!entry.is_regular_file() || ending == ".png" || ending == ".bin") continue;
    for (const char* secret : {"crate_", "groundtruth", "faults", "sigma"})
      EXPECT_THAT(read_file(entry.path()), ::testing::Not(::testing::HasSubstr(secret))) << name;
  }
  const TrialFolder trial(folder);
  for (const TrialFrame& frame : trial.sheet().frames) {
    const Pose T_map_base = frame.belief.T_map_odom * frame.belief.T_odom_base;
    EXPECT_GT(
        (T_map_base.translation() - recording().T_world_base(frame.index).translation()).norm(),
        0.01);
  }
  EXPECT_EQ(files, (std::set<std::string>{"beliefs.csv", "color", "depth", "detections.csv",
                                          "frames.csv", "label", "method.yaml", "odometry.txt",
                                          "poses.txt", "scan", "trial.yaml"}));
}

/// Of the files below a folder: how many are links to a recording's, and bytes of the others.
struct Cost {
  int links = 0;
  std::uintmax_t bytes = 0;
};
Cost cost_of(const fs::path& folder) {
  Cost cost;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      entry.hard_link_count() > 1 ? void(++cost.links) : void(cost.bytes += entry.file_size());
  return cost;
}

TEST_F(FaultyTrial, LinksWhatNoDoseTouches) {
  const int frames = recording().frame_count();
  EXPECT_EQ(cost_of(written(task("faults: {misregistration: {magnitude_m: 0.03}}\n"))).links,
            3 * frames + 2);  // and the logs
  EXPECT_EQ(cost_of(written(task("faults: {depth: {axial: 3}}\n"))).links, 2 * frames + 2);
  EXPECT_EQ(cost_of(written(task("faults: {labels: {boundary_px: 1}}\n"))).links, 2 * frames + 2);
  EXPECT_EQ(cost_of(written(task("faults: {labels: {scores: 1}}\n"))).links, 3 * frames + 2);
}

TEST_F(FaultyTrial, RefusesAFolderThatWasChanged) {
  const Task of = task("faults: {pose: {sigma_xy_m: 0.05}, labels: {confusion: 1}}\ndetect: all\n");
  const auto refused = [&](const std::string& file, const std::string& part,
                           const std::function<std::string(std::string)>& change) {
    const fs::path folder = written(of);
    const std::string bytes = change(read_file(folder / file));
    fs::remove(folder / file);  // it may be a link
    write_file(folder / file, bytes);
    expect_error(file == "frames.csv" ? "" : file, [&] { static_cast<void>(map_of(folder)); });
    expect_error(part, [&] { static_cast<void>(map_of(folder)); });
  };
  const auto replaced = [](const std::string& from, const std::string& to) {
    return [=](std::string text) {
      const std::size_t at = text.find(from);
      EXPECT_NE(at, text.npos) << from;
      return text.replace(at, from.size(), to);
    };
  };
  const auto cut = [](const std::string& text) { return text.substr(0, text.size() - 30); };
  refused("trial.yaml", "trial of format 2", replaced("trial_format: 1", "trial_format: 2"));
  refused("trial.yaml", "T_color_depth", replaced("T_color_depth: [1", "T_color_depth: [2"));
  refused("trial.yaml", "unknown key", replaced("study:", "stduy:"));
  refused("frames.csv", "is no number above", replaced("\n1,0.5", "\n1,0"));
  refused("frames.csv", "leads out of the folder", replaced("color/000001", "../color/000001"));
  refused("beliefs.csv", "frames.csv", replaced("\n1,0.5", "\n2,0.5"));
  refused("beliefs.csv", "", cut);
  refused("poses.txt", "other poses than beliefs.csv", replaced("\n0.5 ", "\n0.5 1"));
  refused("detections.csv", "class", replaced("\n0,0,1,", "\n0,0,1,99"));
  refused("detections.csv", "stands in a line before", [](const std::string& text) {
    const std::size_t first = text.find('\n') + 1;
    return text + text.substr(first, text.find('\n', first) + 1 - first);
  });
  refused("detections.csv", "not in frames.csv", replaced("\n0,0,1,", "\n99,0,1,"));
  refused("depth/000002.png", "", cut);
  refused("label/000002.png", "", cut);
  refused("method.yaml", "segmentatoin", replaced("segmentation:", "segmentatoin:"));
}

TEST_F(FaultyTrial, LabelImagesOfALayerThatNoLineNamesAreRefused) {
  const fs::path folder = written(task("faults: {misregistration: {magnitude_m: 0.03}}\n"));
  fs::copy(folder / "label", folder / "label_1");
  expect_error("layer 1", [&] { static_cast<void>(map_of(folder)); });
}

TEST_F(FaultyTrial, OfSingleFramesIsRefused) {
  expect_error("score.unit", [&] { static_cast<void>(written(task("score: {unit: frame}\n"))); });
}

}  // namespace
}  // namespace mapscore::eval
