// One self-contained page on which to look at a surface and its skeleton: it opens offline, from disk, in any
// browser with WebGL 2.
#pragma once

#include <string>
#include <vector>

#include "mspskel/base/types.h"
#include "mspskel/mesh/polygon_soup.h"
#include "mspskel/skeleton/curve_skeleton.h"

namespace mspskel {

// Places that a reader of the page should look at, and what there is to see.
struct ViewerPlaces {
  std::string text;                // a sentence
  std::vector<Vector3> positions;  // model coordinates
};

// Joints that bend the page's surface; empty: none.
struct ViewerRig {
  std::vector<std::string> names;
  std::vector<Index> parents;      // before their children; kNone at the first
  std::vector<Index> nodes;        // of the skeleton
  std::vector<Vector3> positions;  // model coordinates
  std::vector<Index> joints;       // four a vertex
  std::vector<double> weights;     // four a vertex
};

// What the page shows; lengths in model units. Lists per vertex are empty or have one entry a point of the
// surface.
struct ViewerScene {
  std::string title;
  PolygonSoup surface;                 // triangles
  CurveSkeleton skeleton;              // its surface map may be empty
  std::vector<Vector3> skeleton_mesh;  // per vertex: its skeletal point
  std::vector<double> msp;             // per vertex: minimum slice perimeter; NaN without a slice
  std::vector<double> slice_error;     // per vertex: 0 to 1; NaN without a slice
  std::vector<double> initial_msp;     // both before refinement, where there was one
  std::vector<double> initial_slice_error;
  std::vector<Vector3> slice_normal;  // per vertex: unit; zero without a slice
  std::vector<Index> part_of_vertex;  // of the surface
  std::vector<Index> part_of_node;    // one entry a node, or empty
  ViewerRig rig;
  std::vector<ViewerPlaces> places;  // those where the skeleton is outside are found here
  std::string report;                // the text of a JSON object as `--report` writes it; empty: none
};

// The page's bytes. Numbers are kept as 32-bit floats about the middle of the surface. Throws UsageError for
// a list of another length, an index out of range, a polygon that is no triangle, a surface without points,
// or a report that is not JSON; MeshError for coordinates that are not finite. Size: about 0.9 MB and 150
// bytes a vertex. Cost: O(faces + pieces of the skeleton).
std::string format_viewer_page(const ViewerScene& scene);

// format_viewer_page, written as write_file_atomically does.
void write_viewer_page(const std::string& path, const ViewerScene& scene);

}  // namespace mspskel
