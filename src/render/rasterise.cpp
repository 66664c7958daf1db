#include "rasterise.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mspskel::render_detail {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();

std::array<const Vector3*, 3> corners(const DrawSurface& surface, const View& view, Index triangle) {
  const auto& t = surface.triangles[triangle];
  return {&view.points[t[0]], &view.points[t[1]], &view.points[t[2]]};
}

// Samples are at integers plus a half. Rows and columns whose samples can lie in [low, high].
int first_sample(double low, int begin) {
  return static_cast<int>(std::max<double>(begin, std::ceil(low - 0.5)));
}
int last_sample(double high, int end) {
  return static_cast<int>(std::min<double>(end - 1, std::floor(high - 0.5)));
}

// A sample exactly on an edge that two triangles share belongs to one of them.
bool owns_edge(const Vector3& a, const Vector3& b) {
  return a.y() < b.y() || (a.y() == b.y() && a.x() > b.x());
}

struct Rows {
  int first, last;
};
Rows band_range(double low, double high, const View& view, int band_count) {
  const auto band = [&](double y) {
    return static_cast<int>(std::clamp(std::floor(y / view.band_rows), 0.0, band_count - 1.0));
  };
  return {band(low - view.margin), band(high + view.margin)};
}

struct TubeHit {
  double depth = std::numeric_limits<double>::infinity();
  Vector3 normal = Vector3::Zero();  // in samples' axes
};

void hit_ball(const Vector3& centre, double radius, double x, double y, TubeHit& hit) {
  const double dx = x - centre.x(), dy = y - centre.y(), height2 = radius * radius - dx * dx - dy * dy;
  if (height2 < 0) return;
  const double height = std::sqrt(height2);
  if (centre.z() - height < hit.depth) hit = {centre.z() - height, Vector3(dx, dy, -height) / radius};
}

// Where the line of sight through (x, y) first meets the tube: its side, or the ball at one of its ends.
TubeHit hit_tube(const Tube& tube, double x, double y) {
  TubeHit hit;
  hit_ball(tube.begin, tube.radius, x, y, hit);
  const Vector3 run = tube.end - tube.begin;
  const double length = run.norm();
  if (length == 0.0) return hit;
  hit_ball(tube.end, tube.radius, x, y, hit);
  const Vector3 u = run / length, from(x - tube.begin.x(), y - tube.begin.y(), 0.0);
  // |from + t z|^2 - ((from + t z) . u)^2 = radius^2, a quadratic in t.
  const double along = from.dot(u), p = 1.0 - u.z() * u.z(), q = along * u.z();
  const double discriminant = q * q - p * (from.squaredNorm() - along * along - tube.radius * tube.radius);
  if (p < 1e-12 || discriminant < 0) return hit;
  const double t = (q - std::sqrt(discriminant)) / p, s = along + t * u.z();
  if (s < 0 || s > length || tube.begin.z() + t >= hit.depth) return hit;
  return {tube.begin.z() + t, (from + t * Vector3::UnitZ() - s * u) / tube.radius};
}

}  // namespace

View make_view(const DrawSurface& surface, const Camera& camera, int band_rows, int margin, int band_count) {
  View view;
  view.camera = camera;
  view.band_rows = band_rows;
  view.margin = margin;
  view.points.reserve(surface.points.size());
  for (const Vector3& p : surface.points) view.points.push_back(camera.project(p));
  const auto triangle_count = static_cast<Index>(surface.triangles.size());
  std::vector<Rows> range;
  range.reserve(surface.triangles.size());
  view.band_begin.assign(static_cast<std::size_t>(band_count) + 1, 0);
  for (Index t = 0; t < triangle_count; ++t) {
    const auto p = corners(surface, view, t);
    const auto y = std::minmax({p[0]->y(), p[1]->y(), p[2]->y()});
    range.push_back(band_range(y.first, y.second, view, band_count));
    for (int b = range.back().first; b <= range.back().last; ++b) ++view.band_begin[b + 1];
  }
  for (int b = 0; b < band_count; ++b) view.band_begin[b + 1] += view.band_begin[b];
  view.band_triangle.resize(static_cast<std::size_t>(view.band_begin.back()));
  std::vector<Index> next(view.band_begin.begin(), view.band_begin.end() - 1);
  for (Index t = 0; t < triangle_count; ++t) {
    for (int b = range[t].first; b <= range[t].last; ++b) view.band_triangle[next[b]++] = t;
  }
  return view;
}

void Band::clear(int band_width, int begin, int end) {
  width = band_width;
  row_begin = begin;
  row_end = end;
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(end - begin);
  depth.assign(count, kFar);
  triangle.assign(count, kNone);
  normal.assign(count, Eigen::Vector3f::Zero());
  rim.assign(count, 0.0f);
  tube_depth.assign(count, kFar);
  tube.assign(count, kNone);
  tube_normal.assign(count, Eigen::Vector3f::Zero());
}

double twice_area(const std::array<const Vector3*, 3>& p) {
  return (p[1]->x() - p[0]->x()) * (p[2]->y() - p[0]->y()) -
         (p[1]->y() - p[0]->y()) * (p[2]->x() - p[0]->x());
}

std::array<double, 3> barycentric(const std::array<const Vector3*, 3>& p, double area, double x, double y) {
  std::array<double, 3> weight{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3 &a = *p[(k + 1) % 3], &b = *p[(k + 2) % 3];
    weight[k] = ((b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x())) / area;
  }
  return weight;
}

void draw_triangles(const DrawSurface& surface, const View& view, int band_number, Band& band) {
  for (Index i = view.band_begin[band_number]; i < view.band_begin[band_number + 1]; ++i) {
    const Index t = view.band_triangle[i];
    auto p = corners(surface, view, t);
    const double area = twice_area(p);
    if (area == 0.0) continue;
    std::array<Eigen::Vector3f, 3> n;
    for (std::size_t k = 0; k < 3; ++k) {
      n[k] = view.camera.turn(surface.corner_normals[3 * static_cast<std::size_t>(t) + k]);
    }
    std::array<bool, 3> owns{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3 &a = *p[(k + 1) % 3], &b = *p[(k + 2) % 3];
      owns[k] = area > 0 ? owns_edge(a, b) : owns_edge(b, a);
    }
    const auto xs = std::minmax({p[0]->x(), p[1]->x(), p[2]->x()});
    const auto ys = std::minmax({p[0]->y(), p[1]->y(), p[2]->y()});
    const int x0 = first_sample(xs.first, 0), x1 = last_sample(xs.second, band.width);
    const int y1 = last_sample(ys.second, band.row_end);
    for (int y = first_sample(ys.first, band.row_begin); y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        const auto w = barycentric(p, area, x + 0.5, y + 0.5);
        bool covered = true;
        for (std::size_t k = 0; k < 3; ++k) covered = covered && (w[k] > 0 || (w[k] == 0 && owns[k]));
        if (!covered) continue;
        const std::size_t s = band.index(x, y);
        Eigen::Vector3f normal = static_cast<float>(w[0]) * n[0] + static_cast<float>(w[1]) * n[1] +
                                 static_cast<float>(w[2]) * n[2];
        normal.normalize();
        band.rim[s] += rim_of(normal.z());
        const auto depth = static_cast<float>(w[0] * p[0]->z() + w[1] * p[1]->z() + w[2] * p[2]->z());
        if (depth >= band.depth[s]) continue;
        band.depth[s] = depth;
        band.triangle[s] = t;
        band.normal[s] = normal.z() < 0 ? Eigen::Vector3f(-normal) : normal;
      }
    }
  }
}

void draw_tubes(const View& view, Band& band) {
  for (std::size_t i = 0; i < view.tubes.size(); ++i) {
    const Tube& tube = view.tubes[i];
    const double r = tube.radius;
    const Vector3 &a = tube.begin, &b = tube.end;
    const int x0 = first_sample(std::min(a.x(), b.x()) - r, 0);
    const int x1 = last_sample(std::max(a.x(), b.x()) + r, band.width);
    const int y1 = last_sample(std::max(a.y(), b.y()) + r, band.row_end);
    for (int y = first_sample(std::min(a.y(), b.y()) - r, band.row_begin); y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        const TubeHit hit = hit_tube(tube, x + 0.5, y + 0.5);
        const std::size_t s = band.index(x, y);
        const auto depth = static_cast<float>(hit.depth);
        if (depth >= band.tube_depth[s]) continue;
        band.tube_depth[s] = depth;
        band.tube[s] = static_cast<Index>(i);
        band.tube_normal[s] =
            Eigen::Vector3f(static_cast<float>(hit.normal.x()), static_cast<float>(-hit.normal.y()),
                            static_cast<float>(-hit.normal.z()));
      }
    }
  }
}

}  // namespace mspskel::render_detail
