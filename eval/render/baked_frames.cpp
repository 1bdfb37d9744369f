// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/render/baked_frames.hpp"

#include "core/error.hpp"
#include "eval/results/study_store.hpp"
#include "eval/study/grid.hpp"
#include "eval/study/leaf_yaml.hpp"
#include "sim/faults/depth_noise.hpp"
#include "sim/faults/label_noise.hpp"

#include <fmt/format.h>

namespace mapscore::eval {
namespace {

/// `key: value, ...` of the keys that differ from the ideal.
template <class Dose>
std::string text_of(const Dose& dose) {
  std::string text;
  const auto own = canonical(dose).own;
  own.fields(own, [&](const auto& member, const Field& field) {
    const std::string value = Leaf<std::remove_cvref_t<decltype(member)>>::text(member);
    if (value == "-") return;
    if (!text.empty()) text += ", ";
    text += fmt::format("{}: {}", field.key, value);
  });
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
      depth_dose_(study.faults.depth.dose()),
      label_dose_(sim::masks_alone(study.faults.labels.dose())) {
  refuse_sweep(study);
  table_ = detected_table(study, table);
}

std::optional<BakedFaults> BakedFrames::faults() const {
  BakedFaults baked{study_seed_, text_of(depth_dose_), text_of(label_dose_)};
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
  const sim::LabelDose dose = study.faults.labels.dose();
  return dose.confusion > 0.0 || !dose.confusion_matrix.empty() || dose.scores > 0.0;
}

}  // namespace mapscore::eval
