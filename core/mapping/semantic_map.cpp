// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/mapping/semantic_map.hpp"

#include "core/error.hpp"
#include "core/mapping/free_space.hpp"
#include "core/mapping/map_resolution.hpp"
#include "core/whole_file.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <utility>
#include <variant>

namespace mapscore {
namespace {

/// Calls act(hits of one voxel) in their order.
void for_each_voxel(std::span<const VoxelHit> hits, auto&& act) {
  for (auto hit = hits.begin(); hit != hits.end();) {
    const auto end =
        std::find_if(hit, hits.end(), [&](const VoxelHit& h) { return h.key != hit->key; });
    act(std::span<const VoxelHit>(hit, end));
    hit = end;
  }
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
  SemanticOcTree::Descent descent(*tree_);
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
              carves() ? descent.finest(octree_key(key)) : descent.hit(octree_key(key));
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
    if (!(point.position.array().abs() < edge_m_ * kOctreeReach).all()) continue;
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

void SemanticMap::decay_in_view(const DepthView& view, const BlendRule& rule,
                                std::span<const VoxelHit> hits) {
  check(rule);
  const Eigen::AlignedBox3d box = view.box(edge_m_);
  if (box.isEmpty()) return;
  std::vector<VoxelKey> in_view;
  for_each_leaf_in(*tree_, box, [&](const auto& leaf) {
    if (leaf->beliefs().empty()) return;
    for_each_finest(*tree_, leaf, [&](const VoxelKey& key) {
      if (view.sees(key, edge_m_) && !std::ranges::binary_search(hits, key, {}, &VoxelHit::key))
        in_view.push_back(key);
    });
  });
  for (const VoxelKey& key : in_view) decay(rule, tree_->finest(octree_key(key)).mutable_beliefs());
}

std::vector<MapVoxel> SemanticMap::voxels() const {
  std::vector<MapVoxel> voxels;
  for (auto leaf = tree_->begin_leafs(), end = tree_->end_leafs(); leaf != end; ++leaf) {
    const ClassProbability best = leaf->best();
    const bool occupied = tree_->isNodeOccupied(*leaf);
    for_each_finest(*tree_, leaf, [&](const VoxelKey& key) {
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
    for_each_finest(*tree_, leaf, [&](const VoxelKey& key) {
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
  export_color_at(*this, VoteRule{}, 1, Paint::classes, table, threshold, file);  // any rule: 1
}

}  // namespace mapscore
