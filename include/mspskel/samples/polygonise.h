// Closed triangle meshes of solids given by a function: marching tetrahedra, then remeshing on the function's
// surface.
#pragma once

#include <functional>

#include "mspskel/mesh/polygon_soup.h"

namespace mspskel {

// A solid as a function that is negative inside and changes no faster than the distance (it is 1-Lipschitz):
// a signed distance, or a lower bound of it. Parts that are farther from the surface than the function's
// value are skipped unseen.
struct ImplicitSolid {
  std::function<double(const Vector3&)> value;
  // How wide the solid is near a point, half the width of its thinnest part there; changes no faster than a
  // quarter of the distance. Empty where fineness need not follow it.
  std::function<double(const Vector3&)> width = {};
  Vector3 low = Vector3::Zero(), high = Vector3::Zero();  // a box that contains the solid
};

// The surface where `value` is 0 on a grid of cubes with the given side, each cut into six tetrahedra by
// Kuhn's pattern. Closed, manifold, outward and without self-intersections whatever the function; parts
// thinner than the cell may be lost. Cost: O(surface / cell²) evaluations. Throws UsageError if cell <= 0 or
// the grid would be larger than 2^20 cells a side.
PolygonSoup march_tetrahedra(const ImplicitSolid& solid, double cell);

// The same on tetrahedra that follow the solid's width: none of its edges is longer than 1.7 `cell` widths.
// They come of halving those of a cube (Maubach 1995), so that neighbours share their corners. Cost:
// O(surface / (cell · width)²) evaluations of value and width. Throws UsageError if cell <= 0 or the solid
// has no width.
PolygonSoup march_by_width(const ImplicitSolid& solid, double cell);

struct RemeshOptions {
  double edge = 0.1;  // wanted edge length, model units, > 0; in widths of the solid if by_width
  int rounds = 5;     // of split, collapse, flip, relax; 0 leaves the mesh alone
  bool by_width = false;
};

// Equalises edge lengths and angles (Botsch, Kobbelt 2004), vertices projected to the zero set of the solid's
// function. Keeps the topology. A step that would fold the surface is left out.
PolygonSoup remesh(const PolygonSoup& soup, const ImplicitSolid& solid, const RemeshOptions& options);

// Both in turn, with the cell and edge length that give about `vertices` vertices.
// `thinnest`: cells are never larger than this; half of the thinnest wall or gap is safe.
// Throws UsageError where so few vertices cannot show the solid.
PolygonSoup polygonise(const ImplicitSolid& solid, Index vertices, double thinnest);

// The same with edges in proportion to the solid's width, for solids with thick and thin parts: time and
// vertices do not depend on how far the widths differ.
PolygonSoup polygonise_by_width(const ImplicitSolid& solid, Index vertices);

}  // namespace mspskel
