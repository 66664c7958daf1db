#include <cmath>
#include <string>

#include "families.h"
#include "truth.h"

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
          {},
          [=](const SampleOptions& o) { return closed_curve(curve, o.ratio, 400); }};
}

// A ring of major radius 1: `axis` is the line that goes through its hole.
struct RingPlace {
  Vector3 center, axis;
};

Eigen::Matrix3d turn_to(const Vector3& axis) {
  return Eigen::Quaterniond::FromTwoVectors(Vector3::UnitZ(), axis).toRotationMatrix();
}

PolygonSoup make_rings(const std::vector<RingPlace>& places, double minor, const SampleOptions& options) {
  Tessellation t = tessellation(4 * kPi * kPi * minor * static_cast<double>(places.size()), options);
  PolygonSoup soup;
  for (const RingPlace& place : places) {
    append(soup, moved(make_torus(1, minor, t), turn_to(place.axis), place.center));
    ++t.seed;  // no two rings alike
  }
  return soup;
}

CurveSkeleton ring_truth(const RingPlace& place, double major, double minor) {
  const auto circle = [&](double u) {
    return Vector3(major * std::cos(2 * kPi * u), major * std::sin(2 * kPi * u), 0);
  };
  return moved(closed_curve(circle, minor, 120), turn_to(place.axis), place.center);
}

CurveSkeleton rings_truth(const std::vector<RingPlace>& places, double minor) {
  CurveSkeleton truth;
  for (const RingPlace& place : places) append(truth, ring_truth(place, 1, minor));
  return truth;
}

void set_rings(SampleInfo& info, Index count) {
  info.genus = info.components = count;
  info.leaves = 0;
  info.resolution = 600 * count;
  info.least_resolution = 60 * count;
}

std::vector<RingPlace> hopf_places() { return {{{0, 0, 0}, {0, 0, 1}}, {{1, 0, 0}, {0, 1, 0}}}; }

Family hopf_link() {
  SampleInfo info = with_ratio(facts("hopf-link", "two linked rings", 0, 0, 2000, 120),
                               "minor radius / major radius", 0.2, 0.02, 0.4);
  set_rings(info, 2);
  return {info,
          [](const SampleOptions& o) { return make_rings(hopf_places(), o.ratio, o); },
          {},
          [](const SampleOptions& o) { return rings_truth(hopf_places(), o.ratio); }};
}

std::vector<RingPlace> chain_places(Index count) {
  std::vector<RingPlace> places;
  places.reserve(static_cast<std::size_t>(count));
  for (Index i = 0; i < count; ++i)
    places.push_back({{4.0 / 3 * i, 0, 0}, i % 2 == 0 ? Vector3(0, 0, 1) : Vector3(0, 1, 0)});
  return places;
}

// At distance 4/3 a ring is as far from the next but one as from the tube of the next.
Family chain() {
  const SampleInfo info =
      with_ratio(with_count(facts("chain", "a row of linked rings", 0, 0, 4000, 300), "rings", 5, 2, 100),
                 "minor radius / major radius", 0.15, 0.02, 0.28);
  return {info, [](const SampleOptions& o) { return make_rings(chain_places(o.count), o.ratio, o); },
          [](SampleInfo& i, const SampleOptions& o) { set_rings(i, o.count); },
          [](const SampleOptions& o) { return rings_truth(chain_places(o.count), o.ratio); }};
}

// Flat rings on a square lattice, each joined to its neighbours by an upright ring (the Japanese four-in-one
// weave).
struct Mail {
  static constexpr double kPitch = 2.6, kJoin = 0.85;  // lattice constant, radius of an upright ring
  std::vector<RingPlace> flat, upright;

  explicit Mail(Index count) {
    for (Index y = 0; y < count; ++y)
      for (Index x = 0; x < count; ++x) {
        const Vector3 center(kPitch * x, kPitch * y, 0);
        flat.push_back({center, {0, 0, 1}});
        if (x + 1 < count) upright.push_back({center + Vector3(kPitch / 2, 0, 0), Vector3::UnitY()});
        if (y + 1 < count) upright.push_back({center + Vector3(0, kPitch / 2, 0), Vector3::UnitX()});
      }
  }
};

Family chain_mail() {
  const SampleInfo info = with_ratio(
      with_count(facts("chain-mail", "a patch of flat rings joined by upright ones", 0, 0, 12000, 3000),
                 "flat rings along a side", 3, 2, 12),
      "minor radius / major radius", 0.15, 0.04, 0.22);
  const auto make = [](const SampleOptions& o) {
    const Mail mail(o.count);
    const auto flat = static_cast<double>(mail.flat.size());
    SampleOptions part = o;
    part.resolution = static_cast<Index>(o.resolution * flat /
                                         (flat + Mail::kJoin * static_cast<double>(mail.upright.size())));
    PolygonSoup soup = make_rings(mail.flat, o.ratio, part);
    Tessellation t = tessellation(4 * kPi * kPi * o.ratio * flat, part);
    t.seed += mail.flat.size();
    for (const RingPlace& place : mail.upright) {
      append(soup, moved(make_torus(Mail::kJoin, o.ratio, t), turn_to(place.axis), place.center));
      ++t.seed;
    }
    return soup;
  };
  const auto truth = [](const SampleOptions& o) {
    const Mail mail(o.count);
    CurveSkeleton result = rings_truth(mail.flat, o.ratio);
    for (const RingPlace& place : mail.upright) append(result, ring_truth(place, Mail::kJoin, o.ratio));
    return result;
  };
  return {info, make,
          [](SampleInfo& i, const SampleOptions& o) {
            set_rings(i, o.count * o.count + 2 * o.count * (o.count - 1));
          },
          truth};
}

// Three ellipses in the coordinate planes; no two are linked, all three are.
Family borromean() {
  SampleInfo info =
      with_ratio(facts("borromean-rings", "three rings, linked although no two of them are", 0, 0, 3000, 300),
                 "tube radius / short half axis", 0.2, 0.04, 0.33);
  set_rings(info, 3);
  info.resolution = 3000;
  info.least_resolution = 600;
  const auto ellipse = [](Eigen::Index axis) {
    return [axis](double u) {
      Vector3 p = Vector3::Zero();
      p[axis] = 2 * std::cos(2 * kPi * u);
      p[(axis + 1) % 3] = std::sin(2 * kPi * u);
      return p;
    };
  };
  const auto make = [ellipse](const SampleOptions& o) {
    PolygonSoup soup;
    Tessellation t = tessellation(3 * 2 * kPi * o.ratio * length(ellipse(0)), o);
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      append(soup, make_closed_tube(ellipse(axis), o.ratio, t));
      ++t.seed;
    }
    return soup;
  };
  const auto truth = [ellipse](const SampleOptions& o) {
    CurveSkeleton result;
    for (Eigen::Index axis = 0; axis < 3; ++axis) append(result, closed_curve(ellipse(axis), o.ratio, 200));
    return result;
  };
  return {info, make, {}, truth};
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
