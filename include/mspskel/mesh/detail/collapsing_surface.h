// Half-edge arrays that lose two faces and a vertex with every edge collapse.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "mspskel/base/clones.h"
#include "mspskel/mesh/coarsen_surface.h"
#include "mspskel/mesh/detail/moment_frame.h"
#include "mspskel/mesh/detail/quadric.h"

namespace mspskel {
namespace detail {

// The faces round an edge ab, those of the edge left out, in counter-clockwise order: the fan of the vertex
// that a and b merge into. Face i runs from the origin of outgoing[i], a or b, to vertex[i] and vertex[i +
// 1].
struct MergedRing {
  static constexpr Index kCapacity = 33;  // one more than the largest valence, to repeat the first vertex
  Index size = 0;
  Index from_a = 0;  // the first so many faces are a's
  std::array<Index, kCapacity> vertex, outgoing;
};

enum class CollapseOutcome { kDone, kRefusedTopology, kRefusedShape };

// The layout is SurfaceSnapshot's; a dead face has origin kNone.
class CollapsingSurface {
 public:
  CollapsingSurface(const SurfaceSnapshot& input, const CoarseningOptions& options);

  Index vertex_count() const { return live_vertices_; }
  Index halfedge_count() const { return static_cast<Index>(origin_.size()); }
  bool is_edge(Index h) const { return origin_[h] != kNone && h < twin_[h]; }

  // Of the edge's collapse; infinite as long as it is blocked.
  double cost(Index h);
  double edge_length(Index h) const { return (position_[origin_[h]] - position_[origin_[twin_[h]]]).norm(); }

  void start_pass() { std::fill(moved_.begin(), moved_.end(), 0); }
  bool moved(Index h) const { return moved_[origin_[h]] || moved_[origin_[twin_[h]]]; }
  CollapseOutcome collapse(Index h);

  bool sparse() const { return 5 * live_faces_ < halfedge_count(); }  // under three fifths are alive
  void compact();
  void finish(CoarseSurface& result);

 private:
  // Half-edges of an edge share one cost, stored at the smaller one. One that is blocked has its sign turned.
  static constexpr double kStale = -std::numeric_limits<double>::infinity();

  double& stored_cost(Index h) { return cost_[std::min(h, twin_[h])]; }
  void block(Index h) {
    double& cost = stored_cost(h);
    if (cost != kStale) cost = -std::abs(cost);
  }
  void unblock(Index h) {
    double& cost = stored_cost(h);
    if (cost != kStale) cost = std::abs(cost);
  }
  double evaluate(Index h) const;
  static Index next(Index h) { return SurfaceSnapshot::next(h); }
  static Index prev(Index h) { return SurfaceSnapshot::prev(h); }
  void gather(Index h, MergedRing& ring) const;
  bool permits_counts(Index h) const;
  static bool permits_link(const MergedRing& ring);
  bool permits_shape(Index h, const MergedRing& ring, const Vector3& p,
                     std::array<Vector3, MergedRing::kCapacity>& normal) const;
  double sharpest(Index h, const MergedRing& ring) const;
  double worst_shape(Index h, const MergedRing& ring) const;
  void remove_face(Index h);
  void renumber();

  CoarseningOptions options_;
  double cos_turn_, cos_dihedral_;
  Eigen::Matrix3d frame_;
  TieBreaker ties_;
  Index live_vertices_ = 0, live_faces_ = 0;
  // per vertex
  std::vector<Vector3> position_;
  std::vector<Quadric> quadric_;
  std::vector<Index> valence_, component_, merged_into_;
  std::vector<char> moved_;
  // per half-edge, face, component, input vertex
  std::vector<Index> origin_, twin_;
  std::vector<double> cost_;
  std::vector<Vector3> face_normal_;  // unit, or zero
  std::vector<Index> component_size_;
  std::vector<Index> current_;
};

inline CollapsingSurface::CollapsingSurface(const SurfaceSnapshot& input, const CoarseningOptions& options)
    : options_(options),
      cos_turn_(std::cos(options.most_turn * kPi / 180)),
      cos_dihedral_(std::cos(options.most_dihedral * kPi / 180)),
      frame_(moment_frame(input)),
      ties_(frame_),
      live_faces_(input.face_count()),
      position_(input.position),
      quadric_(input.position.size()),
      valence_(input.position.size(), 0),
      component_(input.component),
      merged_into_(input.position.size()),
      moved_(input.position.size(), 0),
      origin_(input.origin),
      twin_(input.twin),
      cost_(input.origin.size(), kStale),
      face_normal_(static_cast<std::size_t>(input.face_count())),
      component_size_(static_cast<std::size_t>(input.component_count), 0),
      current_(input.position.size()) {
  std::iota(merged_into_.begin(), merged_into_.end(), 0);
  std::iota(current_.begin(), current_.end(), 0);
  for (Index v = 0; v < input.vertex_count(); ++v) {
    if (component_[v] == kNone) {
      merged_into_[v] = current_[v] = kNone;
      continue;
    }
    ++live_vertices_;
    ++component_size_[component_[v]];
    quadric_[v].add_point(position_[v], options.spread * input.vertex_area[v]);
  }
  for (Index f = 0; f < live_faces_; ++f) {
    const Vector3 n = input.face_normal_times_twice_area(f);
    const double twice = n.norm();
    face_normal_[f] = twice > 0 ? Vector3(n / twice) : Vector3::Zero();
    Quadric plane;
    plane.add_plane(face_normal_[f], face_normal_[f].dot(position_[origin_[3 * f]]), twice / 6);
    for (Index h = 3 * f; h < 3 * f + 3; ++h) {
      ++valence_[origin_[h]];
      quadric_[origin_[h]] += plane;
    }
  }
}

inline double CollapsingSurface::cost(Index h) {
  double& cost = stored_cost(h);
  if (cost == kStale) cost = evaluate(h);
  return std::signbit(cost) ? std::numeric_limits<double>::infinity() : cost;
}

inline double CollapsingSurface::evaluate(Index h) const {
  const Index a = origin_[h], b = origin_[next(h)];
  Quadric q = quadric_[a];
  q += quadric_[b];
  const Vector3 middle = 0.5 * (position_[a] + position_[b]);
  const double error = q(q.least_point(middle));
  return std::abs(std::max(error, 0.0)) * ties_.factor(middle);  // below zero by rounding only
}

inline void CollapsingSurface::gather(Index h, MergedRing& ring) const {
  const auto fan = [&](Index first, Index last) {
    for (Index o = first; o != last; o = twin_[prev(o)]) {
      ring.outgoing[ring.size] = o;
      ring.vertex[ring.size++] = origin_[next(o)];
    }
  };
  const Index o = twin_[h];
  fan(twin_[prev(h)], next(o));
  ring.from_a = ring.size;
  fan(twin_[prev(o)], next(h));
  ring.vertex[ring.size] = ring.vertex[0];
}

// Valences after the collapse, and the component's size.
inline bool CollapsingSurface::permits_counts(Index h) const {
  const Index a = origin_[h], b = origin_[next(h)];
  const Index merged = valence_[a] + valence_[b] - 4;
  return merged >= 4 && merged <= options_.most_valence && valence_[origin_[prev(h)]] > 4 &&
         valence_[origin_[prev(twin_[h])]] > 4 &&
         component_size_[component_[a]] > options_.component_vertices;
}

// The link condition: besides the apexes of the two faces, ab's ends have no neighbour in common. The apexes
// keep four edges, so no face closes up either.
inline bool CollapsingSurface::permits_link(const MergedRing& ring) {
  for (Index i = 1; i < ring.from_a; ++i)
    for (Index j = ring.from_a + 1; j < ring.size; ++j)
      if (ring.vertex[i] == ring.vertex[j]) return false;
  return true;
}

inline double face_shape(const Vector3& a, const Vector3& b, const Vector3& c) {
  const double squares = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
  return squares > 0 ? 2 * std::sqrt(3.0) * (b - a).cross(c - a).norm() / squares : 0.0;
}

// Cosine of the largest angle between neighbouring faces before the collapse.
inline double CollapsingSurface::sharpest(Index h, const MergedRing& ring) const {
  double least = 1;
  const auto visit = [&](Index g) {
    for (Index i = 0; i < 3; ++i, g = next(g))
      least = std::min(least, face_normal_[g / 3].dot(face_normal_[twin_[g] / 3]));
  };
  visit(h);
  visit(twin_[h]);
  for (Index i = 0; i < ring.size; ++i) visit(ring.outgoing[i]);
  return least;
}

inline double CollapsingSurface::worst_shape(Index h, const MergedRing& ring) const {
  const auto shape = [&](Index g) {
    return face_shape(position_[origin_[g]], position_[origin_[next(g)]], position_[origin_[prev(g)]]);
  };
  double worst = std::min(shape(h), shape(twin_[h]));
  for (Index i = 0; i < ring.size; ++i) worst = std::min(worst, shape(ring.outgoing[i]));
  return worst;
}

// Also hands out the unit normals of the faces after the collapse.
inline bool CollapsingSurface::permits_shape(Index h, const MergedRing& ring, const Vector3& p,
                                             std::array<Vector3, MergedRing::kCapacity>& normal) const {
  double shape = 1, crease = 1;
  Vector3 to_here = position_[ring.vertex[0]] - p;
  double here = to_here.squaredNorm();
  for (Index i = 0; i < ring.size; ++i) {
    const Vector3 to_there = position_[ring.vertex[i + 1]] - p;
    const double there = to_there.squaredNorm();
    const Vector3 n = to_here.cross(to_there);
    const double twice = n.norm(), squares = here + there + (to_there - to_here).squaredNorm();
    shape = std::min(shape, squares > 0 ? 2 * std::sqrt(3.0) * twice / squares : 0.0);
    normal[i] = twice > 0 ? Vector3(n / twice) : Vector3::Zero();
    const Index f = ring.outgoing[i] / 3;
    const double turn = normal[i].dot(face_normal_[f]);
    if (turn < cos_turn_ && !face_normal_[f].isZero(0)) return false;
    crease = std::min(crease, normal[i].dot(face_normal_[twin_[next(ring.outgoing[i])] / 3]));
    if (i > 0) crease = std::min(crease, normal[i].dot(normal[i - 1]));
    to_here = to_there;
    here = there;
  }
  crease = std::min(crease, normal[0].dot(normal[ring.size - 1]));
  // The allowance lets straight creases be thinned despite rounding.
  if (crease < cos_dihedral_ && crease < sharpest(h, ring) - 1e-3) return false;
  // Here it keeps regular meshes, where shapes before and after are equal, from following the rounding.
  return shape >= options_.least_shape || shape >= worst_shape(h, ring) - 1e-6;
}

// Glues the two neighbours of h's face that lie across its other edges.
inline void CollapsingSurface::remove_face(Index h) {
  const Index s = twin_[next(h)], t = twin_[prev(h)];
  twin_[s] = t;
  twin_[t] = s;
  --valence_[origin_[prev(h)]];
  for (Index i = 3 * (h / 3), end = i + 3; i < end; ++i) origin_[i] = kNone;
  --live_faces_;
}

// Merges the origin of h into its target, where permitted; blocks the edge otherwise.
MSPSKEL_AVX_CLONES inline CollapseOutcome CollapsingSurface::collapse(Index h) {
  if (!permits_counts(h)) return block(h), CollapseOutcome::kRefusedTopology;
  MergedRing ring;
  gather(h, ring);
  if (!permits_link(ring)) return block(h), CollapseOutcome::kRefusedTopology;
  const Index a = origin_[h], b = origin_[next(h)], o = twin_[h];
  Quadric q = quadric_[a];
  q += quadric_[b];
  const Vector3 p = q.least_point(0.5 * (position_[a] + position_[b]));
  std::array<Vector3, MergedRing::kCapacity> normal;
  if (!permits_shape(h, ring, p, normal)) return block(h), CollapseOutcome::kRefusedShape;

  position_[b] = p;
  quadric_[b] = q;
  valence_[b] = ring.size;
  merged_into_[a] = b;
  moved_[a] = moved_[b] = 1;
  --component_size_[component_[a]];
  --live_vertices_;
  for (Index i = 0; i < ring.from_a; ++i) origin_[ring.outgoing[i]] = b;
  remove_face(h);
  remove_face(o);
  for (Index i = 0; i < ring.size; ++i) {
    face_normal_[ring.outgoing[i] / 3] = normal[i];
    stored_cost(ring.outgoing[i]) = kStale;
    unblock(next(ring.outgoing[i]));  // its cost is the same, but it may have been blocked by this one
  }
  return CollapseOutcome::kDone;
}

// Drops dead vertices and faces; the others keep their order.
inline void CollapsingSurface::compact() {
  const auto root = [&](Index v) {
    while (merged_into_[v] != v) v = merged_into_[v] = merged_into_[merged_into_[v]];
    return v;
  };
  for (Index& v : current_)
    if (v != kNone) v = root(v);
  std::vector<Index> renumbered(position_.size(), kNone);
  Index count = 0;
  for (Index v = 0; v < static_cast<Index>(position_.size()); ++v) {
    if (merged_into_[v] != v) continue;
    position_[count] = position_[v];
    quadric_[count] = quadric_[v];
    valence_[count] = valence_[v];
    component_[count] = component_[v];
    renumbered[v] = count++;
  }
  for (Index& v : current_)
    if (v != kNone) v = renumbered[v];
  position_.resize(count);
  quadric_.resize(count);
  valence_.resize(count);
  component_.resize(count);
  moved_.assign(count, 0);
  merged_into_.resize(count);
  std::iota(merged_into_.begin(), merged_into_.end(), 0);

  std::vector<Index> face(face_normal_.size(), kNone);
  Index faces = 0;
  for (Index f = 0; f < static_cast<Index>(face.size()); ++f)
    if (origin_[3 * f] != kNone) face[f] = faces++;
  for (Index f = 0; f < static_cast<Index>(face.size()); ++f) {
    if (face[f] == kNone) continue;
    face_normal_[face[f]] = face_normal_[f];
    for (Index i = 0; i < 3; ++i) {
      const Index from = 3 * f + i, to = 3 * face[f] + i;
      origin_[to] = renumbered[origin_[from]];
      twin_[to] = 3 * face[twin_[from] / 3] + twin_[from] % 3;
      cost_[to] = cost_[from];
    }
  }
  face_normal_.resize(faces);
  origin_.resize(3 * faces);
  twin_.resize(3 * faces);
  cost_.resize(3 * faces);
}

// Numbers vertices by place, and faces and their half-edges by their vertices, so that nothing that walks on
// the surface can depend on how the input was stored, and walks stay within few cache lines.
inline void CollapsingSurface::renumber() {
  const std::vector<Index> order = spatial_order(position_, frame_);
  const Index vertices = static_cast<Index>(order.size()), halfedges = halfedge_count();
  std::vector<Index> rank(order.size());
  std::vector<Vector3> position(order.size());
  for (Index k = 0; k < vertices; ++k) {
    rank[order[k]] = k;
    position[k] = position_[order[k]];
  }
  position_ = std::move(position);
  for (Index& v : current_)
    if (v != kNone) v = rank[v];
  for (Index& v : origin_) v = rank[v];

  std::vector<Index> first;  // each face's half-edge at its smallest vertex
  first.reserve(static_cast<std::size_t>(halfedges / 3));
  for (Index h = 0; h < halfedges; ++h)
    if (origin_[h] < origin_[next(h)] && origin_[h] < origin_[prev(h)]) first.push_back(h);
  std::sort(first.begin(), first.end(), [&](Index g, Index h) {
    return std::pair(origin_[g], origin_[next(g)]) < std::pair(origin_[h], origin_[next(h)]);
  });
  std::vector<Index> place(origin_.size()), origin(origin_.size()), twin(origin_.size());
  Index to = 0;
  for (const Index h : first)
    for (const Index g : {h, next(h), prev(h)}) place[g] = to++;
  for (Index h = 0; h < halfedges; ++h) {
    origin[place[h]] = origin_[h];
    twin[place[h]] = place[twin_[h]];
  }
  origin_ = std::move(origin);
  twin_ = std::move(twin);
}

inline void CollapsingSurface::finish(CoarseSurface& result) {
  compact();
  renumber();
  result.surface.position = std::move(position_);
  result.surface.origin = std::move(origin_);
  result.surface.twin = std::move(twin_);
  result.coarse_vertex = std::move(current_);
  complete_snapshot(result.surface);
}

}  // namespace detail
}  // namespace mspskel
