// The boundary of a union of solids, from the shells' own triangles.
#pragma once

#include <optional>
#include <vector>

#include "mspskel/base/progress.h"
#include "mspskel/mesh/polygon_soup.h"
#include "shell_grid.h"
#include "shifted_shells.h"

namespace mspskel::detail {

struct CutShells {
  PolygonSoup soup;
  std::vector<std::size_t> shell;  // per triangle: the group's shell that it is of
  std::size_t crossings = 0;       // pairs of shells that cross
};

// The shells' triangles cut along the curves where the shells cross, without what lies in another's solid:
// closed, manifold, counter-clockwise as seen from outside, in the surface's coordinates. Each shell is moved
// by up to kShellShift first, so that no faces are coplanar and no three meet in a line. Nothing where a
// shell crosses itself beside another, or rounding gets in the way. Cost: O(pairs of faces that meet), and
// the square of those of one face.
std::optional<CutShells> cut_union(const ShellGroup& group, const Execution& execution);

}  // namespace mspskel::detail
