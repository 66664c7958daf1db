#include "mesh_input.h"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "mspskel/base/counted.h"
#include "mspskel/base/error.h"

namespace mspskel::cli {
namespace {

MeshInput mend(const PolygonSoup& soup, const RepairSettings& settings, const ProgressCallback& progress) {
  MeshInput input;
  input.mended = true;
  input.repair = mend_soup(soup, settings.options, progress);
  report_progress(progress, "mending", 1.0);
  input.built = build_mesh_with_report(input.repair.soup);
  const std::string done = summary(input.repair);
  if (!done.empty()) input.built.warnings.insert(input.built.warnings.begin(), "mended: " + done);
  input.repair.soup = {};
  input.vertex_of_point = input.repair.vertex_of_point;
  return input;
}

std::string length_text(double length) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", length);
  return text;
}

MeshInput of_wrap(WrappedSoup&& wrapped) {
  MeshInput input;
  input.wrapped = std::move(wrapped);
  input.built = build_mesh_with_report(input.wrapped->soup);
  input.wrapped->soup = {};
  input.vertex_of_point = input.wrapped->vertex_of_point;
  input.built.warnings.insert(input.built.warnings.begin(),
                              "wrapped to " + counted(input.wrapped->solids, "solid") + ": gaps below " +
                                  length_text(input.wrapped->gap) + " are closed, on a grid with cells of " +
                                  length_text(input.wrapped->cell) +
                                  " (--wrap never mends what can be mended instead)");
  return input;
}

// Where a good part of the surface is made up by what closes it, mending is a guess.
bool is_guesswork(const MendCounts& counts) {
  constexpr double kMostMadeUp = 0.25;
  return counts.hole_share > kMostMadeUp;
}

// What the components of a surface fill each on its own, cubed model units.
double filled_by_shells(const SurfaceSnapshot& surface) {
  std::vector<double> volume(static_cast<std::size_t>(surface.component_count), 0.0);
  for (Index f = 0; f < surface.face_count(); ++f) {
    const Index v = surface.origin[3 * f];
    volume[surface.component[v]] += surface.face_normal_times_twice_area(f).dot(surface.position[v]) / 6;
  }
  const double sum = std::accumulate(volume.begin(), volume.end(), 0.0,
                                     [](double all, double part) { return all + std::abs(part); });
  return sum * std::pow(surface.frame.scale, 3);
}

std::string way_of(const UnitedShells& united) {
  if (united.cell == 0) return "cut along the curves where they cross";
  return "sampled at cells of " + length_text(united.cell) +
         (united.resolved ? "" : ", which are too coarse for the thinnest of them");
}

void unite(MeshInput& input, const SurfaceSnapshot& surface, const CrossingShells& crossing,
           const Execution& execution) {
  input.united = unite_shells(surface, crossing, {}, execution);
  UnitedShells& united = *input.united;
  if (united.left_apart > 0)
    input.built.warnings.push_back(counted(united.left_apart, "shell") +
                                   " cross each other and stay apart: united they would have more handles "
                                   "than shells; each has a skeleton of its own");
  if (united.shells == 0) return;
  std::vector<std::string> warnings = std::move(input.built.warnings);
  for (Opening& opening : input.repair.openings) {
    if (opening.vertex == kNone) continue;
    const bool replaced = united.replaced[surface.component[opening.vertex]];
    opening.vertex = replaced ? kNone : united.vertex_of[opening.vertex];
  }
  if (input.vertex_of_point.empty()) {
    input.vertex_of_point = united.vertex_of;
  } else {
    for (Index& v : input.vertex_of_point)
      if (v != kNone) v = united.vertex_of[v];
  }
  input.built = build_mesh_with_report(united.soup);
  united.soup = {};
  warnings.push_back(
      counted(united.shells, "shell") + " that cross each other or lie in one place are united to " +
      counted(united.solids, "solid") + ", " + way_of(united) + " (--shells each keeps them apart)");
  input.built.warnings.insert(input.built.warnings.begin(), warnings.begin(), warnings.end());
}

// Shells that cross each other: walls round a room, as a house's, are wrapped, others are united. A part that
// the file holds twice is one: mending welds the two and drops the faces that repeat.
void join_shells(MeshInput& input, const PolygonSoup& soup, const RepairSettings& settings,
                 const Execution& execution) {
  if (input.built.component_count < 2) return;
  SurfaceSnapshot surface = make_snapshot(input.built.mesh);
  if (settings.repair && !input.mended && has_repeated_shells(surface)) {
    input = mend(soup, settings, execution.progress);
    surface = make_snapshot(input.built.mesh);
  }
  const CrossingShells crossing = crossing_shells(surface, execution);
  if (crossing.groups.empty()) return;
  if (settings.wrap_mode == WrapMode::kAuto) {
    WrapOptions options = settings.wrapping;
    options.thicken_walls = false;
    options.filled = filled_by_shells(surface);
    WrappedSoup wrapped = wrap_soup(soup, options, execution);
    if (wrapped.encloses) {
      input = of_wrap(std::move(wrapped));
      return;
    }
  }
  unite(input, surface, crossing, execution);
}

// Nothing tells what the solid is: most of the surface is open sheets, and a good part of the rest would be
// made up.
void refuse_sheets(const MendCounts& counts) {
  constexpr double kMostSheets = 0.5;
  if (counts.flat_share <= kMostSheets) return;
  throw MendError("the mesh encloses no volume: " + std::to_string(std::lround(100 * counts.flat_share)) +
                      " % of its area is open sheets, and what they might stand round is anybody's guess; "
                      "close it to a solid, or wrap it with --wrap 0.02",
                  counts);
}

double share_of(const std::string& option, const std::string& text, const std::string& words, Range range) {
  double share = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, share);
  if (error != std::errc() || stop != end || !(share >= range.low && share <= range.high))
    throw UsageError(option + ": expected " + words + " or a share from " + range_text(range) + ", not '" +
                     text + "'");
  return share;
}

Json opening_json(const Opening& opening) {
  const auto list = [](const Vector3& v) { return Json{v[0], v[1], v[2]}; };
  return {{"centre", list(opening.centre)}, {"normal", list(opening.normal)}, {"radius", opening.radius}};
}

}  // namespace

void RepairSettings::resolve() {
  if (components == "all" || components == "largest")
    options.smallest_component = components == "all" ? 0 : 1;
  else
    options.smallest_component = share_of("--components", components, "all, largest", {0, 1});
  wrap_mode = wrap == "auto" ? WrapMode::kAuto : wrap == "never" ? WrapMode::kNever : WrapMode::kAlways;
  if (wrap_mode == WrapMode::kAlways) wrapping.gap = share_of("--wrap", wrap, "auto, never", {0.004, 0.2});
}

void add_repair_options(CommandLine& line, RepairSettings& settings) {
  line.group("Repair, of a mesh that is not one closed, manifold surface");
  line.choice<bool>("--repair", settings.repair, {{"auto", true}, {"off", false}},
                    "auto: mend it and say what was done; off: refuse it");
  line.text("--components", settings.components, "all|largest|SHARE",
            "pieces that stay: those whose extent is at least this share of the largest one's");
  line.number("--weld", settings.options.weld, {0, 0.01},
              "points nearer than this share of the extent are one; equal ones always are");
  line.choice<OpenEnds>(
      "--open", settings.options.open,
      {{"ends", OpenEnds::kEnds}, {"cap", OpenEnds::kCap}, {"fail", OpenEnds::kFail}},
      "ends: where a tube is open its skeleton ends, other holes are closed; cap: all are; fail: refuse");
  line.text(
      "--wrap", settings.wrap, "auto|never|SHARE",
      "one surface round it all that closes gaps below this share of the extent; auto: where mending would "
      "make up more than a quarter of the surface, at a scale that the mesh tells");
  line.choice<bool>("--shells", settings.unite, {{"union", true}, {"each", false}},
                    "union: shells that cross each other are one solid; each: every shell has a skeleton");
}

CurveSkeleton MeshInput::of_file(const CurveSkeleton& skeleton) const {
  CurveSkeleton result = skeleton;
  if (vertex_of_point.empty()) return result;
  result.node_of_vertex.clear();
  for (const Index v : vertex_of_point)
    result.node_of_vertex.push_back(v == kNone ? kNone : skeleton.node_of_vertex[v]);
  return result;
}

CurveSkeleton MeshInput::of_surface(const CurveSkeleton& skeleton) const {
  CurveSkeleton result = skeleton;
  if (vertex_of_point.empty() || skeleton.node_of_vertex.size() != vertex_of_point.size()) return result;
  result.node_of_vertex.assign(built.mesh.n_vertices(), kNone);
  for (std::size_t p = 0; p < vertex_of_point.size(); ++p)
    if (vertex_of_point[p] != kNone) result.node_of_vertex[vertex_of_point[p]] = skeleton.node_of_vertex[p];
  return result;
}

MeshInput prepare_mesh(const PolygonSoup& soup, const RepairSettings& settings, const Execution& execution) {
  const MendOptions defaults;
  const bool wants_more =
      settings.options.weld > 0 || settings.options.smallest_component != defaults.smallest_component;
  MeshInput input;
  if (settings.wrap_mode == WrapMode::kAlways) {
    input = of_wrap(wrap_soup(soup, settings.wrapping, execution));
  } else if (!settings.repair) {
    input.built = build_mesh_with_report(soup);
  } else if (wants_more) {
    input = mend(soup, settings, execution.progress);
  } else {
    try {
      input.built = build_mesh_with_report(soup);
    } catch (const MeshError&) {
      input = mend(soup, settings, execution.progress);
    }
  }
  if (settings.wrap_mode == WrapMode::kAuto && is_guesswork(input.repair.counts)) {
    // A bowl is open on purpose: nothing but its wall would be enclosed.
    WrapOptions options = settings.wrapping;
    options.thicken_walls = false;
    WrappedSoup wrapped = wrap_soup(soup, options, execution);
    if (wrapped.encloses)
      input = of_wrap(std::move(wrapped));
    else
      refuse_sheets(input.repair.counts);
  }
  if (settings.unite && !input.wrapped) join_shells(input, soup, settings, execution);
  input.built.warnings.insert(input.built.warnings.begin(), soup.warnings.begin(), soup.warnings.end());
  return input;
}

MeshInput wrap_mesh(const MeshInput& input, const PolygonSoup& soup, const RepairSettings& settings,
                    const Execution& execution) {
  const std::size_t open_ends = input.repair.openings.size();
  MeshInput wrapped =
      of_wrap(wrap_soup(open_ends > 0 ? to_soup(input.built.mesh) : soup, settings.wrapping, execution));
  std::vector<std::string>& warnings = wrapped.built.warnings;
  if (open_ends > 0) {
    for (Index& v : wrapped.vertex_of_point = input.vertex_of_point)
      if (v != kNone) v = wrapped.wrapped->vertex_of_point[v];
    wrapped.mended = true;
    wrapped.repair = input.repair;
    wrapped.repair.openings.clear();
    warnings.insert(warnings.begin(), {"mended: " + summary(input.repair),
                                       counted(open_ends, "open end") + " of it " +
                                           (open_ends == 1 ? "is" : "are") + " covered by the wrap"});
  }
  warnings.insert(warnings.begin(), soup.warnings.begin(), soup.warnings.end());
  return wrapped;
}

Json counts_json(const MendCounts& c) {
  return {{"welded_points", c.welded_points},
          {"stitched_points", c.stitched_points},
          {"isolated_points", c.isolated_points},
          {"degenerate_faces", c.degenerate_faces},
          {"repeated_faces", c.repeated_faces},
          {"two_sided_faces", c.two_sided_faces},
          {"thickened_faces", c.thickened_faces},
          {"flap_faces", c.flap_faces},
          {"turned_faces", c.turned_faces},
          {"paired_edges", c.paired_edges},
          {"one_sided_edges", c.one_sided_edges},
          {"split_vertices", c.split_vertices},
          {"split_edges", c.split_edges},
          {"holes", c.holes},
          {"hole_faces", c.hole_faces},
          {"hole_share", c.hole_share},
          {"joined_pieces", c.joined_pieces},
          {"flat_components", c.flat_components},
          {"flat_share", c.flat_share},
          {"small_components", c.small_components},
          {"small_faces", c.small_faces}};
}

Json repair_facts(const MeshInput& input) {
  Json openings = Json::array();
  for (const Opening& opening : input.repair.openings) openings.push_back(opening_json(opening));
  Json facts{{"mended", input.mended}, {"points", input.repair.vertex_of_point.size()}};
  facts.update(counts_json(input.repair.counts));
  facts.update({{"united_shells", input.united ? input.united->shells : 0},
                {"united_solids", input.united ? input.united->solids : 0},
                {"shells_left_apart", input.united ? input.united->left_apart : 0},
                {"wrapped", input.wrapped.has_value()},
                {"gap", input.wrapped ? input.wrapped->gap : 0.0},
                {"cell", input.wrapped  ? input.wrapped->cell
                         : input.united ? input.united->cell
                                        : 0.0},
                {"openings", openings}});
  return facts;
}

}  // namespace mspskel::cli
