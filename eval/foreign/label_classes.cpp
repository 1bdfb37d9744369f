// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/foreign/label_classes.hpp"

#include "core/error.hpp"
#include "files/yaml_value.hpp"

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <limits>

namespace mapscore::eval {
namespace {

constexpr std::uint64_t kMostLabel = std::numeric_limits<std::uint16_t>::max();

std::size_t values_of_label(bool has_instances, ClassMasks masks) {
  return !has_instances && masks == ClassMasks::instances ? kInstancesOfLabel : 1;
}

/// Colours that tell classes apart: hues a golden ratio of the circle from one another.
Colour hue(std::size_t n) {
  const double turn = 6.0 * std::fmod(0.618033988749895 * static_cast<double>(n), 1.0);
  const auto level = [&](double shift) {
    const double x = std::fmod(turn + shift, 6.0);
    return static_cast<std::uint8_t>(255 * std::clamp(std::abs(x - 3.0) - 1.0, 0.0, 1.0));
  };
  return {level(0), level(4), level(2)};
}

/// `label` of an entry, one or several; by default the class's id.
std::vector<std::size_t> labels_of(const YamlValue& item, std::size_t id) {
  if (!item.has("label")) return {id};
  const YamlValue label = item.at("label");
  if (!label.node.IsSequence()) return {label.whole(0, kMostLabel)};
  std::vector<std::size_t> labels;
  for (const YamlValue& one : label.elements()) labels.push_back(one.whole(0, kMostLabel));
  if (labels.empty()) label.fail("names no label; give one at least, or leave the class out");
  return labels;
}

/// One entry of `classes`; its pixel value, at most `most`, goes into `class_of_pixel`.
void add_class(const YamlValue& item, std::size_t most, LabelClasses& classes) {
  item.only({"name", "label", "colour", "detect"});
  auto& known = classes.table.classes;
  SemanticClass added{static_cast<ClassId>(known.size()), item.at("name").name(), hue(known.size()),
                      true};
  if (item.has("colour")) added.colour = item.at("colour").colour();
  if (item.has("detect")) added.detect = item.at("detect").boolean();
  for (const SemanticClass& other : known)
    if (other.name == added.name) item.fail("two classes have this name; rename one");
  auto& meaning = classes.class_of_pixel;
  for (const std::size_t label : labels_of(item, added.id)) {
    if (label > most)
      item.fail(
          fmt::format("label {} is no class of masks instances, whose pixels are {} * label "
                      "+ instance; give one of at most {}, or cut by masks components",
                      label, kInstancesOfLabel, most));
    if (meaning.size() <= label) meaning.resize(label + 1, kBackground);
    if (meaning[label] == added.id)
      item.fail(fmt::format("label {} stands twice; keep one", label));
    if (meaning[label] != kBackground)
      item.fail(
          fmt::format("label {} is taken by {}; give another", label, known[meaning[label]].name));
    meaning[label] = added.id;
  }
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
  std::vector<int> instance_of(static_cast<std::size_t>(count));  // in the order of first pixels
  int free = next;
  for (int v = 0; v < mask.rows; ++v) {
    for (int u = 0; u < mask.cols; ++u) {
      if (component(v, u) == 0) continue;
      int& instance = instance_of[static_cast<std::size_t>(component(v, u))];
      if (instance == 0) instance = free++;
      instances(v, u) = static_cast<std::uint16_t>(instance);
    }
  }
  return free;
}

/// The image with each pixel's class in place of its value.
cv::Mat1w classes_at_pixels(const cv::Mat1w& label, const std::vector<ClassId>& class_of_value) {
  cv::Mat1w classes(label.size());
  std::transform(label.begin(), label.end(), classes.begin(),
                 [&](std::uint16_t value) { return class_of_value[value]; });
  return classes;
}

}  // namespace

LabelClasses read_label_classes(const std::filesystem::path& file, ClassMasks masks) {
  const YamlValue root = load_yaml(file);
  root.only({"classes", "instances"});
  LabelClasses classes;
  classes.has_instances = root.has("instances");
  const std::size_t most = kMostLabel / values_of_label(classes.has_instances, masks);
  for (const YamlValue& item : root.at("classes").elements()) {
    if (classes.table.classes.size() > kMostLabel) item.fail("more than 65535 classes");
    add_class(item, most, classes);
  }
  const auto detected = [](const SemanticClass& c) { return c.detect; };
  if (std::ranges::none_of(classes.table.classes, detected))
    root.at("classes").fail("no class is detected; leave out detect: false of one");
  if (classes.has_instances) add_instances(root.at("instances"), classes.table);
  return classes;
}

std::vector<ClassId> LabelClasses::class_of_value(ClassMasks masks) const {
  std::vector<ClassId> classes(kMostLabel + 1, kBackground);
  const std::size_t values = values_of_label(has_instances, masks);
  for (std::size_t value = 0; value < classes.size(); ++value) {
    const std::size_t label = value / values;
    if (has_instances)
      classes[value] = table.class_of(static_cast<InstanceId>(value));
    else if (label < class_of_pixel.size())
      classes[value] = class_of_pixel[label];
  }
  return classes;
}

LabelledImage instances_of(const cv::Mat1w& label, const std::vector<ClassId>& class_of_value,
                           const ClassTable& table, ClassMasks masks) {
  LabelledImage image{cv::Mat1w::zeros(label.size()), table};
  const bool by_value = masks == ClassMasks::instances;
  const cv::Mat1w keys = by_value ? label : classes_at_pixels(label, class_of_value);
  std::vector<bool> present(kMostLabel + 1);
  for (const std::uint16_t key : keys) present[key] = true;
  auto next = static_cast<int>(table.instances.size());
  for (std::size_t key = 0; key < present.size(); ++key) {
    const ClassId id = by_value ? class_of_value[key] : static_cast<ClassId>(key);
    if (!present[key] || !table.detected(id)) continue;
    const cv::Mat1b mask = keys == static_cast<int>(key);
    const int first = next;
    if (masks == ClassMasks::components)
      next = number_components(mask, next, image.instances);
    else
      image.instances.setTo(next++, mask);
    if (next > static_cast<int>(kMostLabel))
      throw Error("a label image has more components than there are ids; cut it by masks classes");
    for (int n = first; n < next; ++n)
      image.table.instances.push_back({static_cast<InstanceId>(n), table.classes[id].name, id});
  }
  return image;
}

LabelledImage instances_of(const cv::Mat1w& label, const LabelClasses& classes, ClassMasks masks) {
  if (classes.has_instances) return {label, classes.table};
  return instances_of(label, classes.class_of_value(masks), classes.table, masks);
}

}  // namespace mapscore::eval
