// From matched triangles without a boundary to the pieces that stay and their vertices.
#pragma once

#include <vector>

#include "face_set.h"
#include "mspskel/repair/mend_soup.h"

namespace mspskel::detail {

// Which triangles belong to a piece that encloses a volume and is no crumb.
std::vector<char> faces_to_keep(const std::vector<Vector3>& points, const FaceSet& faces,
                                const std::vector<Index>& twin, const MendOptions& options,
                                MendCounts& counts);

// The kept triangles with a vertex for each fan of faces, so that no vertex has two, and a vertex in the
// middle of all but one of the edges that join the same two vertices. Both are drawn into the material by a
// thousandth of their shortest edge; where void lies between two such edges (join_touching_pieces) the middle
// is drawn into it by a tenth, so that the bridge has a width. Vertices follow the order of the
// points, further ones of a point come after all those. Fills soup, vertex_of_point (for the points of
// `input`, whose like is point_of[point]), and `vertex_of_added`, for the points from input.points on.
void make_vertices(const std::vector<Vector3>& points, const FaceSet& faces, std::vector<Index> twin,
                   const std::vector<char>& keep, const PolygonSoup& input,
                   const std::vector<Index>& point_of, MendedSoup& mended,
                   std::vector<Index>& vertex_of_added);

}  // namespace mspskel::detail
