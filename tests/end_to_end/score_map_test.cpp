// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/recording/recording.hpp"
#include "eval/report/colours.hpp"
#include "files/png.hpp"
#include "tests/end_to_end/program.hpp"
#include "tests/end_to_end/tiny_study.hpp"

#include <fmt/format.h>
#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>
#include <opencv2/imgcodecs.hpp>

#include <bit>
#include <cstring>
#include <limits>
#include <sstream>

// Maps that other programs wrote, scored by the built program.

namespace mapscore::testing {
namespace {

struct SeenPoint {
  Eigen::Vector3d p_world;
  ClassId class_id;
};

class ScoreMap : public TinyStudy {
 protected:
  /// Every depth sample of the tiny recording, frame by frame.
  [[nodiscard]] std::vector<std::vector<SeenPoint>> seen() const {
    const auto recording = eval::Recording::open(folder() / "tiny");
    const Calibration& calibration = recording.info().calibration;
    std::vector<std::vector<SeenPoint>> frames;
    for (int n = 0; n < recording.frame_count(); ++n) {
      const Frame frame = recording.read(n, {.depth = true, .depth_label = true});
      const Pose T_world_depth = frame.T_world_base * calibration.T_base_depth;
      auto& points = frames.emplace_back();
      for (int v = 0; v < frame.depth.rows; ++v)
        for (int u = 0; u < frame.depth.cols; ++u)
          if (frame.depth(v, u) != 0)
            points.push_back({T_world_depth * calibration.depth.back_project(
                                                  u, v, frame.depth(v, u) / kDepthUnitsPerMetre),
                              recording.info().table.class_of(frame.depth_label(v, u))});
    }
    return frames;
  }

  [[nodiscard]] Outcome score(const std::string& map, std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{"score", path(map), "--truth", path("tiny")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return mapscore(arguments);
  }

  /// The value of one figure of `score --tidy`.
  [[nodiscard]] std::string figure(const std::string& map, const std::string& class_and_metric,
                                   std::vector<std::string> more = {}) const {
    more.emplace_back("--tidy");
    const Outcome outcome = score(map, more);
    expect_done(outcome);
    const std::size_t at = outcome.out.find("\n" + class_and_metric + ",");
    if (at == std::string::npos) return "no such figure in: " + outcome.out;
    const std::size_t value = at + class_and_metric.size() + 2;
    return outcome.out.substr(value, outcome.out.find('\n', value) - value);
  }
};

octomap::point3d to_octomap(const Eigen::Vector3d& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}

TEST_F(ScoreMap, OfPlainOctoMapCalls) {
  octomap::OcTree tree(0.05);
  for (const auto& frame : seen())
    for (const SeenPoint& point : frame) tree.updateNode(to_octomap(point.p_world), true);
  tree.updateInnerOccupancy();
  tree.prune();
  ASSERT_TRUE(tree.write(path("map.ot")));
  ASSERT_TRUE(tree.writeBinary(path("map.bt")));
  for (const char* map : {"map.ot", "map.bt"}) {
    EXPECT_EQ(figure(map, "surface,precision"), "1") << map;
    EXPECT_EQ(figure(map, "surface,recall"), "1") << map;
  }
}

TEST_F(ScoreMap, WithFreeSpaceCarvedByOctoMap) {
  octomap::OcTree tree(0.05);
  const auto recording = eval::Recording::open(folder() / "tiny");
  int n = 0;
  for (const auto& frame : seen()) {
    octomap::Pointcloud cloud;
    for (const SeenPoint& point : frame) cloud.push_back(to_octomap(point.p_world));
    const Pose T_world_depth =
        recording.T_world_base(n++) * recording.info().calibration.T_base_depth;
    tree.insertPointCloud(cloud, to_octomap(T_world_depth.translation()));
  }
  tree.prune();
  ASSERT_TRUE(tree.writeBinary(path("map.bt")));
  EXPECT_GT(std::stod(figure("map.bt", "all,free_recall")), 0.9);
  EXPECT_GT(std::stod(figure("map.bt", "all,free_precision")), 0.9);
  EXPECT_GT(std::stod(figure("map.bt", "all,occupied_recall")), 0.9);
}

TEST_F(ScoreMap, OfAColorOcTreeInClassColours) {
  octomap::ColorOcTree tree(0.05);
  const auto table = eval::Recording::open(folder() / "tiny").info().table;
  for (const auto& frame : seen()) {
    for (const SeenPoint& point : frame) {
      const Colour colour = table.classes.at(point.class_id).colour;
      tree.updateNode(to_octomap(point.p_world), true);
      tree.setNodeColor(point.p_world.x(), point.p_world.y(), point.p_world.z(), colour.r, colour.g,
                        colour.b);
    }
  }
  ASSERT_TRUE(tree.write(path("map.ot")));
  EXPECT_GT(std::stod(figure("map.ot", "crate,f1")), 0.95);

  // A legend amends the class table, and a note says what it left to the table.
  const std::string crate = fmt::format("{:02X}{:02X}{:02X}", table.classes[1].colour.r,
                                        table.classes[1].colour.g, table.classes[1].colour.b);
  write_text(path("legend.yaml"), "colours: {\"123456\": crate}\n");
  const Outcome amended = score("map.ot", {"--legend", path("legend.yaml")});
  expect_done(amended);
  EXPECT_NE(amended.err.find("does not list"), std::string::npos) << amended.err;
  EXPECT_NE(amended.err.find(crate), std::string::npos) << amended.err;
  write_text(path("legend.yaml"), "colours: {\"" + crate + "\": wall}\n");
  EXPECT_EQ(figure("map.ot", "crate,predicted", {"--legend", path("legend.yaml")}), "0");
  EXPECT_EQ(figure("map.ot", "surface,recall", {"--geometry"}), "1");
}

/// What pcl::io::savePCDFileBinary writes of an organised cloud of PointXYZL; a pixel without depth
/// is NaN, as RGB-D drivers have it.
TEST_F(ScoreMap, OfAnOrganisedPcd) {
  const auto points = seen().front();
  const std::size_t holes = 7;
  std::ostringstream file;
  file << "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z label\n"
          "SIZE 4 4 4 4\nTYPE F F F U\nCOUNT 1 1 1 1\nWIDTH "
       << points.size() + holes << "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS "
       << points.size() + holes << "\nDATA binary\n";
  const auto put = [&](const void* bytes) { file.write(static_cast<const char*>(bytes), 4); };
  const auto put_point = [&](const Eigen::Vector3f& p, std::uint32_t label) {
    for (int axis = 0; axis < 3; ++axis) put(&p[axis]);
    put(&label);
  };
  for (const SeenPoint& point : points) put_point(point.p_world.cast<float>(), point.class_id);
  for (std::size_t n = 0; n < holes; ++n)
    put_point(Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()), 0);
  write_text(path("map.pcd"), file.str());

  expect_refused(score("map.pcd"), {"map.pcd", "7", "--skip_nan"});
  EXPECT_EQ(figure("map.pcd", "crate,recall", {"--skip_nan", "--frames", "0"}), "1");
}

TEST_F(ScoreMap, RefusesWhatDoesNotFit) {
  octomap::OcTree coarse(0.1);
  coarse.updateNode(to_octomap(seen().front().front().p_world), true);
  ASSERT_TRUE(coarse.write(path("coarse.ot")));
  expect_refused(score("coarse.ot"), {"coarse.ot", "0.1", "--voxel_m 0.1", "--resample"});
  expect_done(score("coarse.ot", {"--voxel_m", "0.1"}));
  expect_done(score("coarse.ot", {"--resample"}));

  write_text(path("map.csv"), "i,j,k,class\n2000,0,0,crate\n");
  expect_refused(score("map.csv"), {"map.csv", "another frame", "--transform", "--trust_frame"});
  expect_done(score("map.csv", {"--trust_frame"}));

  write_text(path("legend.yaml"), "colours: {}\n");
  expect_refused(score("map.csv", {"--legend", path("legend.yaml")}), {"legend.yaml", "no class"});
  write_text(path("empty.csv"), "i,j,k,class\n");
  expect_refused(score("empty.csv"), {"empty.csv", "empty"});
  write_text(path("cut.ot"), bytes_of(path("coarse.ot")).substr(0, 120));
  expect_refused(score("cut.ot"), {"cut.ot"});
  expect_refused(score("coarse.ot", {"--resample", "--transform", "1 2 3"}), {"--transform"});
  expect_refused(score("coarse.ot", {"--resample", "--frames", "9"}), {"9", "4 frames"});
  expect_refused(score("map.txt"), {"map.txt", ".ply"});
}

TEST_F(ScoreMap, FlagsThatWouldDoNothingAreRefused) {
  std::filesystem::copy(path("tiny/label"), path("network"));
  expect_done(mapscore({"truth", path("tiny"), "-o", path("truth.csv")}));
  for (const std::vector<std::string>& flags : std::vector<std::vector<std::string>>{
           {"--geometry"},
           {"--threshold", "0.5"},
           {"--transform", "1 0 0 0 0 0 1"},
           {"--errors_ply", "a.ply"},
           {"--view", "4", "1", "2", "5", "3", "0.8", "--picture", "a.png"},
           {"--min_samples", "2"}})
    expect_refused(score("network", flags), {flags.front(), "network", "label images"});
  for (const char* flag : {"--transform", "--legend", "--picture", "--errors_ply"})
    expect_refused(score("truth.csv", {"--resample", flag, ""}), {flag, "empty"});
  expect_refused(score("truth.csv", {"--resample", "--legend="}), {"--legend=", "no value"});
  expect_refused(score("truth.csv", {"--resample", "--geometry", "--legend", "l.yaml"}),
                 {"--legend", "--geometry"});
  expect_refused(score("truth.csv", {"--align", "--trust_frame"}), {"--trust_frame", "--align"});
  for (const std::vector<std::string>& time :
       {std::vector<std::string>{"--frame", "1"}, std::vector<std::string>{"--at_s", "0"}})
    expect_refused(score("truth.csv", time), {time.front(), "nothing moves"});
  expect_refused(mapscore({"score", path("truth.csv"), "--truth", path("truth.csv")}),
                 {"truth.csv", "recording's folder", "scene"});
}

TEST_F(ScoreMap, DetectChoosesWhatPooledFiguresAreOver) {
  expect_done(mapscore({"truth", path("tiny"), "-o", path("truth.csv")}));
  const auto pooled = [&](const std::vector<std::string>& flags) {
    const Outcome outcome = score("truth.csv", flags);
    expect_done(outcome);
    return outcome.out;
  };
  EXPECT_NE(pooled({}).find("pooled and macro over: crate\n"), std::string::npos);
  EXPECT_NE(pooled({"--detect", "wall"}).find("pooled and macro over: wall\n"), std::string::npos);
  EXPECT_NE(pooled({"--detect", "all"}).find("over: crate, wall\n"), std::string::npos);
  EXPECT_EQ(pooled({"--detect", "crate,wall"}), pooled({"--detect", "all"}));
  expect_refused(score("truth.csv", {"--detect", "cup"}), {"detect", "cup"});
}

TEST_F(ScoreMap, SeveralMapsStandInOneTable) {
  expect_done(mapscore({"truth", path("tiny"), "-o", path("good.csv")}));
  write_text(path("one.csv"), "i,j,k,class\n1,1,1,crate\n");
  const auto rows = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"score",   path("good.csv"), path("one.csv"),
                                       "--truth", path("tiny"),     "--trust_frame"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return mapscore(arguments);
  };
  // Each figure as it is of the map alone, under the map's name.
  const Outcome both = rows({"--tidy"});
  expect_done(both);
  EXPECT_TRUE(both.out.starts_with("class,map,metric,value\n")) << both.out;
  for (const char* map : {"good.csv", "one.csv"})
    for (const char* metric : {"f1", "predicted"})
      EXPECT_NE(both.out.find(
                    fmt::format("pooled,{},{},{}\n", path(map), metric,
                                figure(map, fmt::format("pooled,{}", metric), {"--trust_frame"}))),
                std::string::npos)
          << map << both.out;
  // The maps beneath each other, class by class.
  const std::string csv = rows({"--format", "csv"}).out;
  const auto row = [&](const char* group, const char* map) {
    return csv.find(fmt::format("\n{},{},", group, path(map)));
  };
  EXPECT_LT(row("crate", "one.csv"), row("pooled", "good.csv")) << csv;
  EXPECT_LT(row("pooled", "good.csv"), row("pooled", "one.csv"));
  EXPECT_LT(row("pooled", "one.csv"), row("macro", "good.csv"));
  EXPECT_NE(row("macro", "one.csv"), std::string::npos);
  expect_refused(rows({"--details"}), {"--details", "2 are given"});
  expect_refused(rows({"--picture", path("a.png")}), {"--picture", "one by one"});
  std::filesystem::copy(path("tiny/label"), path("network"));
  expect_refused(rows({path("network")}), {"network", "pixels"});
  write_text(path("bare.csv"), "i,j,k\n1,1,1\n");
  expect_refused(rows({path("bare.csv")}), {"bare.csv", "no labels", "--geometry"});
}

TEST_F(ScoreMap, AMapInAnotherUnitIsNamedForWhatItIs) {
  std::string metres = "x,y,z,class\n", millimetres = metres;
  const auto points = seen().front();
  for (const SeenPoint& point : points) {
    const Eigen::Vector3d p = point.p_world;
    const char* name = point.class_id == 1 ? "crate" : "wall";
    metres += fmt::format("{},{},{},{}\n", p.x(), p.y(), p.z(), name);
    millimetres += fmt::format("{},{},{},{}\n", 1e3 * p.x(), 1e3 * p.y(), 1e3 * p.z(), name);
  }
  write_text(path("metres.csv"), metres);
  write_text(path("millimetres.csv"), millimetres);
  expect_refused(score("millimetres.csv"), {"millimetres.csv", "--scale 0.001", "--trust_frame"});
  EXPECT_EQ(figure("millimetres.csv", "crate,f1", {"--scale", "0.001"}),
            figure("metres.csv", "crate,f1"));
  // Of a flag that is wrong, what mends it is told, not what would mend the map without it.
  expect_refused(score("metres.csv", {"--scale", "0.001"}), {"metres.csv", "give --scale 1,"});
  expect_refused(score("metres.csv", {"--scale", "1000000"}), {"metres.csv", "--scale"});
  write_text(path("voxels.csv"), "1,1,1,crate\n");
  expect_refused(score("voxels.csv", {"--scale", "0.001"}), {"voxels.csv", "--scale"});
  expect_refused(score("voxels.csv", {"--align"}), {"voxels.csv", "--align", "too few"});
}

TEST_F(ScoreMap, ATurnAboutZIsNamedAndItsTransformMendsItFarFromTheOrigin) {
  std::string text = "x,y,z,class\n";
  const auto points = seen().front();
  for (const SeenPoint& point : points) {
    const Eigen::Vector3d& p = point.p_world;
    text += fmt::format("{:.6f},{:.6f},{:.6f},{}\n", 12345.678 - p.y(), 23456.789 + p.x(), p.z(),
                        point.class_id == 1 ? "crate" : "wall");
  }
  write_text(path("far.csv"), text);
  const Outcome outcome = score("far.csv", {"--transform", "-23456.789 12345.678 0 0 0 0 1"});
  const std::string said = outcome.out + outcome.err, flag = "--transform '";
  EXPECT_NE(said.find("it lacks a turn of -90 deg about z"), std::string::npos) << said;
  const std::size_t begin = said.find(flag) + flag.size();
  const std::string transform = said.substr(begin, said.find('\'', begin) - begin);
  EXPECT_EQ(figure("far.csv", "crate,recall", {"--transform", transform, "--frames", "0"}), "1");
}

TEST_F(ScoreMap, ClassesThatFitNothingAreTold) {
  // Every surface where it is, as the crate; then as the wall alone, which is not detected.
  const std::vector<SeenPoint> points = seen().front();
  for (const auto& [name, told] : {std::pair{"crate", "surface of their class"},
                                   std::pair{"wall", "none of the map's occupied voxels"}}) {
    std::string map = "x,y,z,class\n";
    for (const SeenPoint& point : points)
      if (const Eigen::Vector3d p = point.p_world; point.class_id != 1)
        map += fmt::format("{},{},{},{}\n", p.x(), p.y(), p.z(), name);
    write_text(path("map.csv"), map);
    const Outcome outcome = score("map.csv", {"-q"});
    expect_done(outcome);
    EXPECT_NE(outcome.err.find(told), std::string::npos) << outcome.err;
  }
}

TEST_F(ScoreMap, LabelImagesAgainstThemselves) {
  expect_refused(mapscore({"score", path("tiny/label"), "--truth", path("tiny")}),
                 {"tiny/label", "ids of instances"});
  // The tiny recording's instance ids equal its class ids.
  std::filesystem::copy(path("tiny/label"), path("network"));
  const Outcome outcome = mapscore({"score", path("network"), "--truth", path("tiny"), "--tidy"});
  expect_done(outcome);
  EXPECT_NE(outcome.out.find("all,miou,1\n"), std::string::npos) << outcome.out;
}

TEST_F(ScoreMap, LabelImagesTakeDetectAndPicture) {
  const auto recording = eval::Recording::open(folder() / "tiny");
  std::filesystem::copy(path("tiny/label"), path("network"));
  // The wall, class 2, goes unseen in frame 2; where it is not detected that is no error.
  cv::Mat1w labels = recording.read(2).label.clone();
  labels.setTo(0, labels == 2);
  write_text(path("network/000002.png"), encode_png(labels));
  EXPECT_NE(figure("network", "all,pa"), "1");
  EXPECT_EQ(figure("network", "all,pa", {"--detect", "all"}), figure("network", "all,pa"));
  EXPECT_EQ(figure("network", "all,pa", {"--detect", "crate"}), "1");
  expect_refused(score("network", {"--detect", "cup"}), {"detect", "cup"});

  expect_done(score("network", {"--picture", path("errors.png")}));
  const cv::Mat3b picture = cv::imread(path("errors.png"));
  // One row, of the one frame that has errors, and four columns.
  EXPECT_GT(picture.cols, 4 * picture.rows * 3 / 4);
  const Colour missed = eval::kMissedColour;
  const cv::Mat3b column = picture.colRange(3 * picture.cols / 4, picture.cols);
  cv::Mat1b is_missed;
  cv::inRange(column, cv::Vec3b(missed.b, missed.g, missed.r),
              cv::Vec3b(missed.b, missed.g, missed.r), is_missed);
  const double share = double(cv::countNonZero(recording.read(2).label == 2)) / labels.total();
  EXPECT_NEAR(cv::countNonZero(is_missed) / (480.0 * 360.0), share, 0.1 * share);
  expect_refused(score("network", {"--picture", path("errors.jpg")}), {"errors.jpg", ".png"});
}

}  // namespace
}  // namespace mapscore::testing
