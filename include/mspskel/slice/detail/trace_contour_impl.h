#pragma once

namespace mspskel {

inline SliceTracer::SliceTracer(const SurfaceSnapshot& surface) : surface_(surface) {
  step_.resize(surface.origin.size());
  for (Index h = 0; h < surface.halfedge_count(); ++h)
    step_[h] = {surface.apex(h), surface.twin[surface.prev(h)], surface.twin[surface.next(h)], 0};
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
      h = s.if_positive;
      positive = d;
      to = s.apex;
    } else {
      h = s.if_negative;
      negative = d;
      from = s.apex;
    }
    if (h == start) return;
  }
}

// Length and signed area (oriented by the surface) of the contour; length = infinity once it cannot stay
// below `bound`.
inline SliceTracer::Measure SliceTracer::measure(Index start, const Side& side, double bound,
                                                 std::int64_t& steps) const {
  double x0 = 0, y0 = 0, z0 = 0, x = 0, y = 0, z = 0, length = 0, ax = 0, ay = 0, az = 0;
  std::int64_t count = 0;
  bool complete = true;
  walk(start, side, [&](Index, Index from, Index to, double negative, double positive) {
    const Point &p = point_[from], &q = point_[to];
    const double w = negative / (negative - positive);
    const double cx = p.x + w * (q.x - p.x), cy = p.y + w * (q.y - p.y), cz = p.z + w * (q.z - p.z);
    if (count++ == 0) {
      x0 = x = cx, y0 = y = cy, z0 = z = cz;
      return true;
    }
    const double dx = cx - x, dy = cy - y, dz = cz - z, rx = cx - x0, ry = cy - y0, rz = cz - z0;
    length += std::sqrt(dx * dx + dy * dy + dz * dz);
    ax += ry * dz - rz * dy, ay += rz * dx - rx * dz, az += rx * dy - ry * dx;
    x = cx, y = cy, z = cz;
    if (length >= bound || (count % 8 == 0 && length + std::sqrt(rx * rx + ry * ry + rz * rz) >= bound)) {
      complete = false;
      return false;
    }
    return true;
  });
  steps += count;
  if (!complete) return {std::numeric_limits<double>::infinity(), 0.0};
  const double rx = x - x0, ry = y - y0, rz = z - z0;
  // The walk keeps the positive side on its right as seen from outside, which is clockwise about the plane's
  // normal round material.
  return {length + std::sqrt(rx * rx + ry * ry + rz * rz), -0.5 * (ax * side.x + ay * side.y + az * side.z)};
}

inline SliceTracer::Shortest SliceTracer::shortest_through(Index v, const Vector3& normal, double bound,
                                                           std::int64_t& steps) const {
  Shortest best;
  const Index first = surface_.vertex_halfedge[v];
  if (first == kNone) return best;
  best.perimeter = bound;
  const Point& p = point_[v];
  const Side side{normal.x(), normal.y(), normal.z(), normal.x() * p.x + normal.y() * p.y + normal.z() * p.z,
                  v};
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

inline void SliceTracer::trace(Index start, const Plane& plane, Index through, Contour& contour) const {
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

inline bool SliceTracer::shortest_contour(Index v, const Vector3& normal, Contour& contour,
                                          std::int64_t& steps) const {
  const Shortest found = shortest_through(v, normal, std::numeric_limits<double>::infinity(), steps);
  if (found.start == kNone) return false;
  trace(found.start, Plane{normal, normal.dot(surface_.position[v])}, v, contour);
  steps += static_cast<std::int64_t>(contour.halfedge.size());
  return true;
}

}  // namespace mspskel
