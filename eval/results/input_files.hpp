// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/foreign/network_labels.hpp"
#include "eval/networks/inferred_images.hpp"
#include "eval/recording/recording.hpp"
#include "eval/study/study.hpp"

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mapscore::eval {

/// Hashes of what the files hold that poses, detections and commands of a study come from, as they
/// stand in the keys of trials. Each file is read once, or never where its hash is known.
class InputFiles {
 public:
  /// By what is read and the path as the study has it.
  using Hashes = std::map<std::string, std::string>;

  /// Reads the files.
  InputFiles() = default;
  /// As they were when these hashes were taken; no file is looked at.
  explicit InputFiles(Hashes known) : hashes_(std::move(known)), are_known_(true) {}

  /// Hash of what the perception of a configuration reads: the object map of simulated perception,
  /// a network's images, classes and scores, or its model and classes; empty where it reads none.
  /// Throws Error when one is missing.
  std::string perceived(const Study& config);

  /// Hash of the file that the source of a configuration's poses reads; empty when it reads none.
  /// Throws Error when the file is refused.
  std::string poses(const Study& config);

  /// Hashes of the files that the command of a configuration's method names, in its words
  /// (file_beside) or as what it depends on. Throws Error when one of the latter is missing.
  std::vector<std::string> depends(const Study& config);

  /// All that were asked for.
  [[nodiscard]] const Hashes& hashes() const { return hashes_; }

 private:
  /// The hash at `name`, of what `read` returns where it is not known yet.
  const std::string& of(const std::string& name, const std::function<std::string()>& read);

  Hashes hashes_;
  bool are_known_ = false;
};

/// The label images that the perception of a configuration reads: those of a folder, or those that
/// its network gives of the recording, inferred by one thread where nobody did before
/// (infer_networks). None where it reads none. Throws Error as inferred_images.
[[nodiscard]] std::optional<NetworkImages> network_images(const Study& config,
                                                          const Recording& recording);

/// Reads the files that poses and detections of a study come from, at every point of its grid, and
/// returns their hashes. Throws Error naming the file when one is refused.
InputFiles::Hashes check_input_files(const Study& study);

/// Reads the label images of the networks of a study, at every point of its grid, as those of a
/// recording, and loads the networks that are to run. Throws Error as NetworkLabels::check and
/// check_network.
void check_network_labels(const Study& study, const Recording& recording);

/// What the user may want to know: detected classes of the recording that no label of a network's
/// class file names, so that they are never found with it; empty where all are named.
[[nodiscard]] std::string note_on_labels(const Study& study, const Recording& recording);

/// Runs the networks of a study, at every point of its grid, over a recording, where nobody did
/// before, or where what they gave is not as it was written, on `jobs` threads; `progress(done,
/// all)` counts the frames of all. Throws Error as inferred_images.
void infer_networks(const Study& study, const Recording& recording, int jobs,
                    const std::function<void(int, int)>& progress);

}  // namespace mapscore::eval
