// 3MF: a zip archive whose root relationship names a model in XML, of objects that are meshes or put together
// from others, and of the items to build.
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <string>

#include "assembly.h"
#include "mesh_parsers.h"
#include "mspskel/base/error.h"
#include "xml_document.h"
#include "zip_archive.h"

namespace mspskel::detail {
namespace {

using Transform = Eigen::Affine3d;

double number(const pugi::xml_node& node, const char* name) {
  const std::string_view text = node.attribute(name).value();
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    throw ReadError("a " + std::string(local_name(node)) + " has no finite number as its " + name);
  return value;
}

Index corner(const pugi::xml_node& triangle, const char* name, std::size_t count) {
  const std::string_view text = triangle.attribute(name).value();
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    throw ReadError(std::string("a triangle has no vertex index as its ") + name);
  if (value >= count)
    throw ReadError("vertex index " + std::to_string(value) + " is out of range, there are " +
                    std::to_string(count) + " vertices");
  return static_cast<Index>(value);
}

// Twelve numbers: the images of the axes, then of the origin. None: everything stays.
Transform transform_of(const pugi::xml_node& node) {
  Transform place = Transform::Identity();
  std::string_view text = node.attribute("transform").value();
  if (text.empty()) return place;
  for (int k = 0; k < 12; ++k) {
    text.remove_prefix(std::min(text.size(), text.find_first_not_of(" \t\r\n")));
    const auto [end, error] =
        std::from_chars(text.data(), text.data() + text.size(), place.matrix()(k % 3, k / 3));
    if (error != std::errc()) throw ReadError("a transform has no twelve numbers");
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  }
  if (!place.matrix().allFinite()) throw ReadError("a transform is not finite");
  return place;
}

PolygonSoup read_mesh_element(const pugi::xml_node& mesh) {
  PolygonSoup soup;
  const pugi::xml_node vertices = first_element(mesh, "vertices"),
                       triangles = first_element(mesh, "triangles");
  for (pugi::xml_node v = first_element(vertices, "vertex"); v; v = next_element(v, "vertex"))
    soup.points.emplace_back(number(v, "x"), number(v, "y"), number(v, "z"));
  if (soup.points.size() > kMostElements) throw ReadError("there are too many vertices");
  for (pugi::xml_node t = first_element(triangles, "triangle"); t; t = next_element(t, "triangle")) {
    if (soup.corners.size() + 3 > kMostElements) throw ReadError("there are too many triangles");
    soup.add_triangle(corner(t, "v1", soup.points.size()), corner(t, "v2", soup.points.size()),
                      corner(t, "v3", soup.points.size()));
  }
  return soup;
}

class Package {
 public:
  explicit Package(std::string_view bytes)
      : limit_(bytes.size()), archive_(bytes, limit_), assembly_(limit_) {}

  PolygonSoup read() {
    const std::string root = root_model();
    const pugi::xml_node build = first_element(model(root), "build");
    for (pugi::xml_node item = first_element(build, "item"); item; item = next_element(item, "item"))
      place(root, item, Transform::Identity(), 0);
    PolygonSoup soup = assembly_.take();
    if (supports_ > 0)
      soup.warnings.push_back(std::to_string(supports_) +
                              (supports_ == 1 ? " support is left out" : " supports are left out"));
    return soup;
  }

 private:
  std::string root_model() const {
    const std::optional<std::string> text = archive_.read("_rels/.rels");
    if (!text) throw ReadError("the archive has no _rels/.rels: it is no 3MF file");
    pugi::xml_document document;
    load_xml(*text, document);
    const pugi::xml_node list = first_element(document, "Relationships");
    for (pugi::xml_node r = first_element(list, "Relationship"); r; r = next_element(r, "Relationship")) {
      const std::string_view type = r.attribute("Type").value();
      if (type.size() > 8 && type.substr(type.size() - 8) == "/3dmodel") return r.attribute("Target").value();
    }
    throw ReadError("the archive names no 3D model");
  }

  pugi::xml_node model(const std::string& path) {
    const auto [entry, added] = documents_.try_emplace(path);
    if (added) {
      const std::optional<std::string> text = archive_.read(path);
      if (!text) throw ReadError("the archive has no " + path.substr(0, 80));
      limit_.spend(2 * text->size());  // its elements
      load_xml(*text, entry->second);
    }
    const pugi::xml_node root = first_element(entry->second, "model");
    if (!root) throw ReadError(path.substr(0, 80) + " has no element model");
    return root;
  }

  // Objects by their numbers in their model.
  pugi::xml_node object(const std::string& path, const std::string& id) {
    auto [entry, added] = objects_.try_emplace(path);
    if (added) {
      const pugi::xml_node resources = first_element(model(path), "resources");
      for (pugi::xml_node o = first_element(resources, "object"); o; o = next_element(o, "object"))
        entry->second.emplace(o.attribute("id").value(), o);
    }
    const auto found = entry->second.find(id);
    if (found == entry->second.end()) throw ReadError("there is no object " + id.substr(0, 24));
    return found->second;
  }

  // What a component or an item refers to; it may lie in another model of the archive.
  void place(const std::string& model_path, const pugi::xml_node& reference, const Transform& outer,
             int depth) {
    constexpr int kDeepest = 64;
    if (depth > kDeepest) throw ReadError("objects are put together from themselves, or too deep");
    limit_.spend(sizeof(Transform));
    std::string path = model_path;
    for (const pugi::xml_attribute& a : reference.attributes())
      if (const std::string_view name = a.name(); name.size() > 5 && name.substr(name.size() - 5) == ":path")
        path = a.value();
    const pugi::xml_node o = object(path, reference.attribute("objectid").value());
    const std::string_view type = o.attribute("type").value();
    if (type == "support" || type == "solidsupport") {
      ++supports_;
      return;
    }
    const Transform at = outer * transform_of(reference);
    if (const pugi::xml_node mesh = first_element(o, "mesh")) assembly_.add(part(o, mesh), at);
    const pugi::xml_node parts = first_element(o, "components");
    for (pugi::xml_node c = first_element(parts, "component"); c; c = next_element(c, "component"))
      place(path, c, at, depth + 1);
  }

  const PolygonSoup& part(const pugi::xml_node& object, const pugi::xml_node& mesh) {
    const auto [entry, added] = meshes_.try_emplace(object.hash_value());
    if (added) entry->second = read_mesh_element(mesh);
    return entry->second;
  }

  GrowthLimit limit_;
  ZipArchive archive_;
  Assembly assembly_;
  std::map<std::string, pugi::xml_document> documents_;
  std::map<std::string, std::map<std::string, pugi::xml_node>> objects_;
  std::map<std::size_t, PolygonSoup> meshes_;
  int supports_ = 0;
};

}  // namespace

PolygonSoup parse_3mf(std::string_view bytes) { return Package(bytes).read(); }

}  // namespace mspskel::detail
