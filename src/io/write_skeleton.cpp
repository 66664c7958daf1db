#include "mspskel/io/write_skeleton.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "append_text.h"
#include "mesh_parsers.h"
#include "mspskel/base/error.h"
#include "mspskel/base/near_name.h"
#include "mspskel/io/atomic_file.h"
#include "write_vtp.h"

namespace mspskel {
namespace {

using OrderedJson = nlohmann::ordered_json;

using detail::append;
using detail::append_all;

struct Extension {
  const char* text;
  SkeletonFormat format;
};
constexpr Extension kExtensions[] = {{".skel", SkeletonFormat::kSkel},
                                     {".obj", SkeletonFormat::kObj},
                                     {".ply", SkeletonFormat::kPly},
                                     {".json", SkeletonFormat::kJson},
                                     {".swc", SkeletonFormat::kSwc},
                                     {".vtp", SkeletonFormat::kVtp},
                                     {".graphml", SkeletonFormat::kGraphml},
                                     {".cgal", SkeletonFormat::kPolylines},
                                     {".polylines.txt", SkeletonFormat::kPolylines}};

std::string format_skel(const CurveSkeleton& skeleton) {
  std::string out = "ID Cx Cy Cz RADIUS #NEIGHBORS NEIGHBORS_LIST\n";
  append_all(out, skeleton.nodes.size(), '\n');
  const auto neighbors = adjacency(skeleton);
  for (std::size_t v = 0; v < skeleton.nodes.size(); ++v) {
    append_all(out, v, ' ', skeleton.nodes[v].position, ' ', skeleton.nodes[v].radius, ' ',
               neighbors[v].size());
    for (const Index w : neighbors[v]) append_all(out, ' ', w);
    out += '\n';
  }
  return out;
}

std::string format_obj(const CurveSkeleton& skeleton) {
  std::string out;
  for (const SkeletonNode& node : skeleton.nodes) append_all(out, "v ", node.position, '\n');
  for (const auto& [a, b] : skeleton.edges) append_all(out, "l ", a + 1, ' ', b + 1, '\n');
  return out;
}

std::string format_ply(const CurveSkeleton& skeleton) {
  std::string out = "ply\nformat ascii 1.0\n";
  append_all(out, "element vertex ", skeleton.nodes.size(),
             "\nproperty double x\nproperty double y\nproperty double z\nproperty double radius\n");
  append_all(out, "element edge ", skeleton.edges.size(),
             "\nproperty int vertex1\nproperty int vertex2\nend_header\n");
  for (const SkeletonNode& node : skeleton.nodes) append_all(out, node.position, ' ', node.radius, '\n');
  for (const auto& [a, b] : skeleton.edges) append_all(out, a, ' ', b, '\n');
  return out;
}

std::string format_json(const CurveSkeleton& skeleton, const std::string& report) {
  OrderedJson nodes = OrderedJson::array(), edges = OrderedJson::array(), arcs = OrderedJson::array();
  for (std::size_t v = 0; v < skeleton.nodes.size(); ++v) {
    const SkeletonNode& node = skeleton.nodes[v];
    nodes.push_back({{"id", v},
                     {"position", {node.position[0], node.position[1], node.position[2]}},
                     {"radius", node.radius},
                     {"area", node.area},
                     {"perimeter", node.perimeter},
                     {"slice_error", node.slice_error}});
  }
  for (const auto& [a, b] : skeleton.edges) edges.push_back({{"source", a}, {"target", b}});
  for (const Branch& branch : branches(skeleton)) arcs.push_back(branch.nodes);
  OrderedJson document{{"directed", false}, {"multigraph", false}, {"graph", {{"name", "curve skeleton"}}}};
  document["nodes"] = std::move(nodes);
  document["edges"] = std::move(edges);
  document["branches"] = std::move(arcs);
  document["node_of_vertex"] = skeleton.node_of_vertex;
  if (!report.empty()) {
    OrderedJson parsed = OrderedJson::parse(report, nullptr, false);
    if (parsed.is_discarded()) throw UsageError("the report for a JSON skeleton is not JSON");
    document["report"] = std::move(parsed);
  }
  return document.dump(1, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

// Types: 1 soma, 5 fork, 6 end, 0 else.
std::string format_swc(const CurveSkeleton& skeleton, const RootChoice& root) {
  const SpanningForest forest = span(skeleton, root);
  std::vector<Index> id(skeleton.nodes.size()), children(skeleton.nodes.size(), 0);
  for (std::size_t i = 0; i < forest.order.size(); ++i) id[forest.order[i]] = static_cast<Index>(i + 1);
  for (const Index parent : forest.parent)
    if (parent != kNone) ++children[parent];
  std::string out = "# index type x y z radius parent\n";
  for (const auto& [a, b] : forest.cut) append_all(out, "# cut edge ", id[a], ' ', id[b], '\n');
  for (const Index v : forest.order) {
    const Index parent = forest.parent[v], ways = children[v] + (parent != kNone);
    const bool soma = parent == kNone && is_soma(skeleton, v);
    const Index type = soma ? 1 : ways > 2 ? 5 : ways == 1 ? 6 : 0;
    append_all(out, id[v], ' ', type, ' ', skeleton.nodes[v].position, ' ', skeleton.nodes[v].radius, ' ',
               parent == kNone ? Index{-1} : id[parent], '\n');
  }
  return out;
}

std::vector<Index> isolated_nodes(const CurveSkeleton& skeleton) {
  std::vector<char> used(skeleton.nodes.size(), 0);
  for (const auto& [a, b] : skeleton.edges) used[a] = used[b] = 1;
  std::vector<Index> result;
  for (Index v = 0; v < static_cast<Index>(used.size()); ++v)
    if (!used[v]) result.push_back(v);
  return result;
}

std::string format_polylines(const CurveSkeleton& skeleton) {
  std::string out;
  for (const Branch& branch : branches(skeleton)) {
    append(out, branch.nodes.size());
    for (const Index v : branch.nodes) append_all(out, ' ', skeleton.nodes[v].position);
    out += '\n';
  }
  for (const Index v : isolated_nodes(skeleton)) append_all(out, "1 ", skeleton.nodes[v].position, '\n');
  return out;
}

std::string format_graphml(const CurveSkeleton& skeleton) {
  std::string out =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<graphml "
      "xmlns=\"http://graphml.graphdrawing.org/xmlns\">\n";
  const char* const names[] = {"x", "y", "z", "radius"};
  for (const char* name : names)
    append_all(out, "  <key id=\"", name, "\" for=\"node\" attr.name=\"", name,
               "\" attr.type=\"double\"/>\n");
  append(out, "  <graph id=\"skeleton\" edgedefault=\"undirected\">\n");
  for (std::size_t v = 0; v < skeleton.nodes.size(); ++v) {
    const SkeletonNode& node = skeleton.nodes[v];
    const double values[] = {node.position[0], node.position[1], node.position[2], node.radius};
    append_all(out, "    <node id=\"", v, "\">");
    for (int k = 0; k < 4; ++k) append_all(out, "<data key=\"", names[k], "\">", values[k], "</data>");
    append(out, "</node>\n");
  }
  for (const auto& [a, b] : skeleton.edges)
    append_all(out, "    <edge source=\"", a, "\" target=\"", b, "\"/>\n");
  return out + "  </graph>\n</graphml>\n";
}

}  // namespace

SkeletonFormat skeleton_format_of(const std::string& path) {
  if (path == "-") return SkeletonFormat::kSkel;
  for (const Extension& extension : kExtensions) {
    const std::string_view text = extension.text;
    if (path.size() > text.size() &&
        detail::equals_ignoring_case(std::string_view(path).substr(path.size() - text.size()), text))
      return extension.format;
  }
  throw unknown_extension("skeleton format", path, skeleton_extensions());
}

std::vector<std::string> skeleton_extensions() {
  std::vector<std::string> names;
  for (const Extension& extension : kExtensions) names.emplace_back(extension.text);
  return names;
}

void refuse_not_finite(const CurveSkeleton& skeleton) {
  for (std::size_t v = 0; v < skeleton.nodes.size(); ++v) {
    const SkeletonNode& node = skeleton.nodes[v];
    if (!node.position.allFinite() || !std::isfinite(node.radius) || !std::isfinite(node.area) ||
        !std::isfinite(node.perimeter) || !std::isfinite(node.slice_error))
      throw NoSkeletonError("node " + std::to_string(v) + " of the skeleton has a number that is not finite");
  }
}

std::string format_skeleton(const CurveSkeleton& skeleton, SkeletonFormat format, const std::string& report,
                            const RootChoice& root) {
  refuse_not_finite(skeleton);
  switch (format) {
    case SkeletonFormat::kSkel:
      return format_skel(skeleton);
    case SkeletonFormat::kObj:
      return format_obj(skeleton);
    case SkeletonFormat::kPly:
      return format_ply(skeleton);
    case SkeletonFormat::kJson:
      return format_json(skeleton, report);
    case SkeletonFormat::kSwc:
      return format_swc(skeleton, root);
    case SkeletonFormat::kVtp:
      return detail::format_vtp(skeleton, root);
    case SkeletonFormat::kGraphml:
      return format_graphml(skeleton);
    default:
      return format_polylines(skeleton);
  }
}

std::vector<std::string> losses_of_format(const CurveSkeleton& skeleton, SkeletonFormat format) {
  if (format != SkeletonFormat::kSwc) return {};
  const std::size_t cuts = span(skeleton).cut.size();
  if (cuts == 0) return {};
  return {"SWC holds trees only: " + std::to_string(cuts) +
          (cuts == 1 ? " loop was cut" : " loops were cut") + ", the cut edges are comments"};
}

void write_skeleton(const std::string& path, const CurveSkeleton& skeleton, const std::string& report,
                    const RootChoice& root) {
  write_file_atomically(path, format_skeleton(skeleton, skeleton_format_of(path), report, root));
}

}  // namespace mspskel
