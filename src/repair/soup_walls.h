// The faces of a soup as what a wrap goes round.
#pragma once

#include <limits>
#include <vector>

#include "clean_faces.h"
#include "mspskel/base/error.h"
#include "mspskel/mesh/detail/triangle_queries.h"
#include "mspskel/mesh/polygon_soup.h"
#include "weld_points.h"

namespace mspskel::detail {

// What is wrapped: the faces, and polygons that are pressed to lines, which still join what lies at their
// ends: they are triangles of two corners.
struct SoupWalls {
  explicit SoupWalls(const PolygonSoup& all) : soup(all) {
    Index degenerate = 0;
    const std::vector<Index> point_of = weld_equal_points(soup.points);
    faces = clean_faces(soup, point_of, degenerate);
    if (faces.count() == 0) throw MeshError("the mesh has no face with an area: there is nothing to wrap");
    if (degenerate > 0) add_lines(point_of);
    low = high = soup.points[faces.corners[0]];
    for (const Index v : faces.corners) {
      low = low.cwiseMin(soup.points[v]);
      high = high.cwiseMax(soup.points[v]);
    }
    extent = (high - low).norm();
    if (!(extent > 0 && extent < std::numeric_limits<double>::infinity()))
      throw MeshError("the mesh has no extent that can be wrapped");
  }

  Triangle triangle(Index f) const {
    const auto corner = [&](Index k) { return soup.points[faces.corners[3 * f + k]]; };
    return {corner(0), corner(1), corner(2)};
  }

  const PolygonSoup& soup;
  FaceSet faces;
  Vector3 low, high;
  double extent = 0;

 private:
  void add_lines(const std::vector<Index>& point_of) {
    std::vector<char> cleaned(soup.polygon_count(), 0);
    for (const Index f : faces.polygon) cleaned[f] = 1;
    const auto known = [&](Index v) {
      return v >= 0 && v < static_cast<Index>(soup.points.size()) && soup.points[v].allFinite();
    };
    for (Index f = 0; f < static_cast<Index>(cleaned.size()); ++f)
      for (Index i = soup.begin[f]; !cleaned[f] && i + 1 < soup.begin[f + 1]; ++i) {
        const Index from = soup.corners[i], to = soup.corners[i + 1];
        if (known(from) && known(to) && point_of[from] != point_of[to])
          faces.add(point_of[from], point_of[to], point_of[to], f);
      }
  }
};

}  // namespace mspskel::detail
