// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/experiment/store.hpp"

#include <array>
#include <cstdint>
#include <utility>

namespace mapscore::eval {

/// Name and member of every plain count of a result, once: the store and the tidy CSV follow.
template <class Owner>
using CountField = std::pair<const char*, std::int64_t Owner::*>;

inline constexpr std::array<CountField<ClassCounts>, 12> kClassCountFields{{
    {"predicted", &ClassCounts::predicted},
    {"true_predicted", &ClassCounts::true_predicted},
    {"visible", &ClassCounts::visible},
    {"found", &ClassCounts::found},
    {"false_near", &ClassCounts::false_near},
    {"false_leak", &ClassCounts::false_leak},
    {"false_floating", &ClassCounts::false_floating},
    {"missed_mislabelled", &ClassCounts::missed_mislabelled},
    {"missed_unlabelled", &ClassCounts::missed_unlabelled},
    {"missed_unmapped", &ClassCounts::missed_unmapped},
    {"visible_4", &ClassCounts::visible_4},
    {"found_4", &ClassCounts::found_4},
}};

inline constexpr std::array<CountField<InstanceCounts>, 5> kInstanceCountFields{{
    {"instances_true_positive", &InstanceCounts::true_positive},
    {"instances_false_positive", &InstanceCounts::false_positive},
    {"instances_false_negative", &InstanceCounts::false_negative},
    {"instances_iou_sum_billionth", &InstanceCounts::iou_sum_nano},
    {"instances_void", &InstanceCounts::void_predicted},
}};

inline constexpr std::array<CountField<ThinCounts>, 4> kThinCountFields{{
    {"thin_predicted", &ThinCounts::predicted},
    {"thin_true_predicted", &ThinCounts::true_predicted},
    {"thin_visible", &ThinCounts::visible},
    {"thin_found", &ThinCounts::found},
}};

inline constexpr std::array<CountField<BoxCounts>, 6> kBoxCountFields{{
    {"boxes", &BoxCounts::detections},
    {"boxes_unseen", &BoxCounts::unseen},
    {"iou_sum_billionth", &BoxCounts::iou_sum_nano},
    {"at_25", &BoxCounts::at_25},
    {"at_50", &BoxCounts::at_50},
    {"at_75", &BoxCounts::at_75},
}};

inline constexpr std::array<CountField<Accounting>, 9> kAccountingFields{{
    {"frames", &Accounting::frames},
    {"detections", &Accounting::detections},
    {"skipped_no_points", &Accounting::skipped_no_points},
    {"skipped_no_seed_point", &Accounting::skipped_no_seed_point},
    {"skipped_seed_off_object", &Accounting::skipped_seed_off_object},
    {"skipped_eroded_away", &Accounting::skipped_eroded_away},
    {"points", &Accounting::points},
    {"map_voxels", &Accounting::map_voxels},
    {"hits_beyond_span", &Accounting::hits_beyond_span},
}};

}  // namespace mapscore::eval
