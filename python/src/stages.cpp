// The stages one by one. Lengths are in the surface's normalised frame, as in C++; arrays can be replaced.
#include <nanobind/stl/array.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/vector.h>

#include <memory>
#include <optional>

#include "arrays.h"
#include "bindings.h"
#include "mesh_input.h"
#include "mspskel/arcs/collapsed_arcs.h"
#include "mspskel/arcs/limit_nodes.h"
#include "mspskel/arcs/space_nodes.h"
#include "mspskel/extract_skeleton.h"
#include "mspskel/mesh/orient_shells.h"
#include "mspskel/refine/find_digits.h"
#include "mspskel/refine/reach_digits.h"
#include "options.h"
#include "watched_run.h"

namespace mspskel::python {
namespace {

// A surface with what every stage looks up on it.
struct Surface {
  explicit Surface(SurfaceSnapshot given) : snapshot(std::move(given)), tracer(snapshot), solid(snapshot) {}
  const SurfaceSnapshot snapshot;
  const SliceTracer tracer;
  const BoundingVolumeHierarchy solid;
};

struct Tips {
  std::vector<LimbTip> tips;
};

// Arcs, and what the collapse knows of their classes.
struct Arcs {
  ArcGraph graph;
  ArcClasses classes;
};

// Work on `options` that Ctrl-C and the time limit may end.
template <class Work>
auto watched(const Options& options, Work work) {
  WatchedRun run(nb::none(), options.run.time_limit);
  ExtractOptions extract = options.run.extract;
  extract.execution.progress = run.progress();
  return run.run([&] { return work(extract); });
}

std::unique_ptr<Surface> make_surface(const PolygonSoup& soup, const Options& options) {
  return watched(options, [&](const ExtractOptions& o) {
    const cli::MeshInput input = cli::prepare_mesh(soup, options.run.repair, o.execution);
    SurfaceSnapshot snapshot = make_snapshot(input.built.mesh);
    std::optional<SurfaceSnapshot> outward = orient_shells_outward(snapshot);
    return std::make_unique<Surface>(outward ? std::move(*outward) : std::move(snapshot));
  });
}

std::pair<std::unique_ptr<Surface>, View<Index>> coarsen(const Surface& surface, const Options& options) {
  CoarseSurface coarse = watched(options, [&](const ExtractOptions& o) {
    return coarsen_surface(surface.snapshot, o.coarsening, o.execution);
  });
  return {std::make_unique<Surface>(std::move(coarse.surface)), given_away(std::move(coarse.coarse_vertex))};
}

VertexSlices slices(const Surface& surface, const Options& options) {
  return watched(options, [&](const ExtractOptions& o) {
    return o.slices == SliceMethod::kSearch
               ? search_minimum_slice_perimeters(surface.tracer, o.search, o.execution)
               : compute_minimum_slice_perimeters(surface.tracer, o.sampling, o.execution);
  });
}

void refuse_other_surface(const Surface& surface, std::size_t entries, const char* name) {
  if (static_cast<Index>(entries) != surface.snapshot.vertex_count())
    throw UsageError(std::string(name) + ": made on a surface of " + std::to_string(entries) +
                     " vertices, not of " + std::to_string(surface.snapshot.vertex_count()));
}

void slice_errors(const Surface& surface, VertexSlices& slices, const Options& options) {
  refuse_other_surface(surface, slices.valid.size(), "slices");
  watched(options, [&](const ExtractOptions& o) {
    compute_slice_errors(surface.tracer, o.error, slices, o.execution);
  });
}

void refine(const Surface& surface, VertexSlices& slices, const Options& options) {
  refuse_other_surface(surface, slices.valid.size(), "slices");
  watched(options, [&](const ExtractOptions& o) {
    refine_slices(surface.tracer, o.sampling, o.cone, slices, o.execution);
  });
}

SkeletonMesh skeletal_points(const Surface& surface, const VertexSlices& slices, const Options& options) {
  refuse_other_surface(surface, slices.valid.size(), "slices");
  return watched(options, [&](const ExtractOptions& o) {
    SkeletonMeshOptions points = o.points;
    points.solid = &surface.solid;
    SkeletonMesh mesh = make_skeleton_mesh(surface.tracer, slices, points, o.execution);
    if (o.coherence.enabled) apply_spatial_coherence(surface.snapshot, o.coherence, mesh);
    return mesh;
  });
}

VolumeCocycles cocycles(const Surface& surface, const VertexSlices& slices, const Options& options) {
  refuse_other_surface(surface, slices.valid.size(), "slices");
  return watched(options, [&](const ExtractOptions& o) {
    return compute_volume_cocycles(surface.snapshot, slice_candidates(slices), o.cocycles,
                                   o.execution.progress);
  });
}

CollapsedSkeleton collapse(const Surface& surface, const SkeletonMesh& mesh, const VolumeCocycles& cocycles,
                           const Options& options) {
  return watched(options, [&](const ExtractOptions& o) {
    CollapsedSkeleton collapsed =
        collapse_skeleton_mesh(surface.snapshot, mesh, cocycles.label, o.collapse, o.execution);
    return o.filter_branches ? std::move(filter_branches(collapsed, o.filter).skeleton)
                             : std::move(collapsed);
  });
}

Tips limb_tips(const Surface& surface, const VertexSlices& slices, const Options& options) {
  refuse_other_surface(surface, slices.valid.size(), "slices");
  return watched(options, [&](const ExtractOptions& o) {
    return Tips{find_limb_tips(surface.snapshot, surface.solid, slices, o.refinement.limbs, o.execution)};
  });
}

std::unique_ptr<Arcs> arcs(const CollapsedSkeleton& collapsed, const VolumeCocycles& cocycles) {
  auto arcs = std::make_unique<Arcs>();
  ArcTubes tubes;
  arcs->graph = make_arc_graph(collapsed, tubes);
  if (cocycles.rank == 0 || collapsed.label_of_vertex.empty()) return arcs;
  CollapseTubes known;
  known.arcs = std::move(tubes);
  known.halfedge = cocycles.label;
  known.node_of_vertex = collapsed.node_of_vertex;
  known.to_vertex = collapsed.label_of_vertex;
  arcs->classes = {CrossingLabels(cocycles), std::move(known)};
  return arcs;
}

void refine_all(Arcs& arcs, const Surface& surface, const VertexSlices& slices, const Tips& tips,
                const Options& options) {
  refuse_other_surface(surface, slices.valid.size(), "slices");
  watched(options, [&](const ExtractOptions& o) {
    const RefinementOptions& refinement = o.refinement;
    refine_arcs(arcs.graph, surface.snapshot, surface.snapshot, surface.solid, slices, tips.tips, refinement,
                o.execution, arcs.classes);
    reach_digits(arcs.graph, surface.snapshot, surface.solid,
                 find_digits(arcs.graph, surface.snapshot, surface.solid, refinement.limbs, o.execution),
                 refinement.centering.step, refinement.joint_overlap, o.execution);
    if (refinement.node_spacing) space_nodes(arcs.graph, surface.solid, *refinement.node_spacing);
    if (refinement.nodes > 0)
      limit_nodes(arcs.graph, surface.solid, refinement.nodes, arcs.classes.crossings);
  });
}

CurveSkeleton finish(const Arcs& arcs, const Surface& surface, const SkeletonMesh& mesh,
                     const Options& options) {
  return watched(options, [&](const ExtractOptions& o) {
    return make_curve_skeleton(arcs.graph, surface.snapshot, surface.solid, mesh.perimeter, mesh.error,
                               o.execution);
  });
}

View<double> to_model(const Surface& surface, const Points& points) {
  std::vector<Vector3> moved = copied(points);
  for (Vector3& x : moved) x = surface.snapshot.frame.to_model(x);
  return given_away(std::move(moved));
}

View<double> contour(const Surface& surface, const VertexSlices& slices, Index vertex) {
  refuse_other_surface(surface, slices.valid.size(), "slices");
  if (vertex < 0 || vertex >= surface.snapshot.vertex_count())
    throw UsageError("vertex: expected 0 to " + std::to_string(surface.snapshot.vertex_count() - 1));
  Contour found;
  slice_contour(surface.tracer, slices, vertex, found);
  return given_away(std::move(found.point));
}

// A property that shows `member` as an array and takes another one of the same length.
template <class Class, class Given, class Value>
void array_property(nb::class_<Class>& bound, const char* name, std::vector<Value> Class::*member) {
  bound.def_prop_rw(
      name, [member](const Class& self) { return view(self.*member, nb::find(self)); },
      [member, name](Class& self, const Given& given) { replace(self.*member, given, name); });
}

void bind_surface(nb::module_& module) {
  using Self = const Surface&;
  nb::class_<Surface>(module, "Surface", "A closed surface in its normalised frame.")
      .def_prop_ro("points", [](Self s) { return view(s.snapshot.position, nb::find(s)); })
      .def_prop_ro("normals", [](Self s) { return view(s.snapshot.normal, nb::find(s)); })
      .def_prop_ro("areas", [](Self s) { return view(s.snapshot.vertex_area, nb::find(s)); })
      .def_prop_ro("faces",
                   [](Self s) {
                     const std::vector<Index>& corners = s.snapshot.origin;
                     return View<Index>(corners.data(), {corners.size() / 3, 3}, nb::find(s));
                   })
      .def_prop_ro("scale", [](Self s) { return s.snapshot.frame.scale; })
      .def("to_model", &to_model, nb::arg("points"), "Points of the frame in the mesh's own coordinates.")
      .def("contour", &contour, nb::arg("slices"), nb::arg("vertex"),
           "The slice of a vertex as a closed polygon.");
}

void bind_values(nb::module_& module) {
  nb::class_<VertexSlices> slices(module, "Slices", "One slice a vertex.");
  array_property<VertexSlices, List<double>>(slices, "perimeter", &VertexSlices::perimeter);
  array_property<VertexSlices, Points>(slices, "normal", &VertexSlices::normal);
  array_property<VertexSlices, Points>(slices, "centre", &VertexSlices::centre);
  array_property<VertexSlices, List<double>>(slices, "area", &VertexSlices::area);
  array_property<VertexSlices, List<double>>(slices, "error", &VertexSlices::error);
  array_property<VertexSlices, List<std::uint8_t>>(slices, "valid", &VertexSlices::valid);
  slices.def_prop_ro("contour_points",
                     [](const VertexSlices& s) { return view(s.contour_points, nb::find(s)); });

  nb::class_<SkeletonMesh> mesh(module, "SkeletonMesh", "Every vertex at its skeletal point.");
  array_property<SkeletonMesh, Points>(mesh, "points", &SkeletonMesh::position);
  array_property<SkeletonMesh, List<double>>(mesh, "perimeter", &SkeletonMesh::perimeter);
  array_property<SkeletonMesh, Points>(mesh, "normal", &SkeletonMesh::normal);
  array_property<SkeletonMesh, List<double>>(mesh, "error", &SkeletonMesh::error);
  array_property<SkeletonMesh, List<std::uint8_t>>(mesh, "valid", &SkeletonMesh::valid);

  nb::class_<VolumeCocycles>(module, "Cocycles", "What tells one way round a handle from another.")
      .def_ro("rank", &VolumeCocycles::rank)
      .def_prop_ro("genus", [](const VolumeCocycles& c) { return c.genus; });

  nb::class_<Tips>(module, "LimbTips", "Where limbs end.")
      .def("__len__", [](const Tips& t) { return t.tips.size(); })
      .def_prop_ro(
          "vertices",
          [](const Tips& t) {
            std::vector<Index> vertices;
            for (const LimbTip& tip : t.tips) vertices.push_back(tip.vertex);
            return given_away(std::move(vertices));
          },
          nb::rv_policy::automatic)
      .def_prop_ro(
          "points",
          [](const Tips& t) {
            std::vector<Vector3> points;
            for (const LimbTip& tip : t.tips) points.push_back(tip.position);
            return given_away(std::move(points));
          },
          nb::rv_policy::automatic);
}

View<double> collapsed_points(const CollapsedSkeleton& collapsed) {
  std::vector<Vector3> points;
  for (const CollapsedNode& node : collapsed.nodes) points.push_back(node.position);
  return given_away(std::move(points));
}

View<Index> collapsed_edges(const CollapsedSkeleton& collapsed) {
  std::vector<std::array<Index, 2>> edges;
  for (const CollapsedEdge& edge : collapsed.edges) edges.push_back({edge.first, edge.second});
  return given_away(std::move(edges));
}

void bind_graphs(nb::module_& module) {
  nb::class_<CollapsedSkeleton>(module, "Collapsed",
                                "What is left of the skeleton mesh; edges may be parallel.")
      .def_prop_ro("points", &collapsed_points, nb::rv_policy::automatic)
      .def_prop_ro("edges", &collapsed_edges, nb::rv_policy::automatic)
      .def_prop_ro("node_of_vertex",
                   [](const CollapsedSkeleton& c) { return view(c.node_of_vertex, nb::find(c)); });
  nb::class_<Arcs>(module, "Arcs", "Hubs, and curves between them.")
      .def("__len__", [](const Arcs& a) { return a.graph.arcs.size(); })
      .def_prop_ro(
          "alive",
          [](const Arcs& a) {
            std::vector<std::uint8_t> alive;
            for (const Arc& arc : a.graph.arcs) alive.push_back(arc.alive ? 1 : 0);
            return given_away(std::move(alive));
          },
          nb::rv_policy::automatic)
      .def_prop_ro("hubs", [](const Arcs& a) { return view(a.graph.hub_position, nb::find(a)); })
      .def(
          "ends", [](const Arcs& a, std::size_t arc) { return a.graph.arcs.at(arc).hub; }, nb::arg("arc"))
      .def(
          "points",
          [](const Arcs& a, std::size_t arc) {
            return given_away(std::vector<Vector3>(a.graph.arcs.at(arc).points));
          },
          nb::arg("arc"))
      .def(
          "set_points",
          [](Arcs& a, std::size_t arc, const Points& points) {
            if (points.shape(0) < 2) throw UsageError("points: an arc has at least its two ends");
            a.graph.arcs.at(arc).points = copied(points);
          },
          nb::arg("arc"), nb::arg("points"), "The first and last point are those of the arc's hubs.");
}

}  // namespace

void bind_stages(nb::module_& module) {
  bind_surface(module);
  bind_values(module);
  bind_graphs(module);
  module.def("make_surface", &make_surface, nb::arg("soup"), nb::arg("options"));
  module.def("coarsen", &coarsen, nb::arg("surface"), nb::arg("options"));
  module.def("slices", &slices, nb::arg("surface"), nb::arg("options"));
  module.def("slice_errors", &slice_errors, nb::arg("surface"), nb::arg("slices"), nb::arg("options"));
  module.def("refine_slices", &refine, nb::arg("surface"), nb::arg("slices"), nb::arg("options"));
  module.def("skeletal_points", &skeletal_points, nb::arg("surface"), nb::arg("slices"), nb::arg("options"));
  module.def("cocycles", &cocycles, nb::arg("surface"), nb::arg("slices"), nb::arg("options"));
  module.def("collapse", &collapse, nb::arg("surface"), nb::arg("mesh"), nb::arg("cocycles"),
             nb::arg("options"));
  module.def("limb_tips", &limb_tips, nb::arg("surface"), nb::arg("slices"), nb::arg("options"));
  module.def("arcs", &arcs, nb::arg("collapsed"), nb::arg("cocycles"));
  module.def("refine_arcs", &refine_all, nb::arg("arcs"), nb::arg("surface"), nb::arg("slices"),
             nb::arg("tips"), nb::arg("options"));
  module.def("finish", &finish, nb::arg("arcs"), nb::arg("surface"), nb::arg("mesh"), nb::arg("options"));
}

}  // namespace mspskel::python
