// Shells that cross each other are one solid: a figure of body, hair and clothes, a pot with its handle.
#pragma once

#include <vector>

#include "mspskel/base/progress.h"
#include "mspskel/mesh/polygon_soup.h"
#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {

struct UniteOptions {
  // Side of the cells of a grid on which shells are sampled, as a share of the united shells' extent;
  // [0.001, 0.1]. 0: they are cut where that can be; else a third of the thinnest shell's thickness, at most
  // a hundredth, and not so fine that more than about 20 nodes a face of the shells lie near the surface, or
  // 60,000 where they have few faces, or 300,000 where they have many.
  double cell = 0.0;
};

// Throws UsageError naming the option that is out of range.
void validate(const UniteOptions& options);

struct UnitedShells {
  PolygonSoup soup;  // closed triangles, model units: the shells that cross no other, as they are,
                     // then the united ones
  std::vector<Index> vertex_of;  // per vertex of the surface: its own, or the nearest of the united surface
  std::vector<bool> replaced;    // per component of the surface: it is a part of a united one
  Index shells = 0, solids = 0;  // how many were united into how many
  Index left_apart = 0;          // shells that cross others and stay apart; the soup is empty if all do
  // Of the largest grid on which shells were sampled, model units; 0 if none was.
  double cell = 0.0;
  bool resolved = true;  // every grid is fine enough for the thinnest of its shells
};

struct CrossingShells {
  // At least two components that cross each other or are copies, each group in order.
  std::vector<std::vector<Index>> groups;
  // Per component the first one that it is a copy of, which is none itself; kNone. Empty without groups.
  std::vector<Index> copy_of;
};

// Contact does not count: an edge or a vertex of one has to lie in the other by a thousandth of the smaller
// one's extent, or a hundredth of its width (four times volume over area) where that is less. Copies lie
// within 0.005 of their width of each other everywhere. Cost: a box query a face. Throws Cancelled.
CrossingShells crossing_shells(const SurfaceSnapshot& surface, const Execution& execution = {});

// Whether two components have all their vertices in the same places: a part that a file holds twice. They
// touch everywhere and cross nowhere. O(vertices log vertices).
bool has_repeated_shells(const SurfaceSnapshot& surface);

// Each group of `crossing` becomes the boundary of the union of their solids; of copies one stays as it
// is.
//   The shells' triangles are cut along the curves where they cross, and those within another shell's solid
// are left out: as fine as the shells, with the handles of their union. Each shell is moved by up to 2e-7 of
// the extent before, so that faces in one plane are none. Parts in contact leave slits, and these handles: if
// the union has more handles than its shells, more pieces than one, or cavities, it is cut again with each
// shell grown by 5e-4 to 7.5e-4 of the extent, at most 0.015 of the shell's width, and the better of the two
// is taken. Cavities below a hundredth of the volume are filled. Edges longer than one and a half of their
// shell's thickness are halved, those shorter than 0.15 of the thinnest one's are merged.
//   Where that fails, as where a shell crosses itself beside another, where two vertices come to lie in one
// place, or where the union has more handles than its shells have and n of them, or the further pairs of a
// graph of crossings beyond a tree, can make, shells that cross by less than a thousandth of their extent
// are told apart, and what still crosses is cut, or sampled at the nodes of a grid near the surface: inside
// where a shell's own solid has the node. Each cube of the grid is six tetrahedra about one diagonal (Kuhn
// 1960), and what separates inside from outside in them is a closed manifold (Doi and Koide 1991, "An
// efficient method of triangulating equi-valued surfaces by using tetrahedral cells"). Walls thinner than the
// cells give the union handles: if it has more than its shells have, all are thickened by half a cell's
// diagonal, and the better union is taken; one that still has too many is none: they stay apart, as the
// parts of an assembly do.
//   Pieces of the union below 0.025 of its extent are left out.
// Positions are those of the shells, or within a cell of them. Cost: O(pairs of faces that meet) and the
// square of those of one face; on a grid O(area / cell²) inside queries and distances, in parallel. Throws
// Cancelled.
UnitedShells unite_shells(const SurfaceSnapshot& surface, const CrossingShells& crossing,
                          const UniteOptions& options = {}, const Execution& execution = {});

}  // namespace mspskel
