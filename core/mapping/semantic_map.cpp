// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/mapping/semantic_map.hpp"

#include "core/error.hpp"
#include "core/fusion/frame_hits.hpp"
#include "core/mapping/free_space.hpp"
#include "core/whole_file.hpp"

#include <octomap/ColorOcTree.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <utility>
#include <variant>

namespace mapscore {
namespace {

/// Calls `use(key)` for every finest voxel that a leaf stands for.
void for_each_finest(const SemanticOcTree::leaf_iterator& leaf, const SemanticOcTree& tree,
                     const auto& use) {
  const int span = 1 << (tree.getTreeDepth() - leaf.getDepth());
  const VoxelKey low = voxel_key(leaf.getIndexKey());
  for (int i = 0; i < span; ++i)
    for (int j = 0; j < span; ++j)
      for (int k = 0; k < span; ++k) use(VoxelKey{low.i + i, low.j + j, low.k + k});
}

}  // namespace

SemanticMap::SemanticMap(double edge_m, const Carving& carving)
    : edge_m_(edge_m), carving_(carving) {
  if (!(edge_m > 0.0) || !std::isfinite(edge_m))
    throw Error("voxel_m: must be a positive length in metres");
  if (carving.carve) check_ranges(carving);
  tree_ = std::make_unique<SemanticOcTree>(edge_m);
  if (carving.carve) tree_->set_model(carving.model);
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
          // Inner nodes are brought up to date in what is saved.
          SemanticOcTreeNode& voxel =
              carves() ? tree_->finest(octree_key(key)) : tree_->hit(octree_key(key));
          mapscore::fuse(kind, of_voxel, draws, voxel.mutable_beliefs());
        });
      },
      rule);
}

void SemanticMap::see(const Eigen::Vector3d& origin, std::span<const Eigen::Vector3d> points,
                      std::span<const VoxelHit> hits) {
  if (!carves()) throw Error("map: does not carve; make it with a Carving that does");
  std::vector<VoxelKey> hit_voxels;
  hit_voxels.reserve(hits.size());
  for (const VoxelHit& hit : hits) hit_voxels.push_back(hit.key);
  const SeenSpace seen = seen_space(origin, points, edge_m_, carving_.max_range_m, hit_voxels);
  hits_beyond_span_ += seen.points_left_out;
  tree_->observe(seen.blocks);
}

void SemanticMap::add_colours(std::span<const ColouredPoint> points) {
  for (const ColouredPoint& point : points) {
    if (!(point.position.array().abs() < edge_m_ * (1 << 15)).all()) continue;
    const octomap::OcTreeKey key = octree_key(voxel_of(point.position, edge_m_));
    if (tree_->search(key) != nullptr) tree_->finest(key).mutable_colour().add(point.colour);
  }
}

void SemanticMap::merge(const SemanticMap& other, const FusionRule& rule) {
  if (other.edge_m_ != edge_m_)
    throw Error("merge: the maps' voxels differ in size; map both with the same voxel_m");
  check(rule);
  (void)merged(rule, {}, {});  // says whether the rule allows it
  tree_->merge(*other.tree_, rule);
  hits_beyond_span_ += other.hits_beyond_span_;
}

std::vector<MapVoxel> SemanticMap::voxels() const {
  std::vector<MapVoxel> voxels;
  for (auto leaf = tree_->begin_leafs(), end = tree_->end_leafs(); leaf != end; ++leaf) {
    const ClassProbability best = leaf->best();
    const bool occupied = tree_->isNodeOccupied(*leaf);
    for_each_finest(leaf, *tree_, [&](const VoxelKey& key) {
      voxels.push_back({key, best.class_id, best.probability, occupied});
    });
  }
  std::ranges::sort(voxels, {}, &MapVoxel::key);
  return voxels;
}

std::vector<BelievedVoxel> SemanticMap::believed_voxels() const {
  std::vector<BelievedVoxel> voxels;
  for (auto leaf = tree_->begin_leafs(), end = tree_->end_leafs(); leaf != end; ++leaf) {
    if (leaf->beliefs().empty()) continue;
    std::optional<Colour> colour;
    if (leaf->colour().count > 0) colour = leaf->colour().mean();
    for_each_finest(leaf, *tree_, [&](const VoxelKey& key) {
      voxels.push_back({key, leaf->beliefs(), colour});
    });
  }
  std::ranges::sort(voxels, {}, &BelievedVoxel::key);
  return voxels;
}

void SemanticMap::set_beliefs(const VoxelKey& key, ClassBeliefs beliefs) {
  if (!fits_octree(key) || tree_->search(octree_key(key)) == nullptr)
    throw Error("map: has no such voxel; give one of believed_voxels()");
  if (!beliefs.well_formed())
    throw Error(
        "map: beliefs that are none; give classes ascending, each once, and weights of 0 or more");
  tree_->finest(octree_key(key)).mutable_beliefs() = std::move(beliefs);
}

std::span<const ClassProbability> SemanticMap::classes_at(const VoxelKey& key) const {
  const SemanticOcTreeNode* node = fits_octree(key) ? tree_->search(octree_key(key)) : nullptr;
  return node ? node->beliefs().entries() : std::span<const ClassProbability>();
}

std::optional<Colour> SemanticMap::colour_at(const VoxelKey& key) const {
  const SemanticOcTreeNode* node = fits_octree(key) ? tree_->search(octree_key(key)) : nullptr;
  if (node == nullptr || node->colour().count == 0) return std::nullopt;
  return node->colour().mean();
}

void SemanticMap::save(const std::filesystem::path& file) const {
  WholeFile whole(file);
  tree_->write(whole.stream());
  whole.finish();
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
    if (voxel.best_class >= table.classes.size())
      throw Error("map: class " + std::to_string(voxel.best_class) +
                  " is not in the class table; export it with the table that it was made with");
    const Colour colour = table.classes[voxel.best_class].colour;
    coloured.updateNode(octree_key(voxel.key), true, true)->setColor(colour.r, colour.g, colour.b);
  }
  if (coloured.size() > 0) coloured.updateInnerOccupancy();
  WholeFile whole(file);
  coloured.write(whole.stream());
  whole.finish();
}

}  // namespace mapscore
