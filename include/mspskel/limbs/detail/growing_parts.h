// The connected parts of a surface beyond a distance that falls.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "mspskel/mesh/component_areas.h"
#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {
namespace detail {

// Half of the area of each component: a part that has more is the body.
inline std::vector<double> half_areas_of_components(const SurfaceSnapshot& surface) {
  std::vector<double> half = component_areas(surface);
  for (double& area : half) area *= 0.5;
  return half;
}

// The vertices of some faces, ascending.
inline std::vector<Index> vertices_of(const SurfaceSnapshot& surface, const std::vector<Index>& faces) {
  std::vector<Index> vertices;
  for (const Index f : faces)
    vertices.insert(vertices.end(), surface.origin.begin() + 3 * f, surface.origin.begin() + 3 * f + 3);
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

// Parts begin at the maxima of the distance, grow as it falls, and meet at saddles, where the one with the
// higher top takes the other: how long a part is on its own is the persistence of its maximum. Notes is what
// the caller knows of a part. Only the given vertices count.
template <class Notes>
class GrowingParts {
 public:
  struct Part {
    Index top = kNone;
    Notes notes;
    std::vector<Index> vertices;
  };

  // `place` is scratch memory for every vertex of the surface: kNone, and so again when this goes.
  GrowingParts(const SurfaceSnapshot& surface, const std::vector<double>& distance,
               std::vector<Index> vertices, std::vector<Index>& place)
      : surface_(surface), distance_(distance), order_(std::move(vertices)), place_(place) {
    std::sort(order_.begin(), order_.end(), [&](Index a, Index b) {
      return distance_[a] != distance_[b] ? distance_[a] > distance_[b] : a < b;
    });
    parent_.resize(order_.size());
    part_.resize(order_.size());
  }
  ~GrowingParts() {
    for (const Index v : order_) place_[v] = kNone;
  }
  GrowingParts(const GrowingParts&) = delete;
  GrowingParts& operator=(const GrowingParts&) = delete;

  // Calls meet(high, low, saddle) before the part `high` takes the part `low`, and join(part, vertex) after
  // the vertex has joined the part. Cost: O(vertices log vertices).
  template <class Meet, class Join>
  void grow(Meet meet, Join join) {
    for (std::size_t i = 0; i < order_.size(); ++i) join(add(static_cast<Index>(i), meet), order_[i]);
  }

  // The parts that no other one took: one of each connected set of the vertices.
  template <class Visit>
  void for_each_left(Visit visit) {
    for (std::size_t i = 0; i < order_.size(); ++i)
      if (parent_[i] == static_cast<Index>(i)) visit(part_[i]);
  }

 private:
  Index root(Index i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  template <class Meet>
  Part& add(Index i, Meet& meet) {
    const Index v = order_[i];
    place_[v] = parent_[i] = i;
    roots_.clear();
    for_each_neighbour(surface_, v, [&](Index w) {
      if (place_[w] == kNone || w == v) return;
      const Index r = root(place_[w]);
      if (std::find(roots_.begin(), roots_.end(), r) == roots_.end()) roots_.push_back(r);
    });
    std::sort(roots_.begin(), roots_.end());  // each is the place of its part's top
    for (std::size_t k = 1; k < roots_.size(); ++k) {
      Part &high = part_[roots_[0]], &low = part_[roots_[k]];
      meet(high, low, v);
      if (low.vertices.size() > high.vertices.size()) std::swap(high.vertices, low.vertices);
      high.vertices.insert(high.vertices.end(), low.vertices.begin(), low.vertices.end());
      std::vector<Index>().swap(low.vertices);
      parent_[roots_[k]] = roots_[0];
    }
    const Index into = roots_.empty() ? i : roots_[0];
    if (into == i) part_[i].top = v;
    part_[into].vertices.push_back(v);
    parent_[i] = into;
    return part_[into];
  }

  const SurfaceSnapshot& surface_;
  const std::vector<double>& distance_;
  std::vector<Index> order_;   // by falling distance
  std::vector<Index>& place_;  // of each vertex in that order; kNone: not yet beyond
  std::vector<Index> parent_;  // of each place
  std::vector<Part> part_;     // of each root
  std::vector<Index> roots_;
};

}  // namespace detail
}  // namespace mspskel
