#include <algorithm>
#include <cmath>
#include <memory>

#include "families.h"
#include "mspskel/samples/blocks.h"
#include "mspskel/samples/skin_graph.h"
#include "noise.h"

namespace mspskel::detail {

namespace {

double smooth_maximum(double a, double b, double blend) { return -smooth_minimum(-a, -b, blend); }

struct Hole {
  double x, y, radius;
};

// g holes in rows; no two alike, so that no two handles tie.
std::vector<Hole> plate_holes(Index count, Index columns, double pitch, const SampleOptions& o) {
  std::vector<Hole> holes;
  const Index rows = (count + columns - 1) / columns;
  for (Index i = 0; i < count; ++i) {
    const auto id = static_cast<std::uint64_t>(i);
    const Index row = i / columns, in_row = std::min(columns, count - row * columns);
    holes.push_back({pitch * (i % columns - 0.5 * (in_row - 1) + 0.04 * noise(o.seed, id, 0)),
                     pitch * (row - 0.5 * (rows - 1) + 0.04 * noise(o.seed, id, 1)),
                     0.5 * pitch * (o.ratio + 0.03 * noise(o.seed, id, 2))});
  }
  return holes;
}

Family plate() {
  SampleInfo info = with_ratio(
      with_count(facts("plate", "slab with round holes through it", 0, kNone, 4000, 300), "holes", 4, 0, 100),
      "hole diameter / distance of holes", 0.55, 0.2, 0.75);
  const auto make = [](const SampleOptions& o) {
    constexpr double kHalfThickness = 0.18, kRounding = 0.1;
    const auto columns = std::max<Index>(1, static_cast<Index>(std::ceil(std::sqrt(o.count))));
    const Index rows = std::max<Index>(1, (o.count + columns - 1) / columns);
    const double half_x = 0.5 * columns + 0.15, half_y = 0.5 * rows + 0.1;
    const auto holes = std::make_shared<std::vector<Hole>>(plate_holes(o.count, columns, 1.0, o));
    ImplicitSolid solid;
    solid.high = {half_x, half_y, kHalfThickness};
    solid.low = -solid.high;
    solid.value = [=](const Vector3& p) {
      double outline = rounded_box_distance({p.x(), p.y(), 0}, {half_x, half_y, 1}, 0.3);
      for (const Hole& hole : *holes)
        outline = std::max(outline, hole.radius - std::hypot(p.x() - hole.x, p.y() - hole.y));
      const double a = outline + kRounding, b = std::abs(p.z()) - kHalfThickness + kRounding;
      return std::min(std::max(a, b), 0.0) + std::hypot(std::max(a, 0.0), std::max(b, 0.0)) - kRounding;
    };
    return polygonise(solid, o.resolution, 0.5 * std::min(1 - o.ratio, o.ratio));
  };
  return {info, make, [](SampleInfo& i, const SampleOptions& o) {
            i.genus = o.count;
            i.resolution = std::max<Index>(2000, 600 * o.count);
            i.least_resolution = std::max<Index>(300, 150 * o.count);
          }};
}

// Two arches on a ball lean toward each other until their tubes nearly touch at the top.
Family handles() {
  SampleInfo info = with_ratio(facts("handles", "ball with two handles that almost touch", 2, 0, 4000, 1500),
                               "gap / diameter of a handle", 0.15, 0.1, 2.0);
  const auto make = [](const SampleOptions& o) {
    constexpr double kTube = 0.16, kBlend = 0.15;
    const auto arch = [&](double side) {
      BallGraph graph;
      graph.blend = 0;
      const double top = side * (kTube + kTube * o.ratio), foot = side * 0.62;
      constexpr Index kPieces = 24;
      for (Index i = 0; i <= kPieces; ++i) {
        const double angle = kPi * i / kPieces, lift = std::sin(angle);
        graph.nodes.push_back(
            {{0.8 * std::cos(angle), foot + (top - foot) * lift, 0.35 + 1.25 * lift}, kTube});
        if (i > 0) graph.edges.emplace_back(i - 1, i);
      }
      return skin_solid(graph);
    };
    const ImplicitSolid left = arch(-1), right = arch(1);
    ImplicitSolid solid;
    solid.low = {-1.2, -1.2, -1.2};
    solid.high = {1.2, 1.2, 2.0};
    solid.value = [=](const Vector3& p) {
      return smooth_minimum(p.norm() - 1, std::min(left.value(p), right.value(p)), kBlend);
    };
    return y_upward(polygonise(solid, o.resolution, std::min(0.08, 0.85 * 2 * kTube * o.ratio)));
  };
  return {info, make, {}};
}

// The trefoil cut open at its outermost point, both ends bent outward and led out through the same side.
BallGraph open_trefoil(double radius) {
  constexpr Index kPieces = 120, kBend = 12;
  constexpr double kCut = 0.06;
  BallGraph graph;
  graph.blend = 0;
  const auto curve = [](double u) {
    const double a = 4 * kPi * u, b = 6 * kPi * u, rho = 2 + 0.8 * std::cos(b);
    return Vector3(rho * std::cos(a), rho * std::sin(a), -0.8 * std::sin(b));
  };
  // A parabola from the curve's end, there along the curve, at last along x.
  const auto bend = [&](double u, double ahead, Index i) {
    const Vector3 end = curve(u), corner = end + 1.1 * (curve(u + ahead) - end).normalized();
    const double t = static_cast<double>(i) / kBend;
    return Vector3((1 - t) * (1 - t) * end + 2 * t * (1 - t) * corner +
                   t * t * (corner + Vector3(1.4, 0, 0)));
  };
  const Vector3 outside(3, 0, 0);
  graph.nodes.push_back({bend(kCut, -1e-4, kBend) + outside, radius});
  for (Index i = kBend; i > 0; --i) graph.nodes.push_back({bend(kCut, -1e-4, i), radius});
  for (Index i = 0; i <= kPieces; ++i)
    graph.nodes.push_back({curve(kCut + (1 - 2 * kCut) * i / kPieces), radius});
  for (Index i = 1; i <= kBend; ++i) graph.nodes.push_back({bend(1 - kCut, 1e-4, i), radius});
  graph.nodes.push_back({bend(1 - kCut, 1e-4, kBend) + outside, radius});
  for (Index i = 0; i + 1 < static_cast<Index>(graph.nodes.size()); ++i) graph.edges.emplace_back(i, i + 1);
  return graph;
}

Family knotted_tunnel() {
  SampleInfo info =
      with_ratio(facts("knotted-tunnel", "block with a tunnel through it that is knotted as a trefoil", 1,
                       kNone, 6000, 2000),
                 "tunnel radius / distance of the tunnel's strands", 0.25, 0.15, 0.3);
  const auto make = [](const SampleOptions& o) {
    const double radius = 1.6 * o.ratio;
    const ImplicitSolid tunnel = skin_solid(open_trefoil(radius));
    const Vector3 half(3.7, 3.7, 1.7);
    ImplicitSolid solid;
    solid.low = -half;
    solid.high = half;
    solid.value = [=](const Vector3& p) {
      const double box = rounded_box_distance(p, half, 0.4);
      return box > 0.5 ? box : smooth_maximum(box, -tunnel.value(p), 0.2);
    };
    return polygonise(solid, o.resolution, std::min(0.6 * radius, 0.3));
  };
  return {info, make, {}};
}

// A profile of constant thickness turned round the axis, with a handle on one side.
Family cup() {
  SampleInfo info = with_ratio(facts("cup", "thin-walled cup with a handle", 1, kNone, 6000, 2500),
                               "wall / radius", 0.14, 0.08, 0.25);
  const auto make = [](const SampleOptions& o) {
    const double wall = o.ratio / 2;
    const BallNode center{{0, 0, -1}, wall}, edge{{0.8, 0, -1}, wall}, rim{{1, 0, 1}, wall};
    BallGraph handle;
    handle.blend = 0;
    constexpr Index kPieces = 20;
    for (Index i = 0; i <= kPieces; ++i) {
      const double angle = kPi * (i - 0.5 * kPieces) / kPieces;
      handle.nodes.push_back(
          {{0.97 + 0.65 * std::cos(angle) + 0.06 * std::sin(angle), 0, 0.05 + 0.6 * std::sin(angle)}, 0.11});
      if (i > 0) handle.edges.emplace_back(i - 1, i);
    }
    const ImplicitSolid grip = skin_solid(handle);
    ImplicitSolid solid;
    solid.low = {-1.2, -1.2, -1.2};
    solid.high = {1.9, 1.2, 1.2};
    solid.value = [=](const Vector3& p) {
      const Vector3 q(std::hypot(p.x(), p.y()), 0, p.z());
      const double body = std::min(round_cone_distance(q, center, edge), round_cone_distance(q, edge, rim));
      // The handle ends in the wall: what reaches into the cup is cut off along the wall's middle.
      const double beyond = 0.9 + 0.1 * p.z() - q.x();
      return smooth_minimum(body, std::max(grip.value(p), beyond), 0.08);
    };
    return y_upward(polygonise(solid, o.resolution, 0.5 * o.ratio));
  };
  return {info, make, [](SampleInfo& i, const SampleOptions& o) {
            i.least_resolution = std::max<Index>(3000, static_cast<Index>(60 / (o.ratio * o.ratio)));
            i.resolution = 2 * i.least_resolution;
          }};
}

}  // namespace

std::vector<Family> block_families() { return {plate(), handles(), knotted_tunnel(), cup()}; }

}  // namespace mspskel::detail
