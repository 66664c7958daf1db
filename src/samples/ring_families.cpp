#include <cmath>

#include "families.h"
#include "mspskel/base/error.h"
#include "truth.h"

namespace mspskel::detail {

namespace {

// Of a solid of revolution from z = -length / 2 to length / 2.
CurveSkeleton upright_axis(double length, double half_width) {
  if (length < 3 * half_width)
    throw UsageError(
        "a solid that is not half as long again as wide has no defined skeleton; use a larger --ratio");
  return axis_between({0, 0, -length / 2}, {0, 0, length / 2}, half_width);
}

Family sphere() {
  return {facts("sphere", "unit sphere", 0, kNone, 1000, 20),
          [](const SampleOptions& o) { return make_sphere(1, tessellation(4 * kPi, o)); },
          {}};
}

Family capsule() {
  return {with_ratio(facts("capsule", "cylinder of radius 1 with half spheres at its ends", 0, 2, 1500, 30),
                     "length of the cylinder / radius", 6, 0.1, 100),
          [](const SampleOptions& o) {
            return make_capsule(1, o.ratio, tessellation(2 * kPi * o.ratio + 4 * kPi, o));
          },
          {},
          [](const SampleOptions& o) { return upright_axis(o.ratio + 2, 1); }};
}

Family tube() {
  return {with_ratio(facts("tube", "cylinder of radius 1 with flat ends", 0, 2, 1500, 40), "length / radius",
                     8, 0.1, 100),
          [](const SampleOptions& o) {
            return make_tube(1, o.ratio, tessellation(2 * kPi * o.ratio + 2 * kPi, o));
          },
          {},
          [](const SampleOptions& o) { return upright_axis(o.ratio, 1); }};
}

Family prism() {
  const auto make = [](const SampleOptions& o) {
    const double side = 2 * std::sin(kPi / o.count), base = o.count * std::sin(2 * kPi / o.count) / 2;
    return make_prism(o.count, 1, o.ratio, tessellation(o.count * side * o.ratio + 2 * base, o));
  };
  return {
      with_ratio(with_count(facts("prism", "right prism over a regular polygon with corners at distance 1", 0,
                                  2, 1500, 40),
                            "sides", 6, 3, 100),
                 "height / corner distance", 8, 0.1, 100),
      make,
      {},
      [](const SampleOptions& o) { return upright_axis(o.ratio, std::cos(kPi / o.count)); }};
}

Family torus() {
  return {
      with_ratio(facts("torus", "torus of major radius 1", 1, 0, 2000, 60), "minor radius / major radius",
                 0.3, 0.02, 0.96),
      [](const SampleOptions& o) { return make_torus(1, o.ratio, tessellation(4 * kPi * kPi * o.ratio, o)); },
      {},
      [](const SampleOptions& o) {
        const auto circle = [](double u) { return Vector3(std::cos(2 * kPi * u), std::sin(2 * kPi * u), 0); };
        return closed_curve(circle, o.ratio, 120);
      }};
}

Family bowl() {
  return {with_ratio(
              facts("bowl", "half a spherical shell of outer radius 1, open at the top", 0, kNone, 3000, 300),
              "wall / outer radius", 0.1, 0.02, 0.5),
          [](const SampleOptions& o) {
            const double inner = 1 - o.ratio;
            return make_bowl(1, o.ratio,
                             tessellation(2 * kPi * (1 + inner * inner) + kPi * kPi * o.ratio, o));
          },
          {}};
}

Family shell() {
  SampleInfo info =
      with_ratio(facts("shell", "unit ball with a round cavity, whose surface is a second component", 0,
                       kNone, 2000, 60),
                 "cavity radius / outer radius", 0.6, 0.05, 0.9);
  info.components = 2;
  const auto make = [](const SampleOptions& o) {
    const Tessellation t = tessellation(4 * kPi * (1 + o.ratio * o.ratio), o);
    PolygonSoup soup = make_sphere(1, t), cavity = make_sphere(o.ratio, t);
    reverse_orientation(cavity);
    append(soup, cavity);
    return soup;
  };
  return {info, make, {}};
}

Family csaszar() {
  return {facts("csaszar-torus", "the torus of 7 vertices and 14 faces, at any resolution", 1, kNone, 7, 7),
          [](const SampleOptions&) { return make_csaszar_torus(); },
          {}};
}

}  // namespace

std::vector<Family> ring_families() {
  return {sphere(), capsule(), tube(), prism(), torus(), bowl(), shell(), csaszar()};
}

}  // namespace mspskel::detail
