#include "oriented_surface.h"

#include <algorithm>
#include <string>

#include "defects.h"
#include "edge_table.h"
#include "mspskel/base/error.h"

namespace mspskel::detail {
namespace {

using Surface = OrientedSurface;

// Connected pieces of the boundary edges, by union and find over their vertices.
Index count_pieces(const std::vector<std::pair<Index, Index>>& edges, Index vertex_count) {
  std::vector<Index> parent(vertex_count, kNone);
  Index pieces = 0;
  const auto root = [&](Index v) {
    if (parent[v] == kNone) {
      parent[v] = v;
      ++pieces;
    }
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const auto& [a, b] : edges) {
    const Index ra = root(a), rb = root(b);
    if (ra == rb) continue;
    parent[std::max(ra, rb)] = std::min(ra, rb);
    --pieces;
  }
  return pieces;
}

// Matches the two half-edges of every edge; collects what is wrong with the others.
class EdgeMatcher {
 public:
  EdgeMatcher(Index vertex_count, const Triangulation& triangulation)
      : vertex_count_(vertex_count), triangulation_(triangulation), corners_(triangulation.corners) {}

  std::vector<Index> run() {
    std::vector<Index> twin(corners_.size(), kNone);
    EdgeTable(vertex_count_, corners_)
        .each_edge([&](Index a, Index b, const HalfedgeEnd* first, const HalfedgeEnd* last) {
          const auto faces = last - first;
          if (faces == 1) boundary_.emplace_back(a, b);
          if (faces > 2) crowded_.add(edge_name(a, b) + " (" + std::to_string(faces) + " faces)");
          if (faces > 1) find_duplicates(first, last);
          if (faces == 2) {
            twin[first[0].halfedge] = first[1].halfedge;
            twin[first[1].halfedge] = first[0].halfedge;
          }
        });
    refuse_defects();
    return twin;
  }

 private:
  // Two faces of one edge with the same apex have the same corners. Each pair comes up at its three edges:
  // count it at the one opposite to its largest corner.
  void find_duplicates(const HalfedgeEnd* first, const HalfedgeEnd* last) {
    apexes_.clear();
    for (const HalfedgeEnd* e = first; e != last; ++e)
      apexes_.emplace_back(corners_[Surface::prev(e->halfedge)], e->halfedge / 3);
    if (apexes_.size() > 2) std::sort(apexes_.begin(), apexes_.end());
    for (std::size_t i = 1; i < apexes_.size(); ++i)
      if (apexes_[i].first == apexes_[i - 1].first && apexes_[i].first > first->other)
        duplicates_.add(std::to_string(triangulation_.polygon(apexes_[i].second)) + " (as " +
                        std::to_string(triangulation_.polygon(apexes_[i - 1].second)) + ")");
  }

  void refuse_defects() const {
    std::string message;
    const auto add = [&](const std::string& part) { message += (message.empty() ? "" : "; ") + part; };
    if (!boundary_.empty()) {
      NamedCount edges;
      for (const auto& [a, b] : boundary_) edges.add(edge_name(a, b));
      const Index pieces = count_pieces(boundary_, vertex_count_);
      add("the mesh is not closed: " + edges.count("boundary edge", "boundary edges") + " in " +
          std::to_string(pieces) + (pieces == 1 ? " loop" : " loops") + ", first " + edges.names());
    }
    if (crowded_.any())
      add("the mesh is not manifold: " + crowded_.count("edge has", "edges have") +
          " more than two faces, first " + crowded_.names());
    if (duplicates_.any())
      add(duplicates_.count("face is", "faces are") + " given twice, first " + duplicates_.names());
    if (!message.empty()) throw MeshError(message);
  }

  Index vertex_count_;
  const Triangulation& triangulation_;
  const std::vector<Index>& corners_;
  std::vector<std::pair<Index, Index>> boundary_;
  std::vector<std::pair<Index, Index>> apexes_;
  NamedCount crowded_, duplicates_;
};

// Walks every component from its first face; returns which faces have to be turned over, at most half of each
// component.
std::vector<char> find_disagreeing(Surface& s) {
  const Index faces = s.face_count();
  std::vector<char> turn(faces, 0);
  std::vector<Index> stack, members;
  s.component.assign(faces, kNone);
  for (Index seed = 0; seed < faces; ++seed) {
    if (s.component[seed] != kNone) continue;
    s.component[seed] = s.component_count;
    stack.assign(1, seed);
    members.assign(1, seed);
    Index turned = 0;
    while (!stack.empty()) {
      const Index f = stack.back();
      stack.pop_back();
      for (Index h = 3 * f; h < 3 * f + 3; ++h) {
        const Index t = s.twin[h], g = t / 3;
        const char wanted = static_cast<char>(turn[f] ^ (s.corners[h] == s.corners[t]));
        if (s.component[g] == kNone) {
          s.component[g] = s.component_count;
          turn[g] = wanted;
          turned += wanted;
          stack.push_back(g);
          members.push_back(g);
        } else if (turn[g] != wanted) {
          throw MeshError(
              "the surface has only one side and cannot be oriented: going round it, the faces disagree at "
              "edge " +
              edge_name(s.corners[h], s.corners[Surface::next(h)]));
        }
      }
    }
    const Index size = static_cast<Index>(members.size());
    if (2 * static_cast<std::int64_t>(turned) > size) {
      for (const Index f : members) turn[f] ^= 1;
      turned = size - turned;
    }
    s.reoriented_faces += turned;
    ++s.component_count;
  }
  return turn;
}

void refuse_pinched_vertices(const Surface& s, Index vertex_count) {
  std::vector<Index> incident(vertex_count, 0), first(vertex_count, kNone);
  for (Index h = static_cast<Index>(s.corners.size()) - 1; h >= 0; --h) {
    ++incident[s.corners[h]];
    first[s.corners[h]] = h;
  }
  NamedCount pinched;
  for (Index v = 0; v < vertex_count; ++v) {
    if (first[v] == kNone) continue;
    Index fan = 0, h = first[v];
    do {
      ++fan;
      h = s.twin[Surface::prev(h)];
    } while (h != first[v]);
    if (fan != incident[v]) pinched.add(std::to_string(v));
  }
  if (pinched.any())
    throw MeshError("the mesh is not manifold: several fans of faces meet at " +
                    pinched.count("vertex", "vertices") + ", first " + pinched.names());
}

}  // namespace

void turn_faces(OrientedSurface& s, const std::vector<char>& turn) {
  // (a, b, c) becomes (a, c, b): half-edge 3f+i is then the place of the edge that was at 3f+2-i.
  const auto moved = [&](Index h) { return turn[h / 3] ? h + 2 - 2 * (h % 3) : h; };
  std::vector<Index> twin(s.twin.size());
  for (Index h = 0; h < static_cast<Index>(twin.size()); ++h) twin[moved(h)] = moved(s.twin[h]);
  s.twin = std::move(twin);
  for (Index f = 0; f < s.face_count(); ++f)
    if (turn[f]) std::swap(s.corners[3 * f + 1], s.corners[3 * f + 2]);
}

OrientedSurface orient_surface(Index vertex_count, const Triangulation& triangulation) {
  OrientedSurface s;
  s.twin = EdgeMatcher(vertex_count, triangulation).run();
  s.corners = triangulation.corners;
  const std::vector<char> turn = find_disagreeing(s);
  if (s.reoriented_faces > 0) turn_faces(s, turn);
  refuse_pinched_vertices(s, vertex_count);
  return s;
}

}  // namespace mspskel::detail
