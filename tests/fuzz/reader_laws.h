// What every reader promises for any bytes, and the mesh builder for any soup.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "mspskel/base/error.h"
#include "mspskel/io/read_mesh.h"
#include "mspskel/io/write_mesh.h"
#include "mspskel/mesh/build_mesh.h"

namespace mspskel::fuzz {

inline void require(bool holds, const char* law) {
  if (holds) return;
  std::fprintf(stderr, "broken: %s\n", law);
  std::abort();
}

inline void check_soup(const PolygonSoup& soup, std::size_t size) {
  require(soup.points.size() <= size && soup.corners.size() <= size && soup.begin.size() <= size + 1,
          "a soup has no more elements than its file bytes");
  for (const Vector3& p : soup.points) require(p.allFinite(), "coordinates are finite");
  require(soup.begin.front() == 0 && soup.begin.back() == static_cast<Index>(soup.corners.size()),
          "polygons cover the corners");
  for (std::size_t f = 0; f < soup.polygon_count(); ++f)
    require(soup.begin[f] < soup.begin[f + 1], "no polygon is empty");
  for (const Index v : soup.corners)
    require(v >= 0 && v < static_cast<Index>(soup.points.size()), "indices are in range");
}

inline void check_round_trip(const PolygonSoup& soup) {
  for (const MeshFormat format : {MeshFormat::kOff, MeshFormat::kObj, MeshFormat::kPly}) {
    const std::string bytes = format_mesh(soup, format);
    const PolygonSoup again = read_polygon_soup(std::string_view(bytes), format);
    require(again.points == soup.points && again.begin == soup.begin && again.corners == soup.corners,
            "what is written reads back exactly");
  }
}

inline void check_mesh(const PolygonSoup& soup) {
  try {
    const BuiltMesh built = build_mesh_with_report(soup);
    require(built.mesh.n_vertices() == soup.points.size(), "vertices keep their numbers");
    require(2 * built.mesh.n_edges() == 3 * built.mesh.n_faces(),
            "a closed mesh has three half-edges a face");
    for (const auto h : built.mesh.halfedges())
      require(!h.is_boundary() && h.next().next().next() == h, "the mesh is closed");
  } catch (const MeshError&) {
  }
}

inline int check_reader(const std::uint8_t* data, std::size_t size, MeshFormat format) {
  try {
    const PolygonSoup soup =
        read_polygon_soup(std::string_view(reinterpret_cast<const char*>(data), size), format);
    check_soup(soup, size);
    check_round_trip(soup);
    check_mesh(soup);
  } catch (const ReadError&) {
  }
  return 0;
}

}  // namespace mspskel::fuzz
