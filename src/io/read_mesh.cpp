#include "mspskel/io/read_mesh.h"

#include <filesystem>
#include <optional>

#include "mesh_parsers.h"
#include "mspskel/base/error.h"
#include "mspskel/mesh/build_mesh.h"
#include "read_bytes.h"

namespace mspskel {
namespace {

using detail::starts_ignoring_case;

std::optional<MeshFormat> format_of_extension(const std::string& extension) {
  if (extension == "off") return MeshFormat::kOff;
  if (extension == "obj") return MeshFormat::kObj;
  if (extension == "ply") return MeshFormat::kPly;
  if (extension == "stl") return MeshFormat::kStl;
  if (extension == "vtk") return MeshFormat::kVtk;
  if (extension == "vtp") return MeshFormat::kVtp;
  if (extension == "gltf" || extension == "glb") return MeshFormat::kGltf;
  if (extension == "3mf") return MeshFormat::k3mf;
  return std::nullopt;
}

bool is_off_keyword(std::string_view word) {
  word = word.substr(0, word.find_first_of(" \t\r\n0123456789"));
  return word.size() >= 3 && word.size() <= 8 &&
         detail::equals_ignoring_case(word.substr(word.size() - 3), "off");
}
bool has_obj_record(std::string_view bytes) {
  for (std::size_t start = 0; start < bytes.size();) {
    const std::string_view line = bytes.substr(start, bytes.find_first_of("\r\n", start) - start);
    if (line.substr(0, 2) == "v " || line.substr(0, 2) == "v\t") return true;
    start += line.size() + 1;
  }
  return false;
}
bool is_binary_stl(std::string_view bytes) {
  if (bytes.size() < 84) return false;
  std::uint64_t count = 0;
  for (int i = 3; i >= 0; --i)
    count = 256 * count + static_cast<unsigned char>(bytes[80 + static_cast<std::size_t>(i)]);
  return bytes.size() == 84 + 50 * count;
}

std::optional<MeshFormat> format_of_content(std::string_view bytes) {
  if (bytes.substr(0, 3) == "ply" && bytes.find_first_of("\r\n") == 3) return MeshFormat::kPly;
  if (is_binary_stl(bytes)) return MeshFormat::kStl;
  if (bytes.substr(0, 4) == "glTF") return MeshFormat::kGltf;
  if (bytes.substr(0, 4) == "PK\3\4") return MeshFormat::k3mf;
  std::string_view text = bytes.substr(bytes.substr(0, 3) == "\xEF\xBB\xBF" ? 3 : 0);
  if (starts_ignoring_case(text, "# vtk datafile")) return MeshFormat::kVtk;
  for (;;) {  // blank lines and comments before the first word
    text.remove_prefix(std::min(text.size(), text.find_first_not_of(" \t\r\n")));
    if (text.empty() || text[0] != '#') break;
    text.remove_prefix(std::min(text.size(), text.find_first_of("\r\n")));
  }
  if (text.substr(0, 1) == "<") return MeshFormat::kVtp;
  if (text.substr(0, 1) == "{") return MeshFormat::kGltf;
  if (is_off_keyword(text.substr(0, 16))) return MeshFormat::kOff;
  if (starts_ignoring_case(text, "solid")) return MeshFormat::kStl;
  if (has_obj_record(text)) return MeshFormat::kObj;
  return std::nullopt;
}

bool is_utf16(std::string_view bytes) {
  const std::string_view mark = bytes.substr(0, 2);
  return (mark == "\xFF\xFE" || mark == "\xFE\xFF") && !is_binary_stl(bytes);
}

const char* name_of(MeshFormat format) {
  static constexpr const char* kNames[] = {"OFF", "OBJ", "PLY", "STL", "VTK", "VTP", "glTF", "3MF"};
  return kNames[static_cast<int>(format)];
}

// `folder`: see parse_gltf.
PolygonSoup parse(std::string_view bytes, MeshFormat format, const std::string* folder) {
  switch (format) {
    case MeshFormat::kOff:
      return detail::parse_off(bytes);
    case MeshFormat::kObj:
      return detail::parse_obj(bytes);
    case MeshFormat::kPly:
      return detail::parse_ply(bytes);
    case MeshFormat::kStl:
      return detail::parse_stl(bytes);
    case MeshFormat::kVtk:
      return detail::parse_vtk(bytes);
    case MeshFormat::kVtp:
      return detail::parse_vtp(bytes);
    case MeshFormat::kGltf:
      return detail::parse_gltf(bytes, folder);
    default:
      return detail::parse_3mf(bytes);
  }
}

}  // namespace

PolygonSoup read_polygon_soup(std::string_view bytes, MeshFormat format) {
  return parse(bytes, format, nullptr);
}

PolygonSoup read_polygon_soup(const std::string& path) {
  const std::string bytes = detail::read_bytes(path);
  const std::string name = path == "-" ? "standard input" : path;
  if (is_utf16(bytes)) throw ReadError(name + ": the text is UTF-16; save it as UTF-8 or ASCII");
  const auto by_content = format_of_content(bytes);
  const auto by_extension = path == "-" ? std::nullopt : format_of_extension(detail::extension_of(path));
  if (!by_extension && !by_content)
    throw ReadError(
        name +
        ": neither the extension nor the content is that of OFF, OBJ, PLY, STL, VTK, VTP, glTF or 3MF");
  const MeshFormat format = by_extension ? *by_extension : *by_content;
  try {
    const std::string folder = std::filesystem::path(path).parent_path().string();
    return parse(bytes, format, path == "-" ? nullptr : &folder);
  } catch (const ReadError& error) {
    const bool misnamed = by_content && *by_content != format;
    throw ReadError(name + ": " + error.what() +
                    (misnamed ? std::string(" (its content looks like ") + name_of(*by_content) + ")" : ""));
  }
}

DefaultMesh read_mesh(const std::string& path) { return build_mesh(read_polygon_soup(path)); }

}  // namespace mspskel
