// Plates, lattices and foams with many handles: the finished skeleton has every cycle, in the class of its
// own handle, and every stage can be stopped.
#include <catch2/catch.hpp>
#include <map>

#include "mspskel/collapse/topology_certificate.h"
#include "mspskel/extract_skeleton.h"
#include "topology/certificate_of.h"
#include "topology/voxel_solids.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

// The bars of a cubic lattice of n nodes a side: genus 2n³ − 3n² + 1.
VoxelSolid lattice(int n) {
  mspskel::test::Random random(0);
  VoxelSolid solid;
  solid.add(random_lattice(n, 1.0, random));
  return solid;
}

void check_exact(const VoxelSolid& solid, Index least_genus) {
  const ExtractResult result = extract_skeleton_of_snapshot(snapshot_of(solid, 1), default_options());
  const TopologyCertificate certificate = certificate_of(result);
  INFO("genus " << certificate.total_genus << ": " << certificate.reason);
  CHECK(certificate.total_genus >= least_genus);
  CHECK(certificate.verdict == TopologyVerdict::kProved);
  CHECK(certificate.crossing_rank == certificate.total_genus);
}

}  // namespace

TEST_CASE("plates of genus 16, 100 and 1024 have all cycles") {
  for (const int n : {4, 10, 32}) check_exact(pierced_plate(n), n * n);
}

TEST_CASE("lattices of genus 28, 176 and 833 have all cycles") {
  check_exact(lattice(3), 28);
  check_exact(lattice(5), 176);
  check_exact(lattice(8), 833);
}

TEST_CASE("foams of genus 10, 100 and 500 have all cycles") {
  check_exact(foam({3, 3, 3}), 10);
  check_exact(foam({5, 5, 5}), 100);
  check_exact(foam({8, 8, 8}), 500);
  check_exact(foam({20, 5, 5}), 400);
}

// Some minutes: topology_test "[long]".
TEST_CASE("a plate, a lattice and foams of genus 5000 have all cycles", "[.long]") {
  check_exact(pierced_plate(71), 5041);
  check_exact(lattice(14), 4901);
  check_exact(foam({220, 5, 5}), 5000);
  check_exact(foam({16, 16, 16}), 4900);
}

TEST_CASE("every stage that the handles make longer asks more often whether to stop") {
  std::map<std::string, int> asked[2];
  for (const int k : {0, 1}) {
    ExtractOptions options = default_options();
    options.coarsen = false;
    options.execution.threads = 1;
    options.execution.progress = [&](const char* stage, double) { return ++asked[k][stage], true; };
    (void)extract_skeleton_of_snapshot(snapshot_of(pierced_plate(k == 0 ? 4 : 12), 1), options);
  }
  for (const char* stage :
       {"slice search", "skeletal points", "cocycles", "collapse", "arcs", "radius", "surface map"}) {
    INFO(stage << ": " << asked[0][stage] << ", with nine times the handles " << asked[1][stage]);
    CHECK(asked[0][stage] > 0);
    CHECK(asked[1][stage] >= 2 * asked[0][stage]);
  }
}
