#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "mspskel/base/linkage.h"
#include "mspskel/center/detail/descent.h"

namespace mspskel {
namespace detail::slice_centre {

// Where samples came to rest, before and after merging.
struct Minimum {
  Vector2 position = Vector2::Zero();
  double value = 0.0;  // what breaks ties: the potential, or the force's norm
  Index votes = 1;
  SkeletalPointStop stop = SkeletalPointStop::kConverged;
};

// Most votes, then the least value, then the first.
inline Index vote(const std::vector<Minimum>& minima) {
  Index best = kNone;
  for (Index i = 0; i < static_cast<Index>(minima.size()); ++i)
    if (best == kNone || minima[i].votes > minima[best].votes ||
        (minima[i].votes == minima[best].votes && minima[i].value < minima[best].value))
      best = i;
  return best;
}

// Merges points that are linked by gaps of at most `radius` without a contour between them; a cluster is
// represented by its member with the least value, which lies inside where a mean might not. The result does
// not depend on the order.
inline std::vector<Minimum> merge_minima(const PlanarRegion& region, const std::vector<Minimum>& points,
                                         double radius) {
  const auto count = static_cast<Index>(points.size());
  std::vector<Index> root(points.size(), kNone);
  std::vector<Index> stack;
  std::vector<Minimum> merged;
  for (Index seed = 0; seed < count; ++seed) {
    if (root[seed] != kNone) continue;
    root[seed] = seed;
    stack.push_back(seed);
    Minimum cluster = points[seed];
    cluster.votes = 0;
    while (!stack.empty()) {
      const Minimum& from = points[stack.back()];
      stack.pop_back();
      if (from.value < cluster.value)
        cluster.position = from.position, cluster.value = from.value, cluster.stop = from.stop;
      cluster.votes += from.votes;
      for (Index i = 0; i < count; ++i) {
        if (root[i] != kNone) continue;
        const Vector2 gap = points[i].position - from.position;
        if (gap.norm() > radius || region.first_hit(from.position, gap) <= 1) continue;
        root[i] = seed;
        stack.push_back(i);
      }
    }
    merged.push_back(cluster);
  }
  return merged;
}

// The point at a share of the inward chord of a contour sample, no deeper than max_depth; false where there
// is no inside.
inline bool inward_point(const PlanarRegion& region, const PlanarRegion::Sample& s, double share,
                         double max_depth, Vector2* result) {
  const double unit = region.perimeter(), skin = 1e-9;
  const Vector2 from = s.point + skin * unit * s.inward, reach = unit * s.inward;
  const double chord = std::min(region.first_hit(from, reach), 1.0) + skin;
  *result = s.point + std::min(share * chord * unit, max_depth) * s.inward;
  return region.contains(*result);
}

// The point farthest from the contour among the midpoints of inward chords: inside whenever any of them is.
inline SkeletalPoint deepest_sample(const PlanarRegion& region, Index count) {
  SkeletalPoint result;
  result.position = region.contour_centroid();
  double depth = -1;
  for (const PlanarRegion::Sample& s : region.sample(0, count)) {
    Vector2 p;
    if (!inward_point(region, s, 0.5, region.perimeter(), &p)) continue;
    const double d = region.distance(p);
    if (d <= depth) continue;
    depth = d;
    result.position = p;
    result.stop = SkeletalPointStop::kDeepestSample;
  }
  return result;
}

// Steps one and two of 4.2.2: force samples on every ring, at the spacing of the outer one's.
inline ForceSamples make_force_samples(const PlanarRegion& region, Index count) {
  std::vector<Vector2> samples;
  for (Index r = 0; r < static_cast<Index>(region.rings().size()); ++r) {
    const double share = region.rings()[r].perimeter / region.perimeter();
    const Index n = r == 0 ? count : std::max<Index>(3, static_cast<Index>(std::ceil(share * count)));
    for (const PlanarRegion::Sample& s : region.sample(r, n)) samples.push_back(s.point);
  }
  return samples;
}

// Step three of 4.2.2: along the force, until ‖F(i+1)‖ > ‖F(i)‖ for every step down to the smallest. A step
// is at most a share below 1 of the distance to the contour, so it cannot cross it.
inline Minimum trace_moving_sample(const PlanarRegion& region, const ForceSamples& force_samples, Vector2 p,
                                   const SkeletalPointOptions& options, Index* iterations) {
  constexpr double kSmallest = 1e-4;  // in perimeters
  // In forces of all samples put together at a distance of one perimeter: in a disc, 1e-3 perimeters off its
  // centre.
  constexpr double kVanished = 0.1;
  const double unit = region.perimeter();
  Vector2 force = sampled_repulsive_force(force_samples, p);
  double limit = unit;  // a halved step only doubles again
  Minimum rest{p, force.norm(), 1, SkeletalPointStop::kIterations};
  const double vanished = kVanished * force_samples.count / (unit * unit);
  for (Index i = 0; i < options.max_iterations; ++i) {
    double step = std::min(limit, options.step * region.distance(p));
    const double norm = force.norm();
    if (!(norm > 0) || !std::isfinite(norm)) break;
    Vector2 trial, trial_force;
    for (;; step *= 0.5) {
      trial = p + step / norm * force;
      trial_force = sampled_repulsive_force(force_samples, trial);
      if (trial_force.norm() <= norm || step < kSmallest * unit) break;
    }
    ++*iterations;
    limit = 2 * step;
    if (!(trial_force.norm() <= norm)) {
      rest.stop = norm < vanished ? SkeletalPointStop::kConverged : SkeletalPointStop::kShoulder;
      break;
    }
    p = trial;
    force = trial_force;
  }
  rest.position = p;
  rest.value = force.norm();
  return rest;
}

inline SkeletalPoint by_sampled_force(const PlanarRegion& region, const SkeletalPointOptions& options) {
  const ForceSamples force_samples = make_force_samples(region, options.force_samples);
  const double unit = region.perimeter();
  std::vector<Minimum> rests;
  SkeletalPoint result;
  for (const PlanarRegion::Sample& s : region.sample(0, options.moving_samples)) {
    Vector2 p;
    if (!inward_point(region, s, 0.5, options.displacement * unit, &p)) continue;
    ++result.samples;
    const Minimum rest = trace_moving_sample(region, force_samples, p, options, &result.iterations);
    // Between two force samples nothing keeps it off the contour, and once through it flies away.
    if (region.contains(rest.position)) rests.push_back(rest);
  }
  const std::vector<Minimum> minima = merge_minima(region, rests, options.merge_radius * unit);
  if (minima.empty()) return deepest_sample(region, options.moving_samples);
  const Minimum& winner = minima[vote(minima)];
  result.position = winner.position;
  result.votes = winner.votes;
  result.minima = static_cast<Index>(minima.size());
  result.stop = winner.stop;
  return result;
}

// Index i of n in an order in which every beginning is spread evenly: 0, then halves, quarters, ...
inline std::vector<Index> spread_order(Index n) {
  Index size = 1;
  while (size < n) size *= 2;
  std::vector<Index> order;
  for (Index i = 0; i < size; ++i) {
    Index reversed = 0;
    for (Index bit = 1, other = size / 2; other > 0; bit *= 2, other /= 2)
      if (i & bit) reversed += other;
    if (reversed < n) order.push_back(reversed);
  }
  return order;
}

// True if no way of casting the remaining votes changes the winner.
inline bool decided(const std::vector<Minimum>& minima, Index remaining) {
  const Index best = vote(minima);
  if (best == kNone) return false;
  Index second = 0;
  for (Index i = 0; i < static_cast<Index>(minima.size()); ++i)
    if (i != best) second = std::max(second, minima[i].votes);
  return minima[best].votes > second + remaining;
}

inline DescentRule rule_of(const SkeletalPointOptions& options) {
  return {options.tolerance, options.max_iterations, -std::numeric_limits<double>::infinity()};
}
inline Index none_near(const Vector2&) { return kNone; }

// Descends from the starts, a descent that comes within the merge radius of a minimum already found joins it,
// and ends as soon as the vote is decided.
inline std::vector<Minimum> find_minima(const PlanarRegion& region, const PlanarRegion& charged,
                                        const SkeletalPointOptions& options, SkeletalPoint* result) {
  const double unit = region.perimeter(), radius = options.merge_radius * unit;
  std::vector<Minimum> minima;
  const auto near = [&](const Vector2& p) {
    for (Index i = 0; i < static_cast<Index>(minima.size()); ++i) {
      const Vector2 gap = minima[i].position - p;
      if (gap.squaredNorm() <= radius * radius && region.first_hit(p, gap) > 1) return i;
    }
    return kNone;
  };
  const auto field = [&](const Vector2& p) { return repulsive_field(charged, p); };
  const std::vector<PlanarRegion::Sample> samples = region.sample(0, options.starts);
  Index remaining = static_cast<Index>(samples.size());
  for (const Index k : spread_order(remaining)) {
    if (decided(minima, remaining)) break;
    --remaining;
    Vector2 start;
    if (!inward_point(region, samples[k], options.start_depth, unit, &start)) continue;
    const Descent d = descend(region, field, start, rule_of(options), near);
    ++result->samples;
    result->iterations += d.iterations;
    const Index known = d.joined != kNone ? d.joined : near(d.position);
    const auto stop = d.converged ? SkeletalPointStop::kConverged : SkeletalPointStop::kIterations;
    if (known != kNone)
      ++minima[known].votes;
    else if (std::isfinite(d.potential))
      minima.push_back({d.position, d.potential, 1, stop});
  }
  return minima;
}

inline SkeletalPoint by_closed_form(const PlanarRegion& region, const SkeletalPointOptions& options) {
  SkeletalPoint result;
  bool screened = false;
  for (const PlanarRegion::Ring& ring : region.rings())
    screened = screened || (options.max_segments > 0 && ring.points > options.max_segments);
  const PlanarRegion coarse = screened ? region.resampled(options.max_segments) : PlanarRegion();
  const std::vector<Minimum> minima = find_minima(region, screened ? coarse : region, options, &result);
  if (minima.empty()) return deepest_sample(region, std::max<Index>(options.starts, 32));
  const Minimum& winner = minima[vote(minima)];
  result.position = winner.position;
  result.votes = winner.votes;
  result.minima = static_cast<Index>(minima.size());
  result.stop = winner.stop;
  if (screened) {
    const auto field = [&](const Vector2& p) { return repulsive_field(region, p); };
    const Descent d = descend(region, field, winner.position, rule_of(options), none_near);
    result.position = d.position;
    result.iterations += d.iterations;
    result.stop = d.converged ? SkeletalPointStop::kConverged : SkeletalPointStop::kIterations;
  }
  return result;
}

inline SkeletalPoint by_nearest_valley(const PlanarRegion& region, const SkeletalPointOptions& options) {
  constexpr double kFlat = 0.1;
  const auto field = [&](const Vector2& p) { return repulsive_field(region, p); };
  Vector2 start;
  if (!inward_point(region, region.sample(0, 1).front(), options.start_depth, region.perimeter(), &start))
    return by_closed_form(region, options);
  DescentRule rule = rule_of(options);
  rule.flat = kFlat;
  const Descent d = descend(region, field, start, rule, none_near);
  SkeletalPoint result;
  result.position = d.position;
  result.iterations = d.iterations;
  result.samples = result.votes = result.minima = 1;
  result.stop = d.converged ? SkeletalPointStop::kConverged : SkeletalPointStop::kIterations;
  return result;
}

// The fields of filled regions have no wall at the contour: where the region is bent or holed they may vanish
// at its edge or pull through it.
inline bool central(const PlanarRegion& region, const Vector2& p) {
  constexpr double kLeastDepth = 0.2;  // a disc's centre has 1, the middle of a long strip 0.5
  return region.distance(p) >= kLeastDepth * region.mean_width();
}

inline SkeletalPoint by_nearest_valley_instead(const PlanarRegion& region,
                                               const SkeletalPointOptions& options, Index iterations_before) {
  SkeletalPoint result = by_nearest_valley(region, options);
  result.iterations += iterations_before;
  if (result.stop == SkeletalPointStop::kConverged) result.stop = SkeletalPointStop::kNearestValleyInstead;
  return result;
}

inline SkeletalPoint by_area_field(const PlanarRegion& region, const SkeletalPointOptions& options) {
  const Vector2 start = region.centroid();
  if (!region.contains(start)) return by_nearest_valley_instead(region, options, 0);
  const auto field = [&](const Vector2& p) { return area_field(region, p); };
  const Descent d = descend(region, field, start, rule_of(options), none_near);
  if (!d.converged || !central(region, d.position))
    return by_nearest_valley_instead(region, options, d.iterations);
  SkeletalPoint result;
  result.position = d.position;
  result.iterations = d.iterations;
  result.samples = result.votes = result.minima = 1;
  result.stop = SkeletalPointStop::kConverged;
  return result;
}

// The fixed point x ← x + F / π, exact in one step for a disc. The field is no gradient where parts are
// hidden, so the step is halved whenever the force does not fall.
inline SkeletalPoint by_visible_field(const PlanarRegion& region, const SkeletalPointOptions& options) {
  SkeletalPoint result;
  result.position = region.centroid();
  if (!region.contains(result.position)) return by_nearest_valley_instead(region, options, 0);
  result.stop = SkeletalPointStop::kIterations;
  result.samples = result.votes = result.minima = 1;
  const double smallest = options.tolerance * region.mean_width();
  Vector2 force = visible_field(region, result.position, options.rays);
  double share = 1 / kPi;
  while (result.stop != SkeletalPointStop::kConverged && result.iterations < options.max_iterations) {
    const Vector2 step = shorten_to_contour(region, result.position, share * force);
    ++result.iterations;
    if (step.norm() < smallest && !(force.norm() * (1 / kPi) < 10 * smallest)) break;
    if (step.norm() < smallest) result.stop = SkeletalPointStop::kConverged;
    const Vector2 trial_force = visible_field(region, result.position + step, options.rays);
    if (trial_force.norm() < force.norm()) {
      result.position += step;
      force = trial_force;
    } else {
      share *= 0.5;
    }
  }
  const bool good = result.stop == SkeletalPointStop::kConverged && central(region, result.position);
  return good ? result : by_nearest_valley_instead(region, options, result.iterations);
}

inline void require(bool good, const char* option, const char* range) {
  if (!good) throw UsageError(std::string("skeletal point: ") + option + " has to be " + range);
}

}  // namespace detail::slice_centre

MSPSKEL_INLINE void validate(const SkeletalPointOptions& o) {
  const auto count = [](Index x, Index low, Index high) { return x >= low && x <= high; };
  detail::slice_centre::require(count(o.moving_samples, 1, 10000), "moving_samples", "1 to 10000");
  detail::slice_centre::require(count(o.force_samples, 3, 100000), "force_samples", "3 to 100000");
  detail::slice_centre::require(o.displacement > 0 && o.displacement <= 0.1, "displacement",
                                "above 0 and at most 0.1");
  detail::slice_centre::require(o.step > 0 && o.step <= 0.9, "step", "above 0 and at most 0.9");
  detail::slice_centre::require(o.merge_radius >= 0 && o.merge_radius <= 1, "merge_radius", "0 to 1");
  detail::slice_centre::require(count(o.starts, 1, 10000), "starts", "1 to 10000");
  detail::slice_centre::require(o.start_depth > 0 && o.start_depth <= 0.9, "start_depth",
                                "above 0 and at most 0.9");
  detail::slice_centre::require(o.max_segments == 0 || count(o.max_segments, 8, 1000000), "max_segments",
                                "0, or 8 to 1000000");
  detail::slice_centre::require(count(o.rays, 8, 100000), "rays", "8 to 100000");
  detail::slice_centre::require(o.tolerance >= 1e-12 && o.tolerance <= 0.1, "tolerance", "1e-12 to 0.1");
  detail::slice_centre::require(count(o.max_iterations, 1, 100000), "max_iterations", "1 to 100000");
}

MSPSKEL_INLINE SkeletalPoint find_skeletal_point(const PlanarRegion& region,
                                                 const SkeletalPointOptions& options) {
  validate(options);
  if (options.method == SkeletalPointMethod::kCentre || !region.valid()) {
    SkeletalPoint result;
    result.position = region.contour_centroid();
    if (options.method == SkeletalPointMethod::kCentre && !region.rings().empty())
      result.stop = SkeletalPointStop::kConverged;
    return result;
  }
  switch (options.method) {
    case SkeletalPointMethod::kSampledForce:
      return detail::slice_centre::by_sampled_force(region, options);
    case SkeletalPointMethod::kAreaField:
      return detail::slice_centre::by_area_field(region, options);
    case SkeletalPointMethod::kVisibleField:
      return detail::slice_centre::by_visible_field(region, options);
    case SkeletalPointMethod::kNearestValley:
      return detail::slice_centre::by_nearest_valley(region, options);
    default:
      return detail::slice_centre::by_closed_form(region, options);
  }
}

}  // namespace mspskel
