#include "cut_union.h"

#include <algorithm>
#include <array>
#include <utility>

#include "../mesh/edge_table.h"
#include "crossing_curves.h"
#include "cut_faces.h"
#include "disjoint_sets.h"
#include "face_set.h"

namespace mspskel::detail {
namespace {

constexpr const char* kStage = "union of shells";

// Pieces that no curve divides: they lie in the same solids.
DisjointSets patches_of(const std::vector<CutPiece>& pieces, const Execution& execution) {
  struct Side {
    std::array<Index, 2> ends;
    Index piece;
    char cut;
  };
  const auto count = static_cast<Index>(pieces.size());
  std::vector<Side> sides;
  sides.reserve(3 * pieces.size());
  for (Index i = 0; i < count; ++i)
    for (int k = 0; k < 3; ++k) {
      const Index a = pieces[i].corner[k], b = pieces[i].corner[(k + 1) % 3];
      sides.push_back({{std::min(a, b), std::max(a, b)}, i, pieces[i].cut[k]});
    }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return a.ends != b.ends ? a.ends < b.ends : a.piece < b.piece;
  });
  report_progress(execution.progress, kStage, 0.8);
  DisjointSets patches(count);
  for (std::size_t i = 0; i + 1 < sides.size(); ++i)
    if (sides[i].ends == sides[i + 1].ends && !sides[i].cut && !sides[i + 1].cut)
      patches.unite(sides[i].piece, sides[i + 1].piece);
  return patches;
}

bool is_outside(const ShiftedShells& shells, const CutPiece& piece) {
  const Index own = shells.member_of_face(piece.face);
  const Vector3 p =
      (shells.point(piece.corner[0]) + shells.point(piece.corner[1]) + shells.point(piece.corner[2])) / 3;
  for (Index m = 0; m < static_cast<Index>(shells.group().size()); ++m)
    if (m != own && shells.is_in(m, p)) return false;
  return true;
}

// Of each patch the largest piece tells for all.
std::vector<char> which_are_outside(const ShiftedShells& shells, const std::vector<CutPiece>& pieces,
                                    const Execution& execution) {
  DisjointSets patches = patches_of(pieces, execution);
  const auto count = static_cast<Index>(pieces.size());
  const auto doubled_area = [&](Index i) {
    const std::array<Index, 3>& c = pieces[i].corner;
    return (shells.point(c[1]) - shells.point(c[0])).cross(shells.point(c[2]) - shells.point(c[0])).norm();
  };
  std::vector<Index> largest(pieces.size(), kNone), roots;
  for (Index i = 0; i < count; ++i) {
    Index& best = largest[patches.root(i)];
    if (best == kNone) roots.push_back(patches.root(i));
    if (best == kNone || doubled_area(i) > doubled_area(best)) best = i;
  }
  std::vector<char> outside(pieces.size(), 0);
  parallel_for(
      static_cast<Index>(roots.size()), kStage, execution, [] { return 0; },
      [&](Index r, int&) { outside[roots[r]] = is_outside(shells, pieces[largest[roots[r]]]); }, 64);
  for (Index i = 0; i < count; ++i) outside[i] = outside[patches.root(i)];
  return outside;
}

// Vertices in the order in which the pieces first have them.
CutShells outer_pieces(const ShiftedShells& shells, const std::vector<CutPiece>& pieces,
                       const Execution& execution) {
  const std::vector<char> outside = which_are_outside(shells, pieces, execution);
  CutShells cut;
  std::vector<Index> vertex(shells.points().size(), kNone);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (!outside[i]) continue;
    std::array<Index, 3> c = pieces[i].corner;
    const auto shell = static_cast<std::size_t>(shells.member_of_face(pieces[i].face));
    if (shells.group().shell(shell).inside_out) std::swap(c[1], c[2]);
    for (Index& v : c) {
      if (vertex[v] == kNone) {
        vertex[v] = static_cast<Index>(cut.soup.points.size());
        cut.soup.points.push_back(shells.point(v));
      }
      v = vertex[v];
    }
    cut.soup.add_triangle(c[0], c[1], c[2]);
    cut.shell.push_back(shell);
  }
  return cut;
}

// Whether each side has its opposite and each vertex one fan.
bool is_closed_manifold(const PolygonSoup& soup) {
  std::vector<Index> twin(soup.corners.size(), kNone);
  bool paired = true;
  EdgeTable(static_cast<Index>(soup.points.size()), soup.corners)
      .each_edge([&](Index, Index, const HalfedgeEnd* first, const HalfedgeEnd* last) {
        paired =
            paired && last - first == 2 && soup.corners[first[0].halfedge] != soup.corners[first[1].halfedge];
        if (!paired) return;
        twin[first[0].halfedge] = first[1].halfedge;
        twin[first[1].halfedge] = first[0].halfedge;
      });
  if (!paired) return false;
  std::vector<Index> degree(soup.points.size(), 0);
  for (const Index v : soup.corners) ++degree[v];
  std::vector<char> seen(soup.points.size(), 0);
  for (Index h = 0; h < static_cast<Index>(soup.corners.size()); ++h) {
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

std::optional<CutShells> try_cut(const ShellGroup& group, unsigned seed, const Execution& execution) {
  ShiftedShells shells(group, seed);
  Watch watch(execution.progress, kStage);
  const std::optional<CrossingCurves> curves = find_crossing_curves(shells, execution, watch);
  if (!curves) return std::nullopt;
  watch.ask(0.5);
  const std::optional<std::vector<CutPiece>> pieces = cut_along_curves(shells, *curves, watch);
  if (!pieces) return std::nullopt;
  watch.ask(0.7);
  CutShells cut = outer_pieces(shells, *pieces, execution);
  watch.ask(0.9);
  if (!is_closed_manifold(cut.soup)) return std::nullopt;
  cut.crossings = curves->crossings(shells);
  return cut;
}

}  // namespace

std::optional<CutShells> cut_union(const ShellGroup& group, const Execution& execution) {
  constexpr unsigned kTries = 3;
  for (unsigned seed = 1; seed <= kTries; ++seed)
    if (auto cut = try_cut(group, seed, execution)) return cut;
  return std::nullopt;
}

}  // namespace mspskel::detail
