// Arcs in the walls of shells, where no section tells one way from another: the shortest one, in the middle
// of the wall.
#pragma once

#include <vector>

#include "mspskel/arcs/arc_graph.h"
#include "mspskel/base/progress.h"
#include "mspskel/collapse/crossing_labels.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/mesh/surface_snapshot.h"
#include "mspskel/solid/detail/inner_graph.h"

namespace mspskel {

// Draws the arcs of shells tight between the ends of their tubes, so that a mug's loop runs straight down the
// wall from one end of its handle to the other: rounds of the heat flow along the line, each followed by a
// move to the middle of the wall's chord. Points in tubes, hubs of other arcs, and loops without a tube stay.
// Where the shortest way of its class through the middle of the wall is another one, it takes that.
// Where a shell has several handles and the arcs in its wall are a tree, they are laid anew if that makes the
// loops shorter: each handle closes on itself and hangs on the middle of the floor, and so do all other ends.
// A shell with loops and no leaf gets an arc from the end of a tube to the middle of its floor, which is
// where the axis of its opening runs inside; the shortest of these arcs. A point moves only as far as its
// edges stay off the surface. Returns the number of arcs drawn. Cost: a section a point, and a closest point
// and a ray a point and round; a path through the solid an end of a tube. Throws Cancelled.
Index tighten_in_walls(ArcGraph& graph, detail::InnerGraph& inner, const std::vector<bool>& shells,
                       double step, const CrossingLabels& crossings = {}, const Execution& execution = {});

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/arcs/detail/tighten_walls_impl.h"
#endif
