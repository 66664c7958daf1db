#include <cmath>
#include <string>

#include "families.h"

namespace mspskel::detail {

namespace {

using Curve = std::function<Vector3(double)>;

// (p, q) torus knot: p times round the z axis, q times round the tube of a torus with major radius 2.
Curve torus_knot(int p, int q, double minor) {
  return [=](double u) {
    const double a = 2 * kPi * p * u, b = 2 * kPi * q * u, rho = 2 + minor * std::cos(b);
    return Vector3(rho * std::cos(a), rho * std::sin(a), -minor * std::sin(b));
  };
}

Curve figure_eight() {
  return [](double u) {
    const double a = 2 * kPi * u, rho = 2 + std::cos(2 * a);
    return Vector3(rho * std::cos(3 * a), rho * std::sin(3 * a), std::sin(4 * a));
  };
}

double length(const Curve& curve) {
  constexpr int kSteps = 1000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) sum += (curve((i + 1.0) / kSteps) - curve(i * 1.0 / kSteps)).norm();
  return sum;
}

Family knot(const char* name, const char* description, const Curve& curve, double thickest) {
  return {with_ratio(facts(name, description, 1, 0, 3000, 600), "tube radius / half the knot's mean radius",
                     0.3, 0.08, thickest),
          [=](const SampleOptions& o) {
            return make_closed_tube(curve, o.ratio, tessellation(2 * kPi * o.ratio * length(curve), o));
          },
          {}};
}

// A ring of major radius 1: `axis` is the line that goes through its hole.
struct RingPlace {
  Vector3 center, axis;
};

PolygonSoup make_rings(const std::vector<RingPlace>& places, double minor, const SampleOptions& options) {
  Tessellation t = tessellation(4 * kPi * kPi * minor * static_cast<double>(places.size()), options);
  PolygonSoup soup;
  for (const RingPlace& place : places) {
    const Eigen::Matrix3d turn =
        Eigen::Quaterniond::FromTwoVectors(Vector3::UnitZ(), place.axis).toRotationMatrix();
    append(soup, moved(make_torus(1, minor, t), turn, place.center));
    ++t.seed;  // no two rings alike
  }
  return soup;
}

void set_rings(SampleInfo& info, Index count) {
  info.genus = info.components = count;
  info.leaves = 0;
  info.resolution = 600 * count;
  info.least_resolution = 60 * count;
}

Family hopf_link() {
  SampleInfo info = with_ratio(facts("hopf-link", "two linked rings", 0, 0, 2000, 120),
                               "minor radius / major radius", 0.2, 0.02, 0.4);
  set_rings(info, 2);
  return {info,
          [](const SampleOptions& o) {
            return make_rings({{{0, 0, 0}, {0, 0, 1}}, {{1, 0, 0}, {0, 1, 0}}}, o.ratio, o);
          },
          {}};
}

// At distance 4/3 a ring is as far from the next but one as from the tube of the next.
Family chain() {
  const SampleInfo info =
      with_ratio(with_count(facts("chain", "a row of linked rings", 0, 0, 4000, 300), "rings", 5, 2, 100),
                 "minor radius / major radius", 0.15, 0.02, 0.28);
  const auto make = [](const SampleOptions& o) {
    std::vector<RingPlace> places;
    places.reserve(static_cast<std::size_t>(o.count));
    for (Index i = 0; i < o.count; ++i)
      places.push_back({{4.0 / 3 * i, 0, 0}, i % 2 == 0 ? Vector3(0, 0, 1) : Vector3(0, 1, 0)});
    return make_rings(places, o.ratio, o);
  };
  return {info, make, [](SampleInfo& i, const SampleOptions& o) { set_rings(i, o.count); }};
}

// Flat rings on a square lattice, each joined to its neighbours by an upright ring (the Japanese four-in-one
// weave).
Family chain_mail() {
  const SampleInfo info = with_ratio(
      with_count(facts("chain-mail", "a patch of flat rings joined by upright ones", 0, 0, 12000, 3000),
                 "flat rings along a side", 3, 2, 12),
      "minor radius / major radius", 0.15, 0.04, 0.22);
  const auto make = [](const SampleOptions& o) {
    constexpr double kPitch = 2.6, kJoin = 0.85;  // lattice constant, radius of an upright ring
    std::vector<RingPlace> flat;
    for (Index y = 0; y < o.count; ++y)
      for (Index x = 0; x < o.count; ++x) flat.push_back({{kPitch * x, kPitch * y, 0}, {0, 0, 1}});
    SampleOptions part = o;
    const Index uprights = 2 * o.count * (o.count - 1);
    const double share =
        static_cast<double>(flat.size()) / (static_cast<double>(flat.size()) + kJoin * uprights);
    part.resolution = static_cast<Index>(o.resolution * share);
    PolygonSoup soup = make_rings(flat, o.ratio, part);
    Tessellation t = tessellation(4 * kPi * kPi * o.ratio * static_cast<double>(flat.size()), part);
    t.seed += flat.size();
    const auto join = [&](const Vector3& a, const Vector3& b, const Vector3& axis) {
      const Eigen::Matrix3d turn =
          Eigen::Quaterniond::FromTwoVectors(Vector3::UnitZ(), axis).toRotationMatrix();
      append(soup, moved(make_torus(kJoin, o.ratio, t), turn, 0.5 * (a + b)));
      ++t.seed;
    };
    for (Index y = 0; y < o.count; ++y)
      for (Index x = 0; x < o.count; ++x) {
        const Index i = y * o.count + x;
        if (x + 1 < o.count) join(flat[i].center, flat[i + 1].center, Vector3::UnitY());
        if (y + 1 < o.count) join(flat[i].center, flat[i + o.count].center, Vector3::UnitX());
      }
    return soup;
  };
  return {info, make, [](SampleInfo& i, const SampleOptions& o) {
            set_rings(i, o.count * o.count + 2 * o.count * (o.count - 1));
          }};
}

// Three ellipses in the coordinate planes; no two are linked, all three are.
Family borromean() {
  SampleInfo info =
      with_ratio(facts("borromean-rings", "three rings, linked although no two of them are", 0, 0, 3000, 300),
                 "tube radius / short half axis", 0.2, 0.04, 0.33);
  set_rings(info, 3);
  info.resolution = 3000;
  info.least_resolution = 600;
  const auto make = [](const SampleOptions& o) {
    PolygonSoup soup;
    const auto ellipse = [](Eigen::Index axis) {
      return [axis](double u) {
        Vector3 p = Vector3::Zero();
        p[axis] = 2 * std::cos(2 * kPi * u);
        p[(axis + 1) % 3] = std::sin(2 * kPi * u);
        return p;
      };
    };
    Tessellation t = tessellation(3 * 2 * kPi * o.ratio * length(ellipse(0)), o);
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      append(soup, make_closed_tube(ellipse(axis), o.ratio, t));
      ++t.seed;
    }
    return soup;
  };
  return {info, make, {}};
}

}  // namespace

std::vector<Family> knot_families() {
  return {knot("trefoil", "knotted tube: trefoil, the (2, 3) torus knot", torus_knot(2, 3, 0.8), 0.6),
          knot("cinquefoil", "knotted tube: cinquefoil, the (2, 5) torus knot", torus_knot(2, 5, 0.8), 0.5),
          knot("knot-8-19", "knotted tube: the (3, 4) torus knot", torus_knot(3, 4, 1.0), 0.5),
          knot("figure-eight", "knotted tube: figure-eight knot", figure_eight(), 0.45),
          hopf_link(),
          chain(),
          chain_mail(),
          borromean()};
}

}  // namespace mspskel::detail
