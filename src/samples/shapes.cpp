#include "mspskel/samples/shapes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "mspskel/base/error.h"
#include "noise.h"
#include "rings.h"

namespace mspskel {

namespace {
using detail::noise;
using detail::Ring;

const double kRowHeight = std::sqrt(3.0) / 2;  // of an equilateral triangle with edge 1

struct ProfilePoint {
  double radius, height;
};

// A smooth stretch of a profile, u in [0, 1] at constant speed.
struct ProfilePiece {
  std::function<ProfilePoint(double)> at;
  double length;
};

ProfilePiece segment(ProfilePoint a, ProfilePoint b) {
  const auto at = [a, b](double u) {
    return ProfilePoint{(1 - u) * a.radius + u * b.radius, (1 - u) * a.height + u * b.height};
  };
  return {at, std::hypot(b.radius - a.radius, b.height - a.height)};
}

ProfilePiece arc(ProfilePoint center, double radius, double from, double to) {
  const auto at = [=](double u) {
    const double angle = from + u * (to - from);
    // At the axis the cosine's rounding must not leave a tiny circle.
    const double rho = center.radius + radius * std::cos(angle);
    return ProfilePoint{std::abs(rho) < 1e-12 * radius ? 0.0 : rho, center.height + radius * std::sin(angle)};
  };
  return {at, radius * std::abs(to - from)};
}

void check_positive(double value, const char* name) {
  if (!(value > 0) || !std::isfinite(value))
    throw UsageError(std::string(name) + " must be a positive number");
}

void check(const Tessellation& t) {
  check_positive(t.edge, "edge");
  if (!(t.irregularity >= 0 && t.irregularity <= 0.3)) throw UsageError("irregularity must lie in [0, 0.3]");
}

// One circle of a surface of revolution. Vertices stray along the circle, and along the profile unless it has
// a corner.
Ring add_circle(PolygonSoup& soup, const ProfilePiece& piece, double u, double step, const Tessellation& t) {
  const auto row = static_cast<std::uint64_t>(soup.points.size());
  const Index count =
      std::max<Index>(4, static_cast<Index>(std::lround(2 * kPi * piece.at(u).radius / t.edge)));
  const double start = 0.5 * noise(t.seed, row) / count;
  Ring ring;
  for (Index i = 0; i < count; ++i) {
    const auto id = static_cast<std::uint64_t>(i);
    const double turn = start + (i + t.irregularity * noise(t.seed + 1, row, id)) / count;
    const bool corner = u == 0.0 || u == 1.0;
    const ProfilePoint p = piece.at(corner ? u : u + t.irregularity * step * noise(t.seed + 2, row, id));
    ring.turn.push_back(turn);
    ring.vertex.push_back(detail::add_point(
        soup, {p.radius * std::cos(2 * kPi * turn), p.radius * std::sin(2 * kPi * turn), p.height}));
  }
  return ring;
}

// Turns a profile round the z axis. The solid lies to the left of the profile's direction (radius to the
// right, height up). The profile is closed, or both its ends lie on the axis.
PolygonSoup revolve(const std::vector<ProfilePiece>& profile, bool closed, const Tessellation& t) {
  check(t);
  PolygonSoup soup;
  Index apex = kNone;
  if (!closed) apex = detail::add_point(soup, {0, 0, profile.front().at(0).height});
  Ring first, last;
  for (std::size_t p = 0; p < profile.size(); ++p) {
    const ProfilePiece& piece = profile[p];
    const Index rows = std::max<Index>(closed ? 3 : 1,
                                       static_cast<Index>(std::lround(piece.length / (kRowHeight * t.edge))));
    const bool ends_at_axis = !closed && p + 1 == profile.size();
    for (Index row = p == 0 && !closed ? 1 : 0; row < rows; ++row) {
      Ring ring = add_circle(soup, piece, static_cast<double>(row) / rows, 1.0 / rows, t);
      if (last.vertex.empty()) {
        if (apex != kNone) detail::close_behind(soup, ring, apex);
        first = ring;
      } else {
        detail::zip(soup, last, ring);
      }
      last = std::move(ring);
    }
    if (ends_at_axis) detail::close_before(soup, last, detail::add_point(soup, {0, 0, piece.at(1).height}));
  }
  if (closed) detail::zip(soup, last, first);
  return soup;
}
}  // namespace

double edge_for_vertices(double area, Index vertices) {
  // A vertex stands for two triangles of area edge² · √3 / 4 each.
  return std::sqrt(area / (kRowHeight * std::max<Index>(vertices, 4)));
}

PolygonSoup make_sphere(double radius, const Tessellation& t) {
  check_positive(radius, "radius");
  return revolve({arc({0, 0}, radius, -kPi / 2, 0), arc({0, 0}, radius, 0, kPi / 2)}, false, t);
}

PolygonSoup make_capsule(double radius, double length, const Tessellation& t) {
  check_positive(radius, "radius");
  check_positive(length, "length");
  return revolve(
      {arc({0, -length / 2}, radius, -kPi / 2, 0), segment({radius, -length / 2}, {radius, length / 2}),
       arc({0, length / 2}, radius, 0, kPi / 2)},
      false, t);
}

PolygonSoup make_tube(double radius, double length, const Tessellation& t) {
  check_positive(radius, "radius");
  check_positive(length, "length");
  const double h = length / 2;
  return revolve(
      {segment({0, -h}, {radius, -h}), segment({radius, -h}, {radius, h}), segment({radius, h}, {0, h})},
      false, t);
}

PolygonSoup make_torus(double major, double minor, const Tessellation& t) {
  check_positive(minor, "minor");
  if (!(major > minor) || !std::isfinite(major)) throw UsageError("major must be larger than minor");
  return revolve({arc({major, 0}, minor, -kPi, kPi)}, true, t);
}

PolygonSoup make_bowl(double radius, double wall, const Tessellation& t) {
  check_positive(wall, "wall");
  if (!(radius > wall) || !std::isfinite(radius)) throw UsageError("radius must be larger than wall");
  return revolve({arc({0, 0}, radius, -kPi / 2, 0), arc({radius - wall / 2, 0}, wall / 2, 0, kPi),
                  arc({0, 0}, radius - wall, 0, -kPi / 2)},
                 false, t);
}

namespace {
// A polygon parallel to the base: corners always, `per_side` edges along each side.
Ring add_polygon(PolygonSoup& soup, Index sides, double radius, double z, Index per_side, double stray_z,
                 const Tessellation& t) {
  const auto row = static_cast<std::uint64_t>(soup.points.size());
  const auto corner = [&](Index i) {
    const double angle = 2 * kPi * i / sides;
    return Vector3(radius * std::cos(angle), radius * std::sin(angle), z);
  };
  Ring ring;
  for (Index side = 0; side < sides; ++side)
    for (Index k = 0; k < per_side; ++k) {
      const auto id = static_cast<std::uint64_t>(side * per_side + k);
      const double u = (k + (k > 0 ? t.irregularity * noise(t.seed + 1, row, id) : 0.0)) / per_side;
      Vector3 p = (1 - u) * corner(side) + u * corner(side + 1);
      p.z() += stray_z * noise(t.seed + 2, row, id);
      ring.turn.push_back((side + u) / sides);
      ring.vertex.push_back(detail::add_point(soup, p));
    }
  return ring;
}
}  // namespace

PolygonSoup make_prism(Index sides, double radius, double height, const Tessellation& t) {
  check(t);
  if (sides < 3) throw UsageError("sides must be at least 3");
  check_positive(radius, "radius");
  check_positive(height, "height");
  const double side = 2 * radius * std::sin(kPi / sides), apothem = radius * std::cos(kPi / sides);
  const auto steps = [&](double length) {
    return std::max<Index>(1, static_cast<Index>(std::lround(length / t.edge)));
  };
  const Index per_side = steps(side), cap_rows = steps(apothem / kRowHeight),
              rows = steps(height / kRowHeight);
  PolygonSoup soup;
  const auto cap_ring = [&](Index row, double z) {
    const double scale = static_cast<double>(row) / cap_rows;
    return add_polygon(soup, sides, scale * radius, z,
                       std::max<Index>(1, static_cast<Index>(std::lround(scale * per_side))), 0.0, t);
  };
  const Index bottom = detail::add_point(soup, {0, 0, -height / 2});
  Ring last = cap_ring(1, -height / 2);
  detail::close_behind(soup, last, bottom);
  const auto advance = [&](Ring ring) {
    detail::zip(soup, last, ring);
    last = std::move(ring);
  };
  for (Index row = 2; row <= cap_rows; ++row) advance(cap_ring(row, -height / 2));
  for (Index row = 1; row < rows; ++row)
    advance(add_polygon(soup, sides, radius, -height / 2 + row * height / rows, per_side,
                        t.irregularity * height / rows, t));
  for (Index row = cap_rows; row >= 1; --row) advance(cap_ring(row, height / 2));
  detail::close_before(soup, last, detail::add_point(soup, {0, 0, height / 2}));
  return soup;
}

namespace {
// A closed curve at equal steps of arc length, each point with a frame that turns round the tangent as little
// as possible.
struct FramedCurve {
  std::vector<Vector3> point, tangent, across;
};

std::vector<double> equal_steps(const std::function<Vector3(double)>& curve, Index count, double& length) {
  const Index fine = std::max<Index>(2048, 4 * count);
  std::vector<double> arc{0.0};
  for (Index i = 0; i < fine; ++i)
    arc.push_back(arc.back() + (curve((i + 1.0) / fine) - curve(static_cast<double>(i) / fine)).norm());
  length = arc.back();
  std::vector<double> parameter;
  Index i = 0;
  for (Index k = 0; k < count; ++k) {
    const double wanted = length * k / count;
    while (arc[i + 1] < wanted) ++i;
    parameter.push_back((i + (wanted - arc[i]) / (arc[i + 1] - arc[i])) / fine);
  }
  return parameter;
}

// Frames by parallel transport; what is missing to a full turn at the end is spread over the curve (Bishop
// 1975).
FramedCurve framed(const std::function<Vector3(double)>& curve, const std::vector<double>& parameter) {
  FramedCurve f;
  constexpr double kStep = 1e-5;
  for (const double u : parameter) {
    f.point.push_back(curve(u));
    f.tangent.push_back((curve(u + kStep) - curve(u - kStep)).normalized());
  }
  const std::size_t count = parameter.size();
  Vector3 across = f.tangent[0].unitOrthogonal();
  for (std::size_t k = 0; k <= count; ++k) {
    const Vector3& tangent = f.tangent[k % count];
    across = (across - across.dot(tangent) * tangent).normalized();
    if (k < count) f.across.push_back(across);
  }
  const double gap = std::atan2(f.tangent[0].dot(across.cross(f.across[0])), across.dot(f.across[0]));
  for (std::size_t k = 0; k < count; ++k)
    f.across[k] = Eigen::AngleAxisd(gap * static_cast<double>(k) / static_cast<double>(count), f.tangent[k]) *
                  f.across[k];
  return f;
}
}  // namespace

PolygonSoup make_closed_tube(const std::function<Vector3(double)>& curve, double radius,
                             const Tessellation& t) {
  check(t);
  check_positive(radius, "radius");
  double length = 0;
  equal_steps(curve, 1, length);
  const Index count = std::max<Index>(6, static_cast<Index>(std::lround(2 * kPi * radius / t.edge)));
  const Index rows = std::max<Index>(8, static_cast<Index>(std::lround(length / (kRowHeight * t.edge))));
  const FramedCurve f = framed(curve, equal_steps(curve, rows, length));
  PolygonSoup soup;
  Ring first, last;
  for (Index row = 0; row < rows; ++row) {
    const Vector3 up = f.tangent[row].cross(f.across[row]);
    const auto id = static_cast<std::uint64_t>(row);
    const double start = 0.5 * noise(t.seed, id) / count;
    Ring ring;
    for (Index i = 0; i < count; ++i) {
      const double turn =
          start + (i + t.irregularity * noise(t.seed + 1, id, static_cast<std::uint64_t>(i))) / count;
      const double angle = 2 * kPi * turn;
      ring.turn.push_back(turn);
      ring.vertex.push_back(detail::add_point(
          soup, f.point[row] + radius * (std::cos(angle) * f.across[row] + std::sin(angle) * up)));
    }
    if (row == 0)
      first = ring;
    else
      detail::zip(soup, last, ring);
    last = std::move(ring);
  }
  detail::zip(soup, last, first);
  return soup;
}

PolygonSoup make_csaszar_torus() {
  PolygonSoup soup;
  soup.points = {{3, -3, 0}, {-3, 3, 0}, {-3, -3, 1}, {3, 3, 1}, {-1, -2, 3}, {1, 2, 3}, {0, 0, 15}};
  constexpr Index kFaces[14][3] = {{0, 1, 2}, {3, 1, 0}, {0, 2, 6}, {4, 3, 0}, {5, 4, 0},
                                   {6, 5, 0}, {5, 2, 1}, {1, 3, 6}, {1, 4, 5}, {6, 4, 1},
                                   {2, 3, 4}, {5, 3, 2}, {2, 4, 6}, {3, 5, 6}};
  for (const auto& f : kFaces) soup.add_triangle(f[0], f[2], f[1]);
  return soup;
}

PolygonSoup moved(PolygonSoup soup, const Eigen::Matrix3d& turn, const Vector3& shift) {
  for (Vector3& p : soup.points) p = turn * p + shift;
  return soup;
}

PolygonSoup y_upward(PolygonSoup soup) {
  for (Vector3& p : soup.points) p = Vector3(p.x(), p.z(), -p.y());
  return soup;
}

void append(PolygonSoup& soup, const PolygonSoup& other) {
  const auto shift = static_cast<Index>(soup.points.size());
  const Index base = soup.begin.back();
  soup.points.insert(soup.points.end(), other.points.begin(), other.points.end());
  for (const Index c : other.corners) soup.corners.push_back(c + shift);
  for (std::size_t f = 1; f < other.begin.size(); ++f) soup.begin.push_back(base + other.begin[f]);
}

void reverse_orientation(PolygonSoup& soup) {
  for (std::size_t f = 0; f + 1 < soup.begin.size(); ++f)
    std::reverse(soup.corners.begin() + soup.begin[f], soup.corners.begin() + soup.begin[f + 1]);
}

}  // namespace mspskel
