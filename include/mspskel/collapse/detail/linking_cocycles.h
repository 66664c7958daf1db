// Linking numbers of the generator loops with the dual generator loops pushed out of the solid.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "mspskel/collapse/detail/homology_generators.h"
#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {
namespace detail {

// Crossings of two families of curves seen along one direction. The linking number of two disjoint closed
// curves is the signed count of the crossings where the first passes above the second, and minus that of the
// crossings where it passes below; that both agree is the check.
struct CrossingCount {
  std::int64_t above = 0, below = 0;
};

// Directions to look along, generic for any model that was not made to fool them. Linking numbers do not
// depend on the direction, so the model may turn under it.
inline Vector3 view_direction(int attempt) {
  const double t = 0.7548776662466927 * (attempt + 1), z = 2 * (0.5698402909980532 * (attempt + 1)) - 1;
  const double height = z - 2 * std::floor((z + 1) / 2), angle = 2 * kPi * (t - std::floor(t));
  const double radius = std::sqrt(std::max(0.0, 1 - height * height));
  return Vector3(radius * std::cos(angle), radius * std::sin(angle), height).normalized();
}

// Coordinates with the third toward the viewer.
struct View {
  Vector3 u, v, d;
  explicit View(const Vector3& direction)
      : u(direction.unitOrthogonal()), v(direction.cross(u)), d(direction) {}
  Vector3 operator()(const Vector3& x) const { return {u.dot(x), v.dot(x), d.dot(x)}; }
};

// Sign of the turn a → b → c as seen from the viewer; none if rounding could change it.
inline std::optional<int> turn(const Vector3& a, const Vector3& b, const Vector3& c) {
  constexpr double kRounding = 1e-15;  // of a coordinate in the unit frame, turned
  const double x1 = b.x() - a.x(), y1 = b.y() - a.y(), x2 = c.x() - a.x(), y2 = c.y() - a.y();
  const double value = x1 * y2 - y1 * x2;
  const double error = kRounding * (std::abs(x1) + std::abs(y1) + std::abs(x2) + std::abs(y2));
  if (std::abs(value) <= error) return std::nullopt;
  return value > 0 ? 1 : -1;
}

// Adds the crossing of segments pq and ab to `count`, if there is one. False if rounding hides the answer.
inline bool count_crossing(const Vector3& p, const Vector3& q, const Vector3& a, const Vector3& b,
                           CrossingCount& count) {
  constexpr double kHeightRounding = 1e-13;
  if (std::max(p.x(), q.x()) < std::min(a.x(), b.x()) || std::max(a.x(), b.x()) < std::min(p.x(), q.x()) ||
      std::max(p.y(), q.y()) < std::min(a.y(), b.y()) || std::max(a.y(), b.y()) < std::min(p.y(), q.y()))
    return true;
  const auto ta = turn(p, q, a), tb = turn(p, q, b), tp = turn(a, b, p), tq = turn(a, b, q);
  if ((ta && tb && *ta == *tb) || (tp && tq && *tp == *tq)) return true;
  if (!ta || !tb || !tp || !tq) return false;
  const auto cross = [](const Vector3& x, const Vector3& y) { return x.x() * y.y() - x.y() * y.x(); };
  const Vector3 pq = q - p, ab = b - a, pa = a - p;
  const double denominator = cross(pq, ab);
  const double above =
      p.z() + cross(pa, ab) / denominator * pq.z() - a.z() - cross(pa, pq) / denominator * ab.z();
  if (!(std::abs(above) >= kHeightRounding)) return false;
  (above > 0 ? count.above : count.below) +=
      *ta < 0 ? 1 : -1;  // a on the right of pq: ab crosses to the left
  return true;
}

// The edges of closed walks, each once, with the loops that run through it, and a grid over the view plane.
class LoopBundle {
 public:
  struct Use {
    Index loop;
    std::int64_t times;  // signed by direction
  };
  struct Segment {
    Index halfedge;
    Vector3 a, b;  // in view coordinates, along the half-edge
    std::vector<Use> uses;
  };

  LoopBundle(const SurfaceSnapshot& surface, const std::vector<std::vector<Index>>& loops, const View& view);

  const std::vector<Segment>& segments() const { return segments_; }

  // Calls visit(segment index) once for each segment whose cells the box of pq meets.
  template <class Visit>
  void near(const Vector3& p, const Vector3& q, Visit&& visit);

 private:
  std::array<Index, 4> cells(const Vector3& p, const Vector3& q) const {
    const auto cell = [&](double x, double low, double width) {
      return static_cast<Index>(std::clamp((x - low) / width * size_, 0.0, size_ - 1.0));
    };
    return {cell(std::min(p.x(), q.x()), low_.x(), width_.x()),
            cell(std::max(p.x(), q.x()), low_.x(), width_.x()),
            cell(std::min(p.y(), q.y()), low_.y(), width_.y()),
            cell(std::max(p.y(), q.y()), low_.y(), width_.y())};
  }

  std::vector<Segment> segments_;
  Vector3 low_, width_;
  Index size_ = 1;
  std::vector<std::vector<Index>> grid_;
  std::vector<Index> stamp_;
  Index now_ = 0;
};

inline LoopBundle::LoopBundle(const SurfaceSnapshot& surface, const std::vector<std::vector<Index>>& loops,
                              const View& view) {
  struct Entry {
    Index edge, loop;
    std::int64_t sign;
  };
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < loops.size(); ++i)
    for (const Index h : loops[i])
      entries.push_back({std::min(h, surface.twin[h]), static_cast<Index>(i), h < surface.twin[h] ? 1 : -1});
  std::stable_sort(entries.begin(), entries.end(),
                   [](const Entry& a, const Entry& b) { return a.edge < b.edge; });
  Vector3 high = Vector3::Constant(-1e300);
  low_ = -high;
  for (const Entry& e : entries) {
    if (segments_.empty() || segments_.back().halfedge != e.edge) {
      segments_.push_back({e.edge,
                           view(surface.position[surface.origin[e.edge]]),
                           view(surface.position[surface.target(e.edge)]),
                           {}});
      low_ = low_.cwiseMin(segments_.back().a).cwiseMin(segments_.back().b);
      high = high.cwiseMax(segments_.back().a).cwiseMax(segments_.back().b);
    }
    segments_.back().uses.push_back({e.loop, e.sign});
  }
  width_ = (high - low_).cwiseMax(1e-12);
  size_ = std::max<Index>(1, static_cast<Index>(std::sqrt(static_cast<double>(segments_.size()))));
  grid_.resize(static_cast<std::size_t>(size_) * static_cast<std::size_t>(size_));
  stamp_.assign(segments_.size(), -1);
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    const auto [x0, x1, y0, y1] = cells(segments_[i].a, segments_[i].b);
    for (Index y = y0; y <= y1; ++y)
      for (Index x = x0; x <= x1; ++x) grid_[y * size_ + x].push_back(static_cast<Index>(i));
  }
}

template <class Visit>
void LoopBundle::near(const Vector3& p, const Vector3& q, Visit&& visit) {
  const auto [x0, x1, y0, y1] = cells(p, q);
  ++now_;
  for (Index y = y0; y <= y1; ++y)
    for (Index x = x0; x <= x1; ++x)
      for (const Index i : grid_[y * size_ + x]) {
        if (stamp_[i] == now_) continue;
        stamp_[i] = now_;
        visit(i);
      }
}

namespace linking {

inline Vector3 midpoint(const SurfaceSnapshot& s, Index h) {
  return 0.5 * (s.position[s.origin[h]] + s.position[s.target(h)]);
}

// The walk across the half-edges of a dual loop as a polygon: midpoint, centroid, midpoint, ...
inline std::vector<Vector3> polygon(const SurfaceSnapshot& surface, const std::vector<Index>& dual_loop) {
  std::vector<Vector3> points;
  for (const Index h : dual_loop) {
    points.push_back(midpoint(surface, h));
    points.push_back(surface.face_centroid(SurfaceSnapshot::face(surface.twin[h])));
  }
  return points;
}

// The one place where loop j and dual loop j touch: the dual loop goes from face(h) across the middle of h
// and is pushed outward by less than anything. Seen from the side that a face turns to the viewer, the
// outside is above. Where just one of the two faces turns to the viewer, the edge is on the silhouette:
// pushed outward, the dual loop swings past a convex edge and back, above on one face and below on the other,
// and turns back before a concave one.
//
//       f1 | f2        h runs up, f1 = face(h) on its left; the dual loop goes right
//      ----h---->
//
// Where the faces are turned inward (outward = −1), left and right and in and out change places.
inline bool count_contact(const SurfaceSnapshot& surface, const View& view, Index h, int outward,
                          CrossingCount& count) {
  const Index f1 = SurfaceSnapshot::face(h), f2 = SurfaceSnapshot::face(surface.twin[h]);
  const Vector3 n1 = outward * surface.face_normal_times_twice_area(f1),
                n2 = outward * surface.face_normal_times_twice_area(f2);
  const double up1 = n1.dot(view.d), up2 = n2.dot(view.d);
  if (std::abs(up1) <= 1e-9 * n1.norm() || std::abs(up2) <= 1e-9 * n2.norm()) return false;
  const bool silhouette = (up1 > 0) != (up2 > 0);
  if (silhouette) {
    const Vector3 to_apex =
        surface.position[surface.apex(surface.twin[h])] - surface.position[surface.origin[h]];
    if (n1.dot(to_apex) > 0) return true;  // concave
  }
  if (silhouette || up1 > 0) count.above += outward;
  if (silhouette || up1 < 0) count.below -= outward;
  return true;
}

}  // namespace linking

// Linking numbers of dual loops, pushed out of the solid, with the loops on its surface, one dual loop at a
// time. As functions of the loops they span the cohomology of the solid: rank g.
class LinkingPeriods {
 public:
  LinkingPeriods(const SurfaceSnapshot& surface, const HomologyGenerators& generators, int outward)
      : surface_(surface), generators_(generators), outward_(outward), count_(generators.loop.size()) {}

  // Pairs of a loop's number and dual loop i's linking number with it, without zeros. None if no direction
  // gave a clear view, which needs a surface that touches or crosses itself.
  std::optional<std::vector<std::pair<Index, std::int64_t>>> operator()(Index i) {
    constexpr int kDirections = 12;
    for (int attempt = 0; attempt < kDirections; ++attempt) {
      if (static_cast<int>(seen_.size()) == attempt) seen_.emplace_back(surface_, generators_, attempt);
      if (auto periods = along(seen_[static_cast<std::size_t>(attempt)], i)) return periods;
    }
    return std::nullopt;
  }

 private:
  // A dual loop's step from face to face across a half-edge: what it crosses, in Seen::crossings.
  struct Step {
    Index first = kNone;  // kNone: not looked at
    Index count = 0;
    bool clear = true;  // false: rounding hides whether it crosses something
  };
  struct Crossing {
    Index segment;
    CrossingCount count;
  };
  struct Seen {
    View view;
    LoopBundle bundle;
    std::vector<Step> step;  // per half-edge; dual loops share most of their steps
    std::vector<Crossing> crossings;
    Seen(const SurfaceSnapshot& surface, const HomologyGenerators& generators, int attempt)
        : view(view_direction(attempt)),
          bundle(surface, generators.loop, view),
          step(surface.origin.size()) {}
  };

  const Step& step_across(Seen& seen, Index h) {
    Step& step = seen.step[h];
    if (step.first != kNone) return step;
    step.first = static_cast<Index>(seen.crossings.size());
    const Index f = SurfaceSnapshot::face(h), next = SurfaceSnapshot::face(surface_.twin[h]);
    const Vector3 middle = linking::midpoint(surface_, h);
    add(seen, f, surface_.face_centroid(f), middle, step);
    add(seen, next, middle, surface_.face_centroid(next), step);
    step.count = static_cast<Index>(seen.crossings.size()) - step.first;
    return step;
  }

  // Adds the crossings of a piece of the step, within face f, with all loops.
  void add(Seen& seen, Index f, const Vector3& from, const Vector3& to, Step& step) {
    const Vector3 p = seen.view(from), q = seen.view(to);
    seen.bundle.near(p, q, [&](Index s) {
      const LoopBundle::Segment& segment = seen.bundle.segments()[s];
      const Index other = SurfaceSnapshot::face(surface_.twin[segment.halfedge]);
      if (SurfaceSnapshot::face(segment.halfedge) == f || other == f) return;  // same triangle: never cross
      CrossingCount one;
      step.clear = step.clear && count_crossing(p, q, segment.a, segment.b, one);
      if (one.above != 0 || one.below != 0) seen.crossings.push_back({s, one});
    });
  }

  // Seen along one direction; none if rounding gets in the way there.
  std::optional<std::vector<std::pair<Index, std::int64_t>>> along(Seen& seen, Index i) {
    bool clear = true;
    crossed_.assign(1, i);
    for (const Index h : generators_.dual_loop[i]) {
      const Step& step = step_across(seen, h);
      clear = clear && step.clear;
      for (Index c = step.first; c < step.first + step.count; ++c) {
        const Crossing& crossing = seen.crossings[c];
        for (const LoopBundle::Use& use : seen.bundle.segments()[crossing.segment].uses) {
          crossed_.push_back(use.loop);
          count_[use.loop].above += use.times * crossing.count.above;
          count_[use.loop].below += use.times * crossing.count.below;
        }
      }
    }
    clear = clear && linking::count_contact(surface_, seen.view, generators_.dual_loop[i].front(), outward_,
                                            count_[i]);
    std::vector<std::pair<Index, std::int64_t>> periods;
    for (const Index j : crossed_) {
      clear = clear && count_[j].above == -count_[j].below;
      if (count_[j].above != 0) periods.push_back({j, count_[j].above});
      count_[j] = {};
    }
    if (!clear) return std::nullopt;
    return periods;
  }

  const SurfaceSnapshot& surface_;
  const HomologyGenerators& generators_;
  int outward_;
  std::deque<Seen> seen_;             // per direction
  std::vector<CrossingCount> count_;  // per loop, all zero between calls
  std::vector<Index> crossed_;        // loops with a count, some more than once
};

}  // namespace detail
}  // namespace mspskel
