// glTF 2.0, as JSON with buffers beside it or as one binary file: the triangles of the scene's meshes, where
// its nodes put them.
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "assembly.h"
#include "byte_reader.h"
#include "cell_array.h"
#include "gltf_accessors.h"
#include "mesh_parsers.h"
#include "mspskel/base/error.h"

namespace mspskel::detail {
namespace {

using nlohmann::json;
using Transform = Eigen::Affine3d;

// The JSON text and the binary chunk.
struct Chunks {
  std::string_view text, binary;
};

Chunks chunks_of(std::string_view bytes) {
  if (bytes.substr(0, 4) != "glTF") return {bytes, {}};
  constexpr std::uint32_t kText = 0x4E4F534A, kBinary = 0x004E4942;
  ByteReader reader(bytes, 4, ByteOrder::kLittle);
  const auto version = reader.read<std::uint32_t>("the header");
  if (version != 2) throw ReadError("it is glTF " + std::to_string(version) + ", not 2");
  reader.skip(4, "the header");  // the length
  Chunks chunks;
  while (reader.bytes_left() >= 8) {
    const auto size = reader.read<std::uint32_t>("a chunk"), kind = reader.read<std::uint32_t>("a chunk");
    const std::size_t begin = reader.offset();
    reader.skip(size, "a chunk");
    if (kind == kText && chunks.text.empty()) chunks.text = bytes.substr(begin, size);
    if (kind == kBinary && chunks.binary.empty()) chunks.binary = bytes.substr(begin, size);
  }
  return chunks;
}

json parse_json(std::string_view text) {
  try {
    return json::parse(text);
  } catch (const json::exception& error) {
    throw ReadError(std::string("not well-formed JSON: ") + error.what());
  }
}

// `count` numbers, or none.
std::vector<double> numbers(const json& node, const char* name, std::size_t count) {
  const json& list = member(node, name);
  std::vector<double> values;
  if (list.is_null()) return values;
  for (const json& value : list)
    if (value.is_number()) values.push_back(value.get<double>());
  if (values.size() != count)
    throw ReadError(std::string("a node's ") + name + " has not the numbers that it needs");
  return values;
}

Transform transform_of(const json& node) {
  Transform place = Transform::Identity();
  if (const std::vector<double> m = numbers(node, "matrix", 16); !m.empty()) {
    for (int k = 0; k < 12; ++k)
      place.matrix()(k % 3, k / 3) = m[static_cast<std::size_t>(k / 3 * 4 + k % 3)];
    for (int k = 0; k < 3; ++k) place.matrix()(k, 3) = m[static_cast<std::size_t>(12 + k)];
    return place;
  }
  if (const auto t = numbers(node, "translation", 3); !t.empty()) place.translate(Vector3(t[0], t[1], t[2]));
  if (const auto r = numbers(node, "rotation", 4); !r.empty())
    place.rotate(Eigen::Quaterniond(r[3], r[0], r[1], r[2]).normalized());
  if (const auto s = numbers(node, "scale", 3); !s.empty()) place.scale(Vector3(s[0], s[1], s[2]));
  return place;
}

class Scene {
 public:
  Scene(std::string_view bytes, const std::string* folder)
      : limit_(bytes.size()),
        chunks_(chunks_of(bytes)),
        document_(parse_json(chunks_.text)),
        accessors_(document_, chunks_.binary, folder, limit_),
        assembly_(limit_) {}

  PolygonSoup read() {
    const json& version = member(member(document_, "asset"), "version");
    if (version.is_null()) throw ReadError("it has no asset with a version");
    if (const std::string text = version.is_string() ? version.get<std::string>() : version.dump();
        text.substr(0, 2) != "2.")
      throw ReadError("it is glTF " + text + ", not 2");
    visited_.assign(member(document_, "nodes").size(), 0);
    for (const std::size_t root : roots()) visit(root);
    PolygonSoup soup = assembly_.take();
    if (left_out_ > 0)
      soup.warnings.push_back(std::to_string(left_out_) +
                              (left_out_ == 1 ? " primitive of points or lines is left out"
                                              : " primitives of points or lines are left out"));
    return soup;
  }

 private:
  // Of the scene to show; without scenes, the nodes that are no other's children.
  std::vector<std::size_t> roots() const {
    std::vector<std::size_t> list;
    if (member(document_, "scenes").size() > 0) {
      const json& scene = element(document_, "scenes", size_member(document_, "scene", 0));
      for (const json& node : member(scene, "nodes")) list.push_back(number_of(node));
      return list;
    }
    std::vector<char> child(visited_.size(), 0);
    for (const json& node : member(document_, "nodes"))
      for (const json& c : member(node, "children"))
        if (number_of(c) < child.size()) child[number_of(c)] = 1;
    for (std::size_t n = 0; n < child.size(); ++n)
      if (!child[n]) list.push_back(n);
    return list;
  }
  static std::size_t number_of(const json& value) {
    if (!value.is_number_unsigned()) throw ReadError("a node is no number");
    return value.get<std::size_t>();
  }

  // A node with all below it; a deep tree needs no deep stack.
  void visit(std::size_t root) {
    std::vector<std::pair<std::size_t, Transform>> waiting{{root, Transform::Identity()}};
    while (!waiting.empty()) {
      const auto [number, outer] = waiting.back();
      waiting.pop_back();
      const json& node = element(document_, "nodes", number);
      if (visited_[number]) throw ReadError("node " + std::to_string(number) + " has several parents");
      visited_[number] = 1;
      const Transform place = outer * transform_of(node);
      // A skinned mesh stands where its joints put it; as it was bound, that is where its vertices are.
      const bool skinned = !member(node, "skin").is_null();
      if (!member(node, "mesh").is_null())
        assembly_.add(mesh(size_member(node, "mesh", 0)), skinned ? Transform::Identity() : place);
      const json& children = member(node, "children");
      for (auto c = children.rbegin(); c != children.rend(); ++c) waiting.emplace_back(number_of(*c), place);
    }
  }

  const PolygonSoup& mesh(std::size_t number) {
    const auto [entry, added] = meshes_.try_emplace(number);
    if (added)
      for (const json& primitive : member(element(document_, "meshes", number), "primitives"))
        add_primitive(primitive, entry->second);
    return entry->second;
  }

  void add_primitive(const json& primitive, PolygonSoup& soup) {
    constexpr std::size_t kTriangles = 4, kFan = 6;
    const std::size_t mode = size_member(primitive, "mode", kTriangles);
    if (mode > kFan) throw ReadError("a primitive's mode " + std::to_string(mode) + " is unknown");
    if (mode < kTriangles) {
      ++left_out_;
      return;
    }
    if (!member(member(primitive, "extensions"), "KHR_draco_mesh_compression").is_null())
      throw ReadError("its meshes are compressed by Draco: export without compression");
    const std::vector<Vector3> points =
        accessors_.vectors(size_member(member(primitive, "attributes"), "POSITION", kAbsent));
    CellArray list;
    if (member(primitive, "indices").is_null()) {
      for (std::size_t i = 0; i < points.size(); ++i) list.points.push_back(static_cast<std::int64_t>(i));
    } else {
      list.points = accessors_.indices(size_member(primitive, "indices", 0));
    }
    const auto first = static_cast<Index>(soup.points.size());
    if (soup.points.size() + points.size() > kMostElements) throw ReadError("there are too many vertices");
    soup.points.insert(soup.points.end(), points.begin(), points.end());
    add_cells(cells_of(list, mode), mode == 5 ? CellKind::kStrips : CellKind::kPolygons, first,
              static_cast<Index>(points.size()), soup);
  }
  // Triangles, one strip, or a fan round the first point.
  static CellArray cells_of(CellArray list, std::size_t mode) {
    const std::size_t size = list.points.size();
    if (mode == 4)
      for (std::size_t i = 3; i <= size; i += 3) list.end.push_back(static_cast<std::int64_t>(i));
    if (mode == 5) list.end.push_back(static_cast<std::int64_t>(size));
    if (mode != 6) return list;
    CellArray fan;
    for (std::size_t i = 1; i + 1 < size; ++i) {
      fan.points.insert(fan.points.end(), {list.points[0], list.points[i], list.points[i + 1]});
      fan.end.push_back(static_cast<std::int64_t>(fan.points.size()));
    }
    return fan;
  }

  GrowthLimit limit_;
  Chunks chunks_;
  json document_;
  GltfAccessors accessors_;
  Assembly assembly_;
  std::vector<char> visited_;  // per node
  std::map<std::size_t, PolygonSoup> meshes_;
  int left_out_ = 0;
};

}  // namespace

PolygonSoup parse_gltf(std::string_view bytes, const std::string* folder) {
  return Scene(bytes, folder).read();
}

}  // namespace mspskel::detail
