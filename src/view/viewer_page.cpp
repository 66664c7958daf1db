#include "mspskel/view/viewer_page.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "../render/camera.h"
#include "base64.h"
#include "mspskel/base/error.h"
#include "mspskel/io/atomic_file.h"
#include "mspskel/mesh/surface_snapshot.h"
#include "mspskel/render/render.h"
#include "page_data.h"
#include "page_template.h"

namespace mspskel {
namespace {

using detail::PageData;
using Json = nlohmann::ordered_json;

// More marks than this at one sentence hide what they mark.
constexpr std::size_t kMostPlaces = 200;

void check_length(const char* name, std::size_t count, std::size_t vertices) {
  if (count != 0 && count != vertices)
    throw UsageError("the page's list " + std::string(name) + " has " + std::to_string(count) +
                     " entries for " + std::to_string(vertices) + " vertices");
}

void check_indices(const char* name, const std::vector<Index>& indices, Index least, std::size_t count) {
  for (std::size_t i = 0; i < indices.size(); ++i)
    if (indices[i] < least || (indices[i] != kNone && static_cast<std::size_t>(indices[i]) >= count))
      throw UsageError("entry " + std::to_string(i) + " of the page's " + name + " is " +
                       std::to_string(indices[i]) + ", which does not exist");
}

void check_positions(const char* name, const std::vector<Vector3>& positions) {
  for (std::size_t i = 0; i < positions.size(); ++i)
    if (!positions[i].allFinite())
      throw MeshError("the coordinates of " + std::string(name) + " " + std::to_string(i) +
                      " are not finite");
}

void validate_rig(const ViewerScene& scene) {
  const ViewerRig& rig = scene.rig;
  const std::size_t count = rig.names.size();
  if (count == 0) return;
  if (rig.parents.size() != count || rig.nodes.size() != count || rig.positions.size() != count)
    throw UsageError("the page's rig has " + std::to_string(count) +
                     " names and another number of parents, nodes or positions");
  const std::size_t influences = 4 * scene.surface.points.size();
  if (rig.joints.size() != influences || rig.weights.size() != influences)
    throw UsageError("the page's rig needs four joints and weights a vertex");
  check_indices("rig.joints", rig.joints, 0, count);
  check_indices("rig.nodes", rig.nodes, 0, scene.skeleton.nodes.size());
  check_positions("joint", rig.positions);
  for (std::size_t j = 0; j < count; ++j)
    check_indices("rig.parents", {rig.parents[j]}, j == 0 ? kNone : 0, j);
}

void validate(const ViewerScene& scene) {
  const std::size_t vertices = scene.surface.points.size();
  if (vertices == 0) throw UsageError("a page needs a surface: this one has no points");
  check_positions("vertex", scene.surface.points);
  for (std::size_t f = 0; f < scene.surface.polygon_count(); ++f)
    if (scene.surface.begin[f + 1] - scene.surface.begin[f] != 3)
      throw UsageError("polygon " + std::to_string(f) + " of the page's surface is no triangle");
  check_indices("corners", scene.surface.corners, 0, vertices);
  check_length("skeleton_mesh", scene.skeleton_mesh.size(), vertices);
  check_length("msp", scene.msp.size(), vertices);
  check_length("slice_error", scene.slice_error.size(), vertices);
  check_length("initial_msp", scene.initial_msp.size(), vertices);
  check_length("initial_slice_error", scene.initial_slice_error.size(), vertices);
  check_length("slice_normal", scene.slice_normal.size(), vertices);
  check_length("node_of_vertex", scene.skeleton.node_of_vertex.size(), vertices);
  check_indices("node_of_vertex", scene.skeleton.node_of_vertex, kNone, scene.skeleton.nodes.size());
  check_length("part_of_vertex", scene.part_of_vertex.size(), vertices);
  if (!scene.part_of_node.empty() && scene.part_of_node.size() != scene.skeleton.nodes.size())
    throw UsageError("the page's list part_of_node has " + std::to_string(scene.part_of_node.size()) +
                     " entries for " + std::to_string(scene.skeleton.nodes.size()) + " nodes");
  validate_rig(scene);
  for (const auto& edge : scene.skeleton.edges)
    check_indices("edges", {edge[0], edge[1]}, 0, scene.skeleton.nodes.size());
}

NormalisedFrame frame_of(const std::vector<Vector3>& points) {
  Vector3 low = points.front(), high = points.front();
  for (const Vector3& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double half = 0.5 * (high - low).norm();
  return {0.5 * (low + high), half > 0 ? half : 1.0};
}

std::vector<float> floats(const std::vector<Vector3>& positions, const NormalisedFrame& frame) {
  std::vector<float> values;
  values.reserve(3 * positions.size());
  for (const Vector3& p : positions)
    for (const double x : frame.to_normalised(p)) values.push_back(static_cast<float>(x));
  return values;
}

std::vector<float> floats(const std::vector<double>& numbers, double unit = 1.0) {
  std::vector<float> values;
  values.reserve(numbers.size());
  for (const double x : numbers) values.push_back(static_cast<float>(x / unit));
  return values;
}

void add_surface(PageData& data, const ViewerScene& scene, const NormalisedFrame& frame) {
  data.add("position", floats(scene.surface.points, frame));
  data.add("face", scene.surface.corners);
  if (!scene.skeleton_mesh.empty()) data.add("skeleton_mesh", floats(scene.skeleton_mesh, frame));
  if (!scene.msp.empty()) data.add("msp", floats(scene.msp, frame.scale));
  if (!scene.slice_error.empty()) data.add("slice_error", floats(scene.slice_error));
  if (!scene.initial_msp.empty()) data.add("initial_msp", floats(scene.initial_msp, frame.scale));
  if (!scene.initial_slice_error.empty()) data.add("initial_slice_error", floats(scene.initial_slice_error));
  if (!scene.slice_normal.empty()) data.add("slice_normal", floats(scene.slice_normal, NormalisedFrame{}));
  if (!scene.part_of_vertex.empty()) data.add("part_of_vertex", scene.part_of_vertex);
  if (!scene.part_of_node.empty()) data.add("part_of_node", scene.part_of_node);
  if (!scene.rig.names.empty()) {
    data.add("rig_joint", scene.rig.joints);
    data.add("rig_weight", floats(scene.rig.weights));
  }
  if (!scene.skeleton.node_of_vertex.empty()) data.add("node_of_vertex", scene.skeleton.node_of_vertex);
}

void add_skeleton(PageData& data, const CurveSkeleton& skeleton, const NormalisedFrame& frame) {
  std::vector<Vector3> position;
  std::vector<double> radius, perimeter, error;
  for (const SkeletonNode& node : skeleton.nodes) {
    position.push_back(node.position);
    radius.push_back(node.radius);
    perimeter.push_back(node.perimeter);
    error.push_back(node.slice_error);
  }
  std::vector<Index> edges, branch_nodes, branch_begin{0};
  for (const auto& [a, b] : skeleton.edges) edges.insert(edges.end(), {a, b});
  for (const Branch& branch : branches(skeleton)) {
    branch_nodes.insert(branch_nodes.end(), branch.nodes.begin(), branch.nodes.end());
    branch_begin.push_back(static_cast<Index>(branch_nodes.size()));
  }
  data.add("node_position", floats(position, frame));
  data.add("node_radius", floats(radius, frame.scale));
  data.add("node_msp", floats(perimeter, frame.scale));
  data.add("node_error", floats(error));
  data.add("edge", edges);
  data.add("branch_node", branch_nodes);
  data.add("branch_begin", branch_begin);
}

// One place a stretch of pieces that follow each other.
ViewerPlaces places_outside(const ViewerScene& scene) {
  ViewerPlaces places{"the skeleton leaves the solid", {}};
  if (scene.surface.polygon_count() == 0) return places;
  RenderScene drawn;
  drawn.surface = scene.surface;
  drawn.skeleton = scene.skeleton;
  bool outside = false;
  for (const SkeletonPiece& piece : outside_pieces(drawn)) {
    if (piece.outside && !outside) places.positions.push_back(0.5 * (piece.begin + piece.end));
    outside = piece.outside;
  }
  return places;
}

Json json_of(const Vector3& x) { return {x.x(), x.y(), x.z()}; }

Json places_json(const ViewerScene& scene, const NormalisedFrame& frame) {
  std::vector<ViewerPlaces> all = scene.places;
  all.push_back(places_outside(scene));
  Json list = Json::array();
  for (const ViewerPlaces& places : all) {
    if (places.positions.empty()) continue;
    check_positions("place", places.positions);
    Json at = Json::array();
    for (std::size_t i = 0; i < std::min(kMostPlaces, places.positions.size()); ++i)
      at.push_back(json_of(frame.to_normalised(places.positions[i])));
    list.push_back({{"text", places.text}, {"count", places.positions.size()}, {"at", std::move(at)}});
  }
  return list;
}

Json rig_json(const ViewerRig& rig, const NormalisedFrame& frame) {
  if (rig.names.empty()) return nullptr;
  Json at = Json::array();
  for (const Vector3& x : rig.positions) at.push_back(json_of(frame.to_normalised(x)));
  return {{"names", rig.names}, {"parents", rig.parents}, {"nodes", rig.nodes}, {"at", std::move(at)}};
}

// JSON that may stand in an HTML script element: nothing in it closes the element.
std::string text_for_html(const Json& json) {
  std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace), out;
  for (const char c : text) {
    if (c == '<')
      out += "\\u003c";
    else
      out += c;
  }
  return out;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '<')
      out += "&lt;";
    else if (c == '&')
      out += "&amp;";
    else
      out += c;
  }
  return out;
}

std::string description(const ViewerScene& scene, const NormalisedFrame& frame, const Json& arrays) {
  Json report;
  if (!scene.report.empty()) {
    report = Json::parse(scene.report, nullptr, false);
    if (report.is_discarded()) throw UsageError("the report for a page is not JSON");
  }
  const render_detail::ModelFrame view =
      render_detail::make_model_frame(render_detail::make_draw_surface(scene.surface), scene.surface.points);
  return text_for_html({{"title", scene.title},
                        {"origin", json_of(frame.origin)},
                        {"scale", frame.scale},
                        {"right", json_of(view.right)},
                        {"up", json_of(view.up)},
                        {"arrays", arrays},
                        {"rig", rig_json(scene.rig, frame)},
                        {"places", places_json(scene, frame)},
                        {"report", report}});
}

}  // namespace

std::string format_viewer_page(const ViewerScene& scene) {
  validate(scene);
  const NormalisedFrame frame = frame_of(scene.surface.points);
  PageData data;
  add_surface(data, scene, frame);
  add_skeleton(data, scene.skeleton, frame);
  // The template names, in this order, what takes its marks' places.
  const std::pair<std::string_view, std::string> parts[] = {
      {"@MSPSKEL_TITLE@", escaped(scene.title)},
      {"@MSPSKEL_DESCRIPTION@", description(scene, frame, data.table())},
      {"@MSPSKEL_DATA@", detail::encode_base64(data.bytes())}};
  const std::string_view page = detail::page_template();
  std::string out;
  std::size_t done = 0;
  for (const auto& [mark, text] : parts) {
    const std::size_t at = page.find(mark, done);
    out.append(page.substr(done, at - done)).append(text);
    done = at + mark.size();
  }
  return out.append(page.substr(done));
}

void write_viewer_page(const std::string& path, const ViewerScene& scene) {
  write_file_atomically(path, format_viewer_page(scene));
}

}  // namespace mspskel
