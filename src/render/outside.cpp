#include "outside.h"

#include <algorithm>
#include <cmath>

#include "camera.h"
#include "mspskel/render/render.h"

namespace mspskel {
namespace render_detail {
namespace {

// Points in a grid over a plane, so that each triangle meets only the points beneath it.
class PointGrid {
 public:
  explicit PointGrid(const std::vector<Vector3>& points) {
    Eigen::Vector2d high = points.front().head<2>();
    low_ = high;
    for (const Vector3& p : points) {
      low_ = low_.cwiseMin(p.head<2>());
      high = high.cwiseMax(p.head<2>());
    }
    side_ = std::clamp(static_cast<int>(std::sqrt(static_cast<double>(points.size()))), 1, 1024);
    cell_ = ((high - low_) / side_).cwiseMax(1e-300);
    cells_.resize(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_));
    for (std::size_t i = 0; i < points.size(); ++i) {
      cells_[index(column(points[i].x()), row(points[i].y()))].push_back(static_cast<Index>(i));
    }
  }

  int column(double x) const { return bin((x - low_.x()) / cell_.x()); }
  int row(double y) const { return bin((y - low_.y()) / cell_.y()); }
  const std::vector<Index>& cell(int x, int y) const { return cells_[index(x, y)]; }

 private:
  int bin(double t) const { return static_cast<int>(std::clamp(t, 0.0, side_ - 1.0)); }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(side_) + static_cast<std::size_t>(x);
  }

  Eigen::Vector2d low_, cell_;
  int side_ = 1;
  std::vector<std::vector<Index>> cells_;
};

double orient(const Vector3& a, const Vector3& b, const Vector3& p) {
  return (b.x() - a.x()) * (p.y() - a.y()) - (b.y() - a.y()) * (p.x() - a.x());
}

// For every point: faces above it (larger z) that look up minus those that look down.
std::vector<int> count_above(const DrawSurface& surface, const std::vector<Vector3>& corner,
                             const std::vector<Vector3>& points) {
  const PointGrid grid(points);
  std::vector<int> count(points.size(), 0);
  for (const auto& t : surface.triangles) {
    const Vector3 &a = corner[t[0]], &b = corner[t[1]], &c = corner[t[2]];
    const double area = orient(a, b, c);
    if (area == 0.0) continue;
    const int x1 = grid.column(std::max({a.x(), b.x(), c.x()})),
              y1 = grid.row(std::max({a.y(), b.y(), c.y()}));
    for (int y = grid.row(std::min({a.y(), b.y(), c.y()})); y <= y1; ++y) {
      for (int x = grid.column(std::min({a.x(), b.x(), c.x()})); x <= x1; ++x) {
        for (const Index i : grid.cell(x, y)) {
          const double u = orient(b, c, points[i]) / area, v = orient(c, a, points[i]) / area,
                       w = 1.0 - u - v;
          if (u < 0 || v < 0 || w < 0) continue;
          if (u * a.z() + v * b.z() + w * c.z() > points[i].z()) count[i] += area > 0 ? 1 : -1;
        }
      }
    }
  }
  return count;
}

}  // namespace

std::vector<bool> inside_solid(const DrawSurface& surface, const std::vector<Vector3>& points) {
  std::vector<int> votes(points.size(), 0);
  if (surface.triangles.empty() || points.empty()) return std::vector<bool>(points.size(), true);
  const ModelFrame frame = make_model_frame(surface, points);
  // Askew to the principal axes, where symmetric models have their edges and flat sides.
  for (const Vector3& d :
       {Vector3(0.81, 0.43, 0.39), Vector3(-0.37, 0.84, 0.41), Vector3(0.29, -0.47, 0.83)}) {
    const Vector3 z = (d.x() * frame.right + d.y() * frame.up + d.z() * frame.toward).normalized();
    Eigen::Matrix3d axes;
    axes.row(1) = z.cross(frame.right).normalized();
    axes.row(0) = axes.row(1).transpose().cross(z);
    axes.row(2) = z;
    const Vector3& base = points.front();
    std::vector<Vector3> corner, at;
    corner.reserve(surface.points.size());
    at.reserve(points.size());
    for (const Vector3& p : surface.points) corner.push_back(axes * (p - base));
    for (const Vector3& p : points) at.push_back(axes * (p - base));
    const std::vector<int> count = count_above(surface, corner, at);
    for (std::size_t i = 0; i < points.size(); ++i) votes[i] += count[i] != 0 ? 1 : 0;
  }
  std::vector<bool> inside(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) inside[i] = votes[i] >= 2;
  return inside;
}

std::vector<SkeletonPiece> outside_pieces(const RenderScene& scene, const DrawSurface& surface) {
  Eigen::AlignedBox3d box;
  for (const Vector3& p : surface.points) box.extend(p);
  for (const SkeletonNode& node : scene.skeleton.nodes) box.extend(node.position);
  const double step = box.isEmpty() ? 0.0 : box.diagonal().norm() / 400.0;
  std::vector<SkeletonPiece> pieces;
  std::vector<Vector3> middles;
  for (std::size_t e = 0; e < scene.skeleton.edges.size(); ++e) {
    const Vector3& a = scene.skeleton.nodes[scene.skeleton.edges[e][0]].position;
    const Vector3& b = scene.skeleton.nodes[scene.skeleton.edges[e][1]].position;
    const int count = step > 0.0 ? std::max(1, static_cast<int>(std::ceil((b - a).norm() / step))) : 1;
    for (int k = 0; k < count; ++k) {
      const double s = static_cast<double>(k) / count, t = static_cast<double>(k + 1) / count;
      pieces.push_back({a + s * (b - a), a + t * (b - a), static_cast<Index>(e), false});
      middles.push_back(a + 0.5 * (s + t) * (b - a));
    }
  }
  const std::vector<bool> inside = inside_solid(surface, middles);
  for (std::size_t i = 0; i < pieces.size(); ++i) pieces[i].outside = !inside[i];
  return pieces;
}

}  // namespace render_detail

double outside_share(const std::vector<SkeletonPiece>& pieces) {
  double all = 0.0, outside = 0.0;
  for (const SkeletonPiece& piece : pieces) {
    const double length = (piece.end - piece.begin).norm();
    all += length;
    if (piece.outside) outside += length;
  }
  return all > 0.0 ? outside / all : 0.0;
}

}  // namespace mspskel
