// Reads a curve skeleton back.
#pragma once

#include <string>
#include <string_view>

#include "mspskel/io/write_skeleton.h"
#include "mspskel/skeleton/curve_skeleton.h"

namespace mspskel {

// Reads .skel, .obj (v and l), .ply (text or binary; vertices with x, y, z and perhaps radius, edges with
// vertex1 and vertex2), .json, .swc (with the edges that the writer cut) and .cgal or .polylines.txt (points
// in the same place are one node), by extension; "-" is .skel from standard input. Positions and edges, radii
// from .skel, .ply, .json and .swc, the surface map and the other node values from .json. Edges come out
// sorted, each once. Throws ReadError that names the path and the line or element: a malformed file, an index out of
// range, an edge from a node to itself, a number that is not finite. Throws UsageError for another extension.
CurveSkeleton read_skeleton(const std::string& path);

// The same from memory. Throws UsageError for formats that are only written.
CurveSkeleton read_skeleton(std::string_view bytes, SkeletonFormat format);

}  // namespace mspskel
