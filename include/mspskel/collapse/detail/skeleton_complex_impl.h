#pragma once

#include <algorithm>
#include <utility>

#include "mspskel/base/linkage.h"

namespace mspskel {

MSPSKEL_INLINE SkeletonComplex::SkeletonComplex(Index vertex_count)
    : vertices_(static_cast<std::size_t>(vertex_count)), vertex_count_(vertex_count) {}

MSPSKEL_INLINE CocycleLabel SkeletonComplex::label(Index dart) const {
  return dart % 2 == 0 ? labels_[dart / 2] : -labels_[dart / 2];
}

MSPSKEL_INLINE std::array<Index, 3> SkeletonComplex::face_darts(Index f) const {
  return {corners_[3 * f].dart, corners_[3 * f + 1].dart, corners_[3 * f + 2].dart};
}

// ---- lists
// -----------------------------------------------------------------------------------------------------------

MSPSKEL_INLINE void SkeletonComplex::link_dart(Index dart, Index vertex) {
  Vertex& v = vertices_[vertex];
  darts_[dart] = {vertex, v.first, kNone};
  if (v.first != kNone) darts_[v.first].prev = dart;
  v.first = dart;
  ++v.degree;
}

MSPSKEL_INLINE void SkeletonComplex::unlink_dart(Index dart) {
  const Dart d = darts_[dart];
  (d.prev == kNone ? vertices_[d.origin].first : darts_[d.prev].next) = d.next;
  if (d.next != kNone) darts_[d.next].prev = d.prev;
  --vertices_[d.origin].degree;
  darts_[dart] = {};
}

MSPSKEL_INLINE void SkeletonComplex::link_corner(Index corner, Index dart) {
  Edge& e = edges_[dart / 2];
  corners_[corner] = {dart, e.first_corner, kNone};
  if (e.first_corner != kNone) corners_[e.first_corner].prev = corner;
  e.first_corner = corner;
  ++e.face_count;
}

MSPSKEL_INLINE void SkeletonComplex::unlink_corner(Index corner) {
  const Corner c = corners_[corner];
  Edge& e = edges_[c.dart / 2];
  (c.prev == kNone ? e.first_corner : corners_[c.prev].next) = c.next;
  if (c.next != kNone) corners_[c.next].prev = c.prev;
  --e.face_count;
  corners_[corner] = {};
}

// Scans the shorter of the two lists.
template <class Visit>
void SkeletonComplex::for_each_dart_between(Index u, Index x, Visit visit) const {
  const bool from_u = degree(u) <= degree(x);
  for (Index d = first_dart(from_u ? u : x); d != kNone; d = next_dart(d))
    if (target(d) == (from_u ? x : u)) visit(from_u ? d : d ^ 1);
}

// ---- construction
// ----------------------------------------------------------------------------------------------------

MSPSKEL_INLINE Index SkeletonComplex::add_edge(Index first, Index second, CocycleLabel label) {
  const auto valid = [&](Index v) { return v >= 0 && v < vertex_capacity() && is_vertex(v); };
  if (!valid(first) || !valid(second) || first == second)
    throw UsageError("edge " + std::to_string(first) + "-" + std::to_string(second) +
                     " does not join two vertices");
  const Index e = edge_capacity();
  darts_.resize(darts_.size() + 2);
  edges_.emplace_back();
  labels_.push_back(std::move(label));
  link_dart(2 * e, first);
  link_dart(2 * e + 1, second);
  ++edge_count_;
  return e;
}

MSPSKEL_INLINE Index SkeletonComplex::add_face(Index dart0, Index dart1, Index dart2) {
  const std::array<Index, 3> darts{dart0, dart1, dart2};
  const Index f = face_capacity();
  for (const Index d : darts)
    if (d < 0 || d >= 2 * edge_capacity() || !is_edge(d / 2))
      throw UsageError("face " + std::to_string(f) + " names a dart that does not exist");
  CocycleLabel sum;
  for (std::size_t i = 0; i < 3; ++i) {
    if (target(darts[i]) != origin(darts[(i + 1) % 3]))
      throw UsageError("the edges of face " + std::to_string(f) + " do not close");
    if (!labels_[darts[i] / 2].is_zero()) sum += label(darts[i]);
  }
  if (!sum.is_zero()) throw UsageError("the labels round face " + std::to_string(f) + " do not sum to zero");
  corners_.resize(corners_.size() + 3);
  for (Index i = 0; i < 3; ++i) link_corner(3 * f + i, darts[static_cast<std::size_t>(i)]);
  ++face_count_;
  return f;
}

MSPSKEL_INLINE void SkeletonComplex::reserve(Index edges, Index faces) {
  darts_.reserve(darts_.size() + 2 * static_cast<std::size_t>(edges));
  edges_.reserve(edges_.size() + static_cast<std::size_t>(edges));
  labels_.reserve(labels_.size() + static_cast<std::size_t>(edges));
  corners_.reserve(corners_.size() + 3 * static_cast<std::size_t>(faces));
}

MSPSKEL_INLINE void SkeletonComplex::drop_isolated_vertices() {
  for (Vertex& v : vertices_) {
    if (!v.alive || v.degree > 0) continue;
    v.alive = false;
    --vertex_count_;
  }
}

MSPSKEL_INLINE void SkeletonComplex::forget_labels() {
  for (CocycleLabel& label : labels_) label = {};
  merge_parallel_edges();
}

MSPSKEL_INLINE void SkeletonComplex::merge_parallel_edges() {
  for (Index e = 0; e < edge_capacity(); ++e) {
    if (!is_edge(e)) continue;
    const auto [u, v] = ends(e);
    merges_.clear();
    for_each_dart_between(u, v, [&](Index d) {
      if (d / 2 > e && same_class({}, d, 2 * e)) merges_.push_back({2 * e, d});
    });
    for (const auto& [keep, gone] : merges_) merge_edges(keep, gone);
  }
}

// ---- collapse
// --------------------------------------------------------------------------------------------------------

MSPSKEL_INLINE bool SkeletonComplex::same_class(const CocycleLabel& shift, Index dart, Index other) const {
  if (shift.is_zero() && labels_[dart / 2].is_zero()) return labels_[other / 2].is_zero();
  return shift + label(dart) == label(other);
}

MSPSKEL_INLINE CollapseRefusal SkeletonComplex::refusal(Index e, Index kept, bool allow_parallel) {
  const Index out = dart_from(e, kept), gone = target(out);
  const CocycleLabel shift = label(out);
  merges_.clear();
  for (Index d = first_dart(gone); d != kNone; d = next_dart(d)) {
    if (d == (out ^ 1)) continue;
    const Index x = target(d);
    if (x == kept) return CollapseRefusal::kLoop;
    bool differs = false, merges = false;
    for_each_dart_between(kept, x, [&](Index c) {
      if (same_class(shift, d, c)) {
        merges = true;
        merges_.push_back({c, d});
      } else {
        differs = true;
      }
    });
    // Where parallel edges are allowed already, one more of a class that is there makes no new loop.
    if (differs && !merges && !allow_parallel) return CollapseRefusal::kDifferentLabels;
  }
  return CollapseRefusal::kAllowed;
}

MSPSKEL_INLINE void SkeletonComplex::rebase(Index dart, const CocycleLabel& shift) {
  if (dart % 2 == 0)
    labels_[dart / 2] += shift;
  else
    labels_[dart / 2] -= shift;
}

MSPSKEL_INLINE CollapseRefusal SkeletonComplex::collapse(Index e, Index kept, bool allow_parallel) {
  if (const CollapseRefusal reason = refusal(e, kept, allow_parallel); reason != CollapseRefusal::kAllowed)
    return reason;
  const Index out = dart_from(e, kept), gone = target(out);
  const CocycleLabel shift = label(out);
  while (edges_[e].first_corner != kNone) delete_face(edges_[e].first_corner / 3);
  delete_edge(e);
  merged_.clear();
  for (const auto& [keep, other] : merges_) {
    merge_edges(keep, other);
    merged_.push_back(keep / 2);
  }
  while (vertices_[gone].first != kNone) {
    const Index d = vertices_[gone].first;
    unlink_dart(d);
    link_dart(d, kept);
    if (!shift.is_zero()) rebase(d, shift);
  }
  vertices_[gone].alive = false;
  --vertex_count_;
  return CollapseRefusal::kAllowed;
}

// Both darts are about to run between the same vertices: `keep`'s edge takes over the faces of `gone`'s.
MSPSKEL_INLINE void SkeletonComplex::merge_edges(Index keep, Index gone) {
  while (edges_[gone / 2].first_corner != kNone) {
    const Index corner = edges_[gone / 2].first_corner;
    const Index dart = corners_[corner].dart == gone ? keep : keep ^ 1;
    unlink_corner(corner);
    link_corner(corner, dart);
    if (has_twin_face(corner / 3)) delete_face(corner / 3);
  }
  delete_edge(gone / 2);
}

// Whether another face has the same three edges.
MSPSKEL_INLINE bool SkeletonComplex::has_twin_face(Index f) const {
  const auto [a, b, c] = face_darts(f);
  Index few = a / 2;
  for (const Index e : {b / 2, c / 2})
    if (edges_[e].face_count < edges_[few].face_count) few = e;
  const auto has = [&](Index g, Index e) {
    const auto [p, q, r] = face_darts(g);
    return p / 2 == e || q / 2 == e || r / 2 == e;
  };
  for (Index corner = edges_[few].first_corner; corner != kNone; corner = corners_[corner].next) {
    const Index g = corner / 3;
    if (g != f && has(g, a / 2) && has(g, b / 2) && has(g, c / 2)) return true;
  }
  return false;
}

MSPSKEL_INLINE void SkeletonComplex::delete_face(Index f) {
  for (Index corner = 3 * f; corner < 3 * f + 3; ++corner) unlink_corner(corner);
  --face_count_;
}

MSPSKEL_INLINE void SkeletonComplex::delete_edge(Index e) {
  if (edges_[e].first_corner != kNone)
    throw UsageError("edge " + std::to_string(e) + " has faces and cannot be deleted");
  unlink_dart(2 * e);
  unlink_dart(2 * e + 1);
  labels_[e] = {};
  --edge_count_;
}

// ---- checks
// ----------------------------------------------------------------------------------------------------------

MSPSKEL_INLINE std::string SkeletonComplex::find_violation() const {
  Index vertices = 0, edges = 0, faces = 0;
  for (Index v = 0; v < vertex_capacity(); ++v) {
    vertices += is_vertex(v) ? 1 : 0;
    Index degree = 0;
    for (Index d = first_dart(v); d != kNone; d = next_dart(d), ++degree) {
      if (!is_vertex(v) || origin(d) != v) return "dart " + std::to_string(d) + " is in the wrong list";
      for (Index c = next_dart(d); c != kNone; c = next_dart(c))
        if (target(c) == target(d) && label(c) == label(d))
          return "edges " + std::to_string(c / 2) + " and " + std::to_string(d / 2) + " should be one";
    }
    if (degree != vertices_[v].degree) return "vertex " + std::to_string(v) + " has a wrong degree";
  }
  for (Index e = 0; e < edge_capacity(); ++e) {
    if (!is_edge(e)) continue;
    ++edges;
    if (origin(2 * e) == target(2 * e)) return "edge " + std::to_string(e) + " is a loop";
    Index count = 0;
    for (Index c = first_corner(e); c != kNone; c = next_corner(c), ++count)
      if (corners_[c].dart / 2 != e) return "corner " + std::to_string(c) + " is in the wrong list";
    if (count != edges_[e].face_count) return "edge " + std::to_string(e) + " has a wrong face count";
  }
  for (Index f = 0; f < face_capacity(); ++f) {
    if (!is_face(f)) continue;
    ++faces;
    const auto darts = face_darts(f);
    CocycleLabel sum;
    for (std::size_t i = 0; i < 3; ++i) {
      if (!is_edge(darts[i] / 2)) return "face " + std::to_string(f) + " has a dead edge";
      if (target(darts[i]) != origin(darts[(i + 1) % 3]))
        return "face " + std::to_string(f) + " is not closed";
      sum += label(darts[i]);
    }
    if (!sum.is_zero()) return "the labels round face " + std::to_string(f) + " do not sum to zero";
    if (has_twin_face(f)) return "face " + std::to_string(f) + " is there twice";
  }
  if (vertices != vertex_count_ || edges != edge_count_ || faces != face_count_) return "a count is wrong";
  return {};
}

// ---- from a surface
// --------------------------------------------------------------------------------------------------

MSPSKEL_INLINE SkeletonComplex make_complex(const SurfaceSnapshot& surface,
                                            const std::vector<CocycleLabel>& halfedge_label) {
  const bool labelled = !halfedge_label.empty();
  if (labelled && static_cast<Index>(halfedge_label.size()) != surface.halfedge_count())
    throw UsageError("labels: there must be one for every half-edge");
  std::vector<std::array<Index, 3>> order;  // smaller vertex, larger vertex, half-edge between them
  order.reserve(static_cast<std::size_t>(surface.halfedge_count()) / 2);
  for (Index h = 0; h < surface.halfedge_count(); ++h) {
    const Index u = surface.origin[h], v = surface.target(h);
    if (u < v) order.push_back({u, v, h});
  }
  std::sort(order.begin(), order.end());
  SkeletonComplex complex(surface.vertex_count());
  complex.reserve(static_cast<Index>(order.size()), surface.face_count());
  std::vector<Index> dart(static_cast<std::size_t>(surface.halfedge_count()), kNone);
  for (const auto& [u, v, h] : order) {
    const Index twin = surface.twin[h];
    if (labelled && halfedge_label[h] != -halfedge_label[twin])
      throw UsageError("labels: half-edges " + std::to_string(h) + " and " + std::to_string(twin) +
                       " are not negatives");
    const Index e = complex.add_edge(u, v, labelled ? halfedge_label[h] : CocycleLabel{});
    dart[h] = 2 * e;
    dart[twin] = 2 * e + 1;
  }
  for (Index f = 0; f < surface.face_count(); ++f)
    complex.add_face(dart[3 * f], dart[3 * f + 1], dart[3 * f + 2]);
  complex.drop_isolated_vertices();
  complex.merge_parallel_edges();
  return complex;
}

}  // namespace mspskel
