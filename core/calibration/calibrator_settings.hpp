// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/parameters.hpp"

#include <string_view>

namespace mapscore {

/// What a Calibrator looks for, and how far.
struct CalibratorSettings {
  static constexpr std::string_view kKind = "estimated",
                                    kMeaning =
                                        "found from the outlines of masks and the steps of depth "
                                        "of the recording's own frames, from the believed one on";
  bool focal_length = false, principal_point = false;
  bool time_offset = false;  ///< find the time between the streams too; needs frames with motion
  Degrees search_deg{4};
  double search_m = 0.06;
  int frames = 40;

  static void fields(auto& s, auto&& visit) {
    visit(s.focal_length, Field{"focal_length", "find the colour camera's focal length too"});
    visit(s.principal_point, Field{"principal_point",
                                   "find the colour camera's principal point too, which a turn is "
                                   "hardly told from"});
    visit(s.search_deg, Field{"search_deg", "largest turn that the search tries", {0.1, 10}});
    visit(s.search_m, Field{"search_m", "largest shift that the search tries", {0.002, 0.2}});
    visit(s.frames, Field{"frames",
                          "frames that are used at most: of a recording spread evenly over those "
                          "with objects, of a stream the latest",
                          {1, 1000}});
  }
  bool operator==(const CalibratorSettings&) const = default;
};

}  // namespace mapscore
