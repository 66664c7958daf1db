#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace mspskel {
namespace detail {

// Volume integrals over the solid that a component bounds, from the tetrahedra of its faces and the origin.
struct SolidMoments {
  double volume = 0.0;
  Vector3 first = Vector3::Zero();                   // ∫ x
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();  // ∫ x xᵀ

  Vector3 centroid() const { return first / volume; }

  // The principal axis whose moment stands apart from the other two by the larger factor.
  Vector3 axis() const {
    const Vector3 c = centroid();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(second / volume - c * c.transpose());
    const Vector3 moment = solver.eigenvalues();  // ascending
    return solver.eigenvectors().col(moment[2] * moment[0] > moment[1] * moment[1] ? 2 : 0);
  }
};

inline std::vector<SolidMoments> solid_moments(const SurfaceSnapshot& surface) {
  std::vector<SolidMoments> of(static_cast<std::size_t>(surface.component_count));
  for (Index h = 0; h < surface.halfedge_count(); h += 3) {
    const std::array<Index, 3> corner{surface.origin[h], surface.target(h), surface.apex(h)};
    SolidMoments& m = of[surface.component[corner[0]]];
    const Vector3 &a = surface.position[corner[0]], &b = surface.position[corner[1]],
                  &c = surface.position[corner[2]], sum = a + b + c;
    const double volume = a.dot(b.cross(c)) / 6;
    m.volume += volume;
    m.first += volume / 4 * sum;
    m.second +=
        volume / 20 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }
  return of;
}

// From the centre both ways along the axis, up to half the middle ball's radius before the surface.
inline std::optional<std::vector<Vector3>> axis_points(const SolidMoments& moments,
                                                       const BoundingVolumeHierarchy& solid) {
  if (!(std::abs(moments.volume) > 0)) return std::nullopt;
  const Vector3 centre = moments.centroid(), axis = moments.axis();
  if (!solid.inside(centre)) return std::nullopt;
  const double clearance = solid.distance(centre);
  std::vector<Vector3> points;
  for (const double sign : {-1.0, 1.0}) {
    const auto ahead = solid.first_hit(centre, sign * axis);
    if (!ahead) return std::nullopt;
    // As far before the surface as a grown end (ExtensionOptions), and at least a tenth of the way off, so
    // that the arc has a length.
    constexpr double kTipClearance = 0.5;
    const double reach = std::max(0.1 * ahead->distance, ahead->distance - kTipClearance * clearance);
    points.push_back(centre + sign * reach * axis);
    if (sign < 0) points.push_back(centre);
  }
  return points;
}

}  // namespace detail

inline Index lay_axes(ArcGraph& graph, const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
                      const std::vector<LimbTip>& tips) {
  const std::vector<bool> limbed = components_with_limbs(surface, tips);
  if (std::find(limbed.begin(), limbed.end(), false) == limbed.end()) return 0;
  const std::vector<Index> twice_euler = twice_euler_characteristics(surface);
  const std::vector<detail::SolidMoments> moments = detail::solid_moments(surface);
  const std::vector<Index> component = detail::hub_components(graph, surface);
  const std::size_t collapsed_arcs = graph.arcs.size();
  Index laid = 0;
  for (Index c = 0; c < surface.component_count; ++c) {
    if (limbed[c] || twice_euler[c] != 4) continue;
    const auto points = detail::axis_points(moments[c], solid);
    if (!points) continue;
    for (std::size_t i = 0; i < collapsed_arcs; ++i)
      if (component[graph.arcs[i].hub[0]] == c) graph.arcs[i].alive = false;
    for (Index h = 0; h < static_cast<Index>(component.size()); ++h)
      if (component[h] == c) graph.hub_alive[h] = false;
    Arc axis;
    axis.hub = {graph.add_hub(points->front()), graph.add_hub(points->back())};
    axis.points = *points;
    graph.arcs.push_back(std::move(axis));
    for (Index v = 0; v < surface.vertex_count(); ++v) {
      if (surface.vertex_halfedge[v] == kNone || surface.component[v] != c) continue;
      graph.arc_of_vertex[v] = graph.arc_count() - 1;
      graph.hub_of_vertex[v] = kNone;
    }
    ++laid;
  }
  return laid;
}

}  // namespace mspskel
