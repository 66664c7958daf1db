// Skeletons read back exactly from the formats that are read, and the others hold what their readers expect.
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "io/temporary_folder.h"
#include "io/tetrahedron_text.h"
#include "mspskel/base/error.h"
#include "mspskel/io/read_skeleton.h"
#include "mspskel/io/write_skeleton.h"

using namespace mspskel;
using Catch::Contains;
using mspskel::test::TemporaryFolder;

namespace {

// A triangle with a tail, and a node alone: joints, a leaf, a loop, two components.
CurveSkeleton example() {
  CurveSkeleton skeleton;
  for (int i = 0; i < 6; ++i) {
    SkeletonNode node;
    node.position = Vector3(i / 3.0, -0.1 * i * i, 1e-20 * i);
    node.radius = 1 / (1.0 + i);
    node.area = i;
    node.perimeter = 2.5 * i;
    node.slice_error = i / 7.0;
    skeleton.nodes.push_back(node);
  }
  skeleton.edges = {{0, 1}, {0, 2}, {1, 2}, {2, 3}, {3, 4}};
  skeleton.node_of_vertex = {0, 5, kNone, 3, 3};
  return skeleton;
}
void check_graph(const CurveSkeleton& a, const CurveSkeleton& b, bool radius) {
  REQUIRE(a.nodes.size() == b.nodes.size());
  CHECK(a.edges == b.edges);
  for (std::size_t v = 0; v < a.nodes.size(); ++v) {
    CHECK(a.nodes[v].position == b.nodes[v].position);
    if (radius) CHECK(a.nodes[v].radius == b.nodes[v].radius);
  }
}
void check_refused(SkeletonFormat format, const std::string& text, const std::string& what) {
  INFO(text);
  CHECK_THROWS_AS(read_skeleton(std::string_view(text), format), ReadError);
  CHECK_THROWS_WITH(read_skeleton(std::string_view(text), format), Contains(what));
}
std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

}  // namespace

TEST_CASE("skeletons go through files and back") {
  const TemporaryFolder folder;
  const CurveSkeleton skeleton = example();
  for (const char* name : {"a.skel", "a.obj", "a.ply", "a.json", "B.SKEL"}) {
    write_skeleton(folder.path(name), skeleton, R"({"seconds": 1.5})");
    check_graph(read_skeleton(folder.path(name)), skeleton, std::string(name) != "a.obj");
  }
  const CurveSkeleton full = read_skeleton(folder.path("a.json"));
  CHECK(full.node_of_vertex == skeleton.node_of_vertex);
  for (std::size_t v = 0; v < 6; ++v) {
    CHECK(full.nodes[v].area == skeleton.nodes[v].area);
    CHECK(full.nodes[v].perimeter == skeleton.nodes[v].perimeter);
    CHECK(full.nodes[v].slice_error == skeleton.nodes[v].slice_error);
  }
  check_graph(
      read_skeleton(std::string_view(format_skeleton({}, SkeletonFormat::kSkel)), SkeletonFormat::kSkel), {},
      true);
}

TEST_CASE("the extension picks the format; an unknown one lists the known") {
  CHECK(skeleton_format_of("-") == SkeletonFormat::kSkel);
  CHECK(skeleton_format_of("x/a.b.VTP") == SkeletonFormat::kVtp);
  CHECK(skeleton_format_of("a.polylines.txt") == SkeletonFormat::kPolylines);
  CHECK_THROWS_AS(skeleton_format_of("a.txt"), UsageError);
  CHECK_THROWS_WITH(skeleton_format_of("skel"),
                    Contains(".skel .obj .ply .json .swc .vtp .graphml .cgal .polylines.txt"));
  CHECK_THROWS_AS(read_skeleton("a.vtp"), UsageError);
}

TEST_CASE(".skel: header, count, then a line a node with its neighbours") {
  const auto lines = lines_of(format_skeleton(example(), SkeletonFormat::kSkel));
  REQUIRE(lines.size() == 8);
  CHECK(lines[0] == "ID Cx Cy Cz RADIUS #NEIGHBORS NEIGHBORS_LIST");
  CHECK(lines[1] == "6");
  CHECK(lines[2] == "0 0 -0 0 1 2 1 2");
  CHECK_THAT(lines[4], Catch::StartsWith("2 ") && Catch::EndsWith(" 3 0 1 3"));
  CHECK_THAT(lines[7], Catch::EndsWith(" 0"));
}

TEST_CASE(".json: nodes, edges, branches, surface map and report") {
  const CurveSkeleton skeleton = example();
  const auto json =
      nlohmann::json::parse(format_skeleton(skeleton, SkeletonFormat::kJson, R"({"a": [1, 2]})"));
  CHECK(json["nodes"].size() == 6);
  CHECK(json["nodes"][3]["id"] == 3);
  CHECK(json["nodes"][3]["radius"] == 0.25);
  CHECK(json["edges"][3] == nlohmann::json({{"source", 2}, {"target", 3}}));
  CHECK(json["branches"].size() == branches(skeleton).size());
  CHECK(json["node_of_vertex"] == nlohmann::json(skeleton.node_of_vertex));
  CHECK(json["report"]["a"][1] == 2);
  CHECK_FALSE(nlohmann::json::parse(format_skeleton(skeleton, SkeletonFormat::kJson)).contains("report"));
  CHECK_THROWS_AS(format_skeleton(skeleton, SkeletonFormat::kJson, "{"), UsageError);
}

TEST_CASE(".swc: a forest, parents first, each cut edge a comment") {
  const CurveSkeleton skeleton = example();
  int nodes = 0, roots = 0, cuts = 0;
  for (const std::string& line : lines_of(format_skeleton(skeleton, SkeletonFormat::kSwc))) {
    if (line[0] == '#') {
      cuts += line.find("cut edge") != std::string::npos;
      continue;
    }
    std::istringstream in(line);
    int id = 0, type = -1, parent = 0;
    double x, y, z, radius;
    REQUIRE(in >> id >> type >> x >> y >> z >> radius >> parent);
    CHECK(id == ++nodes);
    CHECK((type == 0 || type == 5 || type == 6 || (type == 1 && parent == -1)));
    CHECK((parent == -1 || (parent >= 1 && parent < id)));
    roots += parent == -1;
  }
  const GraphCounts counts = count_graph(skeleton);
  CHECK(nodes == counts.nodes);
  CHECK(roots == counts.components);
  CHECK(cuts == counts.cycles);
  CHECK_THAT(losses_of_format(skeleton, SkeletonFormat::kSwc).at(0), Contains("1 loop was cut"));
  CHECK(losses_of_format(skeleton, SkeletonFormat::kVtp).empty());
}

TEST_CASE(".swc and polylines read back as they were, loops and lone nodes too") {
  // Their nodes come in an order of their own.
  const auto by_place = [](const CurveSkeleton& skeleton, bool radius) {
    std::vector<std::array<double, 4>> nodes;
    std::vector<std::array<std::array<double, 4>, 2>> edges;
    for (const SkeletonNode& n : skeleton.nodes)
      nodes.push_back({n.position[0], n.position[1], n.position[2], radius ? n.radius : 0});
    for (const auto& [a, b] : skeleton.edges)
      edges.push_back({std::minmax(nodes[a], nodes[b]).first, std::minmax(nodes[a], nodes[b]).second});
    std::sort(nodes.begin(), nodes.end());
    std::sort(edges.begin(), edges.end());
    return std::pair(nodes, edges);
  };
  const CurveSkeleton skeleton = example();
  for (const SkeletonFormat format : {SkeletonFormat::kSwc, SkeletonFormat::kPolylines}) {
    const bool radius = format == SkeletonFormat::kSwc;
    const std::string text = format_skeleton(skeleton, format);
    CHECK(by_place(read_skeleton(std::string_view(text), format), radius) == by_place(skeleton, radius));
  }
  const std::string_view foreign =
      "#a comment\n# cut edges: none\n7 0 0 0 0 2 3\r\n\n3 1 1.5 0 0 1 -1 # soma\n";
  const CurveSkeleton read = read_skeleton(foreign, SkeletonFormat::kSwc);
  CHECK(read.edges == std::vector<std::array<Index, 2>>{{0, 1}});
  CHECK(read.nodes.at(1).position.x() == 1.5);
  CHECK(read.nodes.at(0).radius == 2);
}

TEST_CASE(".ply, .vtp, .graphml and polylines count their elements right") {
  const CurveSkeleton skeleton = example();
  const std::string ply = format_skeleton(skeleton, SkeletonFormat::kPly);
  CHECK_THAT(ply, Contains("element vertex 6\n") && Contains("element edge 5\n") &&
                      Contains("property double radius\n"));
  CHECK(lines_of(ply.substr(ply.find("end_header\n") + 11)).size() == 11);

  const std::string vtp = format_skeleton(skeleton, SkeletonFormat::kVtp);
  const auto arcs = branches(skeleton);
  CHECK_THAT(vtp, Contains("NumberOfPoints=\"6\" NumberOfVerts=\"1\" NumberOfLines=\"" +
                           std::to_string(arcs.size()) + "\""));
  CHECK_THAT(vtp, Contains("MaximumInscribedSphereRadius") && Contains("GroupIds"));

  const std::string graphml = format_skeleton(skeleton, SkeletonFormat::kGraphml);
  const auto count = [](const std::string& text, const std::string& part) {
    std::size_t n = 0;
    for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; ++at) ++n;
    return n;
  };
  CHECK(count(graphml, "<node ") == 6);
  CHECK(count(graphml, "<edge ") == 5);

  std::size_t points = 0;
  const auto lines = lines_of(format_skeleton(skeleton, SkeletonFormat::kPolylines));
  CHECK(lines.size() == arcs.size() + 1);
  for (const std::string& line : lines) {
    std::istringstream in(line);
    std::size_t n = 0, numbers = 0;
    REQUIRE(in >> n);
    for (double x; in >> x;) ++numbers;
    CHECK(numbers == 3 * n);
    points += n;
  }
  CHECK(points == 5 + arcs.size() + 1);  // edges, one more point a branch, the node alone
}

TEST_CASE("malformed skeletons are refused with their line") {
  const std::string head = "ID Cx Cy Cz RADIUS #NEIGHBORS NEIGHBORS_LIST\n";
  check_refused(SkeletonFormat::kSkel, "1\n0 0 0 0 1 0\n", "line 1");
  check_refused(SkeletonFormat::kSkel, head + "9999999\n", "9999999 nodes");
  check_refused(SkeletonFormat::kSkel, head + "1\n1 0 0 0 1 0\n", "line 3: expected node 0");
  check_refused(SkeletonFormat::kSkel, head + "1\n0 0 0 0 1 1 1\n", "line 3: node index 1 is out of range");
  check_refused(SkeletonFormat::kSkel, head + "1\n0 0 0 0 1 1 0\n", "line 3: node 0 has an edge to itself");
  check_refused(SkeletonFormat::kSkel, head + "1\n0 0 0 nan 1 0\n", "line 3");
  check_refused(SkeletonFormat::kSkel, head + "1\n0 0 0 0 1 7\n0 0 0 0 0 0 0 0", "");
  check_refused(SkeletonFormat::kSwc, "1 0 0 0 0 1 -1\n2 0 0 0 0\n", "line 2: expected a number");
  check_refused(SkeletonFormat::kSwc, "1 0 0 0 0 1 -1\n1 0 0 0 1 1 -1\n", "line 2: node 1 is there twice");
  check_refused(SkeletonFormat::kSwc, "1 0 0 0 0 1 -1 9\n", "line 1: expected the end of the line");
  check_refused(SkeletonFormat::kSwc, "1 0 0 0 0 1 2\n", "there is no node 2");
  check_refused(SkeletonFormat::kSwc, "1 0 0 0 0 1 1\n", "node 1 is its own parent");
  check_refused(SkeletonFormat::kSwc, "# cut edge 1\n1 0 0 0 0 1 -1\n", "line 1");
  check_refused(SkeletonFormat::kPolylines, "2 0 0 0 1 1\n", "line 1: expected a coordinate");
  check_refused(SkeletonFormat::kPolylines, "1 0 0 0 1\n", "line 1: expected the end of the line");
  check_refused(SkeletonFormat::kPolylines, "9 0 0 0\n", "there cannot be 9 points");
  check_refused(SkeletonFormat::kPolylines, "2 0 0 0 0 0 0\n", "edge to itself");
  check_refused(SkeletonFormat::kObj, "v 0 0 0\nv 1 0\n", "line 2");
  check_refused(SkeletonFormat::kObj, "v 0 0 0\nl 1 2\n", "line 2: node index 1 is out of range");
  check_refused(SkeletonFormat::kObj, "v 0 0 0\nl 0 1\n", "line 2: node index 0");
  check_refused(SkeletonFormat::kJson, "{\"nodes\": [}", "parse error");
  check_refused(SkeletonFormat::kJson, "[]", "not an object");
  check_refused(SkeletonFormat::kJson, "{\"nodes\": []}", "edges");
  check_refused(SkeletonFormat::kJson, R"({"nodes": [{"position": [0, 0]}], "edges": []})",
                "three coordinates");
  check_refused(SkeletonFormat::kJson, R"({"nodes": [{"position": [0, 0, "x"]}], "edges": []})",
                "finite number");
  check_refused(SkeletonFormat::kJson, R"({"nodes": [], "edges": [{"source": 0, "target": 1}]})",
                "out of range");
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string edges = "element edge 1\nproperty int vertex1\nproperty int vertex2\nend_header\n";
  check_refused(SkeletonFormat::kPly, ply + edges + "0 0 0\n0 0 1\n0 2\n", "edge 0: node index 2");
  check_refused(SkeletonFormat::kPly, ply + edges + "0 0 0\n0 0 1\n1 1\n", "edge 0: node 1 has an edge to");
  check_refused(SkeletonFormat::kPly, ply + edges + "0 0 0\n0 0 nan\n0 1\n", "line 12");
  check_refused(SkeletonFormat::kPly, ply + "element edge 1\nproperty int vertex1\nend_header\n",
                "no vertex1 and vertex2");
  const TemporaryFolder folder;
  CHECK_THROWS_WITH(read_skeleton(folder.write("a.skel", "x")), Contains("a.skel: line 1"));
}

TEST_CASE(".obj polylines and negative indices; other records are skipped") {
  const std::string text = "# c\nv 0 0 0\nv 1 0 0 # c\no x\nv 2 0 0\nl 1 2 3\nl -1 -2\nf 1 2 3\n";
  const CurveSkeleton skeleton = read_skeleton(std::string_view(text), SkeletonFormat::kObj);
  CHECK(skeleton.edges == std::vector<std::array<Index, 2>>{{0, 1}, {1, 2}});
}

TEST_CASE("binary .ply skeletons; radii may be absent") {
  for (const bool radius : {false, true}) {
    test::Bytes bytes(false);
    for (const float x : {0.0f, 1.0f, 0.5f}) {
      bytes.add(x).add(2.0f).add(3.0f);
      if (radius) bytes.add(x + 1);
    }
    bytes.add(1).add(0).add(1).add(2);
    const CurveSkeleton skeleton = read_skeleton(
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\n" +
            std::string(radius ? "property float radius\n" : "") +
            "element edge 2\nproperty int vertex1\nproperty int vertex2\nend_header\n" + bytes.text,
        SkeletonFormat::kPly);
    CHECK(skeleton.edges == std::vector<std::array<Index, 2>>{{0, 1}, {1, 2}});
    CHECK(skeleton.nodes.at(2).position == Vector3(0.5, 2, 3));
    CHECK(skeleton.nodes.at(1).radius == (radius ? 2 : SkeletonNode().radius));
  }
}

TEST_CASE("a number that is not finite is not written, in any format") {
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL})
    for (int field = 0; field < 5; ++field) {
      CurveSkeleton skeleton = example();
      SkeletonNode& node = skeleton.nodes[4];
      double* const fields[] = {&node.position[1], &node.radius, &node.area, &node.perimeter,
                                &node.slice_error};
      *fields[field] = bad;
      for (const auto format :
           {SkeletonFormat::kSkel, SkeletonFormat::kObj, SkeletonFormat::kPly, SkeletonFormat::kJson,
            SkeletonFormat::kSwc, SkeletonFormat::kVtp, SkeletonFormat::kGraphml, SkeletonFormat::kPolylines})
        CHECK_THROWS_WITH(format_skeleton(skeleton, format), Contains("node 4"));
      CHECK_THROWS_AS(format_skeleton(skeleton, SkeletonFormat::kSkel), NoSkeletonError);
    }
}
