// The samples with handles: rank and collapse are exact, and what settles each is what should.
#include <catch2/catch.hpp>

#include "mspskel/collapse/skeleton_decimater.h"
#include "mspskel/collapse/volume_cocycles.h"
#include "mspskel/samples/samples.h"
#include "topology/voxel_solids.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

void check_exact(const SurfaceSnapshot& s, Index genus) {
  const VolumeCocycles cocycles = compute_volume_cocycles(s);
  CHECK(cocycles.rank == genus);
  CHECK(cocycles.completions == 0);
  std::vector<MergingSet> sets;
  for (Index v = 0; v < s.vertex_count(); ++v) {
    MergingVertex m;
    m.position = s.position[v];
    m.area = s.vertex_area[v];
    m.valid = false;
    sets.push_back(MergingSet(m));
  }
  SkeletonDecimater decimater(make_complex(s, cocycles.label), std::move(sets));
  decimater.run();
  const ComplexTopology topology = complex_topology(decimater.complex());
  CHECK(topology.components == s.component_count);
  CHECK(topology.cycles == genus);
  CHECK(topology.label_rank == genus);
}

}  // namespace

TEST_CASE("samples of the least sizes are exact") {
  for (const SampleInfo& info : list_samples()) {
    SampleOptions options;
    options.resolution = std::max<Index>(info.least_resolution, std::min<Index>(info.resolution, 2000));
    INFO(info.name);
    const SurfaceSnapshot s = snapshot_of(make_sample(info.name, options));
    CHECK(s.component_count == info.components);
    check_exact(s, info.genus);
  }
}

TEST_CASE("plates of genus 0 to 60") {
  for (const Index holes : {0, 1, 2, 7, 15, 31, 60}) {
    SampleOptions options;
    options.count = holes;
    const SampleInfo info = describe_sample("plate", options);
    options.resolution = info.least_resolution;
    INFO(holes);
    CHECK(info.genus == holes);
    check_exact(snapshot_of(make_sample("plate", options)), holes);
  }
}

TEST_CASE("tori from thin to a hole of 5 % of the tube") {
  for (const double ratio : {0.05, 0.3, 0.8, 1 / 1.05}) {
    SampleOptions options;
    options.ratio = ratio;
    options.jitter = 0.1;
    INFO(ratio);
    check_exact(snapshot_of(make_sample("torus", options)), 1);
  }
}
