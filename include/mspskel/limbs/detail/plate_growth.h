// A plate grown from one of its faces.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "mspskel/base/watch.h"
#include "mspskel/limbs/detail/plate_measurement.h"
#include "mspskel/solid/detail/inward_chord.h"

namespace mspskel {
namespace detail {

// The vertices where a finite value is more than `least` and no less than at their neighbours, the greatest
// first. O(vertices log vertices).
inline std::vector<Index> greatest_of_neighbours(const SurfaceSnapshot& surface,
                                                 const std::vector<double>& value, double least) {
  std::vector<Index> tops;
  for (Index v = 0; v < surface.vertex_count(); ++v) {
    if (surface.vertex_halfedge[v] == kNone || !(value[v] > least) || !std::isfinite(value[v])) continue;
    bool greatest = true;
    for_each_neighbour(surface, v, [&](Index w) { greatest = greatest && value[w] <= value[v]; });
    if (greatest) tops.push_back(v);
  }
  std::sort(tops.begin(), tops.end(),
            [&](Index a, Index b) { return value[a] != value[b] ? value[a] > value[b] : a < b; });
  return tops;
}

// A plate is all faces that hang together where the solid is about as thick, across its sides, as at the face
// that it grows from: the sides themselves and the rim between them. Its root is where they end, because the
// solid is thicker there or turns another way: at what carries it, and where it meets another plate. What
// lies beyond the convex hull of its root is free.
class PlateGrowth {
 public:
  PlateGrowth(const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
              const LimbOptions& options, const ProgressCallback& progress)
      : surface_(surface),
        solid_(solid),
        measurement_(surface, options),
        tried_(static_cast<std::size_t>(surface.face_count()), false),
        grown_(tried_.size(), 0),
        asked_(tried_.size(), 0),
        chord_(tried_.size(), -1.0),
        watch_(progress, "arcs") {
    for (Index f = 0; f < surface.face_count(); ++f)
      normal_.push_back(surface.face_normal_times_twice_area(f).normalized());
  }

  // The plate that a face is a side of, if it is one and less thick than `most`. A face that was a side of an
  // earlier one gives none, and none does after kWork times the faces. Throws Cancelled. Cost: up to two rays
  // a face of the plate, and O(its vertices log vertices).
  std::optional<Plate> grow(Index side, double most) {
    constexpr int kTimes = 3;
    constexpr std::size_t kLeastFaces = 16, kWork = 16;
    if (tried_[side] || work_ > kWork * tried_.size()) return std::nullopt;
    tried_[side] = true;
    PlateSlab slab;
    slab.across = normal_[side];
    slab.thickness = chord(side);
    slab.middle = surface_.face_centroid(side) - 0.5 * slab.thickness * slab.across;
    if (!(slab.thickness > 0) || slab.thickness > most) return std::nullopt;
    std::vector<Index> faces = faces_of(slab, side);
    if (faces.size() < kLeastFaces) return std::nullopt;
    for (int i = 1; i < kTimes; ++i) {
      slab = mean_slab(slab, faces);
      std::vector<Index> again = faces_of(slab, side);
      const bool same = again.size() == faces.size();
      faces = std::move(again);
      if (same) break;
    }
    if (faces.size() < kLeastFaces) return std::nullopt;
    fill_gaps(faces);
    std::optional<Plate> plate = measurement_.run(slab, faces, [&](Index f) { return grown_[f] == growth_; });
    if (plate && (goes_on_bent(faces, slab) || !is_wide(faces, slab))) return std::nullopt;
    return plate;
  }

  // The same from a vertex of its rim.
  std::optional<Plate> grow_at(Index v, double most) {
    const Index side = side_near(v);
    if (side == kNone || tried_[side] || chord(side) > most || !is_wide_inward(side, -surface_.normal[v]))
      return std::nullopt;
    return grow(side, most);
  }

  const Vector3& normal(Index f) const { return normal_[f]; }

 private:
  static constexpr double kAlike = 1.5;  // two thicknesses of one plate

  static bool are_alike(double one, double other) { return one < kAlike * other && other < kAlike * one; }

  // Whether the solid is as thick across at a point of the middle plane.
  bool is_as_thick(const Vector3& x, const Vector3& across, double thickness) const {
    const double most = kAlike * thickness;
    const double here = length_within(x, across, most) + length_within(x, -across, most);
    return here <= most && here * kAlike >= thickness;
  }

  // Whether it is so on both sides of the way inward from a face near the rim: where it is not, as in the end
  // of a tube, nothing needs to grow.
  bool is_wide_inward(Index side, const Vector3& inward) {
    const Vector3& across = normal_[side];
    const double thickness = chord(side);
    Vector3 along = inward - inward.dot(across) * across;
    if (!(thickness > 0) || !(along.norm() > 0)) return false;
    along.normalize();
    const Vector3 x = surface_.face_centroid(side) - 0.5 * thickness * across + thickness * along,
                  beside = thickness * across.cross(along);
    return is_as_thick(x + beside, across, thickness) && is_as_thick(x - beside, across, thickness);
  }

  // Whether a slab is wider than thick nearly everywhere, and not only as a whole, as tubes that fork in one
  // plane are: whichever way one goes from its sides along it, it goes on there or the opposite way. At most
  // sixteen rays for each of some of the faces.
  bool is_wide(const std::vector<Index>& faces, const PlateSlab& slab) const {
    constexpr std::size_t kSample = 64;
    constexpr double kBeside = 0.9;  // thicknesses; in a square bar four fifths are nearer to the middle
    constexpr double kShare = 0.5;   // of the area of the sides
    constexpr int kWays = 4;
    const Vector3 one = slab.across.unitOrthogonal(), other = slab.across.cross(one);
    const auto goes_on = [&](const Vector3& x, int way) {
      const double angle = kPi * way / kWays;
      const Vector3 beside = kBeside * slab.thickness * (std::cos(angle) * one + std::sin(angle) * other);
      return is_as_thick(x + beside, slab.across, slab.thickness) ||
             is_as_thick(x - beside, slab.across, slab.thickness);
    };
    double sides = 0, wide = 0;
    for (std::size_t i = 0; i < faces.size(); i += 1 + faces.size() / kSample) {
      if (!is_side(faces[i], slab.across)) continue;
      const double area = surface_.face_area(faces[i]);
      const Vector3 x = surface_.face_centroid(faces[i]);
      const Vector3 middle = x - slab.across.dot(x - slab.middle) * slab.across;
      sides += area;
      int ways = 0;
      while (ways < kWays && goes_on(middle, ways)) ++ways;
      if (ways == kWays) wide += area;
    }
    return wide >= kShare * sides;
  }

  // Whether most of where the faces of a plate end is no root: the surface goes on without an edge and the
  // solid is as thick there, so that they are a piece of a bent sheet. A ray for each face beyond.
  bool goes_on_bent(const std::vector<Index>& faces, const PlateSlab& slab) {
    constexpr double kSmooth = 0.85, kMost = 0.5;
    double length = 0, bent = 0;
    for (const Index f : faces)
      for (Index h = 3 * f; h < 3 * f + 3; ++h) {
        const Index beyond = SurfaceSnapshot::face(surface_.twin[h]);
        if (grown_[beyond] == growth_) continue;
        const double edge = surface_.edge_length(h);
        length += edge;
        if (normal_[f].dot(normal_[beyond]) >= kSmooth && are_alike(chord(beyond), slab.thickness))
          bent += edge;
      }
    return bent > kMost * length;
  }

  // A face of the side of a plate that a vertex is on the rim of: where the ball inward of it, as wide as it
  // is deep, has outgrown the plate, the surface is nearest across it. The rim's own faces lie aslant. kNone
  // where no ball inward of it does. A few questions for the nearest place.
  Index side_near(Index v) const {
    constexpr double kWider = 1.25, kMost = 1.0;  // step; the frame's unit
    double depth = kMost;
    for_each_neighbour(surface_, v, [&](Index w) {
      depth = std::min(depth, 0.5 * (surface_.position[w] - surface_.position[v]).norm());
    });
    for (; depth > 0 && depth < kMost; depth *= kWider) {
      const Vector3 x = surface_.position[v] - depth * surface_.normal[v];
      if (!solid_.inside(x)) return kNone;
      const ClosestPoint nearest = solid_.closest(x, 0.5 * depth);
      if (nearest.face != kNone) return face_at(v, nearest.point, nearest.point - x);
    }
    return kNone;
  }

  // The face at the vertex nearest to a point, on the way from v, that faces a direction most.
  Index face_at(Index v, const Vector3& point, const Vector3& direction) const {
    const auto away = [&](Index w) { return (surface_.position[w] - point).squaredNorm(); };
    for (Index last = kNone; last != v;) {
      last = v;
      for_each_neighbour(surface_, last, [&](Index w) {
        if (away(w) < away(v)) v = w;
      });
    }
    const Index first = surface_.vertex_halfedge[v];
    Index best = SurfaceSnapshot::face(first);
    for (Index h = surface_.next_outgoing(first); h != first; h = surface_.next_outgoing(h))
      if (const Index f = SurfaceSnapshot::face(h); normal_[f].dot(direction) > normal_[best].dot(direction))
        best = f;
    return best;
  }

  // From a point in the solid to its surface; infinity where that is farther than `most`.
  double length_within(const Vector3& x, const Vector3& direction, double most) const {
    const auto hit = solid_.first_hit(x, direction, most);
    return hit ? hit->distance : std::numeric_limits<double>::infinity();
  }

  // Of the solid inward from a face; 0 if there is none.
  double chord(Index f) {
    if (chord_[f] < 0) {
      const auto chord = inward_chord(solid_, surface_.face_centroid(f), -normal_[f]);
      chord_[f] = chord ? chord->length : 0.0;
    }
    return chord_[f];
  }

  // Whether the sides of a plate run along a face.
  bool is_side(Index f, const Vector3& across) const {
    constexpr double kParallel = 0.85;
    return std::abs(normal_[f].dot(across)) >= kParallel;
  }

  // How thick the solid is across a plate, below a face of its side or behind a face of its rim.
  double thickness_at(Index f, const PlateSlab& slab) {
    if (is_side(f, slab.across)) return chord(f);
    const Vector3 x = surface_.face_centroid(f) - 0.5 * slab.thickness * normal_[f];
    const double most = kAlike * slab.thickness, one = length_within(x, slab.across, most);
    return one < most ? one + length_within(x, -slab.across, most - one) : one;
  }

  // The faces that hang together with one, where the solid is about as thick as the slab and near its middle.
  // Those that are its sides are marked as tried.
  std::vector<Index> faces_of(const PlateSlab& slab, Index first) {
    constexpr double kReach = 0.75;  // thicknesses
    const auto belongs = [&](Index f) {
      watch_.step();
      if (std::abs(slab.across.dot(surface_.face_centroid(f) - slab.middle)) > kReach * slab.thickness)
        return false;
      const double here = thickness_at(f, slab);
      return are_alike(here, slab.thickness);
    };
    std::vector<Index> faces{first};
    grown_[first] = asked_[first] = ++growth_;
    for (std::size_t i = 0; i < faces.size(); ++i)
      for (Index h = 3 * faces[i]; h < 3 * faces[i] + 3; ++h) {
        const Index f = SurfaceSnapshot::face(surface_.twin[h]);
        if (std::exchange(asked_[f], growth_) == growth_ || !belongs(f)) continue;
        grown_[f] = growth_;
        if (is_side(f, slab.across)) tried_[f] = true;
        faces.push_back(f);
      }
    work_ += faces.size();
    return faces;
  }

  // Adds what lies in gaps of the faces that have just grown, as a rough surface leaves them: what hangs
  // together outside and is small.
  void fill_gaps(std::vector<Index>& faces) {
    constexpr std::size_t kSmall = 20;  // as a share: one in so many faces
    const std::size_t most = faces.size() / kSmall;
    if (most == 0) return;
    const Index plate = growth_;
    std::vector<Index> flood;
    // Whether a flood from its first face stays small. It stops where an earlier one came by that did not.
    const auto is_gap = [&] {
      grown_[flood.front()] = ++growth_;
      for (std::size_t k = 0; k < flood.size(); ++k)
        for (Index h = 3 * flood[k]; h < 3 * flood[k] + 3; ++h) {
          const Index f = SurfaceSnapshot::face(surface_.twin[h]);
          if (grown_[f] == plate || grown_[f] == growth_) continue;
          if (grown_[f] > plate || flood.size() >= most) return false;
          grown_[f] = growth_;
          flood.push_back(f);
        }
      return true;
    };
    const std::size_t count = faces.size();
    for (std::size_t i = 0; i < count; ++i)
      for (Index h = 3 * faces[i]; h < 3 * faces[i] + 3; ++h) {
        const Index across = SurfaceSnapshot::face(surface_.twin[h]);
        if (grown_[across] >= plate) continue;
        flood.assign(1, across);
        if (!is_gap()) continue;
        for (const Index f : flood) grown_[f] = plate;
        faces.insert(faces.end(), flood.begin(), flood.end());
      }
    ++growth_;
    for (const Index f : faces) grown_[f] = growth_;
  }

  // The same slab as all of these faces show it: one of a noisy surface may lie aslant.
  PlateSlab mean_slab(const PlateSlab& slab, const std::vector<Index>& faces) const {
    PlateSlab mean;
    mean.across = mean.middle = Vector3::Zero();
    std::array<double, 2> area{};
    std::array<Vector3, 2> place{Vector3::Zero(), Vector3::Zero()};
    for (const Index f : faces) {
      if (!is_side(f, slab.across)) continue;
      const std::size_t side = normal_[f].dot(slab.across) > 0 ? 1 : 0;
      const Vector3 normal = surface_.face_normal_times_twice_area(f);
      mean.across += side ? normal : Vector3(-normal);
      area[side] += normal.norm();
      place[side] += normal.norm() * surface_.face_centroid(f);
    }
    if (!(area[0] > 0 && area[1] > 0)) return slab;
    mean.across.normalize();
    mean.middle = 0.5 * (place[0] / area[0] + place[1] / area[1]);
    mean.thickness = mean.across.dot(place[1] / area[1] - place[0] / area[0]);
    return mean.thickness > 0 ? mean : slab;
  }

  const SurfaceSnapshot& surface_;
  const BoundingVolumeHierarchy& solid_;
  PlateMeasurement measurement_;
  std::vector<Vector3> normal_;  // of each face
  std::vector<bool> tried_;      // faces of sides that have grown
  std::vector<Index> grown_;     // the last growth that it belongs to
  std::vector<Index> asked_;     // the last growth that came by
  Index growth_ = 0;
  std::size_t work_ = 0;       // faces that plates came by
  std::vector<double> chord_;  // inward from each face; negative where it was not asked for
  Watch watch_;
};

}  // namespace detail
}  // namespace mspskel
