#pragma once

#include <Eigen/Sparse>
#include <algorithm>
#include <array>
#include <cmath>

#include "mspskel/arcs/detail/arc_points.h"
#include "mspskel/arcs/detail/own_step.h"
#include "mspskel/arcs/detail/waver.h"
#include "mspskel/base/even_directions.h"
#include "mspskel/base/linkage.h"
#include "mspskel/base/sparse_solvers.h"

namespace mspskel {
namespace detail {

// The unit vector across a unit tangent that points most nearly to the nearest surface point.
inline Vector3 direction_to_surface(const BoundingVolumeHierarchy& solid, const Vector3& x,
                                    const Vector3& tangent) {
  Vector3 u = solid.closest(x).point - x;
  u -= u.dot(tangent) * tangent;
  return u.norm() < 1e-12 ? tangent.unitOrthogonal() : u.normalized();
}

// How many points of an evenly spaced line on each side of a point its direction is taken over: as far as the
// solid is thick, as long as the line hardly bends there. A section stands across the part that the line runs
// through: in a thick one, that of a waver would tilt with it, and centring make it worse.
inline std::size_t reach_of_direction(const std::vector<Vector3>& line, double spacing, std::size_t i,
                                      double thickness) {
  constexpr double kStraight = 0.9;  // least distance of the ends, in lengths of the way by the point
  if (!(spacing > 0)) return 1;
  auto reach = static_cast<std::size_t>(std::min(thickness / spacing, static_cast<double>(line.size())));
  for (; reach > 1; reach = 3 * reach / 4) {
    const Vector3 &from = line[i - std::min(i, reach)], &to = line[std::min(i + reach, line.size() - 1)];
    if ((to - from).norm() >= kStraight * ((line[i] - from).norm() + (to - line[i]).norm())) break;
  }
  return std::max<std::size_t>(reach, 1);
}

// The distance of every hub to the surface.
inline std::vector<double> clearance_of_hubs(const ArcPoints& points, const BoundingVolumeHierarchy& solid,
                                             const Execution& execution) {
  std::vector<double> clearance(static_cast<std::size_t>(points.hub_count), 0.0);
  parallel_for(
      points.hub_count, "arcs", execution, [] { return 0; },
      [&](Index h, int) {
        if (points.kind[h] != ArcPoints::Kind::kDead) clearance[h] = solid.distance(points.x[h]);
      });
  return clearance;
}

// Per inner point of a chain the distance to the surface: that of the hubs, at every fourth point, and in
// proportion between, which is right to a step or two. Hubs get none: joints have no direction, and a leaf's
// end has that of its last step. Cost: a query for each fourth point.
inline void find_thickness(const ArcPoints& points, const std::vector<Index>& chain,
                           const BoundingVolumeHierarchy& solid, const std::vector<double>& clearance_of_hub,
                           std::vector<double>& thickness) {
  constexpr std::size_t kEvery = 4;
  if (chain.size() < 3) return;
  double before = clearance_of_hub[chain.front()];
  for (std::size_t from = 0; from + 1 < chain.size(); from += kEvery) {
    const std::size_t to = std::min(from + kEvery, chain.size() - 1);
    const double after =
        to + 1 < chain.size() ? solid.distance(points.x[chain[to]]) : clearance_of_hub[chain[to]];
    for (std::size_t k = std::max<std::size_t>(from, 1); k < to; ++k)
      thickness[chain[k]] =
          before + (after - before) * static_cast<double>(k - from) / static_cast<double>(to - from);
    before = after;
  }
}

// Makes `line` the points of a chain. Returns their mean distance.
inline double lay_out(const ArcPoints& points, const std::vector<Index>& chain, std::vector<Vector3>& line) {
  line.clear();
  double length = 0;
  for (const Index i : chain) {
    if (!line.empty()) length += (points.x[i] - line.back()).norm();
    line.push_back(points.x[i]);
  }
  return length / static_cast<double>(std::max<std::size_t>(line.size(), 2) - 1);
}

// Unit tangents of a chain's inner points and leaf ends from a smoothed copy of it; zero elsewhere.
// `thickness`: per point the distance to the surface.
inline void find_tangents(const ArcPoints& points, const std::vector<Index>& chain,
                          const std::vector<double>& thickness, int smoothing,
                          std::vector<Vector3>& tangent) {
  std::vector<Vector3> line, copy;
  const double spacing = lay_out(points, chain, line);
  for (int round = 0; round < smoothing; ++round) {
    copy = line;
    for (std::size_t i = 1; i + 1 < line.size(); ++i)
      line[i] = 0.5 * copy[i] + 0.25 * (copy[i - 1] + copy[i + 1]);
  }
  for (std::size_t i = 0; i < chain.size(); ++i) {
    if (points.kind[chain[i]] == ArcPoints::Kind::kJoint) continue;
    const std::size_t reach = reach_of_direction(line, spacing, i, thickness[chain[i]]);
    const Vector3 along = line[std::min(i + reach, line.size() - 1)] - line[i - std::min(i, reach)];
    if (along.norm() > 0) tangent[chain[i]] = along.normalized();
  }
}

// For every tangent of a chain a unit vector across it where the section's first ray goes. Along the chain it
// turns as little as the tangents let it; it begins towards the nearest surface, so all rays turn with the
// model.
inline void find_first_rays(const ArcPoints& points, const std::vector<Index>& chain,
                            const std::vector<Vector3>& tangent, const BoundingVolumeHierarchy& solid,
                            std::vector<Vector3>& ray) {
  Vector3 last = Vector3::Zero();
  for (const Index i : chain) {
    if (tangent[i].isZero()) continue;
    last -= last.dot(tangent[i]) * tangent[i];
    if (last.norm() < 0.1) last = direction_to_surface(solid, points.x[i], tangent[i]);
    last.normalize();
    ray[i] = last;
  }
}

// What the points of all chains know of where they run.
struct ArcCourse {
  std::vector<double> clearance_of_hub;     // distance to the surface
  std::vector<double> thickness;            // per point, likewise; 0 for hubs
  std::vector<Vector3> tangent, first_ray;  // per point, unit vectors; zero where there is none
};

inline ArcCourse find_course(const ArcPoints& points, const BoundingVolumeHierarchy& solid, int smoothing,
                             const Execution& execution) {
  ArcCourse course;
  course.clearance_of_hub = clearance_of_hubs(points, solid, execution);
  course.thickness.assign(points.x.size(), 0.0);
  course.tangent.assign(points.x.size(), Vector3::Zero());
  course.first_ray.assign(points.x.size(), Vector3::Zero());
  parallel_for(
      static_cast<Index>(points.chains.size()), "arcs", execution, [] { return 0; },
      [&](Index c, int) {
        const std::vector<Index>& chain = points.chains[c];
        find_thickness(points, chain, solid, course.clearance_of_hub, course.thickness);
        find_tangents(points, chain, course.thickness, smoothing, course.tangent);
        find_first_rays(points, chain, course.tangent, solid, course.first_ray);
      },
      1);
  return course;
}

// Of an end that stays: far above what the stiffness of the thickest solid comes to.
constexpr double kHeldWeight = 1e9;

struct Pull {
  Vector3 goal = Vector3::Zero();
  Eigen::Matrix3d weight = Eigen::Matrix3d::Zero();
  double stiffness = 1.0;
};

inline Pull even_pull(const Vector3& goal, double weight) {
  return {goal, weight * Eigen::Matrix3d::Identity(), 1.0};
}

// Of a point that nothing pulls.
constexpr double kFreeWeight = 1e-3;

// Inner points between two others of their chain whose sections a round leaves out, every second one; they
// take turns, so that all are seen.
inline std::vector<std::uint8_t> left_out(const ArcPoints& points, int round) {
  std::vector<std::uint8_t> out(points.x.size(), 0);
  for (const auto& chain : points.chains)
    for (std::size_t i = 2 + static_cast<std::size_t>(round % 2); i + 2 < chain.size(); i += 2)
      out[chain[i]] = 1;
  return out;
}

// The pull of a point without a section of its own: the mean of its neighbours'.
inline Pull pull_between(const ArcPoints& points, const std::vector<Pull>& pulls, Index i) {
  const Index a = points.next[i][0], b = points.next[i][1];
  const Vector3 move = 0.5 * (pulls[a].goal - points.x[a] + pulls[b].goal - points.x[b]);
  return {points.x[i] + move, 0.5 * (pulls[a].weight + pulls[b].weight),
          0.5 * (pulls[a].stiffness + pulls[b].stiffness)};
}

// `share` is that of options.step which the point's arc has.
inline Pull section_pull(const BoundingVolumeHierarchy& solid, const Vector3& x, const Vector3& tangent,
                         const Vector3& start, double share, const CenteringOptions& options) {
  const VisibleSection section = visible_section(solid, x, tangent, start, options.rays);
  if (!section.closed || section.radius <= 0) return even_pull(x, kFreeWeight);
  const double move = (section.centre - x).norm() / (0.7 * section.radius);
  // A second difference grows with the square of the step; the reference makes the curve independent of it.
  constexpr double kReferenceStep = 0.008;
  const double thickness = section.clearance * kReferenceStep / (options.step * options.step * share);
  const double weight = 1 / (1 + std::pow(move, 4));
  const double along_wide = std::pow(section.roundness, 1.5) * section.narrowness;
  const Eigen::Matrix3d less = (1 - along_wide) * section.wide * section.wide.transpose();
  return {section.centre, weight * (Eigen::Matrix3d::Identity() - less), thickness * thickness};
}

// Near a joint a section is that of the part which the arc leaves, and says nothing of where it runs: there
// weights fall with the distance.
inline void loosen_near_joints(const ArcPoints& points, const std::vector<Index>& chain,
                               const std::vector<double>& clearance_of_hub, std::vector<Pull>& pulls) {
  constexpr double kReach = 2;  // radii of the joint's ball
  if (chain.empty()) return;
  for (const Index joint : {chain.front(), chain.back()}) {
    const double reach = points.next[joint].size() > 2 ? kReach * clearance_of_hub[joint] : 0.0;
    for (const Index i : chain) {
      if (points.kind[i] != ArcPoints::Kind::kInner) continue;
      const double distance = (points.x[i] - points.x[joint]).norm();
      if (distance < reach) pulls[i].weight *= std::max(kFreeWeight, distance / reach);
    }
  }
}

// In its own ball an arc bends one way or not at all. What turns to and fro there follows sections that its
// own direction tilts, so it is held the stiffer, the more it wavers.
inline void stiffen_wavers(const ArcPoints& points, const std::vector<Index>& chain,
                           const std::vector<double>& thickness, std::vector<Pull>& pulls) {
  constexpr double kGain = 100;   // of a waver of one radian, and as its square
  constexpr double kSpan = 1.25;  // radii of the ball to each side
  constexpr double kLeast = 6;    // points; thinner limbs are followed
  std::vector<Vector3> line;
  const double spacing = lay_out(points, chain, line);
  if (!(spacing > 0)) return;
  for (std::size_t i = 1; i + 1 < line.size(); ++i) {
    const double reach = kSpan * thickness[chain[i]] / spacing;
    if (reach >= kLeast) pulls[chain[i]].stiffness *= 1 + kGain * std::pow(waver(line, i, reach), 2);
  }
}

// How many more edges there are than points: so many cycles that pieces have beyond one each.
inline Index surplus_of_edges(const ArcPoints& points) {
  Index surplus = 0;
  for (const auto& chain : points.chains)
    if (!chain.empty()) surplus += static_cast<Index>(chain.size()) - 1;
  for (const ArcPoints::Kind kind : points.kind)
    if (kind != ArcPoints::Kind::kDead) --surplus;
  return surplus;
}

// Minimises Σ (x − goal)ᵀ W (x − goal) + Σ μ|x − mean of neighbours|² with μ = smoothness · stiffness.
inline std::vector<Vector3> solve_positions(const ArcPoints& points, const std::vector<Pull>& pulls,
                                            double smoothness) {
  using Triplet = Eigen::Triplet<double>;
  const Index n = points.count();
  CoupledMatrix matrix;
  matrix.even.resize(n, n);
  matrix.diagonal.assign(points.x.size(), Eigen::Matrix3d::Zero());
  std::vector<Triplet> entries;
  Eigen::VectorXd right(3 * n), guess(3 * n);
  const auto add = [&](Index i, Index j, double value) {
    entries.emplace_back(i, j, value);
    if (i == j) matrix.diagonal[i].diagonal().array() += value;
  };
  for (Index i = 0; i < n; ++i) {
    const Eigen::Matrix3d weight = pulls[i].weight + 1e-9 * Eigen::Matrix3d::Identity();
    entries.emplace_back(i, i, weight.trace() / 3);
    matrix.diagonal[i] += weight;
    right.segment<3>(3 * i) = weight * pulls[i].goal;
    guess.segment<3>(3 * i) = points.x[i];
    const auto& next = points.next[i];
    if (next.size() < 2) continue;
    const double mu =
        smoothness * pulls[i].stiffness * (points.kind[i] == ArcPoints::Kind::kInner ? 1.0 : 0.3);
    // Row r = e_i − Σ e_j / k; its outer product enters the matrix.
    const double k = static_cast<double>(next.size());
    add(i, i, mu);
    for (const Index a : next) {
      add(i, a, -mu / k);
      add(a, i, -mu / k);
      for (const Index b : next) add(a, b, mu / (k * k));
    }
  }
  matrix.even.setFromTriplets(entries.begin(), entries.end());
  constexpr Index kFewCycles = 128;  // with more than that, elimination fills in
  const auto solved = solve_coupled(matrix, right, guess, surplus_of_edges(points) > kFewCycles);
  if (!solved) return points.x;
  std::vector<Vector3> x(points.x.size());
  for (Index i = 0; i < n; ++i) x[i] = solved->segment<3>(3 * i);
  return x;
}

}  // namespace detail

MSPSKEL_INLINE VisibleSection visible_section(const BoundingVolumeHierarchy& solid, const Vector3& x,
                                              const Vector3& tangent, int rays) {
  return visible_section(solid, x, tangent, detail::direction_to_surface(solid, x, tangent), rays);
}

MSPSKEL_INLINE VisibleSection visible_section(const BoundingVolumeHierarchy& solid, const Vector3& x,
                                              const Vector3& tangent, const Vector3& u, int rays) {
  const Vector3 w = tangent.cross(u);
  std::array<double, 256> r;
  solid.ray_fan(x, u, w, rays, r.data());
  VisibleSection section;
  section.clearance = *std::min_element(r.begin(), r.begin() + rays);
  double area = 0, perimeter = 0, sum = 0, sum_u = 0, sum_w = 0;
  detail::RegionMoments moments;
  const std::vector<Vector2>& direction = even_directions(rays);
  const double cos_turn = direction[1].x(), sin_turn = direction[1].y();
  double at_u = r[rays - 1] * cos_turn, at_w = -r[rays - 1] * sin_turn;
  for (int i = 0; i < rays; ++i) {
    if (!std::isfinite(r[i])) return section;
    const double s = r[i + 1 < rays ? i + 1 : 0];
    const double next_u = r[i] * direction[i].x(), next_w = r[i] * direction[i].y();
    moments.add(at_u, at_w, next_u, next_w);
    at_u = next_u;
    at_w = next_w;
    sum += r[i];
    sum_u += next_u;
    sum_w += next_w;
    area += 0.5 * r[i] * s * sin_turn;
    perimeter += std::sqrt(std::max(0.0, r[i] * r[i] + s * s - 2 * r[i] * s * cos_turn));
  }
  section.closed = true;
  section.centre = x + 2.0 / rays * (sum_u * u + sum_w * w);
  section.radius = std::sqrt(area / kPi);
  section.mean_ray = sum / rays;
  section.half_width = moments.half_width();
  const detail::RegionMoments::Axes axes = moments.axes();
  section.wide = std::cos(axes.angle) * u + std::sin(axes.angle) * w;
  section.narrowness = axes.larger > 0 ? std::sqrt(axes.smaller / axes.larger) : 1.0;
  section.roundness = perimeter > 0 ? 4 * kPi * area / (perimeter * perimeter) : 0.0;
  return section;
}

MSPSKEL_INLINE void center_arcs(ArcGraph& graph, const BoundingVolumeHierarchy& solid,
                                const CenteringOptions& options, const Execution& execution,
                                const CrossingLabels& crossings, const std::vector<Index>& held) {
  validate(options);
  std::vector<double> step(graph.arcs.size(), options.step);
  parallel_for(
      graph.arc_count(), "arcs", execution, [] { return 0; },
      [&](Index a, int) {
        if (graph.arcs[a].alive) step[a] = detail::own_step(graph.arcs[a], solid, options.step);
      },
      1);
  const auto resample = [&] {
    parallel_for(
        graph.arc_count(), "arcs", execution, [] { return 0; },
        [&](Index a, int) {
          if (Arc& arc = graph.arcs[a]; arc.alive)
            arc.points = detail::resampled_inside(arc, step[a], solid, crossings);
        },
        1);
  };
  resample();
  constexpr double kMostGrowth = 1.5, kSlack = 10;  // steps
  const double longest = kMostGrowth * detail::ArcPoints(graph).length() + kSlack * options.step;
  for (int round = 0; round < options.rounds; ++round) {
    if (round > 0) resample();
    detail::ArcPoints points(graph);
    std::vector<double> share(points.x.size(), 1.0);  // of the step
    for (std::size_t a = 0; a < step.size(); ++a)
      for (const Index i : points.chains[a]) share[i] = std::min(share[i], step[a] / options.step);
    const detail::ArcCourse course = detail::find_course(points, solid, options.tangent_smoothing, execution);
    const auto left_out = detail::left_out(points, round);
    std::vector<detail::Pull> pulls(points.x.size());
    parallel_for(
        points.count(), "arcs", execution, [] { return 0; },
        [&](Index i, int) {
          using Kind = detail::ArcPoints::Kind;
          pulls[i] = detail::even_pull(points.x[i], detail::kFreeWeight);
          if (points.kind[i] == Kind::kDead || points.kind[i] == Kind::kJoint || left_out[i]) return;
          if (!course.tangent[i].isZero())
            pulls[i] = detail::section_pull(solid, points.x[i], course.tangent[i], course.first_ray[i],
                                            share[i], options);
          if (points.kind[i] == Kind::kLeaf) pulls[i].weight = 0.5 * Eigen::Matrix3d::Identity();
        });
    for (Index i = 0; i < points.count(); ++i)
      if (left_out[i]) pulls[i] = detail::pull_between(points, pulls, i);
    parallel_for(
        static_cast<Index>(points.chains.size()), "arcs", execution, [] { return 0; },
        [&](Index c, int) {
          detail::loosen_near_joints(points, points.chains[c], course.clearance_of_hub, pulls);
          detail::stiffen_wavers(points, points.chains[c], course.thickness, pulls);
        });
    for (const Index hub : held)
      if (points.kind[hub] != detail::ArcPoints::Kind::kDead)
        pulls[hub] = detail::even_pull(points.x[hub], detail::kHeldWeight);
    const auto solution = detail::solve_positions(points, pulls, options.smoothness);
    std::vector<Vector3> goal(points.x);
    for (Index i = 0; i < points.count(); ++i)
      if (solution[i].allFinite()) goal[i] += options.damping * (solution[i] - points.x[i]);
    for (const Index hub : held) goal[hub] = points.x[hub];  // however well the system was solved
    detail::move_inside(points, solid, goal, crossings, execution);
    if (points.length() > longest) return;
    points.write_back(graph);
  }
}

}  // namespace mspskel
