// Every variant of PLY gives the same tetrahedron; every defect is refused with its line or byte.
#include "io/tetrahedron_text.h"

using namespace mspskel;
using mspskel::test::Bytes;
using mspskel::test::check_tetrahedron;
using mspskel::test::replace_all;

namespace {

const std::string kVertexHeader = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
const std::string kFaceHeader = "element face 4\nproperty list uchar int vertex_indices\n";
const std::string kStart = "ply\nformat ascii 1.0\n", kEnd = "end_header\n";
const std::string kPoints = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
const std::string kFaces = "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
const std::string kText = kStart + kVertexHeader + kFaceHeader + kEnd + kPoints + kFaces;

const int kCoordinates[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const int kCorners[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

PolygonSoup ply(const std::string& text) {
  return read_polygon_soup(std::string_view(text), MeshFormat::kPly);
}
void check_refused(const std::string& text, const std::string& where, const std::string& what) {
  test::check_refused(MeshFormat::kPly, text, where, what);
}

// Calls f(value of type T) for the scalar type of that name.
template <class F>
void add_scalar(Bytes& bytes, const std::string& type, F value) {
  if (type == "char" || type == "int8") bytes.add(static_cast<std::int8_t>(value));
  if (type == "uchar" || type == "uint8") bytes.add(static_cast<std::uint8_t>(value));
  if (type == "short" || type == "int16") bytes.add(static_cast<std::int16_t>(value));
  if (type == "ushort" || type == "uint16") bytes.add(static_cast<std::uint16_t>(value));
  if (type == "int" || type == "int32") bytes.add(static_cast<std::int32_t>(value));
  if (type == "uint" || type == "uint32") bytes.add(static_cast<std::uint32_t>(value));
  if (type == "float" || type == "float32") bytes.add(static_cast<float>(value));
  if (type == "double" || type == "float64") bytes.add(static_cast<double>(value));
}

std::string binary(bool big, const std::string& coordinate, const std::string& size,
                   const std::string& index) {
  Bytes bytes(big);
  for (const auto& p : kCoordinates)
    for (const int x : p) add_scalar(bytes, coordinate, x);
  for (const auto& f : kCorners) {
    add_scalar(bytes, size, 3);
    for (const int v : f) add_scalar(bytes, index, v);
  }
  return std::string("ply\nformat ") + (big ? "binary_big_endian" : "binary_little_endian") + " 1.0\n" +
         replace_all(kVertexHeader, "float", coordinate) + "element face 4\nproperty list " + size + " " +
         index + " vertex_indices\nend_header\n" + bytes.text;
}

const std::vector<std::string> kIntegers{"char",   "int8",   "uchar", "uint8", "short", "int16",
                                         "ushort", "uint16", "int",   "int32", "uint",  "uint32"};
const std::vector<std::string> kReals{"float", "float32", "double", "float64"};

}  // namespace

TEST_CASE("PLY text: line breaks, comments, names, wrapped values") {
  check_tetrahedron(ply(kText));
  check_tetrahedron(ply(kText.substr(0, kText.size() - 1)));
  check_tetrahedron(ply(replace_all(kText, "\n", "\r\n")));
  check_tetrahedron(ply(replace_all(kText, "\n", "\r")));
  check_tetrahedron(ply(replace_all(kText, "vertex_indices", "vertex_index")));
  check_tetrahedron(ply(replace_all(kText, "element", "comment element vertex 7\nobj_info\nelement")));
  check_tetrahedron(
      ply(kStart + kVertexHeader + kFaceHeader + kEnd + replace_all(kPoints + kFaces, " ", "\n")));
  check_tetrahedron(ply(kStart + kFaceHeader + kVertexHeader + kEnd + kFaces + kPoints));  // faces first
}

TEST_CASE("PLY text: a line ends its element, whatever numbers are left on it") {
  check_tetrahedron(ply(kStart + kVertexHeader + kFaceHeader + kEnd +
                        replace_all(kPoints + kFaces, "\n", " 1 1 0.5 -7\n")));
}

TEST_CASE("PLY binary: only the header's last line ends with a carriage return and a line feed") {
  const std::string good = binary(false, "float", "uchar", "int");
  check_tetrahedron(ply(replace_all(good, "end_header\n", "end_header\r\n")));
}

TEST_CASE("PLY scalar types: every name, as coordinate, list size and index, in text and both byte orders") {
  auto coordinates = kIntegers;
  coordinates.insert(coordinates.end(), kReals.begin(), kReals.end());
  for (const bool big : {false, true}) {
    for (const auto& type : coordinates) check_tetrahedron(ply(binary(big, type, "uchar", "int")));
    for (const auto& type : kIntegers) {
      check_tetrahedron(ply(binary(big, "float", type, "int")));
      check_tetrahedron(ply(binary(big, "double", "uchar", type)));
    }
  }
  for (const auto& type : coordinates) check_tetrahedron(ply(replace_all(kText, "float", type)));
  for (const auto& type : kIntegers)
    check_tetrahedron(ply(replace_all(kText, "uchar int", type + " " + type)));
}

TEST_CASE("PLY: other elements and properties before, between and after are skipped") {
  const std::string header =
      "element camera 2\nproperty list short double view\nproperty char c\n"
      "element vertex 4\nproperty float nx\nproperty double x\nproperty list uchar int ring\nproperty int "
      "y\nproperty short z\n"
      "property uchar red\nelement face 4\nproperty uchar flag\nproperty list int ushort "
      "vertex_index\nproperty list uchar float texcoord\n"
      "element edge 1\nproperty int vertex1\nproperty int vertex2\nelement nothing 1000000000\nend_header\n";
  std::string text = kStart + header + "2 0.5 nan 7\n0 8\n";
  for (const auto& p : kCoordinates)
    text += "nan " + std::to_string(p[0]) + " 2 5 6 " + std::to_string(p[1]) + " " + std::to_string(p[2]) +
            " 255\n";
  for (const auto& f : kCorners)
    text += "1 3 " + std::to_string(f[0]) + " " + std::to_string(f[1]) + " " + std::to_string(f[2]) +
            " 2 0.1 inf\n";
  check_tetrahedron(ply(text + "0 1\n"));

  for (const bool big : {false, true}) {
    Bytes bytes(big);
    bytes.add(std::int16_t{2})
        .add(0.5)
        .add(0.25)
        .add(std::int8_t{7})
        .add(std::int16_t{0})
        .add(std::int8_t{8});
    for (const auto& p : kCoordinates)
      bytes.add(1.0f)
          .add(double(p[0]))
          .add(std::uint8_t{2})
          .add(5)
          .add(6)
          .add(p[1])
          .add(std::int16_t(p[2]))
          .add(std::uint8_t{9});
    for (const auto& f : kCorners) {
      bytes.add(std::uint8_t{1}).add(3);
      for (const int v : f) bytes.add(static_cast<std::uint16_t>(v));
      bytes.add(std::uint8_t{2}).add(0.1f).add(0.2f);
    }
    bytes.add(0).add(1);
    const std::string start =
        std::string("ply\nformat ") + (big ? "binary_big_endian" : "binary_little_endian") + " 1.0\n";
    check_tetrahedron(ply(start + header + bytes.text));
    check_tetrahedron(ply(replace_all(start + header, "\n", "\r\n") + bytes.text));
  }
}

TEST_CASE("PLY header defects are named with their line") {
  check_refused("plx\n", "line 1", "not 'ply'");
  check_refused("ply\nelement vertex 0\nend_header\n", "line 3", "no format");
  check_refused("ply\nformat ascii 1.0\n", "line 3", "end_header");
  check_refused("ply\nformat utf8 1.0\n", "line 2", "'utf8'");
  check_refused(kStart + "elephant vertex 4\n", "line 3", "'elephant'");
  check_refused(kStart + "property float x\n", "line 3", "before the first element");
  check_refused(kStart + "element vertex -1\n", "line 3", "cannot be -1");
  check_refused(kStart + "element vertex 4 5\n", "line 3", "'5'");
  check_refused(kStart + "element vertex 4\nproperty real x\n", "line 4", "'real'");
  check_refused(kStart + "element vertex 4\nproperty float\n", "line 4", "a property's name");
  check_refused(kStart + "element vertex 4\nproperty float x\nproperty float x\n", "line 5",
                "declared twice");
  check_refused(kStart + kVertexHeader + kVertexHeader, "line 7", "declared twice");
  check_refused(kStart + "element vertex 0\nproperty float x\nproperty float y\nend_header\n", "line 6",
                "no x, y and z");
  check_refused(kStart + kVertexHeader + "element face 1\nproperty int n\nend_header\n", "line 9",
                "no vertex_indices");
  check_refused(kStart + "element face 1\nproperty list float int vertex_index\n", "line 4",
                "not an integer");
  check_refused(kStart + "element face 1\nproperty list uchar float vertex_index\n", "line 4",
                "not integers");
}

TEST_CASE("PLY body defects are named with their line or byte") {
  const std::string head = kStart + kVertexHeader + kFaceHeader + kEnd;  // 9 lines
  check_refused(replace_all(kText, "1 0 0", "1 0 nan"), "line 11", "not finite");
  check_refused(replace_all(kText, "1 0 0", "1 0 x"), "line 11", "'x'");
  check_refused(replace_all(kText, "3 0 1 3", "3 0 1 4"), "line 15", "index 4 is out of range");
  check_refused(replace_all(kText, "3 0 1 3", "3 0 1 -1"), "line 15", "index -1 is out of range");
  check_refused(replace_all(kText, "3 0 1 3", "300 0 1 3"), "line 15", "300 values");
  check_refused(replace_all(kText, "3 0 1 3", "0 0 1 3"), "line 15", "no corners");
  check_refused(replace_all(kText, "element vertex 4", "element vertex 400000000"), "line 10",
                "400000000 elements 'vertex'");
  check_refused(replace_all(kText, "3 2 0 3\n", "3 2 0\n"), "line 18", "the end of the file");
  for (const bool big : {false, true}) {
    const std::string good = binary(big, "float", "uchar", "int");
    const std::size_t body = good.find("end_header\n") + 11;
    check_refused(good.substr(0, good.size() - 1), "byte ", "cannot have 3 values");
    check_refused(good.substr(0, body + 50), "byte ", "4 elements 'face'");
    std::string bad = good;
    bad[body + 48] = 127;
    check_refused(bad, "byte ", "127 values");
    bad = good;
    for (std::size_t i = 0; i < 4; ++i) bad[body + i] = '\xFF';
    check_refused(bad, "byte " + std::to_string(body + 4), "not finite");
    bad = good;
    for (std::size_t i = 0; i < 4; ++i) bad[body + 49 + i] = '\xFF';
    check_refused(bad, "byte " + std::to_string(body + 53), "index -1 is out of range");
    check_refused(replace_all(good, "element face 4", "element face 2000000000"), "byte ",
                  "2000000000 elements");
  }
}

TEST_CASE("PLY triangle strips: every second triangle turned round, -1 between strips") {
  const std::string start = kStart + kVertexHeader + "element tristrips 1\nproperty list int int ";
  const auto corners = [&](const std::string& strips) {
    return ply(start + "vertex_indices\nend_header\n" + kPoints + strips).corners;
  };
  // 0 2 1 and 0 1 3 from one strip of four, the other two alone.
  const std::string strips = "12  2 0 1 3  -1  1 2 3  -1  2 0 3";
  CHECK(corners(strips) == std::vector<Index>{2, 0, 1, 1, 0, 3, 1, 2, 3, 2, 0, 3});
  CHECK(corners("4 -1 0 1 -1").empty());
  CHECK(corners("5 0 1 1 2 3") == std::vector<Index>{1, 2, 3});
  CHECK(ply(start + "vertex_index\nend_header\n" + kPoints + strips).polygon_count() == 4);
  check_refused(start + "vertex_indices\nend_header\n" + kPoints + "3 0 1 4\n", "line 14", "vertex index 4");
  check_refused(start + "vertex_indices\nend_header\n" + kPoints + "3 0 1 -2\n", "line 14",
                "vertex index -2");
  check_refused(start + "corners\nend_header\n" + kPoints + strips, "line", "triangle strips");
}
