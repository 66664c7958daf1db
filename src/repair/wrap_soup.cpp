#include "mspskel/repair/wrap_soup.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "merge_short_edges.h"
#include "mspskel/base/error.h"
#include "mspskel/base/watch.h"
#include "outside_flood.h"
#include "point_tree.h"
#include "tetrahedron_cutter.h"
#include "unit_of_length.h"
#include "whole_pieces.h"

namespace mspskel {
namespace {

using detail::DenseGrid;
using detail::OutsideFlood;
using detail::SoupWalls;

// In cells: nodes of a wall that is this thick on both sides hang together in the tetrahedra of the grid.
constexpr double kWall = 0.87;
// Shares of the extent. A soup tells its scale on a grid of twice the finest cells, which is enough to count;
// its walls are as thick there as on the finest.
constexpr double kLeastGap = 0.0125, kLargestGap = 0.1;  // powers of two apart
constexpr double kFinestToldCell = 0.00625, kFinestCell = 0.004, kCoarsestCell = 0.01;
constexpr double kRoom = 4;  // in gaps
constexpr double kTellingCell = 2 * kFinestToldCell;

struct Scale {
  double gap = kLargestGap, cell = kCoarsestCell;  // shares of the extent
  bool encloses = true;

  double wall() const { return kWall * cell; }
};

Scale scale_for(double gap, double finest_cell) {
  return {gap, std::clamp(gap / 4, finest_cell, kCoarsestCell)};
}

// What a ball of each gap encloses, counted on one grid.
class Telling {
 public:
  // filled: model units cubed.
  Telling(const SoupWalls& walls, double filled, double largest_gap, detail::Watch& watch)
      : extent_(walls.extent),
        filled_(filled / std::pow(kTellingCell * walls.extent, 3)),
        flood_(walls, kTellingCell * extent_, kToldWall * extent_, radius(largest_gap), watch) {}

  // In cells: what is shut in beside the walls, and what closed shells fill.
  double enclosed(double gap) {
    flood_.run(radius(gap));
    return flood_.unreached_cells() - flood_.wall_cells() - filled_;
  }
  // The same of what is at least so wide.
  double rooms(double gap, double width) {
    flood_.run(radius(gap));
    return flood_.room_cells(width / 2 * extent_) - filled_;
  }
  double filled() const { return filled_; }
  double walls() const { return flood_.wall_cells(); }

 private:
  static constexpr double kToldWall = kWall * kFinestToldCell;
  // The ball keeps as far from the faces as that of the scale's own grid.
  double radius(double gap) const {
    return (gap / 2 + scale_for(gap, kFinestToldCell).wall() - kToldWall) * extent_;
  }

  double extent_, filled_;
  OutsideFlood flood_;
};

// The least scale that encloses half of what the largest does; walls alone tell nothing. What only the
// largest closes may be a valley, of which a larger ball leaves out still more.
Scale told_scale(const SoupWalls& walls, detail::Watch& watch) {
  constexpr double kSteady = 0.8;
  Telling telling(walls, 0, kLargestGap, watch);
  const double most = telling.enclosed(kLargestGap);
  double gap = kLeastGap;
  if (most > telling.walls())
    while (gap < kLargestGap && telling.enclosed(gap) < most / 2) gap *= 2;
  Scale chosen = scale_for(gap, kFinestToldCell);
  chosen.encloses = most > telling.walls();
  if (chosen.encloses && gap == kLargestGap)
    chosen.encloses = most > kSteady * Telling(walls, 0, 2 * kLargestGap, watch).enclosed(2 * kLargestGap);
  return chosen;
}

// Shells are walls where the least gap shuts in rooms of more than they fill, beside what they fill. The
// nooks between shells that are hardly wider than the gap are none.
Scale scale_of_shells(const SoupWalls& walls, double filled, detail::Watch& watch) {
  Telling telling(walls, filled, kRoom * kLeastGap, watch);
  Scale scale = scale_for(kLeastGap, kFinestToldCell);
  scale.encloses = telling.rooms(kLeastGap, kRoom * kLeastGap) > telling.filled();
  return scale;
}

Scale scale_of(const SoupWalls& walls, const WrapOptions& options, detail::Watch& watch) {
  if (options.gap > 0) return scale_for(options.gap, kFinestCell);
  return options.filled > 0 ? scale_of_shells(walls, options.filled, watch) : told_scale(walls, watch);
}

PolygonSoup surface_of(const OutsideFlood& flood, detail::Watch& watch) {
  const DenseGrid& grid = flood.grid();
  detail::TetrahedronCutter cutter(flood, static_cast<std::uint64_t>(grid.count()));
  for (Index z = 0; z + 1 < grid.size(2); ++z)
    for (Index y = 0; y + 1 < grid.size(1); ++y)
      for (Index x = 0; x + 1 < grid.size(0); ++x) {
        std::array<Index, 8> corner{};
        for (int k = 0; k < 8; ++k) corner[k] = grid.node(x + (k & 1), y + (k >> 1 & 1), z + (k >> 2 & 1));
        watch.step();
        cutter.cut_cube(corner);
      }
  return cutter.take();
}

Index nearest(const PolygonSoup& surface, const detail::PointTree& tree, const Vector3& p, double cell) {
  Index best = kNone;
  double least = std::numeric_limits<double>::infinity();
  for (double within = 2 * cell; best == kNone; within *= 2)
    tree.each_within(p, within, [&](Index v) {
      const double d = (surface.points[v] - p).squaredNorm();
      if (d > least || (d == least && v > best)) return;
      least = d;
      best = v;
    });
  return best;
}

std::vector<Index> nearest_vertices(const PolygonSoup& soup, const WrappedSoup& wrapped,
                                    detail::Watch& watch) {
  std::vector<char> used(soup.points.size(), 0);
  for (const Index v : soup.corners)
    if (v >= 0 && v < static_cast<Index>(used.size())) used[v] = soup.points[v].allFinite();
  std::vector<Index> all(wrapped.soup.points.size());
  for (std::size_t v = 0; v < all.size(); ++v) all[v] = static_cast<Index>(v);
  const detail::PointTree tree(wrapped.soup.points, all);
  std::vector<Index> vertex_of_point(soup.points.size(), kNone);
  for (std::size_t p = 0; p < used.size(); ++p) {
    watch.step();
    if (used[p]) vertex_of_point[p] = nearest(wrapped.soup, tree, soup.points[p], wrapped.cell);
  }
  return vertex_of_point;
}

WrappedSoup wrap(const PolygonSoup& soup, const WrapOptions& options, const Execution& execution) {
  detail::Watch watch(execution.progress, "wrapping");
  watch.ask(0.0);
  const SoupWalls walls(soup);
  watch.ask(0.1);
  const Scale scale = scale_of(walls, options, watch);
  WrappedSoup wrapped;
  wrapped.encloses = scale.encloses;
  if (!scale.encloses && !options.thicken_walls) return wrapped;
  watch.ask(0.2);
  wrapped.cell = scale.cell * walls.extent;
  wrapped.gap = scale.gap * walls.extent;
  OutsideFlood flood(walls, wrapped.cell, kWall * wrapped.cell, wrapped.gap / 2, watch);
  watch.ask(0.6);
  flood.run(wrapped.gap / 2);
  watch.ask(0.8);
  detail::WholePieces pieces = detail::without_crumbs(surface_of(flood, watch));
  wrapped.small_components = pieces.crumbs;
  wrapped.solids = pieces.solids;
  wrapped.soup = detail::without_short_edges(pieces.soup, detail::kShortEdge * wrapped.cell, watch);
  watch.ask(0.9);
  wrapped.vertex_of_point = nearest_vertices(soup, wrapped, watch);
  return wrapped;
}

}  // namespace

void validate(const WrapOptions& options) {
  if (options.gap != 0 && !(options.gap >= 0.004 && options.gap <= 0.2))
    throw UsageError("gaps that wrapping closes must be from 0.004 to 0.2 of the extent, or 0");
  if (!(options.filled >= 0)) throw UsageError("what shells fill must be at least 0");
}

WrappedSoup wrap_soup(const PolygonSoup& soup, const WrapOptions& options, const Execution& execution) {
  validate(options);
  const int exponent = detail::exponent_of_unit(soup);
  if (exponent == 0) return wrap(soup, options, execution);
  PolygonSoup near_one = soup;
  detail::scale_points(near_one, -exponent);
  WrapOptions near_options = options;
  near_options.filled = std::scalbn(options.filled, -3 * exponent);
  WrappedSoup wrapped = wrap(near_one, near_options, execution);
  if (!detail::survives_scaling(wrapped.soup, exponent))
    throw MeshError(detail::refusal_to_scale(exponent, "wrapped"));
  detail::scale_points(wrapped.soup, exponent);
  wrapped.gap = std::scalbn(wrapped.gap, exponent);
  wrapped.cell = std::scalbn(wrapped.cell, exponent);
  return wrapped;
}

}  // namespace mspskel
