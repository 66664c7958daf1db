#include "find_openings.h"

#include <algorithm>

namespace mspskel::detail {

double loop_radius(const LoopShape& shape) {
  return shape.length > 0 ? 2 * shape.area.norm() / shape.length : 0.0;
}

bool is_tube_end(const std::vector<Vector3>& points, const FaceSet& faces, const std::vector<Index>& twin,
                 const std::vector<Index>& loop, const LoopShape& shape, std::vector<char>& visited) {
  constexpr double kLeastRoundness = 0.25, kMostAcross = 0.25;
  if (4 * kPi * shape.area.norm() < kLeastRoundness * shape.length * shape.length) return false;
  const Vector3 normal = shape.area.normalized();
  double reach = 0;
  for (const Index h : loop) reach = std::max(reach, (points[faces.origin(h)] - shape.centre).norm());
  reach += loop_radius(shape);

  std::vector<Index> reached;
  const auto walls = static_cast<Index>(visited.size());
  const auto visit = [&](Index f) {
    if (f >= walls || visited[f]) return;
    visited[f] = 1;
    reached.push_back(f);
  };
  for (const Index h : loop) visit(h / 3);
  double across = 0, whole = 0;
  for (std::size_t i = 0; i < reached.size(); ++i) {
    const Index f = reached[i];
    const Vector3 area = area_vector(points, faces, f);
    if (area.norm() > 0) {
      across += std::pow(area.dot(normal), 2) / area.norm();
      whole += area.norm();
    }
    for (Index h = 3 * f; h < 3 * f + 3; ++h) {
      if (twin[h] == kNone) continue;
      const Index g = twin[h] / 3;
      const Vector3 middle = (points[faces.corners[3 * g]] + points[faces.corners[3 * g + 1]] +
                              points[faces.corners[3 * g + 2]]) /
                             3;
      if ((middle - shape.centre).norm() <= reach) visit(g);
    }
  }
  for (const Index f : reached) visited[f] = 0;
  return whole > 0 && across < kMostAcross * whole;
}

}  // namespace mspskel::detail
