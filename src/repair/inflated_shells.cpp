#include "inflated_shells.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <random>

namespace mspskel::detail {
namespace {

// Moves a vertex so that each of its faces moves outward by one, or as near to it as that goes.
Vector3 growth_at(const SurfaceSnapshot& surface, Index v) {
  constexpr double kFlat = 0.01, kFarthest = 2;
  Eigen::Matrix3d normals = Eigen::Matrix3d::Zero();
  Vector3 sum = Vector3::Zero();
  double weights = 0;
  const Index first = surface.vertex_halfedge[v];
  Index h = first;
  do {
    const Vector3 &p = surface.position[v], &q = surface.position[surface.target(h)],
                  &r = surface.position[surface.apex(h)];
    const Vector3 normal = (q - p).cross(r - p);
    const double weight = std::atan2(normal.norm(), (q - p).dot(r - p));
    if (normal.norm() > 0) {
      const Vector3 n = normal.normalized();
      normals += weight * n * n.transpose();
      sum += weight * n;
      weights += weight;
    }
    h = surface.next_outgoing(h);
  } while (h != first);
  if (weights == 0) return Vector3::Zero();
  normals += kFlat * weights * Eigen::Matrix3d::Identity();
  const Vector3 way = normals.ldlt().solve(sum);
  return way / std::max(1.0, way.norm() / kFarthest);
}

}  // namespace

const ShellGroup& InflatedShells::grow(const std::vector<Index>& members, double by,
                                       const Execution& execution) {
  constexpr double kMost = 0.01;  // of the width
  if (shells_.empty()) {
    surface_ = original_;
    shells_ = original_shells_;
  }
  std::mt19937 random(1);
  for (const Index m : members) {
    Shell& shell = shells_[m];
    const double part = 1 + 0.5 * static_cast<double>(random()) / 4294967296.0;
    const double way = std::min(by, kMost * shell.width) * part * (shell.inside_out ? -1 : 1);
    for (const Index v : shell.vertices) {
      surface_.position[v] = original_.position[v] + way * growth_at(original_, v);
      const Vector3& p = surface_.position[v];
      shell.low = v == shell.vertices[0] ? p : Vector3(shell.low.cwiseMin(p));
      shell.high = v == shell.vertices[0] ? p : Vector3(shell.high.cwiseMax(p));
    }
  }
  group_.emplace(surface_, shells_, members, execution);
  return *group_;
}

}  // namespace mspskel::detail
