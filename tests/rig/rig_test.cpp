// A rig is a tree whose weights sum to 1 and stay on their limb.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cstring>
#include <set>

#include "../topology/voxel_solids.h"
#include "mspskel/base/error.h"
#include "mspskel/extract_skeleton.h"
#include "mspskel/io/write_glb.h"
#include "mspskel/render/render.h"
#include "mspskel/rig/make_rig.h"
#include "support/meshes.h"
#include "support/questions.h"

using namespace mspskel;

namespace {

struct Shape {
  SurfaceSnapshot surface;
  CurveSkeleton skeleton;
  PolygonSoup soup;
};

Shape shape_of(const DefaultMesh& mesh) {
  ExtractResult result = extract_skeleton(mesh);
  PolygonSoup soup = to_polygon_soup(result.surface);
  return {std::move(result.surface), std::move(result.skeleton), std::move(soup)};
}

Shape sample(const std::string& name) { return shape_of(test::to_mesh(make_sample(name))); }

// A thick plate on which two limbs lie side by side and have grown together, each with an arc of its own.
Shape webbed_limbs() {
  test::VoxelSolid solid;
  solid.box({0, 0, 0}, {20, 20, 6});
  const DefaultMesh mesh = test::to_mesh(test::boundary(solid));
  Shape shape{make_snapshot(mesh), {}, {}};
  shape.soup = to_polygon_soup(shape.surface);
  CurveSkeleton& skeleton = shape.skeleton;
  for (const double x : {5.0, 15.0})
    for (int y = 2; y <= 18; ++y) skeleton.nodes.push_back({Vector3(x, y, 3), 3, 60, 32, 0});
  for (Index n = 0; n + 1 < 34; ++n)
    if (n != 16) skeleton.edges.push_back({n, n + 1});
  skeleton.nodes.push_back({Vector3(10, 1, 3), 1, 60, 10, 0});
  skeleton.edges.push_back({0, 34});
  skeleton.edges.push_back({17, 34});
  for (const Vector3& p : shape.soup.points) {
    const Index y = std::clamp(static_cast<Index>(std::lround(p.y())), 2, 18) - 2;
    skeleton.node_of_vertex.push_back(p.x() < 9.5 ? y : p.x() > 10.5 || y > 0 ? 17 + y : 34);
  }
  return shape;
}

// The same pulled askew: every face is wider than a right angle.
Shape askew_limbs() {
  Shape shape = webbed_limbs();
  const auto pull = [](Vector3& p) { p += Vector3(1.5 * p.y() + 0.7 * p.z(), 0, 1.2 * p.y()); };
  for (Vector3& p : shape.soup.points) pull(p);
  for (SkeletonNode& node : shape.skeleton.nodes) pull(node.position);
  shape.surface = make_snapshot(test::to_mesh(shape.soup));
  return shape;
}

// Each face is split at a point near one of its edges, which leaves a sliver there.
Shape slivered(Shape shape) {
  PolygonSoup fine;
  fine.points = shape.soup.points;
  for (std::size_t f = 0; f < shape.soup.polygon_count(); ++f) {
    const Index* corner = &shape.soup.corners[3 * f];
    const Index added = static_cast<Index>(fine.points.size());
    const std::array<double, 3> share{f % 2 ? 0.68 : 0.28, f % 2 ? 0.28 : 0.68, 0.04};
    Vector3 x = Vector3::Zero();
    for (int k = 0; k < 3; ++k) x += share[k] * shape.soup.points[corner[k]];
    fine.points.push_back(x);
    shape.skeleton.node_of_vertex.push_back(shape.skeleton.node_of_vertex[corner[f % 2 ? 0 : 1]]);
    for (int k = 0; k < 3; ++k) fine.add_triangle(corner[k], corner[(k + 1) % 3], added);
  }
  shape.soup = std::move(fine);
  shape.surface = make_snapshot(test::to_mesh(shape.soup));
  return shape;
}

// The same with an arc beside it that no vertex is mapped to.
Shape webbed_limbs_and_empty_arc() {
  Shape shape = webbed_limbs();
  CurveSkeleton& skeleton = shape.skeleton;
  for (int x = 11; x <= 16; ++x) {
    const Index n = static_cast<Index>(skeleton.nodes.size());
    skeleton.nodes.push_back({Vector3(x, 1, 3), 1, 0, 0, 0});
    skeleton.edges.push_back({x == 11 ? 34 : n - 1, n});
  }
  return shape;
}

// A tall block and the 29 nodes of its axis, to which no vertex is mapped.
Shape block_with_axis() {
  test::VoxelSolid solid;
  solid.box({0, 0, 0}, {12, 12, 40});
  Shape shape{make_snapshot(test::to_mesh(test::boundary(solid))), {}, {}};
  shape.soup = to_polygon_soup(shape.surface);
  for (int z = 6; z <= 34; ++z) shape.skeleton.nodes.push_back({Vector3(6, 6, z), 6, 48, 48, 0});
  for (Index n = 0; n + 1 < 29; ++n) shape.skeleton.edges.push_back({n, n + 1});
  return shape;
}

// Of a vertex that no limb of the block has: the node of the axis at its height.
Index axis_node(const Vector3& p) { return std::clamp(static_cast<Index>(std::lround(p.z())), 6, 34) - 6; }

// A tall block with an arc that forks before it reaches the side, where a vertex follows each prong's end.
Shape block_with_fork_inside() {
  Shape shape = block_with_axis();
  CurveSkeleton& skeleton = shape.skeleton;
  for (int x = 7; x <= 9; ++x) {  // 29 to 31
    skeleton.nodes.push_back({Vector3(x, 6, 20), 1, 6, 4, 0});
    skeleton.edges.push_back({x == 7 ? 14 : 27 + x - 6, 28 + x - 6});
  }
  for (const double side : {-1.0, 1.0})  // 32 to 34, 35 to 37
    for (int step = 1; step <= 3; ++step) {
      const Index n = static_cast<Index>(skeleton.nodes.size());
      skeleton.nodes.push_back({Vector3(9 + 0.6 * step, 6 + side * step, 20), 1, 6, 4, 0});
      skeleton.edges.push_back({step == 1 ? 31 : n - 1, n});
    }
  for (const Vector3& p : shape.soup.points) {
    const bool on_limb =
        p.x() > 11.5 && std::abs(std::abs(p.y() - 6) - 3) < 0.1 && std::abs(p.z() - 20) < 0.1;
    skeleton.node_of_vertex.push_back(on_limb ? (p.y() < 6 ? 34 : 37) : axis_node(p));
  }
  return shape;
}

// A tall block with an arc that hardly leaves it: of the vertices on its side two layers follow its end.
Shape block_with_flat_limb() {
  Shape shape = block_with_axis();
  CurveSkeleton& skeleton = shape.skeleton;
  for (int x = 7; x <= 11; ++x) {
    const Index n = static_cast<Index>(skeleton.nodes.size());
    skeleton.nodes.push_back({Vector3(x, 6, 20), 1, 6, 4, 0});
    skeleton.edges.push_back({x == 7 ? 14 : n - 1, n});
  }
  for (const Vector3& p : shape.soup.points) {
    const bool on_limb = p.x() > 11.5 && std::abs(p.y() - 6) < 1.5 && std::abs(p.z() - 20) < 1.5;
    skeleton.node_of_vertex.push_back(on_limb ? 33 : axis_node(p));
  }
  return shape;
}

const Shape& beast() {
  static const Shape shape = sample("quadruped");
  return shape;
}

bool hangs_on(const Rig& rig, Index joint, Index above) {
  while (joint != kNone && joint != above) joint = rig.joints[joint].parent;
  return joint == above;
}

bool is_limb(const std::string& name) { return name.rfind("limb", 0) == 0; }
std::string limb_of(const std::string& name) { return name.substr(0, name.find('_')); }

}  // namespace

TEST_CASE("joints are one tree, parents first, and names are unique") {
  for (const char* name : {"quadruped", "capsule", "torus", "handles", "chain", "octoped"}) {
    INFO(name);
    const Shape shape = sample(name);
    const Rig rig = make_rig(shape.surface, shape.skeleton);
    std::set<std::string> names;
    for (Index j = 0; j < static_cast<Index>(rig.joints.size()); ++j) {
      CHECK((rig.joints[j].parent == kNone) == (j == 0));
      CHECK(rig.joints[j].parent < j);
      names.insert(rig.joints[j].name);
    }
    CHECK(names.size() == rig.joints.size());
    CHECK(static_cast<Index>(rig.cut.size()) == count_graph(shape.skeleton).cycles);
    CHECK(rig.joints.size() <= 40);
  }
}

TEST_CASE("weights are at most four, positive and sum to 1") {
  const Rig rig = make_rig(beast().surface, beast().skeleton);
  REQUIRE(rig.influences.size() == beast().soup.points.size());
  for (const auto& influences : rig.influences) {
    double sum = 0;
    for (const auto& [joint, weight] : influences) {
      CHECK(weight >= 0);
      CHECK(joint < static_cast<Index>(rig.joints.size()));
      sum += weight;
    }
    CHECK(sum == Approx(1.0));
  }
}

TEST_CASE("a vertex follows joints of one way from the root") {
  const Rig rig = make_rig(beast().surface, beast().skeleton);
  for (const auto& influences : rig.influences)
    for (const Influence& a : influences)
      for (const Influence& b : influences)
        if (a.weight > 0 && b.weight > 0)
          CHECK((hangs_on(rig, a.joint, b.joint) || hangs_on(rig, b.joint, a.joint)));
}

TEST_CASE("at rest nothing moves; a turned root turns everything") {
  const Rig rig = make_rig(beast().surface, beast().skeleton);
  const double extent = beast().surface.frame.scale;
  const auto still = bend(rig, beast().soup.points, {});
  const auto turned = bend(rig, beast().soup.points, {{0, Vector3(1, 2, 3), 70}});
  const Eigen::AngleAxisd turn(70 * kPi / 180, Vector3(1, 2, 3).normalized());
  for (std::size_t v = 0; v < still.size(); ++v) {
    const Vector3& p = beast().soup.points[v];
    CHECK((still[v] - p).norm() < 1e-9 * extent);
    const Vector3 want = rig.joints[0].position + turn * (p - rig.joints[0].position);
    CHECK((turned[v] - want).norm() < 1e-9 * extent);
  }
}

TEST_CASE("a bent limb moves its tip and no other limb") {
  const Rig rig = make_rig(beast().surface, beast().skeleton);
  const auto& points = beast().soup.points;
  Index bent_limbs = 0;
  for (Index j = 0; j < static_cast<Index>(rig.joints.size()); ++j) {
    const std::string& name = rig.joints[j].name;
    if (!is_limb(name) || is_limb(rig.joints[rig.joints[j].parent].name)) continue;
    const bool has_children = std::any_of(rig.joints.begin(), rig.joints.end(),
                                          [&](const RigJoint& joint) { return joint.parent == j; });
    if (!has_children) continue;
    ++bent_limbs;
    INFO(name);
    const auto bent = bend(rig, points, {{j, Vector3(1, 1, 1), 45}});
    double farthest = 0, elsewhere = 0;
    for (std::size_t v = 0; v < points.size(); ++v) {
      const double moved = (bent[v] - points[v]).norm();
      const Index strongest = rig.influences[v][0].joint;
      farthest = std::max(farthest, moved);
      const std::string& there = rig.joints[strongest].name;
      if (is_limb(there) && limb_of(there) != limb_of(name) && !hangs_on(rig, strongest, j))
        elsewhere = std::max(elsewhere, moved);
    }
    CHECK(farthest > 0.02 * beast().surface.frame.scale);
    CHECK(elsewhere < 0.01 * beast().surface.frame.scale);
  }
  CHECK(bent_limbs >= 5);
}

TEST_CASE("each limb has a joint that bends it, which its tip follows") {
  for (const Shape& shape : {beast(), sample("octoped"), webbed_limbs_and_empty_arc(), block_with_flat_limb(),
                             block_with_fork_inside()})
    for (const Index joints : {0, 24, 18, 12}) {
      RigOptions options;
      options.joints = joints;
      const Rig rig = make_rig(shape.surface, shape.skeleton, options);
      for (Index j = 1; j < static_cast<Index>(rig.joints.size()); ++j) {
        const std::string& name = rig.joints[j].name;
        if (!is_limb(name) || is_limb(rig.joints[rig.joints[j].parent].name)) continue;
        INFO(name << ", " << joints << " joints");
        double most = 0;
        for (const auto& influences : rig.influences) {
          double followed = 0;
          for (const Influence& i : influences)
            if (i.weight > 0 && hangs_on(rig, i.joint, j)) followed += i.weight;
          most = std::max(most, followed);
        }
        CHECK(most >= 0.5);
      }
    }
}

TEST_CASE("with few joints limbs lose their bends before their roots") {
  const Shape shape = sample("octoped");
  const Index ends = count_graph(shape.skeleton).leaves;
  RigOptions options;
  options.joints = 3 * ends;
  const Rig all = make_rig(shape.surface, shape.skeleton, options);
  options.joints = 2 * ends + 4;
  const Rig few = make_rig(shape.surface, shape.skeleton, options);
  std::set<Index> of_all, of_few;
  for (const RigJoint& joint : all.joints)
    if (joint.parent != kNone && is_limb(joint.name) && !is_limb(all.joints[joint.parent].name))
      of_all.insert(joint.node);
  for (const RigJoint& joint : few.joints)
    if (joint.parent != kNone && is_limb(joint.name) && !is_limb(few.joints[joint.parent].name))
      of_few.insert(joint.node);
  CHECK(of_all.size() == static_cast<std::size_t>(ends));
  CHECK(of_all == of_few);
}

TEST_CASE("an arc to which no vertex is mapped has no joints") {
  const Shape shape = webbed_limbs_and_empty_arc();
  for (const RigJoint& joint : make_rig(shape.surface, shape.skeleton).joints) CHECK(joint.node <= 34);
}

TEST_CASE(
    "what follows a joint changes by at most 0.9 of an edge's length over its distance from the joint") {
  for (const Shape& shape : {webbed_limbs(), beast()}) {
    const Rig rig = make_rig(shape.surface, shape.skeleton);
    const auto followed = [&](Index v, Index joint) {
      double sum = 0;
      for (const Influence& i : rig.influences[v])
        if (i.weight > 0 && hangs_on(rig, i.joint, joint)) sum += i.weight;
      return sum;
    };
    double steepest = 0;
    for (Index h = 0; h < shape.surface.halfedge_count(); ++h) {
      const Index v = shape.surface.origin[h], w = shape.surface.target(h);
      const Vector3 &a = shape.soup.points[v], &b = shape.soup.points[w];
      for (Index j = 1; j < static_cast<Index>(rig.joints.size()); ++j) {
        const double distance = (0.5 * (a + b) - rig.joints[j].position).norm(), length = (b - a).norm();
        const double change = std::abs(followed(v, j) - followed(w, j));
        steepest = std::max(steepest, change * std::max(distance, 0.5 * length) / length);
      }
    }
    CHECK(steepest < 0.9001);
  }
}

// Against the way that a face is turned by what its corners follow the joint on average.
Index count_flipped(const Shape& shape, const Rig& rig, Index turned, const Vector3& axis, double degrees) {
  const PolygonSoup& soup = shape.soup;
  const auto bent = bend(rig, soup.points, {{turned, axis, degrees}});
  Index flipped = 0;
  for (std::size_t f = 0; f < soup.polygon_count(); ++f) {
    const Index* corner = &soup.corners[3 * f];
    double followed = 0;
    for (int k = 0; k < 3; ++k)
      for (const Influence& i : rig.influences[corner[k]])
        if (i.weight > 0 && hangs_on(rig, i.joint, turned)) followed += i.weight / 3;
    const auto normal = [&](const std::vector<Vector3>& x) -> Vector3 {
      return (x[corner[1]] - x[corner[0]]).cross(x[corner[2]] - x[corner[0]]);
    };
    const Eigen::AngleAxisd turn(followed * degrees * kPi / 180, axis);
    if ((turn * normal(soup.points)).dot(normal(bent)) < 0) ++flipped;
  }
  return flipped;
}

// Of all joints, each turned by 45 degrees either way about axes of many directions.
Index count_flipped(const Shape& shape, const Rig& rig) {
  Index flipped = 0;
  for (Index j = 1; j < static_cast<Index>(rig.joints.size()); ++j)
    for (const Vector3& axis : {Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(0, 0, 1), Vector3(3, 1, 2),
                                Vector3(-1, 3, 1), Vector3(2, -2, 3), Vector3(-3, -1, 1)})
      for (const double degrees : {45.0, -45.0})
        flipped += count_flipped(shape, rig, j, axis.normalized(), degrees);
  return flipped;
}

TEST_CASE("no face turns over when a joint bends by 45 degrees, about whatever axis") {
  for (const Shape& shape : {webbed_limbs(), askew_limbs(), beast(), sample("octoped"), sample("table")})
    CHECK(count_flipped(shape, make_rig(shape.surface, shape.skeleton)) == 0);
}

TEST_CASE("no sliver turns over when a joint bends by 45 degrees") {
  for (const Shape& shape : {slivered(webbed_limbs()), slivered(beast())})
    CHECK(count_flipped(shape, make_rig(shape.surface, shape.skeleton)) == 0);
}

TEST_CASE("no face turns over where many joints lie close together, though a vertex follows only four") {
  const Shape shape = sample("quadruped");
  RigOptions options;
  options.joints = 90;
  CHECK(count_flipped(shape, make_rig(shape.surface, shape.skeleton, options)) == 0);
}

TEST_CASE("a wanted number of joints is met") {
  std::vector<Index> wanted{1, 40};
  for (Index joints = 3; joints <= 30; ++joints) wanted.push_back(joints);
  for (const Shape& shape : {beast(), sample("octoped")})
    for (const Index joints : wanted) {
      RigOptions options;
      options.joints = joints;
      CHECK(static_cast<Index>(make_rig(shape.surface, shape.skeleton, options).joints.size()) == joints);
    }
}

TEST_CASE("limbs that mirror each other are twins with one name") {
  const Rig rig = make_rig(beast().surface, beast().skeleton);
  for (std::size_t j = 0; j < rig.joints.size(); ++j) {
    const Index twin = rig.joints[j].twin;
    if (twin == kNone) continue;
    CHECK(rig.joints[twin].twin == static_cast<Index>(j));
    std::string a = rig.joints[j].name, b = rig.joints[twin].name;
    CHECK(a.substr(0, a.size() - 1) == b.substr(0, b.size() - 1));
    CHECK(a.back() != b.back());
  }
  CHECK(std::any_of(rig.joints.begin(), rig.joints.end(),
                    [](const RigJoint& joint) { return joint.twin != kNone; }));
}

TEST_CASE("poses are read as written, and what is wrong with them is said") {
  const Rig rig = make_rig(beast().surface, beast().skeleton);
  const JointTurn turn = parse_joint_turn(rig, "root=y,-30");
  CHECK(turn.joint == 0);
  CHECK(turn.axis == Vector3::UnitY());
  CHECK(turn.angle == -30);
  CHECK(parse_joint_turn(rig, "root=1,0,2,5").axis == Vector3(1, 0, 2));
  for (const char* wrong : {"root", "nobody=x,1", "root=w,1", "root=x", "root=x,much", "root=0,0,0,5"})
    CHECK_THROWS_AS(parse_joint_turn(rig, wrong), UsageError);
}

TEST_CASE("a .glb has its lengths right") {
  const Rig rig = make_rig(beast().surface, beast().skeleton);
  const GlbScene scene{"beast", beast().soup, beast().skeleton};
  for (const std::string& bytes : {format_glb(scene), format_rigged_glb(scene, rig)}) {
    const auto number = [&](std::size_t at) {
      std::uint32_t value = 0;
      for (std::size_t i = 0; i < 4; ++i)
        value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
      return value;
    };
    REQUIRE(bytes.substr(0, 4) == "glTF");
    CHECK(number(4) == 2);
    CHECK(number(8) == bytes.size());
    const std::size_t json = number(12);
    CHECK(json % 4 == 0);
    CHECK(20 + json + 8 + number(20 + json) == bytes.size());
  }
  CHECK(format_glb(scene).find("_RADIUS") != std::string::npos);
  CHECK(format_rigged_glb(scene, rig).find("inverseBindMatrices") != std::string::npos);
}

TEST_CASE("a rig that drops joints asks more often whether to stop") {
  const auto questions = [](Index joints) {
    RigOptions options;
    options.joints = joints;
    return test::questions_of([&](const ProgressCallback& progress) {
      make_rig(beast().surface, beast().skeleton, options, progress);
    });
  };
  CHECK(questions(2) > questions(0) + 4);
}

TEST_CASE("options out of range, other surfaces and empty skeletons are refused") {
  RigOptions options;
  options.blend = -1;
  CHECK_THROWS_AS(make_rig(beast().surface, beast().skeleton, options), UsageError);
  CHECK_THROWS_AS(make_rig(beast().surface, CurveSkeleton{}), UsageError);
  const Rig rig = make_rig(beast().surface, beast().skeleton);
  CHECK_THROWS_AS(bend(rig, {}, {}), UsageError);
  CHECK_THROWS_AS(bend(rig, beast().soup.points, {{999, Vector3::UnitX(), 1}}), UsageError);
}
