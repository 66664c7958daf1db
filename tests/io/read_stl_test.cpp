// STL as text and binary: equal corners become one point; every defect is refused with its line or byte.
#include "io/tetrahedron_text.h"

using namespace mspskel;
using mspskel::test::Bytes;
using mspskel::test::check_tetrahedron;
using mspskel::test::replace_all;

namespace {

const double kPoints[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
// Welding numbers points by first appearance: 0 1 2, then 3.
const int kCorners[4][3] = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};

std::string text_stl() {
  std::string text = "solid tetrahedron of four\n";
  for (const auto& f : kCorners) {
    text += "facet normal 0 0 1\n outer loop\n";
    for (const int v : f)
      text += "  vertex " + std::to_string(kPoints[v][0]) + " " + std::to_string(kPoints[v][1]) + " " +
              std::to_string(kPoints[v][2]) + "\n";
    text += " endloop\nendfacet\n";
  }
  return text + "endsolid tetrahedron of four\n";
}
std::string binary_stl(std::string header) {
  header.resize(80, '\0');
  Bytes bytes(false);
  bytes.add(std::uint32_t{4});
  for (const auto& f : kCorners) {
    bytes.add(0.0f).add(0.0f).add(0.0f);
    for (const int v : f)
      for (const double x : kPoints[v]) bytes.add(static_cast<float>(x));
    bytes.add(std::uint16_t{0});
  }
  return header + bytes.text;
}

PolygonSoup stl(const std::string& text) {
  return read_polygon_soup(std::string_view(text), MeshFormat::kStl);
}
void check_refused(const std::string& text, const std::string& where, const std::string& what) {
  test::check_refused(MeshFormat::kStl, text, where, what);
}
void check_welded(const PolygonSoup& soup) {
  REQUIRE(soup.points.size() == 4);
  for (std::size_t v = 0; v < 4; ++v)
    for (int k = 0; k < 3; ++k) CHECK(soup.points[v][k] == kPoints[v][k]);
  CHECK(soup.corners == std::vector<Index>{0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0});
}

}  // namespace

TEST_CASE("STL text: case, line breaks, names, several solids") {
  const std::string text = text_stl();
  check_welded(stl(text));
  check_welded(stl(replace_all(text, "\n", "\r\n")));
  check_welded(stl(replace_all(text, "\n", "\r")));
  check_welded(stl(" \n" + replace_all(replace_all(text, "facet", "FACET"), "vertex", "Vertex")));
  check_welded(stl(replace_all(text, "tetrahedron of four", "")));
  check_welded(stl(replace_all(text, "normal 0 0 1", "normal nan nan nan")));
  const std::size_t second = text.find("facet normal", text.find("facet normal") + 1);
  check_welded(stl(text.substr(0, second) + "endsolid\n\nsolid facet vertex\n" + text.substr(second)));
}

TEST_CASE("STL binary, with a header that says solid too") {
  for (const char* header : {"made by a test", "solid cube facet vertex", ""})
    check_welded(stl(binary_stl(header)));
  check_welded(stl(binary_stl("trailing bytes") + "xyz"));
}

TEST_CASE("STL welding: -0 is 0, a triangle that loses a corner is left out") {
  const PolygonSoup soup = stl(replace_all(text_stl(), " 0.000000\n", " -0.0\n"));
  check_welded(soup);
  std::string text = text_stl();
  const std::string sliver =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0 -0\nendloop\nendfacet\n";
  text.insert(text.find("endsolid"), sliver);
  check_welded(stl(text));
  // One unit in the last place apart is another point.
  const PolygonSoup apart =
      stl("solid\nfacet normal 0 0 0\nouter loop\nvertex 0.1 0 0\nvertex 0.10000000000000002 0 0\nvertex 1 1 "
          "1\nendloop\nendfacet\nendsolid");
  CHECK(apart.points.size() == 3);
}

TEST_CASE("STL text defects are named with their line") {
  const std::string text = text_stl();  // facet, outer loop, three vertices, endloop, endfacet
  check_refused("cube\n", "line 1", "'solid'");
  check_refused(text.substr(0, text.find("endsolid")), "line 30", "before 'endsolid'");
  check_refused(text.substr(0, 120), "line ", "");
  check_refused(replace_all(text, "outer loop", "loop"), "line 3", "'outer'");
  check_refused(replace_all(text, "endfacet", "endface"), "line 8", "'endface'");
  check_refused(replace_all(text, "facet normal", "faset normal"), "line 2", "'faset'");
  check_refused(replace_all(text, "vertex 1.000000", "vertex one"), "line 5", "'one'");
  check_refused(replace_all(text, "vertex 1.000000", "vertex inf"), "line 5", "not finite");
  check_refused(
      "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\nendfacet\nendsolid\n",
      "line 6", "2 corners");
}

TEST_CASE("STL binary defects are named with their byte") {
  const std::string good = binary_stl("test");
  check_refused(good.substr(0, good.size() - 1), "byte 84", "4 triangles, but only 3");
  std::string bad = good;
  bad[83] = 1;
  check_refused(bad, "byte 84", "16777220 triangles");
  bad = good;
  for (std::size_t i = 0; i < 4; ++i) bad[96 + i] = '\xFF';
  check_refused(bad, "byte 108", "not finite (triangle 0)");
  check_refused(std::string("\0\0\0", 3), "line 1", "'solid'");
}
