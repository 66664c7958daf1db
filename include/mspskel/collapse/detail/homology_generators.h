// 2g loops that generate the first homology of each connected component, by tree and cotree.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {
namespace detail {

// Vertices and faces of one connected component.
struct ComponentElements {
  std::vector<Index> vertices, faces;

  Index genus() const {  // V − E + F = 2 − 2g with E = 3F/2
    return (2 - static_cast<Index>(vertices.size()) + static_cast<Index>(faces.size()) / 2) / 2;
  }
};

inline std::vector<ComponentElements> component_elements(const SurfaceSnapshot& surface) {
  std::vector<ComponentElements> elements(surface.component_count);
  for (Index v = 0; v < surface.vertex_count(); ++v)
    if (surface.component[v] != kNone) elements[surface.component[v]].vertices.push_back(v);
  for (Index f = 0; f < surface.face_count(); ++f)
    elements[surface.component[surface.origin[3 * f]]].faces.push_back(f);
  return elements;
}

// A spanning tree of the vertices and a spanning tree of the faces that share no edge leave 2g edges; each
// closes one loop through the vertex tree and one through the face tree (Eppstein, "Dynamic generators of
// topologically embedded graphs", SODA 2003). Loop i and dual loop j meet once if i = j and never otherwise.
struct HomologyGenerators {
  // Closed walks of half-edges without the way back and forth to the root that both ends share.
  std::vector<std::vector<Index>> loop;
  // dual_loop[j] leaves face(h) across each of its half-edges h; the first one closes loop[j].
  std::vector<std::vector<Index>> dual_loop;
};

namespace generators {

// Breadth-first tree of the component's vertices: per vertex the half-edge that leads to it, and its depth.
inline void grow_tree(const SurfaceSnapshot& surface, Index root, std::vector<Index>& to,
                      std::vector<Index>& depth) {
  std::vector<Index> queue{root};
  depth[root] = 0;
  for (std::size_t i = 0; i < queue.size(); ++i) {
    const Index v = queue[i], first = surface.vertex_halfedge[v];
    Index h = first;
    do {
      const Index w = surface.target(h);
      if (depth[w] == kNone) {
        depth[w] = depth[v] + 1;
        to[w] = h;
        queue.push_back(w);
      }
      h = surface.next_outgoing(h);
    } while (h != first);
  }
}

class UnionFind {
 public:
  explicit UnionFind(Index n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
  Index find(Index x) {
    while (parent_[x] != x) x = parent_[x] = parent_[parent_[x]];
    return x;
  }
  bool unite(Index a, Index b) {
    a = find(a), b = find(b);
    if (a == b) return false;
    parent_[b] = a;
    return true;
  }

 private:
  std::vector<Index> parent_;
};

// Half-edges (one an edge) outside the tree, those that close the longest loops first: the face tree takes
// the long ones, which leaves short generators (Erickson, Whittlesey, SODA 2005, in steps instead of
// lengths).
inline std::vector<Index> candidates_by_loop_length(const SurfaceSnapshot& surface,
                                                    const std::vector<Index>& faces,
                                                    const std::vector<Index>& to,
                                                    const std::vector<Index>& depth) {
  std::vector<std::vector<Index>> bucket;
  for (const Index f : faces)
    for (Index h = 3 * f; h < 3 * f + 3; ++h) {
      const Index t = surface.twin[h], a = surface.origin[h], b = surface.target(h);
      if (h > t || to[b] == h || to[a] == t) continue;
      const auto length = static_cast<std::size_t>(depth[a]) + static_cast<std::size_t>(depth[b]);
      if (bucket.size() <= length) bucket.resize(length + 1);
      bucket[length].push_back(h);
    }
  std::vector<Index> sorted;
  for (std::size_t i = bucket.size(); i-- > 0;)
    sorted.insert(sorted.end(), bucket[i].begin(), bucket[i].end());
  return sorted;
}

// The closed walk root → origin(h) → target(h) → root, its common tail dropped.
inline std::vector<Index> tree_loop(const SurfaceSnapshot& surface, Index h, const std::vector<Index>& to,
                                    const std::vector<Index>& depth) {
  std::vector<Index> up, down;
  Index a = surface.origin[h], b = surface.target(h);
  while (a != b) {
    if (depth[a] >= depth[b]) {
      up.push_back(to[a]);
      a = surface.origin[to[a]];
    } else {
      down.push_back(surface.twin[to[b]]);
      b = surface.origin[to[b]];
    }
  }
  std::reverse(up.begin(), up.end());
  up.push_back(h);
  up.insert(up.end(), down.begin(), down.end());
  return up;
}

// Face tree as per face the half-edge of its parent that is left to reach it, and depth; kNone: not reached.
struct FaceTree {
  std::vector<Index> entered, depth;
};

inline void grow_face_tree(const SurfaceSnapshot& surface, Index root, const std::vector<bool>& in_cotree,
                           FaceTree& tree) {
  std::vector<Index> queue{root};
  tree.depth[root] = 0;
  for (std::size_t i = 0; i < queue.size(); ++i)
    for (Index h = 3 * queue[i]; h < 3 * queue[i] + 3; ++h) {
      const Index f = SurfaceSnapshot::face(surface.twin[h]);
      if (!in_cotree[h] || tree.depth[f] != kNone) continue;
      tree.depth[f] = tree.depth[queue[i]] + 1;
      tree.entered[f] = h;
      queue.push_back(f);
    }
}

// The closed walk of faces across h and back through the face tree.
inline std::vector<Index> face_tree_loop(const SurfaceSnapshot& surface, Index h, const FaceTree& tree) {
  std::vector<Index> loop{h}, down;
  Index from = SurfaceSnapshot::face(surface.twin[h]), to = SurfaceSnapshot::face(h);
  while (from != to) {
    if (tree.depth[from] >= tree.depth[to]) {
      loop.push_back(surface.twin[tree.entered[from]]);
      from = SurfaceSnapshot::face(tree.entered[from]);
    } else {
      down.push_back(tree.entered[to]);
      to = SurfaceSnapshot::face(tree.entered[to]);
    }
  }
  loop.insert(loop.end(), down.rbegin(), down.rend());
  return loop;
}

}  // namespace generators

// Generators of every component. Cost: O(faces).
inline std::vector<HomologyGenerators> homology_generators(const SurfaceSnapshot& surface,
                                                           const std::vector<ComponentElements>& components) {
  std::vector<Index> to(surface.vertex_count(), kNone), depth(surface.vertex_count(), kNone);
  generators::UnionFind faces(surface.face_count());
  std::vector<bool> in_cotree(surface.origin.size(), false);
  generators::FaceTree face_tree{std::vector<Index>(surface.face_count(), kNone),
                                 std::vector<Index>(surface.face_count(), kNone)};
  std::vector<HomologyGenerators> result(components.size());
  for (std::size_t c = 0; c < components.size(); ++c) {
    if (components[c].genus() <= 0) continue;
    // Root: the vertex farthest from the origin, which is the centroid, so that it moves with the model.
    const auto nearer = [&](Index a, Index b) {
      return surface.position[a].squaredNorm() < surface.position[b].squaredNorm();
    };
    const auto& vertices = components[c].vertices;
    generators::grow_tree(surface, *std::max_element(vertices.begin(), vertices.end(), nearer), to, depth);
    std::vector<Index> closing;
    for (const Index h : generators::candidates_by_loop_length(surface, components[c].faces, to, depth)) {
      const Index t = surface.twin[h];
      if (faces.unite(SurfaceSnapshot::face(h), SurfaceSnapshot::face(t)))
        in_cotree[h] = in_cotree[t] = true;
      else
        closing.push_back(h);
    }
    generators::grow_face_tree(surface, components[c].faces.front(), in_cotree, face_tree);
    for (const Index h : closing) {
      result[c].loop.push_back(generators::tree_loop(surface, h, to, depth));
      result[c].dual_loop.push_back(generators::face_tree_loop(surface, h, face_tree));
    }
  }
  return result;
}

}  // namespace detail
}  // namespace mspskel
