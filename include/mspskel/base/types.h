// Scalar, vector and index types that every stage shares.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>

namespace mspskel {

// Positions and directions. Three doubles are no fixed-size vectorisable Eigen type, so they are safe in
// public structs.
using Vector3 = Eigen::Vector3d;

// Coordinates in a plane. Not aligned, so they are safe in public structs whatever flags their users compile
// with.
using Vector2 = Eigen::Matrix<double, 2, 1, Eigen::DontAlign>;

// Vertices, half-edges, faces, nodes. 32 bits hold 2^31 half-edges, that is meshes of 700 million faces.
using Index = std::int32_t;
inline constexpr Index kNone = -1;

inline constexpr double kPi = 3.14159265358979323846;

// From any type with three coordinates, such as a mesh's own.
template <class Point>
Vector3 to_vector3(const Point& p) {
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

}  // namespace mspskel
