// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/experiment/baked_frames.hpp"

#include "core/error.hpp"
#include "eval/experiment/fault_fields.hpp"
#include "eval/experiment/leaf.hpp"
#include "eval/experiment/sensor_doses.hpp"
#include "eval/experiment/study_store.hpp"
#include "eval/experiment/trial_seed.hpp"
#include "sim/faults/depth_noise.hpp"
#include "sim/faults/label_noise.hpp"

#include <fmt/format.h>

namespace mapscore::eval {
namespace {

LabelFaultSettings masks_alone(LabelFaultSettings settings) {
  settings.confusion.reset();
  settings.confusion_matrix.reset();
  settings.scores.reset();
  settings.score_mean.reset();
  settings.score_concentration.reset();
  return resolved(settings);
}

/// `key: value, ...` of the keys that differ from their defaults.
template <class Settings>
std::string text_of(const Settings& settings) {
  std::string text;
  const auto add = [&]<class T>(const Field& field, const T& member) {
    const std::string value = Leaf<T>::text(member);
    if (value == "-" || value == field.unkeyed) return;
    if (!text.empty()) text += ", ";
    text += fmt::format("{}: {}", field.key, value);
  };
  fields(add, settings);
  return text;
}

void refuse_sweep(const Study& study) {
  for (const SweepAxis& axis : study.sweep)
    for (const std::string_view section : {"faults.depth", "faults.labels"})
      if (axis.path.starts_with(section))
        throw Error(fmt::format(
            "--bake: the sweep gives {} several values; bake one: --set sweep={{}} --set {}={}",
            axis.path, axis.path, axis.values.empty() ? "VALUE" : axis.values.back()));
}

}  // namespace

BakedFrames::BakedFrames(const Study& study, const ClassTable& table, const CameraModel& depth)
    : study_seed_(study.seed),
      seed_(trial_seed(study.seed, 0)),
      camera_(depth),
      depth_settings_(resolved(study.faults.depth)),
      label_settings_(masks_alone(resolved(study.faults.labels))),
      depth_dose_(dose_of(depth_settings_)),
      label_dose_(dose_of(label_settings_)) {
  refuse_sweep(study);
  table_ = detected_table(study, table);
}

std::optional<BakedFaults> BakedFrames::faults() const {
  BakedFaults baked{study_seed_, text_of(depth_settings_), text_of(label_settings_)};
  if (baked.depth.empty() && baked.labels.empty()) return std::nullopt;
  return baked;
}

Frame BakedFrames::color(const Frame& exact) const {
  Frame baked = exact;
  baked.label = sim::corrupt_labels(exact.label, table_, label_dose_, seed_, exact.index);
  return baked;
}

Frame BakedFrames::depth(const Frame& exact) const {
  Frame baked = exact;
  baked.depth = sim::corrupt_depth(exact.depth, camera_, depth_dose_, seed_, exact.depth_index);
  return baked;
}

bool has_verdict_faults(const Study& study) {
  const sim::LabelDose dose = dose_of(study.faults.labels);
  return dose.confusion > 0.0 || !dose.confusion_matrix.empty() || dose.scores > 0.0;
}

}  // namespace mapscore::eval
