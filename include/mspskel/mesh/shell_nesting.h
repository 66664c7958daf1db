// Which connected components of a closed surface lie inside which: outer shells and cavities.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {

struct ShellNesting {
  std::vector<Index> parent;  // per component: the smallest component around it, or kNone
  std::vector<Index> depth;   // per component: number of components around it; odd: a cavity
  std::vector<double>
      volume;  // per component: enclosed volume, normalised units; negative: faces turned inward
  Index nested_count() const {
    Index n = 0;
    for (const Index d : depth) n += d > 0;
    return n;
  }
};

namespace detail {

// Winding number of the faces round x: the sum of their solid angles (van Oosterom, Strackee 1983) over 4π.
inline double winding_number(const SurfaceSnapshot& surface, const std::vector<Index>& faces,
                             const Vector3& x) {
  double sum = 0;
  for (const Index f : faces) {
    const Vector3 a = surface.position[surface.origin[3 * f]] - x,
                  b = surface.position[surface.origin[3 * f + 1]] - x,
                  c = surface.position[surface.origin[3 * f + 2]] - x;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (2 * kPi);
}

}  // namespace detail

// Assumes that components do not cross each other: one vertex of a component decides for all of it.
// Cost: O(faces), and O(faces of B) for each pair of components where A's box lies in B's.
inline ShellNesting nest_shells(const SurfaceSnapshot& surface) {
  const Index n = surface.component_count;
  ShellNesting result{std::vector<Index>(n, kNone), std::vector<Index>(n, 0), std::vector<double>(n, 0.0)};
  std::vector<std::vector<Index>> faces(n);
  std::vector<Eigen::AlignedBox3d> box(n);
  for (Index f = 0; f < surface.face_count(); ++f) {
    const Vector3 &a = surface.position[surface.origin[3 * f]],
                  &b = surface.position[surface.origin[3 * f + 1]],
                  &c = surface.position[surface.origin[3 * f + 2]];
    const Index k = surface.component[surface.origin[3 * f]];
    faces[k].push_back(f);
    for (const Vector3* p : {&a, &b, &c}) box[k].extend(*p);
    result.volume[k] += a.dot(b.cross(c)) / 6;
  }
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) {
      if (i == j || !box[j].contains(box[i])) continue;
      const Vector3& x = surface.position[surface.origin[3 * faces[i].front()]];
      if (std::abs(detail::winding_number(surface, faces[j], x)) < 0.5) continue;
      ++result.depth[i];
      const Index p = result.parent[i];
      if (p == kNone || std::abs(result.volume[j]) < std::abs(result.volume[p])) result.parent[i] = j;
    }
  return result;
}

}  // namespace mspskel
