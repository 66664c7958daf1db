// How a part of a surface beyond a level widens from its tip to its mouth.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {
namespace detail {

// Of the surface beyond a level, with the triangles cut where they cross it.
struct PartShape {
  double area = 0;
  double mean_depth = 0;  // below the top
  double mouth = 0;       // the length of the level's contour
  double span = 0;        // the area that the contour goes round, as the plane that sees most of it does
  Vector3 centre = Vector3::Zero();  // the mean of its places
};

// The middle of the surface between two levels, of what lies beyond the lower and beyond the higher one;
// nothing where there is none.
inline std::optional<Vector3> middle_between(const PartShape& low, const PartShape& high) {
  if (!(low.area > high.area)) return std::nullopt;
  return Vector3((low.area * low.centre - high.area * high.centre) / (low.area - high.area));
}

class PartShapeSum {
 public:
  PartShapeSum(const SurfaceSnapshot& surface, const std::vector<double>& distance, double level)
      : surface_(surface), distance_(distance), level_(level) {}

  // Adds the triangles of which v is the farthest corner. All of the part's vertices together count each
  // once.
  void add_vertex(Index v) {
    const auto less_far = [&](Index w) {
      return distance_[w] != distance_[v] ? distance_[w] < distance_[v] : w > v;
    };
    const Index first = surface_.vertex_halfedge[v];
    Index h = first;
    do {
      const Index a = surface_.target(h), b = surface_.apex(h);
      if (less_far(a) && less_far(b)) add_triangle({v, a, b});
      h = surface_.next_outgoing(h);
    } while (h != first);
  }

  PartShape shape(double top) const {
    if (!(area_ > 0)) return {0, 0, mouth_, span_.norm(), Vector3::Zero()};
    return {area_, top - moment_ / area_, mouth_, span_.norm(), places_ / area_};
  }

 private:
  struct Corner {
    Vector3 position;
    double distance;
  };

  void add_triangle(const std::array<Index, 3>& vertices) {
    std::array<Corner, 4> cut;
    std::array<Vector3, 2> rim;
    std::size_t corners = 0, crossings = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Corner a = at(vertices[k]), b = at(vertices[(k + 1) % 3]);
      const bool a_beyond = a.distance >= level_, b_beyond = b.distance >= level_;
      if (a_beyond) cut[corners++] = a;
      if (a_beyond == b_beyond) continue;
      const double share = (level_ - a.distance) / (b.distance - a.distance);
      rim[crossings++] = a.position + share * (b.position - a.position);
      cut[corners++] = {rim[crossings - 1], level_};
    }
    if (crossings == 2) mouth_ += (rim[1] - rim[0]).norm();
    for (std::size_t k = 2; k < corners; ++k) {
      const Vector3 across =
          0.5 * (cut[k - 1].position - cut[0].position).cross(cut[k].position - cut[0].position);
      const double area = across.norm();
      area_ += area;
      span_ += across;  // what a closed contour goes round is the same of all surfaces in it
      moment_ += area * (cut[0].distance + cut[k - 1].distance + cut[k].distance) / 3;
      places_ += area / 3 * (cut[0].position + cut[k - 1].position + cut[k].position);
    }
  }

  Corner at(Index v) const { return {surface_.position[v], distance_[v]}; }

  const SurfaceSnapshot& surface_;
  const std::vector<double>& distance_;
  double level_;
  double area_ = 0, moment_ = 0, mouth_ = 0;
  Vector3 span_ = Vector3::Zero(), places_ = Vector3::Zero();
};

}  // namespace detail
}  // namespace mspskel
