#include "mspskel/io/write_mesh.h"

#include <cstring>

#include "append_text.h"
#include "mspskel/base/error.h"
#include "mspskel/base/near_name.h"
#include "mspskel/io/atomic_file.h"
#include "read_bytes.h"

namespace mspskel {
namespace {

using detail::append;
using detail::append_all;

class MeshText {
 public:
  MeshText(const PolygonSoup& soup, const WriteMeshOptions& options)
      : soup_(soup), colors_(options.vertex_colors) {
    out_.reserve(64 * soup.points.size() + 16 * soup.corners.size());
  }

  std::string off() {
    append_all(out_, colors_.empty() ? "OFF\n" : "COFF\n", soup_.points.size(), ' ', soup_.polygon_count(),
               " 0\n");
    for (std::size_t v = 0; v < soup_.points.size(); ++v) {
      append(out_, soup_.points[v]);
      if (!colors_.empty()) append_integers(colors_[v], " 255");
      out_ += '\n';
    }
    append_polygons();
    return std::move(out_);
  }
  std::string obj() {
    for (std::size_t v = 0; v < soup_.points.size(); ++v) {
      append_all(out_, "v ", soup_.points[v]);
      if (!colors_.empty())
        append_all(out_, ' ',
                   Vector3(colors_[v].red / 255.0, colors_[v].green / 255.0, colors_[v].blue / 255.0));
      out_ += '\n';
    }
    for (std::size_t f = 0; f < soup_.polygon_count(); ++f) {
      out_ += 'f';
      for (Index i = soup_.begin[f]; i < soup_.begin[f + 1]; ++i) append_all(out_, ' ', soup_.corners[i] + 1);
      out_ += '\n';
    }
    return std::move(out_);
  }
  std::string ply_text() {
    append_ply_header("ascii");
    for (std::size_t v = 0; v < soup_.points.size(); ++v) {
      append(out_, soup_.points[v]);
      if (!colors_.empty()) append_integers(colors_[v], "");
      out_ += '\n';
    }
    append_polygons();
    return std::move(out_);
  }
  std::string ply_binary() {
    append_ply_header("binary_little_endian");
    for (std::size_t v = 0; v < soup_.points.size(); ++v) {
      for (int k = 0; k < 3; ++k) append_bytes(soup_.points[v][k]);
      if (colors_.empty()) continue;
      for (const std::uint8_t c : {colors_[v].red, colors_[v].green, colors_[v].blue})
        out_ += static_cast<char>(c);
    }
    for (std::size_t f = 0; f < soup_.polygon_count(); ++f) {
      const Index size = soup_.begin[f + 1] - soup_.begin[f];
      if (small_polygons_)
        out_ += static_cast<char>(size);
      else
        append_bytes(size);
      for (Index i = soup_.begin[f]; i < soup_.begin[f + 1]; ++i) append_bytes(soup_.corners[i]);
    }
    return std::move(out_);
  }

 private:
  void append_integers(VertexColor c, const char* after) {
    append_all(out_, ' ', Index{c.red}, ' ', Index{c.green}, ' ', Index{c.blue}, after);
  }
  void append_polygons() {
    for (std::size_t f = 0; f < soup_.polygon_count(); ++f) {
      append(out_, soup_.begin[f + 1] - soup_.begin[f]);
      for (Index i = soup_.begin[f]; i < soup_.begin[f + 1]; ++i) append_all(out_, ' ', soup_.corners[i]);
      out_ += '\n';
    }
  }
  void append_ply_header(const char* format) {
    for (std::size_t f = 0; f < soup_.polygon_count(); ++f)
      small_polygons_ = small_polygons_ && soup_.begin[f + 1] - soup_.begin[f] < 256;
    append_all(out_, "ply\nformat ", format, " 1.0\nelement vertex ", soup_.points.size(),
               "\nproperty double x\nproperty double y\nproperty double z\n");
    if (!colors_.empty()) append(out_, "property uchar red\nproperty uchar green\nproperty uchar blue\n");
    append_all(out_, "element face ", soup_.polygon_count(), "\nproperty list ",
               small_polygons_ ? "uchar" : "int", " int vertex_indices\nend_header\n");
  }
  // Little-endian on every machine.
  template <class T>
  void append_bytes(T value) {
    std::uint64_t bits = 0;
    if constexpr (sizeof(T) == 8)
      std::memcpy(&bits, &value, 8);
    else
      bits = static_cast<std::uint32_t>(value);
    for (std::size_t i = 0; i < sizeof(T); ++i) out_ += static_cast<char>(bits >> (8 * i) & 255);
  }

  const PolygonSoup& soup_;
  const std::vector<VertexColor>& colors_;
  std::string out_;
  bool small_polygons_ = true;
};

}  // namespace

MeshFormat written_mesh_format_of(const std::string& path) {
  if (path == "-") return MeshFormat::kOff;
  const std::string extension = detail::extension_of(path);
  if (extension == "off") return MeshFormat::kOff;
  if (extension == "obj") return MeshFormat::kObj;
  if (extension == "ply") return MeshFormat::kPly;
  throw unknown_extension("mesh format", path, {".off", ".obj", ".ply"});
}

PolygonSoup to_polygon_soup(const DefaultMesh& mesh) {
  PolygonSoup soup;
  soup.points.reserve(mesh.n_vertices());
  soup.begin.reserve(mesh.n_faces() + 1);
  soup.corners.reserve(3 * mesh.n_faces());
  for (const auto v : mesh.vertices()) soup.points.push_back(to_vector3(mesh.point(v)));
  for (const auto f : mesh.faces()) {
    for (auto v = mesh.cfv_iter(f); v.is_valid(); ++v) soup.corners.push_back(static_cast<Index>(v->idx()));
    soup.begin.push_back(static_cast<Index>(soup.corners.size()));
  }
  return soup;
}

std::string format_mesh(const PolygonSoup& soup, MeshFormat format, const WriteMeshOptions& options) {
  if (!options.vertex_colors.empty() && options.vertex_colors.size() != soup.points.size())
    throw UsageError("there are " + std::to_string(options.vertex_colors.size()) + " colours for " +
                     std::to_string(soup.points.size()) + " vertices");
  for (std::size_t v = 0; v < soup.points.size(); ++v)
    if (!soup.points[v].allFinite())
      throw MeshError("vertex " + std::to_string(v) + " of the mesh to write is not finite");
  MeshText text(soup, options);
  switch (format) {
    case MeshFormat::kOff:
      return text.off();
    case MeshFormat::kObj:
      return text.obj();
    case MeshFormat::kPly:
      return options.ascii ? text.ply_text() : text.ply_binary();
    default:
      throw UsageError("STL is only read, not written");
  }
}

void write_mesh(const std::string& path, const PolygonSoup& soup, const WriteMeshOptions& options) {
  write_file_atomically(path, format_mesh(soup, written_mesh_format_of(path), options));
}
void write_mesh(const std::string& path, const DefaultMesh& mesh, const WriteMeshOptions& options) {
  write_mesh(path, to_polygon_soup(mesh), options);
}

}  // namespace mspskel
