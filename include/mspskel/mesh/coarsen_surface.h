// A closed surface with fewer vertices and the same topology: what the costly stages walk on where the input
// is finer than a skeleton can tell.
#pragma once

#include <vector>

#include "mspskel/base/progress.h"
#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {

struct CoarseningOptions {
  Index vertices = 1600;          // stop at this many; more stay where no collapse is permitted. [4, 2^31)
  Index component_vertices = 50;  // no component is thinned below this many. [4, 2^31)
  // Weight of the squared distance to the vertices merged, beside that to the planes of their faces. It
  // evens out the edges: they differ in length by curvature only where they exceed 8 √spread of the radius of
  // curvature. [1e-6, 1]
  double spread = 0.01;
  double most_turn = 60;  // degrees by which one collapse may turn a face. (0, 90]
  // Degrees between the normals of neighbouring faces; a collapse may not exceed this unless they were at
  // least as sharp before. A tube with n vertices round a section has 360/n, so this keeps thin limbs round.
  // (0, 180]
  double most_dihedral = 65;
  // Shape of a face, from 0 (sliver) to 1 (equilateral), that a collapse may not fall below unless the faces
  // were as bad before. [0, 1)
  double least_shape = 0.2;
  Index most_valence = 12;  // edges at a vertex that a collapse may make. [6, 32]
};

// Throws UsageError naming the option that is out of range.
void validate(const CoarseningOptions& options);

struct CoarseSurface {
  SurfaceSnapshot surface;           // in the frame of the input: its positions are comparable to the input's
  std::vector<Index> coarse_vertex;  // per input vertex the vertex it merged into; kNone for isolated ones
  Index collapses = 0;
  Index refused_topology = 0;  // attempts that failed by the link condition, valences, or a component's size
  Index refused_shape = 0;     // attempts that would have turned, creased or flattened a face too much
  Index passes = 0;
};

// Collapses edges in the order of their quadric error (Garland and Heckbert 1997, "Surface simplification
// using quadric error metrics", weighted by area, with a quadric for the merged points as in Trettner and
// Kobbelt 2020, "Fast and robust QEM simplification using probabilistic quadrics") and puts each merged
// vertex where its quadric is least. Each pass sorts the cheapest edges and collapses those whose ends no
// earlier collapse of the pass has moved; this replaces a heap at a fraction of its cost.
//
// The surface stays closed and manifold, component by component of the same genus (link condition: Dey,
// Edelsbrunner, Guha and Nekhayev 1999). Each class of merged vertices is connected on the input. Isolated
// vertices are left out. Vertices and faces are numbered by place in a frame that turns with the surface: a
// surface that is moved, scaled or stored in another order gives the same result up to rounding. With no more
// vertices than asked for, this is a copy. Sheets that lie closer together than the error may come to cross:
// nothing guards against it.
//
// O(faces · log(faces / vertices)). Throws UsageError, Cancelled.
CoarseSurface coarsen_surface(const SurfaceSnapshot& input, const CoarseningOptions& options = {},
                              const Execution& execution = {});

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/mesh/detail/coarsen_surface_impl.h"
#endif
