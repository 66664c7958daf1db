// Which two triangles follow each other over an edge.
#pragma once

#include "face_set.h"
#include "mspskel/repair/mend_soup.h"

namespace mspskel::detail {

// Turns the triangles to agree with those beside them and matches half-edges that run opposite ways: per
// half-edge the other one, or kNone at a boundary.
//
//        \ material /        Round an edge of more than two faces (seen along it) the faces bound wedges of
//    void \        / void    material and of void in turn. The two faces of a wedge of material are a pair:
//   -------edge x-------     where solids touch along an edge they stay apart.
//    void /        \ void
//        / material \        Faces next to each other in that order are turned to agree.
//
// Within a patch, connected over edges of two faces, most triangles keep their turn; patches that meet at
// crowded edges keep or change theirs as a whole, then all of them if the volume is negative.
std::vector<Index> pair_faces(const std::vector<Vector3>& points, FaceSet& faces, MendCounts& counts);

}  // namespace mspskel::detail
