// Options of the whole pipeline, drawn from the ranges that docs/command_line.md gives, where a run stays
// short.
#pragma once

#include <cstdio>
#include <string>

#include "fuzz/choices.h"
#include "mspskel/extract_skeleton.h"

namespace mspskel::fuzz {

// Draws values for the options that one_in picks, and notes them.
class OptionDraw {
 public:
  OptionDraw(Choices& choices, std::string& said) : choices_(choices), said_(said) {}

  template <class Value>
  void pick(const char* name, Value& value, std::initializer_list<Value> values) {
    if (!choices_.one_in(4)) return;
    value = choices_.of(values);
    note(name, static_cast<double>(value));
  }
  // One of both ends of the range, or a value between.
  template <class Value>
  void range(const char* name, Value& value, double low, double high) {
    if (!choices_.one_in(4)) return;
    const Index where = choices_.below(6);
    const double between =
        low > 0 && high / low > 50 ? choices_.magnitude(low, high) : choices_.uniform(low, high);
    value = static_cast<Value>(where == 0 ? low : where == 1 ? high : between);
    note(name, static_cast<double>(value));
  }

 private:
  void note(const char* name, double value) {
    char text[80];
    std::snprintf(text, sizeof text, " %s %.17g", name, value);
    said_ += text;
  }

  Choices& choices_;
  std::string& said_;
};

inline void draw_slices(OptionDraw& draw, ExtractOptions& o) {
  draw.pick("--coarsen", o.coarsen, {true, false});
  draw.range("--coarse-vertices", o.coarsening.vertices, 4, 1600);
  draw.range("--limb-vertices", o.limb_vertices, 4, 4000);
  if (o.mode == Mode::kDefault) draw.pick("--slice-method", o.slices, {SliceMethod::kSampling});
  draw.range("--slices", o.search.angles, 1, 12);
  draw.range("--sampling-planes", o.sampling.planes, 1, 6);
  draw.range("--search-spread", o.search.spread, 0, 12);
  draw.range("--search-rounds", o.search.rounds, 0, 20);
  draw.range("--search-tilt", o.search.max_tilt, 0, 89);
  draw.pick("--cone", o.cone.enabled, {true, false});
  draw.range("--cone-threshold", o.cone.threshold, 0, 1);
  draw.range("--cone-directions", o.cone.directions, 1, 8);
  draw.range("--cone-min-angle", o.cone.min_angle, 0, 25);
  draw.range("--cone-max-angle", o.cone.max_angle, 25, 89);
  draw.pick("--error-average", o.error.average,
            {SliceErrorAverage::kMean, SliceErrorAverage::kSum, SliceErrorAverage::kArcMean});
  draw.pick("--error-scale", o.error.scale, {SliceErrorScale::kMinMax, SliceErrorScale::kRightAngle});
}

inline void draw_points(OptionDraw& draw, ExtractOptions& o) {
  SkeletalPointOptions& point = o.points.point;
  draw.pick(
      "--point", point.method,
      {SkeletalPointMethod::kCentre, SkeletalPointMethod::kSampledForce, SkeletalPointMethod::kClosedForm,
       SkeletalPointMethod::kAreaField, SkeletalPointMethod::kVisibleField});
  draw.pick("--holes", o.points.holes, {HoleSearch::kIgnore, HoleSearch::kProbe, HoleSearch::kAll});
  draw.range("--moving-samples", point.moving_samples, 1, 8);
  draw.range("--force-samples", point.force_samples, 3, 64);
  draw.range("--displacement", point.displacement, 1e-9, 0.1);
  draw.range("--force-step", point.step, 0.1, 0.9);
  draw.range("--merge-radius", point.merge_radius, 0, 1);
  draw.range("--starts", point.starts, 1, 8);
  draw.pick("--coherence", o.coherence.enabled, {true, false});
  draw.range("--coherence-strength", o.coherence.strength, 0, 10);
}

inline void draw_collapse(OptionDraw& draw, ExtractOptions& o) {
  draw.range("--lambda", o.collapse.lambda, 0, 10);
  draw.range("--saturation", o.collapse.saturation_threshold, 0, 2);
  draw.pick("--bare-edges", o.collapse.one_dimensional, {EdgePolicy::kSaturation, EdgePolicy::kKeep});
  draw.range("--angle-floor", o.collapse.angle_floor, 0, 1.57);
  draw.pick("--order", o.collapse.order, {CollapseOrder::kCost, CollapseOrder::kShortestFirst});
  draw.pick("--filter", o.filter_branches, {true, false});
  draw.range("--filter-ball", o.filter.ball_scale, 0, 100);
}

inline void draw_arcs(OptionDraw& draw, ExtractOptions& o) {
  RefinementOptions& r = o.refinement;
  draw.pick("--refine", r.enabled, {true, false});
  draw.range("--step", r.centering.step, 0.004, 0.25);
  r.extension.step = r.centering.step;
  draw.range("--nodes", r.nodes, 1, 100);
  draw.range("--slenderness", r.limbs.slenderness, 0.0125, 100);
  draw.range("--smallest", r.limbs.smallest, 0, 1);
  draw.range("--centring-rounds", r.centering.rounds, 0, 10);
  draw.range("--smoothness", r.centering.smoothness, 0.1, 1e6);
  draw.range("--tip-clearance", r.extension.tip_clearance, 0.05, 2);
  draw.range("--joint-overlap", r.joint_overlap, 0, 10);
}

// Half of the inputs run with the defaults of their mode, which is what users do.
inline ExtractOptions fuzzed_options(Choices& choices, std::string& said) {
  const bool thesis = choices.one_in(3);
  ExtractOptions options = thesis ? thesis_options() : default_options();
  said += thesis ? "; --mode thesis" : ";";
  if (thesis) options.sampling.planes = 6, options.cone.directions = 5;  // 25 and 15 take too long
  if (choices.one_in(2)) return options;
  OptionDraw draw(choices, said);
  draw_slices(draw, options);
  draw_points(draw, options);
  draw_collapse(draw, options);
  draw_arcs(draw, options);
  return options;
}

}  // namespace mspskel::fuzz
