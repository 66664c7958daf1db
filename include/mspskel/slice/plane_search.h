// Search for the minimum slice instead of sampling: a few planes at every vertex, the planes that won at its
// neighbours, and a compass search over angle and tilt. A fraction of the work of cone refinement for slices
// that are as short or shorter.
#pragma once

#include "mspskel/slice/minimum_slice_perimeter.h"

namespace mspskel {

enum class SliceObjective {
  kPerimeter,  // the raw perimeter: comparable with sampling, but a tilt shortens slices of round parts
  kPerimeterOverTilt,  // perimeter / cos(tilt): all slices through a point of a sphere tie, so tilt is not
                       // rewarded
};

struct SearchOptions {
  SliceObjective objective = SliceObjective::kPerimeterOverTilt;
  int angles = 6;            // planes through the normal tried at seed vertices, 1 to 1000
  int spread = 6;            // planes over all angles and tilts tried at every vertex, 0 to 1000
  int rounds = 12;           // most rounds in which vertices look at their neighbours' planes, 0 to 1000
  double max_tilt = 55.0;    // largest angle between the plane and the vertex normal, degrees; 0 to below 90
  double first_step = 15.0;  // first compass step at seed vertices, degrees; last_step to 90
  double last_step = 5.0;    // least compass step there and the only one elsewhere, degrees; above 0
};

inline void validate(const SearchOptions& o) {
  if (o.angles < 1 || o.angles > 1000) throw UsageError("search angles must be from 1 to 1000");
  if (o.spread < 0 || o.spread > 1000) throw UsageError("search spread must be from 0 to 1000");
  if (o.rounds < 0 || o.rounds > 1000) throw UsageError("search rounds must be from 0 to 1000");
  if (!(o.max_tilt >= 0 && o.max_tilt < 90))
    throw UsageError("search tilt must be from 0 to below 90 degrees");
  if (!(o.last_step > 0 && o.last_step <= o.first_step && o.first_step <= 90))
    throw UsageError("search steps must satisfy 0 < last <= first <= 90 degrees");
}

}  // namespace mspskel

namespace mspskel {

// MSP slices by search. Seeds, the vertices whose area no neighbour exceeds, search on their own; from them
// planes spread over the surface, each vertex trying its neighbours' and a few of its own, and improvements
// go on spreading until nothing changes or `rounds` are over. A round reads only the round before, so the
// result depends neither on threads nor on the order of vertices. Cost: about 15 slices a vertex. Errors are
// left at 1. Throws UsageError, Cancelled.
VertexSlices search_minimum_slice_perimeters(const SliceTracer& tracer, const SearchOptions& options,
                                             const Execution& execution = {});

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/slice/detail/plane_search_impl.h"
#endif
