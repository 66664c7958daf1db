#include "mspskel/view/viewer_page.h"

#include <catch2/catch.hpp>
#include <limits>
#include <nlohmann/json.hpp>

#include "../../src/view/base64.h"
#include "mspskel/base/error.h"

using namespace mspskel;

namespace {

ViewerScene tetrahedron() {
  ViewerScene scene;
  scene.title = "a <b> & c";
  scene.surface.points = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}};
  for (const auto& t : {std::array<Index, 3>{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}})
    scene.surface.add_triangle(t[0], t[1], t[2]);
  scene.skeleton.nodes.resize(2);
  scene.skeleton.nodes[0].position = {0.2, 0.2, 0.2};
  scene.skeleton.nodes[1].position = {0.4, 0.4, 0.4};
  scene.skeleton.edges = {{0, 1}};
  scene.skeleton.node_of_vertex = {0, 1, 1, kNone};
  scene.report = R"({"warnings": ["</script><script>alert(1)</script>"]})";
  return scene;
}

std::string between(const std::string& text, const std::string& begin, const std::string& end) {
  const std::size_t from = text.find(begin) + begin.size();
  return text.substr(from, text.find(end, from) - from);
}

nlohmann::json description(const std::string& page) {
  return nlohmann::json::parse(between(page, "id=\"mspskel-description\">", "</script>"));
}

}  // namespace

TEST_CASE("base64 is RFC 4648's") {
  using detail::encode_base64;
  CHECK(encode_base64("").empty());
  CHECK(encode_base64("f") == "Zg==");
  CHECK(encode_base64("fo") == "Zm8=");
  CHECK(encode_base64("foobar") == "Zm9vYmFy");
  CHECK(encode_base64("\xff\xfe\xfd") == "//79");
}

TEST_CASE("a page holds the scene, and no text of it is markup") {
  const ViewerScene scene = tetrahedron();
  const std::string page = format_viewer_page(scene);
  const nlohmann::json json = description(page);
  CHECK(json["title"] == scene.title);
  CHECK(page.find("<title>a &lt;b> &amp; c") != std::string::npos);
  CHECK(page.find("alert(1)</script>") == std::string::npos);
  CHECK(json["report"]["warnings"][0] == "</script><script>alert(1)</script>");
  CHECK(json["arrays"]["position"]["count"] == 12);
  CHECK(json["arrays"]["face"]["count"] == 12);
  CHECK(json["arrays"]["node_of_vertex"]["count"] == 4);
  CHECK(json["origin"] == nlohmann::json{1.0, 1.0, 1.0});
  CHECK(json["places"].empty());
  CHECK_FALSE(json["arrays"].contains("msp"));
  CHECK(page.find("@MSPSKEL_") == std::string::npos);
}

TEST_CASE("stretches outside of the solid are places of the page") {
  ViewerScene scene = tetrahedron();
  scene.skeleton.nodes[1].position = {1.5, 1.5, 1.5};
  const nlohmann::json places = description(format_viewer_page(scene))["places"];
  REQUIRE(places.size() == 1);
  CHECK(places[0]["count"] == 1);
}

TEST_CASE("what does not fit a page is refused by name") {
  const auto refused = [](auto&& spoil) {
    ViewerScene scene = tetrahedron();
    spoil(scene);
    return scene;
  };
  CHECK_THROWS_AS(format_viewer_page(ViewerScene{}), UsageError);
  CHECK_THROWS_AS(format_viewer_page(refused([](ViewerScene& s) { s.msp = {1.0}; })), UsageError);
  CHECK_THROWS_AS(format_viewer_page(refused([](ViewerScene& s) { s.surface.corners[0] = 9; })), UsageError);
  CHECK_THROWS_AS(format_viewer_page(refused([](ViewerScene& s) {
                    s.skeleton.edges = {{0, 7}};
                  })),
                  UsageError);
  CHECK_THROWS_AS(format_viewer_page(refused([](ViewerScene& s) { s.report = "{"; })), UsageError);
  CHECK_THROWS_AS(format_viewer_page(refused([](ViewerScene& s) {
                    s.surface.points[0].x() = std::numeric_limits<double>::quiet_NaN();
                  })),
                  MeshError);
}

TEST_CASE("a page has parts and joints where the scene has them") {
  ViewerScene scene = tetrahedron();
  CHECK(description(format_viewer_page(scene))["rig"].is_null());
  scene.part_of_vertex = {0, 0, 1, kNone};
  scene.part_of_node = {0, 1};
  scene.rig = {{"root", "limb1_1"}, {kNone, 0}, {0, 1}, {{0, 0, 0}, {1, 1, 1}}, {}, {}};
  CHECK_THROWS_AS(format_viewer_page(scene), UsageError);
  scene.rig.joints = std::vector<Index>(16, 1);
  scene.rig.weights = std::vector<double>(16, 0.25);
  const nlohmann::json json = description(format_viewer_page(scene));
  CHECK(json["rig"]["names"] == nlohmann::json{"root", "limb1_1"});
  CHECK(json["arrays"]["rig_weight"]["count"] == 16);
  CHECK(json["arrays"]["part_of_vertex"]["count"] == 4);
  scene.rig.joints[3] = 2;
  CHECK_THROWS_AS(format_viewer_page(scene), UsageError);
  scene.rig.joints[3] = 0;
  scene.rig.parents[1] = 1;
  CHECK_THROWS_AS(format_viewer_page(scene), UsageError);
  scene.rig.parents[1] = 0;
  scene.part_of_node = {0};
  CHECK_THROWS_AS(format_viewer_page(scene), UsageError);
}
