#include "mspskel/io/write_glb.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "append_text.h"
#include "mspskel/base/error.h"

namespace mspskel {
namespace {

using OrderedJson = nlohmann::ordered_json;

// glTF's numbers for types, buffer targets and ways to draw.
enum Component { kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126 };
enum Target { kNoTarget = 0, kVertices = 34962, kIndices = 34963 };
enum Draw { kLines = 1 };

// A document and its binary chunk, which grow together.
class GlbFile {
 public:
  GlbFile() {
    json_["asset"] = {{"version", "2.0"}, {"generator", "mspskel"}};
    json_["scene"] = 0;
    json_["scenes"] = {{{"nodes", OrderedJson::array()}}};
  }
  OrderedJson& json() { return json_; }

  template <class T>
  std::size_t add_accessor(const std::vector<T>& values, const char* type, std::size_t width,
                           Component component, Target target) {
    OrderedJson view{
        {"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", values.size() * sizeof(T)}};
    if (target != kNoTarget) view["target"] = static_cast<int>(target);
    json_["bufferViews"].push_back(std::move(view));
    append_little_endian(values);
    while (binary_.size() % 4 != 0) binary_ += '\0';
    json_["accessors"].push_back({{"bufferView", json_["bufferViews"].size() - 1},
                                  {"componentType", static_cast<int>(component)},
                                  {"count", values.size() / width},
                                  {"type", type}});
    return json_["accessors"].size() - 1;
  }
  // With the bounds that positions must have.
  std::size_t add_positions(const std::vector<float>& values) {
    const std::size_t accessor = add_accessor(values, "VEC3", 3, kFloat, kVertices);
    std::array<float, 3> low{values[0], values[1], values[2]}, high = low;
    for (std::size_t i = 0; i < values.size(); ++i) {
      low[i % 3] = std::min(low[i % 3], values[i]);
      high[i % 3] = std::max(high[i % 3], values[i]);
    }
    json_["accessors"][accessor]["min"] = low;
    json_["accessors"][accessor]["max"] = high;
    return accessor;
  }
  std::size_t add_indices(const std::vector<std::uint32_t>& values) {
    return add_accessor(values, "SCALAR", 1, kUnsignedInt, kIndices);
  }
  std::size_t add(const char* list, OrderedJson entry) {
    json_[list].push_back(std::move(entry));
    return json_[list].size() - 1;
  }
  std::size_t add_root_node(OrderedJson entry) {
    const std::size_t node = add("nodes", std::move(entry));
    json_["scenes"][0]["nodes"].push_back(node);
    return node;
  }

  std::string bytes() {
    json_["buffers"] = {{{"byteLength", binary_.size()}}};
    std::string text = json_.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
    while (text.size() % 4 != 0) text += ' ';
    std::string out;
    out.reserve(12 + 8 + text.size() + 8 + binary_.size());
    out += "glTF";
    const auto number = [&out](std::size_t value) {
      for (int shift = 0; shift < 32; shift += 8) out += static_cast<char>(value >> shift & 255);
    };
    number(2);
    number(12 + 8 + text.size() + 8 + binary_.size());
    number(text.size());
    out.append("JSON").append(text);
    number(binary_.size());
    out.append("BIN\0", 4).append(binary_);
    return out;
  }

 private:
  template <class T>
  void append_little_endian(const std::vector<T>& values) {
    std::size_t at = binary_.size();
    binary_.resize(at + values.size() * sizeof(T));
    for (const T value : values) {
      std::uint32_t bits = 0;
      if constexpr (sizeof(T) == 4)
        std::memcpy(&bits, &value, 4);
      else
        bits = value;
      for (std::size_t i = 0; i < sizeof(T); ++i) binary_[at++] = static_cast<char>(bits >> (8 * i) & 255);
    }
  }

  OrderedJson json_;
  std::string binary_;
};

void check(const GlbScene& scene) {
  const PolygonSoup& surface = scene.surface;
  if (surface.polygon_count() == 0) throw UsageError("a .glb needs a surface: this one has no triangles");
  for (std::size_t f = 0; f < surface.polygon_count(); ++f)
    if (surface.begin[f + 1] - surface.begin[f] != 3)
      throw UsageError("polygon " + std::to_string(f) + " of the .glb's surface is no triangle");
  for (const Index corner : surface.corners)
    if (corner < 0 || corner >= static_cast<Index>(surface.points.size()))
      throw UsageError("a corner of the .glb's surface is point " + std::to_string(corner) +
                       ", which does not exist");
}

std::vector<float> floats(const std::vector<Vector3>& points, const char* what) {
  std::vector<float> values;
  values.reserve(3 * points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    for (const double x : points[i]) {
      values.push_back(static_cast<float>(x));
      if (!std::isfinite(values.back()))
        throw MeshError("the coordinates of " + std::string(what) + " " + std::to_string(i) +
                        " are no finite 32-bit numbers");
    }
  return values;
}

// Weighted by area.
std::vector<float> normals(const PolygonSoup& surface) {
  std::vector<Vector3> sum(surface.points.size(), Vector3::Zero());
  for (std::size_t f = 0; f < surface.polygon_count(); ++f) {
    const Index* corner = &surface.corners[3 * f];
    const Vector3 &a = surface.points[corner[0]], &b = surface.points[corner[1]],
                  &c = surface.points[corner[2]];
    const Vector3 normal = (b - a).cross(c - a);
    for (int k = 0; k < 3; ++k) sum[corner[k]] += normal;
  }
  std::vector<Vector3> unit;
  for (const Vector3& n : sum) {
    const double length = n.stableNorm();
    unit.push_back(length > 0 && std::isfinite(length) ? Vector3(n / length) : Vector3(Vector3::UnitZ()));
  }
  return floats(unit, "normal");
}

OrderedJson surface_primitive(GlbFile& file, const PolygonSoup& surface, double opacity) {
  OrderedJson material{{"pbrMetallicRoughness",
                        {{"baseColorFactor", {0.69, 0.745, 0.82, opacity}},
                         {"metallicFactor", 0.0},
                         {"roughnessFactor", 0.7}}}};
  if (opacity < 1) material["alphaMode"] = "BLEND";
  const std::size_t position = file.add_positions(floats(surface.points, "vertex"));
  const std::size_t normal = file.add_accessor(normals(surface), "VEC3", 3, kFloat, kVertices);
  const std::size_t indices =
      file.add_indices(std::vector<std::uint32_t>(surface.corners.begin(), surface.corners.end()));
  return {{"attributes", {{"POSITION", position}, {"NORMAL", normal}}},
          {"indices", indices},
          {"material", file.add("materials", std::move(material))}};
}

void add_skeleton(GlbFile& file, const CurveSkeleton& skeleton) {
  if (skeleton.edges.empty()) return;
  std::vector<Vector3> points;
  std::vector<float> radius;
  std::vector<std::uint32_t> ends;
  for (const SkeletonNode& node : skeleton.nodes) {
    points.push_back(node.position);
    radius.push_back(static_cast<float>(node.radius));
  }
  for (const auto& [a, b] : skeleton.edges)
    ends.insert(ends.end(), {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b)});
  const std::size_t position = file.add_positions(floats(points, "node"));
  const std::size_t radii = file.add_accessor(radius, "SCALAR", 1, kFloat, kVertices);
  const std::size_t indices = file.add_indices(ends);
  const std::size_t material = file.add(
      "materials",
      {{"pbrMetallicRoughness", {{"baseColorFactor", {0.01, 0.06, 0.5, 1.0}}, {"metallicFactor", 0.0}}}});
  const std::size_t mesh =
      file.add("meshes", {{"name", "skeleton"},
                          {"primitives",
                           {{{"attributes", {{"POSITION", position}, {"_RADIUS", radii}}},
                             {"indices", indices},
                             {"material", material},
                             {"mode", static_cast<int>(kLines)}}}}});
  file.add_root_node({{"name", "skeleton"}, {"mesh", mesh}});
}

// Weights as 32-bit floats that sum to 1 to the last bit but one: the strongest takes what rounding leaves.
void add_influences(GlbFile& file, const Rig& rig, OrderedJson& primitive) {
  std::vector<std::uint16_t> joints;
  std::vector<float> weights;
  joints.reserve(4 * rig.influences.size());
  weights.reserve(4 * rig.influences.size());
  for (const auto& influences : rig.influences) {
    std::array<float, 4> weight{};
    for (std::size_t i = 1; i < 4; ++i) weight[i] = static_cast<float>(influences[i].weight);
    weight[0] = 1.0f - (weight[1] + weight[2] + weight[3]);
    for (std::size_t i = 0; i < 4; ++i) {
      joints.push_back(static_cast<std::uint16_t>(weight[i] > 0 ? influences[i].joint : 0));
      weights.push_back(weight[i]);
    }
  }
  primitive["attributes"]["JOINTS_0"] = file.add_accessor(joints, "VEC4", 4, kUnsignedShort, kVertices);
  primitive["attributes"]["WEIGHTS_0"] = file.add_accessor(weights, "VEC4", 4, kFloat, kVertices);
}

// The joints are nodes `first`, `first` + 1 and so on.
void add_joints(GlbFile& file, const Rig& rig, const std::vector<JointTurn>& turns, std::size_t first) {
  std::vector<Eigen::Quaterniond> own(rig.joints.size(), Eigen::Quaterniond::Identity());
  for (const JointTurn& turn : turns)
    own[turn.joint] = Eigen::Quaterniond(Eigen::AngleAxisd(turn.angle * kPi / 180, turn.axis.normalized())) *
                      own[turn.joint];
  std::vector<OrderedJson> children(rig.joints.size(), OrderedJson::array());
  for (std::size_t j = 1; j < rig.joints.size(); ++j) children[rig.joints[j].parent].push_back(first + j);
  for (std::size_t j = 0; j < rig.joints.size(); ++j) {
    const RigJoint& joint = rig.joints[j];
    Vector3 moved = joint.position;
    if (joint.parent != kNone) moved -= rig.joints[joint.parent].position;
    OrderedJson node{{"name", joint.name}, {"translation", {moved.x(), moved.y(), moved.z()}}};
    if (!own[j].isApprox(Eigen::Quaterniond::Identity()))
      node["rotation"] = {own[j].x(), own[j].y(), own[j].z(), own[j].w()};
    if (!children[j].empty()) node["children"] = children[j];
    if (j == 0)
      file.add_root_node(std::move(node));
    else
      file.add("nodes", std::move(node));
  }
}

void add_skin(GlbFile& file, const Rig& rig, std::size_t first) {
  std::vector<float> inverse_bind;
  OrderedJson joints = OrderedJson::array();
  for (std::size_t j = 0; j < rig.joints.size(); ++j) {
    const Vector3& p = rig.joints[j].position;
    for (int column = 0; column < 3; ++column)
      for (int row = 0; row < 4; ++row) inverse_bind.push_back(row == column ? 1.0f : 0.0f);
    for (int row = 0; row < 3; ++row) inverse_bind.push_back(static_cast<float>(-p[row]));
    inverse_bind.push_back(1.0f);
    joints.push_back(first + j);
  }
  const std::size_t matrices = file.add_accessor(inverse_bind, "MAT4", 16, kFloat, kNoTarget);
  file.add("skins", {{"inverseBindMatrices", matrices}, {"joints", joints}, {"skeleton", first}});
}

bool ends_with(const std::string& path, const std::string& end) {
  return path.size() > end.size() && std::equal(end.rbegin(), end.rend(), path.rbegin(), [](char a, char b) {
           return a == (b >= 'A' && b <= 'Z' ? static_cast<char>(b - 'A' + 'a') : b);
         });
}

}  // namespace

std::string format_glb(const GlbScene& scene) {
  check(scene);
  GlbFile file;
  OrderedJson primitive = surface_primitive(file, scene.surface, scene.skeleton.edges.empty() ? 1.0 : 0.4);
  const std::size_t mesh =
      file.add("meshes", {{"name", scene.name}, {"primitives", OrderedJson::array({primitive})}});
  file.add_root_node({{"name", scene.name}, {"mesh", mesh}});
  add_skeleton(file, scene.skeleton);
  return file.bytes();
}

std::string format_rigged_glb(const GlbScene& scene, const Rig& rig, const std::vector<JointTurn>& turns) {
  check(scene);
  if (rig.influences.size() != scene.surface.points.size())
    throw UsageError("the rig has " + std::to_string(rig.influences.size()) + " vertices, the surface " +
                     std::to_string(scene.surface.points.size()));
  if (rig.joints.empty() || rig.joints.size() > std::numeric_limits<std::uint16_t>::max())
    throw UsageError("a .glb holds a rig of 1 to 65535 joints, not of " + std::to_string(rig.joints.size()));
  pose_joints(rig, turns);  // refuses turns of no joint
  GlbFile file;
  OrderedJson primitive = surface_primitive(file, scene.surface, 1.0);
  add_influences(file, rig, primitive);
  const std::size_t mesh =
      file.add("meshes", {{"name", scene.name}, {"primitives", OrderedJson::array({primitive})}});
  const std::size_t node = file.add_root_node({{"name", scene.name}, {"mesh", mesh}, {"skin", 0}});
  add_joints(file, rig, turns, node + 1);
  add_skin(file, rig, node + 1);
  return file.bytes();
}

std::string format_rig_text(const Rig& rig) {
  std::string out;
  for (const RigJoint& joint : rig.joints)
    detail::append_all(out, "joints ", joint.name, ' ', joint.position, '\n');
  if (!rig.joints.empty()) detail::append_all(out, "root ", rig.joints[0].name, '\n');
  for (std::size_t v = 0; v < rig.influences.size(); ++v) {
    detail::append_all(out, "skin ", v);
    for (const auto& [joint, weight] : rig.influences[v])
      if (weight > 0) detail::append_all(out, ' ', rig.joints[joint].name, ' ', static_cast<float>(weight));
    out += '\n';
  }
  for (std::size_t j = 1; j < rig.joints.size(); ++j)
    detail::append_all(out, "hier ", rig.joints[rig.joints[j].parent].name, ' ', rig.joints[j].name, '\n');
  return out;
}

bool is_glb(const std::string& path) { return ends_with(path, ".glb"); }
bool is_rig_text(const std::string& path) { return ends_with(path, ".rig.txt"); }

}  // namespace mspskel
