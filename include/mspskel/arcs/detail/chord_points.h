// Points inside the solid that stand for the vertices of its surface, and the labels of the ways to them.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <unordered_map>
#include <utility>

#include "mspskel/collapse/crossing_labels.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/mesh/surface_snapshot.h"
#include "mspskel/solid/detail/inward_chord.h"

namespace mspskel {
namespace detail {

// Points inside the solid for each vertex of the surface: the middle of its inward chord, and one just below
// the surface. Found when first asked for.
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
      : surface_(surface), solid_(solid), crossings_(crossings) {}

  // The label's entries whose cocycles are regions, or the other ones.
  CocycleLabel part(const CocycleLabel& label, bool of_regions) const {
    CocycleLabel result;
    for (const auto& [index, value] : label.entries())
      if (crossings_.is_region(index) == of_regions) result += CocycleLabel::unit(index, value);
    return result;
  }
  // Of the straight way from the vertex, which x sees.
  CocycleLabel from_vertex(Index v, const Vector3& x) {
    const Vector3& position = surface_.position[v];
    const CocycleLabel label = crossings_(position, x);
    if (!crossings_.has_loops()) return label;
    return part(label, true) + part(crossings_(base(v), x), false);
  }
  // Linking numbers of the step along the half-edge below the surface.
  CocycleLabel below(Index h) {
    return part(crossings_(base(surface_.origin[h]), base(surface_.target(h))), false);
  }

  // Whether that step has its ends below the surface and stays inside.
  bool stays_below(Index h) {
    const Point &a = (*this)(surface_.origin[h], kShallow), &b = (*this)(surface_.target(h), kShallow);
    return a.clearance > 0 && b.clearance > 0 && !solid_.segment_crosses(a.x, b.x);
  }

  const Point& operator()(Index v, Layer layer) {
    Below& at = below_.try_emplace(v).first->second;
    std::optional<Point>& known = at.point[layer];
    if (known) return *known;
    if (!at.looked && surface_.vertex_halfedge[v] != kNone) at.chord = inward_chord(surface_, solid_, v);
    at.looked = true;
    Point point;
    point.x = surface_.position[v];
    if (at.chord) place(v, layer, *at.chord, point);
    known = std::move(point);
    return *known;
  }

 private:
  // What is known of a vertex.
  struct Below {
    bool looked = false;  // for its chord
    std::optional<InwardChord> chord;
    std::array<std::optional<Point>, 2> point;  // by layer
  };

  void place(Index v, Layer layer, const InwardChord& chord, Point& point) {
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
  Vector3 base(Index v) {
    const Point& shallow = (*this)(v, kShallow);
    return shallow.clearance > 0 ? shallow.x : surface_.position[v];
  }

  const SurfaceSnapshot& surface_;
  const BoundingVolumeHierarchy& solid_;
  const CrossingLabels& crossings_;
  std::unordered_map<Index, Below> below_;  // each stays where it is while others come in
};

}  // namespace detail
}  // namespace mspskel
