// Volume integrals over the solids that the components of a surface bound.
#pragma once

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <vector>

#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {
namespace detail {

// From the tetrahedra of the faces and the origin.
struct SolidMoments {
  double volume = 0.0;
  Vector3 first = Vector3::Zero();                   // ∫ x
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();  // ∫ x xᵀ

  double gross = 0.0;  // volumes of the tetrahedra, each without its sign

  // More than rounding leaves of a sheet.
  bool has_volume() const { return std::abs(volume) > 1e-13 * gross; }
  // Of a solid that has a volume.
  Vector3 centroid() const { return first / volume; }

  // The axis along the length of a solid that is longer than wide; of others the principal axis whose moment
  // stands apart from the other two by the larger factor.
  Vector3 axis() const {
    const auto solver = principal_axes();
    const Vector3 moment = solver.eigenvalues();
    return solver.eigenvectors().col(is_longer(moment) || moment[2] * moment[0] > moment[1] * moment[1] ? 2
                                                                                                        : 0);
  }
  // Whether the axis is longer or shorter than the other two are, so that it tells how the solid lies.
  bool axis_stands_apart() const {
    const Vector3 moment = principal_axes().eigenvalues();
    return is_longer(moment) || moment[1] > kLonger * kLonger * moment[0];
  }
  // Whether the axis is that along the length.
  bool is_longer_than_wide() const { return is_longer(principal_axes().eigenvalues()); }
  // Of a solid whose sections across its axis are all alike.
  double length_as_prism() const { return std::sqrt(12 * principal_axes().eigenvalues()[2]); }

 private:
  static constexpr double kLonger = 1.1;

  static bool is_longer(const Vector3& ascending) { return ascending[2] > kLonger * kLonger * ascending[1]; }

  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal_axes() const {  // ascending
    const Vector3 c = centroid();
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(second / volume - c * c.transpose());
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
    m.gross += std::abs(volume);
    m.first += volume / 4 * sum;
    m.second +=
        volume / 20 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }
  return of;
}

}  // namespace detail
}  // namespace mspskel
