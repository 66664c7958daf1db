// Pictures judged by what must be in them: covered area, colours of inside and outside, the same bytes on any
// thread.
#include "mspskel/render/render.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <limits>

using namespace mspskel;

namespace {

PolygonSoup box(double x, double y, double z) {
  PolygonSoup soup;
  for (int i = 0; i < 8; ++i) soup.points.push_back({i & 1 ? x : 0.0, i & 2 ? y : 0.0, i & 4 ? z : 0.0});
  for (const auto& q : std::initializer_list<std::array<Index, 4>>{
           {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    soup.corners.insert(soup.corners.end(), q.begin(), q.end());
    soup.begin.push_back(static_cast<Index>(soup.corners.size()));
  }
  return soup;
}

// Unit ball about the origin, its poles on z.
PolygonSoup ball(int rings) {
  PolygonSoup soup;
  const int around = 2 * rings;
  const auto at = [&](int i, int j) { return 1 + (i - 1) * around + j % around; };
  soup.points.push_back({0, 0, 1});
  for (int i = 1; i < rings; ++i) {
    for (int j = 0; j < around; ++j) {
      const double a = kPi * i / rings, b = 2 * kPi * j / around;
      soup.points.push_back({std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)});
    }
  }
  soup.points.push_back({0, 0, -1});
  const auto south = static_cast<Index>(soup.points.size() - 1);
  for (int j = 0; j < around; ++j) {
    soup.add_triangle(0, at(1, j), at(1, j + 1));
    for (int i = 1; i + 1 < rings; ++i) {
      soup.add_triangle(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      soup.add_triangle(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
    soup.add_triangle(south, at(rings - 1, j + 1), at(rings - 1, j));
  }
  return soup;
}

CurveSkeleton segment(const Vector3& a, const Vector3& b) {
  CurveSkeleton skeleton;
  skeleton.nodes.resize(2);
  skeleton.nodes[0].position = a;
  skeleton.nodes[1].position = b;
  skeleton.edges = {{0, 1}};
  return skeleton;
}

RenderScene pierced_ball() {
  RenderScene scene;
  scene.surface = ball(24);
  scene.skeleton = segment({-0.5, 0, 0}, {2, 0, 0});
  return scene;
}

RenderOptions one_view(double azimuth, double elevation) {
  RenderOptions options;
  options.width = 200;
  options.height = 160;
  options.view_count = 1;
  options.azimuth = azimuth;
  options.elevation = elevation;
  return options;
}

double count(const Image& image, const std::function<bool(Color)>& wanted) {
  double sum = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) sum += wanted(image.at(x, y)) ? 1 : 0;
  }
  return sum;
}
bool is_red(Color c) { return c.red > c.green + 60 && c.red > c.blue + 60; }
bool is_blue(Color c) { return c.blue > c.red + 60 && c.blue > c.green + 30; }
bool is_drawn(Color c) { return c != kWhite; }

}  // namespace

TEST_CASE("a box covers its rectangle in each principal view") {
  RenderScene scene;
  scene.surface = box(3, 2, 1);
  const RenderOptions options = one_view(0, 0);
  const double margin = 0.04 * 160 + 1.5 * options.line_width;
  const double scale = std::min((200 - 2 * margin) / 3, (160 - 2 * margin) / 2);
  // Pixels that the border only touches are counted in full: at most the perimeter.
  const double front = count(render(scene, options), is_drawn);
  CHECK(front >= 6 * scale * scale - 1);
  CHECK(front <= 6 * scale * scale + 10 * scale + 4);
  RenderOptions top = one_view(0, 90);
  const double top_scale = (200 - 2 * margin) / 3;
  CHECK(count(render(scene, top), is_drawn) == Approx(3 * top_scale * top_scale).epsilon(0.05));
}

TEST_CASE("the picture does not depend on where and how large the model is") {
  RenderScene scene = pierced_ball(), moved = scene;
  // Powers of two, so that only the offset rounds.
  for (Vector3& p : moved.surface.points) p = 4096.0 * p + Vector3(1e5, -3e4, 7e4);
  for (SkeletonNode& n : moved.skeleton.nodes) n.position = 4096.0 * n.position + Vector3(1e5, -3e4, 7e4);
  const Image a = render(scene, one_view(30, 20)), b = render(moved, one_view(30, 20));
  double different = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    different += std::abs(a.pixels[i] - b.pixels[i]) > 8 ? 1 : 0;
  CHECK(different < 0.002 * static_cast<double>(a.pixels.size()));
}

TEST_CASE("a skeleton shows through the ghost, and red where it leaves the solid") {
  const RenderScene scene = pierced_ball();
  CHECK(outside_share(outside_pieces(scene)) == Approx(0.4).margin(0.01));
  for (const SkeletonPiece& piece : outside_pieces(scene)) {
    const double x = 0.5 * (piece.begin.x() + piece.end.x());
    if (std::abs(x - 1.0) > 0.02) CHECK(piece.outside == (x > 1.0));
  }
  RenderOptions options = one_view(0, 0);
  const Image image = render(scene, options);
  const double red = count(image, is_red), blue = count(image, is_blue);
  CHECK(red > 150);
  CHECK(blue > 150);
  // Opaque, the surface hides what is inside and nothing else.
  options.ghost_opacity = 1.0;
  const Image opaque = render(scene, options);
  CHECK(count(opaque, is_blue) < 0.1 * blue);
  CHECK(count(opaque, is_red) > 0.8 * red);
}

TEST_CASE("a skeleton behind a limb but outside is flagged, a cavity too") {
  RenderScene scene;
  scene.surface = ball(16);
  const PolygonSoup inner = ball(16);
  const auto offset = static_cast<Index>(scene.surface.points.size());
  for (const Vector3& p : inner.points) scene.surface.points.push_back(0.5 * p);
  for (std::size_t f = 0; f < inner.polygon_count(); ++f) {
    const Index* c = &inner.corners[3 * f];
    scene.surface.add_triangle(offset + c[0], offset + c[2], offset + c[1]);
  }
  scene.skeleton = segment({-1.5, 0.01, 0.02}, {1.5, 0.01, 0.02});
  for (const SkeletonPiece& piece : outside_pieces(scene)) {
    const double r = (0.5 * (piece.begin + piece.end)).norm();
    if (std::abs(r - 0.5) < 0.03 || std::abs(r - 1.0) < 0.03) continue;
    CHECK(piece.outside == (r < 0.5 || r > 1.0));
  }
}

TEST_CASE("one and two threads give the same picture") {
  RenderScene scene = pierced_ball();
  scene.lines.push_back({{{0, 0, 1.1}, {0, 1.1, 0}, {1.1, 0, 0}}, true, {0, 120, 120}});
  RenderOptions options;
  options.width = options.height = 150;
  options.view_count = 5;
  Execution one, two;
  one.threads = 1;
  two.threads = 2;
  const Image a = render(scene, options, one), b = render(scene, options, two);
  CHECK(a.width == 450);
  CHECK(a.height == 300);
  CHECK(a.pixels == b.pixels);
}

TEST_CASE("vertex colours reach the picture") {
  RenderScene scene;
  scene.surface = ball(12);
  for (const Vector3& p : scene.surface.points)
    scene.vertex_color.push_back(p.x() < 0 ? Color{220, 10, 10} : Color{10, 10, 220});
  const Image image = render(scene, one_view(0, 0));
  CHECK(count(image, is_red) > 1000);
  CHECK(count(image, is_blue) > 1000);
  scene.vertex_color.pop_back();
  CHECK_THROWS_AS(render(scene), UsageError);
}

TEST_CASE("a scene without a surface, flat or of one point is drawn") {
  RenderScene scene;
  scene.skeleton = segment({0, 0, 0}, {1, 0, 0});
  CHECK(count(render(scene, one_view(0, 0)), is_blue) > 300);
  CHECK(outside_share(outside_pieces(scene)) == 0.0);
  scene.skeleton.edges.clear();
  scene.skeleton.nodes.resize(1);
  CHECK(count(render(scene, one_view(0, 0)), is_drawn) > 20);
  RenderScene flat;
  flat.surface.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  flat.surface.add_triangle(0, 1, 2);
  CHECK_NOTHROW(render(flat));
}

TEST_CASE("options and scenes that cannot be drawn are refused by name") {
  const RenderScene scene = pierced_ball();
  const auto refuses = [&](const char* name, const std::function<void(RenderOptions&)>& change) {
    RenderOptions options;
    change(options);
    CHECK_THROWS_WITH(render(scene, options), Catch::Contains(name));
    CHECK_THROWS_AS(render(scene, options), UsageError);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refuses("width", [](RenderOptions& o) { o.width = 0; });
  refuses("height", [](RenderOptions& o) { o.height = 100000; });
  refuses("view_count", [](RenderOptions& o) { o.view_count = 0; });
  refuses("azimuth", [&](RenderOptions& o) { o.azimuth = nan; });
  refuses("elevation", [](RenderOptions& o) { o.elevation = 91; });
  refuses("samples", [](RenderOptions& o) { o.samples = 5; });
  refuses("ghost_opacity", [](RenderOptions& o) { o.ghost_opacity = -0.1; });
  refuses("line_width", [&](RenderOptions& o) { o.line_width = nan; });
  CHECK_THROWS_AS(render(RenderScene{}), UsageError);
  RenderScene broken = scene;
  broken.surface.corners[0] = 1 << 20;
  CHECK_THROWS_AS(render(broken), MeshError);
  broken = scene;
  broken.surface.points[3].x() = nan;
  CHECK_THROWS_AS(render(broken), MeshError);
  broken = scene;
  broken.skeleton.edges[0][1] = 2;
  CHECK_THROWS_AS(render(broken), MeshError);
  CHECK_THROWS_AS(outside_pieces(broken), MeshError);
  broken = scene;
  broken.skeleton.nodes[0].position.x() = nan;
  CHECK_THROWS_AS(render(broken), MeshError);
}

TEST_CASE("tiny and huge models are drawn like others, and what has no extent in numbers is refused") {
  const Image image = render(pierced_ball(), one_view(0, 0));
  for (const int power : {-600, 900}) {
    RenderScene scene = pierced_ball();
    for (Vector3& p : scene.surface.points) p *= std::ldexp(1.0, power);
    for (SkeletonNode& n : scene.skeleton.nodes) n.position *= std::ldexp(1.0, power);
    CHECK(render(scene, one_view(0, 0)).pixels == image.pixels);
    CHECK(outside_pieces(scene).back().outside);
  }
  RenderScene scene = pierced_ball();
  scene.skeleton = segment({-1.7e308, 0, 0}, {1.7e308, 0, 0});
  CHECK_THROWS_AS(render(scene), MeshError);
}

TEST_CASE("a progress callback can stop the rendering") {
  Execution execution;
  execution.progress = [](const char*, double) { return false; };
  CHECK_THROWS_AS(render(pierced_ball(), {}, execution), Cancelled);
}
