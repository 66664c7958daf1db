// mspskel-scale: how time, memory and the skeleton itself change with the fineness of the mesh.
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <limits>
#include <utility>

#include "mspskel/base/stopwatch.h"
#include "mspskel/extract_skeleton.h"
#include "mspskel/io/read_mesh.h"
#include "mspskel/mesh/build_mesh.h"
#include "mspskel/samples/samples.h"
#include "subdivide.h"

namespace mspskel::bench {
namespace {

constexpr const char* kUsage =
    "usage: mspskel-scale [MESH [THREADS]]\n"
    "Extracts the skeleton of MESH (default: the sample quadruped) and of the same surface with 4 and 16 "
    "times\n"
    "the faces. Seconds are from the polygons to the skeleton, without reading; bytes are the most that the\n"
    "process has held. Distances are mean distances to the first mesh's skeleton and back.\n";

struct Run {
  double faces = 0, seconds = 0, bytes = 0;
  Index leaves = 0;
  CurveSkeleton skeleton;
};

double peak_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
#ifdef __APPLE__
  return static_cast<double>(usage.ru_maxrss);
#else
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
#endif
}

double distance_to_segment(const Vector3& p, const Vector3& a, const Vector3& b) {
  const Vector3 ab = b - a;
  const double length2 = ab.squaredNorm();
  const double t = length2 > 0 ? std::clamp((p - a).dot(ab) / length2, 0.0, 1.0) : 0.0;
  return (p - (a + t * ab)).norm();
}

// Mean over the length of `from` of the distance to `to`.
double mean_distance(const CurveSkeleton& from, const CurveSkeleton& to) {
  double sum = 0, length = 0;
  for (const auto& [a, b] : from.edges) {
    const Vector3 p = from.nodes[a].position, q = from.nodes[b].position;
    constexpr int kSamples = 4;
    for (int i = 0; i < kSamples; ++i) {
      const Vector3 x = p + (i + 0.5) / kSamples * (q - p);
      double nearest = std::numeric_limits<double>::infinity();
      for (const auto& [c, d] : to.edges)
        nearest = std::min(nearest, distance_to_segment(x, to.nodes[c].position, to.nodes[d].position));
      sum += nearest * (q - p).norm() / kSamples;
    }
    length += (q - p).norm();
  }
  return length > 0 ? sum / length : 0.0;
}

double diagonal(const PolygonSoup& soup) {
  Vector3 low = soup.points.front(), high = low;
  for (const Vector3& p : soup.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (high - low).norm();
}

Run run(const PolygonSoup& soup, int threads) {
  ExtractOptions options = default_options();
  options.execution.threads = threads;
  const Stopwatch watch;
  ExtractResult result = extract_skeleton_of_snapshot(make_snapshot(build_mesh(soup)), options);
  Run done;
  done.seconds = watch.seconds();
  done.faces = static_cast<double>(soup.polygon_count());
  done.bytes = peak_bytes();
  done.leaves = count_graph(result.skeleton).leaves;
  done.skeleton = std::move(result.skeleton);
  return done;
}

void print(const Run& now, const Run& first, double diagonal) {
  const double apart =
      0.5 * (mean_distance(now.skeleton, first.skeleton) + mean_distance(first.skeleton, now.skeleton));
  std::printf("%9.0f %9.2f %11.2f %11.0f %7d %10.3f", now.faces, now.seconds, 1e6 * now.seconds / now.faces,
              now.bytes / now.faces, static_cast<int>(now.leaves), 100 * apart / diagonal);
  if (now.faces > first.faces)
    std::printf(" %9.2f", std::log(now.seconds / first.seconds) / std::log(now.faces / first.faces));
  std::printf("\n");
  std::fflush(stdout);
}

int scale(int argc, char** argv) {
  if (argc > 3 || (argc > 1 && argv[1][0] == '-')) {
    std::fputs(kUsage, stderr);
    return 1;
  }
  const int threads = argc > 2 ? std::atoi(argv[2]) : 0;
  PolygonSoup soup = argc > 1 ? read_polygon_soup(argv[1]) : make_sample("quadruped", {});
  const double size = diagonal(soup);
  std::printf("    faces   seconds    us a face  bytes a face  leaves  distance, %%  exponent\n");
  Run first;
  for (int level = 0; level < 3; ++level) {
    if (level > 0) soup = subdivided(soup);
    Run now = run(soup, threads);
    if (level == 0) first = now;
    print(now, first, size);
  }
  return 0;
}

}  // namespace
}  // namespace mspskel::bench

int main(int argc, char** argv) {
  try {
    return mspskel::bench::scale(argc, argv);
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "mspskel-scale: %s\n", problem.what());
    return 2;
  }
}
