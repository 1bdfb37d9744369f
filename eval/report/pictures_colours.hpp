// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"

namespace mapscore::eval {

// What is right and wrong in a map, in Okabe and Ito's palette, which colour-blind readers can tell
// apart. Used alike by figures and pictures.
inline constexpr Colour kTrueColour{0x00, 0x9E, 0x73};
inline constexpr Colour kNearColour{0x56, 0xB4, 0xE9};
inline constexpr Colour kLeakColour{0xD5, 0x5E, 0x00};
inline constexpr Colour kFloatingColour{0xCC, 0x79, 0xA7};
inline constexpr Colour kMissedColour{0x22, 0x22, 0x22};
inline constexpr Colour kMislabelledColour{0xE6, 0x9F, 0x00};
inline constexpr Colour kUnlabelledColour{0x99, 0x99, 0x99};

}  // namespace mapscore::eval
