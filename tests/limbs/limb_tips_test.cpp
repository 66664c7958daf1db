// The tips of limbs: as many as there are limbs, at their ends, whatever the pose, the place and the
// triangles.
#include "mspskel/limbs/limb_tips.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "limbs/armchair.h"
#include "mspskel/extract_skeleton.h"
#include "mspskel/limbs/detail/part_level.h"
#include "mspskel/limbs/detail/part_shape.h"
#include "mspskel/limbs/detail/plates.h"
#include "mspskel/mesh/coarsen_surface.h"
#include "mspskel/mesh/inner_distance.h"
#include "mspskel/mesh/subdivide_surface.h"
#include "mspskel/samples/blocks.h"
#include "mspskel/samples/polygonise.h"
#include "mspskel/samples/skin_graph.h"
#include "support/pipes.h"
#include "support/questions.h"
#include "support/solids.h"
#include "topology/voxel_solids.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

std::vector<LimbTip> tips_of(const Solid& solid, double slenderness = LimbOptions().slenderness) {
  LimbOptions options;
  options.slenderness = slenderness;
  return find_limb_tips(solid.surface, solid.hierarchy, solid.slices(), options);
}

}  // namespace

TEST_CASE("Each limb of a tripod has a tip at its end") {
  const BallGraph limbs = tripod();
  for (const Index vertices : {400, 1200, 4000}) {
    const Solid solid(to_mesh(skin_graph(limbs, vertices)));
    const std::vector<LimbTip> tips = tips_of(solid);
    REQUIRE(tips.size() == 3);
    std::set<Index> reached;
    for (const LimbTip& tip : tips) {
      const Vector3 at = solid.model(solid.surface.position[tip.vertex]);
      for (Index i = 1; i < 4; ++i)
        if ((at - limbs.nodes[i].position).norm() < 1.1 * limbs.nodes[i].radius) reached.insert(i);
      CHECK(tip.measures.depth > 0.2);
      CHECK_FALSE(tip.cap.empty());
    }
    CHECK(reached.size() == 3);
  }
}

TEST_CASE("The search for limbs asks whether to stop as parts grow and meet") {
  const Solid solid(sample("octoped", 20000));
  const VertexSlices slices = solid.slices();
  const SurfaceWays ways(solid.surface);
  const std::vector<std::optional<Vector3>> within{
      Vector3(solid.surface.position[0] - 1e-3 * solid.surface.normal[0])};
  Execution execution;
  execution.threads = 1;
  const int distances = questions_of([&](const ProgressCallback& progress) {
    execution.progress = progress;
    inner_distances(solid.surface, ways, solid.hierarchy, within, execution);
  });
  CHECK(questions_of([&](const ProgressCallback& progress) {
          execution.progress = progress;
          find_limb_tips(solid.surface, solid.hierarchy, slices, LimbOptions(), execution);
        }) > distances + solid.surface.vertex_count() / 1024 + 8);
}

TEST_CASE("Samples have the tips that they were made with") {
  CHECK(tips_of(Solid(sample("octoped", 3000))).size() == 9);
  CHECK(tips_of(Solid(sample("y-tube", 1500))).size() == 3);
  CHECK(tips_of(Solid(sample("capsule", 1000))).size() == 2);
}

TEST_CASE("A fold that encloses nothing is no limb and no ear, and a thin sheet may be one") {
  LimbMeasures part;
  part.depth = 0.3;
  part.half_width = 0.03;
  part.slenderness = 2 * kPi * 0.3 * 0.3 / (2 * kPi * 0.3 * 0.03);
  part.depth_over_mouth = 10;
  part.carrier_half_chord = part.carrier_half_thickness = 0.1;
  for (const double thickness : {1.0, 0.04}) {
    part.half_chord = part.half_thickness = thickness * part.half_width;
    CHECK(is_limb(part, {}));
    CHECK(is_ear(part, {}));
  }
  part.half_chord = part.half_thickness = 1e-6;
  CHECK_FALSE(is_limb(part, {}));
  CHECK_FALSE(is_ear(part, {}));
}

TEST_CASE("The sums of a part are what is beyond the level, with the triangles cut") {
  const Solid solid(jittered(to_mesh(skin_graph(tripod(), 900)), 3, 0.2));
  std::vector<double> height;
  std::vector<Index> order;
  for (const Vector3& x : solid.surface.position) {
    height.push_back(x.z() + 0.3 * x.x());
    order.push_back(static_cast<Index>(order.size()));
  }
  std::sort(order.begin(), order.end(), [&](Index a, Index b) { return height[a] > height[b]; });
  detail::LevelSum sum;
  for (std::size_t i = 0; i + 1 < order.size(); ++i) {
    sum.add(detail::change_at(solid.surface, height, order[i]));
    if (i % 50 != 0) continue;
    for (const double share : {0.0, 0.5, 1.0}) {
      const double level = height[order[i]] + share * (height[order[i + 1]] - height[order[i]]);
      detail::PartShapeSum cut(solid.surface, height, level);
      for (std::size_t k = 0; k <= i; ++k) cut.add_vertex(order[k]);
      const detail::PartShape shape = cut.shape(height[order[0]]);
      const detail::PartLevel part = sum.at(level, height[order[0]]);
      CHECK(part.area == Approx(shape.area).margin(1e-9));
      CHECK(part.mouth == Approx(shape.mouth).margin(1e-6));
    }
  }
}

TEST_CASE("A shape without limbs has the ends of its longest way as tips, which are no limbs") {
  const Solid solid(sphere(500));
  const std::vector<LimbTip> tips = tips_of(solid);
  REQUIRE(tips.size() == 2);
  for (const LimbTip& tip : tips) {
    CHECK(tip.kind == TipKind::kWayEnd);
    CHECK_FALSE(tip.cap.empty());
  }
  const auto at = [&](int i) { return solid.surface.position[tips[i].vertex].normalized(); };
  CHECK(at(0).dot(at(1)) < -0.95);
}

TEST_CASE("Fewer tips are limbs where more is asked") {
  const Solid solid(to_mesh(skin_graph(tripod(), 1200)));
  std::size_t before = solid.surface.position.size();
  for (const double slenderness : {0.01, 0.3, 1.0, 3.0, 10.0, 100.0}) {
    const std::vector<LimbTip> tips = tips_of(solid, slenderness);
    const auto limbs = static_cast<std::size_t>(std::count_if(
        tips.begin(), tips.end(), [](const LimbTip& tip) { return tip.kind == TipKind::kLimb; }));
    CHECK(limbs <= before);
    before = limbs;
  }
  CHECK(before == 0);
}

TEST_CASE("Tips stay the same vertices when the model is turned, moved and scaled") {
  const DefaultMesh mesh = sample("octoped", 2600);
  const DefaultMesh moved = translated(scaled(rotated(mesh, {0.3, -0.8, 0.5}, 1.1), 37.5), {10, -20, 5});
  std::set<Index> here, there;
  for (const LimbTip& tip : tips_of(Solid(mesh))) here.insert(tip.vertex);
  for (const LimbTip& tip : tips_of(Solid(moved))) there.insert(tip.vertex);
  CHECK(here == there);
}

TEST_CASE("Pieces have tips of their own, and nothing to measure gives none") {
  PolygonSoup pair = skin_graph(tripod(), 1200);
  const PolygonSoup one = pair;
  const auto shift = static_cast<Index>(one.points.size());
  for (const Vector3& p : one.points) pair.points.push_back(p + Vector3(0, 5, 0));
  for (std::size_t f = 0; f < one.polygon_count(); ++f) {
    for (Index c = one.begin[f]; c < one.begin[f + 1]; ++c) pair.corners.push_back(one.corners[c] + shift);
    pair.begin.push_back(static_cast<Index>(pair.corners.size()));
  }
  const Solid solid(to_mesh(pair));
  std::array<int, 2> count{0, 0};
  for (const LimbTip& tip : tips_of(solid)) ++count[solid.surface.component[tip.vertex]];
  CHECK(count == std::array<int, 2>{3, 3});
  CHECK(find_limb_tips(solid.surface, solid.hierarchy, solid.no_slices(), {}).empty());
}

TEST_CASE("The corners of a block are no limbs") {
  for (const LimbTip& tip : tips_of(Solid(prism(4, 1.5, 13)))) CHECK(tip.kind == TipKind::kWayEnd);
}

TEST_CASE("The corners of bodies that carry limbs are no limbs") {
  struct Body {
    std::string name;
    Index count;
    double ratio;
    Section section;
    std::size_t limbs;
    bool sparse = false;
  };
  // A cube with rods, the top of a table beyond the legs, the corners of a frame of bars.
  const std::vector<Body> bodies{
      {"cube-rods", 1, 0, Section::kSquare, 1}, {"cube-rods", 3, 0, Section::kRound, 3},
      {"table", 4, 0.7, Section::kSquare, 4},   {"table", 5, 1, Section::kSquare, 5, true},
      {"cube-rods", 2, 0, Section::kRound, 2},  {"heptoroid", kNone, 0, Section::kOwn, 0, true},
      {"lattice", 3, 0, Section::kRound, 0},    {"lattice", 3, 0, Section::kSquare, 0}};
  for (const Body& body : bodies) {
    SampleOptions options;
    options.count = body.count;
    options.ratio = body.ratio;
    options.section = body.section;
    options.sparse = body.sparse;
    INFO(body.name << " " << body.count);
    SurfaceSnapshot surface = make_snapshot(to_mesh(make_sample(body.name, options)));
    if (body.sparse) surface = subdivide_surface(surface).surface;
    const std::vector<LimbTip> tips = tips_of(Solid(std::move(surface)));
    const auto limbs = std::count_if(tips.begin(), tips.end(), [](const LimbTip& tip) {
      return tip.kind == TipKind::kLimb || tip.kind == TipKind::kEar;
    });
    CHECK(static_cast<std::size_t>(limbs) == body.limbs);
  }
}

TEST_CASE("The corners of a thick table top are no ears, since beside them it is as thick as they are") {
  for (const double thickness : {0.5, 0.55, 0.6, 0.65, 0.7})
    for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6}) {
      std::vector<Block> blocks{{{-1.5, -1.5, 0}, {1.5, 1.5, thickness}}};
      for (const double x : {-1.05, 1.05})
        for (const double y : {-1.05, 1.05}) blocks.push_back(bar({x, y, 0.25}, {x, y, -2.5}, 0.15, false));
      const std::vector<LimbTip> tips = tips_of(Solid(to_mesh(make_boxes(blocks, 1500, 0.2, seed))));
      const auto ears = std::count_if(tips.begin(), tips.end(),
                                      [](const LimbTip& tip) { return tip.kind == TipKind::kEar; });
      INFO("thickness " << thickness << ", seed " << seed);
      CHECK(ears == 0);
    }
}

TEST_CASE("The corner of a slab is one at any depth; legs, fingers and long planks are none") {
  for (const double thickness : {0.0, 0.1, 1.0, 1.9}) {
    // Beyond a straight level, at depth 1.
    const auto is_corner_of = [&](double area, double mouth, double thick) {
      return is_slab_corner(1, 2 * kPi / mouth, 2 * kPi / area, thick, 1.1);
    };
    CHECK(is_corner_of(2 + 2 * std::sqrt(2.0) * thickness, 4 + 2 * thickness, thickness));
    const double sharp = std::tan(kPi / 6);  // a corner of 60 degrees
    CHECK_FALSE(
        is_corner_of(2 * sharp + 2 * thickness / std::cos(kPi / 6), 4 * sharp + 2 * thickness, thickness));
    for (const double width : {0.2, 0.5, 1.0}) {
      const double plank = std::min(thickness, width);
      CHECK_FALSE(is_corner_of(2 * (width + plank), 2 * (width + plank), plank));
    }
    if (thickness < 0.5) CHECK(is_corner_of(2 * (2.5 + thickness), 2 * (2.5 + thickness), thickness));
    CHECK_FALSE(is_corner_of(20, 14, 10 * (1 + thickness)));  // a bump
  }
}

TEST_CASE("A blunt fin on something thicker is an ear; the same as a corner of a slab is none") {
  LimbMeasures m;
  m.depth = 1;
  m.half_thickness = m.half_chord = 0.1;
  m.half_width = 0.8;
  m.carrier_half_chord = 1;
  m.msp_ratio = 3;
  m.slenderness = 2 * kPi / (2 + 2 * std::sqrt(2.0) * 0.2);
  m.depth_over_mouth = 2 * kPi / 4.4;
  m.mean_depth = 0.6;
  m.carrier_half_thickness = 1;
  CHECK_FALSE(is_corner(m));
  CHECK(is_ear(m, {}));
  m.carrier_half_thickness = 0.1;
  CHECK(is_corner(m));
  CHECK_FALSE(is_ear(m, {}));
}

TEST_CASE("The blunt ends of a plank beyond the legs that carry it are no limbs") {
  constexpr int kWidth = 16, kHeight = 20, kLeg = 2, kBetween = 24;
  for (const int end : {6, 8, 10}) {
    CAPTURE(end);
    VoxelSolid plank;
    for (int x = -end; x < kBetween + end; ++x)
      for (int z = 0; z < kWidth; ++z) plank.cells.insert({x, kHeight, z});
    for (const int x : {0, kBetween - kLeg})
      for (const int z : {2, kWidth - 2 - kLeg})
        for (int y = 0; y < kHeight; ++y)
          for (int i = 0; i < kLeg * kLeg; ++i) plank.cells.insert({x + i % kLeg, y, z + i / kLeg});
    const Solid solid(to_mesh(boundary(plank)));
    std::size_t feet = 0, ends = 0;
    for (const LimbTip& tip : tips_of(solid)) {
      if (tip.kind != TipKind::kLimb && tip.kind != TipKind::kEar) continue;
      ++(solid.model(tip.position).y() < 1 ? feet : ends);
    }
    CHECK(feet == 4);
    CHECK(ends == 0);
  }
}

TEST_CASE("The back of a chair is one limb that ends in the middle, and a low rail is none") {
  constexpr int kWidth = 10, kLeg = 6;
  for (const int height : {2, 3, 6, 8, 11}) {
    VoxelSolid chair;
    chair.box({0, 0, 0}, {kWidth, kWidth, 1});
    chair.box({0, kWidth - 1, 0}, {kWidth, kWidth, 1 + height});
    for (const int x : {0, kWidth - 1})
      for (const int y : {0, kWidth - 1}) chair.box({x, y, -kLeg}, {x + 1, y + 1, 0});
    for (const double noise : {0.0, 0.2}) {
      CAPTURE(height, noise);
      const Solid given(jittered(to_mesh(boundary(chair, 2)), 3, noise * 0.5));
      std::size_t feet = 0, backs = 0;
      for (const LimbTip& tip : tips_of(given)) {
        const Vector3 target = given.model(tip.target);
        if (target.z() < 0) {
          ++feet;
          continue;
        }
        ++backs;
        CHECK(std::abs(target.x() - 0.5 * kWidth) < 0.1 * kWidth);
        CHECK(std::abs(target.y() - (kWidth - 0.5)) < 0.3);
        CHECK(target.z() > height - 0.5);
      }
      CHECK(feet == 4);
      CHECK(backs == (height > 0.5 * kWidth ? 1 : 0));
    }
  }
}

TEST_CASE("A fin of sixteen triangles is a plate, since no gap of it is as large as its base") {
  VoxelSolid cells;
  cells.box({0, 0, 0}, {4, 5, 1});
  cells.box({1, 2, 1}, {3, 3, 2});
  PolygonSoup soup = boundary(cells);
  for (Vector3& p : soup.points) p = p.cwiseProduct(Vector3(1, 0.4, 2));
  const Solid given(to_mesh(soup));
  const std::vector<detail::Plate> plates =
      detail::PlateSearch(given.surface, given.hierarchy, LimbOptions(), {})
          .run(std::vector<double>(given.surface.position.size(), 0.0));
  REQUIRE(plates.size() == 1);
  CHECK(plates.front().stands_out);
  CHECK(plates.front().limb.part.size() == 12);
}

TEST_CASE("Tubes that fork in one plane are no plate, however wide the fork is") {
  for (const double angle : {0.35, 0.6, 0.9}) {
    const Vector3 one(std::sin(angle), 0, std::cos(angle)), other(-one.x(), 0, one.z());
    const Solid fork(united(
        {{{0, 0, -3}, {0, 0, 0.1}, 0.35}, {{0, 0, 0}, 3 * one, 0.15}, {{0, 0, 0}, 3 * other, 0.15}}, 0.1));
    CAPTURE(angle);
    CHECK(detail::PlateSearch(fork.surface, fork.hierarchy, LimbOptions(), {})
              .run(std::vector<double>(fork.surface.position.size(), 0.0))
              .empty());
    CHECK(tips_of(fork).size() == 3);
  }
}

TEST_CASE("A piece of a bent sheet is no plate") {
  constexpr double kRadius = 3, kHalfThickness = 0.15, kHalfHeight = 0.75, kHalfAngle = 1.1;
  ImplicitSolid sheet;
  sheet.low = Vector3(-kRadius - 0.5, -0.5, -1.2);
  sheet.high = Vector3(kRadius + 0.5, kRadius + 0.5, 1.2);
  sheet.value = [](const Vector3& x) {
    const double angle = std::atan2(x.x(), x.y());
    const Vector3 across(std::abs(std::hypot(x.x(), x.y()) - kRadius) - kHalfThickness,
                         std::abs(x.z()) - kHalfHeight, kRadius * (std::abs(angle) - kHalfAngle));
    return 0.7 * across.maxCoeff();
  };
  const Solid solid(to_mesh(polygonise(sheet, 3000, kHalfThickness)));
  std::vector<double> along(solid.surface.position.size());
  for (std::size_t v = 0; v < along.size(); ++v) along[v] = std::abs(solid.surface.position[v].x());
  CHECK(detail::PlateSearch(solid.surface, solid.hierarchy, LimbOptions(), {}).run(along).empty());
}

TEST_CASE("A plate that forks has a limb for each of its lobes, also where these are most of it") {
  for (const int length : {5, 7, 10}) {
    VoxelSolid fish;
    fish.box({0, 0, 0}, {7, 8, 14});
    fish.box({3, 2, 14}, {4, 6, 16});  // the tail and its lobes
    fish.box({3, 0, 16}, {4, 3, 16 + length});
    fish.box({3, 5, 16}, {4, 8, 16 + length});
    fish.box({3, 0, 16}, {4, 8, 18});
    const Solid solid(to_mesh(boundary(fish, 2)));
    std::size_t upper = 0, lower = 0;
    for (const LimbTip& tip : tips_of(solid)) {
      const Vector3 x = solid.model(tip.position);
      if (x.z() > 14 + length) ++(x.y() > 4 ? upper : lower);
    }
    CAPTURE(length);
    CHECK(upper == 1);
    CHECK(lower == 1);
  }
}

TEST_CASE("A stub near the end of a pipe is measured without the pipe, which would be slender again") {
  const Solid solid(united({{{-4, 0, 0}, {4, 0, 0}, 1.0}, {{-2.8, 0, 0}, {-2.8, 0, 2.6}, 0.6}}, 0.15));
  int stubs = 0;
  for (const LimbTip& tip : tips_of(solid)) {
    if (solid.model(solid.surface.position[tip.vertex]).z() < 1.5) continue;
    ++stubs;
    CHECK(tip.kind == TipKind::kLimb);
    CHECK(tip.measures.depth * solid.surface.frame.scale < 2);
  }
  CHECK(stubs == 1);
}

TEST_CASE("An arm that ends in a knife's edge is a limb, as what there is of it behind the edge tells") {
  BallGraph graph;
  graph.blend = 0.1;
  graph.nodes = {{{0, 0, 0}, 0.5}, {{4, 0, 0}, 0.2}, {{-2, 3.4, 0}, 0.3}, {{-2, -3.4, 0}, 0.3}};
  graph.edges = {{0, 1}, {0, 2}, {0, 3}};
  for (const double edge : {2.5, 3.0, 3.5}) {
    CAPTURE(edge);
    PolygonSoup soup = skin_graph(graph, 6000);
    for (Vector3& p : soup.points)
      if (p.x() > 1.5) {
        p.y() *= std::pow(1 - (p.x() - 1.5) / 2.8, 2);
        p.z() *= std::max(1e-6, 1 - (p.x() - 1.5) / (edge - 1.5));
      }
    const Solid solid(to_mesh(soup));
    const std::vector<LimbTip> tips = tips_of(solid);
    CHECK(std::count_if(tips.begin(), tips.end(),
                        [](const LimbTip& tip) { return tip.kind == TipKind::kLimb; }) == 3);
  }
}

TEST_CASE("The back and the arms of an armchair are limbs, though their roots go round corners") {
  using namespace armchair;
  for (const double noise : {0.0, 0.1}) {
    CAPTURE(noise);
    const Solid given(jittered(to_mesh(boundary(cells(), 2)), 3, noise));
    std::size_t feet = 0, backs = 0, arms = 0;
    for (const LimbTip& tip : tips_of(given)) {
      const Vector3 x = given.model(tip.target);
      if (x.z() < 0) {
        ++feet;
      } else if (x.y() > kWidth - 1) {
        ++backs;
        CHECK(std::abs(x.x() - 0.5 * kWidth) < 0.1 * kWidth);
        CHECK(x.z() > kBack);
      } else {
        ++arms;
        CHECK(std::abs(std::abs(x.x() - 0.5 * kWidth) - 0.5 * (kWidth - 1)) < 0.3);
        CHECK(x.z() > kArm - 1);
        CHECK(x.y() < 0.5 * kWidth);
      }
    }
    CHECK(feet == 4);
    CHECK(backs == 1);
    CHECK(arms == 2);
  }
}

TEST_CASE("Both flanges of a bent sheet are limbs, and the walls of an open box are none") {
  constexpr int kWidth = 10, kShort = 8, kLong = 14;
  VoxelSolid sheet;
  sheet.box({0, 0, 0}, {kWidth, 1, kShort});
  sheet.box({0, 0, 0}, {kWidth, kLong, 1});
  const Solid bent(to_mesh(boundary(sheet, 2)));
  std::size_t ends = 0;
  for (const LimbTip& tip : tips_of(bent)) {
    const Vector3 x = bent.model(tip.target);
    CHECK(std::abs(x.x() - 0.5 * kWidth) < 0.1 * kWidth);
    CHECK((x.z() > kShort - 1 || x.y() > kLong - 1));
    ++ends;
  }
  CHECK(ends == 2);

  VoxelSolid box;
  box.box({0, 0, 0}, {kWidth, kWidth, 1});
  for (const int at : {0, kWidth - 1}) {
    box.box({at, 0, 0}, {at + 1, kWidth, kShort});
    box.box({0, at, 0}, {kWidth, at + 1, kShort});
  }
  for (const LimbTip& tip : tips_of(Solid(to_mesh(boundary(box, 2))))) CHECK(tip.kind == TipKind::kWayEnd);
}

TEST_CASE("A tube's surface lies at half of its depth, and its mouth is its girth; a corner's lies deeper") {
  SampleOptions options;
  options.count = 1;
  options.section = Section::kSquare;
  const Solid solid(to_mesh(make_sample("cube-rods", options)));
  for (const LimbTip& tip : tips_of(solid)) {
    if (tip.kind != TipKind::kLimb) continue;
    CHECK(std::abs(tip.measures.mean_depth - 0.5) < 0.05);
    CHECK(std::abs(tip.measures.depth_over_mouth / tip.measures.slenderness - 1) < 0.2);
  }

  // Near a cube's corner lie three quarters of discs, whose mean radius is two thirds of theirs.
  SampleOptions sides;
  sides.resolution = 4000;
  sides.sides = Vector3(2, 2, 2);
  const Solid cube(to_mesh(make_sample("box", sides)));
  const std::vector<Vector3>& x = cube.surface.position;
  Index corner = 0;
  for (Index v = 0; v < cube.surface.vertex_count(); ++v)
    if (x[v].sum() > x[corner].sum()) corner = v;
  constexpr double kReach = 0.2;
  std::vector<double> distance;
  for (const Vector3& position : x) distance.push_back(-(position - x[corner]).norm());
  detail::PartShapeSum sum(cube.surface, distance, -kReach);
  for (Index v = 0; v < cube.surface.vertex_count(); ++v)
    if (distance[v] >= -kReach) sum.add_vertex(v);
  const detail::PartShape shape = sum.shape(0);
  CHECK(std::abs(shape.mean_depth / (2 * kReach / 3) - 1) < 0.05);
  CHECK(std::abs(shape.area / (0.75 * kPi * kReach * kReach) - 1) < 0.15);
  CHECK(std::abs(shape.mouth / (1.5 * kPi * kReach) - 1) < 0.15);
}

TEST_CASE("A limb's slenderness is its length over its radius, however fine the triangles are") {
  for (const Index vertices : {800, 4000}) {
    BallGraph star;
    star.blend = 0;
    star.nodes = {{{0, 0, 0}, 0.3}, {{0, 0, 3}, 0.3}, {{4, 0, 0}, 0.3}, {{-2, 0, 0}, 0.3}, {{0, 5, 0}, 0.3}};
    star.edges = {{0, 1}, {0, 2}, {0, 3}, {0, 4}};
    const Solid solid(to_mesh(skin_graph(star, vertices)));
    const std::vector<LimbTip> tips = tips_of(solid);
    REQUIRE(tips.size() == 4);
    const auto like_a_tube = std::count_if(tips.begin(), tips.end(), [&](const LimbTip& tip) {
      const double depth = tip.measures.depth * solid.surface.frame.scale;
      return std::abs(tip.measures.slenderness / (depth / 0.3) - 1) < 0.15;
    });
    CHECK(like_a_tube == 4);
  }
}

TEST_CASE("Knobs on a handle are told, and its bends are not") {
  BallGraph jug;
  jug.blend = 0.05;
  jug.nodes = {{{0, 0, 0}, 1.0},     {{-1.5, 0, 1.5}, 0.3},  {{-1.5, 0, 3}, 0.3},  {{1.5, 0, 3}, 0.3},
               {{1.5, 0, 1.5}, 0.3}, {{-1.8, 0, 3.4}, 0.25}, {{1.8, 0, 3.4}, 0.25}};
  jug.edges = {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 0}, {2, 5}, {3, 6}};
  BallGraph plain = jug;
  plain.nodes.resize(5);
  plain.edges.resize(5);
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    const Solid knobs(jittered(to_mesh(skin_graph(jug, 3000)), seed, 0.1));
    std::set<Index> reached;
    for (const LimbTip& tip : tips_of(knobs))
      for (const Index i : {5, 6})
        if ((knobs.model(tip.position) - jug.nodes[i].position).norm() < 0.5) reached.insert(i);
    CHECK(reached.size() == 2);
    for (const LimbTip& tip : tips_of(Solid(jittered(to_mesh(skin_graph(plain, 3000)), seed, 0.1))))
      CHECK(tip.kind == TipKind::kBodyEnd);
  }
}

TEST_CASE("A hair on something thick is no twig, however thin it is") {
  const PolygonSoup smooth = to_soup(to_mesh(skin_graph(tripod(), 4000)));
  const std::size_t count = tips_of(Solid(to_mesh(smooth))).size();
  for (const std::size_t share : {2, 3, 5}) {  // in the middle of a triangle
    PolygonSoup soup;
    soup.points = smooth.points;
    const auto base = static_cast<Index>(soup.points.size());
    const std::size_t chosen = smooth.polygon_count() / share;
    for (std::size_t f = 0; f < smooth.polygon_count(); ++f) {
      const std::array<Index, 3> v = {smooth.corners[3 * f], smooth.corners[3 * f + 1],
                                      smooth.corners[3 * f + 2]};
      if (f != chosen) {
        soup.add_triangle(v[0], v[1], v[2]);
        continue;
      }
      const Vector3 &a = smooth.points[v[0]], &b = smooth.points[v[1]], &c = smooth.points[v[2]];
      const Vector3 middle = (a + b + c) / 3;
      for (const Vector3& x : {a, b, c}) soup.points.push_back(middle + 0.1 * (x - middle));
      soup.points.push_back(middle + 0.08 * (b - a).cross(c - a).normalized());
      for (Index k = 0; k < 3; ++k) {
        const Index next = (k + 1) % 3;
        soup.add_triangle(v[k], v[next], base + next);
        soup.add_triangle(v[k], base + next, base + k);
        soup.add_triangle(base + k, base + next, base + 3);
      }
    }
    CHECK(tips_of(Solid(to_mesh(soup))).size() == count);
  }
}

TEST_CASE("A twig of a single vertex is a limb, and a bump of one is none") {
  for (const auto& [length, tips] : {std::pair<double, std::size_t>{1.2, 4}, {0.3, 3}}) {
    DefaultMesh mesh = to_mesh(skin_graph(tripod(), 1200));
    const Vector3 place(0, 0.45, 1.5);
    auto nearest = *mesh.vertices_begin();
    for (const auto v : mesh.vertices())
      if ((to_vector3(mesh.point(v)) - place).norm() < (to_vector3(mesh.point(nearest)) - place).norm())
        nearest = v;
    const Vector3 top = to_vector3(mesh.point(nearest)) + Vector3(0, length, 0);
    mesh.set_point(nearest, {top.x(), top.y(), top.z()});
    const Solid solid(mesh);
    const std::vector<LimbTip> found = tips_of(solid);
    CHECK(found.size() == tips);
    CHECK(std::any_of(found.begin(), found.end(), [&](const LimbTip& tip) {
            return (solid.model(tip.position) - top).norm() < 1e-6;
          }) == (tips == 4));
  }
}

TEST_CASE("Small ears count on a body with limbs, and no bump of a body without") {
  BallGraph bear;
  bear.blend = 0.05;
  bear.nodes = {{{0, 0, 0}, 1.0},       {{0, 0, 1.6}, 0.8},     {{3, 0, 0.5}, 0.4},
                {{-3, 0, 0.5}, 0.4},    {{1.2, 0, -3}, 0.45},   {{-1.2, 0, -3}, 0.45},
                {{0.62, 0, 2.3}, 0.22}, {{0.95, 0, 2.75}, 0.2}, {{-0.62, 0, 2.3}, 0.22},
                {{-0.95, 0, 2.75}, 0.2}};
  bear.edges = {{0, 1}, {0, 2}, {0, 3}, {0, 4}, {0, 5}, {6, 7}, {8, 9}, {1, 6}, {1, 8}};
  const Solid solid(to_mesh(skin_graph(bear, 4000)));
  std::set<Index> reached;
  for (const LimbTip& tip : tips_of(solid))
    for (const Index i : {2, 3, 4, 5, 7, 9})
      if ((solid.model(tip.position) - bear.nodes[i].position).norm() < 0.6) reached.insert(i);
  CHECK(reached.size() == 6);

  LimbMeasures bump;
  bump.depth = 0.7;
  bump.half_width = bump.half_chord = bump.half_thickness = 1;
  bump.carrier_half_chord = bump.carrier_half_thickness = 1;
  bump.slenderness = 0.7;
  bump.depth_over_mouth = 0.7;
  bump.msp_ratio = 4;
  CHECK(is_ear(bump, {}));
  CHECK_FALSE(is_limb(bump, {}));
  bump.carrier_half_chord = 0.5;  // wider than what carries it is thick: the corner of a plate
  CHECK_FALSE(is_ear(bump, {}));
  bump.carrier_half_chord = 1;
  bump.depth_over_mouth = 0.4;  // less area than a flat disc with such a rim: a piece of a disc's edge
  CHECK_FALSE(is_ear(bump, {}));
}

TEST_CASE("A needle that leaves a fold of something thick is no twig") {
  // A block, round about the z axis, with a needle in the middle of its upper side. A cavity lies so near
  // below most of that side that chords inward from there are shorter than the needle is thick.
  constexpr Index kRound = 24;
  constexpr double kRadius = 0.5, kHeight = 0.6, kNeedle = 0.012, kSkin = 4e-4, kFold = -0.002;
  std::vector<Eigen::Vector2d> profile;  // radius and height of each ring
  for (const double share : {0.75, 0.5, 0.25})
    profile.push_back({0.001 * (1 - 0.8 * share), share * kNeedle});
  for (double radius = 0.001; radius < 0.02; radius += 0.002) profile.push_back({radius, 0});
  for (double radius = 0.03; radius < kRadius; radius *= 1.5) profile.push_back({radius, 0});
  for (const double height : {0.0, -0.5 * kHeight, -kHeight}) profile.push_back({kRadius, height});
  PolygonSoup soup;
  soup.points = {{0, 0, kNeedle}, {0, 0, -kHeight}};
  for (const Eigen::Vector2d& ring : profile)
    for (Index k = 0; k < kRound; ++k) {
      const double angle = 2 * kPi * k / kRound;
      soup.points.push_back({ring.x() * std::cos(angle), ring.x() * std::sin(angle), ring.y()});
    }
  const auto at = [](std::size_t ring, Index k) {
    return 2 + kRound * static_cast<Index>(ring) + k % kRound;
  };
  for (Index k = 0; k < kRound; ++k) {
    soup.add_triangle(0, at(0, k), at(0, k + 1));
    soup.add_triangle(1, at(profile.size() - 1, k + 1), at(profile.size() - 1, k));
    for (std::size_t ring = 0; ring + 1 < profile.size(); ++ring) {
      soup.add_triangle(at(ring, k), at(ring + 1, k), at(ring + 1, k + 1));
      soup.add_triangle(at(ring, k), at(ring + 1, k + 1), at(ring, k + 1));
    }
  }
  VoxelSolid cell;
  cell.box({0, 0, 0}, {1, 1, 1});
  const PolygonSoup cavity = boundary(cell);
  const auto first = static_cast<Index>(soup.points.size());
  for (const Vector3& p : cavity.points)
    soup.points.push_back({p.x() > 0.5 ? 0.3 : kFold, p.y() > 0.5 ? 0.2 : -0.2, p.z() > 0.5 ? -kSkin : -0.3});
  for (std::size_t i = 0; i < cavity.corners.size(); i += 3)
    soup.add_triangle(first + cavity.corners[i], first + cavity.corners[i + 2],
                      first + cavity.corners[i + 1]);
  const Solid solid(to_mesh(soup));
  REQUIRE(solid.surface.component_count == 2);
  VertexSlices slices = solid.slices();  // through a fold's own vertices they are as narrow as it is
  for (std::size_t v = 0; v < slices.half_width.size(); ++v)
    if (solid.model(solid.surface.position[v]).head<2>().norm() < 0.02) slices.half_width[v] = 0.001;
  for (const LimbTip& tip : find_limb_tips(solid.surface, solid.hierarchy, slices, {}))
    CHECK(solid.model(tip.position).z() < 0.5 * kNeedle);
}

TEST_CASE("A handle without limbs has no tips: the loop is its skeleton") {
  CHECK(tips_of(Solid(torus(3, 1, 60, 24))).empty());
}

TEST_CASE(
    "The bow of a handle is no limb, however slender, and the foot opposite to the only limb has a tip") {
  BallGraph jug;
  jug.blend = 0.1;
  jug.nodes = {{{0, 0, 0}, 1.5},    {{0, 0, 4}, 0.4},     {{1, 0, 0.6}, 0.25},
               {{2.6, 0, 1}, 0.25}, {{2.6, 0, -1}, 0.25}, {{1, 0, -0.6}, 0.25}};
  jug.edges = {{0, 1}, {2, 3}, {3, 4}, {4, 5}, {0, 2}, {0, 5}};
  const Solid solid(to_mesh(skin_graph(jug, 4000)));
  for (const LimbTip& tip : tips_of(solid)) {
    const Vector3 at = solid.model(tip.position);
    if (tip.kind == TipKind::kLimb) CHECK((at - jug.nodes[1].position).norm() < 0.6);
    CHECK(at.x() < 1.6);
  }
}

TEST_CASE("The handle of a hammer is a limb, and both ends of its head have tips") {
  for (const double handle : {3.0, 6.0, 12.0}) {
    BallGraph hammer;
    hammer.blend = 0;
    hammer.nodes = {{{0, 0, 0}, 0.8}, {{1.6, 0, 0}, 0.8}, {{-1.6, 0, 0}, 0.8}, {{0, 0, -handle}, 0.3}};
    hammer.edges = {{0, 1}, {0, 2}, {0, 3}};
    const Solid solid(to_mesh(skin_graph(hammer, 4000)));
    std::set<Index> reached;
    for (const LimbTip& tip : tips_of(solid))
      for (const Index i : {1, 2, 3})
        if ((solid.model(tip.position) - hammer.nodes[i].position).norm() < 1.2 * hammer.nodes[i].radius) {
          reached.insert(i);
          if (i == 3) CHECK(tip.kind == TipKind::kLimb);
        }
    CHECK(reached.size() == 3);
  }
}

TEST_CASE("Leaves of a hammer's head are aimed at the middles of its ends") {
  // Seen from the handle the edges of the ends are farthest.
  for (const Section section : {Section::kSquare, Section::kRound})
    for (const double width : {0.15, 0.4}) {
      SampleOptions options;
      options.section = section;
      options.ratio = width;
      const Solid solid(to_mesh(make_sample("hammer", options)));
      Index ends = 0;
      for (const LimbTip& tip : tips_of(solid)) {
        const Vector3 target = solid.model(tip.target);
        if (std::abs(target.x()) < 3) continue;
        ++ends;
        CHECK(std::hypot(target.y(), target.z()) < 0.1);
      }
      CHECK(ends == 2);
    }
}

TEST_CASE("A knob on the farthest limb hides neither that limb nor the others") {
  BallGraph limbs = tripod();
  limbs.nodes.push_back({{0.75, 0, 2.9}, 0.12});
  limbs.edges.push_back({1, static_cast<Index>(limbs.nodes.size()) - 1});
  const Solid solid(to_mesh(skin_graph(limbs, 4000)));
  std::set<Index> reached;
  for (const LimbTip& tip : tips_of(solid))
    for (Index i = 1; i < 4; ++i)
      if ((solid.model(tip.position) - limbs.nodes[i].position).norm() < 1.5) reached.insert(i);
  CHECK(reached.size() == 3);
}

TEST_CASE("Leaves are aimed at the middle of a limb's end, inside the solid") {
  const Solid solid(to_mesh(skin_graph(tripod(), 4000)));
  for (const LimbTip& tip : tips_of(solid)) {
    CHECK((tip.target - tip.position).norm() < 0.5 * 0.4 / solid.surface.frame.scale);
    CHECK((tip.target == tip.position ||
           (solid.hierarchy.inside(tip.target) &&
            solid.hierarchy.distance(tip.target) > 0.04 * tip.measures.half_width)));
  }
}

TEST_CASE("Wings are limbs, thin as they are, each of a pair") {
  // A slender body and two pairs of wings, all pressed flat.
  BallGraph butterfly;
  butterfly.blend = 0.1;
  butterfly.nodes = {{{0, 1.6, 0}, 0.3},     {{0, 0, 0}, 0.3},       {{0, -2, 0}, 0.25},
                     {{1.2, 0.8, 0}, 0.9},   {{-1.2, 0.8, 0}, 0.9},  {{2.8, 1.8, 0}, 1.0},
                     {{-2.8, 1.8, 0}, 1.0},  {{1, -0.9, 0}, 0.8},    {{-1, -0.9, 0}, 0.8},
                     {{1.9, -1.9, 0}, 0.85}, {{-1.9, -1.9, 0}, 0.85}};
  butterfly.edges = {{0, 1}, {1, 2}, {1, 3}, {1, 4}, {3, 5}, {4, 6}, {1, 7}, {1, 8}, {7, 9}, {8, 10}};
  for (const double thickness : {0.06, 0.1, 0.15}) {
    PolygonSoup flat = skin_graph(butterfly, 6000);
    for (Vector3& x : flat.points) x.z() *= thickness;
    const ExtractResult result = extract_skeleton(to_mesh(flat));
    const std::vector<std::vector<Index>> next = adjacency(result.skeleton);
    for (const int wing : {5, 6, 9, 10}) {
      CAPTURE(thickness, wing);
      double nearest = 1e9;
      for (std::size_t n = 0; n < next.size(); ++n)
        if (next[n].size() == 1)
          nearest =
              std::min(nearest, (result.skeleton.nodes[n].position - butterfly.nodes[wing].position).norm());
      CHECK(nearest < 1.2 * butterfly.nodes[wing].radius);
    }
  }
}

TEST_CASE("Tips of a finer surface keep their places on the coarser one") {
  const Solid solid(sample("octoped", 3000));
  CoarseningOptions options;
  options.vertices = 800;
  const CoarseSurface coarse = coarsen_surface(solid.surface, options);
  const std::vector<LimbTip> fine = tips_of(solid);
  const std::vector<LimbTip> tips = on_coarser_surface(fine, coarse.coarse_vertex);
  REQUIRE(tips.size() == fine.size());
  for (std::size_t i = 0; i < tips.size(); ++i) {
    CHECK(tips[i].position == fine[i].position);
    CHECK(tips[i].vertex == coarse.coarse_vertex[fine[i].vertex]);
    CHECK(std::is_sorted(tips[i].cap.begin(), tips[i].cap.end()));
    CHECK_FALSE(tips[i].cap.empty());
    for (const Index v : fine[i].cap)
      CHECK(std::binary_search(tips[i].cap.begin(), tips[i].cap.end(), coarse.coarse_vertex[v]));
  }
}
