// Plates that stand on something else: the back of a chair, a flange, a fin of sheet metal.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "mspskel/base/watch.h"
#include "mspskel/limbs/detail/growing_parts.h"
#include "mspskel/limbs/detail/limb_search.h"
#include "mspskel/solid/detail/inward_chord.h"

namespace mspskel {
namespace detail {

// A part with parallel sides, thinner than wide, that leaves the rest along a straight root.
struct Plate {
  FoundLimb limb;           // as deep as it stands high on its root; its part is ascending
  bool stands_out = false;  // else it is too low for its width
};

// Levels of a distance from afar cut a plate aslant: its corners are farthest, and those look like the
// corners of any slab. Its root tells it from them. There the surface turns in sharply, and the solid is no
// more as thick as the plate. So a plate grows from such an edge over all faces where the solid is about as
// thick, across its sides, as at the edge: the sides themselves and the rim between them.
class PlateSearch {
 public:
  PlateSearch(const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
              const LimbOptions& options, const ProgressCallback& progress)
      : surface_(surface),
        solid_(solid),
        options_(options),
        half_area_(half_areas_of_components(surface)),
        tried_(static_cast<std::size_t>(surface.face_count()), false),
        grown_(tried_.size(), 0),
        chord_(tried_.size(), -1.0),
        watch_(progress, "arcs") {
    for (Index f = 0; f < surface.face_count(); ++f)
      normal_.push_back(surface.face_normal_times_twice_area(f).normalized());
  }

  // Throws Cancelled. Cost: up to two rays a face that a plate comes by, at most kWork times the faces;
  // nothing where no edge is sharp.
  std::vector<Plate> run() {
    constexpr std::size_t kWork = 16;
    std::vector<Plate> plates;
    for (const auto& [h, length] : creases()) {
      const Index side = SurfaceSnapshot::face(h);
      if (tried_[side] || work_ > kWork * tried_.size()) continue;
      if (std::optional<Plate> plate = grow(side, length)) plates.push_back(std::move(*plate));
    }
    return plates;
  }

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
    double width = 0;       // across `up`, along the plate
    double unevenness = 0;  // along `up`
  };

  bool is_sharp_inward(Index h) const {
    constexpr double kSharp = 0.64;  // the cosine of 50 degrees
    const Vector3 &a = normal_[SurfaceSnapshot::face(h)],
                  &b = normal_[SurfaceSnapshot::face(surface_.twin[h])];
    const Vector3 along = surface_.position[surface_.target(h)] - surface_.position[surface_.origin[h]];
    return a.dot(b) < kSharp && a.cross(b).dot(along) < 0;
  }

  // The half-edges of sharp inward edges, each with the length of the crease that it is a part of: of all
  // that hang together with it.
  std::vector<std::pair<Index, double>> creases() {
    std::vector<std::pair<Index, double>> edges;
    std::vector<bool> walked(static_cast<std::size_t>(surface_.halfedge_count()), false);
    for (Index first = 0; first < surface_.halfedge_count(); ++first) {
      if (walked[first] || !is_sharp_inward(first)) continue;
      const std::size_t begin = edges.size();
      double length = 0;
      const auto add = [&](Index h) {
        if (walked[h] || !is_sharp_inward(h)) return;
        walked[h] = walked[surface_.twin[h]] = true;
        length += surface_.edge_length(h);
        edges.emplace_back(h, 0.0);
        edges.emplace_back(surface_.twin[h], 0.0);
      };
      add(first);
      for (std::size_t i = begin; i < edges.size(); ++i) {
        const Index from = edges[i].first;
        for (Index h = surface_.next_outgoing(from); h != from; h = surface_.next_outgoing(h)) add(h);
      }
      for (std::size_t i = begin; i < edges.size(); ++i) edges[i].second = length;
    }
    return edges;
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
  // None that are its sides are tried again.
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
    grown_[first] = ++growth_;
    for (std::size_t i = 0; i < faces.size(); ++i)
      for (Index h = 3 * faces[i]; h < 3 * faces[i] + 3; ++h) {
        const Index f = SurfaceSnapshot::face(surface_.twin[h]);
        if (grown_[f] == growth_ || !belongs(f)) continue;
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

  // From a face beside a crease of that length.
  std::optional<Plate> grow(Index side, double crease) {
    constexpr int kTimes = 3;
    constexpr std::size_t kLeastFaces = 16;
    tried_[side] = true;
    Slab slab;
    slab.across = normal_[side];
    slab.thickness = chord(side);
    slab.middle = surface_.face_centroid(side) - 0.5 * slab.thickness * slab.across;
    if (!(slab.thickness > 0) || slab.thickness > kThin * crease) return std::nullopt;
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

  // The faces that have just grown as a plate; nothing where they are none.
  std::optional<Plate> measured(const Slab& slab, const std::vector<Index>& faces) const {
    constexpr double kStraight = 0.4, kBelow = 0.3;  // heights
    const std::optional<Root> root = find_root(faces, slab.across);
    if (!root || slab.thickness > kThin * root->width) return std::nullopt;
    Plate plate;
    FoundLimb& limb = plate.limb;
    limb.part = vertices_of(faces);
    limb.root = root->middle;
    double area = 0, bottom = 0, height = 0;
    for (const Index f : faces) area += surface_.face_area(f);
    for (const Index v : limb.part) {
      bottom = std::min(bottom, height_of(v, *root));
      height = std::max(height, height_of(v, *root));
    }
    // A top on legs and a wall between walls have other roots.
    if (root->unevenness > kStraight * height || bottom < -kBelow * height ||
        area >= half_area_[surface_.component[limb.part.front()]] ||
        !(height > kLeastTipDepth * options_.smallest))
      return std::nullopt;
    const PartLevel level{height, area, 2 * (root->width + slab.thickness)};
    plate.stands_out = level.slenderness() >= options_.slenderness && !is_blunt(level.depth_over_mouth());
    set_measures(limb.tip.measures, level, slab.thickness);
    set_end(limb, faces, *root, level);
    return plate;
  }

  double height_of(Index v, const Root& root) const {
    return (surface_.position[v] - root.middle).dot(root.up);
  }

  std::optional<Root> find_root(const std::vector<Index>& faces, const Vector3& across) const {
    Root root;
    Vector3 centre = Vector3::Zero();
    double area = 0, length = 0;
    std::vector<Index> round;
    for (const Index f : faces) {
      const double own = surface_.face_area(f);
      centre += own * surface_.face_centroid(f);
      area += own;
      for (Index h = 3 * f; h < 3 * f + 3; ++h) {
        if (grown_[SurfaceSnapshot::face(surface_.twin[h])] == growth_) continue;
        const double edge = surface_.edge_length(h);
        root.middle +=
            0.5 * edge * (surface_.position[surface_.origin[h]] + surface_.position[surface_.target(h)]);
        length += edge;
        round.push_back(surface_.origin[h]);
      }
    }
    if (!(length > 0)) return std::nullopt;
    root.middle /= length;
    root.up = centre / area - root.middle;
    root.up -= root.up.dot(across) * across;
    if (!(root.up.norm() > 0)) return std::nullopt;
    root.up.normalize();
    const auto extent = [&](const Vector3& along) {
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (const Index v : round) {
        low = std::min(low, along.dot(surface_.position[v]));
        high = std::max(high, along.dot(surface_.position[v]));
      }
      return high - low;
    };
    root.width = extent(across.cross(root.up));
    root.unevenness = extent(root.up);
    return root;
  }

  std::vector<Index> vertices_of(const std::vector<Index>& faces) const {
    std::vector<Index> vertices;
    for (const Index f : faces)
      vertices.insert(vertices.end(), surface_.origin.begin() + 3 * f, surface_.origin.begin() + 3 * f + 3);
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
  }

  // The half width of a plate is that across it: centring moves an arc freely along it, so that only this
  // tells when a leaf has strayed from the middle of the end.
  static void set_measures(LimbMeasures& m, const PartLevel& level, double thickness) {
    m.depth = level.depth;
    m.slenderness = level.slenderness();
    m.depth_over_mouth = level.depth_over_mouth();
    m.half_width = m.half_chord = m.half_thickness = 0.5 * thickness;
  }

  // The cap, the target in the middle of the end, and the vertex that is nearest above it.
  void set_end(FoundLimb& limb, const std::vector<Index>& faces, const Root& root,
               const PartLevel& level) const {
    const double radius = level.depth / level.slenderness();  // of a tube of its area and height
    const double end = std::min(0.5 * level.depth, kEnd * radius);
    const double cap = std::min(0.5 * level.depth, kTipCap * radius);
    LimbTip& tip = limb.tip;
    double area = 0;
    for (const Index f : faces) {
      if ((surface_.face_centroid(f) - root.middle).dot(root.up) < level.depth - end) continue;
      const double own = surface_.face_area(f);
      tip.target += own * surface_.face_centroid(f);
      area += own;
    }
    tip.target = area > 0 ? Vector3(tip.target / area) : Vector3(root.middle + level.depth * root.up);
    const Vector3 top = tip.target + end * root.up;
    for (const Index v : limb.part) {
      if (height_of(v, root) < level.depth - cap) continue;
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
  std::vector<Index> grown_;       // the last growth that came by
  Index growth_ = 0;
  std::size_t work_ = 0;       // faces that plates came by
  std::vector<double> chord_;  // inward from each face; negative where it was not asked for
  Watch watch_;
};

}  // namespace detail
}  // namespace mspskel
