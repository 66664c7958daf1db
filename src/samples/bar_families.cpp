#include <algorithm>
#include <array>
#include <cmath>

#include "families.h"
#include "mspskel/base/error.h"
#include "mspskel/samples/blocks.h"
#include "truth.h"

namespace mspskel::detail {

namespace {

const std::array<Vector3, 6> kDirections{Vector3(1, 0, 0),  Vector3(-1, 0, 0), Vector3(0, 1, 0),
                                         Vector3(0, -1, 0), Vector3(0, 0, 1),  Vector3(0, 0, -1)};

// Bars and the axes that they were made round.
struct BarModel {
  std::vector<Block> blocks;
  TruthGraph truth;
  double thinnest = 1e300;  // half width of the thinnest bar

  void add(const Vector3& from, const Vector3& to, double half_width, bool round) {
    blocks.push_back(bar(from, to, half_width, round));
    thinnest = std::min(thinnest, half_width);
  }
};

bool is_round(const SampleOptions& o) { return o.section == Section::kRound; }

// Boxes keep their edges; where a cylinder is among the blocks all edges are a little rounded.
PolygonSoup make_bars(const BarModel& model, const SampleOptions& o) {
  const bool boxes = std::all_of(model.blocks.begin(), model.blocks.end(),
                                 [](const Block& b) { return b.shape == Block::Shape::kBox; });
  if (boxes) return make_boxes(model.blocks, o.resolution, Tessellation().irregularity, o.seed);
  return polygonise(blocks_solid(model.blocks, 0.15 * model.thinnest), o.resolution, 0.7 * model.thinnest);
}

using Build = BarModel (*)(const SampleOptions&);

Family bar_family(const SampleInfo& info, Build build,
                  const std::function<void(SampleInfo&, const SampleOptions&)>& adapt = {}) {
  return {info, [build](const SampleOptions& o) { return make_bars(build(o), o); }, adapt,
          [build](const SampleOptions& o) { return std::move(build(o).truth).result(); }};
}

Family hammer() {
  const auto build = [](const SampleOptions& o) {
    constexpr double kHead = 3.5, kHandle = 9;
    BarModel model;
    model.add({-kHead, 0, 0}, {kHead, 0, 0}, 1, is_round(o));
    model.add({0, 0, 0}, {0, 0, -kHandle}, o.ratio, is_round(o));
    for (const double side : {-1.0, 1.0}) model.truth.limb({0, 0, 0}, 1, {side * kHead, 0, 0}, 1);
    model.truth.limb({0, 0, 0}, 1, {0, 0, -kHandle}, o.ratio);
    return model;
  };
  return bar_family(
      with_ratio(with_sections(facts("hammer", "a handle in the middle of a head", 0, 3, 2500, 1000),
                               Section::kSquare),
                 "width of the handle / width of the head", 0.4, 0.15, 0.9),
      build);
}

Family tee() {
  const auto build = [](const SampleOptions& o) {
    BarModel model;
    model.add({-5, 0, 0}, {5, 0, 0}, 1, is_round(o));
    model.add({0, 0, 0}, {0, 0, 6}, o.ratio, is_round(o));
    for (const double side : {-1.0, 1.0}) model.truth.limb({0, 0, 0}, 1, {side * 5, 0, 0}, 1);
    model.truth.limb({0, 0, 0}, 1, {0, 0, 6}, o.ratio);
    return model;
  };
  return bar_family(
      with_ratio(with_sections(facts("tee", "a pipe with a branch", 0, 3, 2500, 1000), Section::kRound),
                 "width of the branch / width of the pipe", 0.8, 0.2, 1),
      build);
}

Family cross() {
  const auto build = [](const SampleOptions& o) {
    BarModel model;
    for (Index i = 0; i < o.count; ++i) {
      const Vector3& way = kDirections[static_cast<std::size_t>(i)];
      model.add({0, 0, 0}, 6 * way, 1, is_round(o));
      model.truth.limb({0, 0, 0}, 1, 6 * way, 1);
    }
    return model;
  };
  return bar_family(with_count(with_sections(facts("cross", "equal arms along the axes", 0, 4, 2500, 1000),
                                             Section::kRound),
                               "arms", 4, 3, 6),
                    build, [](SampleInfo& i, const SampleOptions& o) { i.leaves = o.count; });
}

// One rod goes on through the cube to the opposite side, as the handle of a mace does.
Family cube_rods() {
  const auto build = [](const SampleOptions& o) {
    BarModel model;
    model.blocks.push_back({Vector3::Constant(-1), Vector3::Constant(1)});
    for (Index i = 0; i < o.count; ++i) {
      const Vector3& way = kDirections[static_cast<std::size_t>(i)];
      model.add({0, 0, 0}, 4.5 * way, o.ratio, is_round(o));
      model.truth.limb({0, 0, 0}, 1, 4.5 * way, o.ratio);
    }
    if (o.count == 1) model.truth.limb({0, 0, 0}, 1, -kDirections[0], 1);
    return model;
  };
  return bar_family(
      with_ratio(with_count(with_sections(facts("cube-rods", "a cube with rods in the middles of its sides",
                                                0, 6, 2500, 1000),
                                          Section::kSquare),
                            "rods", 6, 1, 6),
                 "width of a rod / width of the cube", 0.25, 0.1, 0.6),
      build, [](SampleInfo& i, const SampleOptions& o) { i.leaves = std::max<Index>(2, o.count); });
}

Family comb() {
  const auto build = [](const SampleOptions& o) {
    constexpr double kPitch = 1.5, kTooth = 5, kRest = 2.5;
    const double end = 0.5 * kPitch * (o.count - 1) + kRest;
    BarModel model;
    model.add({-end, 0, 0}, {end, 0, 0}, 0.5, is_round(o));
    for (Index i = 0; i < o.count; ++i) {
      const Vector3 root(kPitch * (i - 0.5 * (o.count - 1)), 0, 0), tip = root + Vector3(0, 0, kTooth);
      model.add(root, tip, 0.5 * o.ratio, is_round(o));
      if (i > 0) model.truth.arc(root - Vector3(kPitch, 0, 0), 0.5, root, 0.5);
      model.truth.limb(root, 0.5, tip, 0.5 * o.ratio);
    }
    for (const double side : {-1.0, 1.0})
      model.truth.limb({side * (end - kRest), 0, 0}, 0.5, {side * end, 0, 0}, 0.5);
    return model;
  };
  return bar_family(
      with_ratio(with_count(with_sections(facts("comb", "a spine with teeth on one side", 0, 7, 4000, 1500),
                                          Section::kSquare),
                            "teeth", 5, 2, 40),
                 "width of a tooth / width of the spine", 0.5, 0.2, 1),
      build, [](SampleInfo& i, const SampleOptions& o) {
        i.leaves = o.count + 2;
        i.resolution = 1500 + 500 * o.count;
        i.least_resolution = 600 + 200 * o.count;
      });
}

Family ladder() {
  const auto build = [](const SampleOptions& o) {
    constexpr double kPitch = 1.8, kHalfApart = 1.6, kRest = 1.8, kRail = 0.35, kRung = 0.22;
    BarModel model;
    const double end = 0.5 * kPitch * (o.count - 1) + kRest;
    for (const double side : {-kHalfApart, kHalfApart}) {
      model.add({side, 0, -end}, {side, 0, end}, kRail, is_round(o));
      for (const double up : {-1.0, 1.0})
        model.truth.limb({side, 0, up * (end - kRest)}, kRail, {side, 0, up * end}, kRail);
    }
    for (Index i = 0; i < o.count; ++i) {
      const Vector3 left(-kHalfApart, 0, kPitch * (i - 0.5 * (o.count - 1)));
      const Vector3 right = left + Vector3(2 * kHalfApart, 0, 0), step(0, 0, kPitch);
      model.add(left, right, kRung, is_round(o));
      model.truth.arc(left, kRail, right, kRail);
      if (i == 0) continue;
      model.truth.arc(left - step, kRail, left, kRail);
      model.truth.arc(right - step, kRail, right, kRail);
    }
    return model;
  };
  return bar_family(
      with_count(with_sections(facts("ladder", "two rails and rungs", 4, 4, 5000, 2000), Section::kSquare),
                 "rungs", 5, 2, 40),
      build, [](SampleInfo& i, const SampleOptions& o) {
        i.genus = o.count - 1;
        i.resolution = 1500 + 700 * o.count;
        i.least_resolution = 800 + 300 * o.count;
      });
}

Family lattice() {
  const auto build = [](const SampleOptions& o) {
    constexpr double kPitch = 3, kHalf = 0.35;
    BarModel model;
    const Index n = o.count;
    const double end = kPitch * (n - 1) + kHalf;
    for (int axis = 0; axis < 3; ++axis)
      for (Index a = 0; a < n; ++a)
        for (Index b = 0; b < n; ++b) {
          Vector3 from = Vector3::Constant(-kHalf);
          from[(axis + 1) % 3] = kPitch * a;
          from[(axis + 2) % 3] = kPitch * b;
          Vector3 to = from, node = from;
          to[axis] = end;
          model.add(from, to, kHalf, is_round(o));
          for (Index i = 0; i + 1 < n; ++i) {
            node[axis] = kPitch * i;
            model.truth.arc(node, kHalf, node + kPitch * Vector3::Unit(axis), kHalf);
          }
        }
    return model;
  };
  return bar_family(
      with_count(with_sections(facts("lattice", "bars along the edges of stacked cubes", 5, 0, 4000, 1500),
                               Section::kSquare),
                 "bars side by side", 2, 2, 6),
      build, [](SampleInfo& i, const SampleOptions& o) {
        const Index n = o.count, bars = 3 * n * n * (n - 1);
        i.genus = bars - n * n * n + 1;
        i.resolution = 350 * bars;
        i.least_resolution = 130 * bars;
      });
}

// Where the legs of a table stand, in [-1, 1]²: on a circle, or in equal steps round a square.
Vector3 place_of_leg(Index i, const SampleOptions& o) {
  if (is_round(o)) {
    const double angle = 2 * kPi * (i + 0.1) / o.count;
    return {std::cos(angle), std::sin(angle), 0};
  }
  const double round = 8.0 * i / o.count;
  const auto coordinate = [](double s) {  // -1 to 1, there, back to -1, there, in steps of a sixth
    const double t = std::fmod(s + 8, 8);
    return std::round(6 * (t < 2 ? t - 1 : t < 4 ? 1 : t < 6 ? 5 - t : -1)) / 6;
  };
  return {coordinate(round), coordinate(round - 2), 0};
}

// Within the top the arcs lead straight to the legs; it is all one joint.
Family table() {
  const auto build = [](const SampleOptions& o) {
    constexpr double kHalfTop = 2, kHalfThick = 0.15, kLeg = 0.16, kHeight = 2.6;
    const double corner = is_round(o) ? 1 : std::sqrt(2.0);
    BarModel model;
    model.add({0, 0, -kHalfThick}, {0, 0, kHalfThick}, kHalfTop, is_round(o));
    model.thinnest = kHalfThick;
    for (Index i = 0; i < o.count; ++i) {
      const Vector3 top = o.ratio * (kHalfTop - kLeg) * place_of_leg(i, o),
                    foot = top - Vector3(0, 0, kHeight);
      model.add(top, foot, kLeg, is_round(o));
      model.truth.arc({0, 0, 0}, corner * kHalfTop, top, kLeg);
      model.truth.limb(top, kLeg, foot, kLeg);
    }
    return model;
  };
  return standing(bar_family(
      with_ratio(with_count(with_sections(facts("table", "a table, its top as square or round as its legs", 0,
                                                4, 4000, 2000),
                                          Section::kSquare),
                            "legs", 4, 3, 8),
                 "distance of the legs from the middle / that of legs at the rim", 1, 0.4, 1),
      build, [](SampleInfo& i, const SampleOptions& o) { i.leaves = o.count; }));
}

// The back is as wide as the seat; it is known where it ends, and its arc is a matter of taste near the seat.
Family chair() {
  const auto build = [](const SampleOptions& o) {
    constexpr double kHalfSeat = 2, kHalfThick = 0.2, kLeg = 0.2, kHeight = 4;
    constexpr double kEdge = kHalfSeat - kHalfThick;
    const double top = kHalfThick + 2 * kHalfSeat * o.ratio;
    BarModel model;
    model.blocks.push_back({{-kHalfSeat, -kHalfSeat, -kHalfThick}, {kHalfSeat, kHalfSeat, kHalfThick}});
    model.blocks.push_back({{-kHalfSeat, kEdge - kHalfThick, -kHalfThick}, {kHalfSeat, kHalfSeat, top}});
    for (const double x : {-1.0, 1.0})
      for (const double y : {-1.0, 1.0}) {
        const Vector3 root = (kHalfSeat - kLeg) * Vector3(x, y, 0), foot = root - Vector3(0, 0, kHeight);
        model.add(root, foot, kLeg, false);
        model.truth.arc({0, 0, 0}, std::sqrt(2.0) * kHalfSeat, root, kLeg);
        model.truth.limb(root, kLeg, foot, kLeg);
      }
    const Vector3 root(0, kEdge, 0);
    model.truth.arc({0, 0, 0}, std::sqrt(2.0) * kHalfSeat, root, kHalfSeat);
    model.truth.limb(root, kHalfSeat, {0, kEdge, top}, std::sqrt(kHalfSeat * kHalfThick));
    return model;
  };
  return standing(
      bar_family(with_ratio(facts("chair", "a chair whose back is as wide as its seat", 0, 5, 3000, 1000),
                            "height of the back / its width", 1, 0.6, 2),
                 build));
}

// The axis along the longest side, from end to end. What is nearly as wide as long has none that is better
// than another.
CurveSkeleton longest_axis(const Vector3& sides) {
  Eigen::Index axis = 0;
  const double length = sides.maxCoeff(&axis), a = sides[(axis + 1) % 3], b = sides[(axis + 2) % 3];
  if (length < 1.5 * std::max(a, b))
    throw UsageError(
        "a solid that is not half as long again as wide has no defined skeleton; use other --sides");
  const Vector3 end = 0.5 * length * Vector3::Unit(axis);
  return axis_between(-end, end, 0.5 * std::sqrt(a * b));
}

Family box() {
  return {with_sides(facts("box", "a box of given sides", 0, 2, 1500, 40), {10, 5, 2}),
          [](const SampleOptions& o) {
            return make_boxes({{-0.5 * o.sides, 0.5 * o.sides}}, o.resolution, Tessellation().irregularity,
                              o.seed);
          },
          {},
          [](const SampleOptions& o) { return longest_axis(o.sides); }};
}

Family ellipsoid() {
  const auto make = [](const SampleOptions& o) {
    const Vector3 half = 0.5 * o.sides;
    ImplicitSolid solid;
    solid.low = -half;
    solid.high = half;
    // Grows no faster than the distance, since it does so along the shortest half axis.
    solid.value = [half](const Vector3& p) { return (p.cwiseQuotient(half).norm() - 1) * half.minCoeff(); };
    return polygonise(solid, o.resolution, half.minCoeff());
  };
  return {with_sides(facts("ellipsoid", "an ellipsoid of given axes", 0, 2, 1500, 100), {6, 4, 2}),
          make,
          {},
          [](const SampleOptions& o) { return longest_axis(o.sides); }};
}

}  // namespace

std::vector<Family> bar_families() {
  return {hammer(),  tee(),   cross(), cube_rods(), comb(),     ladder(),
          lattice(), table(), chair(), box(),       ellipsoid()};
}

}  // namespace mspskel::detail
