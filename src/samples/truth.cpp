#include "truth.h"

#include <algorithm>

namespace mspskel::detail {

Index TruthGraph::node(const Vector3& position, double radius) {
  for (std::size_t i = 0; i < skeleton_.nodes.size(); ++i) {
    SkeletonNode& node = skeleton_.nodes[i];
    if ((node.position - position).squaredNorm() > 1e-18 * (1 + position.squaredNorm())) continue;
    node.radius = std::max(node.radius, radius);
    return static_cast<Index>(i);
  }
  SkeletonNode node;
  node.position = position;
  node.radius = radius;
  skeleton_.nodes.push_back(node);
  return static_cast<Index>(skeleton_.nodes.size()) - 1;
}

void TruthGraph::arc(const Vector3& from, double from_radius, const Vector3& to, double to_radius) {
  const Index a = node(from, from_radius), b = node(to, to_radius);
  if (a != b) skeleton_.edges.push_back({std::min(a, b), std::max(a, b)});
}

void TruthGraph::limb(const Vector3& joint, double joint_radius, const Vector3& tip, double half_width) {
  arc(joint, joint_radius, tip + kEndDepth * half_width * (joint - tip).normalized(), half_width);
}

CurveSkeleton TruthGraph::result() && {
  std::sort(skeleton_.edges.begin(), skeleton_.edges.end());
  skeleton_.edges.erase(std::unique(skeleton_.edges.begin(), skeleton_.edges.end()), skeleton_.edges.end());
  return std::move(skeleton_);
}

CurveSkeleton axis_between(const Vector3& a, const Vector3& b, double half_width) {
  const Vector3 inward = kEndDepth * half_width * (b - a).normalized();
  TruthGraph truth;
  truth.arc(a + inward, half_width, b - inward, half_width);
  return std::move(truth).result();
}

CurveSkeleton closed_curve(const std::function<Vector3(double)>& curve, double radius, Index count) {
  TruthGraph truth;
  for (Index i = 0; i < count; ++i)
    truth.arc(curve(static_cast<double>(i) / count), radius,
              curve(static_cast<double>((i + 1) % count) / count), radius);
  return std::move(truth).result();
}

void append(CurveSkeleton& skeleton, const CurveSkeleton& other) {
  const auto shift = static_cast<Index>(skeleton.nodes.size());
  skeleton.nodes.insert(skeleton.nodes.end(), other.nodes.begin(), other.nodes.end());
  for (const auto& [a, b] : other.edges) skeleton.edges.push_back({a + shift, b + shift});
}

CurveSkeleton moved(CurveSkeleton skeleton, const Eigen::Matrix3d& turn, const Vector3& shift) {
  for (SkeletonNode& node : skeleton.nodes) node.position = turn * node.position + shift;
  return skeleton;
}

CurveSkeleton y_upward(CurveSkeleton skeleton) {
  for (SkeletonNode& node : skeleton.nodes)
    node.position = Vector3(node.position.x(), node.position.z(), -node.position.y());
  return skeleton;
}

// Nodes in the same place are one. In a chain of balls the end lies beyond the last one's middle.
CurveSkeleton truth_of(const BallGraph& graph) {
  std::vector<Index> valence(graph.nodes.size(), 0);
  for (const auto& [i, j] : graph.edges) {
    ++valence[i];
    ++valence[j];
  }
  CurveSkeleton skeleton;
  for (const BallNode& ball : graph.nodes) {
    SkeletonNode node;
    node.position = ball.position;
    node.radius = ball.radius;
    skeleton.nodes.push_back(node);
  }
  for (const auto& [i, j] : graph.edges) {
    skeleton.edges.push_back({std::min(i, j), std::max(i, j)});
    for (const auto& [end, before] : {std::pair(i, j), std::pair(j, i)})
      if (valence[end] == 1)
        skeleton.nodes[end].position +=
            (1 - kEndDepth) * graph.nodes[end].radius *
            (graph.nodes[end].position - graph.nodes[before].position).normalized();
  }
  std::sort(skeleton.edges.begin(), skeleton.edges.end());
  return skeleton;
}

}  // namespace mspskel::detail
