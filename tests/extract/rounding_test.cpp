// Coordinates that were rounded: faces without area, vertices in one place, surfaces that cross themselves.
#include <catch2/catch.hpp>
#include <filesystem>

#include "fuzz/pipeline_laws.h"
#include "mspskel/io/read_mesh.h"
#include "support/skip.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

// Grids as files have them: a share of the extent, and decimals.
std::vector<double> grids(double extent) { return {extent / 100, extent / 1000, 0.01, 0.001}; }

void check_rounded(const PolygonSoup& soup, double grid) {
  PolygonSoup rounded = soup;
  fuzz::round_coordinates(rounded, grid);
  INFO("rounded to " << grid);
  try {
    const ExtractResult result = extract_skeleton(build_mesh(rounded));
    CHECK_NOTHROW(fuzz::check_numbers(result.skeleton));
    CHECK_NOTHROW(fuzz::check_graph(result));
  } catch (const MeshError& refused) {  // says what is wrong with the mesh
    CHECK(std::string(refused.what()) != "");
  }
}

void check_samples(Index most_vertices) {
  for (const SampleInfo& info : list_samples()) {
    SampleOptions options;
    options.resolution = std::max(info.least_resolution, std::min(info.resolution, most_vertices));
    if (options.resolution > 2 * most_vertices) continue;
    INFO(info.name);
    const PolygonSoup soup = make_sample(info.name, options);
    for (const double grid : grids(fuzz::extent(soup))) check_rounded(soup, grid);
  }
}

// Every `stride`-th of the shared meshes.
void check_shared_meshes(std::size_t stride) {
  const std::filesystem::path folder = MSPSKEL_SHARED_MESHES;
  if (!std::filesystem::is_directory(folder)) return skip("no meshes in " + folder.string());
  std::vector<std::filesystem::path> files;
  for (const char* name : {"models", "psb/off"})
    for (const auto& entry : std::filesystem::directory_iterator(folder / name))
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (std::size_t i = stride / 2; i < files.size(); i += stride) {
    INFO(files[i].string());
    const PolygonSoup soup = read_polygon_soup(files[i].string());
    for (const double grid : grids(fuzz::extent(soup))) check_rounded(soup, grid);
  }
}

}  // namespace

TEST_CASE("Rounded samples have skeletons with finite numbers and the right counts") { check_samples(300); }

TEST_CASE("Some rounded meshes have skeletons with finite numbers and the right counts") {
  check_shared_meshes(20);
}

// Takes a quarter of an hour: rounding_test "[all]".
TEST_CASE("All rounded samples and meshes", "[.all]") {
  check_samples(3000);
  check_shared_meshes(1);
}
