// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/fusion/class_beliefs.hpp"
#include "core/placement/placement.hpp"
#include "core/plugged.hpp"

#include <memory>
#include <span>

namespace mapscore {

/// What every fusion rule does.
class AnyFusionRule {
 public:
  virtual ~AnyFusionRule() = default;
  /// As `fuse` of fusion_rule.hpp.
  virtual void fuse(std::span<const VoxelHit> hits, int draws, ClassBeliefs& beliefs) const = 0;
  /// As `merged` of fusion_rule.hpp.
  [[nodiscard]] virtual ClassBeliefs merged(const ClassBeliefs& a, const ClassBeliefs& b) const = 0;
};

/// The fusion rule that a program adds (docs/extending.md).
class PluggedRule : public Plugged<AnyFusionRule> {};

/// Adds a fusion rule to the program that has a static object of it: a struct with kKind, kMeaning,
/// its parameters and their list as the rules of fusion_rule.hpp, and two const members:
///   void fuse(std::span<const VoxelHit> hits, int draws, ClassBeliefs& beliefs)
///   ClassBeliefs merged(const ClassBeliefs& a, const ClassBeliefs& b)
template <class Rule>
struct FusionPlugIn {
  FusionPlugIn() { PluggedRule::plug_in(Rule::kKind, Rule::kMeaning, std::make_unique<Box>()); }

 private:
  struct Box : PluggedBox<AnyFusionRule, Rule, Box> {
    void fuse(std::span<const VoxelHit> hits, int draws, ClassBeliefs& beliefs) const override {
      this->kind_.fuse(hits, draws, beliefs);
    }
    [[nodiscard]] ClassBeliefs merged(const ClassBeliefs& a, const ClassBeliefs& b) const override {
      return this->kind_.merged(a, b);
    }
  };
};

}  // namespace mapscore
