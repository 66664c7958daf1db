// All contours of a plane with one component of the surface, sorted into the flat regions that they bound.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "mspskel/collapse/detail/homology_generators.h"
#include "mspskel/mesh/surface_snapshot.h"
#include "mspskel/slice/contour.h"

namespace mspskel {
namespace detail {

// A connected piece of plane ∩ solid: one outer contour and the contours of the holes directly inside it. It
// is a disc exactly if it has no holes.
struct FlatRegion {
  std::vector<Contour> contours;  // the outer one first
  double perimeter = 0.0;         // of all contours together

  bool is_disc() const { return contours.size() == 1; }
};

// Which side of a plane a vertex is on; `through` counts as positive whatever rounding says.
struct PlaneSide {
  const SurfaceSnapshot& surface;
  Plane plane;
  Index through = kNone;

  double operator()(Index v) const { return v == through ? 0.0 : plane.signed_distance(surface.position[v]); }
};

// Walks the contour that starts at `start` (from the negative to the positive side). Length and area are
// filled in; the area is positive if the surface's normals point away from the enclosed region.
template <class Side>
Contour walk_contour(const SurfaceSnapshot& surface, Index start, const Side& side) {
  Contour contour;
  Index h = start;
  Vector3 area = Vector3::Zero();
  do {
    const Index a = surface.origin[h], b = surface.target(h);
    const double negative = side(a), weight = negative / (negative - side(b));
    const Vector3 point = surface.position[a] + weight * (surface.position[b] - surface.position[a]);
    if (!contour.point.empty()) {
      contour.perimeter += (point - contour.point.back()).norm();
      area += (contour.point.back() - contour.point.front()).cross(point - contour.point.front());
    }
    contour.halfedge.push_back(h);
    contour.weight.push_back(weight);
    contour.point.push_back(point);
    const bool apex_positive = side(surface.apex(h)) >= 0;
    h = surface.twin[apex_positive ? SurfaceSnapshot::prev(h) : SurfaceSnapshot::next(h)];
  } while (h != start);
  contour.perimeter += (contour.point.front() - contour.point.back()).norm();
  contour.area = -0.5 * area.dot(side.plane.normal);
  return contour;
}

// A plane beside vertex v (within `window` below it) that keeps away from all vertices, so that contours that
// would touch come apart: the middle of the widest gap between heights. None if the vertices leave no gap
// that arithmetic could tell. `vertices`: all that lie within the window, and any others.
inline std::optional<Plane> generic_plane(const SurfaceSnapshot& surface, const std::vector<Index>& vertices,
                                          Index v, const Vector3& normal, double window) {
  constexpr double kSmallestGap = 1e-11;  // a hundred thousand roundings of a coordinate in the unit frame
  const double top = normal.dot(surface.position[v]), bottom = top - window;
  std::vector<double> height{bottom, top};
  for (const Index w : vertices) {
    const double x = normal.dot(surface.position[w]);
    if (x > bottom && x < top) height.push_back(x);
  }
  std::sort(height.begin(), height.end());
  double gap = 0, offset = 0;
  for (std::size_t i = 1; i < height.size(); ++i)
    if (height[i] - height[i - 1] > gap) {
      gap = height[i] - height[i - 1];
      offset = 0.5 * (height[i] + height[i - 1]);
    }
  if (gap < kSmallestGap) return std::nullopt;
  return Plane{normal, offset};
}

// Coordinates in the plane, for tests of what lies inside what.
struct PlaneFrame {
  Vector3 u, v;

  explicit PlaneFrame(const Vector3& normal) : u(normal.unitOrthogonal()), v(normal.cross(u)) {}
  Eigen::Vector2d operator()(const Vector3& x) const { return {u.dot(x), v.dot(x)}; }
  // Of the plane through the origin.
  Vector3 point(const Eigen::Vector2d& x) const { return x.x() * u + x.y() * v; }
};

// Whether the point (in the plane) lies inside the closed polygon: parity of the crossings of a ray.
inline bool inside_polygon(const std::vector<Eigen::Vector2d>& polygon, const Eigen::Vector2d& x) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Eigen::Vector2d &a = polygon[i], &b = polygon[j];
    if ((a.y() > x.y()) == (b.y() > x.y())) continue;
    if (x.x() < a.x() + (x.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  }
  return inside;
}

// Point of region ∩ plane: inside its outer contour and in none of its holes.
inline bool inside_region(const FlatRegion& region, const Plane& plane, const Vector3& x) {
  const PlaneFrame frame(plane.normal);
  bool inside = false;
  for (const Contour& contour : region.contours) {
    std::vector<Eigen::Vector2d> polygon;
    for (const Vector3& p : contour.point) polygon.push_back(frame(p));
    if (inside_polygon(polygon, frame(x))) inside = !inside;
  }
  return inside;
}

namespace regions {

// All contours of the plane with a component, of which `component` has every face that the plane meets, in
// ascending order, and its corners. `positive`: room for a flag a vertex of the surface.
inline std::vector<Contour> all_contours(const SurfaceSnapshot& surface, const ComponentElements& component,
                                         const Plane& plane, std::vector<std::uint8_t>& positive) {
  const PlaneSide side{surface, plane};
  for (const Index v : component.vertices) positive[v] = side(v) >= 0;
  std::vector<Index> starts;
  for (const Index f : component.faces) {
    const bool s[3] = {positive[surface.origin[3 * f]] != 0, positive[surface.origin[3 * f + 1]] != 0,
                       positive[surface.origin[3 * f + 2]] != 0};
    if (s[0] == s[1] && s[1] == s[2]) continue;
    for (Index i = 0; i < 3; ++i)
      if (!s[i] && s[(i + 1) % 3]) starts.push_back(3 * f + i);
  }
  // A crossed face has exactly one half-edge from − to +, so `starts` holds each crossing once, ascending.
  std::vector<bool> seen(starts.size(), false);
  std::vector<Contour> contours;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    if (seen[i]) continue;
    contours.push_back(walk_contour(surface, starts[i], side));
    for (const Index h : contours.back().halfedge)
      seen[static_cast<std::size_t>(std::lower_bound(starts.begin(), starts.end(), h) - starts.begin())] =
          true;
  }
  return contours;
}

// Per contour the smallest other one that encloses it, or kNone. Contours of a generic plane are disjoint, so
// one point decides.
inline std::vector<Index> nesting(const std::vector<Contour>& contours, const Plane& plane) {
  const PlaneFrame frame(plane.normal);
  const auto n = static_cast<Index>(contours.size());
  std::vector<std::vector<Eigen::Vector2d>> polygon(n);
  std::vector<Eigen::AlignedBox2d> box(n);
  for (Index i = 0; i < n; ++i)
    for (const Vector3& p : contours[i].point) {
      polygon[i].push_back(frame(p));
      box[i].extend(polygon[i].back());
    }
  std::vector<Index> parent(n, kNone);
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) {
      if (i == j || std::abs(contours[j].area) < std::abs(contours[i].area)) continue;
      if (parent[i] != kNone && std::abs(contours[parent[i]].area) <= std::abs(contours[j].area)) continue;
      if (box[j].contains(box[i]) && inside_polygon(polygon[j], polygon[i].front())) parent[i] = j;
    }
  return parent;
}

}  // namespace regions

// The flat regions of the plane in the solid that this component bounds, by increasing perimeter. `outward`
// is −1 if the component's faces are turned inward. Empty where outer contours and holes do not alternate as
// they do on a surface without self-intersections. `component` and `positive` are as for all_contours.
// Cost: O(faces + contours²), of the faces given.
inline std::vector<FlatRegion> flat_regions(const SurfaceSnapshot& surface,
                                            const ComponentElements& component, int outward,
                                            const Plane& plane, std::vector<std::uint8_t>& positive) {
  std::vector<Contour> contours = regions::all_contours(surface, component, plane, positive);
  for (Contour& contour : contours) contour.area *= outward;
  const std::vector<Index> parent = regions::nesting(contours, plane);
  std::vector<FlatRegion> result;
  std::vector<std::size_t> region_of(contours.size());
  for (std::size_t i = 0; i < contours.size(); ++i) {
    const bool outer = contours[i].area > 0;
    if (!outer && parent[i] == kNone) return {};
    if (parent[i] != kNone && (contours[static_cast<std::size_t>(parent[i])].area > 0) == outer) return {};
    if (!outer) continue;
    region_of[i] = result.size();
    result.emplace_back();
    result.back().perimeter = contours[i].perimeter;
    result.back().contours.push_back(contours[i]);
  }
  for (std::size_t i = 0; i < contours.size(); ++i) {
    if (contours[i].area > 0) continue;
    FlatRegion& region = result[region_of[static_cast<std::size_t>(parent[i])]];
    region.perimeter += contours[i].perimeter;
    region.contours.push_back(std::move(contours[i]));
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const FlatRegion& a, const FlatRegion& b) { return a.perimeter < b.perimeter; });
  return result;
}

}  // namespace detail
}  // namespace mspskel
