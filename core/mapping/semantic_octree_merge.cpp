// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/mapping/semantic_octree.hpp"

#include <algorithm>

namespace mapscore {

/// Walks two trees together; a leaf stands for all that lies below it.
class SemanticOcTree::Merge {
 public:
  Merge(SemanticOcTree& mine, const SemanticOcTree& theirs, const FusionRule& rule)
      : mine_(mine), theirs_(theirs), rule_(rule) {}

  /// `created`: mine was just made and says nothing.
  void nodes(SemanticOcTreeNode* mine, bool created, const SemanticOcTreeNode* theirs) {
    const bool mine_is_leaf = !created && !mine_.nodeHasChildren(mine);
    const bool theirs_is_leaf = !theirs_.nodeHasChildren(theirs);
    if (theirs_is_leaf && created) return mine->copyData(*theirs);
    if (theirs_is_leaf && mine_is_leaf) return add(*theirs, *mine);
    if (mine_is_leaf) mine_.expand_leaf(mine);
    for (unsigned index = 0; index < 8; ++index) {
      if (!theirs_is_leaf && !theirs_.nodeChildExists(theirs, index)) continue;
      const bool fresh = !mine_.nodeChildExists(mine, index);
      SemanticOcTreeNode* child =
          fresh ? mine_.createNodeChild(mine, index) : mine_.getNodeChild(mine, index);
      nodes(child, fresh, theirs_is_leaf ? theirs : theirs_.getNodeChild(theirs, index));
    }
    mine->updateOccupancyChildren();
  }

 private:
  void add(const SemanticOcTreeNode& from, SemanticOcTreeNode& to) const {
    to.setLogOdds(std::clamp(to.getLogOdds() + from.getLogOdds(), mine_.getClampingThresMinLog(),
                             mine_.getClampingThresMaxLog()));
    if (from.colour().count > 0) to.mutable_colour() += from.colour();
    if (from.beliefs().empty()) return;
    ClassBeliefs& beliefs = to.mutable_beliefs();
    beliefs = beliefs.empty() ? from.beliefs() : merged(rule_, beliefs, from.beliefs());
  }

  SemanticOcTree& mine_;
  const SemanticOcTree& theirs_;
  const FusionRule& rule_;
};

void SemanticOcTree::merge(const SemanticOcTree& other, const FusionRule& rule) {
  if (other.root == nullptr) return;
  const auto [node, created] = root_or_new();
  Merge(*this, other, rule).nodes(node, created, other.root);
}

}  // namespace mapscore
