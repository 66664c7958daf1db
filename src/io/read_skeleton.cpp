#include "mspskel/io/read_skeleton.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>
#include <unordered_map>

#include "mesh_parsers.h"
#include "mspskel/base/error.h"
#include "read_bytes.h"
#include "text_scanner.h"

namespace mspskel {
namespace {

using detail::Syntax;
using detail::TextScanner;

constexpr const char* kReadable = "skeletons are read from .skel .obj .ply .json .swc .cgal .polylines.txt";

// Sorted, each once; throws by calling fail(message) for an edge that no graph has.
template <class Fail>
void add_edge(CurveSkeleton& skeleton, std::int64_t a, std::int64_t b, std::int64_t count, Fail fail) {
  for (const std::int64_t v : {a, b})
    if (v < 0 || v >= count)
      fail("node index " + std::to_string(v) + " is out of range, there are " + std::to_string(count) +
           " nodes");
  if (a == b) fail("node " + std::to_string(a) + " has an edge to itself");
  skeleton.edges.push_back({static_cast<Index>(std::min(a, b)), static_cast<Index>(std::max(a, b))});
}
void sort_edges(CurveSkeleton& skeleton) {
  std::sort(skeleton.edges.begin(), skeleton.edges.end());
  skeleton.edges.erase(std::unique(skeleton.edges.begin(), skeleton.edges.end()), skeleton.edges.end());
}

CurveSkeleton parse_skel(std::string_view bytes) {
  TextScanner scan(bytes, Syntax::kHashComments);
  const auto fail = [&](const std::string& message) { scan.fail(scan.position(), message); };
  scan.skip_blank();
  const char* start = scan.position();
  if (scan.word() != "ID") scan.fail(start, "the first line does not start with ID");
  scan.skip_line();
  const std::int64_t count = scan.integer("the number of nodes");
  // A node takes six numbers of at least two bytes each.
  if (count < 0 || static_cast<std::uint64_t>(count) > scan.room_for(12))
    fail("there cannot be " + std::to_string(count) + " nodes here");
  CurveSkeleton skeleton;
  skeleton.nodes.resize(static_cast<std::size_t>(count));
  for (std::int64_t i = 0; i < count; ++i) {
    const std::int64_t id = scan.integer("a node's number");
    if (id != i) fail("expected node " + std::to_string(i) + ", found " + std::to_string(id));
    SkeletonNode& node = skeleton.nodes[static_cast<std::size_t>(i)];
    for (int k = 0; k < 3; ++k) node.position[k] = scan.coordinate("a coordinate");
    node.radius = scan.coordinate("a radius");
    const std::int64_t neighbors = scan.integer("the number of neighbours");
    if (neighbors < 0 || static_cast<std::uint64_t>(neighbors) > scan.room_for(2))
      fail("a node cannot have " + std::to_string(neighbors) + " neighbours here");
    for (std::int64_t n = 0; n < neighbors; ++n)
      add_edge(skeleton, i, scan.integer("a neighbour"), count, fail);
  }
  if (scan.skip_blank()) fail("there is more after the last node");
  sort_edges(skeleton);
  return skeleton;
}

// v and l records; negative indices count from the last v.
CurveSkeleton parse_obj(std::string_view bytes) {
  TextScanner scan(bytes, Syntax::kHashComments);
  CurveSkeleton skeleton;
  struct Link {
    std::int64_t a, b;
    const char* at;
  };
  std::vector<Link> links;  // may name nodes that come later
  while (scan.skip_blank()) {
    const std::string_view tag = scan.word();
    if (tag == "v") {
      SkeletonNode node;
      for (int k = 0; k < 3; ++k) {
        if (!scan.skip_spaces()) scan.fail_expected("a coordinate");
        node.position[k] = scan.coordinate_here("a coordinate");
      }
      skeleton.nodes.push_back(node);
    } else if (tag == "l") {
      std::int64_t last = -1;
      while (scan.skip_spaces()) {
        const char* at = scan.position();
        const std::int64_t index = scan.integer_here("a node index");
        if (index == 0) scan.fail(at, "node index 0 is out of range, indices start from 1");
        const std::int64_t v =
            index < 0 ? static_cast<std::int64_t>(skeleton.nodes.size()) + index : index - 1;
        if (v < 0) scan.fail(at, "node index " + std::to_string(index) + " is out of range");
        if (last >= 0) links.push_back({last, v, at});
        last = v;
      }
    }
    scan.skip_line();
  }
  for (const Link& link : links)
    add_edge(skeleton, link.a, link.b, static_cast<std::int64_t>(skeleton.nodes.size()),
             [&](const std::string& message) { scan.fail(link.at, message); });
  sort_edges(skeleton);
  return skeleton;
}

CurveSkeleton parse_ply_skeleton(std::string_view bytes) {
  const detail::PlyGraph graph = detail::parse_ply_graph(bytes);
  CurveSkeleton skeleton;
  skeleton.nodes.resize(graph.points.size());
  for (std::size_t v = 0; v < graph.points.size(); ++v) {
    skeleton.nodes[v].position = graph.points[v];
    if (!graph.radius.empty()) skeleton.nodes[v].radius = graph.radius[v];
  }
  const auto count = static_cast<std::int64_t>(graph.points.size());
  for (std::size_t e = 0; e < graph.edges.size(); ++e)
    add_edge(skeleton, graph.edges[e][0], graph.edges[e][1], count, [e](const std::string& message) {
      throw ReadError("edge " + std::to_string(e) + ": " + message);
    });
  sort_edges(skeleton);
  return skeleton;
}

// A comment line's cut edge, if it is one, and to the end of the line.
void read_swc_comment(TextScanner& scan, std::vector<std::array<std::int64_t, 2>>& links) {
  for (const char* word : {"#", "cut", "edge"}) {
    if (scan.word() != word) return scan.skip_line();
    scan.skip_spaces();
  }
  const std::int64_t a = scan.integer_here("a node's number");
  if (!scan.skip_spaces()) scan.fail_expected("a node's number");
  links.push_back({a, scan.integer_here("a node's number")});
  scan.skip_line();
}

// Nodes have any numbers, in any order; -1 as parent means none. The writer's cut edges close their loops.
CurveSkeleton parse_swc(std::string_view bytes) {
  TextScanner scan(bytes, Syntax::kPlain);
  CurveSkeleton skeleton;
  std::unordered_map<std::int64_t, std::int64_t> node_of;
  std::vector<std::array<std::int64_t, 2>> links;
  while (scan.skip_blank()) {
    const char* line = scan.position();
    if (*line == '#') {
      read_swc_comment(scan, links);
      continue;
    }
    const std::int64_t id = scan.integer_here("a node's number");
    const auto here = [&](const char* what) {
      if (!scan.skip_spaces()) scan.fail_expected(what);
    };
    if (!node_of.emplace(id, static_cast<std::int64_t>(skeleton.nodes.size())).second)
      scan.fail(line, "node " + std::to_string(id) + " is there twice");
    here("a type");
    scan.integer_here("a type");
    SkeletonNode node;
    for (double* number : {&node.position[0], &node.position[1], &node.position[2], &node.radius}) {
      here("a number");
      *number = scan.coordinate_here("a number");
    }
    here("a parent");
    const std::int64_t parent = scan.integer_here("a parent");
    if (parent != -1) links.push_back({id, parent});
    skeleton.nodes.push_back(node);
    if (scan.skip_spaces() && *scan.position() != '#') scan.fail_expected("the end of the line");
  }
  const auto fail = [](const std::string& message) { throw ReadError(message); };
  for (const auto& [a, b] : links) {
    const auto from = node_of.find(a), to = node_of.find(b);
    for (const auto& [found, id] : {std::pair{from, a}, std::pair{to, b}})
      if (found == node_of.end()) fail("there is no node " + std::to_string(id));
    if (a == b) fail("node " + std::to_string(a) + " is its own parent");
    add_edge(skeleton, from->second, to->second, static_cast<std::int64_t>(skeleton.nodes.size()), fail);
  }
  sort_edges(skeleton);
  return skeleton;
}

// Lines of `n x1 y1 z1 ...`; points in the same place are one node.
CurveSkeleton parse_polylines(std::string_view bytes) {
  TextScanner scan(bytes, Syntax::kPlain);
  CurveSkeleton skeleton;
  std::map<std::tuple<double, double, double>, std::int64_t> node_at;
  while (scan.skip_blank()) {
    const char* line = scan.position();
    const std::int64_t count = scan.integer_here("the number of points");
    if (count < 1 || static_cast<std::uint64_t>(count) > scan.room_for(6))
      scan.fail(line, "there cannot be " + std::to_string(count) + " points here");
    std::int64_t last = -1;
    for (std::int64_t i = 0; i < count; ++i) {
      SkeletonNode node;
      for (int k = 0; k < 3; ++k) {
        if (!scan.skip_spaces()) scan.fail_expected("a coordinate");
        node.position[k] = scan.coordinate_here("a coordinate");
      }
      const auto next = static_cast<std::int64_t>(skeleton.nodes.size());
      const auto& [found, is_new] =
          node_at.emplace(std::tuple(node.position[0], node.position[1], node.position[2]), next);
      if (is_new) skeleton.nodes.push_back(node);
      if (last >= 0)
        add_edge(skeleton, last, found->second, next + 1,
                 [&](const std::string& message) { scan.fail(line, message); });
      last = found->second;
    }
    if (scan.skip_spaces()) scan.fail_expected("the end of the line");
  }
  sort_edges(skeleton);
  return skeleton;
}

using nlohmann::json;

double number_of(const json& value, const char* what) {
  if (!value.is_number() || !std::isfinite(value.get<double>()))
    throw ReadError(std::string(what) + " is not a finite number");
  return value.get<double>();
}
std::int64_t integer_of(const json& value, const char* what) {
  if (!value.is_number_integer()) throw ReadError(std::string(what) + " is not an integer");
  return value.get<std::int64_t>();
}
const json& array_of(const json& document, const char* name) {
  const auto found = document.find(name);
  if (found == document.end() || !found->is_array())
    throw ReadError(std::string("there is no array \"") + name + "\"");
  return *found;
}

SkeletonNode node_of(const json& value) {
  if (!value.is_object()) throw ReadError("a node is not an object");
  SkeletonNode node;
  const json& position = array_of(value, "position");
  if (position.size() != 3) throw ReadError("a node's position has not three coordinates");
  for (int k = 0; k < 3; ++k)
    node.position[k] = number_of(position[static_cast<std::size_t>(k)], "a coordinate");
  const auto read = [&](const char* name, double& target) {
    const auto found = value.find(name);
    if (found != value.end() && !found->is_null()) target = number_of(*found, name);
  };
  read("radius", node.radius);
  read("area", node.area);
  read("perimeter", node.perimeter);
  read("slice_error", node.slice_error);
  return node;
}

CurveSkeleton parse_json(std::string_view bytes) {
  json document;
  try {
    document = json::parse(bytes);
  } catch (const json::exception& error) {
    throw ReadError(error.what());  // it names line and column
  }
  if (!document.is_object()) throw ReadError("the document is not an object");
  CurveSkeleton skeleton;
  for (const json& node : array_of(document, "nodes")) skeleton.nodes.push_back(node_of(node));
  const auto count = static_cast<std::int64_t>(skeleton.nodes.size());
  for (const json& edge : array_of(document, "edges")) {
    if (!edge.is_object() || !edge.contains("source") || !edge.contains("target"))
      throw ReadError("an edge has no source and target");
    add_edge(skeleton, integer_of(edge["source"], "an edge's source"),
             integer_of(edge["target"], "an edge's target"), count,
             [](const std::string& message) { throw ReadError(message); });
  }
  if (document.contains("node_of_vertex")) {
    for (const json& value : array_of(document, "node_of_vertex")) {
      const std::int64_t node = integer_of(value, "an entry of node_of_vertex");
      if (node < kNone || node >= count) throw ReadError("node_of_vertex names node " + std::to_string(node));
      skeleton.node_of_vertex.push_back(static_cast<Index>(node));
    }
  }
  sort_edges(skeleton);
  return skeleton;
}

}  // namespace

CurveSkeleton read_skeleton(std::string_view bytes, SkeletonFormat format) {
  switch (format) {
    case SkeletonFormat::kSkel:
      return parse_skel(bytes);
    case SkeletonFormat::kObj:
      return parse_obj(bytes);
    case SkeletonFormat::kPly:
      return parse_ply_skeleton(bytes);
    case SkeletonFormat::kJson:
      return parse_json(bytes);
    case SkeletonFormat::kSwc:
      return parse_swc(bytes);
    case SkeletonFormat::kPolylines:
      return parse_polylines(bytes);
    case SkeletonFormat::kVtp:
    case SkeletonFormat::kGraphml:
      break;
  }
  throw UsageError(kReadable);
}

CurveSkeleton read_skeleton(const std::string& path) {
  const SkeletonFormat format = skeleton_format_of(path);
  if (format == SkeletonFormat::kVtp || format == SkeletonFormat::kGraphml)
    throw UsageError("cannot read " + path + ": " + kReadable);
  const std::string bytes = detail::read_bytes(path);
  try {
    return read_skeleton(bytes, format);
  } catch (const ReadError& error) {
    throw ReadError((path == "-" ? "standard input" : path) + ": " + error.what());
  }
}

}  // namespace mspskel
