// Parts that no arc of a skeleton stands for: a box on a box, the foot of a vase.
#pragma once

#include <vector>

#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {

struct CreasePartOptions {
  // A border between two parts is a gain where it costs at most so many times the square root of the smaller
  // one's area, else a loss; [0, 100]. Round an open disc it is 2 sqrt(pi) = 3.5.
  double cost = 0.5;
  // Parts below this share of the surface do not stay apart; [0, 1].
  double smallest = 0.005;
  Index most = 0;   // at most so many parts, though never fewer than there were; 0: no limit
  Index least = 0;  // at least so many, as far as there are faces
  // Borders that cost up to so many times `cost` are settled before it is decided which of them stand; [1,
  // 100].
  double doubt = 1.4;
  double border_width = 0.25;  // how far they move then, in radii of a circle of their length; [0, 10]
};

// Throws UsageError naming the option.
void validate(const CreasePartOptions& options);

// Merges the single faces of each part: of all pairs of pieces that touch, the one whose border costs most
// for its smaller piece becomes one, until the part is one again. Of this tree of merges those are undone,
// from the last one down, whose borders gain most together: each log(`cost` / what it costs for its smaller
// piece), where a border of which creases take less than half counts as too dear (optimal cuts of a
// hierarchy: Guigues, Cocquerez and Le Men 2006, "Scale-sets image analysis"). What stays apart lies within a
// ring of creases. Where a border between grown pieces runs, and so what it costs, depends on the order of
// merges: those that may stand settle (smooth_borders), which may move the borders of the parts given, too,
// and merging starts anew from what they bound. `costs` are those of border_costs. Writes `part_of_face`,
// numbered by the least face. Throws UsageError for options out of range. O(faces log faces) on meshes whose
// pieces have few neighbours, and a maximum flow about each border.
void split_at_creases(const SurfaceSnapshot& surface, const std::vector<double>& costs,
                      std::vector<Index>& part_of_face, const CreasePartOptions& options = {});

}  // namespace mspskel
