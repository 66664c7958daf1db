#include "mspskel/samples/skin_graph.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "mspskel/base/error.h"

namespace mspskel {

//   In the half-plane over the axis, x along it from a, y away from it, the cone's flank is a line that both
//   circles touch; it leans by the angle whose sine is (r_a - r_b) / |ab|. Points behind the flank's ends see
//   a circle.
double round_cone_distance(const Vector3& p, const BallNode& a, const BallNode& b) {
  const Vector3 axis = b.position - a.position, to_p = p - a.position;
  const double length = axis.norm();
  const double sine = (a.radius - b.radius) / std::max(length, 1e-300);
  if (std::abs(sine) >= 1)  // one ball contains the other
    return a.radius > b.radius ? to_p.norm() - a.radius : (p - b.position).norm() - b.radius;
  const double x = to_p.dot(axis) / length, y = std::sqrt(std::max(0.0, to_p.squaredNorm() - x * x));
  const double cosine = std::sqrt(1 - sine * sine);
  const double along = x * cosine - y * sine;  // of the flank, 0 where it leaves a
  if (along <= 0) return to_p.norm() - a.radius;
  if (along >= length * cosine) return (p - b.position).norm() - b.radius;
  return y * cosine + x * sine - a.radius;
}

double smooth_minimum(double a, double b, double blend) {
  const double h = blend - std::abs(a - b);
  return std::min(a, b) - (h > 0 ? h * h / (4 * blend) : 0.0);
}

namespace {
// A round cone and the ball round it, by which far cones are passed over.
struct Limb {
  BallNode a, b;
  Vector3 middle;
  double reach, blend;
};
// Of a limb's radius: wider fillets would thicken a chain of short limbs at its nodes.
constexpr double kWidestBlend = 0.6;
}  // namespace

ImplicitSolid skin_solid(const BallGraph& graph) {
  if (graph.edges.empty()) throw UsageError("the graph has no edges");
  ImplicitSolid solid;
  solid.low = Vector3::Constant(1e300);
  solid.high = -solid.low;
  for (const BallNode& node : graph.nodes) {
    if (!(node.radius > 0)) throw UsageError("every node needs a positive radius");
    const double reach = node.radius + graph.blend;
    solid.low = solid.low.cwiseMin(node.position - Vector3::Constant(reach));
    solid.high = solid.high.cwiseMax(node.position + Vector3::Constant(reach));
  }
  auto limbs = std::make_shared<std::vector<Limb>>();
  for (const auto& [i, j] : graph.edges) {
    const BallNode &a = graph.nodes.at(static_cast<std::size_t>(i)),
                   &b = graph.nodes.at(static_cast<std::size_t>(j));
    limbs->push_back({a, b, 0.5 * (a.position + b.position),
                      0.5 * (a.position - b.position).norm() + std::max(a.radius, b.radius),
                      std::min(graph.blend, kWidestBlend * std::min(a.radius, b.radius))});
  }
  solid.value = [limbs](const Vector3& p) {
    double result = 1e300;
    for (const Limb& limb : *limbs) {
      // A limb whose ball is farther than the result by the blend leaves no trace.
      const double margin = result + limb.blend + limb.reach;
      if (margin < 0 || (p - limb.middle).squaredNorm() > margin * margin) continue;
      const double distance = round_cone_distance(p, limb.a, limb.b);
      result = limb.blend > 0 ? smooth_minimum(result, distance, limb.blend) : std::min(result, distance);
    }
    return result;
  };
  return solid;
}

PolygonSoup skin_graph(const BallGraph& graph, Index vertices) {
  double smallest = 1e300;
  for (const BallNode& node : graph.nodes) smallest = std::min(smallest, node.radius);
  return polygonise(skin_solid(graph), vertices, 0.9 * smallest);
}

}  // namespace mspskel
