// What the whole pipeline promises for any closed mesh and any options in their ranges.
#pragma once

#include <cmath>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "fuzz/fuzzed_meshes.h"
#include "fuzz/fuzzed_options.h"
#include "mspskel/collapse/topology_certificate.h"
#include "mspskel/mesh/build_mesh.h"
#include "mspskel/mesh/component_solids.h"
#include "mspskel/mesh/mesh_report.h"
#include "mspskel/skeleton/polyline_graph.h"
#include "mspskel/skeleton/surface_map.h"

namespace mspskel::fuzz {

// A law that does not hold. The message is the law alone, so that findings of one kind can be counted.
struct Broken : std::logic_error {
  using std::logic_error::logic_error;
};

inline void hold(bool law, const std::string& name) {
  if (!law) throw Broken(name);
}

inline bool same_bytes(const CurveSkeleton& a, const CurveSkeleton& b) {
  if (a.nodes.size() != b.nodes.size() || a.edges != b.edges || a.node_of_vertex != b.node_of_vertex)
    return false;
  for (std::size_t i = 0; i < a.nodes.size(); ++i)
    if (a.nodes[i].position != b.nodes[i].position || a.nodes[i].radius != b.nodes[i].radius ||
        a.nodes[i].area != b.nodes[i].area || a.nodes[i].perimeter != b.nodes[i].perimeter ||
        a.nodes[i].slice_error != b.nodes[i].slice_error)
      return false;
  return true;
}

inline void check_numbers(const CurveSkeleton& skeleton) {
  for (const SkeletonNode& node : skeleton.nodes) {
    hold(node.position.allFinite(), "positions are finite");
    hold(std::isfinite(node.radius) && node.radius >= 0, "radii are finite and not negative");
    hold(std::isfinite(node.area) && node.area >= 0, "areas are finite and not negative");
    hold(std::isfinite(node.perimeter) && node.perimeter >= 0, "perimeters are finite and not negative");
    hold(node.slice_error >= 0 && node.slice_error <= 1, "slice errors are from 0 to 1");
  }
}

inline void check_graph(const ExtractResult& result) {
  MeshReport surface;
  detail::measure_components(result.surface, surface);
  const GraphCounts counts = count_graph(result.skeleton);
  hold(counts.components == result.surface.component_count, "as many pieces as components");
  hold(counts.cycles == surface.genus, "as many cycles as handles");
  const std::set<std::array<Index, 2>> edges(result.skeleton.edges.begin(), result.skeleton.edges.end());
  hold(edges.size() == result.skeleton.edges.size(), "no edge twice");
  for (const auto& [a, b] : edges)
    hold(a >= 0 && a < b && b < counts.nodes, "edges join two nodes, the smaller one first");
  hold(report_surface_map(result.surface, result.skeleton).partition, "the map is a partition");
}

// The component of the surface that each node stands for: that of its vertices, or of its neighbours where it
// has none.
inline std::vector<Index> node_components(const ExtractResult& result) {
  const std::vector<std::vector<Index>> next = adjacency(result.skeleton);
  std::vector<Index> component =
      component_of_nodes(result.surface, static_cast<Index>(next.size()), result.skeleton.node_of_vertex);
  std::vector<Index> known;
  for (std::size_t i = 0; i < next.size(); ++i)
    if (component[i] != kNone) known.push_back(static_cast<Index>(i));
  for (std::size_t k = 0; k < known.size(); ++k)
    for (const Index i : next[known[k]]) {
      hold(component[i] == kNone || component[i] == component[known[k]], "a piece stands for one component");
      if (component[i] == kNone) known.push_back(i);
      component[i] = component[known[k]];
    }
  hold(known.size() == next.size(), "every piece stands for a component");
  return component;
}

// The certificate agrees with the counts, and fails nothing without a warning.
inline TopologyCertificate check_certificate(const ExtractResult& result,
                                             const std::vector<Index>& component) {
  PolylineGraph graph = polyline_graph(result.surface, result.skeleton);
  graph.component = component;
  const TopologyCertificate certificate =
      certify_topology(result.surface, result.cocycles, BoundingVolumeHierarchy(result.surface), graph);
  const GraphCounts counts = count_graph(result.skeleton);
  hold(certificate.b0 == counts.components && certificate.b1 == counts.cycles,
       "the certificate counts pieces and cycles");
  hold(certificate.inside >= 0 && certificate.inside <= 1, "the share inside is from 0 to 1");
  hold(certificate.verdict != TopologyVerdict::kProved || certificate.edges_not_inside == 0,
       "nothing outside is proved");
  return certificate;
}

// What the default mode adds: arcs are led inside and round their handles, as long as the surface bounds a
// solid. Far from the origin a place has few digits, and a point may come to lie in the surface.
inline void check_refined(const ExtractResult& result, const TopologyCertificate& certificate) {
  if (certificate.self_intersecting || !result.warnings.empty()) return;
  constexpr double kRounding = 1e-12;
  hold(certificate.inside >= 1 - kRounding, "wholly inside an embedded surface, or a warning");
  hold(certificate.verdict != TopologyVerdict::kFailed, "cycles round all handles of an embedded surface");
}

// Every node lies in the solid of its own component, or the certificate says that something is outside, which
// the program warns of. Of an embedded surface it lies within the component's own faces too, whatever lies in
// them; a cavity may cross what it is in, and then parity over both is the solid.
inline void check_containment(const ExtractResult& result, const std::vector<Index>& component,
                              const TopologyCertificate& certificate) {
  if (certificate.edges_not_inside > 0) return;
  const SurfaceSnapshot& surface = result.surface;
  std::vector<std::vector<Index>> faces(static_cast<std::size_t>(surface.component_count));
  if (certificate.self_intersecting)
    faces = find_component_solids(surface).faces;
  else
    for (Index f = 0; f < surface.face_count(); ++f)
      faces[surface.component[surface.origin[3 * f]]].push_back(f);
  std::vector<std::vector<Index>> nodes(faces.size());
  for (std::size_t i = 0; i < component.size(); ++i) nodes[component[i]].push_back(static_cast<Index>(i));
  for (std::size_t c = 0; c < faces.size(); ++c) {
    const BoundingVolumeHierarchy solid(surface, faces[c]);
    for (const Index i : nodes[c])
      hold(solid.inside(surface.frame.to_normalised(result.skeleton.nodes[i].position)),
           "every node in the solid of its component, or the certificate says otherwise");
  }
}

// A piece is at least a tenth as long as its component, or a warning says that something is wrong.
inline void check_lengths(const ExtractResult& result, const std::vector<Index>& component) {
  if (!result.warnings.empty()) return;
  const SurfaceSnapshot& surface = result.surface;
  const auto count = static_cast<std::size_t>(surface.component_count);
  std::vector<Eigen::AlignedBox3d> box(count);
  for (Index v = 0; v < surface.vertex_count(); ++v)
    if (surface.component[v] != kNone) box[surface.component[v]].extend(surface.position[v]);
  std::vector<double> length(count, 0.0);
  for (const auto& [a, b] : result.skeleton.edges)
    length[component[a]] +=
        (result.skeleton.nodes[a].position - result.skeleton.nodes[b].position).norm() / surface.frame.scale;
  for (std::size_t c = 0; c < count; ++c)
    hold(length[c] >= 0.1 * box[c].sizes().maxCoeff(),
         "a piece at least a tenth as long as its component, or a warning");
}

// What every result promises, of whatever mesh it is.
inline void check_result(const ExtractResult& result, bool refined) {
  check_numbers(result.skeleton);
  check_graph(result);
  const std::vector<Index> component = node_components(result);
  const TopologyCertificate certificate = check_certificate(result, component);
  check_containment(result, component, certificate);
  if (refined) check_refined(result, certificate);
  check_lengths(result, component);
}

// Work that takes an execution, on one thread: counts how often it asks whether to go on.
template <class Work>
Index count_calls(Work work) {
  Index calls = 0;
  Execution execution;
  execution.threads = 1;
  execution.progress = [&](const char*, double share) {
    hold(share >= 0 && share <= 1, "progress is from 0 to 1");
    return ++calls, true;
  };
  work(execution);
  return calls;
}

// A callback that says no at its n-th call stops the work there; short work asks nothing.
template <class Work>
void check_cancelling(Work work, Index calls, Choices& choices) {
  if (calls == 0) return;
  const Index last = 1 + static_cast<Index>(choices.uniform(0, 0.999) * calls);
  Index asked = 0;
  Execution execution;
  execution.threads = 1;
  execution.progress = [&](const char*, double) { return ++asked < last; };
  try {
    work(execution);
  } catch (const Cancelled&) {
    return hold(asked == last, "a callback that said no is not asked again");
  }
  hold(false, "a callback that says no stops the work");
}

// One input: what became of it.
enum class Outcome { kExtracted, kWarned, kRefused, kMended, kUnited, kWrapped };
constexpr const char* kOutcomeNames[] = {"extracted", "with warnings", "refused",
                                         "mended",    "united",        "wrapped"};

struct FuzzedInput {
  FuzzedMesh mesh;
  ExtractOptions options;
};

inline FuzzedInput make_input(Choices& choices) {
  FuzzedInput input;
  input.mesh = fuzzed_mesh(choices);
  input.options = fuzzed_options(choices, input.mesh.made);
  return input;
}

// Throws Broken. Errors that an input does not deserve pass through: options are in range and every closed
// mesh has a skeleton.
inline Outcome check_pipeline(const FuzzedInput& input, Choices& choices) {
  const auto extract = [&](const DefaultMesh& mesh, const Execution& execution) {
    ExtractOptions options = input.options;
    options.execution = execution;
    return extract_skeleton(mesh, options);
  };
  DefaultMesh mesh;
  ExtractResult result;
  Index calls = 0;
  try {
    mesh = build_mesh(input.mesh.soup);
    calls = count_calls([&](const Execution& execution) { result = extract(mesh, execution); });
  } catch (const MeshError&) {
    return Outcome::kRefused;
  }
  check_result(result, input.options.refinement.enabled);
  if (choices.one_in(2)) {
    Execution two;
    two.threads = 2;
    hold(same_bytes(extract(mesh, two).skeleton, result.skeleton), "the same bytes on two threads");
  } else {
    check_cancelling([&](const Execution& execution) { (void)extract(mesh, execution); }, calls, choices);
  }
  return result.warnings.empty() ? Outcome::kExtracted : Outcome::kWarned;
}

}  // namespace mspskel::fuzz
