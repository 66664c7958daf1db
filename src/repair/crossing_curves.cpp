#include "crossing_curves.h"

#include <algorithm>
#include <utility>

namespace mspskel::detail {
namespace {

using EndPair = std::pair<Index, Index>;

class CurveSearch {
 public:
  explicit CurveSearch(ShiftedShells& shells) : shells_(shells) {}

  std::optional<CrossingCurves> run(const Execution& execution, Watch& watch) {
    find_passages(execution);
    watch.ask(0.3);
    if (!find_segments() || !find_triples(watch)) return std::nullopt;
    return std::move(curves_);
  }

 private:
  const SurfaceSnapshot& surface() const { return shells_.surface(); }
  const Vector3& point(Index v) const { return shells_.point(v); }
  Index edge_of(Index h) const { return std::min(h, surface().twin[h]); }
  EndPair ends(Index h) const {
    const Index a = surface().origin[h], b = surface().target(h);
    return {std::min(a, b), std::max(a, b)};
  }

  // Six times the volume of the tetrahedron of two edges, the same whichever edge is named first.
  double volume(EndPair one, EndPair other) const {
    if (other < one) std::swap(one, other);
    const Vector3& p = point(one.first);
    return (point(one.second) - p).dot((point(other.first) - p).cross(point(other.second) - p));
  }
  // The side of the face's plane that a point is on.
  double height(Index f, Index v) const {
    const Vector3& a = point(shells_.corner(f, 0));
    return (point(shells_.corner(f, 1)) - a).cross(point(shells_.corner(f, 2)) - a).dot(point(v) - a);
  }

  void find_passages(const Execution& execution) {
    const std::vector<Index>& faces = shells_.group().faces();
    constexpr Index kBlock = 256;
    const Index blocks = (static_cast<Index>(faces.size()) + kBlock - 1) / kBlock;
    std::vector<std::vector<EdgePassage>> found(static_cast<std::size_t>(blocks));
    parallel_for(
        blocks, "union of shells", execution, [] { return 0; },
        [&](Index b, int&) {
          const Index end = std::min<Index>(static_cast<Index>(faces.size()), (b + 1) * kBlock);
          for (Index i = b * kBlock; i < end; ++i)
            for (Index h = 3 * faces[i]; h < 3 * faces[i] + 3; ++h)
              if (edge_of(h) == h) pass_through(h, found[b]);
        },
        1);
    for (std::vector<EdgePassage>& some : found)
      for (EdgePassage& p : some) {
        const auto [a, b] = ends(p.edge);
        p.point = shells_.add_point(point(a) + p.share * (point(b) - point(a)));
        curves_.passages.push_back(p);
      }
  }

  void pass_through(Index h, std::vector<EdgePassage>& found) const {
    const EndPair edge = ends(h);
    const Vector3 &p = surface().position[edge.first], &q = surface().position[edge.second];
    const Vector3 room = Vector3::Constant(4 * kShellShift);
    const Index own = shells_.member(edge.first);
    shells_.group().walls().for_each_in_box(p.cwiseMin(q) - room, p.cwiseMax(q) + room, [&](Index g) {
      if (shells_.member_of_face(g) == own) return true;
      const double at_p = height(g, edge.first), at_q = height(g, edge.second);
      if ((at_p > 0) == (at_q > 0)) return true;
      int ahead = 0;
      for (Index s = 3 * g; s < 3 * g + 3; ++s) {
        const EndPair side = ends(s);
        ahead += (volume(edge, side) > 0) == (side.first == surface().origin[s]);
      }
      if (ahead == 0 || ahead == 3) found.push_back({h, g, kNone, at_p / (at_p - at_q)});
      return true;
    });
  }

  bool find_segments() {
    struct End {
      EndPair faces;
      Index point;
    };
    std::vector<End> ends;
    for (const EdgePassage& p : curves_.passages)
      for (const Index f : {p.edge / 3, surface().twin[p.edge] / 3})
        ends.push_back({{std::min(f, p.face), std::max(f, p.face)}, p.point});
    std::sort(ends.begin(), ends.end(), [](const End& a, const End& b) {
      return a.faces != b.faces ? a.faces < b.faces : a.point < b.point;
    });
    for (std::size_t i = 0; i < ends.size(); i += 2) {
      if (i + 1 == ends.size() || ends[i].faces != ends[i + 1].faces) return false;
      if (i + 2 < ends.size() && ends[i + 2].faces == ends[i].faces) return false;
      curves_.segments.push_back(
          {{ends[i].faces.first, ends[i].faces.second}, {ends[i].point, ends[i + 1].point}});
    }
    for (std::size_t s = 0; s < curves_.segments.size(); ++s)
      for (const Index f : curves_.segments[s].face) curves_.on_face[f].push_back(static_cast<Index>(s));
    return true;
  }

  Index segment_between(Index f, Index g) const {
    const std::array<Index, 2> wanted{std::min(f, g), std::max(f, g)};
    const auto found =
        std::lower_bound(curves_.segments.begin(), curves_.segments.end(), wanted,
                         [](const CurveSegment& s, const std::array<Index, 2>& w) { return s.face < w; });
    return found != curves_.segments.end() && found->face == wanted
               ? static_cast<Index>(found - curves_.segments.begin())
               : kNone;
  }

  // Points of three faces, found in the first of them.
  bool find_triples(Watch& watch) {
    constexpr double kMostPairs = 3e8;
    double pairs = 0;
    for (const auto& [f, list] : curves_.on_face)
      pairs += static_cast<double>(list.size()) * static_cast<double>(list.size());
    if (pairs > kMostPairs) return false;
    for (const auto& [f, list] : curves_.on_face) curves_.faces.push_back(f);
    std::sort(curves_.faces.begin(), curves_.faces.end());
    for (const Index f : curves_.faces)
      if (!find_triples_on(f, watch)) return false;
    for (CurveSegment& s : curves_.segments) {
      const Vector3 from = point(s.end[0]), way = point(s.end[1]) - from;
      std::sort(s.between.begin(), s.between.end(), [&](Index a, Index b) {
        const double at_a = way.dot(point(a) - from), at_b = way.dot(point(b) - from);
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
    const FacePlane plane = shells_.plane_of(f);
    std::vector<Line> lines;
    for (const Index s : curves_.on_face[f]) {
      const Index other =
          curves_.segments[s].face[0] == f ? curves_.segments[s].face[1] : curves_.segments[s].face[0];
      if (other < f) continue;
      const FaceCutter::Point a = plane.at(point(curves_.segments[s].end[0])),
                              b = plane.at(point(curves_.segments[s].end[1]));
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
        if (shells_.member_of_face(s.other) == shells_.member_of_face(t.other)) continue;
        const double ta = FaceCutter::turn(s.a, s.b, t.a), tb = FaceCutter::turn(s.a, s.b, t.b);
        if ((ta > 0) == (tb > 0) ||
            (FaceCutter::turn(t.a, t.b, s.a) > 0) == (FaceCutter::turn(t.a, t.b, s.b) > 0))
          continue;
        const Index third = segment_between(s.other, t.other);
        if (third == kNone) return false;
        const Vector3 &from = point(curves_.segments[t.segment].end[0]),
                      &to = point(curves_.segments[t.segment].end[1]);
        const Index added = shells_.add_point(from + ta / (ta - tb) * (to - from));
        for (const Index k : {s.segment, t.segment, third}) curves_.segments[k].between.push_back(added);
      }
    }
    return true;
  }

  ShiftedShells& shells_;
  CrossingCurves curves_;
};

}  // namespace

std::size_t CrossingCurves::crossings(const ShiftedShells& shells) const {
  std::vector<EndPair> pairs;
  for (const CurveSegment& s : segments) {
    const Index a = shells.member_of_face(s.face[0]), b = shells.member_of_face(s.face[1]);
    pairs.emplace_back(std::min(a, b), std::max(a, b));
  }
  std::sort(pairs.begin(), pairs.end());
  return static_cast<std::size_t>(std::unique(pairs.begin(), pairs.end()) - pairs.begin());
}

std::optional<CrossingCurves> find_crossing_curves(ShiftedShells& shells, const Execution& execution,
                                                   Watch& watch) {
  return CurveSearch(shells).run(execution, watch);
}

}  // namespace mspskel::detail
