// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/experiment/sensor_doses.hpp"

#include <array>
#include <numbers>

namespace mapscore::eval {
namespace {

/// A key of the study and the member that it sets.
template <class Settings, class Dose>
struct Key {
  std::optional<double> Settings::*key;
  double Dose::*member;
  bool is_dose = true;  ///< what `scale` multiplies
  double unit = 1.0;    ///< of the key, in that of the member
};

constexpr double kDegree = std::numbers::pi / 180.0;

using DepthS = DepthFaultSettings;
using DepthD = sim::DepthDose;
constexpr auto kDepthKeys = std::to_array<Key<DepthS, DepthD>>({
    {&DepthS::axial, &DepthD::axial},
    {&DepthS::lateral, &DepthD::lateral},
    {&DepthS::quantisation, &DepthD::quantisation},
    {&DepthS::grazing, &DepthD::grazing},
    {&DepthS::shadow, &DepthD::shadow},
    {&DepthS::flying, &DepthD::flying},
    {&DepthS::range, &DepthD::range},
    {&DepthS::axial_base_m, &DepthD::axial_base_m, false},
    {&DepthS::axial_growth_per_m, &DepthD::axial_growth_per_m, false},
    {&DepthS::lateral_px, &DepthD::lateral_px, false},
    {&DepthS::baseline_m, &DepthD::baseline_m, false},
    {&DepthS::subpixel_px, &DepthD::subpixel_px, false},
    {&DepthS::grazing_from_deg, &DepthD::grazing_from_rad, false, kDegree},
    {&DepthS::grazing_to_deg, &DepthD::grazing_to_rad, false, kDegree},
    {&DepthS::flying_share, &DepthD::flying_share, false},
    {&DepthS::range_min_m, &DepthD::range_min_m, false},
    {&DepthS::range_max_m, &DepthD::range_max_m, false},
});

using LabelS = LabelFaultSettings;
using LabelD = sim::LabelDose;
constexpr auto kLabelKeys = std::to_array<Key<LabelS, LabelD>>({
    {&LabelS::boundary_px, &LabelD::boundary_px},
    {&LabelS::ragged_px, &LabelD::ragged_px},
    {&LabelS::miss, &LabelD::miss},
    {&LabelS::confusion, &LabelD::confusion},
    {&LabelS::scores, &LabelD::scores},
    {&LabelS::holes, &LabelD::holes},
    {&LabelS::islands, &LabelD::islands},
    {&LabelS::ragged_length_px, &LabelD::ragged_length_px, false},
    {&LabelS::miss_area_px, &LabelD::miss_area_px, false},
    {&LabelS::disc_radius_px, &LabelD::disc_radius_px, false},
    {&LabelS::island_reach_px, &LabelD::island_reach_px, false},
    {&LabelS::score_concentration, &LabelD::score_concentration, false},
});

template <class Settings, class Dose, std::size_t N>
void apply(const std::array<Key<Settings, Dose>, N>& keys, const Settings& settings, Dose& dose) {
  for (const auto& [key, member, is_dose, unit] : keys) {
    if (settings.*key) dose.*member = *(settings.*key) * unit;
    if (is_dose) dose.*member *= settings.scale;
  }
}

template <class Settings, class Dose, std::size_t N>
Settings differing(const std::array<Key<Settings, Dose>, N>& keys, const Dose& dose) {
  const Dose ideal;
  Settings settings;
  for (const auto& [key, member, is_dose, unit] : keys)
    if (dose.*member != ideal.*member) settings.*key = dose.*member / unit;
  return settings;
}

/// Its shares off the diagonal times `scale`; the diagonal takes the rest of 1.
std::vector<std::vector<double>> scaled(std::vector<std::vector<double>> matrix, double scale) {
  if (scale == 1.0) return matrix;
  for (std::size_t row = 0; row < matrix.size(); ++row) {
    double wrong = 0.0;
    for (std::size_t column = 0; column < matrix[row].size(); ++column)
      if (column != row) wrong += matrix[row][column] *= scale;
    if (row < matrix[row].size()) matrix[row][row] = 1.0 - wrong;
  }
  return matrix;
}

}  // namespace

sim::DepthDose dose_of(const DepthFaultSettings& settings) {
  sim::DepthDose dose = sim::depth_preset(settings.preset);
  apply(kDepthKeys, settings, dose);
  return dose;
}

sim::LabelDose dose_of(const LabelFaultSettings& settings) {
  sim::LabelDose dose = sim::label_preset(settings.preset);
  apply(kLabelKeys, settings, dose);
  if (settings.score_mean) dose.score_mean = settings.score_mean;
  if (!settings.confusion_matrix) return dose;
  dose.confusion = 0.0;
  if (settings.scale > 0.0)
    dose.confusion_matrix = scaled(*settings.confusion_matrix, settings.scale);
  return dose;
}

DepthFaultSettings resolved(const DepthFaultSettings& settings) {
  const sim::DepthDose dose = dose_of(settings);
  if (is_zero(dose)) return {};
  return differing(kDepthKeys, dose);
}

LabelFaultSettings resolved(const LabelFaultSettings& settings) {
  const sim::LabelDose dose = dose_of(settings);
  if (is_zero(dose)) return {};
  LabelFaultSettings differences = differing(kLabelKeys, dose);
  differences.score_mean = dose.score_mean;
  if (!dose.confusion_matrix.empty()) differences.confusion_matrix = dose.confusion_matrix;
  return differences;
}

}  // namespace mapscore::eval
