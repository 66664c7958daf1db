// A plain test for self-intersections, good enough to keep generated meshes honest: floating point, no exact
// predicates.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "mspskel/base/types.h"
#include "mspskel/mesh/default_mesh.h"

namespace mspskel::test {

namespace detail {

inline double orientation(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  return (b - a).cross(c - a).dot(d - a);
}

// Whether the segment pq meets the inside of triangle abc. Touching counts as meeting.
inline bool crosses(const Vector3& p, const Vector3& q, const Vector3& a, const Vector3& b,
                    const Vector3& c) {
  if (orientation(a, b, c, p) * orientation(a, b, c, q) > 0) return false;
  const double u = orientation(p, q, a, b), v = orientation(p, q, b, c), w = orientation(p, q, c, a);
  return (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
}

struct Triangle {
  std::array<Index, 3> vertex;
  std::array<Vector3, 3> corner;
  Vector3 low, high;

  bool has(Index v) const { return vertex[0] == v || vertex[1] == v || vertex[2] == v; }
};

inline bool crosses(const Triangle& f, const Triangle& g) {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    if (g.has(f.vertex[k]) || g.has(f.vertex[next])) continue;
    if (crosses(f.corner[k], f.corner[next], g.corner[0], g.corner[1], g.corner[2])) return true;
  }
  return false;
}

inline std::vector<Triangle> triangles(const DefaultMesh& mesh) {
  std::vector<Triangle> result;
  for (const auto f : mesh.faces()) {
    Triangle t;
    std::size_t k = 0;
    for (const auto v : mesh.fv_range(f)) {
      t.vertex[k] = v.idx();
      t.corner[k++] = to_vector3(mesh.point(v));
    }
    t.low = t.corner[0].cwiseMin(t.corner[1]).cwiseMin(t.corner[2]);
    t.high = t.corner[0].cwiseMax(t.corner[1]).cwiseMax(t.corner[2]);
    result.push_back(t);
  }
  return result;
}

}  // namespace detail

// Whether two faces that share no edge meet other than at a common vertex. Cost: linear for even meshes.
inline bool intersects_itself(const DefaultMesh& mesh) {
  const std::vector<detail::Triangle> faces = detail::triangles(mesh);
  double size = 0;
  for (const auto& t : faces) size += (t.high - t.low).maxCoeff() / static_cast<double>(faces.size());
  std::vector<std::pair<std::int64_t, Index>>
      cells;  // of a uniform grid, by the faces whose boxes reach into them
  const auto cell = [&](double x) { return static_cast<std::int64_t>(std::floor(x / size)); };
  for (Index f = 0; f < static_cast<Index>(faces.size()); ++f) {
    const Vector3 &low = faces[f].low, &high = faces[f].high;
    for (std::int64_t x = cell(low.x()); x <= cell(high.x()); ++x)
      for (std::int64_t y = cell(low.y()); y <= cell(high.y()); ++y)
        for (std::int64_t z = cell(low.z()); z <= cell(high.z()); ++z)
          cells.emplace_back((x * 2097152 + y) * 2097152 + z, f);
  }
  std::sort(cells.begin(), cells.end());
  for (std::size_t i = 0; i < cells.size(); ++i)
    for (std::size_t j = i + 1; j < cells.size() && cells[j].first == cells[i].first; ++j) {
      const auto &f = faces[cells[i].second], &g = faces[cells[j].second];
      if ((f.low.array() > g.high.array()).any() || (g.low.array() > f.high.array()).any()) continue;
      if (detail::crosses(f, g) || detail::crosses(g, f)) return true;
    }
  return false;
}

}  // namespace mspskel::test
