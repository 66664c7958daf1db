#include <cmath>

#include "families.h"
#include "mspskel/samples/skin_graph.h"
#include "truth.h"

namespace mspskel::detail {

namespace {

// A round body with limbs and handles that begin on its axis, cut off by planes across z.
struct Vessel {
  BallGraph graph;
  TruthGraph truth;
  double floor = -1e300, ceiling = 1e300, thinnest = 1e300;

  void body(const std::vector<BallNode>& profile) { chain(profile); }

  // A tube through these places, the first of which is a joint in the body, with a round end.
  void limb(const std::vector<Vector3>& places, double radius, double joint) {
    tube(places, radius);
    const Vector3 &before = places[places.size() - 2], &end = places.back();
    for (std::size_t i = 1; i + 1 < places.size(); ++i)
      truth.arc(places[i - 1], i == 1 ? joint : radius, places[i], radius);
    truth.limb(before, places.size() == 2 ? joint : radius, end + radius * (end - before).normalized(),
               radius);
  }
  // A tube from joint to joint.
  void handle(const std::vector<Vector3>& places, double radius, double first_joint, double last_joint) {
    tube(places, radius);
    for (std::size_t i = 1; i < places.size(); ++i)
      truth.arc(places[i - 1], i == 1 ? first_joint : radius, places[i],
                i + 1 == places.size() ? last_joint : radius);
  }

  ImplicitSolid solid() const {
    ImplicitSolid skin = skin_solid(graph);
    skin.low.z() = std::max(skin.low.z(), floor);
    skin.high.z() = std::min(skin.high.z(), ceiling);
    skin.value = [value = skin.value, low = floor, high = ceiling](const Vector3& p) {
      constexpr double kRounding = 0.08;
      const double cut = std::max(p.z() - high, low - p.z());
      return -smooth_minimum(-value(p), -cut, kRounding);
    };
    return skin;
  }

 private:
  void tube(const std::vector<Vector3>& places, double radius) {
    std::vector<BallNode> nodes;
    for (const Vector3& place : places) nodes.push_back({place, radius});
    chain(nodes);
    thinnest = std::min(thinnest, radius);
  }

  void chain(const std::vector<BallNode>& nodes) {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      graph.nodes.push_back(nodes[i]);
      const auto last = static_cast<Index>(graph.nodes.size()) - 1;
      if (i > 0) graph.edges.emplace_back(last - 1, last);
    }
  }
};

using BuildVessel = Vessel (*)(const SampleOptions&);

Family vessel_family(const SampleInfo& info, BuildVessel build,
                     const std::function<void(SampleInfo&, const SampleOptions&)>& adapt = {}) {
  const auto make = [build](const SampleOptions& o) {
    const Vessel vessel = build(o);
    return y_upward(polygonise(vessel.solid(), o.resolution, 0.9 * vessel.thinnest));
  };
  return {info, make, adapt,
          [build](const SampleOptions& o) { return y_upward(std::move(build(o).truth).result()); }};
}

// Its axis leads from the middle of the foot to that of the mouth. Handles join it at two heights.
Family vase() {
  const auto build = [](const SampleOptions& o) {
    constexpr double kHeight = 6, kLow = 1.7, kHigh = 4.3, kBelly = 1.3, kNeck = 0.5, kFoot = 0.7,
                     kMouth = 0.65;
    Vessel vessel;
    vessel.graph.blend = 0.15;
    vessel.floor = 0;
    vessel.ceiling = kHeight;
    vessel.thinnest = kNeck;
    vessel.body({{{0, 0, 0}, kFoot},
                 {{0, 0, kLow}, kBelly},
                 {{0, 0, 3.3}, 0.75},
                 {{0, 0, kHigh}, kNeck},
                 {{0, 0, kHeight}, kMouth}});
    const Vector3 low(0, 0, kLow), high(0, 0, kHigh), middle(0, 0, 0.5 * (kLow + kHigh));
    vessel.truth.limb(low, kBelly, {0, 0, 0}, kFoot);
    vessel.truth.limb(high, kNeck, {0, 0, kHeight}, kMouth);
    vessel.truth.arc(low, kBelly, high, kNeck);
    for (Index i = 0; i < o.count; ++i) {
      const double turn = 2 * kPi * i / o.count;
      std::vector<Vector3> places{low};
      constexpr Index kPieces = 16;
      for (Index k = 0; k <= kPieces; ++k) {
        const double angle = kPi * (k - 0.5 * kPieces) / kPieces, out = 0.3 + 1.9 * std::cos(angle);
        places.push_back({out * std::cos(turn), out * std::sin(turn),
                          middle.z() + 0.5 * (kHigh - kLow) * std::sin(angle)});
      }
      places.push_back(high);
      vessel.handle(places, 0.17, kBelly, kNeck);
    }
    return vessel;
  };
  return vessel_family(with_count(facts("vase", "a round solid with foot, belly, neck and mouth, and handles",
                                        2, 2, 4000, 1500),
                                  "handles", 2, 0, 3),
                       build, [](SampleInfo& i, const SampleOptions& o) {
                         i.genus = o.count;
                         i.resolution = 2500 + 750 * o.count;
                         i.least_resolution = 700 + 500 * o.count;
                       });
}

// The body is one joint, as wide as it is; from its middle lead the spout, the knob and both ends of the
// handle.
Family teapot() {
  const auto build = [](const SampleOptions&) {
    constexpr double kBody = 1.3, kSpout = 0.24, kKnob = 0.22;
    const Vector3 middle(0, 0, 0);
    Vessel vessel;
    vessel.graph.blend = 0.15;
    vessel.floor = -1;
    vessel.body({{{0, 0, -0.05}, kBody}, {{0, 0, 0.05}, kBody}});
    const Vector3 spout(3.04, 0, 1.36), bend(2.1, 0, 0.6), root(1.2, 0, -0.1), knob(0, 0, 2);
    vessel.limb({middle, root, bend, spout}, kSpout, kBody);
    vessel.limb({middle, knob}, kKnob, kBody);
    std::vector<Vector3> handle{middle};
    constexpr Index kPieces = 16;
    for (Index k = 0; k <= kPieces; ++k) {
      const double angle = kPi * (k - 0.5 * kPieces) / kPieces;
      handle.push_back({-1 - 1.2 * std::cos(angle), 0, 0.05 + 0.6 * std::sin(angle)});
    }
    handle.push_back(middle);
    vessel.handle(handle, 0.15, kBody, kBody);
    return vessel;
  };
  return vessel_family(facts("teapot", "a round body with a spout, a knob and a handle", 1, 2, 4000, 2000),
                       build);
}

}  // namespace

std::vector<Family> vessel_families() { return {vase(), teapot()}; }

}  // namespace mspskel::detail
