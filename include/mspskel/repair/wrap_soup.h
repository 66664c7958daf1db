// What cannot be mended is wrapped: one closed surface round a soup, at a scale that the soup tells.
#pragma once

#include <vector>

#include "mspskel/base/progress.h"
#include "mspskel/mesh/polygon_soup.h"

namespace mspskel {

struct WrapOptions {
  // Gaps narrower than this share of the extent are closed; [0.004, 0.2]. 0: the least of 0.0125, 0.025, 0.05
  // and 0.1 at which at least half of what the last one encloses is enclosed. Where that is the last one,
  // nothing is enclosed unless it encloses 0.8 of what a gap of 0.2 does.
  double gap = 0.0;
  // Whether faces that enclose nothing get a thickness where the soup is to tell the scale; else nothing is
  // made.
  bool thicken_walls = true;
  // Where the soup is closed shells that cross each other: the sum of what each of them fills, model units
  // cubed; at least 0. They are walls, and enclose something, only where a gap of 0.0125, which is the one
  // that is closed then, shuts in more than as much again, in rooms four times as wide.
  double filled = 0.0;
};

// Throws UsageError naming the option that is out of range.
void validate(const WrapOptions& options);

struct WrappedSoup {
  PolygonSoup soup;                    // closed, manifold triangles, model units
  std::vector<Index> vertex_of_point;  // the vertex nearest to each point; kNone for points of no face
  double gap = 0.0, cell = 0.0;        // model units
  // Whether more is enclosed than the walls take at the largest scale that the soup was asked for, or than
  // its shells fill; where it is not, the soup has told no scale: its faces were given a thickness, or all
  // else here is empty.
  bool encloses = true;
  Index solids = 0, small_components = 0;
};

// The solid is what a ball of the gap's diameter, kept clear of the faces, cannot reach from outside: gaps
// that it does not pass are closed, hollows that it does not find are filled, double walls and crossing faces
// are inside. Faces that enclose nothing get a thickness of less than two cells of the grid; all else grows
// outward by less than one. Crumbs below 0.025 of the largest piece's extent are left out.
//   On a grid whose cells are a quarter of the gap, but from 0.004 to 0.01 of the extent, or from 0.00625
// where the soup tells the scale: distances from the faces, a flood from outside where the ball fits,
// distances from what it reached, and the surface where they equal its radius, cut in tetrahedra. The scale
// is told by volumes on a grid of cells of 0.0125. Faces with corners that are not finite, or not there, are
// left out.
// Throws MeshError if no face has an extent or the wrap has no numbers for its points, Cancelled. Cost: O(nodes + faces + surface / cell²); 40 bytes a
// node.
WrappedSoup wrap_soup(const PolygonSoup& soup, const WrapOptions& options = {},
                      const Execution& execution = {});

}  // namespace mspskel
