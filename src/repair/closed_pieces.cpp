#include "closed_pieces.h"

#include <algorithm>
#include <cmath>

#include "../mesh/edge_table.h"
#include "disjoint_sets.h"
#include "draw_apart.h"
#include "pieces.h"

namespace mspskel::detail {
namespace {

// Gives each fan of faces round a point a vertex.
class Vertices {
 public:
  Vertices(FaceSet& faces, const std::vector<Index>& twin, Index point_count)
      : faces_(faces), twin_(twin), first_of_(point_count, kNone) {}

  // Corners become vertices.
  void assign() {
    DisjointSets fans(static_cast<Index>(faces_.corners.size()));
    for (Index h = 0; h < static_cast<Index>(twin_.size()); ++h) fans.unite(h, FaceSet::next(twin_[h]));
    std::vector<Index> fan(faces_.corners.size());
    for (std::size_t h = 0; h < fan.size(); ++h) fan[h] = fans.root(static_cast<Index>(h));
    // Roots are first members, so they come in the order of the faces.
    std::vector<Index> first(first_of_.size(), kNone), vertex(fan.size(), kNone), further;
    for (Index h = 0; h < static_cast<Index>(fan.size()); ++h) {
      if (fan[h] != h) continue;
      Index& f = first[faces_.corners[h]];
      if (f == kNone)
        f = h;
      else
        further.push_back(h);
    }
    for (Index p = 0; p < static_cast<Index>(first.size()); ++p) {
      if (first[p] == kNone) continue;
      first_of_[p] = vertex[first[p]] = static_cast<Index>(point_.size());
      point_.push_back(p);
    }
    split_ = static_cast<Index>(further.size());
    for (const Index h : further) {
      vertex[h] = static_cast<Index>(point_.size());
      point_.push_back(faces_.corners[h]);
    }
    for (std::size_t h = 0; h < fan.size(); ++h) faces_.corners[h] = vertex[fan[h]];
  }

  const std::vector<Index>& points() const { return point_; }
  Index first_of(Index point) const { return first_of_[point]; }
  // Those whose point has others too.
  std::vector<Index> doubled() const {
    std::vector<char> several(first_of_.size(), 0);
    for (std::size_t v = point_.size() - split_; v < point_.size(); ++v) several[point_[v]] = 1;
    std::vector<Index> found;
    for (std::size_t v = 0; v < point_.size(); ++v)
      if (several[point_[v]]) found.push_back(static_cast<Index>(v));
    return found;
  }
  Index split() const { return split_; }

 private:
  FaceSet& faces_;
  const std::vector<Index>& twin_;
  std::vector<Index> first_of_;
  std::vector<Index> point_;
  Index split_ = 0;
};

//        c                   c
//      /   \               / | \            The faces on both sides of a-b are cut in two from a vertex m in
//     a --- b    becomes  a--m--b           the middle.
//      \   /               \ | /
//        d                   d
void split_edge(FaceSet& faces, std::vector<Index>& twin, Index h, Index m) {
  const auto cut = [&](Index g) {  // the half-edge g, a-b, becomes a-m; returns the one that runs m-b
    const Index b = faces.target(g), c = faces.corners[FaceSet::prev(g)];
    const Index across = FaceSet::next(g), outer = twin[across];
    const auto added = static_cast<Index>(faces.corners.size());
    faces.add(m, b, c, faces.polygon[g / 3]);
    twin.insert(twin.end(), {kNone, outer, across});
    twin[outer] = added + 1;
    twin[across] = added + 2;
    faces.corners[across] = m;
    return added;
  };
  const Index g = twin[h];
  const Index after_h = cut(h), after_g = cut(g);
  twin[h] = after_g;
  twin[after_g] = h;
  twin[g] = after_h;
  twin[after_h] = g;
}

// Whether the faces on both sides of a half-edge face each other.
bool is_concave(const FaceSet& faces, const std::vector<Index>& twin, Index h,
                const std::vector<Vector3>& positions) {
  const Index apex = faces.corners[FaceSet::prev(twin[h])];
  return area_vector(positions, faces, h / 3).dot(positions[apex] - positions[faces.origin(h)]) > 0;
}

struct SplitEdges {
  std::vector<Index> convex, concave;  // the vertices in their middles
};

// Splits all but one of the edges that join the same two vertices: if it can be one that is not concave,
// since the middles of concave ones can move away from it into the void, so that the solid is wider than a
// line there.
SplitEdges split_double_edges(FaceSet& faces, std::vector<Index>& twin, std::vector<Vector3>& positions) {
  SplitEdges added;
  for (bool again = true; again;) {
    again = false;
    std::vector<Index> split, edges;
    EdgeTable(static_cast<Index>(positions.size()), faces.corners)
        .each_edge([&](Index, Index, const HalfedgeEnd* first, const HalfedgeEnd* last) {
          edges.clear();
          for (const HalfedgeEnd* e = first; e != last; ++e)
            if (e->halfedge < twin[e->halfedge]) edges.push_back(e->halfedge);
          if (edges.size() < 2) return;
          const auto stays = std::find_if(edges.begin(), edges.end(),
                                          [&](Index h) { return !is_concave(faces, twin, h, positions); });
          edges.erase(stays == edges.end() ? edges.begin() : stays);
          split.insert(split.end(), edges.begin(), edges.end());
        });
    std::vector<char> changed(faces.count(), 0);
    for (const Index h : split) {
      const Index across = twin[h] / 3;
      if (changed[h / 3] || across >= static_cast<Index>(changed.size()) || changed[across]) {
        again = true;
        continue;
      }
      changed[h / 3] = changed[across] = 1;
      const auto middle = static_cast<Index>(positions.size());
      (is_concave(faces, twin, h, positions) ? added.concave : added.convex).push_back(middle);
      positions.push_back((positions[faces.origin(h)] + positions[faces.target(h)]) / 2);
      split_edge(faces, twin, h, middle);
    }
  }
  return added;
}

// Vertices of a point, by the polygons that they belong to.
struct CornerUse {
  Index point, polygon, vertex;
  bool operator<(const CornerUse& o) const {
    return point != o.point       ? point < o.point
           : polygon != o.polygon ? polygon < o.polygon
                                  : vertex < o.vertex;
  }
};

}  // namespace

std::vector<char> faces_to_keep(const std::vector<Vector3>& points, const FaceSet& faces,
                                const std::vector<Index>& twin, const MendOptions& options,
                                MendCounts& counts) {
  const std::vector<Index> piece_of = pieces_of_faces(faces, twin);
  const std::vector<Piece> pieces = measure_pieces(points, faces, piece_of);
  double largest = 0;
  for (const Piece& piece : pieces)
    if (piece.faces > 0 && has_volume(piece)) largest = std::max(largest, piece.extent);
  std::vector<char> stays(pieces.size(), 0);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (pieces[i].faces == 0) continue;
    if (!has_volume(pieces[i])) {
      ++counts.flat_components;
    } else if (pieces[i].extent < options.smallest_component * largest) {
      ++counts.small_components;
      counts.small_faces += pieces[i].faces;
    } else {
      stays[i] = 1;
    }
  }
  double wall = 0, caps = 0, flat = 0, all = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (pieces[i].faces == 0) continue;
    all += pieces[i].wall;
    if (!has_volume(pieces[i])) flat += pieces[i].wall;
    if (!stays[i]) continue;
    wall += pieces[i].wall;
    caps += pieces[i].caps;
  }
  if (wall > 0) counts.hole_share = caps / (wall + caps);
  if (all > 0) counts.flat_share = flat / all;
  std::vector<char> keep(faces.count());
  for (Index f = 0; f < faces.count(); ++f) keep[f] = stays[piece_of[f]];
  return keep;
}

void make_vertices(const std::vector<Vector3>& points, const FaceSet& all, std::vector<Index> all_twin,
                   const std::vector<char>& keep, const PolygonSoup& input,
                   const std::vector<Index>& point_of, MendedSoup& mended,
                   std::vector<Index>& vertex_of_added) {
  // Only the kept faces, and their half-edges.
  FaceSet faces = kept_faces(all, keep);
  std::vector<Index> moved(all.count(), kNone), twin;
  for (Index f = 0, g = 0; f < all.count(); ++f)
    if (keep[f]) moved[f] = g++;
  for (Index h = 0; h < static_cast<Index>(all_twin.size()); ++h)
    if (keep[h / 3]) twin.push_back(3 * moved[all_twin[h] / 3] + all_twin[h] % 3);

  const std::vector<Index> point_at = faces.corners;
  Vertices vertices(faces, twin, static_cast<Index>(points.size()));
  vertices.assign();
  std::vector<CornerUse> uses;
  for (std::size_t h = 0; h < point_at.size(); ++h)
    uses.push_back({point_at[h], faces.polygon[h / 3], faces.corners[h]});
  std::sort(uses.begin(), uses.end());

  std::vector<Index> polygon_of(input.points.size(), kNone);
  for (Index f = static_cast<Index>(input.polygon_count()) - 1; f >= 0; --f)
    for (Index i = input.begin[f]; i < input.begin[f + 1]; ++i)
      if (input.corners[i] >= 0 && input.corners[i] < static_cast<Index>(polygon_of.size()))
        polygon_of[input.corners[i]] = f;
  mended.vertex_of_point.resize(input.points.size());
  for (std::size_t v = 0; v < input.points.size(); ++v) {
    const Index p = point_of[v];
    const auto use = std::lower_bound(uses.begin(), uses.end(), CornerUse{p, polygon_of[v], 0});
    const bool own = use != uses.end() && use->point == p && use->polygon == polygon_of[v];
    mended.vertex_of_point[v] = polygon_of[v] == kNone ? kNone : own ? use->vertex : vertices.first_of(p);
  }
  for (std::size_t p = input.points.size(); p < points.size(); ++p)
    vertex_of_added.push_back(vertices.first_of(static_cast<Index>(p)));

  for (const Index p : vertices.points()) mended.soup.points.push_back(points[p]);
  mended.counts.split_vertices = vertices.split();
  const SplitEdges split = split_double_edges(faces, twin, mended.soup.points);
  mended.counts.split_edges = static_cast<Index>(split.convex.size() + split.concave.size());
  constexpr double kBridge = 0.02;
  nudge(faces, split.concave, kBridge, Way::kIntoVoid, mended.soup.points);
  std::vector<Index> doubled = vertices.doubled();
  doubled.insert(doubled.end(), split.convex.begin(), split.convex.end());
  if (!doubled.empty()) draw_apart(faces, doubled, mended.soup.points);
  for (Index f = 0; f < faces.count(); ++f)
    mended.soup.add_triangle(faces.corners[3 * f], faces.corners[3 * f + 1], faces.corners[3 * f + 2]);
}

}  // namespace mspskel::detail
