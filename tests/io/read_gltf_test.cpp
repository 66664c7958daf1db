// glTF: meshes where the scene's nodes put them, from every kind of buffer and primitive; defects are
// refused.
#include <fstream>
#include <nlohmann/json.hpp>

#include "io/temporary_folder.h"
#include "io/tetrahedron_text.h"

using namespace mspskel;
using mspskel::test::Bytes;
using mspskel::test::check_tetrahedron;
using nlohmann::json;

namespace {

// Four points as floats, twelve indices as shorts.
std::string buffer() {
  Bytes bytes(false);
  for (const float x : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F}) bytes.add(x);
  for (const int v : {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3}) bytes.add(static_cast<std::uint16_t>(v));
  return bytes.text;
}

json document() {
  return {{"asset", {{"version", "2.0"}}},
          {"buffers", {{{"byteLength", 72}}}},
          {"bufferViews",
           {{{"buffer", 0}, {"byteLength", 48}}, {{"buffer", 0}, {"byteOffset", 48}, {"byteLength", 24}}}},
          {"accessors",
           {{{"bufferView", 0}, {"componentType", 5126}, {"count", 4}, {"type", "VEC3"}},
            {{"bufferView", 1}, {"componentType", 5123}, {"count", 12}, {"type", "SCALAR"}}}},
          {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}}},
          {"nodes", {{{"mesh", 0}}}},
          {"scenes", {{{"nodes", {0}}}}},
          {"scene", 0}};
}

std::string glb(const json& document, const std::string& binary = buffer()) {
  std::string text = document.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  Bytes bytes(false);
  bytes.text = "glTF";
  bytes.add(std::uint32_t{2}).add(static_cast<std::uint32_t>(28 + text.size() + binary.size()));
  bytes.add(static_cast<std::uint32_t>(text.size())).text += "JSON" + text;
  bytes.add(static_cast<std::uint32_t>(binary.size())).text += std::string("BIN\0", 4) + binary;
  return bytes.text;
}

PolygonSoup gltf(const std::string& text) {
  return read_polygon_soup(std::string_view(text), MeshFormat::kGltf);
}
void check_refused(const json& changed, const std::string& what) {
  test::check_refused(MeshFormat::kGltf, glb(changed), "", what);
}

}  // namespace

TEST_CASE("glTF: another version is named, whatever else is in the file") {
  json changed = document();
  changed["asset"]["version"] = "1.0";
  changed["scene"] = "main";
  check_refused(changed, "it is glTF 1.0, not 2");
  changed["asset"]["version"] = 1;
  check_refused(changed, "it is glTF 1, not 2");
}

TEST_CASE("glTF: one mesh, in a binary file, beside its buffer, and with the buffer inside") {
  check_tetrahedron(gltf(glb(document())));
  json inside = document();
  inside["buffers"][0]["uri"] =
      "data:application/octet-stream;base64,"
      "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAACAAEAAAABAAMAAQACAAMAAgAAAAMA";
  check_tetrahedron(gltf(inside.dump()));
  const test::TemporaryFolder folder;
  json beside = document();
  beside["buffers"][0]["uri"] = "the%20data.bin";
  std::ofstream(folder.path("the data.bin"), std::ios::binary) << buffer();
  std::ofstream(folder.path("mesh.gltf")) << beside.dump();
  check_tetrahedron(read_polygon_soup(folder.path("mesh.gltf")));
  test::check_refused(MeshFormat::kGltf, beside.dump(), "", "another file");
}

TEST_CASE("glTF: nodes place their meshes, and mirrored ones are turned") {
  json scene = document();
  scene["nodes"] = {{{"translation", {10, 0, 0}}, {"children", {1, 2}}},
                    {{"mesh", 0}, {"scale", {2, 2, -2}}},
                    {{"mesh", 0}, {"matrix", {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1}}},
                    {{"mesh", 0}}};  // in no scene
  const PolygonSoup soup = gltf(glb(scene));
  REQUIRE(soup.points.size() == 8);
  CHECK(soup.points[1] == Vector3(12, 0, 0));
  CHECK(soup.points[3] == Vector3(10, 0, -2));
  CHECK(std::vector<Index>(soup.corners.begin(), soup.corners.begin() + 3) == std::vector<Index>{1, 2, 0});
  CHECK(soup.points[5].isApprox(Vector3(10, 1, 5)));
  CHECK(soup.points[6].isApprox(Vector3(9, 0, 5)));
  CHECK(soup.corners[12] == 4);
  scene.erase("scene");
  scene.erase("scenes");
  CHECK(gltf(glb(scene)).points.size() == 12);
}

TEST_CASE("glTF: strips, fans, sparse and quantised accessors; points and lines are left out") {
  json one = document();
  json& primitives = one["meshes"][0]["primitives"];
  primitives[0]["mode"] = 5;
  CHECK(gltf(glb(one)).polygon_count() == 10);
  primitives[0]["mode"] = 6;
  CHECK(gltf(glb(one)).corners[3] == 0);
  primitives[0]["mode"] = 4;
  primitives.push_back({{"attributes", {{"POSITION", 0}}}, {"mode", 1}});
  const PolygonSoup soup = gltf(glb(one));
  check_tetrahedron(soup);
  CHECK(soup.warnings == std::vector<std::string>{"1 primitive of points or lines is left out"});
  json sparse = document();
  sparse["accessors"][0]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", 1}, {"byteOffset", 2}, {"componentType", 5123}}},
      {"values", {{"bufferView", 0}, {"byteOffset", 12}}}};
  CHECK(gltf(glb(sparse)).points[2] == Vector3(1, 0, 0));
  json quantised = document();
  quantised["accessors"][0]["componentType"] = 5123;
  quantised["accessors"][0]["normalized"] = true;
  CHECK(gltf(glb(quantised)).points[0].cwiseAbs().maxCoeff() <= 1);
}

TEST_CASE("glTF: defects are refused") {
  const auto changed = [](const json::json_pointer& place, const json& value) {
    json other = document();
    other[place] = value;
    return other;
  };
  using Place = json::json_pointer;
  check_refused(changed(Place("/accessors/0/count"), 5), "accessor 0: it reaches beyond its view");
  check_refused(changed(Place("/accessors/0/count"), 700000000), "grow to more than");
  check_refused(changed(Place("/accessors/0/byteOffset"), 18446744073709551615u), "beyond its view");
  check_refused(changed(Place("/accessors/1/componentType"), 5126), "beyond its view");
  check_refused(changed(Place("/accessors/1/componentType"), 1), "unknown");
  check_refused(changed(Place("/bufferViews/1/byteLength"), 25), "beyond the buffer");
  check_refused(changed(Place("/bufferViews/0/byteStride"), 4), "beyond its view");
  check_refused(changed(Place("/buffers/0/byteLength"), 73), "72 of 73 bytes");
  check_refused(changed(Place("/nodes/0/mesh"), 1), "number 1 of the meshes");
  check_refused(changed(Place("/nodes/0/mesh"), -1), "mesh is no count");
  check_refused(changed(Place("/nodes/0/children"), {0}), "several parents");
  check_refused(changed(Place("/nodes/0/scale"), {1e308, 1e308}), "scale");
  check_refused(
      changed(Place("/meshes/0/primitives/0/extensions"), {{"KHR_draco_mesh_compression", json::object()}}),
      "Draco");
  check_refused(json::array(), "no asset");
  test::check_refused(MeshFormat::kGltf, "{", "", "not well-formed JSON");
  const std::string whole = glb(document());
  for (std::size_t size = 1; size < whole.size(); ++size)
    CHECK_THROWS_AS(gltf(whole.substr(0, size)), ReadError);
}

TEST_CASE("glTF files with random edits are read or refused") {
  test::check_edits(MeshFormat::kGltf, glb(document()), 1500);
}
