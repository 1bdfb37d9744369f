// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "eval/truth/surface_truth.hpp"
#include "eval/truth/visible_truth.hpp"

#include <filesystem>

namespace mapscore::eval {

/// Writes the voxels of the truth, one row a voxel and class, sorted by key, then class. `samples`
/// is what the visible truth holds: the depth samples of all classes in the voxel on the row of its
/// owner, 0 on others and 0 everywhere without it. So, with a visible truth of min_samples 1, V_c
/// at any min_samples n is the rows of c with samples >= n. By the file's ending:
///
/// - `.csv`: header `i,j,k,class,touch_only,samples`, class by its name, touch_only 0 or 1;
/// - `.ply`: binary little-endian points at voxel centres: float x y z (metres, map frame), uchar
///   red green blue (the class's colour), ushort class, uchar touch_only, uint samples.
///
/// Written aside and renamed, so that a file of this name is complete. Throws Error for any other
/// ending, a file that cannot be written, and truths with different edges.
void write_truth(const std::filesystem::path& file, const SurfaceTruth& truth,
                 const VisibleTruth* visible, const ClassTable& table);

}  // namespace mapscore::eval
