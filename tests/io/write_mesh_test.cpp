// What is written reads back exactly; files appear whole or not at all.
#include "mspskel/io/write_mesh.h"

#include <random>

#include "io/temporary_folder.h"
#include "io/tetrahedron_text.h"
#include "mspskel/io/atomic_file.h"

using namespace mspskel;
using Catch::Contains;
using mspskel::test::TemporaryFolder;

namespace {

PolygonSoup random_soup(unsigned seed, Index largest_polygon) {
  std::mt19937_64 random(seed);
  PolygonSoup soup;
  const auto below = [&](std::uint64_t n) { return static_cast<Index>(random() % n); };
  for (int i = 0; i < 300; ++i) {
    Vector3 p;
    for (int k = 0; k < 3; ++k) {
      const double mantissa = std::uniform_real_distribution<double>(-1, 1)(random);
      p[k] = std::ldexp(mantissa, below(2000) - 1000);
    }
    soup.points.push_back(p);
  }
  soup.points.push_back({0.1, -0.0, 5e-324});
  for (int f = 0; f < 100; ++f) {
    for (Index n = 3 + below(static_cast<std::uint64_t>(largest_polygon) - 2); n > 0; --n)
      soup.corners.push_back(below(301));
    soup.begin.push_back(static_cast<Index>(soup.corners.size()));
  }
  return soup;
}
void check_equal(const PolygonSoup& a, const PolygonSoup& b) {
  CHECK(a.points == b.points);
  CHECK(a.begin == b.begin);
  CHECK(a.corners == b.corners);
}

}  // namespace

TEST_CASE("meshes of every format read back exactly, with and without colours") {
  for (const Index largest : {3, 6, 300}) {
    const PolygonSoup soup = random_soup(7, largest);
    WriteMeshOptions plain, colored;
    colored.vertex_colors = color_by_value(std::vector<double>(soup.points.size(), 0.5), 0, 1);
    for (WriteMeshOptions options : {plain, colored}) {
      for (const bool ascii : {false, true}) {
        options.ascii = ascii;
        for (const MeshFormat format : {MeshFormat::kOff, MeshFormat::kObj, MeshFormat::kPly})
          check_equal(read_polygon_soup(std::string_view(format_mesh(soup, format, options)), format), soup);
      }
    }
  }
}

TEST_CASE("a mesh goes through a file and back by its extension") {
  const TemporaryFolder folder;
  PolygonSoup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  soup.add_triangle(0, 2, 1);
  soup.add_triangle(0, 1, 3);
  soup.add_triangle(1, 2, 3);
  soup.add_triangle(2, 0, 3);
  for (const char* name : {"a.off", "a.OBJ", "a.ply"}) {
    write_mesh(folder.path(name), soup);
    const DefaultMesh mesh = read_mesh(folder.path(name));
    check_equal(to_polygon_soup(mesh), soup);
    write_mesh(folder.path(name), mesh);
    check_equal(read_polygon_soup(folder.path(name)), soup);
  }
  CHECK(folder.count() == 3);
  CHECK_THROWS_AS(write_mesh(folder.path("a.stl"), soup), UsageError);
  CHECK_THROWS_WITH(write_mesh(folder.path("a.xyz"), soup), Contains(".off .obj .ply"));
  WriteMeshOptions options;
  options.vertex_colors.resize(3);
  CHECK_THROWS_WITH(write_mesh(folder.path("b.ply"), soup, options), Contains("3 colours for 4 vertices"));
  CHECK(folder.count() == 3);
}

TEST_CASE("colours run from blue to red over the values; NaN is grey") {
  const auto colors = color_by_value({2, 1, 3, std::nan(""), 1});
  CHECK(colors[1].blue > colors[1].red);
  CHECK(colors[2].red > colors[2].blue);
  CHECK(colors[1].blue == colors[4].blue);
  CHECK(colors[3].red == colors[3].green);
  CHECK(colors[3].green == colors[3].blue);
  const auto clamped = color_by_value({-5, 0, 1, 9}, 0, 1);
  CHECK(clamped[0].blue == clamped[1].blue);
  CHECK(clamped[2].red == clamped[3].red);
  const auto same = color_by_value({4, 4});
  CHECK(same[0].blue > same[0].red);
}

TEST_CASE("files are replaced as a whole") {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.txt", "before");
  write_file_atomically(path, "after");
  CHECK(folder.read("a.txt") == "after");
  CHECK(folder.count() == 1);
  // A leftover of another process is neither used nor removed.
  folder.write("a.txt.part0", "foreign");
  write_file_atomically(path, std::string(100000, 'x'));
  CHECK(folder.read("a.txt").size() == 100000);
  CHECK(folder.read("a.txt.part0") == "foreign");
  CHECK(folder.count() == 2);
  std::filesystem::create_symlink(path, folder.path("link"));
  write_file_atomically(folder.path("link"), "through");
  CHECK(folder.read("a.txt") == "through");
  CHECK(std::filesystem::is_symlink(folder.path("link")));
  // The link's target need not exist, and is found from the link's own folder.
  std::filesystem::create_directory(folder.path("sub"));
  std::filesystem::create_symlink("../new.txt", folder.path("sub/to_new"));
  std::filesystem::create_symlink("sub/to_new", folder.path("to_link"));
  write_file_atomically(folder.path("to_link"), "new");
  CHECK(folder.read("new.txt") == "new");
  CHECK(std::filesystem::is_symlink(folder.path("to_link")));
  CHECK(std::filesystem::is_symlink(folder.path("sub/to_new")));
  std::filesystem::create_symlink("round", folder.path("round"));
  CHECK_THROWS_AS(write_file_atomically(folder.path("round"), "x"), WriteError);
}

TEST_CASE("a write-protected file is not replaced, and nothing is left beside it") {
  namespace fs = std::filesystem;
  const TemporaryFolder folder;
  const std::string path = folder.write("a.txt", "before");
  fs::permissions(path, fs::perms::owner_read | fs::perms::group_read);
  CHECK_THROWS_WITH(write_file_atomically(path, "after"),
                    Catch::Contains("a.txt: the file is write-protected"));
  OutputFiles files;
  CHECK_THROWS_AS(files.add(path, "after"), WriteError);
  CHECK(folder.read("a.txt") == "before");
  CHECK(folder.count() == 1);
}

TEST_CASE("a file that is replaced keeps its mode bits") {
  namespace fs = std::filesystem;
  const TemporaryFolder folder;
  const std::string path = folder.write("a.txt", "before");
  for (const auto mode : {fs::perms::owner_read | fs::perms::owner_write,
                          fs::perms::owner_all | fs::perms::group_read | fs::perms::others_exec}) {
    fs::permissions(path, mode);
    write_file_atomically(path, "after");
    CHECK(fs::status(path).permissions() == mode);
  }
}

TEST_CASE("a file that cannot be written is named with the reason, and nothing is left") {
  const TemporaryFolder folder;
  CHECK_THROWS_AS(write_file_atomically(folder.path("no/such/a.txt"), "x"), WriteError);
  CHECK_THROWS_WITH(write_file_atomically(folder.path("no/such/a.txt"), "x"),
                    Contains("no/such/a.txt") && Contains("No such file"));
  CHECK_THROWS_WITH(write_file_atomically(folder.path(""), "x"), Contains("directory"));
  CHECK_THROWS_AS(write_file_atomically("", "x"), WriteError);
  CHECK(folder.count() == 0);
  if (std::filesystem::exists("/dev/full"))
    CHECK_THROWS_WITH(write_file_atomically("/dev/full", "x"), Contains("/dev/full") && Contains("No space"));
  if (std::filesystem::exists("/dev/null")) {
    write_file_atomically("/dev/null", "x");
    CHECK_FALSE(std::filesystem::is_regular_file("/dev/null"));
  }
}

TEST_CASE("a point that is not finite is not written, in any format") {
  PolygonSoup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, std::nan(""), 0}};
  soup.add_triangle(0, 1, 2);
  for (const MeshFormat format : {MeshFormat::kOff, MeshFormat::kObj, MeshFormat::kPly}) {
    CHECK_THROWS_AS(format_mesh(soup, format), MeshError);
    CHECK_THROWS_WITH(format_mesh(soup, format), Contains("vertex 2"));
  }
}
