// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/cli/shared/options.hpp"
#include "eval/foreign/labelled_folder.hpp"
#include "eval/foreign/trial_folder.hpp"

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace mapscore::eval {

/// Flags of verbs that read folders of images, of any origin or of a trial: what the images mean,
/// and which of them are taken.
struct FolderFlags {
  static constexpr const char* kGroup = "Reading the folder";

  std::string folder, masks{names_of(ClassMasks{}).front()}, frames;
  LabelledFolderOptions reading;
  std::vector<std::string> detect;
  std::vector<double> range_m;
  const CLI::App* verb = nullptr;
  std::string cameras_flag;  ///< the verb's own name of --intrinsics

  /// Adds FOLDER and the flags. `cameras`: a further name of --intrinsics, and `use` what the
  /// labels are taken for.
  void add_to(CLI::App& to, const std::string& cameras, const std::string& use);
  /// Files that the flags name, and those that say what the folder's images are.
  [[nodiscard]] std::vector<InputFile> inputs() const;
  /// Reads the folder, with poses or without. Throws Error as LabelledFolder.
  [[nodiscard]] LabelledFolder labelled(bool poses) const;
  /// Reads a trial's folder; --intrinsics replaces the cameras that its method believes in. Throws
  /// Error as TrialFolder, and naming the flag for any of `groups` but those that still have an
  /// effect (`allowed`), since a trial's folder says itself what it means.
  [[nodiscard]] TrialFolder trial(const std::vector<std::string>& groups,
                                  std::vector<std::string> allowed) const;
  /// The frames of --frames, all without it. Throws Error as FrameSelection.
  [[nodiscard]] std::vector<int> chosen_frames(int count) const;
};

}  // namespace mapscore::eval
