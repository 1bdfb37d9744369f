// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/mapping/semantic_map.hpp"

#include "core/error.hpp"
#include "core/mapping/frame_hits.hpp"

#include <octomap/ColorOcTree.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <system_error>
#include <utility>
#include <variant>

namespace mapscore {
namespace {

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

void SemanticMap::fuse(std::span<const VoxelHit> hits, int draws, const FusionRule& rule,
                       std::size_t class_count) {
  check_fusion(hits, draws, rule, class_count);
  std::visit(
      [&](const auto& kind) {
        for_each_voxel(hits, [&](std::span<const VoxelHit> of_voxel) {
          const VoxelKey& key = of_voxel.front().key;
          if (!fits_octree(key)) {
            hits_beyond_span_ += of_voxel.size();
            return;
          }
          constexpr bool kLazy = true;  // inner nodes are brought up to date when the map is saved
          mapscore::fuse(kind, of_voxel, draws,
                         tree_->updateNode(octree_key(key), true, kLazy)->beliefs);
        });
      },
      rule);
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
  return node ? std::as_const(node->beliefs).entries() : std::span<const ClassProbability>();
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
