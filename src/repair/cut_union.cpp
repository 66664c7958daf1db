#include "cut_union.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <unordered_map>
#include <utility>
#include <vector>

#include "disjoint_sets.h"
#include "face_cutter.h"
#include "face_set.h"
#include "mspskel/base/watch.h"

namespace mspskel::detail {
namespace {

using Pair = std::pair<Index, Index>;

// Where an edge, named by the lesser of its half-edges, passes through a face of another shell.
struct Passage {
  Index edge, face, point;
  double share;  // of the edge, from the lesser of its vertices
};

// What two faces have in common: from point to point, and the points where third faces meet it.
struct Segment {
  std::array<Index, 2> face, end;
  std::vector<Index> between{};
};

struct CutPiece {
  std::array<Index, 3> corner;
  Index face;
  std::array<char, 3> cut;  // sides along which another shell passes
};

class CutUnion {
 public:
  CutUnion(const ShellGroup& group, unsigned seed) : group_(group), surface_(group.surface()) {
    std::mt19937 random(seed);
    const auto share = [&] { return 2.0 * (static_cast<double>(random()) / 4294967296.0) - 1; };
    member_.assign(surface_.position.size(), kNone);
    point_ = surface_.position;
    for (std::size_t m = 0; m < group.size(); ++m) {
      const Vector3 shift = kShellShift * Vector3(share(), share(), share());
      shift_.push_back(shift);
      for (const Index v : group.shell(m).vertices) {
        member_[v] = static_cast<Index>(m);
        point_[v] += shift;
      }
    }
  }

  std::optional<CutShells> run(const Execution& execution) {
    Watch watch(execution.progress, "union of shells");
    find_passages(execution);
    watch.ask(0.3);
    if (!find_segments() || !find_triples(watch)) return std::nullopt;
    watch.ask(0.5);
    if (!cut_faces(watch)) return std::nullopt;
    watch.ask(0.7);
    return outer_pieces(execution);
  }

 private:
  Index member_of_face(Index f) const { return member_[surface_.origin[3 * f]]; }
  Index corner(Index f, int k) const { return surface_.origin[3 * f + k]; }
  Index edge_of(Index h) const { return std::min(h, surface_.twin[h]); }
  Pair ends(Index h) const {
    const Index a = surface_.origin[h], b = surface_.target(h);
    return {std::min(a, b), std::max(a, b)};
  }

  // Six times the volume of the tetrahedron of two edges, the same whichever edge is named first.
  double volume(Pair one, Pair other) const {
    if (other < one) std::swap(one, other);
    const Vector3& p = point_[one.first];
    return (point_[one.second] - p).dot((point_[other.first] - p).cross(point_[other.second] - p));
  }
  // The side of the face's plane that a point is on.
  double height(Index f, Index v) const {
    const Vector3& a = point_[corner(f, 0)];
    return (point_[corner(f, 1)] - a).cross(point_[corner(f, 2)] - a).dot(point_[v] - a);
  }

  void find_passages(const Execution& execution) {
    const std::vector<Index>& faces = group_.faces();
    constexpr Index kBlock = 256;
    const Index blocks = (static_cast<Index>(faces.size()) + kBlock - 1) / kBlock;
    std::vector<std::vector<Passage>> found(static_cast<std::size_t>(blocks));
    parallel_for(
        blocks, "union of shells", execution, [] { return 0; },
        [&](Index b, int&) {
          const Index end = std::min<Index>(static_cast<Index>(faces.size()), (b + 1) * kBlock);
          for (Index i = b * kBlock; i < end; ++i)
            for (Index h = 3 * faces[i]; h < 3 * faces[i] + 3; ++h)
              if (edge_of(h) == h) pass_through(h, found[b]);
        },
        1);
    for (std::vector<Passage>& some : found)
      for (Passage& p : some) {
        const auto [a, b] = ends(p.edge);
        p.point = static_cast<Index>(point_.size());
        point_.push_back(point_[a] + p.share * (point_[b] - point_[a]));
        passages_.push_back(p);
      }
  }

  void pass_through(Index h, std::vector<Passage>& found) const {
    const Pair edge = ends(h);
    const Vector3 &p = surface_.position[edge.first], &q = surface_.position[edge.second];
    const Vector3 room = Vector3::Constant(4 * kShellShift);
    const Index own = member_[edge.first];
    group_.walls().for_each_in_box(p.cwiseMin(q) - room, p.cwiseMax(q) + room, [&](Index g) {
      if (member_of_face(g) == own) return true;
      const double at_p = height(g, edge.first), at_q = height(g, edge.second);
      if ((at_p > 0) == (at_q > 0)) return true;
      int ahead = 0;
      for (Index s = 3 * g; s < 3 * g + 3; ++s) {
        const Pair side = ends(s);
        ahead += (volume(edge, side) > 0) == (side.first == surface_.origin[s]);
      }
      if (ahead == 0 || ahead == 3) found.push_back({h, g, kNone, at_p / (at_p - at_q)});
      return true;
    });
  }

  bool find_segments() {
    struct End {
      Pair faces;
      Index point;
    };
    std::vector<End> ends;
    for (const Passage& p : passages_)
      for (const Index f : {p.edge / 3, surface_.twin[p.edge] / 3})
        ends.push_back({{std::min(f, p.face), std::max(f, p.face)}, p.point});
    std::sort(ends.begin(), ends.end(), [](const End& a, const End& b) {
      return a.faces != b.faces ? a.faces < b.faces : a.point < b.point;
    });
    for (std::size_t i = 0; i < ends.size(); i += 2) {
      if (i + 1 == ends.size() || ends[i].faces != ends[i + 1].faces) return false;
      if (i + 2 < ends.size() && ends[i + 2].faces == ends[i].faces) return false;
      segments_.push_back({{ends[i].faces.first, ends[i].faces.second}, {ends[i].point, ends[i + 1].point}});
    }
    for (std::size_t s = 0; s < segments_.size(); ++s)
      for (const Index f : segments_[s].face) on_face_[f].push_back(static_cast<Index>(s));
    return true;
  }

  Index segment_between(Index f, Index g) const {
    const std::array<Index, 2> wanted{std::min(f, g), std::max(f, g)};
    const auto found =
        std::lower_bound(segments_.begin(), segments_.end(), wanted,
                         [](const Segment& s, const std::array<Index, 2>& w) { return s.face < w; });
    return found != segments_.end() && found->face == wanted ? static_cast<Index>(found - segments_.begin())
                                                             : kNone;
  }

  // The face's plane, seen from outside the shell, along the axis that it faces most.
  struct Plane {
    int u, v;
    FaceCutter::Point at(const Vector3& p) const { return {p[u], p[v]}; }
  };
  Plane plane_of(Index f) const {
    const Vector3& a = point_[corner(f, 0)];
    const Vector3 normal = (point_[corner(f, 1)] - a).cross(point_[corner(f, 2)] - a);
    int axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    return normal[axis] > 0 ? Plane{u, v} : Plane{v, u};
  }

  // Points of three faces, found in the first of them.
  bool find_triples(Watch& watch) {
    constexpr double kMostPairs = 3e8;
    double pairs = 0;
    for (const auto& [f, list] : on_face_)
      pairs += static_cast<double>(list.size()) * static_cast<double>(list.size());
    if (pairs > kMostPairs) return false;
    std::vector<Index> faces;
    for (const auto& [f, list] : on_face_) faces.push_back(f);
    std::sort(faces.begin(), faces.end());
    cut_faces_ = faces;
    for (const Index f : faces)
      if (!find_triples_on(f, watch)) return false;
    for (Segment& s : segments_) {
      const Vector3 from = point_[s.end[0]], way = point_[s.end[1]] - from;
      std::sort(s.between.begin(), s.between.end(), [&](Index a, Index b) {
        const double at_a = way.dot(point_[a] - from), at_b = way.dot(point_[b] - from);
        return at_a != at_b ? at_a < at_b : a < b;
      });
    }
    return true;
  }
  bool find_triples_on(Index f, Watch& watch) {
    struct Line {
      Index segment, other;
      FaceCutter::Point a, b, low, high;
    };
    const Plane plane = plane_of(f);
    std::vector<Line> lines;
    for (const Index s : on_face_[f]) {
      const Index other = segments_[s].face[0] == f ? segments_[s].face[1] : segments_[s].face[0];
      if (other < f) continue;
      const FaceCutter::Point a = plane.at(point_[segments_[s].end[0]]),
                              b = plane.at(point_[segments_[s].end[1]]);
      lines.push_back({s,
                       other,
                       a,
                       b,
                       {std::min(a[0], b[0]), std::min(a[1], b[1])},
                       {std::max(a[0], b[0]), std::max(a[1], b[1])}});
    }
    for (std::size_t i = 0; i < lines.size(); ++i) {
      watch.step();
      for (std::size_t j = i + 1; j < lines.size(); ++j) {
        const Line &s = lines[i], &t = lines[j];
        if (s.high[0] < t.low[0] || t.high[0] < s.low[0] || s.high[1] < t.low[1] || t.high[1] < s.low[1])
          continue;
        if (member_of_face(s.other) == member_of_face(t.other)) continue;
        const double ta = FaceCutter::turn(s.a, s.b, t.a), tb = FaceCutter::turn(s.a, s.b, t.b);
        if ((ta > 0) == (tb > 0) ||
            (FaceCutter::turn(t.a, t.b, s.a) > 0) == (FaceCutter::turn(t.a, t.b, s.b) > 0))
          continue;
        const Index third = segment_between(s.other, t.other);
        if (third == kNone) return false;
        const Vector3 &from = point_[segments_[t.segment].end[0]], &to = point_[segments_[t.segment].end[1]];
        const auto point = static_cast<Index>(point_.size());
        const Vector3 place = from + ta / (ta - tb) * (to - from);
        point_.push_back(place);
        for (const Index k : {s.segment, t.segment, third}) segments_[k].between.push_back(point);
      }
    }
    return true;
  }

  bool cut_faces(Watch& watch) {
    std::unordered_map<Index, std::vector<std::pair<double, Index>>> on_edge;
    for (const Passage& p : passages_) on_edge[p.edge].push_back({p.share, p.point});
    for (auto& [edge, list] : on_edge) std::sort(list.begin(), list.end());
    std::vector<char> is_cut(static_cast<std::size_t>(surface_.face_count()), 0);
    for (const Index f : cut_faces_) is_cut[f] = 1;
    for (const Index f : group_.faces())
      if (!is_cut[f]) pieces_.push_back({{corner(f, 0), corner(f, 1), corner(f, 2)}, f, {0, 0, 0}});
    for (const Index f : cut_faces_)
      if (!cut_face(f, on_edge, watch)) return false;
    return true;
  }

  bool cut_face(Index f, const std::unordered_map<Index, std::vector<std::pair<double, Index>>>& on_edge,
                Watch& watch) {
    const Plane plane = plane_of(f);
    const Vector3 base = point_[corner(f, 0)];
    const auto flat = [&](Index v) { return plane.at(point_[v] - base); };
    FaceCutter cutter(flat(corner(f, 0)), flat(corner(f, 1)), flat(corner(f, 2)));
    std::vector<Index> name{corner(f, 0), corner(f, 1), corner(f, 2)};
    std::unordered_map<Index, Index> number;
    const auto add_name = [&](Index v) {
      number.emplace(v, static_cast<Index>(name.size()));
      name.push_back(v);
    };
    for (int k = 0; k < 3; ++k) {
      const Index h = 3 * f + k;
      const auto found = on_edge.find(edge_of(h));
      if (found == on_edge.end()) continue;
      std::vector<std::pair<double, Index>> list = found->second;
      if (surface_.origin[h] > surface_.target(h)) std::reverse(list.begin(), list.end());
      for (const auto& [share, v] : list) {
        cutter.add_on_side(k, flat(v));
        add_name(v);
      }
    }
    const auto add = [&](Index v) {
      if (number.count(v) > 0) return;
      watch.step();
      cutter.add_within(flat(v));
      add_name(v);
    };
    for (const Index s : on_face_[f]) {
      for (const Index v : segments_[s].end) add(v);
      for (const Index v : segments_[s].between) add(v);
    }
    for (const Index s : on_face_[f]) {
      watch.step();
      Index from = segments_[s].end[0];
      for (const Index v : segments_[s].between) {
        if (!cutter.keep(number[from], number[v])) return false;
        from = v;
      }
      if (!cutter.keep(number[from], number[segments_[s].end[1]])) return false;
    }
    for (const FaceCutter::Part& part : cutter.parts())
      pieces_.push_back({{name[part.corner[0]], name[part.corner[1]], name[part.corner[2]]}, f, part.kept});
    return true;
  }

  // Pieces that no curve divides lie in the same solids.
  std::optional<CutShells> outer_pieces(const Execution& execution) {
    const auto count = static_cast<Index>(pieces_.size());
    struct Side {
      Pair ends;
      Index piece;
      char cut;
    };
    std::vector<Side> sides;
    sides.reserve(3 * pieces_.size());
    for (Index i = 0; i < count; ++i)
      for (int k = 0; k < 3; ++k) {
        const Index a = pieces_[i].corner[k], b = pieces_[i].corner[(k + 1) % 3];
        sides.push_back({{std::min(a, b), std::max(a, b)}, i, pieces_[i].cut[k]});
      }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
      return a.ends != b.ends ? a.ends < b.ends : a.piece < b.piece;
    });
    report_progress(execution.progress, "union of shells", 0.8);
    DisjointSets patches(count);
    for (std::size_t i = 0; i + 1 < sides.size(); ++i)
      if (sides[i].ends == sides[i + 1].ends && !sides[i].cut && !sides[i + 1].cut)
        patches.unite(sides[i].piece, sides[i + 1].piece);
    const auto doubled_area = [&](Index i) {
      const std::array<Index, 3>& c = pieces_[i].corner;
      return (point_[c[1]] - point_[c[0]]).cross(point_[c[2]] - point_[c[0]]).norm();
    };
    std::vector<Index> largest(pieces_.size(), kNone), roots;
    for (Index i = 0; i < count; ++i) {
      Index& best = largest[patches.root(i)];
      if (best == kNone) roots.push_back(patches.root(i));
      if (best == kNone || doubled_area(i) > doubled_area(best)) best = i;
    }
    std::vector<char> outside(pieces_.size(), 0);
    parallel_for(
        static_cast<Index>(roots.size()), "union of shells", execution, [] { return 0; },
        [&](Index r, int&) { outside[roots[r]] = is_outside(pieces_[largest[roots[r]]]); }, 64);
    CutShells cut;
    PolygonSoup& soup = cut.soup;
    std::vector<Index> vertex(point_.size(), kNone);
    for (Index i = 0; i < count; ++i) {
      if (!outside[patches.root(i)]) continue;
      std::array<Index, 3> c = pieces_[i].corner;
      const auto shell = static_cast<std::size_t>(member_of_face(pieces_[i].face));
      if (group_.shell(shell).inside_out) std::swap(c[1], c[2]);
      for (Index& v : c) {
        if (vertex[v] == kNone) {
          vertex[v] = static_cast<Index>(soup.points.size());
          soup.points.push_back(point_[v]);
        }
        v = vertex[v];
      }
      soup.add_triangle(c[0], c[1], c[2]);
      cut.shell.push_back(shell);
    }
    report_progress(execution.progress, "union of shells", 0.9);
    if (!is_manifold(soup)) return std::nullopt;
    cut.crossings = crossings();
    return cut;
  }

  // Pairs of shells.
  std::size_t crossings() const {
    std::vector<Pair> pairs;
    for (const Segment& s : segments_) {
      const Index a = member_of_face(s.face[0]), b = member_of_face(s.face[1]);
      pairs.emplace_back(std::min(a, b), std::max(a, b));
    }
    std::sort(pairs.begin(), pairs.end());
    return static_cast<std::size_t>(std::unique(pairs.begin(), pairs.end()) - pairs.begin());
  }

  bool is_outside(const CutPiece& piece) const {
    const Index own = member_of_face(piece.face);
    const Vector3 p = (point_[piece.corner[0]] + point_[piece.corner[1]] + point_[piece.corner[2]]) / 3;
    for (std::size_t m = 0; m < group_.size(); ++m)
      if (static_cast<Index>(m) != own && group_.is_in(m, p - shift_[m])) return false;
    return true;
  }

  // Whether each side has its opposite and each vertex one fan.
  static bool is_manifold(const PolygonSoup& soup) {
    const auto halfedges = static_cast<Index>(soup.corners.size());
    std::vector<std::array<Index, 3>> sides;
    const auto target = [&](Index h) { return soup.corners[FaceSet::next(h)]; };
    for (Index h = 0; h < halfedges; ++h) {
      const Index a = soup.corners[h], b = target(h);
      sides.push_back({std::min(a, b), std::max(a, b), h});
    }
    std::sort(sides.begin(), sides.end());
    if (sides.size() % 2 != 0) return false;
    std::vector<Index> twin(soup.corners.size());
    for (std::size_t i = 0; i < sides.size(); i += 2) {
      const auto &s = sides[i], &t = sides[i + 1];
      if (s[0] != t[0] || s[1] != t[1] || soup.corners[s[2]] == soup.corners[t[2]]) return false;
      if (i + 2 < sides.size() && sides[i + 2][0] == s[0] && sides[i + 2][1] == s[1]) return false;
      twin[s[2]] = t[2];
      twin[t[2]] = s[2];
    }
    std::vector<Index> degree(soup.points.size(), 0);
    for (const Index v : soup.corners) ++degree[v];
    std::vector<char> seen(soup.points.size(), 0);
    for (Index h = 0; h < halfedges; ++h) {
      const Index v = soup.corners[h];
      if (seen[v]) continue;
      seen[v] = 1;
      Index fan = 0, at = h;
      do {
        ++fan;
        at = twin[FaceSet::prev(at)];
      } while (at != h);
      if (fan != degree[v]) return false;
    }
    return true;
  }

  const ShellGroup& group_;
  const SurfaceSnapshot& surface_;
  std::vector<Index> member_;   // per vertex
  std::vector<Vector3> shift_;  // per member
  std::vector<Vector3> point_;  // the surface's, moved, then those of the curves
  std::vector<Passage> passages_;
  std::vector<Segment> segments_;                          // ascending by faces
  std::unordered_map<Index, std::vector<Index>> on_face_;  // segments
  std::vector<Index> cut_faces_;
  std::vector<CutPiece> pieces_;
};

}  // namespace

std::optional<CutShells> cut_union(const ShellGroup& group, const Execution& execution) {
  constexpr unsigned kTries = 3;
  for (unsigned seed = 1; seed <= kTries; ++seed)
    if (auto cut = CutUnion(group, seed).run(execution)) return cut;
  return std::nullopt;
}

}  // namespace mspskel::detail
