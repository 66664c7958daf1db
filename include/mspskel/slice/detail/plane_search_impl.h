#pragma once

#include <algorithm>

#include "mspskel/base/linkage.h"

namespace mspskel::detail {

// Planes closer than 4 degrees are left to the compass.
inline constexpr double kSamePlane = 0.9976;
// A neighbour's plane is tried unless its slice there is longer than the best here by more than this factor.
inline constexpr double kOfferSlack = 1.02;
// A gain of less than 0.2 % is not worth the planes that every change makes the neighbours try.
inline constexpr double kLeastGain = 0.998;

struct PlaneOffer {
  double objective;
  Vector3 normal;
};

// What one vertex finds in a round: no start half-edge where it has no better plane than before.
struct RoundResult {
  BestSlice slice;
  double objective = std::numeric_limits<double>::infinity();
};

// A vertex whose area no neighbour exceeds.
inline bool is_seed(const SurfaceSnapshot& surface, Index v) {
  bool seed = surface.vertex_halfedge[v] != kNone;
  const double most = (1 + 1e-9) * surface.vertex_area[v];  // on regular meshes equals differ by rounding
  for_each_neighbour(surface, v, [&](Index w) { seed = seed && surface.vertex_area[w] <= most; });
  return seed;
}

// Planes in every vertex's own frame, spread evenly over the band of the sphere that the tilt allows.
struct SpreadPlane {
  double cosine, sine;   // of the angle round the vertex normal
  double across, along;  // components of the plane's normal across and along the vertex normal
};

inline std::vector<SpreadPlane> spread_planes(const SearchOptions& options) {
  constexpr double kGolden = 0.6180339887498949;
  const double max_sine = std::sin(options.max_tilt * kPi / 180);
  std::vector<SpreadPlane> planes;
  for (int i = 0; i < options.spread; ++i) {
    const double sine = max_sine * (i + 0.5) / options.spread, angle = 2 * kPi * kGolden * (i + 0.5);
    planes.push_back({std::cos(angle), std::sin(angle), std::sqrt(1 - sine * sine), sine});
  }
  return planes;
}

// What the vertices know after a round. best[v] holds v's slice and the work so far.
struct SearchState {
  std::vector<BestSlice> best;
  std::vector<double> objective;
  std::vector<int> changed_in;  // the last round that gave v another plane
  std::vector<std::uint8_t> visited;
  std::vector<Index> active;  // the vertices of the next round, ascending
  Index unvisited = 0;

  // Seeds are active in round 0.
  explicit SearchState(const SurfaceSnapshot& surface)
      : best(surface.vertex_count()),
        objective(surface.vertex_count(), std::numeric_limits<double>::infinity()),
        changed_in(surface.vertex_count(), -2),
        visited(surface.vertex_count(), 0),
        called_(surface.vertex_count(), 0) {
    for (Index v = 0; v < surface.vertex_count(); ++v) {
      if (is_seed(surface, v)) active.push_back(v);
      unvisited += surface.vertex_halfedge[v] != kNone;
    }
  }

  bool has_slice(Index v) const { return best[v].shortest.start != kNone; }

  // Takes over what the round found at the active vertices. The neighbours of those that have changed or have
  // been visited for the first time are the next ones.
  void advance(const SurfaceSnapshot& surface, const std::vector<RoundResult>& found, int round) {
    std::vector<Index> next;
    for (std::size_t i = 0; i < active.size(); ++i) {
      const Index v = active[i];
      const RoundResult& result = found[i];
      best[v].slices += result.slice.slices;
      best[v].steps += result.slice.steps;
      const bool better = result.slice.shortest.start != kNone;
      if (better) {
        best[v].shortest = result.slice.shortest;
        best[v].normal = result.slice.normal;
        objective[v] = result.objective;
        changed_in[v] = round;
      }
      const bool first_visit = !visited[v];
      if (first_visit) visited[v] = 1, --unvisited;
      for_each_neighbour(surface, v, [&](Index w) {
        if (called_[w] || !(better || (first_visit && !visited[w]))) return;
        called_[w] = 1;
        next.push_back(w);
      });
    }
    for (const Index v : next) called_[v] = 0;
    std::sort(next.begin(), next.end());
    active.swap(next);
  }

 private:
  std::vector<std::uint8_t> called_;
};

// The search at one vertex. A plane is its unit normal m; its tilt is asin|m·n_p|.
class PlaneSearch {
 public:
  PlaneSearch(const SliceTracer& tracer, const SearchOptions& options, Index v, const Vector3& normal,
              double objective)
      : tracer_(tracer),
        options_(options),
        v_(v),
        axis_(tracer.surface().normal[v]),
        max_sine_(std::sin(options.max_tilt * kPi / 180)),
        objective_(objective) {
    best_.normal = normal;
  }

  // The slice found and the work spent; no start half-edge unless some plane was better.
  const BestSlice& best() const { return best_; }
  double objective() const { return objective_; }

  bool knows(const Vector3& m) const { return std::abs(m.dot(best_.normal)) > kSamePlane; }

  // True if the plane is allowed and better than the best so far.
  bool try_plane(const Vector3& m) {
    const double sine = std::abs(m.dot(axis_));
    if (sine > max_sine_ + 1e-12) return false;
    const double cosine = tilt_factor(options_.objective, sine);
    ++best_.slices;
    const auto found = tracer_.shortest_through(v_, m, kLeastGain * objective_ * cosine, best_.steps);
    if (found.start == kNone) return false;
    best_.shortest = found;
    best_.normal = m;
    objective_ = found.perimeter / cosine;
    return true;
  }

  void try_angles() {
    const VertexFrame frame = make_vertex_frame(tracer_.surface(), v_);
    for (int i = 0; i < options_.angles; ++i)
      try_plane(plane_normal(frame.u, frame.v, kPi * i / options_.angles));
  }

  // The zero direction differs from vertex to vertex, so together neighbours look at many more planes than
  // one of them.
  void try_spread(const std::vector<SpreadPlane>& planes) {
    const VertexFrame frame = make_vertex_frame(tracer_.surface(), v_);
    for (const SpreadPlane& plane : planes) {
      const Vector3 m = plane.across * (plane.cosine * frame.u + plane.sine * frame.v) + plane.along * axis_;
      if (!knows(m)) try_plane(m);
    }
  }

  // Turns and tilts the plane by a step as long as that helps, then by half of it, down to the least step.
  void compass(double step_degrees) {
    if (best_.shortest.start == kNone) return;
    const double least = options_.last_step * kPi / 180;
    int helped = -1;
    for (double step = step_degrees * kPi / 180; step >= least * (1 - 1e-9);) {
      const Vector3 m = best_.normal;
      const Vector3 turn = axis_.cross(m).normalized(), tilt = m.cross(turn).normalized();
      const Vector3 moves[4] = {turn, -turn, tilt, -tilt};
      const double cosine = std::cos(step), sine = std::sin(step);
      const int last = helped;
      helped = -1;
      for (int i = 0; i < 4 && helped < 0; ++i) {
        const int k = last < 0 ? i : (last + i) % 4;  // go on in the direction that helped
        if (last >= 0 && k == (last ^ 1)) continue;   // never straight back
        if (try_plane(cosine * m + sine * moves[k])) helped = k;
      }
      if (helped < 0) step /= 2;
    }
  }

  // cos(tilt), or 1 where the tilt does not count.
  static double tilt_factor(SliceObjective objective, double sine) {
    return objective == SliceObjective::kPerimeter ? 1.0 : std::sqrt(1 - sine * sine);
  }

 private:
  const SliceTracer& tracer_;
  const SearchOptions& options_;
  Index v_;
  Vector3 axis_;  // the vertex normal
  double max_sine_;
  BestSlice best_;
  double objective_;
};

// Planes of v's neighbours that v has not seen and that promise a gain, the most promising first.
inline void collect_offers(const SurfaceSnapshot& surface, const SearchState& state, int round, Index v,
                           std::vector<PlaneOffer>& offers) {
  offers.clear();
  const bool settled = state.visited[v] && state.changed_in[v] < round - 1;
  for_each_neighbour(surface, v, [&](Index w) {
    if (!state.has_slice(w) || (settled && state.changed_in[w] < round - 1)) return;
    offers.push_back({state.objective[w], state.best[w].normal});
  });
  std::sort(offers.begin(), offers.end(),
            [](const PlaneOffer& a, const PlaneOffer& b) { return a.objective < b.objective; });
}

// The offers to v, each plane once.
inline void try_offers(const std::vector<PlaneOffer>& offers, PlaneSearch& search) {
  for (auto offer = offers.begin(); offer != offers.end(); ++offer) {
    if (offer->objective > kOfferSlack * search.objective()) return;
    const bool repeated = std::any_of(offers.begin(), offer, [&](const PlaneOffer& other) {
      return std::abs(other.normal.dot(offer->normal)) > kSamePlane;
    });
    if (!repeated && !search.knows(offer->normal)) search.try_plane(offer->normal);
  }
}

// One round of one vertex. A seed starts in round 0, any other vertex once a neighbour has been visited.
inline RoundResult search_round(const SliceTracer& tracer, const SearchOptions& options,
                                const std::vector<SpreadPlane>& spread, const SearchState& state, int round,
                                Index v, std::vector<PlaneOffer>& offers) {
  const bool first_visit = !state.visited[v];
  PlaneSearch search(tracer, options, v, state.best[v].normal, state.objective[v]);
  collect_offers(tracer.surface(), state, round, v, offers);
  try_offers(offers, search);
  if (round == 0) search.try_angles();
  if (first_visit) search.try_spread(spread);
  search.compass(round == 0 ? options.first_step : options.last_step);
  return {search.best(), search.objective()};
}

}  // namespace mspskel::detail

namespace mspskel {

MSPSKEL_INLINE VertexSlices search_minimum_slice_perimeters(const SliceTracer& tracer,
                                                            const SearchOptions& options,
                                                            const Execution& execution) {
  validate(options);
  const SurfaceSnapshot& surface = tracer.surface();
  const Index count = surface.vertex_count();
  const std::vector<detail::SpreadPlane> spread = detail::spread_planes(options);
  detail::SearchState state(surface);
  std::vector<detail::RoundResult> found;
  for (int round = 0, settling = 0; !state.active.empty(); ++round) {
    if (state.unvisited == 0 && settling++ >= options.rounds) break;
    const auto active = static_cast<Index>(state.active.size());
    found.resize(state.active.size());
    parallel_for(
        active, "slice search", execution, [] { return std::vector<detail::PlaneOffer>(); },
        [&](Index i, std::vector<detail::PlaneOffer>& offers) {
          found[i] = detail::search_round(tracer, options, spread, state, round, state.active[i], offers);
        });
    state.advance(surface, found, round);
  }
  VertexSlices slices;
  slices.resize(count);
  for (Index v = 0; v < count; ++v) detail::store_slice(v, state.best[v], slices);
  for (const detail::BestSlice& best : state.best) {
    slices.slices += best.slices;
    slices.steps += best.steps;
  }
  return slices;
}

}  // namespace mspskel
