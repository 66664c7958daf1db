// Which way a body lies whose second moments do not tell it, as a cube.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <vector>

#include "mspskel/mesh/detail/solid_moments.h"

namespace mspskel {
namespace detail {

// ∫ vec(x xᵀ) vec(x xᵀ)ᵀ about the centroid.
using FourthMoment = Eigen::Matrix<double, 9, 9>;

inline Eigen::Matrix<double, 9, 1> vector_of_square(const Vector3& x) {
  const Eigen::Matrix3d square = x * x.transpose();
  return Eigen::Map<const Eigen::Matrix<double, 9, 1>>(square.data());
}

// Of the solids of the components that are wanted; each about the centroid of its moments. By the divergence
// theorem a seventh of the surface integral, for which six points a triangle are exact (Dunavant 1985, "High
// degree efficient symmetrical Gaussian quadrature rules for the triangle", degree 4).
inline std::vector<FourthMoment> fourth_moments(const SurfaceSnapshot& surface,
                                                const std::vector<SolidMoments>& moments,
                                                const std::vector<bool>& wanted) {
  struct Node {
    double weight, corner, others;  // barycentric coordinates
  };
  constexpr std::array<Node, 2> kNodes{{{0.223381589678011, 0.108103018168070, 0.445948490915965},
                                        {0.109951743655322, 0.816847572980459, 0.091576213509771}}};
  std::vector<FourthMoment> of(moments.size(), FourthMoment::Zero());
  for (Index h = 0; h < surface.halfedge_count(); h += 3) {
    const Index component = surface.component[surface.origin[h]];
    if (!wanted[component]) continue;
    const Vector3 centre = moments[component].centroid();
    const std::array<Vector3, 3> corner{surface.position[surface.origin[h]] - centre,
                                        surface.position[surface.target(h)] - centre,
                                        surface.position[surface.apex(h)] - centre};
    const double volume = corner[0].dot(corner[1].cross(corner[2])) / 6;
    for (const Node& node : kNodes)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto x = vector_of_square(node.corner * corner[k] +
                                        node.others * (corner[(k + 1) % 3] + corner[(k + 2) % 3]));
        of[component] += 3.0 / 7 * volume * node.weight * x * x.transpose();
      }
  }
  return of;
}

// The direction along which a body is long and ends flat: of least fourth moment over the cube of the second.
// Of an ellipsoid it is the longest axis, of a cube and of a prism as long as wide the normal of a side. The
// best of 256 directions, refined; of equal ones rounding decides. O(1).
inline Vector3 box_direction(const SolidMoments& moments, const FourthMoment& fourth) {
  constexpr int kDirections = 256, kRound = 8;
  constexpr double kFirst = 0.1, kLast = 1e-9;  // steps of the refinement, radians
  const Vector3 c = moments.centroid();
  const Eigen::Matrix3d second = moments.second / moments.volume - c * c.transpose();
  const auto cost = [&](const Vector3& d) {
    const auto square = vector_of_square(d);
    return square.dot(fourth * square) / std::pow(d.dot(second * d), 3);
  };
  Vector3 best = Vector3::UnitZ();
  double least = cost(best);
  const auto offer = [&](const Vector3& d) {
    const double at = cost(d);
    if (!(at < least)) return false;
    least = at;
    best = d;
    return true;
  };
  for (const Vector3& axis : {Vector3::UnitX().eval(), Vector3::UnitY().eval()}) offer(axis);
  for (int k = 0; k < kDirections; ++k) {
    const double z = (k + 0.5) / kDirections, angle = kPi * (3 - std::sqrt(5.0)) * k;
    offer({std::sqrt(1 - z * z) * std::cos(angle), std::sqrt(1 - z * z) * std::sin(angle), z});
  }
  for (double step = kFirst; step > kLast;) {
    const Vector3 middle = best, u = middle.unitOrthogonal(), w = middle.cross(u);
    bool better = false;
    for (int k = 0; k < kRound; ++k) {
      const double angle = 2 * kPi * k / kRound;
      better |= offer((middle + step * (std::cos(angle) * u + std::sin(angle) * w)).normalized());
    }
    if (!better) step /= 2;
  }
  return best;
}

}  // namespace detail
}  // namespace mspskel
