// A plate, and how far faces that may be one stand out of what they are fixed to.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "mspskel/limbs/detail/convex_hull.h"
#include "mspskel/limbs/detail/growing_parts.h"
#include "mspskel/limbs/detail/limb_measurement.h"

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

struct PlateSlab {
  Vector3 middle = Vector3::Zero(), across = Vector3::Zero();  // a point of its middle plane; unit
  double thickness = 0;
};
// The height, the width and the end of a plate, from its faces and from where these end. Its root is what it
// is fixed to; what lies beyond the convex hull of that is free.
class PlateMeasurement {
 public:
  PlateMeasurement(const SurfaceSnapshot& surface, const LimbOptions& options)
      : surface_(surface), options_(options), half_area_(half_areas_of_components(surface)) {}

  // Some faces as a plate; nothing where they are none. is_member(f): whether a face is one of them.
  template <class IsMember>
  std::optional<Plate> run(const PlateSlab& slab, const std::vector<Index>& faces, IsMember is_member) const {
    constexpr double kFree = 0.3, kBelow = 0.3, kStraight = 0.4;  // heights
    constexpr double kSheet = 0.2;
    std::optional<Root> root = find_root(faces, slab.across, is_member);
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
        !(level.depth > kLeastTipDepth * options_.smallest))
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

 private:
  static constexpr double kThin = 0.5;  // thickness over width

  // Where a plate meets what it stands on, and which way it stands up.
  struct Root {
    Vector3 middle = Vector3::Zero(), up = Vector3::Zero();
    double width = 0;               // across `up`, along the plate
    std::vector<Vector3> vertices;  // of its edges
    bool in_pieces = false;         // none that hangs together is most of it
  };

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

  template <class IsMember>
  std::optional<Root> find_root(const std::vector<Index>& faces, const Vector3& across,
                                IsMember is_member) const {
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
        if (is_member(SurfaceSnapshot::face(surface_.twin[h]))) continue;
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
  const LimbOptions& options_;
  std::vector<double> half_area_;  // of each component
};

}  // namespace detail
}  // namespace mspskel
