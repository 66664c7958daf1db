#include "run_options.h"

#include <limits>

namespace mspskel::cli {
namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

// The mode decides what the other options' defaults are, so it is looked for first; whether the word is a
// mode at all is the parser's affair.
std::string wanted_mode(const std::vector<std::string>& arguments) {
  std::string mode;
  for (std::size_t i = 0; i < arguments.size() && arguments[i] != "--"; ++i) {
    if (arguments[i] == "--mode" && i + 1 < arguments.size()) mode = arguments[i + 1];
    if (arguments[i].rfind("--mode=", 0) == 0) mode = arguments[i].substr(7);
  }
  return mode;
}

void add_slice_options(CommandLine& line, ExtractOptions& options, int& planes) {
  line.group("Slices");
  line.toggle(
      "coarsen", options.coarsen,
      "work on a coarser surface where the mesh is finer than needed, and cut long edges where it is sparse");
  line.number("--coarse-vertices", options.coarsening.vertices, {4, 1e9},
              "what a finer mesh is coarsened to, or to more where its limbs are thin; arcs are still "
              "centred in the mesh itself");
  line.number("--limb-vertices", options.limb_vertices, {4, 1e9},
              "vertices of the surface on which limbs are told, where the mesh is finer");
  line.choice<SliceMethod>("--slice-method", options.slices,
                           {{"search", SliceMethod::kSearch}, {"sampling", SliceMethod::kSampling}},
                           "search: local search from a few planes; sampling: all planes, then cones");
  line.number("--slices", planes, {1, 1000},
              "planes tried at a vertex; where search begins, or all of sampling");
  line.number("--search-spread", options.search.spread, {0, 1000},
              "search: planes over all angles and tilts tried at a vertex");
  line.number("--search-rounds", options.search.rounds, {0, 1000},
              "search: most rounds in which vertices look at their neighbours' planes");
  line.number("--search-tilt", options.search.max_tilt, {0, 89},
              "search: largest angle between plane and vertex normal, degrees");
  line.toggle("cone", options.cone.enabled, "sampling: try more planes where the slice error is high");
  line.number("--cone-threshold", options.cone.threshold, {0, 1},
              "sampling: slice error above which a vertex is refined");
  line.number("--cone-directions", options.cone.directions, {1, 1000}, "sampling: directions in the cone");
  line.number("--cone-min-angle", options.cone.min_angle, {0, 89},
              "sampling: half angle of the cone at the threshold, degrees, and not above that at error 1");
  line.number("--cone-max-angle", options.cone.max_angle, {0, 89},
              "sampling: half angle of the cone at error 1, degrees");
  line.choice<SliceErrorAverage>(
      "--error-average", options.error.average,
      {{"mean", SliceErrorAverage::kMean},
       {"sum", SliceErrorAverage::kSum},
       {"arc", SliceErrorAverage::kArcMean}},
      "of the angles along a slice: over its points, their sum, or over its length");
  line.choice<SliceErrorScale>(
      "--error-scale", options.error.scale,
      {{"minmax", SliceErrorScale::kMinMax}, {"right-angle", SliceErrorScale::kRightAngle}},
      "what becomes 0 and 1: the mesh's least and largest, or no angle and a right angle");
}

void add_point_options(CommandLine& line, ExtractOptions& options) {
  SkeletalPointOptions& point = options.points.point;
  line.group("Skeletal points");
  line.choice<SkeletalPointMethod>("--point", point.method,
                                   {{"centre", SkeletalPointMethod::kCentre},
                                    {"sampled-force", SkeletalPointMethod::kSampledForce},
                                    {"force", SkeletalPointMethod::kClosedForm},
                                    {"area-field", SkeletalPointMethod::kAreaField},
                                    {"visible-field", SkeletalPointMethod::kVisibleField}},
                                   "where in its slice a skeletal point lies");
  line.choice<HoleSearch>(
      "--holes", options.points.holes,
      {{"ignore", HoleSearch::kIgnore}, {"probe", HoleSearch::kProbe}, {"all", HoleSearch::kAll}},
      "whether holes in a slice repel: no, those in sight, all");
  line.number("--moving-samples", point.moving_samples, {1, 10000},
              "sampled force: samples that seek a minimum");
  line.number("--force-samples", point.force_samples, {3, 100000}, "sampled force: samples of the contour");
  line.number("--displacement", point.displacement, {1e-9, 0.1},
              "sampled force: first distance from the contour, in perimeters");
  line.number("--force-step", point.step, {1e-6, 0.9}, "sampled force: a step, in distances to the contour");
  line.number("--merge-radius", point.merge_radius, {0, 1}, "minima closer than this are one, in perimeters");
  line.number("--starts", point.starts, {1, 10000}, "force: descents");
  line.toggle("coherence", options.coherence.enabled,
              "move doubtful skeletal points toward their neighbours");
  line.number("--coherence-strength", options.coherence.strength, {0, 10},
              "weight of the neighbours against a certain point's own");
}

void add_collapse_options(CommandLine& line, ExtractOptions& options) {
  CollapseOptions& collapse = options.collapse;
  line.group("Collapse");
  line.number("--lambda", collapse.lambda, {0, kUnlimited}, "weight of the slice error in an edge's cost");
  line.number("--saturation", collapse.saturation_threshold, {0, kUnlimited},
              "an edge without faces collapses below this saturation");
  line.choice<EdgePolicy>("--bare-edges", collapse.one_dimensional,
                          {{"saturation", EdgePolicy::kSaturation}, {"keep", EdgePolicy::kKeep}},
                          "what becomes of edges without faces");
  line.number("--angle-floor", collapse.angle_floor, {0, 1.57},
              "least angle between slices in the cost, radians");
  line.choice<CollapseOrder>("--order", collapse.order,
                             {{"cost", CollapseOrder::kCost}, {"length", CollapseOrder::kShortestFirst}},
                             "of the edges that collapse");
  line.toggle("keep-topology", collapse.keep_topology,
              "refuse what would lose or make a handle; without it, the thesis's literal behaviour");
  line.number("--smallest-handle", options.cocycles.smallest_handle, {0, 1},
              "handles round which a shorter loop runs get no cycle; share of the extent, 0: none");
  line.toggle("filter", options.filter_branches,
              "drop branches that do not leave their joint's ball, merge joints (thesis 6.1)");
  line.number("--filter-ball", options.filter.ball_scale, {0, 100}, "filter: the ball, in radii MSP / 2 pi");
}

void add_arc_options(CommandLine& line, ExtractOptions& options, double& step, double& detail) {
  RefinementOptions& refinement = options.refinement;
  line.group("Arcs; lengths are shares of the model's extent");
  line.toggle("refine", refinement.enabled, "lead arcs inside, prune, centre and extend them");
  line.number("--step", step, {0.0005, 0.5}, "distance of the nodes along an arc");
  line.number("--nodes", refinement.nodes, {0, 1e9}, "at most so many nodes; 0: as many as the step gives");
  line.number("--detail", detail, {0.01, 100},
              "2 keeps limbs half as slender as 1 does, 0.5 only those twice as slender");
  line.number("--smallest", refinement.limbs.smallest, {0, 1}, "features below this size are noise");
  line.number("--centring-rounds", refinement.centering.rounds, {0, 100}, "of sections and solves");
  line.number("--smoothness", refinement.centering.smoothness, {0.1, 1e6}, "weight of straight arcs");
  line.number("--tip-clearance", refinement.extension.tip_clearance, {0.05, 2},
              "where arcs end before a tip, in radii of the limb's end");
  line.number("--joint-overlap", refinement.joint_overlap, {0, 10},
              "joints closer than this are one, in radii of the smaller ball");
}

}  // namespace

RunOptionTable::RunOptionTable(const std::vector<std::string>& arguments, RunOptions& target)
    : target_(target) {
  ExtractOptions& options = target.extract;
  options = wanted_mode(arguments) == "thesis" ? thesis_options() : default_options();
  seed_ = options.cone.seed;
  planes_ = options.slices == SliceMethod::kSearch ? options.search.angles : options.sampling.planes;
  usual_step_ = step_ = options.refinement.centering.step;
}

void RunOptionTable::add_general(CommandLine& line) {
  line.group("Options");
  preset_.add_to(line);
  line.choice<Mode>("--mode", target_.extract.mode, {{"default", Mode::kDefault}, {"thesis", Mode::kThesis}},
                    "thesis: every formula and constant as printed; changes the defaults below");
  line.number("-t,--threads", target_.extract.execution.threads, {0, 4096}, "0: as many as the machine has");
  line.number("--seed", seed_, kSeedRange, "of the directions in the cones");
  line.number("--time-limit", target_.time_limit, {0, 1e9}, "seconds; 0: none");
  line.number("--least-inside", target_.least_inside, {0, 1},
              "share of the length that must be inside, of arcs that are refined");
}

void RunOptionTable::add_stages(CommandLine& line) {
  add_slice_options(line, target_.extract, planes_);
  add_point_options(line, target_.extract);
  add_collapse_options(line, target_.extract);
  add_arc_options(line, target_.extract, step_, detail_);
}

void RunOptionTable::resolve(CommandLine& line) {
  preset_.apply(line);
  ExtractOptions& options = target_.extract;
  target_.repair.resolve();
  options.cone.seed = seed_;
  if (line.given("--slices")) options.search.angles = options.sampling.planes = planes_;
  if (step_ != usual_step_) options.refinement.node_spacing = step_;
  options.refinement.limbs.slenderness /= detail_;
}

}  // namespace mspskel::cli
