// Files: the format by extension, then by content; why a file cannot be read; what its bytes may cost.
#include "mspskel/io/read_mesh.h"

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "io/temporary_folder.h"
#include "io/tetrahedron_text.h"

using namespace mspskel;
using Catch::Contains;
using mspskel::test::check_tetrahedron;
using mspskel::test::TemporaryFolder;

namespace {
const std::string kOff = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
const std::string kObj = "# obj\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
const std::string kPly =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
const std::string kStl =
    "solid\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
    "0\nendloop\nendfacet\nendsolid\n";
}  // namespace

TEST_CASE("the extension picks the format, else the content does") {
  const TemporaryFolder folder;
  for (const char* name : {"a.off", "a.OFF", "a.txt", "a"})
    check_tetrahedron(read_polygon_soup(folder.write(name, kOff)));
  for (const char* name : {"b.obj", "b.Obj", "b.dat"})
    check_tetrahedron(read_polygon_soup(folder.write(name, kObj)));
  for (const char* name : {"c.ply", "c.mesh"}) check_tetrahedron(read_polygon_soup(folder.write(name, kPly)));
  for (const char* name : {"d.stl", "d.mesh"})
    CHECK(read_polygon_soup(folder.write(name, kStl)).points.size() == 3);
  CHECK(read_mesh(folder.path("a.off")).n_faces() == 4);
  CHECK_THROWS_AS(read_mesh(folder.path("d.stl")), MeshError);
}

TEST_CASE("a file that cannot be read is named with the reason") {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& path, const std::string& why) {
    CHECK_THROWS_AS(read_polygon_soup(path), ReadError);
    CHECK_THROWS_WITH(read_polygon_soup(path), Contains(path) && Contains(why));
  };
  refused(folder.path("none.off"), "No such file");
  refused(folder.path(""), "directory");
  refused(folder.write("empty.off", ""), "empty");
  refused(folder.write("what.txt", "hello world"), "OFF, OBJ, PLY, STL, VTK, VTP, glTF or 3MF");
  refused(folder.write("bad.off", "OFF\n1 0 0\n0 0 x\n"), "line 3");
  refused(folder.write("wide.obj", std::string("\xFF\xFEv\0 \0", 6)), "UTF-16");
  refused(folder.write("misnamed.obj", kOff + "v\n"), "looks like OFF");
}

TEST_CASE("a short file that announces much is refused before memory is taken") {
  using test::check_refused;
  check_refused(MeshFormat::kOff, "OFF\n2000000000 0 0\n", "line 2", "only");
  check_refused(MeshFormat::kOff, "OFF\n0 2000000000 0\n", "line 2", "only");
  check_refused(MeshFormat::kOff, "OFF\n1 1 0\n0 0 0\n2000000000 0\n", "line 4", "2000000000 corners");
  std::string ply = kPly;
  check_refused(MeshFormat::kPly, ply.replace(ply.find("face 4"), 6, "face 2000000000"), "line ",
                "2000000000");
}

TEST_CASE("cut anywhere, a file is read or refused with a typed error") {
  const std::pair<MeshFormat, std::string> files[] = {
      {MeshFormat::kOff, kOff}, {MeshFormat::kObj, kObj}, {MeshFormat::kPly, kPly}, {MeshFormat::kStl, kStl}};
  for (const auto& [format, text] : files) {
    for (std::size_t size = 0; size < text.size(); ++size) {
      try {
        const PolygonSoup soup = read_polygon_soup(std::string_view(text).substr(0, size), format);
        for (const Index v : soup.corners) REQUIRE((v >= 0 && v < static_cast<Index>(soup.points.size())));
      } catch (const ReadError& error) {
        CHECK_THAT(error.what(), Contains("line "));
      }
    }
  }
}

TEST_CASE("numbers at the end of memory that no zero byte follows") {
  for (const std::string number : {"+1", "+0.5", "1e-4000", "1x", "+", "1e", "n"}) {
    const std::string text = "OFF 1 0 0 0 0 " + number;
    const std::vector<char> exact(text.begin(),
                                  text.end());  // the address sanitizer sees any byte read behind it
    try {
      const PolygonSoup soup =
          read_polygon_soup(std::string_view(exact.data(), exact.size()), MeshFormat::kOff);
      CHECK(soup.points.size() == 1);
    } catch (const ReadError& error) {
      CHECK_THAT(error.what(), Contains("line 1"));
    }
  }
}
