// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"

namespace mapscore::eval {

// What is right and wrong in a map, used alike by figures and pictures: blue, sky blue, vermillion,
// yellow and black of Okabe and Ito's palette, moved apart until readers with any kind of colour
// blindness tell them from each other and from the pale scene (pictures_colours_test).
inline constexpr Colour kTrueColour{0x28, 0x58, 0x9C};
inline constexpr Colour kNearColour{0x0A, 0xB0, 0xF8};
inline constexpr Colour kLeakColour{0xCC, 0x33, 0x00};
inline constexpr Colour kFloatingColour{0xFF, 0xCC, 0x2E};
inline constexpr Colour kMissedColour{0x22, 0x22, 0x22};
// The causes of misses, which stand beside the causes of false voxels; unmapped ones are
// kMissedColour.
inline constexpr Colour kMislabelledColour{0x80, 0x22, 0xA6};
inline constexpr Colour kUnlabelledColour{0x80, 0x80, 0x80};

}  // namespace mapscore::eval
