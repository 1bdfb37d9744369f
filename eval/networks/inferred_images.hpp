// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/foreign/network_labels.hpp"
#include "eval/networks/network_model.hpp"
#include "eval/recording/recording.hpp"

#include <filesystem>
#include <functional>

namespace mapscore::eval {

/// Where below a folder of results the label images of networks are kept.
inline constexpr const char* kNetworksFolder = "networks";

/// Throws Error where a network does not fit the images of a recording: what SegmentationNetwork
/// refuses, and where its classes are not one for each channel of its output or not the
/// recording's, or it needs depth and the recording has none. Infers nothing but a black image.
void check_network(const NetworkModel& network, const Recording& recording);

/// The label images that a network gives of the colour images of a recording, as perception by
/// images reads them: in `results`/networks, in a folder named by a hash of what decides them: the
/// files' content, the settings, the recording and OpenCV's release. Inferred now where they are
/// not there, on `jobs` threads, on which no byte depends, while other processes that want them
/// wait; `progress(done, all)` after each frame, one call at a time; what it throws ends the work.
/// The folder is there whole or not at all. Depth is registered by the recording's own calibration,
/// without any fault (docs/methods.md). Throws Error as check_network.
[[nodiscard]] NetworkImages inferred_images(const NetworkModel& network, const Recording& recording,
                                            const std::filesystem::path& results, int jobs = 1,
                                            const std::function<void(int, int)>& progress = {});

/// Removes what inferred_images keeps of this network and recording where it is not as it was
/// written, so that it is inferred anew.
void remove_damaged_images(const NetworkModel& network, const Recording& recording,
                           const std::filesystem::path& results);

}  // namespace mapscore::eval
