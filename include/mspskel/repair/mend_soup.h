// From what a mesh file holds to a closed surface: mended where that is possible, refused with a remedy where
// it is not.
#pragma once

#include <string>
#include <vector>

#include "mspskel/base/error.h"
#include "mspskel/base/progress.h"
#include "mspskel/mesh/polygon_soup.h"
#include "mspskel/repair/opening.h"

namespace mspskel {

// What becomes of a boundary loop.
enum class OpenEnds {
  kEnds,  // a tube's loop is an opening, where the skeleton ends; every other loop is closed as a hole
  kCap,   // every loop is closed as a hole
  kFail,  // MeshError if there is a loop
};

struct MendOptions {
  double weld = 0.0;  // points nearer than this share of the extent are one; [0, 0.01]; equal ones always are
  // Pieces whose extent is below this share of the largest piece's are crumbs and go; [0, 1]. 0 keeps all,
  // 1 keeps only the largest.
  double smallest_component = 0.025;
  // A piece whose extent is below this share of that of one which it touches in an edge is a part of it;
  // others stay apart; [0, 1].
  double touching_part = 0.5;
  OpenEnds open = OpenEnds::kEnds;
};

// Throws UsageError naming the option that is out of range.
void validate(const MendOptions& options);

// How much was done, in elements of the input unless it says otherwise.
struct MendCounts {
  Index welded_points = 0;     // points that became one with an earlier one
  Index stitched_points = 0;   // of these, boundary points that lay beside each other across a seam
  Index isolated_points = 0;   // points that no face uses
  Index degenerate_faces = 0;  // faces that have fewer than three different corners
  Index repeated_faces = 0;    // faces that repeat an earlier one
  Index two_sided_faces = 0;   // triangles that two opposite faces cancelled, each counted once
  Index thickened_faces = 0;   // of these, what is left of something thin, which got a thickness again
  Index flap_faces = 0;        // triangles of flaps and inner walls, which bound nothing
  Index turned_faces = 0;      // triangles turned to agree with their neighbours
  Index paired_edges = 0;      // edges of more than two faces
  Index one_sided_edges = 0;   // edges along which a surface of one side was cut open
  Index split_vertices = 0;    // vertices added where several fans of faces met
  Index split_edges = 0;       // vertices added in the middle of edges where the surface touched itself
  Index holes = 0;             // loops closed
  Index hole_faces = 0;        // triangles added
  double hole_share = 0.0;     // of the area of what stays, that they make up
  Index joined_pieces = 0;     // pieces that became parts of those they touch
  Index flat_components = 0;   // pieces without volume
  double flat_share = 0.0;     // of the area of all pieces, that they make up, without what closes holes
  Index small_components = 0;  // crumbs
  Index small_faces = 0;       // their triangles
};

struct MendedSoup {
  PolygonSoup soup;  // closed, manifold triangles, turned consistently
  // Per input point the vertex that stands for it, or kNone where everything round it was dropped.
  std::vector<Index> vertex_of_point;
  std::vector<Opening> openings;
  MendCounts counts;
};

// The mesh is refused; the counts are of what was done up to there.
struct MendError : MeshError {
  MendError(const std::string& message, const MendCounts& counts_so_far)
      : MeshError(message), counts(counts_so_far) {}
  MendCounts counts;
};

// Welds equal points, drops what bounds nothing, turns faces to agree, and pairs the faces round each edge of
// more than two by angle, so that each pair bounds material; what is open after that is stitched or closed.
//   Where solids touch in an edge or a point they are drawn apart by a thousandth of the shortest edge there;
// a much smaller one that touches in an edge is joined by a bridge along it.
//   Copies of a face are one. Two opposite copies cancel where the faces beside them close without them, and
//   are one face where they do not. A patch with a free edge that hangs on edges of three faces is a flap.
//   Boundary points nearer than a twentieth of their shortest boundary edge are stitched.
//   A loop is a tube's if the wall within a radius of it runs along an axis near its normal rather than
//   across,
// and its centre sees all of it where the notches between the teeth of a ragged end are filled.
// A closed, manifold surface comes through with its vertices and triangles, apart from crumbs and from pieces
// without volume.
// Throws MendError if nothing that encloses a volume is left, saying why and what would help, or if there is
// a loop and open is kFail; Cancelled. Cost: O(n log n); a loop of n edges takes n³ up to 128 edges, n log n
// beyond.
MendedSoup mend_soup(const PolygonSoup& soup, const MendOptions& options = {},
                     const ProgressCallback& progress = {});

// One sentence that sums up what was done; empty if nothing was.
std::string summary(const MendedSoup& mended);

}  // namespace mspskel
