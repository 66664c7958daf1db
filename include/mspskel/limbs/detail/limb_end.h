// Where a limb ends: along its own walls, or before the lobes that it ends in.
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include "mspskel/limbs/detail/part_shape.h"
#include "mspskel/limbs/detail/part_walk.h"
#include "mspskel/limbs/limb_tips.h"

namespace mspskel {
namespace detail {

struct WallDirection {
  Vector3 axis, middle;  // unit, of either sense; the mean place of the walls
};

// The direction that the surface at these vertices runs along, in which its normals, by area, are least:
// those of a tube's walls are all across it. Nothing where its normals are nearly as large in another.
inline std::optional<WallDirection> direction_of_walls(const SurfaceSnapshot& surface,
                                                       const std::vector<Index>& vertices) {
  constexpr double kClear = 0.9;
  Eigen::Matrix3d normals = Eigen::Matrix3d::Zero();
  Vector3 places = Vector3::Zero();
  double area = 0;
  for (const Index v : vertices) {
    normals += surface.vertex_area[v] * surface.normal[v] * surface.normal[v].transpose();
    places += surface.vertex_area[v] * surface.position[v];
    area += surface.vertex_area[v];
  }
  if (!(area > 0)) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(normals);
  if (!(solver.eigenvalues()[0] < kClear * solver.eigenvalues()[1])) return std::nullopt;
  return WallDirection{solver.eigenvectors().col(0), places / area};
}

// The ends of parts of one surface along given directions.
class EndAlong {
 public:
  explicit EndAlong(const SurfaceSnapshot& surface) : surface_(surface) {}

  // The mean of what lies within `length` of the farthest of these vertices along `outward`, with the
  // triangles cut. Cost: O(vertices).
  std::optional<Vector3> middle(const std::vector<Index>& vertices, const Vector3& outward, double length) {
    height_.resize(surface_.position.size());
    double top = -std::numeric_limits<double>::infinity();
    for (const Index v : vertices) {
      height_[v] = outward.dot(surface_.position[v]);
      top = std::max(top, height_[v]);
      for_each_neighbour(surface_, v, [&](Index w) { height_[w] = outward.dot(surface_.position[w]); });
    }
    PartShapeSum sum(surface_, height_, top - length);
    for (const Index v : vertices)
      if (height_[v] >= top - length) sum.add_vertex(v);
    const PartShape shape = sum.shape(top);
    if (!(shape.area > 0)) return std::nullopt;
    return shape.centre;
  }

 private:
  const SurfaceSnapshot& surface_;
  std::vector<double> height_;  // along the last direction, of the last vertices and those beside them
};

// A limb that ends in two low lobes that are alike ends in the middle before them: no place in one of them
// stands for both.
inline void end_before_fork(const SurfaceSnapshot& surface, const std::vector<double>& distance,
                            PartWalk& walk, double fork, LimbTip& tip) {
  const double top = distance[tip.vertex], end = kEnd * tip.measures.half_width;
  std::vector<Index> part = walk.beyond(tip.vertex, fork - end);
  PartShapeSum all(surface, distance, fork - end), lobes(surface, distance, fork);
  for (const Index v : part) {
    all.add_vertex(v);
    if (distance[v] >= fork) lobes.add_vertex(v);
  }
  const std::optional<Vector3> middle = middle_between(all.shape(top), lobes.shape(top));
  if (!middle) return;
  tip.target = *middle;
  tip.cap = tip.head = std::move(part);
}

}  // namespace detail
}  // namespace mspskel
