#include "surface.h"

#include <cmath>

#include "mspskel/render/render.h"

namespace mspskel {

PolygonSoup to_polygon_soup(const SurfaceSnapshot& surface) {
  PolygonSoup soup;
  soup.points.reserve(surface.position.size());
  for (const Vector3& x : surface.position) soup.points.push_back(surface.frame.to_model(x));
  for (Index h = 0; h < surface.halfedge_count(); h += 3) {
    soup.add_triangle(surface.origin[h], surface.origin[h + 1], surface.origin[h + 2]);
  }
  return soup;
}

namespace render_detail {
namespace {

void add_triangles(const PolygonSoup& soup, DrawSurface& surface) {
  for (std::size_t f = 0; f < soup.polygon_count(); ++f) {
    const Index begin = soup.begin[f], end = soup.begin[f + 1];
    for (Index i = begin + 1; i + 1 < end; ++i) {
      surface.triangles.push_back({soup.corners[begin], soup.corners[i], soup.corners[i + 1]});
    }
  }
}

// Corners (3 f + k) that are at each point, as one array with an offset per point.
struct PointCorners {
  std::vector<Index> begin, corner;
};

PointCorners make_point_corners(const DrawSurface& surface) {
  PointCorners at;
  at.begin.assign(surface.points.size() + 1, 0);
  for (const auto& t : surface.triangles) {
    for (const Index v : t) ++at.begin[v + 1];
  }
  for (std::size_t v = 0; v < surface.points.size(); ++v) at.begin[v + 1] += at.begin[v];
  at.corner.resize(3 * surface.triangles.size());
  std::vector<Index> next(at.begin.begin(), at.begin.end() - 1);
  for (std::size_t c = 0; c < at.corner.size(); ++c) {
    at.corner[next[surface.triangles[c / 3][c % 3]]++] = static_cast<Index>(c);
  }
  return at;
}

void add_corner_normals(DrawSurface& surface) {
  constexpr double kCreaseCosine = 0.64;  // 50 degrees
  constexpr Index kMaxFan = 64;           // the sum over a fan is quadratic in its size
  std::vector<Vector3> normal;            // times twice the area
  normal.reserve(surface.triangles.size());
  for (const auto& [a, b, c] : surface.triangles) {
    normal.push_back((surface.points[b] - surface.points[a]).cross(surface.points[c] - surface.points[a]));
  }
  const PointCorners at = make_point_corners(surface);
  surface.corner_normals.resize(3 * surface.triangles.size());
  for (std::size_t c = 0; c < surface.corner_normals.size(); ++c) {
    const Vector3& own = normal[c / 3];
    const Index v = surface.triangles[c / 3][c % 3];
    Vector3 sum = own;
    if (at.begin[v + 1] - at.begin[v] <= kMaxFan) {
      sum.setZero();
      for (Index i = at.begin[v]; i < at.begin[v + 1]; ++i) {
        const Vector3& other = normal[at.corner[i] / 3];
        if (own.dot(other) > kCreaseCosine * own.norm() * other.norm()) sum += other;
      }
    }
    surface.corner_normals[c] = sum.stableNormalized().cast<float>();
  }
}

}  // namespace

DrawSurface make_draw_surface(const PolygonSoup& soup) {
  DrawSurface surface;
  surface.points = soup.points;
  add_triangles(soup, surface);
  add_corner_normals(surface);
  return surface;
}

}  // namespace render_detail
}  // namespace mspskel
