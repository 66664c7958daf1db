// Every variant of OBJ gives the same tetrahedron; every defect is refused with its line.
#include "io/tetrahedron_text.h"

using namespace mspskel;
using mspskel::test::check_tetrahedron;
using mspskel::test::replace_all;

namespace {
const std::string kPoints = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
const std::string kFaces = "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

PolygonSoup obj(const std::string& text) {
  return read_polygon_soup(std::string_view(text), MeshFormat::kObj);
}
void check_refused(const std::string& text, const std::string& where, const std::string& what) {
  test::check_refused(MeshFormat::kObj, text, where, what);
}
}  // namespace

TEST_CASE("OBJ layout: line breaks of every kind, comments, blank lines, indents") {
  const std::string text = kPoints + kFaces;
  check_tetrahedron(obj(text));
  check_tetrahedron(obj(text.substr(0, text.size() - 1)));
  check_tetrahedron(obj(replace_all(text, "\n", "\r\n")));
  check_tetrahedron(obj(replace_all(text, "\n", "\r")));
  check_tetrahedron(obj("\xEF\xBB\xBF# head\n\n" + replace_all(text, "\n", " # tail\n\n\t ")));
  check_tetrahedron(obj(replace_all(text, " ", "\t  ")));
  check_tetrahedron(obj(kFaces + kPoints));  // faces may come before their points
}

TEST_CASE("OBJ lines go on after a backslash") {
  check_tetrahedron(obj(replace_all(kPoints, " 0", " \\\n 0") + kFaces));
  check_tetrahedron(obj(kPoints + replace_all(kFaces, " ", " \\\r\n")));
  check_tetrahedron(obj(kPoints + replace_all(kFaces, " 3", " 3\\\n")));
  check_tetrahedron(obj(replace_all(kPoints, " 0\n", " 0\\\n\n") + kFaces));
  check_tetrahedron(obj("g one \\\nv 9 9 9\no a\\b\n" + kPoints + kFaces));
}

TEST_CASE("OBJ corners: texture and normal indices, negative indices") {
  for (const std::string after : {"/7", "//8", "/7/8", "/-1/-1", "/7/", "//", "/"}) {
    std::string faces = kFaces;
    for (const char* corner : {"1", "2", "3", "4"})
      faces = replace_all(faces, std::string(" ") + corner, " @" + std::string(corner) + after);
    check_tetrahedron(obj(kPoints + replace_all(faces, "@", "")));
  }
  check_tetrahedron(obj(kPoints + "f -4 -2 -3\nf -4 -3 -1\nf -3 -2 -1\nf -2 -4 -1\n"));
  const PolygonSoup soup =
      obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 0 0\nv 6 0 0\nv 7 0 0\nfo -3 -2 -1 1\n");
  CHECK(soup.corners == std::vector<Index>{0, 1, 2, 3, 4, 5, 0});
  CHECK(soup.begin == std::vector<Index>{0, 3, 7});
}

TEST_CASE("OBJ points with a weight or a colour; records of other kinds are skipped") {
  for (const std::string extra : {" 1", " 0.5 0.5 0.5", " 1 0.5 0.5 0.5"})
    check_tetrahedron(obj(replace_all(kPoints, "\n", extra + "\n") + kFaces));
  check_tetrahedron(obj("mtllib a.mtl\no thing\ng a b\ns off\nusemtl x\n" + kPoints +
                        "vt 0 0\nvn 0 0 1\nvp 1\nl 1 2\np 1\ncurv 0 1 1 2\n" + kFaces + "end"));
}

TEST_CASE("OBJ defects are named with their line") {
  check_refused("v 0 0\nv 1 0 0\n", "line 1", "the end of the line");
  check_refused("v 0 0 0\r\nv 1 x 0\r\n", "line 2", "'x'");
  check_refused("v 0 0 0\nv 1 nan 0\n", "line 2", "not finite");
  check_refused("v 0 0 -1e400\n", "line 1", "not finite");
  check_refused(kPoints + "f 1 2 5\n", "line 5", "index 5 is out of range, there are 4");
  check_refused(kPoints + "f 1 2 0\n", "line 5", "index 0 is out of range");
  check_refused(kPoints + "\n\nf 1 2 -5\n", "line 7", "index -5 is out of range");
  check_refused(kPoints + "f 1 2 99999999999999999999\n", "line 5", "'99999999999999999999'");
  check_refused(kPoints + "f\n", "line 5", "the end of the line");
  check_refused(kPoints + "f 1 2 3.5\n", "line 5", "'3.5'");
  check_refused(kPoints + "f 1/x 2 3\n", "line 5", "'1/x'");
  check_refused(kPoints + "f 1/1/1/ 2 3\n", "line 5", "'1/1/1/'");
  check_refused(kPoints + "f a b c\n", "line 5", "'a'");
}
