// Pipes that meet, cut off across: what pipework and turned parts are made of.
#pragma once

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "mspskel/mesh/component_extents.h"
#include "mspskel/mesh/subdivide_surface.h"
#include "mspskel/render/render.h"
#include "mspskel/repair/unite_shells.h"
#include "support/meshes.h"

namespace mspskel::test {

struct Pipe {
  Vector3 from, to;
  double radius;
};

// Pipes as one solid with exact rims, its edges about `edge` long.
inline DefaultMesh united(const std::vector<Pipe>& pipes, double edge) {
  PolygonSoup soup;
  for (const Pipe& pipe : pipes) {
    const Vector3 axis = pipe.to - pipe.from;
    const auto segments = static_cast<Index>(std::ceil(2 * kPi * pipe.radius / edge));
    const auto rings = static_cast<Index>(std::ceil(axis.norm() / edge));
    const Eigen::Matrix3d turn =
        Eigen::Quaterniond::FromTwoVectors(Vector3::UnitZ(), axis).toRotationMatrix();
    const PolygonSoup own = to_soup(tube(pipe.radius, axis.norm(), segments, rings));
    const auto first = static_cast<Index>(soup.points.size());
    for (const Vector3& p : own.points) soup.points.push_back(pipe.from + turn * p);
    for (std::size_t c = 0; c < own.corners.size(); c += 3)
      soup.add_triangle(first + own.corners[c], first + own.corners[c + 1], first + own.corners[c + 2]);
  }
  const SurfaceSnapshot surface = make_snapshot(to_mesh(soup));
  const UnitedShells solid = unite_shells(surface, crossing_shells(surface));
  REQUIRE(solid.solids == 1);
  const SurfaceSnapshot sparse = make_snapshot(to_mesh(solid.soup));
  SubdivisionOptions options;
  options.enough = 1'000'000;
  options.longest = 2 * edge / component_extents(sparse)[0] / sparse.frame.scale;
  return to_mesh(to_polygon_soup(subdivide_surface(sparse, options).surface));
}

}  // namespace mspskel::test
