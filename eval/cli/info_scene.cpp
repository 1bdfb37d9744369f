// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/info_scene.hpp"

#include "core/error.hpp"
#include "core/whole_file.hpp"
#include "eval/cli/shared/options.hpp"
#include "eval/render/study_recording.hpp"
#include "eval/report/pictures/caption.hpp"
#include "eval/report/pictures/scene.hpp"
#include "eval/report/pictures/view.hpp"
#include "files/text.hpp"
#include "sim/inventory/class_suggestion.hpp"
#include "sim/inventory/scene_inventory.hpp"
#include "sim/world/shape_bounds.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iostream>
#include <map>
#include <vector>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNoLight =
    "no light shines: a head light at the camera will light the images; add a <light> to the scene "
    "to light it otherwise";

std::vector<int> instances_by_class(const ClassTable& table) {
  std::vector<int> counts(table.classes.size(), 0);
  for (const Instance& instance : table.instances)
    if (instance.id != 0) ++counts.at(instance.class_id);
  return counts;
}

}  // namespace

void print_classes(const ClassTable& table) {
  const std::vector<int> instances = instances_by_class(table);
  std::cout << fmt::format("{:>4}  {:<16} {:<8} {:<7} {}\n", "id", "class", "colour", "detect",
                           "instances");
  for (const SemanticClass& c : table.classes)
    std::cout << fmt::format("{:>4}  {:<16} {:02X}{:02X}{:02X}   {:<7} {}\n", c.id, c.name,
                             c.colour.r, c.colour.g, c.colour.b, c.detect ? "yes" : "no",
                             instances.at(c.id));
}

#ifdef MAPSCORE_SIMULATOR

namespace {

void print_kinds(const fs::path& file, const SceneSurfaces& scene) {
  std::cout << fmt::format("{}: scene of {} drawn surfaces\n", shown(file), scene.shapes.size());
  std::map<std::string, int> kinds;
  for (const Shape& shape : scene.shapes) ++kinds[name_of(shape.kind)];
  for (const auto& [kind, count] : kinds) std::cout << fmt::format("  {:<10} {}\n", kind, count);
}

std::string place_of(const Eigen::AlignedBox3d& bounds) {
  if (bounds.isEmpty()) return "a plane without end";
  const Eigen::Vector3d c = bounds.center(), size = bounds.sizes();
  return fmt::format("about ({:.2f}, {:.2f}, {:.2f}), {:.3g} x {:.3g} x {:.3g} m", c.x(), c.y(),
                     c.z(), size.x(), size.y(), size.z());
}

void print_bounds(const Eigen::AlignedBox3d& bounds) {
  if (bounds.isEmpty()) return;
  const Eigen::Vector3d &low = bounds.min(), &high = bounds.max();
  std::cout << fmt::format("  x {:.3f} to {:.3f}, y {:.3f} to {:.3f}, z {:.3f} to {:.3f} m\n",
                           low.x(), high.x(), low.y(), high.y(), low.z(), high.z());
}

void print_unmatched(const std::vector<sim::BodyEntry>& bodies) {
  for (std::size_t body = 0; body < bodies.size(); ++body) {
    const sim::BodyEntry& entry = bodies[body];
    if (entry.matched || entry.drawn_geoms == 0) continue;
    const std::string name = entry.name.empty() ? fmt::format("(body {})", body)
                                                : fmt::format("'{}'", shown(entry.name));
    std::cout << fmt::format("no class matches body {}: {} geoms, {}\n", name, entry.drawn_geoms,
                             place_of(entry.bounds));
  }
}

/// Says what a reader of the picture would otherwise wonder about.
std::vector<std::string> notes_on(const sim::SceneInventory& inventory) {
  const sim::Unseen& unseen = inventory.unseen;
  std::vector<std::string> notes;
  const auto add = [&](int count, const std::string& text) {
    if (count > 0) notes.push_back(fmt::format("{} {}", count, text));
  };
  add(unseen.transparent,
      fmt::format("geoms of alpha below 1 are left out (bodies: {}); `opaque: true` in the class "
                  "file makes them solid",
                  fmt::join(unseen.transparent_bodies, ", ")));
  add(unseen.hidden_groups, "geoms in groups 3 to 5 are neither seen nor truth (collision hulls)");
  add(unseen.invisible, "geoms of alpha 0 are neither seen nor truth");
  add(unseen.infinite_planes, "planes without end are cut at the bounds of everything else");
  add(unseen.flexes, "flexes are neither seen nor truth; use a mesh for what should count");
  add(unseen.skins, "skins are neither seen nor truth; the geoms below them are");
  add(unseen.keyframes, "keyframes are not used: bodies stand as the file places them (qpos0)");
  if (unseen.no_light) notes.emplace_back(kNoLight);
  const double size = inventory.bounds.isEmpty() ? 1.0 : inventory.bounds.sizes().norm();
  if (size < 0.3)
    notes.push_back(fmt::format(
        "all is {:.3g} m across: smaller voxels and a camera nearer than 0.6 m may be wanted "
        "(voxel_m, cameras.range_min_m)",
        size));
  if (size > 100.0)
    notes.push_back(
        fmt::format("all is {:.3g} m across: the truth of small voxels takes long", size));
  return notes;
}

/// Bounds of everything but planes, which often reach far beyond what stands on them.
Eigen::AlignedBox3d looked_at(const SceneSurfaces& scene) {
  Eigen::AlignedBox3d all, standing;
  for (const Shape& shape : scene.shapes) {
    const Eigen::AlignedBox3d box = sim::bounds_of(shape);
    all.extend(box);
    if (shape.kind != ShapeKind::plane) standing.extend(box);
  }
  if (!standing.isEmpty()) return standing;
  return all.isEmpty() ? Eigen::AlignedBox3d(Eigen::Vector3d(-1, -1, 0), Eigen::Vector3d(1, 1, 0))
                       : all;
}

cv::Mat3b class_picture(const fs::path& file, const SceneSurfaces& scene) {
  ScenePainter painter(file);
  const ClassTable& table = scene.table;
  const std::vector<int> instances = instances_by_class(table);
  std::vector<LegendEntry> legend;
  for (const SemanticClass& c : table.classes)
    if (c.id != kBackground && instances.at(c.id) > 0)
      legend.push_back({c.colour, fmt::format("{} ({})", c.name, instances.at(c.id))});
  legend.push_back({Colour{0xB0, 0xB0, 0xB0}, "no class"});
  return captioned(painter.paint_classes(overview(looked_at(scene))),
                   fmt::format("{}: classes and their instances", file.filename().string()),
                   legend);
}

void draw_classes(const fs::path& file, const SceneSurfaces& scene, const SceneInfoFlags& flags) {
  fs::path picture = flags.picture;
  if (picture.empty()) picture = fs::path(file).replace_extension(".classes.png");
  const cv::Mat3b drawn = class_picture(file, scene);
  try {
    std::cout << "picture: " << shown(write_picture(picture, drawn)) << '\n';
  } catch (const Error& error) {
    if (!flags.picture.empty()) throw;
    std::cout << "no picture: " << shown(error.what()) << " (--picture FILE)\n";
  }
}

void suggest(const fs::path& scene, const SceneInfoFlags& flags) {
  if (!flags.picture.empty())
    throw Error("--picture: a suggestion draws none; leave out one of the flags");
  const sim::SceneInventory inventory = sim::take_inventory(scene);
  if (inventory.unseen.no_light) std::cerr << "info: note: " << kNoLight << '\n';
  const std::string text =
      sim::class_file_text(sim::suggest_classes(inventory.bodies), scene.filename().string());
  if (flags.output.empty()) return void(std::cout << text);
  if (fs::exists(flags.output)) throw Error(flags.output + ": exists already; give another file");
  write_whole_file(flags.output, text);
}

}  // namespace

void info_of_scene(const fs::path& file, const SceneInfoFlags& flags) {
  check_outputs({{"--picture", flags.picture, ".png"}});
  if (flags.suggest_classes) return suggest(file, flags);
  if (!flags.output.empty())
    throw Error("--output: only a suggestion is written; add --suggest_classes");
  const SceneSurfaces scene = surfaces_of_scene(file);
  const sim::SceneInventory inventory = sim::take_inventory(file);
  print_kinds(file, scene);
  print_bounds(inventory.bounds);
  print_classes(scene.table);
  print_unmatched(inventory.bodies);
  for (const std::string& note : notes_on(inventory)) std::cout << "note: " << shown(note) << '\n';
  if (!flags.no_picture) draw_classes(file, scene, flags);
}

#else

void info_of_scene(const fs::path& file, const SceneInfoFlags&) {
  (void)surfaces_of_scene(file);  // refuses
}

#endif

}  // namespace mapscore::eval
