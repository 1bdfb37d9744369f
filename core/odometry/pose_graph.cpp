// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/odometry/pose_graph.hpp"

#include "core/error.hpp"

#include <ceres/ceres.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <utility>

namespace mapscore {
namespace {

/// Coordinates of a node in Ceres: translation, then a unit quaternion x y z w.
using Node = std::array<double, 7>;

template <class T>
using NodePose = std::pair<Eigen::Matrix<T, 3, 1>, Eigen::Quaternion<T>>;

template <class T>
NodePose<T> pose_of(const T* node) {
  return {Eigen::Map<const Eigen::Matrix<T, 3, 1>>(node),
          Eigen::Map<const Eigen::Quaternion<T>>(node + 3)};
}

Pose pose_of(const Node& node) {
  const auto [t, q] = pose_of(node.data());
  Pose pose = Pose::Identity();
  pose.linear() = q.normalized().toRotationMatrix();
  pose.translation() = t;
  return pose;
}

/// root (rho, omega): the error of an edge, to first order its Log, over its standard deviations.
struct EdgeError {
  Eigen::Vector3d t_measured;
  Eigen::Quaterniond q_measured;
  Covariance6 root_information;

  template <class T>
  bool operator()(const T* from, const T* to, T* residual) const {
    const auto [t_from, q_from] = pose_of(from);
    const auto [t_to, q_to] = pose_of(to);
    const Eigen::Quaternion<T> q_to_measured = q_measured.cast<T>().conjugate();
    const Eigen::Matrix<T, 3, 1> t = q_from.conjugate() * (t_to - t_from) - t_measured.cast<T>();
    const Eigen::Quaternion<T> q = q_to_measured * (q_from.conjugate() * q_to);
    Eigen::Matrix<T, 6, 1> xi;
    xi << q_to_measured * t, T(2.0) * (q.w() < T(0.0) ? T(-1.0) : T(1.0)) * q.vec();
    Eigen::Map<Eigen::Matrix<T, 6, 1>>(residual, 6) = root_information.cast<T>() * xi;
    return true;
  }
};

/// Throws Error where the search would fail.
void check(std::size_t nodes, const std::vector<PoseEdge>& edges) {
  std::vector<char> hangs(nodes, 0);
  if (nodes > 0) hangs.front() = 1;
  for (bool more = true; std::exchange(more, false);)
    for (const PoseEdge& edge : edges) {
      if (edge.from >= nodes || edge.to >= nodes)
        throw Error("pose graph: an edge names a node that is not there; add the node first");
      if (Eigen::LLT<Covariance6>(edge.covariance).info() != Eigen::Success)
        throw Error("pose graph: the covariance of an edge is singular; give each axis a variance");
      if (hangs[edge.from] == hangs[edge.to]) continue;
      hangs[edge.from] = hangs[edge.to] = 1;
      more = true;
    }
  if (std::ranges::find(hangs, 0) != hangs.end())
    throw Error("pose graph: a node hangs on no edge; connect each node with the first");
}

ceres::CostFunction* cost_of(const PoseEdge& edge) {
  const Eigen::LLT<Covariance6> llt(Covariance6(edge.covariance.inverse()));
  return new ceres::AutoDiffCostFunction<EdgeError, 6, 7, 7>(
      new EdgeError{edge.T_from_to.translation(), Eigen::Quaterniond(edge.T_from_to.linear()),
                    Covariance6(llt.matrixU())});
}

/// Of the node's tangent, which Ceres turns by half angles on the left, in our order and axes.
Covariance6 covariance_of(ceres::Problem& problem, const Node& node) {
  ceres::Covariance::Options options;
  options.num_threads = 1;
  ceres::Covariance covariance(options);
  const double* block = node.data();
  if (!covariance.Compute({std::pair(block, block)}, &problem))
    throw Error("pose graph: its poses are not determined; give edges that are");
  Eigen::Matrix<double, 6, 6, Eigen::RowMajor> tangent;
  covariance.GetCovarianceBlockInTangentSpace(block, block, tangent.data());
  // Translation is in the map's axes; the quaternion's tangent is half a rotation vector there.
  const Eigen::Matrix3d R_node_map = pose_of(node).linear().transpose();
  Covariance6 to_ours = Covariance6::Zero();
  to_ours.topLeftCorner<3, 3>() = R_node_map;
  to_ours.bottomRightCorner<3, 3>() = 2.0 * R_node_map;
  return to_ours * tangent * to_ours.transpose();
}

}  // namespace

OptimisedPoses optimised(std::vector<Pose> nodes, const std::vector<PoseEdge>& edges) {
  check(nodes.size(), edges);
  std::vector<Node> blocks(nodes.size());
  ceres::Problem problem;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    Eigen::Map<Eigen::Vector3d>(blocks[n].data()) = nodes[n].translation();
    Eigen::Map<Eigen::Quaterniond>(blocks[n].data() + 3) = Eigen::Quaterniond(nodes[n].linear());
    problem.AddParameterBlock(
        blocks[n].data(), 7,
        new ceres::ProductManifold<ceres::EuclideanManifold<3>, ceres::EigenQuaternionManifold>{});
  }
  for (const PoseEdge& edge : edges) {
    problem.AddResidualBlock(cost_of(edge), edge.loop ? new ceres::CauchyLoss(3.0) : nullptr,
                             blocks[edge.from].data(), blocks[edge.to].data());
  }
  if (nodes.size() < 2) return {std::move(nodes), Covariance6::Zero()};
  problem.SetParameterBlockConstant(blocks.front().data());
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  options.function_tolerance = 1e-10;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  for (std::size_t n = 1; n < nodes.size(); ++n) nodes[n] = pose_of(blocks[n]);
  return {std::move(nodes), covariance_of(problem, blocks.back())};
}

}  // namespace mapscore
