// What mending promises for any soup, and the whole way from a soup to a skeleton, as the command line goes
// it.
#pragma once

#include <array>
#include <optional>

#include "checked_extraction.h"
#include "fuzz/fuzzed_repair.h"
#include "fuzz/fuzzed_soups.h"
#include "fuzz/pipeline_laws.h"

namespace mspskel::fuzz {

// A refusal says why; all other exceptions pass through.
template <class Work>
bool refuses(Work work) {
  try {
    work();
  } catch (const MeshError& error) {
    hold(std::string(error.what()).size() > 10, "a refusal says why");
    return true;
  }
  return false;
}

inline void check_closed(const PolygonSoup& soup, const std::string& what) {
  hold(all_triangles(soup) && in_range(soup), what + " is triangles");
  for (const Vector3& p : soup.points) hold(p.allFinite(), what + " has finite coordinates");
  try {
    const BuiltMesh built = build_mesh_with_report(soup);
    hold(built.isolated_vertices == 0, what + " has no point without faces");
    hold(built.reoriented_faces == 0, what + " is turned consistently");
  } catch (const MeshError& error) {
    throw Broken(what + " is closed and manifold");
  }
}

// Of a soup that is not so small that places between its points are no numbers.
inline void check_distinct_points(const PolygonSoup& soup) {
  constexpr double kSmallest = 1e-290;
  if (extent(soup) < kSmallest) return;
  std::vector<std::array<double, 3>> places;
  for (const Vector3& p : soup.points) places.push_back({p[0], p[1], p[2]});
  std::sort(places.begin(), places.end());
  hold(std::adjacent_find(places.begin(), places.end()) == places.end(), "no two vertices in one place");
}

inline std::vector<char> used_points(const PolygonSoup& soup) {
  std::vector<char> used(soup.points.size(), 0);
  for (const Index v : soup.corners)
    if (v >= 0 && v < static_cast<Index>(used.size())) used[v] = 1;
  return used;
}

// Vertices by points: only of points that faces use, and all vertices but those that were added.
inline void check_map(const PolygonSoup& soup, const MendedSoup& mended, bool by_equality) {
  const std::vector<char> used = used_points(soup);
  const std::vector<Vector3>& points = mended.soup.points;
  hold(mended.vertex_of_point.size() == soup.points.size(), "the map has an entry for each point");
  std::vector<char> hit(points.size(), 0);
  for (std::size_t p = 0; p < used.size(); ++p) {
    const Index v = mended.vertex_of_point[p];
    hold(v == kNone || (v >= 0 && v < static_cast<Index>(points.size())), "the map is in range");
    if (v == kNone) continue;
    hold(used[p] && soup.points[p].allFinite(), "no vertex stands for a point that no face has");
    if (by_equality) hold(points[v] == soup.points[p], "what was not moved lies where it did");
    hit[v] = 1;
  }
  const MendCounts& c = mended.counts;
  const auto added =
      c.split_vertices + c.split_edges + 2 * c.thickened_faces + static_cast<Index>(mended.openings.size());
  hold(std::count(hit.begin(), hit.end(), 0) <= added, "every vertex stands for a point, or was added");
  if (c.flat_components + c.small_components + c.flap_faces + c.degenerate_faces + c.two_sided_faces == 0)
    for (std::size_t p = 0; p < used.size(); ++p)
      hold(!used[p] || mended.vertex_of_point[p] != kNone, "points go only where something was dropped");
}

inline void check_openings(const MendedSoup& mended) {
  for (const Opening& o : mended.openings) {
    hold(o.vertex >= 0 && o.vertex < static_cast<Index>(mended.soup.points.size()), "openings have a vertex");
    hold(o.centre.allFinite() && std::isfinite(o.radius) && o.radius > 0, "openings have a place and a size");
    hold(std::abs(o.normal.norm() - 1) < 1e-9, "openings have a unit normal");
  }
}

inline void check_counts(const PolygonSoup& soup, const MendedSoup& mended) {
  const MendCounts& c = mended.counts;
  for (const Index n : {c.welded_points, c.stitched_points, c.isolated_points, c.degenerate_faces,
                        c.repeated_faces, c.two_sided_faces, c.thickened_faces, c.flap_faces, c.turned_faces,
                        c.paired_edges, c.one_sided_edges, c.split_vertices, c.split_edges, c.holes,
                        c.hole_faces, c.joined_pieces, c.flat_components, c.small_components, c.small_faces})
    hold(n >= 0, "no count is negative");
  hold(c.hole_share >= 0 && c.hole_share <= 1 && c.flat_share >= 0 && c.flat_share <= 1, "shares are shares");
  hold(c.stitched_points <= c.welded_points, "what was stitched was welded");
  hold(c.thickened_faces <= c.two_sided_faces, "what was thickened was cancelled");
  hold(static_cast<Index>(mended.openings.size()) <= c.holes, "openings are loops");
  const std::vector<char> used = used_points(soup);
  hold(c.isolated_points == std::count(used.begin(), used.end(), 0), "points of no face are counted");
  // Each triangle has its fate.
  if (!all_triangles(soup) || c.flat_components > 0) return;
  const Index left = static_cast<Index>(soup.polygon_count()) - c.degenerate_faces - c.repeated_faces -
                     2 * c.two_sided_faces + 6 * c.thickened_faces - c.flap_faces + c.hole_faces -
                     c.small_faces + 2 * c.split_edges;
  hold(left == static_cast<Index>(mended.soup.polygon_count()), "the counts of faces sum up");
}

// What is mended comes through as it is, apart from pieces so thin that drawing touching parts of them
// asunder has left no volume.
inline void check_again(const MendedSoup& mended) {
  MendOptions options;
  options.smallest_component = 0;
  options.open = OpenEnds::kFail;
  MendedSoup again;
  if (refuses([&] { again = mend_soup(mended.soup, options); }) || again.counts.flat_components > 0)
    return hold(mended.counts.split_vertices + mended.counts.split_edges > 0, "what is mended has a volume");
  hold(again.soup.points == mended.soup.points && again.soup.corners == mended.soup.corners,
       "what is mended comes through mending as it is");
}

inline void check_mended(const PolygonSoup& soup, const MendOptions& options, const MendedSoup& mended) {
  check_closed(mended.soup, "what is mended");
  check_distinct_points(mended.soup);
  const MendCounts& c = mended.counts;
  check_map(soup, mended, options.weld == 0 && c.stitched_points + c.split_vertices + c.split_edges == 0);
  check_openings(mended);
  check_counts(soup, mended);
  check_again(mended);
}

inline void check_wrap(const PolygonSoup& soup, Choices& choices) {
  Execution one;
  one.threads = 1;
  WrapOptions options;
  if (choices.one_in(2)) options.gap = choices.magnitude(0.03, 0.2);
  options.thicken_walls = choices.one_in(2);
  if (choices.one_in(4)) options.filled = choices.magnitude(1e-3, 1) * std::pow(extent(soup), 3);
  WrappedSoup wrapped;
  if (!(options.filled >= 0 && std::isfinite(options.filled))) return;
  if (refuses([&] { wrapped = wrap_soup(soup, options, one); })) return;
  if (wrapped.soup.points.empty())
    return hold(!wrapped.encloses, "a wrap has a surface, or says that it has none");
  check_closed(wrapped.soup, "a wrap");
  hold(wrapped.vertex_of_point.size() == soup.points.size(), "the wrap's map has an entry for each point");
  for (const Index v : wrapped.vertex_of_point)
    hold(v == kNone || (v >= 0 && v < static_cast<Index>(wrapped.soup.points.size())),
         "the wrap's map is in range");
}

// Of shells that cross, on a grid or cut.
inline void check_union(const PolygonSoup& closed, Choices& choices) {
  const SurfaceSnapshot surface = make_snapshot(build_mesh(closed));
  Execution one;
  one.threads = 1;
  const CrossingShells crossing = crossing_shells(surface, one);
  if (crossing.groups.empty()) return;
  UniteOptions options;
  if (choices.one_in(2)) options.cell = choices.magnitude(0.01, 0.1);
  const UnitedShells united = unite_shells(surface, crossing, options, one);
  Index shells = 0;
  for (const std::vector<Index>& group : crossing.groups) shells += static_cast<Index>(group.size());
  hold(united.shells + united.left_apart <= shells, "shells that cross others are united or stay apart");
  if (united.shells == 0) return hold(united.soup.points.empty(), "where nothing is united there is no soup");
  check_closed(united.soup, "a union");
  hold(united.vertex_of.size() == closed.points.size(), "the union's map has an entry for each vertex");
  for (const Index v : united.vertex_of)
    hold(v >= 0 && v < static_cast<Index>(united.soup.points.size()), "the union's map is total");
}

// The result with its own warnings alone, without those of mending.
inline ExtractResult own_result(const cli::CheckedExtraction& made) {
  ExtractResult result = made.result;
  const std::vector<std::string>& before = made.input.built.warnings;
  const auto at = std::search(result.warnings.begin(), result.warnings.end(), before.begin(), before.end());
  if (at != result.warnings.end()) result.warnings.erase(at, at + static_cast<std::ptrdiff_t>(before.size()));
  return result;
}

struct SoupInput {
  FuzzedMesh mesh;
  cli::RunOptions run;
};

inline SoupInput make_soup_input(Choices& choices) {
  SoupInput input;
  input.mesh = fuzzed_soup(choices);
  input.run.repair = fuzzed_repair(choices, input.mesh.made);
  input.run.extract = fuzzed_options(choices, input.mesh.made);
  return input;
}

inline Outcome outcome_of(const cli::MeshInput& input) {
  return input.wrapped           ? Outcome::kWrapped
         : input.united_shells() ? Outcome::kUnited
         : input.mended          ? Outcome::kMended
                                 : Outcome::kExtracted;
}

// Work that gives the same on two threads, or stops where the callback says so. False: it refuses the soup.
template <class Work, class Same>
bool check_work(Work work, Same check_same, Choices& choices) {
  Index calls = 0;
  if (refuses([&] { calls = count_calls(work); })) return false;
  if (choices.one_in(2))
    check_same();
  else
    check_cancelling(work, calls, choices);
  return true;
}

// As far as the surface.
inline Outcome check_preparation(const SoupInput& input, Choices& choices) {
  const PolygonSoup& soup = input.mesh.soup;
  cli::MeshInput prepared;
  const auto prepare = [&](const Execution& execution) {
    prepared = cli::prepare_mesh(soup, input.run.repair, execution);
  };
  const auto check_same = [&] {
    const PolygonSoup surface = to_soup(prepared.built.mesh);
    const std::vector<Index> map = prepared.vertex_of_point;
    Execution two;
    two.threads = 2;
    prepare(two);
    const PolygonSoup again = to_soup(prepared.built.mesh);
    hold(
        again.points == surface.points && again.corners == surface.corners && prepared.vertex_of_point == map,
        "the same surface on two threads");
  };
  return check_work(prepare, check_same, choices) ? outcome_of(prepared) : Outcome::kRefused;
}

// The whole way.
inline Outcome check_whole_way(const SoupInput& input, Choices& choices) {
  const PolygonSoup& soup = input.mesh.soup;
  const auto depth = choices.of({cli::CertificateDepth::kVerdict, cli::CertificateDepth::kFull});
  std::optional<cli::CheckedExtraction> made;
  const auto extract = [&](const Execution& execution) {
    cli::RunOptions run = input.run;
    run.extract.execution = execution;
    made.emplace(cli::extract_checked(soup, cli::prepare_mesh(soup, run.repair, execution), run, depth));
  };
  const auto check_same = [&] {
    const CurveSkeleton skeleton = made->result.skeleton;
    Execution two;
    two.threads = 2;
    extract(two);
    hold(same_bytes(made->result.skeleton, skeleton), "the same bytes on two threads");
  };
  if (!check_work(extract, check_same, choices)) return Outcome::kRefused;
  check_result(own_result(*made), input.run.extract.refinement.enabled);
  hold(made->input.of_file(made->result.skeleton).node_of_vertex.size() == soup.points.size(),
       "the map is of the file's points");
  return outcome_of(made->input);
}

// Throws Broken. Errors other than refusals pass through.
inline Outcome check_soup_input(const SoupInput& input, Choices& choices) {
  const PolygonSoup& soup = input.mesh.soup;
  MendedSoup mended;
  if (!refuses([&] { mended = mend_soup(soup, input.run.repair.options); })) {
    check_mended(soup, input.run.repair.options, mended);
    if (choices.one_in(4)) (void)refuses([&] { check_union(mended.soup, choices); });
  }
  if (choices.one_in(32)) check_wrap(soup, choices);
  // Extraction takes most of the time, and closed meshes try it as well.
  return choices.one_in(6) ? check_whole_way(input, choices) : check_preparation(input, choices);
}

}  // namespace mspskel::fuzz
