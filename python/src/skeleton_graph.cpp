// CurveSkeleton: what writers, checks and trees are made from.
#include <nanobind/stl/array.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <array>

#include "arrays.h"
#include "bindings.h"
#include "mspskel/io/atomic_file.h"
#include "mspskel/io/read_skeleton.h"
#include "mspskel/io/write_skeleton.h"
#include "mspskel/samples/samples.h"
#include "mspskel/skeleton/check_skeleton.h"
#include "mspskel/skeleton/spanning_forest.h"

namespace mspskel::python {
namespace {

CurveSkeleton make_graph(const Points& positions, const Rows<Index>& edges, const Rows<double>& values,
                         const List<Index>& node_of_vertex) {
  if (edges.shape(1) != 2) throw UsageError("edges: expected two nodes a row");
  if (values.shape(0) != positions.shape(0) || values.shape(1) != 4)
    throw UsageError("values: expected radius, area, perimeter and slice error a node");
  CurveSkeleton graph;
  graph.nodes.resize(positions.shape(0));
  for (std::size_t i = 0; i < graph.nodes.size(); ++i)
    graph.nodes[i] = {{positions(i, 0), positions(i, 1), positions(i, 2)},
                      values(i, 0),
                      values(i, 1),
                      values(i, 2),
                      values(i, 3)};
  for (std::size_t i = 0; i < edges.shape(0); ++i)
    graph.edges.push_back({std::min(edges(i, 0), edges(i, 1)), std::max(edges(i, 0), edges(i, 1))});
  std::sort(graph.edges.begin(), graph.edges.end());
  graph.edges.erase(std::unique(graph.edges.begin(), graph.edges.end()), graph.edges.end());
  graph.node_of_vertex = copied(node_of_vertex);
  validate(graph);
  return graph;
}

constexpr std::size_t kStride = sizeof(SkeletonNode) / sizeof(double);
static_assert(sizeof(SkeletonNode) == 7 * sizeof(double), "nodes are rows of doubles");

View<double> node_values(const CurveSkeleton& graph, double SkeletonNode::*value) {
  const double* first = graph.nodes.empty() ? nullptr : &(graph.nodes.front().*value);
  return View<double>(first, {graph.nodes.size()}, nb::find(graph), {kStride});
}

View<double> node_positions(const CurveSkeleton& graph) {
  const double* first = graph.nodes.empty() ? nullptr : graph.nodes.front().position.data();
  return View<double>(first, {graph.nodes.size(), 3}, nb::find(graph), {kStride, 1});
}

std::vector<View<Index>> branch_arrays(const CurveSkeleton& graph) {
  std::vector<View<Index>> result;
  for (Branch& branch : branches(graph)) result.push_back(given_away(std::move(branch.nodes)));
  return result;
}

nb::bytes as_bytes(const std::string& text) { return nb::bytes(text.data(), text.size()); }

void bind_files(nb::module_& module) {
  module.def(
      "read_skeleton", [](const std::string& path) { return read_skeleton(path); }, nb::arg("path"));
  module.def(
      "format_skeleton",
      [](const CurveSkeleton& graph, const std::string& path, const std::string& report) {
        return as_bytes(format_skeleton(graph, skeleton_format_of(path), report));
      },
      nb::arg("graph"), nb::arg("path"), nb::arg("report") = "", "The bytes of a file of that name.");
  module.def(
      "write_file",
      [](const std::string& path, const nb::bytes& bytes) {
        write_file_atomically(path, {bytes.c_str(), bytes.size()});
      },
      nb::arg("path"), nb::arg("bytes"), "Whole or not at all.");
  module.def(
      "losses_of_format",
      [](const CurveSkeleton& graph, const std::string& path) {
        return losses_of_format(graph, skeleton_format_of(path));
      },
      nb::arg("graph"), nb::arg("path"));
}

// The word of --section on the command line.
Section section_of(const std::string& word) {
  if (word == "own") return Section::kOwn;
  if (word == "square") return Section::kSquare;
  if (word == "round") return Section::kRound;
  throw UsageError("section must be own, square or round, not '" + word + "'");
}

template <class Result>
auto of_sample(Result (*make)(const std::string&, const SampleOptions&)) {
  return [make](const std::string& name, Index resolution, double jitter, std::uint64_t seed, Index count,
                double ratio, const std::array<double, 3>& sides, const std::string& section, bool sparse) {
    SampleOptions options;
    options.resolution = resolution;
    options.jitter = jitter;
    options.seed = seed;
    options.count = count;
    options.ratio = ratio;
    options.sides = {sides[0], sides[1], sides[2]};
    options.section = section_of(section);
    options.sparse = sparse;
    const nb::gil_scoped_release unlocked;
    return make(name, options);
  };
}

template <class Function>
void define_of_sample(nb::module_& module, const char* name, const Function& function) {
  module.def(name, function, nb::arg("name"), nb::arg("resolution") = 0, nb::arg("jitter") = 0.0,
             nb::arg("seed") = 1, nb::arg("count") = kNone, nb::arg("ratio") = 0.0,
             nb::arg("sides") = std::array<double, 3>{0, 0, 0}, nb::arg("section") = "own",
             nb::arg("sparse") = false);
}

void bind_samples(nb::module_& module) {
  define_of_sample(module, "make_sample", of_sample(&make_sample));
  define_of_sample(module, "sample_truth", of_sample(&sample_truth));
  module.def("sample_names", [] {
    std::vector<std::string> names;
    for (const SampleInfo& info : list_samples()) names.push_back(info.name);
    return names;
  });
}

}  // namespace

void bind_skeleton_graph(nb::module_& module) {
  nb::class_<CurveSkeleton>(module, "Graph", "Nodes, straight edges and the map from the mesh.")
      .def(
          "__init__",
          [](CurveSkeleton* self, const Points& positions, const Rows<Index>& edges,
             const Rows<double>& values, const List<Index>& node_of_vertex) {
            new (self) CurveSkeleton(make_graph(positions, edges, values, node_of_vertex));
          },
          nb::arg("positions"), nb::arg("edges"), nb::arg("values"), nb::arg("node_of_vertex"))
      .def_prop_ro("positions", &node_positions)
      .def_prop_ro("radius", [](const CurveSkeleton& g) { return node_values(g, &SkeletonNode::radius); })
      .def_prop_ro("area", [](const CurveSkeleton& g) { return node_values(g, &SkeletonNode::area); })
      .def_prop_ro("perimeter",
                   [](const CurveSkeleton& g) { return node_values(g, &SkeletonNode::perimeter); })
      .def_prop_ro("slice_error",
                   [](const CurveSkeleton& g) { return node_values(g, &SkeletonNode::slice_error); })
      .def_prop_ro("edges", [](const CurveSkeleton& g) { return view(g.edges, nb::find(g)); })
      .def_prop_ro("node_of_vertex",
                   [](const CurveSkeleton& g) { return view(g.node_of_vertex, nb::find(g)); })
      .def("branches", &branch_arrays, "Nodes of each maximal chain, ends included.")
      .def(
          "forest",
          [](const CurveSkeleton& g) {
            SpanningForest forest = span(g);
            return std::make_pair(given_away(std::move(forest.parent)), given_away(std::move(forest.cut)));
          },
          "Parent of every node, -1 at roots, and the edges that are no part of the trees.");
  bind_files(module);
  bind_samples(module);
}

}  // namespace mspskel::python
