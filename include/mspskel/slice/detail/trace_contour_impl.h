#pragma once

#include "mspskel/base/clones.h"
#include "mspskel/base/linkage.h"

namespace mspskel {

MSPSKEL_INLINE SliceTracer::SliceTracer(const SurfaceSnapshot& surface) : surface_(surface) {
  step_.resize(surface.origin.size());
  for (Index h = 0; h < surface.halfedge_count(); ++h)
    step_[h] = {surface.apex(h),
                {surface.twin[surface.next(h)], surface.twin[surface.prev(h)]},
                SurfaceSnapshot::face(h)};
  point_.resize(surface.position.size());
  for (std::size_t v = 0; v < point_.size(); ++v) {
    const Vector3& p = surface.position[v];
    point_[v] = {p.x(), p.y(), p.z(), 0.0};
  }
}

// Calls visit(h, origin, target, d_origin, d_target) for every crossed half-edge in walking order until the
// walk is back at the start or visit returns false. A contour crosses each edge at most once, which bounds
// the walk even if the signs of a vertex came out differently twice.
template <class Visit>
void SliceTracer::walk(Index start, const Side& side, Visit&& visit) const {
  Index h = start;
  const Index a = surface_.origin[start], b = surface_.target(start);
  double negative = side(point_[a], a), positive = side(point_[b], b);
  Index from = a, to = b;
  for (Index budget = surface_.halfedge_count(); budget > 0; --budget) {
    if (!visit(h, from, to, negative, positive)) return;
    const Step& s = step_[h];
    const double d = side(point_[s.apex], s.apex);
    if (d >= 0) {
      h = s.exit[1];
      positive = d;
      to = s.apex;
    } else {
      h = s.exit[0];
      negative = d;
      from = s.apex;
    }
    if (h == start) return;
  }
}

namespace detail::two_walks {

// Two doubles side by side, and a mask of as many: all ones or zero.
using Lanes = double __attribute__((vector_size(16)));
using LaneMask = std::int64_t __attribute__((vector_size(16)));

struct Lanes3 {
  Lanes x, y, z;
};
inline Lanes3 operator-(const Lanes3& a, const Lanes3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Lanes dot(const Lanes3& a, const Lanes3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Lanes3 cross(const Lanes3& a, const Lanes3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Lanes3 select(LaneMask m, const Lanes3& a, const Lanes3& b) {
  return {m ? a.x : b.x, m ? a.y : b.y, m ? a.z : b.z};
}
inline Lanes norm(const Lanes3& a) {
  const Lanes square = dot(a, a);
  return Lanes{std::sqrt(square[0]), std::sqrt(square[1])};
}
inline double sum(Lanes a) { return a[0] + a[1]; }
inline Vector3 lane(const Lanes3& a, int k) { return {a.x[k], a.y[k], a.z[k]}; }

}  // namespace detail::two_walks

// Two walkers that leave the start in opposite directions, one a lane, until they stand in the same face. A
// walk waits for memory and for the side of the next vertex, which no processor predicts; two of them wait
// together, and selects take the place of branches.
class SliceTracer::PairWalk {
 public:
  using Lanes = detail::two_walks::Lanes;
  using Lanes3 = detail::two_walks::Lanes3;

  PairWalk(const SliceTracer& tracer, Index start, const Side& side)
      : step_(tracer.step_.data()),
        point_(tracer.point_.data()),
        side_(side),
        s_(step_ + start),
        t_(step_ + tracer.surface_.twin[start]) {
    const Index a = tracer.surface_.origin[start], b = tracer.surface_.target(start);
    negative_ = load(a, a);
    positive_ = load(b, b);
    below_ = Lanes{} + side(point_[a], a);
    above_ = Lanes{} + side(point_[b], b);
  }

  // Where the plane cuts the edges on which the walkers stand.
  Lanes3 crossing() const {
    const Lanes w = below_ / (below_ - above_);
    const Lanes3 e = positive_ - negative_;
    return {negative_.x + w * e.x, negative_.y + w * e.y, negative_.z + w * e.z};
  }

  // Both go on to their next edge. False once they stand in the same face, or on the same edge.
  bool advance() {
    const Lanes3 apex = load(s_->apex, t_->apex);
    Lanes d = side_.x * apex.x + side_.y * apex.y + side_.z * apex.z - side_.offset;
    if (s_->apex == side_.through) d[0] = 0;
    if (t_->apex == side_.through) d[1] = 0;
    const detail::two_walks::LaneMask is_positive = d >= Lanes{};
    const Index face = t_->face;
    // Seen from the other direction the negative side is where the positive one was.
    s_ = step_ + s_->exit[is_positive[0] & 1];
    t_ = step_ + t_->exit[~is_positive[1] & 1];
    negative_ = select(is_positive, negative_, apex);
    positive_ = select(is_positive, apex, positive_);
    below_ = is_positive ? below_ : d;
    above_ = is_positive ? d : above_;
    return s_->face != t_->face && s_->face != face;
  }

 private:
  Lanes3 load(Index a, Index b) const {
    const Point &p = point_[a], &q = point_[b];
    return {Lanes{p.x, q.x}, Lanes{p.y, q.y}, Lanes{p.z, q.z}};
  }

  const Step* step_;
  const Point* point_;
  Side side_;
  const Step *s_, *t_;
  Lanes3 negative_, positive_;  // ends of the edges
  Lanes below_, above_;         // their signed distances
};

// Length and signed area (oriented by the surface) of the contour; length = infinity once it cannot stay
// below `bound`.
MSPSKEL_AVX_CLONES MSPSKEL_INLINE SliceTracer::Measure SliceTracer::measure(Index start, const Side& side,
                                                                            double bound,
                                                                            std::int64_t& steps) const {
  using namespace detail::two_walks;
  PairWalk walk(*this, start, side);
  const Lanes3 first = walk.crossing();
  Lanes3 last = first, area = {};
  Lanes length = {};
  const auto with_chord = [&] { return sum(length) + (lane(last, 0) - lane(last, 1)).norm(); };
  bool apart = true;
  Index count = 0;
  for (const Index limit = surface_.face_count(); apart && count < limit; ++count) {
    apart = walk.advance();
    const Lanes3 point = walk.crossing(), move = point - last, turn = cross(point - first, move);
    length += norm(move);
    area.x += turn.x, area.y += turn.y, area.z += turn.z;
    last = point;
    if (count % 4 == 0 && with_chord() >= bound) break;
  }
  steps += 2 * count + 1;
  const double perimeter = with_chord();
  if (apart || perimeter >= bound) return {std::numeric_limits<double>::infinity(), 0.0};
  const Vector3 o = lane(first, 0),
                twice = lane(area, 0) - lane(area, 1) + (lane(last, 0) - o).cross(lane(last, 1) - o);
  // The walk keeps the positive side on its right as seen from outside, which is clockwise about the plane's
  // normal round material.
  return {perimeter, -0.5 * (twice.x() * side.x + twice.y() * side.y + twice.z() * side.z)};
}

MSPSKEL_INLINE SliceTracer::Side SliceTracer::side_through(Index v, const Vector3& normal) const {
  const Point& p = point_[v];
  return {normal.x(), normal.y(), normal.z(), normal.x() * p.x + normal.y() * p.y + normal.z() * p.z, v};
}

MSPSKEL_INLINE SliceTracer::Shortest SliceTracer::shortest_through(Index v, const Vector3& normal,
                                                                   double bound, std::int64_t& steps) const {
  Shortest best;
  const Index first = surface_.vertex_halfedge[v];
  if (first == kNone) return best;
  best.perimeter = bound;
  const Side side = side_through(v, normal);
  // Each change from + to - counter-clockwise round v starts one contour, out across the edge opposite to v.
  Index h = first;
  bool positive = side(point_[surface_.target(h)], surface_.target(h)) >= 0;
  do {
    const Index q = step_[h].apex;
    const bool next_positive = side(point_[q], q) >= 0;
    if (positive && !next_positive) {
      const Index start = surface_.twin[SurfaceSnapshot::next(h)];
      const Measure m = measure(start, side, best.perimeter, steps);
      if (m.length < best.perimeter && m.length > 0 && m.area > 0) best = {m.length, start};
    }
    positive = next_positive;
    h = surface_.next_outgoing(h);
  } while (h != first);
  if (best.start == kNone) best.perimeter = std::numeric_limits<double>::infinity();
  return best;
}

MSPSKEL_AVX_CLONES MSPSKEL_INLINE void SliceTracer::trace(Index start, const Plane& plane, Index through,
                                                          Contour& contour) const {
  contour.halfedge.clear();
  contour.weight.clear();
  contour.point.clear();
  const Side side{plane.normal.x(), plane.normal.y(), plane.normal.z(), plane.offset, through};
  walk(start, side, [&](Index h, Index from, Index to, double negative, double positive) {
    const Vector3 &p = surface_.position[from], &q = surface_.position[to];
    const double w = negative / (negative - positive);
    contour.halfedge.push_back(h);
    contour.weight.push_back(w);
    contour.point.push_back(p + w * (q - p));
    return true;
  });
  contour.perimeter = 0;
  Vector3 area = Vector3::Zero();
  for (std::size_t i = 0, n = contour.point.size(); i < n; ++i) {
    const Vector3 &a = contour.point[i], &b = contour.point[i + 1 == n ? 0 : i + 1], &o = contour.point[0];
    contour.perimeter += (b - a).norm();
    area += (a - o).cross(b - o);
  }
  contour.area = -0.5 * area.dot(plane.normal);
}

MSPSKEL_INLINE bool SliceTracer::shortest_contour(Index v, const Vector3& normal, Contour& contour,
                                                  std::int64_t& steps) const {
  const Shortest found = shortest_through(v, normal, std::numeric_limits<double>::infinity(), steps);
  if (found.start == kNone) return false;
  trace(found.start, Plane{normal, normal.dot(surface_.position[v])}, v, contour);
  steps += static_cast<std::int64_t>(contour.halfedge.size());
  return true;
}

}  // namespace mspskel
