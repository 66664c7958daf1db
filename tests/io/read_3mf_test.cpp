// 3MF: items, components, transforms, parts in other models of the archive; hostile archives are refused.
#include <zip.h>

#include <map>

#include "io/tetrahedron_text.h"

using namespace mspskel;
using mspskel::test::check_tetrahedron;
using mspskel::test::replace_all;

namespace {

using Files = std::map<std::string, std::string>;

std::string archive(const Files& files) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* const target = zip_source_buffer_create(nullptr, 0, 0, &error);
  zip_source_keep(target);
  zip_t* const zip = zip_open_from_source(target, ZIP_TRUNCATE, &error);
  REQUIRE(zip != nullptr);
  for (const auto& [name, text] : files)
    zip_file_add(zip, name.c_str(), zip_source_buffer(zip, text.data(), text.size(), 0), ZIP_FL_ENC_UTF_8);
  REQUIRE(zip_close(zip) == 0);
  std::string bytes;
  zip_source_open(target);
  zip_source_seek(target, 0, SEEK_END);
  bytes.resize(static_cast<std::size_t>(zip_source_tell(target)));
  zip_source_seek(target, 0, SEEK_SET);
  zip_source_read(target, bytes.data(), bytes.size());
  zip_source_close(target);
  zip_source_free(target);
  return bytes;
}

const std::string kRelationships =
    "<Relationships><Relationship Id=\"a\" Type=\"http://example.org/thumbnail\" Target=\"/b.png\"/>"
    "<Relationship Id=\"rel0\" Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\" "
    "Target=\"/3D/model.model\"/></Relationships>";
const std::string kMesh =
    "<mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" z=\"0\"/>"
    "<vertex x=\"0\" y=\"1\" z=\"0\"/><vertex x=\"0\" y=\"0\" z=\"1\"/></vertices><triangles>"
    "<triangle v1=\"0\" v2=\"2\" v3=\"1\"/><triangle v1=\"0\" v2=\"1\" v3=\"3\"/>"
    "<triangle v1=\"1\" v2=\"2\" v3=\"3\"/><triangle v1=\"2\" v2=\"0\" v3=\"3\"/></triangles></mesh>";

std::string model(const std::string& objects, const std::string& items) {
  return "<?xml version=\"1.0\"?><model unit=\"millimeter\" xmlns=\"m\"><resources>" + objects +
         "</resources><build>" + items + "</build></model>";
}
const std::string kOne = "<object id=\"1\">" + kMesh + "</object>";

PolygonSoup read(const Files& files) {
  const std::string bytes = archive(files);
  return read_polygon_soup(std::string_view(bytes), MeshFormat::k3mf);
}
PolygonSoup read(const std::string& objects, const std::string& items) {
  return read({{"_rels/.rels", kRelationships}, {"3D/model.model", model(objects, items)}});
}
void check_refused(const std::string& objects, const std::string& items, const std::string& what) {
  CHECK_THROWS_WITH(read(objects, items), Catch::Contains(what));
}

}  // namespace

TEST_CASE("3MF: one object, and objects put together, moved and mirrored") {
  check_tetrahedron(read(kOne, "<item objectid=\"1\"/>"));
  const PolygonSoup soup = read(
      kOne +
          "<object id=\"2\"><components><component objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 -1 0 0 5\"/>"
          "<component objectid=\"1\"/></components></object>",
      "<item objectid=\"2\" transform=\"0 1 0 -1 0 0 0 0 1 7 0 0\"/><item objectid=\"1\"/>");
  REQUIRE(soup.points.size() == 12);
  CHECK(soup.points[1] == Vector3(7, 1, 5));
  CHECK(soup.points[3] == Vector3(7, 0, 4));
  CHECK(std::vector<Index>(soup.corners.begin(), soup.corners.begin() + 3) == std::vector<Index>{1, 2, 0});
  CHECK(soup.points[5] == Vector3(7, 1, 0));
  CHECK(soup.points[9] == Vector3(1, 0, 0));
}

TEST_CASE("3MF: parts in other models; supports are left out with a warning") {
  const PolygonSoup soup = read(
      {{"_rels/.rels", kRelationships},
       {"3D/Objects/part.model", model(kOne, "")},
       {"3D/model.model",
        model("<object id=\"9\"><components><component p:path=\"/3D/Objects/part.model\" objectid=\"1\"/>"
              "</components></object><object id=\"8\" type=\"support\">" +
                  kMesh + "</object>",
              "<item objectid=\"9\"/><item objectid=\"8\"/>")}});
  check_tetrahedron(soup);
  CHECK(soup.warnings == std::vector<std::string>{"1 support is left out"});
}

TEST_CASE("3MF: defects are refused") {
  const std::string item = "<item objectid=\"1\"/>";
  check_refused(replace_all(kOne, "v3=\"1\"", "v3=\"4\""), item, "vertex index 4 is out of range");
  check_refused(replace_all(kOne, "x=\"1\"", "x=\"1e999\""), item, "no finite number as its x");
  check_refused(kOne, "<item objectid=\"2\"/>", "no object 2");
  check_refused(kOne, "<item objectid=\"1\" transform=\"1 2 3\"/>", "twelve numbers");
  check_refused("<object id=\"1\"><components><component objectid=\"1\"/></components></object>", item,
                "from themselves");
  CHECK_THROWS_WITH(read({{"a", "b"}}), Catch::Contains("no _rels/.rels"));
  CHECK_THROWS_WITH(read({{"_rels/.rels", kRelationships}}), Catch::Contains("no /3D/model.model"));
  const std::string whole =
      archive({{"_rels/.rels", kRelationships}, {"3D/model.model", model(kOne, "<item objectid=\"1\"/>")}});
  for (std::size_t size = 1; size < whole.size(); size += 5)
    CHECK_THROWS_AS(read_polygon_soup(std::string_view(whole).substr(0, size), MeshFormat::k3mf), ReadError);
}

TEST_CASE("3MF: objects that multiply themselves, and text that is nothing but blanks, are refused") {
  std::string objects = kOne;
  for (int id = 2; id < 12; ++id) {
    objects += "<object id=\"" + std::to_string(id) + "\"><components>";
    for (int k = 0; k < 10; ++k) objects += "<component objectid=\"" + std::to_string(id - 1) + "\"/>";
    objects += "</components></object>";
  }
  check_refused(objects, "<item objectid=\"11\"/>", "grow to more than");
  check_refused(std::string(30'000'000, ' ') + kOne, "<item objectid=\"1\"/>", "grow to more than");
}

TEST_CASE("3MF files with random edits are read or refused") {
  test::check_edits(MeshFormat::k3mf, archive({{"_rels/.rels", kRelationships},
                                               {"3D/model.model", model(kOne, "<item objectid=\"1\"/>")}}));
}
