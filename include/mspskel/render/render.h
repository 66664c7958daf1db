// Pictures of a surface and its skeleton without a window: orthographic software rendering from several
// sides.
#pragma once

#include <vector>

#include "mspskel/base/progress.h"
#include "mspskel/base/types.h"
#include "mspskel/mesh/polygon_soup.h"
#include "mspskel/mesh/surface_snapshot.h"
#include "mspskel/render/image.h"
#include "mspskel/skeleton/curve_skeleton.h"

namespace mspskel {

// A curve drawn as a thin tube, for example the contour of a slice.
struct Polyline {
  std::vector<Vector3> points;  // model coordinates
  bool closed = false;
  Color color{200, 60, 20};
};

// Everything is in one coordinate system. Each part may be empty, but not all of them.
struct RenderScene {
  PolygonSoup surface;              // polygons are cut into fans; need not be closed
  std::vector<Color> vertex_color;  // empty, or one per point of the surface
  CurveSkeleton skeleton;           // nodes and edges are read, parallel edges and loops do no harm
  std::vector<Polyline> lines;
};

struct RenderOptions {
  int width = 600;          // of one view, pixels, 16 to 8192
  int height = 600;         // of one view, pixels, 16 to 8192
  int view_count = 3;       // 1 to 16; see render()
  double azimuth = 35.0;    // of the three-quarter view, degrees round the model's upright axis, -360 to 360
  double elevation = 22.0;  // of the three-quarter view, degrees above the horizon, -90 to 90
  int samples = 3;          // along each side of a pixel, 1 to 4 (anti-aliasing)
  double ghost_opacity =
      0.3;  // of the surface in front of a skeleton or lines, 0 to 1; without them it is opaque
  double line_width = 5.0;  // of a skeleton edge, pixels, 0.5 to 100; balls and polylines go along
  bool wireframe = false;   // draw the edges of the surface's triangles
  Color background = kWhite;
  Color surface_color{176, 190, 210};
  Color edge_color{30, 70, 190};     // skeleton
  Color leaf_color{245, 150, 20};    // nodes with one neighbour
  Color joint_color{30, 165, 70};    // nodes with three or more
  Color outside_color{220, 20, 30};  // skeleton outside the surface's solid
};

// Throws UsageError naming the option.
void validate(const RenderOptions& options);

// Renders `view_count` views side by side (more than four: in a block), each fitted to its cell.
//
// The camera stands by the principal axes of the surface (area-weighted), so the model's orientation hardly
// matters. Upright is the principal axis within 30 degrees of y, else the second; if a coordinate axis is
// within 30 degrees of it, that one, because models stand on their coordinate planes more often than on their
// principal ones. View 1 looks along the shorter of the other two axes; view 2 is the other level or top view
// that shows the longest; the rest are three-quarter views, evenly round. One view alone is the three-quarter
// view, two are view 1 and that.
//
// The surface is drawn as a ghost if there is a skeleton or a line. Skeleton parts outside of the solid get
// outside_color, see outside_pieces(). The picture does not depend on the number of threads.
//
// Throws UsageError for options or vertex colours that do not fit, MeshError for corners or coordinates that
// do not.
// Cost: O(faces + pixels * samples^2 * depth) a view; 70,000 faces in three views of 600 x 600 take half a
// second of one core.
Image render(const RenderScene& scene, const RenderOptions& options = {}, const Execution& execution = {});

// A short straight piece of a skeleton edge, and whether its middle is outside the surface's solid.
struct SkeletonPiece {
  Vector3 begin, end;  // model coordinates
  Index edge = kNone;  // of the skeleton
  bool outside = false;
};

// Cuts the skeleton's edges into pieces of at most 1/400 of the scene's extent and tells inside from outside:
// along each of three rays in general directions the faces towards and away are counted, and a point is
// inside if the count is not balanced for two of them. Without faces nothing is outside. Cost: O(faces +
// pieces).
std::vector<SkeletonPiece> outside_pieces(const RenderScene& scene);

// Length outside over length of all pieces; 0 without pieces.
double outside_share(const std::vector<SkeletonPiece>& pieces);

// The surface of a snapshot in model coordinates.
PolygonSoup to_polygon_soup(const SurfaceSnapshot& surface);

}  // namespace mspskel
