// Points inside the solid that stand for the vertices of its surface, and the labels of the ways to them.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <memory>
#include <optional>
#include <vector>

#include "mspskel/collapse/crossing_labels.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/mesh/surface_snapshot.h"
#include "mspskel/solid/detail/inward_chord.h"

namespace mspskel {
namespace detail {

// Points inside the solid for each vertex of the surface: the middle of its inward chord, and one just below
// the surface. Found when first asked for, by any thread: two that ask at once find the same, and the first
// one's stays.
//
// Labels of ways begin at the vertex where cocycles are regions. A linking number cannot: its loop may pass
// through the vertex. It begins at the point just below, and is carried from vertex to vertex by the straight
// steps between these.
class ChordPoints {
 public:
  enum Layer { kMiddle, kShallow };
  struct Point {
    Vector3 x = Vector3::Zero();
    double clearance = 0.0;  // a lower bound of the distance to the surface; 0: x is the vertex itself
    CocycleLabel from_vertex;
  };

  ChordPoints(const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
              const CrossingLabels& crossings)
      : surface_(surface), solid_(solid), crossings_(crossings), below_(surface.position.size()) {}

  // The label's entries whose cocycles are regions, or the other ones.
  CocycleLabel part(const CocycleLabel& label, bool of_regions) const {
    CocycleLabel result;
    for (const auto& [index, value] : label.entries())
      if (crossings_.is_region(index) == of_regions) result += CocycleLabel::unit(index, value);
    return result;
  }
  // Of the straight way from the vertex, which x sees.
  CocycleLabel from_vertex(Index v, const Vector3& x) const {
    const Vector3& position = surface_.position[v];
    const CocycleLabel label = crossings_(position, x);
    if (!crossings_.has_loops()) return label;
    return part(label, true) + part(crossings_(base(v), x), false);
  }
  // Linking numbers of the step along the half-edge below the surface.
  CocycleLabel below(Index h) const {
    return part(crossings_(base(surface_.origin[h]), base(surface_.target(h))), false);
  }

  // Whether that step has its ends below the surface and stays inside.
  bool stays_below(Index h) const {
    const Point &a = (*this)(surface_.origin[h], kShallow), &b = (*this)(surface_.target(h), kShallow);
    return a.clearance > 0 && b.clearance > 0 && !solid_.segment_crosses(a.x, b.x);
  }

  const Point& operator()(Index v, Layer layer) const {
    return below_[v].point[layer].get([&] {
      Point point;
      point.x = surface_.position[v];
      if (const std::optional<InwardChord>& chord = chord_of(v)) place(v, layer, *chord, point);
      return point;
    });
  }

 private:
  // A value that is found when first asked for.
  template <class T>
  class Once {
   public:
    Once() = default;
    Once(const Once&) = delete;
    Once& operator=(const Once&) = delete;
    ~Once() { delete known_.load(); }
    template <class Find>
    const T& get(Find find) const {
      if (const T* known = known_.load(std::memory_order_acquire)) return *known;
      auto found = std::make_unique<const T>(find());
      const T* first = nullptr;
      return known_.compare_exchange_strong(first, found.get()) ? *found.release() : *first;
    }

   private:
    mutable std::atomic<const T*> known_{nullptr};
  };
  // What is known of a vertex.
  struct Below {
    Once<std::optional<InwardChord>> chord;
    std::array<Once<Point>, 2> point;  // by layer
  };

  const std::optional<InwardChord>& chord_of(Index v) const {
    return below_[v].chord.get([&]() -> std::optional<InwardChord> {
      if (surface_.vertex_halfedge[v] == kNone) return std::nullopt;
      return inward_chord(surface_, solid_, v);
    });
  }

  void place(Index v, Layer layer, const InwardChord& chord, Point& point) const {
    constexpr double kShallowShare = 0.05, kOfEdge = 0.02;
    const Vector3& position = surface_.position[v];
    double depth = 0.5 * chord.length;
    if (layer == kShallow)
      for_each_neighbour(surface_, v, [&](Index w) {
        depth = std::min(
            {depth, kShallowShare * chord.length, kOfEdge * (surface_.position[w] - position).norm()});
      });
    if (!(depth > 0)) return;
    const Vector3 x = chord.start - depth * surface_.normal[v];
    point.x = x;
    point.clearance = std::min(depth, solid_.closest(point.x, depth).distance);
    if (layer == kMiddle || !crossings_.has_loops())
      point.from_vertex = from_vertex(v, point.x);
    else
      point.from_vertex = part(crossings_(position, point.x), true);
  }
  Vector3 base(Index v) const {
    const Point& shallow = (*this)(v, kShallow);
    return shallow.clearance > 0 ? shallow.x : surface_.position[v];
  }

  const SurfaceSnapshot& surface_;
  const BoundingVolumeHierarchy& solid_;
  const CrossingLabels& crossings_;
  std::vector<Below> below_;  // per vertex
};

}  // namespace detail
}  // namespace mspskel
