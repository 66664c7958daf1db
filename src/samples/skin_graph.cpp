#include "mspskel/samples/skin_graph.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "mspskel/base/error.h"

namespace mspskel {

namespace {
struct ConePoint {
  double distance;  // negative inside
  double radius;    // of the ball that touches there
};

//   In the half-plane over the axis, x along it from a, y away from it, the cone's flank is a line that both
//   circles touch; it leans by the angle whose sine is (r_a - r_b) / |ab|. Points behind the flank's ends see
//   a circle.
ConePoint nearest_on_cone(const Vector3& p, const BallNode& a, const BallNode& b) {
  const Vector3 axis = b.position - a.position, to_p = p - a.position;
  const double length = axis.norm();
  const double sine = (a.radius - b.radius) / std::max(length, 1e-300);
  const auto at_a = [&] { return ConePoint{to_p.norm() - a.radius, a.radius}; };
  const auto at_b = [&] { return ConePoint{(p - b.position).norm() - b.radius, b.radius}; };
  if (std::abs(sine) >= 1) return a.radius > b.radius ? at_a() : at_b();  // one ball contains the other
  const double x = to_p.dot(axis) / length, y = std::sqrt(std::max(0.0, to_p.squaredNorm() - x * x));
  const double cosine = std::sqrt(1 - sine * sine);
  const double along = x * cosine - y * sine;  // of the flank, 0 where it leaves a
  if (along <= 0) return at_a();
  if (along >= length * cosine) return at_b();
  return {y * cosine + x * sine - a.radius, a.radius + along / (length * cosine) * (b.radius - a.radius)};
}
}  // namespace

double round_cone_distance(const Vector3& p, const BallNode& a, const BallNode& b) {
  return nearest_on_cone(p, a, b).distance;
}

double smooth_minimum(double a, double b, double blend) {
  const double h = blend - std::abs(a - b);
  return std::min(a, b) - (h > 0 ? h * h / (4 * blend) : 0.0);
}

namespace {
struct Limb {
  BallNode a, b;
  double blend;
};

// Of a limb's radius: wider fillets would thicken a chain of short limbs at its nodes.
constexpr double kWidestBlend = 0.6;
constexpr double kWidthSlope = 0.25;  // of the width away from a limb, as ImplicitSolid says

// A tree of boxes over the limbs: whole branches are passed over that lie farther away than what counts.
class LimbTree {
 public:
  explicit LimbTree(std::vector<Limb> limbs) : limbs_(std::move(limbs)) {
    std::vector<Index> all(limbs_.size());
    std::iota(all.begin(), all.end(), 0);
    build(all, 0, static_cast<Index>(all.size()));
    order_ = std::move(all);
  }

  // The limbs' smooth minimum in their order. A limb farther than the nearest one by three fillets leaves no
  // trace.
  double value(const Vector3& p) const {
    thread_local std::vector<std::pair<Index, double>> near;
    near.clear();
    double nearest = 1e300;
    visit(
        p, [&](const Branch& branch, double away) { return away < nearest + kFillets * branch.blend; },
        [&](Index limb) {
          const double distance = nearest_on_cone(p, limbs_[limb].a, limbs_[limb].b).distance;
          nearest = std::min(nearest, distance);
          near.emplace_back(limb, distance);
        });
    std::sort(near.begin(), near.end());
    double result = 1e300;
    for (const auto& [limb, distance] : near) {
      const double blend = limbs_[limb].blend;
      if (distance > nearest + kFillets * blend) continue;
      result = blend > 0 ? smooth_minimum(result, distance, blend) : std::min(result, distance);
    }
    return result;
  }

  double width(const Vector3& p) const {
    double least = 1e300;
    visit(
        p,
        [&](const Branch& branch, double away) {
          return branch.least_radius + kWidthSlope * std::max(0.0, away) < least;
        },
        [&](Index limb) {
          const ConePoint near = nearest_on_cone(p, limbs_[limb].a, limbs_[limb].b);
          least = std::min(least, near.radius + kWidthSlope * std::max(0.0, near.distance));
        });
    return least;
  }

 private:
  static constexpr double kFillets = 3;
  static constexpr Index kLeafSize = 4;
  struct Branch {
    Vector3 low, high;                        // of the limbs with their radii
    double least_radius, most_radius, blend;  // blend: the widest
    Index first, last;                        // limbs in order_
    Index second_child;                       // the first one follows; 0 at a leaf
  };

  Index build(std::vector<Index>& order, Index first, Index last) {
    Branch branch{Vector3::Constant(1e300), Vector3::Constant(-1e300), 1e300, 0, 0, first, last, 0};
    for (Index i = first; i < last; ++i) {
      const Limb& limb = limbs_[order[i]];
      for (const BallNode& ball : {limb.a, limb.b}) {
        branch.low = branch.low.cwiseMin(ball.position - Vector3::Constant(ball.radius));
        branch.high = branch.high.cwiseMax(ball.position + Vector3::Constant(ball.radius));
        branch.least_radius = std::min(branch.least_radius, ball.radius);
        branch.most_radius = std::max(branch.most_radius, ball.radius);
      }
      branch.blend = std::max(branch.blend, limb.blend);
    }
    const auto number = static_cast<Index>(branches_.size());
    branches_.push_back(branch);
    if (last - first <= kLeafSize) return number;
    Eigen::Index axis = 0;
    (branch.high - branch.low).maxCoeff(&axis);
    const Index middle = first + (last - first) / 2;
    std::nth_element(order.begin() + first, order.begin() + middle, order.begin() + last,
                     [&](Index i, Index j) {
                       const double x = limbs_[i].a.position[axis] + limbs_[i].b.position[axis],
                                    y = limbs_[j].a.position[axis] + limbs_[j].b.position[axis];
                       return x < y || (x == y && i < j);
                     });
    build(order, first, middle);
    const Index second = build(order, middle, last);
    branches_[number].second_child = second;
    return number;
  }

  // At most the distance to any limb of the branch.
  static double away(const Branch& branch, const Vector3& p) {
    const Vector3 gap = (branch.low - p).cwiseMax(p - branch.high).cwiseMax(0.0);
    const double distance = gap.norm();
    return distance > 0 ? distance : -branch.most_radius;
  }

  // Nearer branches first, so that much is passed over.
  template <class Counts, class Take>
  void visit(const Vector3& p, const Counts& counts, const Take& take, Index number = 0) const {
    const Branch& branch = branches_[number];
    if (branch.second_child == 0) {
      for (Index i = branch.first; i < branch.last; ++i) take(order_[i]);
      return;
    }
    Index children[2] = {number + 1, branch.second_child};
    double distance[2] = {away(branches_[children[0]], p), away(branches_[children[1]], p)};
    if (distance[1] < distance[0]) {
      std::swap(children[0], children[1]);
      std::swap(distance[0], distance[1]);
    }
    for (int k = 0; k < 2; ++k)
      if (counts(branches_[children[k]], distance[k])) visit(p, counts, take, children[k]);
  }

  std::vector<Limb> limbs_;
  std::vector<Index> order_;
  std::vector<Branch> branches_;
};
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
  std::vector<Limb> limbs;
  for (const auto& [i, j] : graph.edges) {
    const BallNode &a = graph.nodes.at(static_cast<std::size_t>(i)),
                   &b = graph.nodes.at(static_cast<std::size_t>(j));
    limbs.push_back({a, b, std::min(graph.blend, kWidestBlend * std::min(a.radius, b.radius))});
  }
  const auto tree = std::make_shared<const LimbTree>(std::move(limbs));
  solid.value = [tree](const Vector3& p) { return tree->value(p); };
  solid.width = [tree](const Vector3& p) { return tree->width(p); };
  return solid;
}

PolygonSoup skin_graph(const BallGraph& graph, Index vertices) {
  double smallest = 1e300;
  for (const BallNode& node : graph.nodes) smallest = std::min(smallest, node.radius);
  return polygonise(skin_solid(graph), vertices, 0.9 * smallest);
}

PolygonSoup skin_graph_by_width(const BallGraph& graph, Index vertices) {
  return polygonise_by_width(skin_solid(graph), vertices);
}

}  // namespace mspskel
