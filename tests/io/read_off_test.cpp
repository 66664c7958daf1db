// Every variant of OFF gives the same tetrahedron; every defect is refused with its line.
#include "io/tetrahedron_text.h"

using namespace mspskel;
using mspskel::test::check_tetrahedron;
using mspskel::test::replace_all;

namespace {

const std::string kPoints = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
const std::string kFaces = "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";

PolygonSoup off(const std::string& text) {
  return read_polygon_soup(std::string_view(text), MeshFormat::kOff);
}
void check_refused(const std::string& text, const std::string& where, const std::string& what) {
  test::check_refused(MeshFormat::kOff, text, where, what);
}

}  // namespace

TEST_CASE("OFF keywords: any case, glued to the counts, missing") {
  for (const std::string keyword :
       {"OFF\n", "off\n", "Off ", "OFF", "off", "", "\xEF\xBB\xBFOFF\n", "# c\n\nOFF # c\n# c\n"}) {
    INFO(keyword);
    check_tetrahedron(off(keyword + "4 4 6\n" + kPoints + kFaces));
  }
}

TEST_CASE("OFF layout: line breaks of every kind, comments, wrapped lines, blank lines") {
  const std::string text = "OFF\n4 4 6\n" + kPoints + kFaces;
  check_tetrahedron(off(replace_all(text, "\n", "\r\n")));
  check_tetrahedron(off(replace_all(text, "\n", "\r")));
  check_tetrahedron(off(replace_all(text, "\n", "\n\n  \t\n")));
  check_tetrahedron(off(replace_all(text, "\n", " # 1 2 3\n# 4 5\n")));
  check_tetrahedron(off(replace_all(text, " ", "\n")));
  check_tetrahedron(off(replace_all(text, "\n", " ")));
  check_tetrahedron(off(text.substr(0, text.size() - 1)));
}

TEST_CASE("OFF counts: the number of edges may be absent") {
  check_tetrahedron(off("OFF\n4 4\n" + kPoints + kFaces));
  check_tetrahedron(off("OFF 4 4 # c\n# c\n\n" + kPoints + kFaces));
  check_tetrahedron(off("4 4\n" + kPoints + kFaces));
  check_tetrahedron(off("COFF\n4 4\n" + replace_all(kPoints, "\n", " 1 0 0 1\n") + kFaces));
  check_tetrahedron(off("OFF\n4 4\n6\n" + kPoints + kFaces));  // on a line of its own
}

TEST_CASE("OFF numbers: signs, exponents, fractions without a digit before the point, tiny values") {
  const PolygonSoup soup = off("OFF 1 0 0\n+1.5e0 -.25 1e-400");
  CHECK(soup.points[0] == Vector3(1.5, -0.25, 0));
  CHECK(off("OFF 1 0 0 0.1 0.30000000000000004 1").points[0] == Vector3(0.1, 0.30000000000000004, 1));
}

TEST_CASE("OFF prefixes: colours, normals, texture coordinates, a fourth coordinate") {
  const auto points = [](const std::string& extras) { return replace_all(kPoints, "\n", extras + "\n"); };
  for (const std::string extras : {" 255 0 0 255", " 0.5 0.5 0.5", " 0.1 0.2 0.3 1"}) {
    check_tetrahedron(off("COFF\n4 4 0\n" + points(extras) + kFaces));
    check_tetrahedron(off("coff 4 4 0\n" + points(extras) + kFaces));
    check_tetrahedron(off("OFF\n4 4 0\n" + points(extras) + kFaces));  // undeclared
  }
  check_tetrahedron(off("NOFF\n4 4 0\n" + points(" 0 0 1") + kFaces));
  check_tetrahedron(off("noff\n4 4 0\n" + points(" 0 0 1") + kFaces));
  check_tetrahedron(off("STOFF\n4 4 0\n" + points(" 0.5 0.5") + kFaces));
  check_tetrahedron(off("STCNOFF\n4 4 0\n" + points(" 0 0 1 1 1 1 1 0.5 0.5") + kFaces));
  for (const std::string keyword : {"NCOFF", "CNOFF", "ncoff"})
    check_tetrahedron(off(keyword + "\n4 4 0\n" + points(" 0 0 1 0.1 0.2 0.3 1") + kFaces));
  check_tetrahedron(off("NSTOFF\n4 4 0\n" + points(" 0 0 1 0.5 0.5") + kFaces));
  check_tetrahedron(
      off("STCNOFF\n4 4 0\n" + replace_all(points(" 0 0 1 1 1 1 1 0.5 0.5"), " ", "\n") + kFaces));
  CHECK(off("4OFF 1 0 0  2 4 6 2").points[0] == Vector3(1, 2, 3));
  check_tetrahedron(off("nOFF 3\n4 4 0\n" + kPoints + kFaces));
  check_refused("nOFF 4\n1 0 0\n1 2 3 4\n", "dimension 4", "only 3");
  check_refused("4nOFF 3\n1 0 0\n1 2 3 4\n", "line 1", "4nOFF");
  check_refused("4OFF\n1 0 0\n1 2 3 0\n", "line 3", "not finite");
}

TEST_CASE("OFF face colours run to the end of the line; several faces a line are read, too") {
  for (const std::string colour : {" 7", " 1 0 0", " 0.1 0.2 0.3 0.4", " 255 0 0 # red"})
    check_tetrahedron(off("OFF\n4 4 0\n" + kPoints + replace_all(kFaces, "\n", colour + "\n")));
  check_tetrahedron(off("OFF\n4 4 0\n" + kPoints + replace_all(kFaces, "\n", " ")));
  const PolygonSoup mixed = off("OFF 5 2 0 0 0 0 1 0 0 1 1 0 0 1 0 2 2 0\n4 0 1 2 3 9 9 9\n5 0 1 2\n4 3");
  CHECK(mixed.begin == std::vector<Index>{0, 4, 9});
}

TEST_CASE("OFF BINARY: big-endian integers and floats") {
  std::string bytes = "OFF BINARY\n";
  const auto word = [&](std::uint32_t w) {
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(w >> shift & 255);
  };
  for (const std::uint32_t w : {4u, 4u, 0u}) word(w);
  const std::uint32_t one = 0x3F800000;
  for (const std::uint32_t w : {0u, 0u, 0u, one, 0u, 0u, 0u, one, 0u, 0u, 0u, one}) word(w);
  for (const std::uint32_t w :
       {3u, 0u, 2u, 1u, 0u, 3u, 0u, 1u, 3u, 0u, 3u, 1u, 2u, 3u, 1u, one, 3u, 2u, 0u, 3u, 0u})
    word(w);
  check_tetrahedron(off(bytes));
  check_refused(bytes.substr(0, bytes.size() - 6), "byte ", "only 10 bytes follow");
  bytes[12] = 127;
  check_refused(bytes, "byte ", "number of vertices");
}

TEST_CASE("OFF: what follows the last face is left out with a warning") {
  const PolygonSoup soup = off("OFF\n4 1 0\n" + kPoints + "3 0 1 2\n3 0 1 3\n");
  CHECK(soup.polygon_count() == 1);
  CHECK(soup.warnings == std::vector<std::string>{"line 8: what follows the last of 1 face is left out"});
  CHECK(off("OFF\n4 4 0\n" + kPoints + kFaces + "# the end\n\n").warnings.empty());
}

TEST_CASE("OFF defects are named with their line") {
  check_refused("OFF\n0 0\n", "line 3", "number of edges");
  check_refused("PLY\n4 4\n", "line 1", "keyword OFF");
  check_refused("OFF\n-4 4 0\n", "line 2", "number of vertices");
  check_refused("OFF\n# c\n400000000 4 0\n" + kPoints, "line 3", "only");
  check_refused("OFF\n4 99999999999999999999 0\n" + kPoints, "line 2", "out of range");
  check_refused("OFF\n4 4 0\n0 0 0\n1 0 zero\n0 1 0\n0 0 1\n" + kFaces, "line 4", "'zero'");
  check_refused("OFF\r\n2 0 0\r\n0 0 0\r\n1 0 nan\r\n", "line 4", "not finite");
  check_refused("OFF\n1 0 0\n1 0 inf", "line 3", "not finite");
  check_refused("OFF\n1 0 0\n1 0 1e999", "line 3", "not finite");
  check_refused("OFF\n1 0 0\n1 0 1,5", "line 3", "'1,5'");
  check_refused("OFF\n1 0 0\n1 0 +-5", "line 3", "'+-5'");
  check_refused("OFF\n4 1 0\n" + kPoints + "3 0 1 4\n", "line 7", "index 4 is out of range");
  check_refused("OFF\n4 1 0\n" + kPoints + "3 0 -1 2\n", "line 7", "index -1 is out of range");
  check_refused("OFF\n4 1 0\n" + kPoints + "3 0 1\n", "line 8", "the end of the file");
  check_refused("OFF\n4 1 0\n" + kPoints + "3000000 0 1 2\n", "line 7", "3000000 corners");
  check_refused("OFF\n4 1 0\n" + kPoints + "0 1 2 3\n", "line 7", "0 corners");
  check_refused("OFF\n4 1 0\n" + kPoints + "3 0 1 2.5\n", "line 7", "'2.5'");
}
