// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/recording/recording.hpp"
#include "eval/recording/recording_writer.hpp"
#include "files/file_bytes.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/mutations.hpp"
#include "tests/support/tiny_recording.hpp"

#include <fmt/format.h>

namespace mapscore::eval {
namespace {

constexpr std::uint64_t kYamlMutations = 3000, kListMutations = 600;

/// The tiny recording with a mesh beside its crate and wall, one of whose files is damaged.
struct DamagedRecording : ::testing::Test {
  DamagedRecording() {
    RecordingWriter writer(folder_, testing::tiny_info());
    for (const Frame& frame : testing::tiny_frames()) testing::write_frame(writer, frame);
    std::vector<Shape> shapes = testing::tiny_shapes();
    Shape mesh;
    mesh.kind = ShapeKind::mesh;
    mesh.instance = 1;
    mesh.name = "wedge";
    mesh.triangles = {
        {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0)},
        {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0)}};
    shapes.push_back(mesh);
    writer.write_shapes(shapes);
    writer.finish();
  }

  /// All that a recording holds.
  void read() const {
    const Recording recording = Recording::open(folder_);
    for (int index = 0; index < recording.frame_count(); ++index)
      (void)recording.read(index,
                           {.color = true, .label = true, .depth = true, .depth_label = true});
    (void)recording.read_shapes();
  }

  void put(const std::string& name, const std::string& bytes) const {
    std::filesystem::remove(folder_ /
                            name);  // some file systems wait for the disk on replaced files
    write_file(folder_ / name, bytes);
  }

  void expect_read_or_refused(const std::string& name, std::uint64_t count) const {
    const std::string whole = read_file(folder_ / name);
    ASSERT_NO_THROW(read());
    const auto tally = testing::read_mutations(whole, count, [&](const std::string& bytes) {
      put(name, bytes);
      read();
    });
    EXPECT_GT(tally.refused, static_cast<int>(count) / 4);
  }

  void expect_refusal(const std::string& name, const std::string& bytes, const std::string& part) {
    put(name, bytes);
    testing::expect_error(part, [&] { read(); });
  }

  testing::TemporaryFolder own_;
  std::filesystem::path folder_ = own_.path() / "recording";
};

TEST_F(DamagedRecording, Yaml) {
  expect_read_or_refused("recording.yaml", kYamlMutations);
}

TEST_F(DamagedRecording, Lists) {
  for (const char* name : {"color.txt", "depth.txt", "groundtruth.txt", "hashes.txt"}) {
    const std::string whole = read_file(folder_ / name);
    expect_read_or_refused(name, kListMutations);
    put(name, whole);
  }
}

TEST_F(DamagedRecording, Surfaces) {
  for (const char* name : {"truth/shapes.csv", "truth/triangles.ply"}) {
    const std::string whole = read_file(folder_ / name);
    expect_read_or_refused(name, kListMutations);
    put(name, whole);
  }
}

TEST_F(DamagedRecording, YamlNestedWithoutEndIsRefused) {
  for (const char* open : {"[", "{", "{a: ", "- ", "? ", "[{a: "}) {
    std::string nested;
    for (int depth = 0; depth < 20'000; ++depth) nested += open;
    expect_refusal("recording.yaml", nested, "recording.yaml:");
  }
}

TEST_F(DamagedRecording, WhatRefersToItselfIsRefused) {
  expect_refusal("recording.yaml", "&a {format_version: 1, depth: *a, color: *a}",
                 "recording.yaml:");
  expect_refusal("recording.yaml", "format_version: &a [*a, *a]\n", "is a list; write a text");
}

TEST_F(DamagedRecording, LineBreaksInAMessageAreNotRepeated) {
  expect_refusal("recording.yaml", "format_version: \"1\\n2\"\n", "format_version");
  expect_refusal("recording.yaml", "format_version: 1\n\"sce\\nne\": 2\n",
                 "unknown key 'sce\\nne'");
  expect_refusal("recording.yaml", "scene: \"\\\rx\"\n", "unknown escape character: \\r");
}

TEST_F(DamagedRecording, NamesThatNoFileCanHaveAreRefused) {
  const std::string name(5000, 'a');  // comes first by name
  expect_refusal("color.txt", "0 " + name + "\n0.5 b\n1 c\n1.5 d\n", "image is missing");
}

}  // namespace
}  // namespace mapscore::eval
