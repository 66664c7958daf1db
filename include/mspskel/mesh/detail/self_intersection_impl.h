#pragma once

#include <atomic>

#include "mspskel/base/linkage.h"
#include "mspskel/mesh/detail/segment_triangle.h"

namespace mspskel {
namespace detail {

inline Triangle triangle_of(const SurfaceSnapshot& s, Index f) {
  return {s.position[s.origin[3 * f]], s.position[s.origin[3 * f + 1]], s.position[s.origin[3 * f + 2]]};
}

// Corners of f and g, those that both have first and in the same order.
struct FacePair {
  std::array<Index, 3> f, g;
  int shared = 0;

  FacePair(const SurfaceSnapshot& s, Index face_f, Index face_g) {
    for (int k = 0; k < 3; ++k) {
      f[k] = s.origin[3 * face_f + k];
      g[k] = s.origin[3 * face_g + k];
    }
    for (int i = 0; i < 3; ++i)
      for (int j = shared; j < 3; ++j)
        if (f[i] == g[j]) {
          std::swap(f[i], f[shared]);
          std::swap(g[j], g[shared]);
          ++shared;
          break;
        }
  }
};

// Whether all corners of q from `shared` on lie strictly on one side of t.
inline bool on_one_side(const SurfaceSnapshot& s, const std::array<Index, 3>& t,
                        const std::array<Index, 3>& q, int shared) {
  int sum = 0;
  for (int k = shared; k < 3; ++k)
    sum += orientation(s.position[t[1]], s.position[t[2]], s.position[q[k]], s.position[t[0]]);
  return std::abs(sum) == 3 - shared;
}

inline bool faces_intersect(const SurfaceSnapshot& s, Index face_f, Index face_g) {
  const FacePair pair(s, face_f, face_g);
  const auto& p = s.position;
  if (pair.shared == 3) return true;
  if (on_one_side(s, pair.f, pair.g, pair.shared) || on_one_side(s, pair.g, pair.f, pair.shared))
    return false;
  // Flat across a common edge: only a fold overlaps.
  if (pair.shared == 2)
    return s.face_normal_times_twice_area(face_f).dot(s.face_normal_times_twice_area(face_g)) < 0;
  const Triangle f{p[pair.f[0]], p[pair.f[1]], p[pair.f[2]]}, g{p[pair.g[0]], p[pair.g[1]], p[pair.g[2]]};
  if (segment_meets_triangle(f.b, f.c, g, true) || segment_meets_triangle(g.b, g.c, f, true)) return true;
  return pair.shared == 0 &&
         (segment_meets_triangle(f.a, f.b, g, true) || segment_meets_triangle(f.a, f.c, g, true) ||
          segment_meets_triangle(g.a, g.b, f, true) || segment_meets_triangle(g.a, g.c, f, true));
}

// Calls visit(g) for the faces g > f whose boxes meet that of f, until visit returns false.
template <class Visit>
void for_each_later_neighbour(const SurfaceSnapshot& snapshot, const BoundingVolumeHierarchy& hierarchy,
                              Index f, Visit&& visit) {
  const Triangle t = triangle_of(snapshot, f);
  const Vector3 low = t.a.cwiseMin(t.b).cwiseMin(t.c), high = t.a.cwiseMax(t.b).cwiseMax(t.c);
  hierarchy.for_each_in_box(low, high, [&](Index g) { return g <= f || visit(g); });
}

}  // namespace detail

MSPSKEL_INLINE Index count_self_intersections(const SurfaceSnapshot& snapshot,
                                              const BoundingVolumeHierarchy& hierarchy, Index limit,
                                              const Execution& execution) {
  std::atomic<Index> found{0};
  parallel_for(
      snapshot.face_count(), "self-intersections", execution, [] { return 0; },
      [&](Index f, int&) {
        if (found.load(std::memory_order_relaxed) >= limit) return;
        detail::for_each_later_neighbour(snapshot, hierarchy, f, [&](Index g) {
          if (detail::faces_intersect(snapshot, f, g)) found.fetch_add(1, std::memory_order_relaxed);
          return found.load(std::memory_order_relaxed) < limit;
        });
      });
  return std::min(found.load(), limit);
}

MSPSKEL_INLINE std::vector<Index> find_self_intersecting_faces(const SurfaceSnapshot& snapshot,
                                                               const BoundingVolumeHierarchy& hierarchy,
                                                               const Execution& execution) {
  const auto n = static_cast<std::size_t>(snapshot.face_count());
  std::vector<std::atomic<char>> meets(n);
  const auto known = [&](Index f) { return meets[f].load(std::memory_order_relaxed) != 0; };
  // A pair of which both are known already is not looked at, which changes nothing but the time.
  parallel_for(
      snapshot.face_count(), "self-intersections", execution, [] { return 0; },
      [&](Index f, int&) {
        detail::for_each_later_neighbour(snapshot, hierarchy, f, [&](Index g) {
          if ((!known(f) || !known(g)) && detail::faces_intersect(snapshot, f, g))
            for (const Index face : {f, g}) meets[face].store(1, std::memory_order_relaxed);
          return true;
        });
      });
  std::vector<Index> faces;
  for (Index f = 0; f < snapshot.face_count(); ++f)
    if (known(f)) faces.push_back(f);
  return faces;
}

}  // namespace mspskel
