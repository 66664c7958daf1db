// Writes polygons or meshes as OFF, OBJ or PLY, each number in the shortest form that reads back exactly.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mspskel/io/read_mesh.h"
#include "mspskel/mesh/default_mesh.h"
#include "mspskel/mesh/polygon_soup.h"

namespace mspskel {

struct VertexColor {
  std::uint8_t red = 0, green = 0, blue = 0;
};

struct WriteMeshOptions {
  bool ascii = false;  // PLY only: text; else binary, little-endian
  // One a vertex, or empty. OFF becomes COFF; OBJ gets three numbers from 0 to 1 after the coordinates.
  std::vector<VertexColor> vertex_colors;
};

// Colours from blue (low) to red (high) as in the thesis's figures 3.2 and 3.5; values beyond are clamped,
// NaN is grey. If low >= high the range is that of the finite values.
std::vector<VertexColor> color_by_value(const std::vector<double>& values, double low = 0.0,
                                        double high = 0.0);

// The polygons of a mesh, vertex and face order kept.
PolygonSoup to_polygon_soup(const DefaultMesh& mesh);

// The bytes of a file. Throws UsageError for STL, which is only read, or if there are colours but not one a
// vertex, MeshError that names a point that is not finite.
std::string format_mesh(const PolygonSoup& soup, MeshFormat format, const WriteMeshOptions& options = {});

// By extension, in any case (.off .obj .ply); "-" is OFF. Throws UsageError for another extension.
MeshFormat written_mesh_format_of(const std::string& path);

// format_mesh for the path's extension, written as write_file_atomically does. Throws WriteError, too.
void write_mesh(const std::string& path, const PolygonSoup& soup, const WriteMeshOptions& options = {});
void write_mesh(const std::string& path, const DefaultMesh& mesh, const WriteMeshOptions& options = {});

}  // namespace mspskel
