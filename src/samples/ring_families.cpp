#include <cmath>

#include "families.h"

namespace mspskel::detail {

namespace {

SampleInfo info(const char* name, const char* description, Index genus, Index leaves, Index resolution,
                Index least) {
  SampleInfo i;
  i.name = name;
  i.description = description;
  i.genus = genus;
  i.leaves = leaves;
  i.resolution = resolution;
  i.least_resolution = least;
  return i;
}

SampleInfo with_ratio(SampleInfo i, const char* of, double value, double least, double most) {
  i.ratio_of = of;
  i.ratio = value;
  i.least_ratio = least;
  i.most_ratio = most;
  return i;
}

SampleInfo with_count(SampleInfo i, const char* of, Index value, Index least, Index most) {
  i.count_of = of;
  i.count = value;
  i.least_count = least;
  i.most_count = most;
  return i;
}

Family sphere() {
  return {info("sphere", "unit sphere", 0, kNone, 1000, 20),
          [](const SampleOptions& o) { return make_sphere(1, tessellation(4 * kPi, o)); },
          {}};
}

Family capsule() {
  return {with_ratio(info("capsule", "cylinder of radius 1 with half spheres at its ends", 0, 2, 1500, 30),
                     "length of the cylinder / radius", 6, 0.1, 100),
          [](const SampleOptions& o) {
            return make_capsule(1, o.ratio, tessellation(2 * kPi * o.ratio + 4 * kPi, o));
          },
          {}};
}

Family tube() {
  return {with_ratio(info("tube", "cylinder of radius 1 with flat ends", 0, 2, 1500, 40), "length / radius",
                     8, 0.1, 100),
          [](const SampleOptions& o) {
            return make_tube(1, o.ratio, tessellation(2 * kPi * o.ratio + 2 * kPi, o));
          },
          {}};
}

Family prism() {
  const auto make = [](const SampleOptions& o) {
    const double side = 2 * std::sin(kPi / o.count), base = o.count * std::sin(2 * kPi / o.count) / 2;
    return make_prism(o.count, 1, o.ratio, tessellation(o.count * side * o.ratio + 2 * base, o));
  };
  return {with_ratio(with_count(info("prism", "right prism over a regular polygon with corners at distance 1",
                                     0, 2, 1500, 40),
                                "sides", 6, 3, 100),
                     "height / corner distance", 8, 0.1, 100),
          make,
          {}};
}

Family torus() {
  return {
      with_ratio(info("torus", "torus of major radius 1", 1, 0, 2000, 60), "minor radius / major radius", 0.3,
                 0.02, 0.96),
      [](const SampleOptions& o) { return make_torus(1, o.ratio, tessellation(4 * kPi * kPi * o.ratio, o)); },
      {}};
}

}  // namespace

std::vector<Family> ring_families() { return {sphere(), capsule(), tube(), prism(), torus()}; }

}  // namespace mspskel::detail
