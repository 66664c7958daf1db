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
constexpr double kMostNodes = 1.6e7;
constexpr int kScales = 4;  // each twice the one before

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

class Wrapping {
 public:
  Wrapping(const PolygonSoup& soup, const WrapOptions& options, const Execution& execution)
      : soup_(soup), options_(options), execution_(execution) {
    Index degenerate = 0;
    const std::vector<Index> point_of = detail::weld_equal_points(soup.points);
    faces_ = detail::clean_faces(soup, point_of, degenerate);
    if (faces_.count() > 0 && degenerate > 0) add_lines(point_of);
    lay_grid();
  }

  WrappedSoup run() {
    step(0.0);
    measure_faces();
    step(0.4);
    choose_scale();
    step(0.8);
    detail::TetrahedronCutter cutter(*this, static_cast<std::uint64_t>(grid_.count()));
    cut(cutter);
    detail::WholePieces pieces = detail::without_crumbs(cutter.take());
    WrappedSoup wrapped;
    wrapped.small_components = pieces.crumbs;
    wrapped.solids = pieces.solids;
    wrapped.encloses = encloses_;
    wrapped.soup = std::move(pieces.soup);
    wrapped.cell = grid_.side();
    wrapped.gap = 2 * ball_ * grid_.side();
    map_points(wrapped);
    return wrapped;
  }

  // What TetrahedronCutter asks for.
  double value(Index node) const { return ball_ - std::min<double>(reach_.value[node], ball_ + 1); }
  Vector3 place(Index node) const { return grid_.place(node); }

 private:
  // Polygons that are pressed to lines still join what lies at their ends: as triangles of two corners.
  void add_lines(const std::vector<Index>& point_of) {
    std::vector<char> cleaned(soup_.polygon_count(), 0);
    for (const Index f : faces_.polygon) cleaned[f] = 1;
    const auto known = [&](Index v) {
      return v >= 0 && v < static_cast<Index>(soup_.points.size()) && soup_.points[v].allFinite();
    };
    for (Index f = 0; f < static_cast<Index>(cleaned.size()); ++f)
      for (Index i = soup_.begin[f]; !cleaned[f] && i + 1 < soup_.begin[f + 1]; ++i) {
        const Index from = soup_.corners[i], to = soup_.corners[i + 1];
        if (known(from) && known(to) && point_of[from] != point_of[to])
          faces_.add(point_of[from], point_of[to], point_of[to], f);
      }
  }

  void step(double fraction) const { report_progress(execution_.progress, "wrapping", fraction); }

  detail::Triangle triangle(Index f) const {
    const auto corner = [&](Index k) { return soup_.points[faces_.corners[3 * f + k]]; };
    return {corner(0), corner(1), corner(2)};
  }

  // Cells of a quarter of the gap, and of a sixteenth of the largest one where the soup is to tell.
  void lay_grid() {
    if (faces_.count() == 0) throw MeshError("the mesh has no face with an area: there is nothing to wrap");
    Vector3 low = soup_.points[faces_.corners[0]], high = low;
    for (const Index v : faces_.corners) {
      low = low.cwiseMin(soup_.points[v]);
      high = high.cwiseMax(soup_.points[v]);
    }
    const double extent = (high - low).norm();
    if (!(extent > 0 && extent < std::numeric_limits<double>::infinity()))
      throw MeshError("the mesh has no extent that can be wrapped");
    constexpr double kLargestGap = 0.1;
    const double gap = options_.gap > 0 ? options_.gap : kLargestGap;
    double cell = extent * (options_.gap > 0 ? std::clamp(gap / 4, 0.004, 0.01) : gap / 16);
    const auto room = [&](double side) { return Vector3::Constant(side * (kWall + 3) + gap * extent / 2); };
    const auto nodes = [&](double side) { return ((high - low + 2 * room(side)) / side).prod(); };
    while (nodes(cell) > kMostNodes) cell *= 1.1;
    // Not a whole number of cells from the box, so that plane walls do not fall on nodes.
    grid_ = DenseGrid(low - room(cell) - Vector3(0.37, 0.53, 0.71) * cell, high + room(cell), cell);
    largest_ball_ = gap * extent / 2 / cell;
  }

  void measure_faces() {
    const auto count = static_cast<std::size_t>(grid_.count());
    walls_.value.assign(count, std::numeric_limits<float>::infinity());
    walls_.source.assign(count, kNone);
    for (Index f = 0; f < faces_.count(); ++f) {
      const detail::Triangle t = triangle(f);
      const Vector3 low = t.a.cwiseMin(t.b).cwiseMin(t.c), high = t.a.cwiseMax(t.b).cwiseMax(t.c);
      std::array<Index, 3> from{}, to{};
      for (int k = 0; k < 3; ++k) {
        from[k] = grid_.below(low[k], k);
        to[k] = grid_.below(high[k], k) + 1;
      }
      mark_near(t, f, from, to);
    }
    spread(
        grid_, kWall + largest_ball_ + 2, [&](Index n, Index f) { return distance_to_face(n, f); }, walls_);
  }
  double distance_to_face(Index node, Index f) const {
    const Vector3 p = grid_.place(node);
    return (closest_on_triangle(p, triangle(f)) - p).norm() / grid_.side();
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

  // The least scale that encloses half of what the largest does; walls alone tell nothing.
  void choose_scale() {
    if (options_.gap > 0) {
      ball_ = largest_ball_;
      flood();
      return;
    }
    const auto walls =
        std::count_if(walls_.value.begin(), walls_.value.end(), [](float d) { return d < kWall; });
    std::array<double, kScales> enclosed{};
    for (int i = kScales - 1; i >= 0; --i) {
      ball_ = largest_ball_ / (1 << (kScales - 1 - i));
      flood();
      enclosed[i] = static_cast<double>(
          std::count_if(reach_.value.begin(), reach_.value.end(), [&](float d) { return d > ball_; }) -
          walls);
    }
    int chosen = 0;
    encloses_ = enclosed[kScales - 1] > static_cast<double>(walls);
    if (encloses_)
      while (enclosed[chosen] < enclosed[kScales - 1] / 2) ++chosen;
    if (chosen == 0) return;  // the last flood's
    ball_ = largest_ball_ / (1 << (kScales - 1 - chosen));
    flood();
  }

  // Where the ball's centre gets to from outside, and how far from there all else is.
  void flood() {
    const auto fits = [&](Index n) { return walls_.value[n] >= kWall + ball_; };
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
    return std::min<double>(walls_.value[node], kWall + ball_ + 2) - kWall - ball_;
  }

  void cut(detail::TetrahedronCutter<Wrapping>& cutter) const {
    for (Index z = 0; z + 1 < grid_.size(2); ++z)
      for (Index y = 0; y + 1 < grid_.size(1); ++y)
        for (Index x = 0; x + 1 < grid_.size(0); ++x) {
          std::array<Index, 8> corner{};
          for (int k = 0; k < 8; ++k) corner[k] = grid_.node(x + (k & 1), y + (k >> 1 & 1), z + (k >> 2 & 1));
          cutter.cut_cube(corner);
        }
  }

  void map_points(WrappedSoup& wrapped) const {
    std::vector<char> used(soup_.points.size(), 0);
    for (const Index v : soup_.corners)
      if (v >= 0 && v < static_cast<Index>(used.size())) used[v] = soup_.points[v].allFinite();
    std::vector<Index> all(wrapped.soup.points.size());
    for (std::size_t v = 0; v < all.size(); ++v) all[v] = static_cast<Index>(v);
    const detail::PointTree tree(wrapped.soup.points, all);
    wrapped.vertex_of_point.assign(soup_.points.size(), kNone);
    for (std::size_t p = 0; p < used.size(); ++p)
      if (used[p]) wrapped.vertex_of_point[p] = nearest(wrapped.soup, tree, soup_.points[p]);
  }
  Index nearest(const PolygonSoup& surface, const detail::PointTree& tree, const Vector3& p) const {
    Index best = kNone;
    double least = std::numeric_limits<double>::infinity();
    for (double within = 2 * grid_.side(); best == kNone; within *= 2)
      tree.each_within(p, within, [&](Index v) {
        const double d = (surface.points[v] - p).squaredNorm();
        if (d > least || (d == least && v > best)) return;
        least = d;
        best = v;
      });
    return best;
  }

  const PolygonSoup& soup_;
  const WrapOptions& options_;
  const Execution& execution_;
  FaceSet faces_;
  DenseGrid grid_;
  double largest_ball_ = 0, ball_ = 0;  // radius, in cells
  bool encloses_ = true;
  Distances walls_, reach_;
};

}  // namespace

void validate(const WrapOptions& options) {
  if (options.gap != 0 && !(options.gap >= 0.004 && options.gap <= 0.2))
    throw UsageError("gaps that wrapping closes must be from 0.004 to 0.2 of the extent, or 0");
}

WrappedSoup wrap_soup(const PolygonSoup& soup, const WrapOptions& options, const Execution& execution) {
  validate(options);
  return Wrapping(soup, options, execution).run();
}

}  // namespace mspskel
