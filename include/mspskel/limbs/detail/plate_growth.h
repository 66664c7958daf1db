// A plate grown from one of its faces, and how far it stands out of what it is fixed to.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "mspskel/base/watch.h"
#include "mspskel/limbs/detail/convex_hull.h"
#include "mspskel/limbs/detail/growing_parts.h"
#include "mspskel/limbs/detail/limb_search.h"
#include "mspskel/solid/detail/inward_chord.h"

namespace mspskel {
namespace detail {

// A part with parallel sides, thinner than wide, that reaches beyond its root to one side.
struct Plate {
  FoundLimb limb;            // as deep as it stands high on its root; its part is ascending
  bool stands_out = false;   // else it is too low for its width
  bool from_crease = false;  // else from its own end
  bool is_bow = false;       // fixed at two places or more, as a handle or a frame
  Vector3 across = Vector3::Zero(), up = Vector3::Zero();  // unit
  double thickness = 0;
  std::array<double, 2> width{};  // from where to where it extends beside the middle of its root

  // Whether a point lies in the outer half of it, or where that would be if it were a rectangle.
  bool holds_in_outer_half(const Vector3& x) const {
    const Vector3 from_root = x - limb.root, from_end = x - limb.tip.target;
    const double height = from_root.dot(up), along = from_root.dot(across.cross(up));
    return 2 * std::abs(from_end.dot(across)) < thickness && 2 * height >= limb.tip.measures.depth &&
           height <= limb.tip.measures.depth && along >= width[0] && along <= width[1];
  }
};

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
        options_(options),
        half_area_(half_areas_of_components(surface)),
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
    Slab slab;
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
    return measured(slab, faces);
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
  static constexpr double kThin = 0.5;   // its thickness over its width

  struct Slab {
    Vector3 middle = Vector3::Zero(), across = Vector3::Zero();  // a point of its middle plane; unit
    double thickness = 0;
  };
  // Where a plate meets what it stands on, and which way it stands up.
  struct Root {
    Vector3 middle = Vector3::Zero(), up = Vector3::Zero();
    double width = 0;               // across `up`, along the plate
    std::vector<Vector3> vertices;  // of its edges
    bool in_pieces = false;         // none that hangs together is most of it
  };

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
  bool is_wide(const std::vector<Index>& faces, const Slab& slab) const {
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
  double thickness_at(Index f, const Slab& slab) {
    if (is_side(f, slab.across)) return chord(f);
    const Vector3 x = surface_.face_centroid(f) - 0.5 * slab.thickness * normal_[f];
    const double most = kAlike * slab.thickness, one = length_within(x, slab.across, most);
    return one < most ? one + length_within(x, -slab.across, most - one) : one;
  }

  // The faces that hang together with one, where the solid is about as thick as the slab and near its middle.
  // Those that are its sides are marked as tried.
  std::vector<Index> faces_of(const Slab& slab, Index first) {
    constexpr double kReach = 0.75;  // thicknesses
    const auto belongs = [&](Index f) {
      watch_.step();
      if (std::abs(slab.across.dot(surface_.face_centroid(f) - slab.middle)) > kReach * slab.thickness)
        return false;
      const double here = thickness_at(f, slab);
      return here < kAlike * slab.thickness && slab.thickness < kAlike * here;
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
  Slab mean_slab(const Slab& slab, const std::vector<Index>& faces) const {
    Slab mean;
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

  // The faces that have just grown as a plate; nothing where they are none.
  std::optional<Plate> measured(const Slab& slab, const std::vector<Index>& faces) const {
    constexpr double kFree = 0.3, kBelow = 0.3, kStraight = 0.4;  // heights
    constexpr double kSheet = 0.2;
    std::optional<Root> root = find_root(faces, slab.across);
    if (!root) return std::nullopt;
    const PlaneHull hull(root->vertices, slab.across);
    Plate plate;
    FoundLimb& limb = plate.limb;
    limb.part = vertices_of(surface_, faces);
    limb.root = root->middle;
    double area = 0;
    for (const Index f : faces) area += surface_.face_area(f);
    // Up is away from what it is fixed to, which is not away from the middle of that where it goes round a
    // corner.
    PartLevel level;
    Vector3 end = Vector3::Zero();
    const auto measure = [&] {
      root->width = width_of(*root, slab.across);
      level = {height_of(limb.part, *root), area, 2 * (root->width + slab.thickness)};
      end = middle_of_end(faces, *root, level);
    };
    measure();
    const Vector3 beyond = hull.beyond(end);
    if (!(beyond.norm() > 0)) return std::nullopt;
    root->up = beyond.normalized();
    measure();
    double lowest = 0, highest = 0, bottom = 0;
    for (const Vector3& x : root->vertices) {
      lowest = std::min(lowest, height_of(x, *root));
      highest = std::max(highest, height_of(x, *root));
    }
    for (const Index v : limb.part)
      bottom = std::min(bottom, height_of(surface_.position[v], *root) - lowest);
    // A top on legs and a wall between walls are fixed at more sides than one.
    if (hull.beyond(end).norm() < kFree * level.depth || bottom < -kBelow * level.depth ||
        !(level.depth > kLeastTipDepth * options_.smallest) || !is_wide(faces, slab))
      return std::nullopt;
    // Plates that meet have roots round corners, and one of two may be more than half of all. What is thick
    // and so is a body or a bend, and what is fixed in several places is a top on legs.
    const bool straight = highest - lowest <= kStraight * level.depth;
    const bool most = area >= half_area_[surface_.component[limb.part.front()]];
    const bool plain = straight && !most;
    plate.is_bow = root->in_pieces;
    if (slab.thickness > (plain ? kThin : kSheet) * root->width || (plate.is_bow && !plain))
      return std::nullopt;
    plate.stands_out = level.slenderness() >= options_.slenderness && !is_blunt(level.depth_over_mouth());
    // How low it is, is clear only on a straight root.
    if (!plate.stands_out && !straight) return std::nullopt;
    plate.across = slab.across;
    plate.up = root->up;
    plate.thickness = slab.thickness;
    plate.width = extent(limb.part, slab.across.cross(root->up), root->middle);
    set_measures(limb.tip.measures, level, slab.thickness);
    set_end(limb, end, *root, level);
    return plate;
  }

  static double height_of(const Vector3& x, const Root& root) { return (x - root.middle).dot(root.up); }
  double height_of(const std::vector<Index>& part, const Root& root) const {
    double height = 0;
    for (const Index v : part) height = std::max(height, height_of(surface_.position[v], root));
    return height;
  }

  std::array<double, 2> extent(const std::vector<Index>& part, const Vector3& along,
                               const Vector3& from) const {
    std::array<double, 2> range{std::numeric_limits<double>::infinity(),
                                -std::numeric_limits<double>::infinity()};
    for (const Index v : part) {
      const double x = along.dot(surface_.position[v] - from);
      range = {std::min(range[0], x), std::max(range[1], x)};
    }
    return range;
  }

  static double width_of(const Root& root, const Vector3& across) {
    const Vector3 along = across.cross(root.up);
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Vector3& x : root.vertices) {
      low = std::min(low, along.dot(x));
      high = std::max(high, along.dot(x));
    }
    return high - low;
  }

  std::optional<Root> find_root(const std::vector<Index>& faces, const Vector3& across) const {
    constexpr double kMost = 0.75;  // of the root: the rest goes round small gaps
    Root root;
    Vector3 centre = Vector3::Zero();
    double area = 0, length = 0;
    std::vector<std::pair<Index, Index>> edges;
    for (const Index f : faces) {
      const double own = surface_.face_area(f);
      centre += own * surface_.face_centroid(f);
      area += own;
      for (Index h = 3 * f; h < 3 * f + 3; ++h) {
        if (grown_[SurfaceSnapshot::face(surface_.twin[h])] == growth_) continue;
        const double edge = surface_.edge_length(h);
        const Vector3 &a = surface_.position[surface_.origin[h]], &b = surface_.position[surface_.target(h)];
        root.middle += 0.5 * edge * (a + b);
        length += edge;
        root.vertices.push_back(a);
        edges.emplace_back(surface_.origin[h], surface_.target(h));
      }
    }
    if (!(length > 0)) return std::nullopt;
    root.middle /= length;
    root.up = centre / area - root.middle;
    root.up -= root.up.dot(across) * across;
    if (!(root.up.norm() > 0)) return std::nullopt;
    root.up.normalize();
    root.in_pieces = longest_piece(edges) < kMost * length;
    return root;
  }

  // The length of the longest piece of edges that hang together, each given with its ends. They run round
  // faces, so each begins where another one ends.
  double longest_piece(std::vector<std::pair<Index, Index>> edges) const {
    std::sort(edges.begin(), edges.end());
    std::vector<bool> walked(edges.size(), false);
    double longest = 0;
    for (std::size_t first = 0; first < edges.size(); ++first) {
      if (walked[first]) continue;
      double length = 0;
      std::vector<std::size_t> piece{first};
      walked[first] = true;
      for (std::size_t i = 0; i < piece.size(); ++i) {
        const auto [from, to] = edges[piece[i]];
        length += (surface_.position[to] - surface_.position[from]).norm();
        const auto next = std::lower_bound(edges.begin(), edges.end(), std::pair(to, Index(0)));
        for (auto k = static_cast<std::size_t>(next - edges.begin());
             k < edges.size() && edges[k].first == to; ++k) {
          if (walked[k]) continue;
          walked[k] = true;
          piece.push_back(k);
        }
      }
      longest = std::max(longest, length);
    }
    return longest;
  }

  // The half width of a plate is that across it: centring moves an arc freely along it, so that only this
  // tells when a leaf has strayed from the middle of the end.
  static void set_measures(LimbMeasures& m, const PartLevel& level, double thickness) {
    m.depth = level.depth;
    m.slenderness = level.slenderness();
    m.depth_over_mouth = level.depth_over_mouth();
    m.half_width = m.half_chord = m.half_thickness = 0.5 * thickness;
  }

  // How deep the end of a plate is, in so many radii of a tube of its area and height.
  static double depth_of_end(const PartLevel& level, double radii) {
    return std::min(0.5 * level.depth, radii * level.depth / level.slenderness());
  }

  Vector3 middle_of_end(const std::vector<Index>& faces, const Root& root, const PartLevel& level) const {
    const double end = depth_of_end(level, kEnd);
    Vector3 middle = Vector3::Zero();
    double area = 0;
    for (const Index f : faces) {
      if (height_of(surface_.face_centroid(f), root) < level.depth - end) continue;
      const double own = surface_.face_area(f);
      middle += own * surface_.face_centroid(f);
      area += own;
    }
    return area > 0 ? Vector3(middle / area) : Vector3(root.middle + level.depth * root.up);
  }

  // The cap, the target in the middle of the end, and the vertex that is nearest above it.
  void set_end(FoundLimb& limb, const Vector3& middle, const Root& root, const PartLevel& level) const {
    LimbTip& tip = limb.tip;
    tip.target = middle;
    const Vector3 top = middle + depth_of_end(level, kEnd) * root.up;
    for (const Index v : limb.part) {
      if (height_of(surface_.position[v], root) < level.depth - depth_of_end(level, kTipCap)) continue;
      tip.cap.push_back(v);
      const auto away = [&](Index w) { return (surface_.position[w] - top).squaredNorm(); };
      if (tip.vertex == kNone || away(v) < away(tip.vertex)) tip.vertex = v;
    }
  }

  const SurfaceSnapshot& surface_;
  const BoundingVolumeHierarchy& solid_;
  const LimbOptions& options_;
  std::vector<double> half_area_;  // of each component
  std::vector<Vector3> normal_;    // of each face
  std::vector<bool> tried_;        // faces of sides that have grown
  std::vector<Index> grown_;       // the last growth that it belongs to
  std::vector<Index> asked_;       // the last growth that came by
  Index growth_ = 0;
  std::size_t work_ = 0;       // faces that plates came by
  std::vector<double> chord_;  // inward from each face; negative where it was not asked for
  Watch watch_;
};

}  // namespace detail
}  // namespace mspskel
