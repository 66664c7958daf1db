#include "mspskel/repair/mend_soup.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "../mesh/edge_table.h"
#include "boundary_loops.h"
#include "clean_faces.h"
#include "close_loop.h"
#include "closed_pieces.h"
#include "disjoint_sets.h"
#include "distinct_faces.h"
#include "find_openings.h"
#include "join_touching_pieces.h"
#include "mspskel/base/error.h"
#include "mspskel/base/watch.h"
#include "pair_faces.h"
#include "unit_of_length.h"
#include "weld_points.h"

namespace mspskel {
namespace {

using detail::FaceSet;
using detail::HalfedgeEnd;

class Mending {
 public:
  Mending(const PolygonSoup& soup, const MendOptions& options, const ProgressCallback& progress)
      : soup_(soup), options_(options), watch_(progress, "mending"), points_(soup.points) {}

  MendedSoup run() {
    watch_.ask(0.0);
    weld();
    watch_.ask(0.1);
    faces_ = detail::clean_faces(soup_, point_of_, counts().degenerate_faces);
    keep_distinct_faces();
    watch_.ask(0.2);
    stitch();
    watch_.ask(0.4);
    faces_ = detail::without_flaps(points_, faces_, counts());
    watch_.ask(0.5);
    twin_ = detail::pair_faces(points_, faces_, counts());
    wall_count_ = faces_.count();
    watch_.ask(0.6);
    close_loops();
    watch_.ask(0.8);
    join_pieces();
    watch_.ask(0.9);
    finish();
    return std::move(mended_);
  }

 private:
  MendCounts& counts() { return mended_.counts; }
  Index point_count() const { return static_cast<Index>(points_.size()); }

  void weld() {
    point_of_ = detail::weld_equal_points(points_);
    count_unused();
    if (options_.weld == 0) return;
    std::vector<Index> members;
    Vector3 centre = Vector3::Zero();
    for (Index p = 0; p < point_count(); ++p)
      if (used_[p] && point_of_[p] == p && points_[p].allFinite()) members.push_back(p);
    for (const Index p : members) centre += points_[p] / static_cast<double>(members.size());
    double extent = 0;
    for (const Index p : members) extent = std::max(extent, 2 * (points_[p] - centre).norm());
    counts().welded_points += detail::weld_near_points(
        points_, members, std::vector<double>(points_.size(), options_.weld * extent), point_of_);
  }

  void count_unused() {
    used_.assign(points_.size(), 0);
    for (const Index v : soup_.corners)
      if (v >= 0 && v < point_count()) used_[v] = 1;
    counts().isolated_points = static_cast<Index>(std::count(used_.begin(), used_.end(), 0));
    for (Index p = 0; p < point_count(); ++p) counts().welded_points += used_[p] && point_of_[p] != p;
    for (Index p = 0; p < point_count(); ++p)
      if (used_[p]) used_[point_of_[p]] = 1;
  }

  // Points on edges of one face that lie beside each other, as on the two sides of a seam.
  void stitch() {
    constexpr double kReach = 0.05;  // in lengths of the shortest boundary edge at the point
    std::vector<double> reach(points_.size(), std::numeric_limits<double>::infinity());
    std::vector<Index> members;
    detail::EdgeTable(point_count(), faces_.corners)
        .each_edge([&](Index a, Index b, const HalfedgeEnd* first, const HalfedgeEnd* last) {
          if (last - first != 1) return;
          const double length = kReach * (points_[a] - points_[b]).norm();
          for (const Index p : {a, b}) {
            if (reach[p] == std::numeric_limits<double>::infinity()) members.push_back(p);
            reach[p] = std::min(reach[p], length);
          }
        });
    counts().stitched_points = detail::weld_near_points(points_, members, reach, point_of_);
    counts().welded_points += counts().stitched_points;
    if (counts().stitched_points == 0) return;
    watch_.ask(0.3);
    Index degenerate = 0;
    faces_ = detail::clean_faces(soup_, point_of_, degenerate);
    counts().degenerate_faces = degenerate;
    counts().repeated_faces = counts().two_sided_faces = 0;
    keep_distinct_faces();
  }

  void keep_distinct_faces() {
    detail::DistinctFaces distinct = detail::distinct_faces(faces_, point_count(), counts());
    faces_ = std::move(distinct.faces);
    cancelled_ = std::move(distinct.cancelled);
  }

  void close_loops() {
    Index stitched = 0;
    const std::vector<std::vector<Index>> loops =
        detail::boundary_loops(faces_, twin_, point_count(), stitched);
    if (options_.open == OpenEnds::kFail && !loops.empty())
      refuse("the surface has " + std::to_string(loops.size()) + (loops.size() == 1 ? " hole" : " holes") +
             "; close what is open, or let it be closed with --open ends or --open cap");
    std::vector<char> visited(faces_.count(), 0);
    watch_.ask(0.7);
    for (const std::vector<Index>& loop : loops) {
      for (std::size_t i = 0; i < loop.size(); ++i) watch_.step();
      close(loop, visited);
    }
    counts().holes = static_cast<Index>(loops.size());
    counts().hole_faces = faces_.count() - wall_count_;
  }

  // The hole's faces run against the half-edges of the loop: from corner i of the hole to the next one runs
  // the opposite of half-edge size - 1 - i of the loop.
  void close(const std::vector<Index>& loop, std::vector<char>& visited) {
    std::vector<Index> corners;
    std::vector<Vector3> rim;
    for (auto h = loop.rbegin(); h != loop.rend(); ++h) {
      corners.push_back(faces_.target(*h));
      rim.push_back(points_[corners.back()]);
    }
    std::optional<detail::TubeEnd> end;
    if (options_.open == OpenEnds::kEnds && rim.size() > 3)
      end = detail::tube_end(points_, faces_, twin_, loop, rim, visited);
    if (!end) return attach(loop, corners, detail::least_area_triangles(rim));
    const detail::LoopShape& shape = end->shape;
    corners.push_back(point_count());
    points_.push_back(shape.centre);
    mended_.openings.push_back(
        {shape.centre, shape.area.normalized(), detail::loop_radius(shape), corners.back()});
    attach(loop, corners, end->closing);
  }

  void attach(const std::vector<Index>& loop, const std::vector<Index>& corners,
              const detail::LoopClosing& closing) {
    const auto size = static_cast<Index>(loop.size());
    const Index first = static_cast<Index>(faces_.corners.size());
    std::vector<Index> places;  // of the corners of the added faces
    for (const auto& [a, b, c] : closing.triangles) {
      faces_.add(corners[a], corners[b], corners[c], kNone);
      places.insert(places.end(), {a, b, c});
    }
    twin_.resize(faces_.corners.size(), kNone);
    detail::EdgeTable(static_cast<Index>(corners.size()), places)
        .each_edge([&](Index a, Index b, const HalfedgeEnd* begin, const HalfedgeEnd* end) {
          const Index h = first + begin[0].halfedge;
          Index other;
          if (end - begin == 2)
            other = first + begin[1].halfedge;
          else
            other = loop[a == 0 && b == size - 1 ? 0 : size - 1 - a];
          twin_[h] = other;
          twin_[other] = h;
        });
  }

  void join_pieces() {
    const detail::JoinedPieces joined =
        detail::join_touching_pieces(cancelled_, options_.touching_part, points_, faces_, twin_);
    counts().joined_pieces = joined.solid;
    counts().thickened_faces = joined.flat_triangles;
  }

  void finish() {
    const std::vector<char> keep = detail::faces_to_keep(points_, faces_, twin_, options_, counts());
    if (std::find(keep.begin(), keep.end(), 1) == keep.end()) refuse_without_volume();
    watch_.ask(0.95);
    std::vector<Index> vertex_of_added;
    detail::make_vertices(points_, faces_, twin_, keep, soup_, point_of_, mended_, vertex_of_added);
    watch_.ask(1.0);
    place_openings(vertex_of_added);
  }

  // Openings of pieces that stay, named by their vertices, with normals that point out of the solid whichever
  // way the piece is turned.
  void place_openings(const std::vector<Index>& vertex_of_added) {
    if (mended_.openings.empty()) return;
    const PolygonSoup& soup = mended_.soup;
    detail::DisjointSets pieces(static_cast<Index>(soup.points.size()));
    for (std::size_t i = 0; i < soup.corners.size(); i += 3)
      for (const std::size_t k : {i + 1, i + 2}) pieces.unite(soup.corners[i], soup.corners[k]);
    std::vector<double> volume(soup.points.size(), 0.0);
    for (std::size_t i = 0; i < soup.corners.size(); i += 3) {
      const Index piece = pieces.root(soup.corners[i]);
      const auto at = [&](std::size_t k) {
        return Vector3(soup.points[soup.corners[k]] - soup.points[piece]);
      };
      volume[piece] += at(i).dot(at(i + 1).cross(at(i + 2)));
    }
    std::vector<Opening> openings;
    for (Opening o : mended_.openings) {
      o.vertex = vertex_of_added[o.vertex - soup_.points.size()];
      if (o.vertex == kNone) continue;
      if (volume[pieces.root(o.vertex)] < 0) o.normal = -o.normal;
      openings.push_back(o);
    }
    mended_.openings = openings;
  }

  [[noreturn]] void refuse(const std::string& reason) const { throw MendError(reason, mended_.counts); }
  [[noreturn]] void refuse_without_volume() const {
    if (wall_count_ == 0)
      refuse("the mesh has no face with an area: points and lines have no skeleton; triangulate them");
    refuse("the mesh encloses no volume: its " + std::to_string(wall_count_) +
           (wall_count_ == 1 ? " triangle is" : " triangles are") +
           " flat or an open sheet; give it a thickness, close it to a solid, or wrap it with --wrap 0.02");
  }

  const PolygonSoup& soup_;
  const MendOptions& options_;
  detail::Watch watch_;
  std::vector<Vector3> points_;  // those of the soup, then centres of caps, then of what gets a thickness
  std::vector<Index> point_of_;
  std::vector<char> used_;
  FaceSet faces_, cancelled_;
  std::vector<Index> twin_;
  Index wall_count_ = 0;
  MendedSoup mended_;
};

// What the steps after it take for granted.
void check_ranges(const PolygonSoup& soup) {
  constexpr std::size_t kMost = 700'000'000;
  if (soup.points.size() > kMost || soup.corners.size() > kMost) throw MeshError("the mesh is too large");
  if (soup.begin.empty() || soup.begin.front() != 0 ||
      soup.begin.back() != static_cast<Index>(soup.corners.size()) ||
      !std::is_sorted(soup.begin.begin(), soup.begin.end()))
    throw MeshError("the polygons' ranges do not cover their corners");
}

}  // namespace

void validate(const MendOptions& options) {
  if (!(options.weld >= 0 && options.weld <= 0.01))
    throw UsageError("weld must be from 0 to 0.01 of the extent");
  if (!(options.smallest_component >= 0 && options.smallest_component <= 1))
    throw UsageError("smallest component must be from 0 to 1 of the largest");
  if (!(options.touching_part >= 0 && options.touching_part <= 1))
    throw UsageError("a touching part must be from 0 to 1 of what it touches");
}

MendedSoup mend_soup(const PolygonSoup& soup, const MendOptions& options, const ProgressCallback& progress) {
  validate(options);
  check_ranges(soup);
  const int exponent = detail::exponent_of_unit(soup);
  if (exponent == 0) return Mending(soup, options, progress).run();
  PolygonSoup near_one = soup;
  detail::scale_points(near_one, -exponent);
  MendedSoup mended = Mending(near_one, options, progress).run();
  bool survives = detail::survives_scaling(mended.soup, exponent);
  for (Opening& opening : mended.openings) {
    for (double& x : opening.centre) x = std::scalbn(x, exponent);
    opening.radius = std::scalbn(opening.radius, exponent);
    survives = survives && opening.centre.allFinite() && std::isfinite(opening.radius);
  }
  if (!survives) throw MendError(detail::refusal_to_scale(exponent, "mended"), mended.counts);
  // Tiny coordinates beside huge ones lose digits on the way to a unit near one: points that stayed in their
  // place get their own back.
  const std::vector<Vector3> scaled = mended.soup.points;
  detail::scale_points(mended.soup, exponent);
  for (std::size_t p = 0; p < soup.points.size(); ++p)
    if (const Index v = mended.vertex_of_point[p]; v != kNone && scaled[v] == near_one.points[p])
      mended.soup.points[v] = soup.points[p];
  return mended;
}

}  // namespace mspskel
