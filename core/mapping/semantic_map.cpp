// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/mapping/semantic_map.hpp"

#include "core/error.hpp"

#include <octomap/ColorOcTree.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <system_error>

namespace mapscore {
namespace {

/// Below this a decayed class is forgotten; no threshold in use comes near it.
constexpr double kForgotten = 1e-6;

/// Adds `gain` to a class of a voxel whose classes have already decayed.
void add(std::vector<ClassProbability>& classes, ClassId class_id, double gain) {
  const auto place = std::lower_bound(
      classes.begin(), classes.end(), class_id,
      [](const ClassProbability& entry, ClassId id) { return entry.class_id < id; });
  if (place != classes.end() && place->class_id == class_id)
    place->probability += gain;
  else
    classes.insert(place, {class_id, gain});
}

void decay(std::vector<ClassProbability>& classes, double K) {
  for (ClassProbability& entry : classes) entry.probability *= K;
}

/// Writes aside and renames, so that a full disk never leaves half a file under the name asked for.
void write_whole(const std::filesystem::path& file,
                 const std::function<bool(std::ostream&)>& write) {
  const std::filesystem::path aside = file.string() + ".partial";
  std::ofstream stream(aside, std::ios::binary);
  const bool written = stream && write(stream) && stream.flush();
  stream.close();
  std::error_code error;
  if (written && stream) std::filesystem::rename(aside, file, error);
  if (written && stream && !error) return;
  std::filesystem::remove(aside, error);
  throw Error(file.string() +
              ": cannot be written; check the folder, its permissions and free space");
}

}  // namespace

SemanticMap::SemanticMap(double edge_m) : edge_m_(edge_m) {
  if (!(edge_m > 0.0) || !std::isfinite(edge_m))
    throw Error("voxel_m: must be a positive length in metres");
  tree_ = std::make_unique<SemanticOcTree>(edge_m);
}

SemanticMap::SemanticMap(std::unique_ptr<SemanticOcTree> tree)
    : edge_m_(tree->getResolution()), tree_(std::move(tree)) {}

void SemanticMap::blend(std::span<const VoxelHit> hits, int draws, double K) {
  for (auto hit = hits.begin(); hit != hits.end();) {
    const VoxelKey key = hit->key;
    const auto end = std::find_if(hit, hits.end(), [&](const VoxelHit& h) { return h.key != key; });
    if (!fits_octree(key)) {
      hits_beyond_span_ += static_cast<std::size_t>(end - hit);
      hit = end;
      continue;
    }
    constexpr bool kLazy = true;  // inner nodes are brought up to date when the map is saved
    auto& classes = tree_->updateNode(octree_key(key), true, kLazy)->classes;
    decay(classes, K);
    for (; hit != end; ++hit) add(classes, hit->class_id, (1.0 - K) * hit->score_sum / draws);
    std::erase_if(classes, [](const ClassProbability& c) { return c.probability < kForgotten; });
  }
}

std::vector<MapVoxel> SemanticMap::voxels() const {
  std::vector<MapVoxel> voxels;
  for (auto leaf = tree_->begin_leafs(), end = tree_->end_leafs(); leaf != end; ++leaf) {
    const ClassProbability best = leaf->best();
    const bool occupied = tree_->isNodeOccupied(*leaf);
    const int span = 1 << (tree_->getTreeDepth() - leaf.getDepth());
    const VoxelKey low = voxel_key(leaf.getIndexKey());
    for (int i = 0; i < span; ++i)
      for (int j = 0; j < span; ++j)
        for (int k = 0; k < span; ++k)
          voxels.push_back(
              {{low.i + i, low.j + j, low.k + k}, best.class_id, best.probability, occupied});
  }
  std::sort(voxels.begin(), voxels.end(),
            [](const MapVoxel& a, const MapVoxel& b) { return a.key < b.key; });
  return voxels;
}

std::span<const ClassProbability> SemanticMap::classes_at(const VoxelKey& key) const {
  const SemanticOcTreeNode* node = fits_octree(key) ? tree_->search(octree_key(key)) : nullptr;
  return node ? std::span<const ClassProbability>(node->classes)
              : std::span<const ClassProbability>();
}

void SemanticMap::save(const std::filesystem::path& file) const {
  tree_->updateInnerOccupancy();
  write_whole(file, [this](std::ostream& stream) { return tree_->write(stream); });
}

SemanticMap SemanticMap::load(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw Error(file.string() + ": cannot be opened; check the path");
  try {
    return SemanticMap(SemanticOcTree::read_whole(stream));
  } catch (const Error& error) {
    throw Error(file.string() + ": " + error.what());
  }
}

void SemanticMap::export_color(const std::filesystem::path& file, const ClassTable& table,
                               double threshold) const {
  octomap::ColorOcTree coloured(edge_m_);
  for (const MapVoxel& voxel : voxels()) {
    if (!voxel.occupied || voxel.best_class == kBackground || voxel.probability < threshold)
      continue;
    const Colour colour = table.classes.at(voxel.best_class).colour;
    coloured.updateNode(octree_key(voxel.key), true, true)->setColor(colour.r, colour.g, colour.b);
  }
  if (coloured.size() > 0) coloured.updateInnerOccupancy();
  write_whole(file, [&](std::ostream& stream) { return coloured.write(stream); });
}

}  // namespace mapscore
