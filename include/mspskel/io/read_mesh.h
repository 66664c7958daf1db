// Reads OFF, OBJ, PLY, STL, VTK, VTP, glTF and 3MF in double precision, never beyond the bytes that are
// there.
#pragma once

#include <string>
#include <string_view>

#include "mspskel/mesh/default_mesh.h"
#include "mspskel/mesh/polygon_soup.h"

namespace mspskel {

enum class MeshFormat { kOff, kObj, kPly, kStl, kVtk, kVtp, kGltf, k3mf };

// Reads a mesh file whole; "-" is standard input. The format is that of the extension (.off .obj .ply .stl
// .vtk .vtp .gltf .glb .3mf, any case); another or no extension leaves it to the content.
//   OFF  with or without its keyword, in any case; ST, C, N, 4 (x/w, y/w, z/w) and n (of dimension 3) before
//        it, in any order; text and BINARY; the number of edges may be absent; face colours up to the end of
//        the line
//   OBJ  v (what follows x y z is ignored) and f (i, i/t, i//n, i/t/n, negative too, and what follows i may
//        be empty); lines may continue after a backslash; every other record is skipped
//   PLY  ascii and binary of both byte orders; elements vertex (x y z), face and tristrips (strips of
//        triangles, -1 between them), each with vertex_indices or vertex_index; the rest is skipped
//   STL  text and binary, told apart by size before the word "solid"; corners with equal coordinates (-0
//        equals 0) become one point, in order of first appearance, and triangles that lose a corner that way
//        are left out
//   VTK  legacy polydata, text and binary, of versions up to 5.1: POLYGONS and TRIANGLE_STRIPS; lines,
//        vertices and data of points and cells are skipped
//   VTP  VTK's XML polydata: Polys and Strips of all pieces; values as text, base64 or appended, of either
//        byte order, plain or compressed by ZLib
//   glTF 2.0, .gltf and .glb: the triangles, strips and fans of all meshes of the scene, as its nodes place
//        them, with sparse and quantised accessors; skinned meshes as they were bound; points and lines are
//        left out with a warning; Draco and meshopt compression are refused
//   3MF  the items to build, put together from objects of any model of the archive; supports are left out
//        with a warning; lengths in the file's unit
// Points keep the file's order. Throws ReadError that names the path and the line (in binary data the byte)
// for what cannot be read: a missing, empty or unreadable file, a malformed record, an index out of range, a
// coordinate that is not finite, more data announced than the file holds. Cost: linear; about 0.1 µs a face
// for OFF.
PolygonSoup read_polygon_soup(const std::string& path);

// The same from memory. Memory use is bounded by a constant times bytes.size(), whatever the header says;
// what compressed or repeated parts grow to, by 200 times that or 64 MiB. A glTF file whose buffers are other
// files is refused.
PolygonSoup read_polygon_soup(std::string_view bytes, MeshFormat format);

// read_polygon_soup, then build_mesh: throws MeshError if the surface is not closed, manifold and orientable.
DefaultMesh read_mesh(const std::string& path);

}  // namespace mspskel
