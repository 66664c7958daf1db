// Search for the minimum slice instead of sampling: coarse angles, then the planes that won at neighbouring
// vertices, then a compass search over angle and tilt. A fraction of the work of cone refinement for slices
// that are as short.
#pragma once

#include "mspskel/slice/minimum_slice_perimeter.h"

namespace mspskel {

enum class SliceObjective {
  kPerimeter,  // the raw perimeter: comparable with sampling, but a tilt shortens slices of round parts
  kPerimeterOverTilt,  // perimeter / cos(tilt): all slices through a point of a sphere tie, so tilt is not
                       // rewarded
};

struct SearchOptions {
  SliceObjective objective = SliceObjective::kPerimeterOverTilt;
  int angles = 6;            // planes through the normal tried first, 1 to 1000
  int rounds = 4;            // times that a vertex looks at its neighbours' planes, 0 to 100
  double max_tilt = 55.0;    // largest angle between the plane and the vertex normal, degrees; 0 to below 90
  double first_step = 15.0;  // compass step of the first round, degrees; above 0
  double last_step = 4.0;    // the compass stops below this step, degrees; above 0
};

inline void validate(const SearchOptions& o) {
  if (o.angles < 1 || o.angles > 1000) throw UsageError("search angles must be from 1 to 1000");
  if (o.rounds < 0 || o.rounds > 100) throw UsageError("search rounds must be from 0 to 100");
  if (!(o.max_tilt >= 0 && o.max_tilt < 90))
    throw UsageError("search tilt must be from 0 to below 90 degrees");
  if (!(o.first_step > 0 && o.last_step > 0)) throw UsageError("search steps must be above 0 degrees");
}

namespace detail {

// The search at one vertex. A plane is its unit normal m; its tilt is asin|m·n_p|.
class PlaneSearch {
 public:
  PlaneSearch(const SliceTracer& tracer, const SearchOptions& options, Index v)
      : tracer_(tracer),
        options_(options),
        v_(v),
        frame_(make_vertex_frame(tracer.surface(), v)),
        max_sine_(std::sin(options.max_tilt * kPi / 180)) {}

  BestSlice best;
  double objective = std::numeric_limits<double>::infinity();

  void start_from(const Vector3& normal, double value) {
    best.normal = normal;
    objective = value;
  }

  // True if the plane is allowed and better than the best so far.
  bool try_plane(const Vector3& m) {
    const double sine = std::abs(m.dot(frame_.normal));
    if (sine > max_sine_ + 1e-12) return false;
    const double cosine = options_.objective == SliceObjective::kPerimeter ? 1.0 : std::sqrt(1 - sine * sine);
    ++best.slices;
    const auto found = tracer_.shortest_through(v_, m, objective * cosine, best.steps);
    if (found.start == kNone) return false;
    best.shortest = found;
    best.normal = m;
    objective = found.perimeter / cosine;
    return true;
  }

  void coarse_angles() {
    for (int i = 0; i < options_.angles; ++i)
      try_plane(plane_normal(frame_.u, frame_.v, kPi * i / options_.angles));
  }

  // Turns about the vertex normal and tilts towards it by ± step; halves the step when nothing helps.
  void compass(double step_degrees) {
    if (best.normal.isZero()) return;
    int helped = -1;
    for (double step = step_degrees * kPi / 180; step >= options_.last_step * kPi / 180;) {
      const Vector3 m = best.normal;
      const Vector3 turn = frame_.normal.cross(m).normalized(), tilt = m.cross(turn).normalized();
      const Vector3 moves[4] = {turn, -turn, tilt, -tilt};
      const int last = helped;
      helped = -1;
      for (int i = 0; i < 4 && helped < 0; ++i) {
        const int k = last < 0 ? i : (last + i) % 4;  // go on in the direction that helped
        if (last >= 0 && k == (last ^ 1)) continue;   // never straight back
        if (try_plane(std::cos(step) * m + std::sin(step) * moves[k])) helped = k;
      }
      if (helped < 0) step /= 2;
    }
  }

 private:
  const SliceTracer& tracer_;
  const SearchOptions& options_;
  Index v_;
  VertexFrame frame_;
  double max_sine_;
};

inline constexpr double kSamePlane = 0.9994;  // cosine of 2 degrees: closer planes are left to the compass

// The normals that won round v, without repetitions.
inline void neighbour_planes(const SurfaceSnapshot& surface, const VertexSlices& slices,
                             const std::vector<double>& objective, Index v, std::vector<Vector3>& planes) {
  planes.clear();
  const Index first = surface.vertex_halfedge[v];
  Index h = first;
  do {
    const Index w = surface.target(h);
    h = surface.next_outgoing(h);
    if (!slices.valid[w] || objective[w] > 1.2 * objective[v]) continue;
    const Vector3& m = slices.normal[w];
    if (slices.valid[v] && std::abs(m.dot(slices.normal[v])) > kSamePlane) continue;
    if (std::none_of(planes.begin(), planes.end(),
                     [&](const Vector3& o) { return std::abs(m.dot(o)) > kSamePlane; }))
      planes.push_back(m);
  } while (h != first);
}

}  // namespace detail

// MSP slices by search. Each round reads only the round before, so the result depends neither on threads nor
// on the order of vertices. Cost: about 30 slices a vertex. Errors are left at 1. Throws UsageError,
// Cancelled.
inline VertexSlices search_minimum_slice_perimeters(const SliceTracer& tracer, const SearchOptions& options,
                                                    const Execution& execution = {}) {
  validate(options);
  const SurfaceSnapshot& surface = tracer.surface();
  const Index count = surface.vertex_count();
  VertexSlices slices;
  slices.resize(count);
  std::vector<double> objective(count, std::numeric_limits<double>::infinity());
  std::vector<detail::BestSlice> found(count);
  std::vector<double> value = objective;
  struct Scratch {
    std::vector<Vector3> planes;
    Contour contour;
  };
  std::vector<std::array<std::int64_t, 2>> work(count, {0, 0});
  for (int round = 0; round <= options.rounds; ++round) {
    parallel_for(
        count, "slice search", execution, [] { return Scratch(); },
        [&](Index v, Scratch& scratch) {
          found[v] = {};
          if (surface.vertex_halfedge[v] == kNone) return;
          detail::PlaneSearch search(tracer, options, v);
          if (round == 0) {
            search.coarse_angles();
            search.compass(options.first_step);
          } else {
            search.start_from(slices.normal[v], objective[v]);
            detail::neighbour_planes(surface, slices, objective, v, scratch.planes);
            bool better = false;
            for (const Vector3& m : scratch.planes) better = search.try_plane(m) || better;
            if (better) search.compass(options.first_step / 2);
          }
          found[v] = search.best;
          value[v] = search.objective;
        });
    for (Index v = 0; v < count; ++v) {
      work[v][0] += found[v].slices;
      work[v][1] += found[v].steps;
      if (found[v].shortest.start == kNone) continue;
      slices.valid[v] = 1;
      slices.normal[v] = found[v].normal;
      slices.perimeter[v] = found[v].shortest.perimeter;
      objective[v] = value[v];
    }
  }
  parallel_for(
      count, "slice search", execution, [] { return Scratch(); },
      [&](Index v, Scratch& scratch) {
        if (!slices.valid[v] || !tracer.shortest_contour(v, slices.normal[v], scratch.contour, work[v][1]))
          return;
        slices.centre[v] = detail::contour_centre(scratch.contour);
        slices.contour_points[v] = static_cast<Index>(scratch.contour.point.size());
      });
  for (const auto& [planes, steps] : work) {
    slices.slices += planes;
    slices.steps += steps;
  }
  return slices;
}

}  // namespace mspskel
