// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/foreign/label_classes.hpp"

#include "core/error.hpp"
#include "files/yaml_value.hpp"

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <limits>
#include <map>

namespace mapscore::eval {
namespace {

constexpr std::uint64_t kMostLabel = std::numeric_limits<std::uint16_t>::max();

/// Colours that tell classes apart: hues a golden ratio of the circle from one another.
Colour hue(std::size_t n) {
  const double turn = 6.0 * std::fmod(0.618033988749895 * static_cast<double>(n), 1.0);
  const auto level = [&](double shift) {
    const double x = std::fmod(turn + shift, 6.0);
    return static_cast<std::uint8_t>(255 * std::clamp(std::abs(x - 3.0) - 1.0, 0.0, 1.0));
  };
  return {level(0), level(4), level(2)};
}

/// One entry of `classes`; its pixel value goes into `class_of_pixel`.
void add_class(const YamlValue& item, LabelClasses& classes) {
  item.only({"name", "label", "colour", "detect"});
  auto& known = classes.table.classes;
  SemanticClass added{static_cast<ClassId>(known.size()), item.at("name").name(), hue(known.size()),
                      true};
  if (item.has("colour")) added.colour = item.at("colour").colour();
  if (item.has("detect")) added.detect = item.at("detect").boolean();
  for (const SemanticClass& other : known)
    if (other.name == added.name) item.fail("two classes have this name; rename one");
  const std::size_t label = item.has("label") ? item.at("label").whole(0, kMostLabel) : added.id;
  auto& meaning = classes.class_of_pixel;
  if (meaning.size() <= label) meaning.resize(label + 1, kBackground);
  if (meaning[label] != kBackground)
    item.fail(
        fmt::format("label {} is taken by {}; give another", label, known[meaning[label]].name));
  meaning[label] = added.id;
  known.push_back(std::move(added));
}

/// `{id: N, class: NAME}` each; ids that are left out are background.
void add_instances(const YamlValue& list, ClassTable& table) {
  for (const YamlValue& item : list.elements()) {
    item.only({"id", "class"});
    const auto id = static_cast<InstanceId>(item.at("id").whole(1, kMostLabel));
    const std::string name = item.at("class").text();
    const auto found = std::ranges::find(table.classes, name, &SemanticClass::name);
    if (found == table.classes.end())
      item.fail(fmt::format("no class of this file is called '{}'; list it above", name));
    while (table.instances.size() <= id)
      table.instances.push_back(
          {static_cast<InstanceId>(table.instances.size()), "unlisted", kBackground});
    table.instances[id] = {id, fmt::format("{}_{}", name, id), found->id};
  }
}

/// Marks the components of one class; returns the next free instance.
int number_components(const cv::Mat1b& mask, int next, cv::Mat1w& instances) {
  cv::Mat1i component;
  const int count = cv::connectedComponents(mask, component, 8, CV_32S);
  std::map<int, int> instance_of;  // components in the order of their first pixels
  for (int v = 0; v < mask.rows; ++v) {
    for (int u = 0; u < mask.cols; ++u) {
      if (component(v, u) == 0) continue;
      const auto [entry, is_new] =
          instance_of.try_emplace(component(v, u), next + static_cast<int>(instance_of.size()));
      instances(v, u) = static_cast<std::uint16_t>(entry->second);
    }
  }
  return next + count - 1;
}

}  // namespace

LabelClasses read_label_classes(const std::filesystem::path& file) {
  const YamlValue root = load_yaml(file);
  root.only({"classes", "instances"});
  LabelClasses classes;
  for (const YamlValue& item : root.at("classes").elements()) {
    if (classes.table.classes.size() > kMostLabel) item.fail("more than 65535 classes");
    add_class(item, classes);
  }
  const auto detected = [](const SemanticClass& c) { return c.detect; };
  if (std::ranges::none_of(classes.table.classes, detected))
    root.at("classes").fail("no class is detected; leave out detect: false of one");
  classes.has_instances = root.has("instances");
  if (classes.has_instances) add_instances(root.at("instances"), classes.table);
  return classes;
}

LabelledImage instances_of(const cv::Mat1w& label, const LabelClasses& classes, ClassMasks masks) {
  if (classes.has_instances) return {label, classes.table};
  LabelledImage image{cv::Mat1w::zeros(label.size()), classes.table};
  cv::Mat1w of_class = cv::Mat1w::zeros(label.size());
  std::vector<bool> present(classes.table.classes.size());
  for (int v = 0; v < label.rows; ++v) {
    for (int u = 0; u < label.cols; ++u) {
      if (label(v, u) >= classes.class_of_pixel.size()) continue;
      of_class(v, u) = classes.class_of_pixel[label(v, u)];
      present[of_class(v, u)] = true;
    }
  }
  int next = 1;
  for (const SemanticClass& c : classes.table.classes) {
    if (!c.detect || !present[c.id]) continue;
    const cv::Mat1b mask = of_class == c.id;
    const int first = next;
    if (masks == ClassMasks::components)
      next = number_components(mask, next, image.instances);
    else
      image.instances.setTo(next++, mask);
    if (next > static_cast<int>(kMostLabel))
      throw Error("a label image has more than 65534 components; give --masks classes");
    for (int n = first; n < next; ++n)
      image.table.instances.push_back({static_cast<InstanceId>(n), c.name, c.id});
  }
  return image;
}

}  // namespace mapscore::eval
