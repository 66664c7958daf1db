#include "mspskel/repair/wrap_soup.h"

#include <algorithm>
#include <limits>
#include <queue>
#include <utility>

#include "clean_faces.h"
#include "dense_grid.h"
#include "mspskel/base/error.h"
#include "mspskel/mesh/detail/triangle_queries.h"
#include "point_tree.h"
#include "tetrahedron_cutter.h"
#include "weld_points.h"
#include "whole_pieces.h"

namespace mspskel {
namespace {

using detail::DenseGrid;
using detail::FaceSet;

// In cells: nodes of a wall that is this thick on both sides hang together in the tetrahedra of the grid.
constexpr double kWall = 0.87;
// Shares of the extent. A soup tells its scale on a grid of twice the finest cells, which is enough to count;
// its walls are as thick there as on the finest.
constexpr double kLargestGap = 0.1, kFinestToldCell = 0.00625, kFinestCell = 0.004, kCoarsestCell = 0.01;
constexpr double kTellingCell = 2 * kFinestToldCell;
constexpr int kScales = 4;  // each gap is twice the one before

struct Distances {
  std::vector<float> value;   // in cells; infinite beyond the limit
  std::vector<Index> source;  // what is nearest
};

// Every node gets the nearest of the sources that reach it over neighbours: exact beside a source, and within
// a small part of a cell elsewhere. distance(node, source), in cells.
template <class Distance>
void spread(const DenseGrid& grid, double limit, Distance distance, Distances& distances) {
  using Entry = std::pair<float, Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
  for (Index n = 0; n < grid.count(); ++n)
    if (distances.source[n] != kNone) front.emplace(distances.value[n], n);
  while (!front.empty()) {
    const auto [value, node] = front.top();
    front.pop();
    if (value > distances.value[node]) continue;
    const Index source = distances.source[node];
    grid.each_neighbour(node, [&](Index next) {
      if (distances.source[next] == source) return;
      const auto there = static_cast<float>(distance(next, source));
      if (!(there < distances.value[next]) || there > limit) return;
      distances.value[next] = there;
      distances.source[next] = source;
      front.emplace(there, next);
    });
  }
}

// What is wrapped: the faces, and polygons that are pressed to lines, which still join what lies at their
// ends: they are triangles of two corners.
struct Walls {
  explicit Walls(const PolygonSoup& all) : soup(all) {
    Index degenerate = 0;
    const std::vector<Index> point_of = detail::weld_equal_points(soup.points);
    faces = detail::clean_faces(soup, point_of, degenerate);
    if (faces.count() == 0) throw MeshError("the mesh has no face with an area: there is nothing to wrap");
    if (degenerate > 0) add_lines(point_of);
    low = high = soup.points[faces.corners[0]];
    for (const Index v : faces.corners) {
      low = low.cwiseMin(soup.points[v]);
      high = high.cwiseMax(soup.points[v]);
    }
    extent = (high - low).norm();
    if (!(extent > 0 && extent < std::numeric_limits<double>::infinity()))
      throw MeshError("the mesh has no extent that can be wrapped");
  }

  detail::Triangle triangle(Index f) const {
    const auto corner = [&](Index k) { return soup.points[faces.corners[3 * f + k]]; };
    return {corner(0), corner(1), corner(2)};
  }

  const PolygonSoup& soup;
  FaceSet faces;
  Vector3 low, high;
  double extent = 0;

 private:
  void add_lines(const std::vector<Index>& point_of) {
    std::vector<char> cleaned(soup.polygon_count(), 0);
    for (const Index f : faces.polygon) cleaned[f] = 1;
    const auto known = [&](Index v) {
      return v >= 0 && v < static_cast<Index>(soup.points.size()) && soup.points[v].allFinite();
    };
    for (Index f = 0; f < static_cast<Index>(cleaned.size()); ++f)
      for (Index i = soup.begin[f]; !cleaned[f] && i + 1 < soup.begin[f + 1]; ++i) {
        const Index from = soup.corners[i], to = soup.corners[i + 1];
        if (known(from) && known(to) && point_of[from] != point_of[to])
          faces.add(point_of[from], point_of[to], point_of[to], f);
      }
  }
};

// Distances from the walls on a grid, and what balls of up to a given radius reach from outside.
class Flood {
 public:
  // Lengths in model units.
  Flood(const Walls& walls, double cell, double wall, double largest_radius)
      : shape_(walls), wall_(wall / cell), largest_ball_(largest_radius / cell) {
    const Vector3 room = Vector3::Constant(cell * 3 + wall + largest_radius);
    // Not a whole number of cells from the box, so that plane walls do not fall on nodes.
    grid_ = DenseGrid(walls.low - room - Vector3(0.37, 0.53, 0.71) * cell, walls.high + room, cell);
    measure_faces();
  }

  // Where the ball's centre gets to from outside, and how far from there all else is.
  void run(double radius) {
    ball_ = radius / grid_.side();
    flood();
  }
  // Volumes in cells: of the walls, and of what the last ball does not reach.
  double wall_cells() const {
    return static_cast<double>(
        std::count_if(walls_.value.begin(), walls_.value.end(), [&](float d) { return d < wall_; }));
  }
  double unreached_cells() const {
    return static_cast<double>(
        std::count_if(reach_.value.begin(), reach_.value.end(), [&](float d) { return d > ball_; }));
  }
  const DenseGrid& grid() const { return grid_; }

  // What TetrahedronCutter asks for.
  double value(Index node) const { return ball_ - std::min<double>(reach_.value[node], ball_ + 1); }
  Vector3 place(Index node) const { return grid_.place(node); }

 private:
  void measure_faces() {
    const auto count = static_cast<std::size_t>(grid_.count());
    walls_.value.assign(count, std::numeric_limits<float>::infinity());
    walls_.source.assign(count, kNone);
    for (Index f = 0; f < shape_.faces.count(); ++f) {
      const detail::Triangle t = shape_.triangle(f);
      const Vector3 low = t.a.cwiseMin(t.b).cwiseMin(t.c), high = t.a.cwiseMax(t.b).cwiseMax(t.c);
      std::array<Index, 3> from{}, to{};
      for (int k = 0; k < 3; ++k) {
        from[k] = grid_.below(low[k], k);
        to[k] = grid_.below(high[k], k) + 1;
      }
      mark_near(t, f, from, to);
    }
    spread(
        grid_, wall_ + largest_ball_ + 2, [&](Index n, Index f) { return distance_to_face(n, f); }, walls_);
  }
  double distance_to_face(Index node, Index f) const {
    const Vector3 p = grid_.place(node);
    return (closest_on_triangle(p, shape_.triangle(f)) - p).norm() / grid_.side();
  }
  // The nodes of a range within a cell's diagonal of the face, by halves as long as the face is near.
  void mark_near(const detail::Triangle& t, Index f, const std::array<Index, 3>& from,
                 const std::array<Index, 3>& to) {
    const Vector3 low = grid_.place(grid_.node(from[0], from[1], from[2])),
                  high = grid_.place(grid_.node(to[0], to[1], to[2])), middle = (low + high) / 2;
    const double distance = (closest_on_triangle(middle, t) - middle).norm();
    if (distance > (high - low).norm() / 2 + 1.74 * grid_.side()) return;
    int longest = 0;
    for (int k = 1; k < 3; ++k)
      if (to[k] - from[k] > to[longest] - from[longest]) longest = k;
    if (to[longest] == from[longest]) {
      const Index node = grid_.node(from[0], from[1], from[2]);
      const auto there = static_cast<float>(distance / grid_.side());
      if (!(there < walls_.value[node])) return;
      walls_.value[node] = there;
      walls_.source[node] = f;
      return;
    }
    std::array<Index, 3> below = to, above = from;
    below[longest] = (from[longest] + to[longest]) / 2;
    above[longest] = below[longest] + 1;
    mark_near(t, f, from, below);
    mark_near(t, f, above, to);
  }

  void flood() {
    const auto fits = [&](Index n) { return walls_.value[n] >= wall_ + ball_; };
    std::vector<char> reached(walls_.value.size(), 0);
    std::vector<Index> waiting{0};
    reached[0] = 1;
    while (!waiting.empty()) {
      const Index node = waiting.back();
      waiting.pop_back();
      grid_.each_neighbour(node, [&](Index next) {
        if (reached[next] || !fits(next)) return;
        reached[next] = 1;
        waiting.push_back(next);
      });
    }
    reach_.value.assign(walls_.value.size(), std::numeric_limits<float>::infinity());
    reach_.source.assign(walls_.value.size(), kNone);
    for (Index n = 0; n < grid_.count(); ++n) {
      if (!reached[n]) continue;
      reach_.value[n] = static_cast<float>(-surplus(n));
      bool at_front = false;
      grid_.each_neighbour(n, [&](Index next) { at_front = at_front || !reached[next]; });
      if (at_front) reach_.source[n] = n;
    }
    spread(
        grid_, ball_ + 2,
        [&](Index n, Index source) {
          return (grid_.place(n) - grid_.place(source)).norm() / grid_.side() - surplus(source);
        },
        reach_);
  }
  // How much farther the walls are than the ball needs, up to the distance that is measured.
  double surplus(Index node) const {
    return std::min<double>(walls_.value[node], wall_ + ball_ + 2) - wall_ - ball_;
  }

  const Walls& shape_;
  DenseGrid grid_;
  double wall_, largest_ball_, ball_ = 0;  // half the thickness, radii; in cells
  Distances walls_, reach_;
};

struct Scale {
  double gap = kLargestGap, cell = kCoarsestCell;  // shares of the extent
  bool encloses = true;

  double wall() const { return kWall * cell; }
};

Scale scale_for(double gap, double finest_cell) {
  return {gap, std::clamp(gap / 4, finest_cell, kCoarsestCell)};
}

// The least scale that encloses half of what the largest does; walls alone tell nothing.
Scale told_scale(const Walls& walls) {
  constexpr double wall = kWall * kFinestToldCell;
  const auto scale = [](int i) { return scale_for(kLargestGap / (1 << (kScales - 1 - i)), kFinestToldCell); };
  // The ball keeps as far from the faces as that of the scale's own grid.
  const auto radius = [&](int i) { return (scale(i).gap / 2 + scale(i).wall() - wall) * walls.extent; };
  Flood flood(walls, kTellingCell * walls.extent, wall * walls.extent, radius(kScales - 1));
  const auto enclosed = [&](int i) {
    flood.run(radius(i));
    return flood.unreached_cells() - flood.wall_cells();
  };
  const double most = enclosed(kScales - 1);
  int least = 0;
  if (most > flood.wall_cells())
    while (least + 1 < kScales && enclosed(least) < most / 2) ++least;
  Scale chosen = scale(least);
  chosen.encloses = most > flood.wall_cells();
  return chosen;
}

PolygonSoup surface_of(const Flood& flood) {
  const DenseGrid& grid = flood.grid();
  detail::TetrahedronCutter cutter(flood, static_cast<std::uint64_t>(grid.count()));
  for (Index z = 0; z + 1 < grid.size(2); ++z)
    for (Index y = 0; y + 1 < grid.size(1); ++y)
      for (Index x = 0; x + 1 < grid.size(0); ++x) {
        std::array<Index, 8> corner{};
        for (int k = 0; k < 8; ++k) corner[k] = grid.node(x + (k & 1), y + (k >> 1 & 1), z + (k >> 2 & 1));
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

std::vector<Index> nearest_vertices(const PolygonSoup& soup, const WrappedSoup& wrapped) {
  std::vector<char> used(soup.points.size(), 0);
  for (const Index v : soup.corners)
    if (v >= 0 && v < static_cast<Index>(used.size())) used[v] = soup.points[v].allFinite();
  std::vector<Index> all(wrapped.soup.points.size());
  for (std::size_t v = 0; v < all.size(); ++v) all[v] = static_cast<Index>(v);
  const detail::PointTree tree(wrapped.soup.points, all);
  std::vector<Index> vertex_of_point(soup.points.size(), kNone);
  for (std::size_t p = 0; p < used.size(); ++p)
    if (used[p]) vertex_of_point[p] = nearest(wrapped.soup, tree, soup.points[p], wrapped.cell);
  return vertex_of_point;
}

}  // namespace

void validate(const WrapOptions& options) {
  if (options.gap != 0 && !(options.gap >= 0.004 && options.gap <= 0.2))
    throw UsageError("gaps that wrapping closes must be from 0.004 to 0.2 of the extent, or 0");
}

WrappedSoup wrap_soup(const PolygonSoup& soup, const WrapOptions& options, const Execution& execution) {
  validate(options);
  const auto step = [&](double fraction) { report_progress(execution.progress, "wrapping", fraction); };
  step(0.0);
  const Walls walls(soup);
  const Scale scale = options.gap > 0 ? scale_for(options.gap, kFinestCell) : told_scale(walls);
  WrappedSoup wrapped;
  wrapped.encloses = scale.encloses;
  if (!scale.encloses && !options.thicken_walls) return wrapped;
  step(0.2);
  wrapped.cell = scale.cell * walls.extent;
  wrapped.gap = scale.gap * walls.extent;
  Flood flood(walls, wrapped.cell, kWall * wrapped.cell, wrapped.gap / 2);
  step(0.6);
  flood.run(wrapped.gap / 2);
  step(0.8);
  detail::WholePieces pieces = detail::without_crumbs(surface_of(flood));
  wrapped.small_components = pieces.crumbs;
  wrapped.solids = pieces.solids;
  wrapped.soup = std::move(pieces.soup);
  wrapped.vertex_of_point = nearest_vertices(soup, wrapped);
  return wrapped;
}

}  // namespace mspskel
