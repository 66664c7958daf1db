#include "mspskel/io/write_segments.h"

#include <cmath>

#include "append_text.h"
#include "mspskel/base/error.h"
#include "mspskel/base/near_name.h"
#include "mspskel/io/atomic_file.h"
#include "read_bytes.h"

namespace mspskel {
namespace {

using detail::append_all;

std::string seg_text(const std::vector<Index>& part_of_face) {
  std::string out;
  for (const Index part : part_of_face) append_all(out, part, '\n');
  return out;
}

std::string ply_text(const PolygonSoup& surface, const std::vector<Index>& part_of_face) {
  std::string out;
  append_all(out, "ply\nformat ascii 1.0\nelement vertex ", surface.points.size(),
             "\nproperty double x\nproperty double y\nproperty double z\nelement face ",
             surface.polygon_count(),
             "\nproperty list int int vertex_indices\nproperty uchar red\nproperty uchar green\n"
             "property uchar blue\nproperty int part\nend_header\n");
  for (const Vector3& p : surface.points) append_all(out, p, '\n');
  for (std::size_t f = 0; f < surface.polygon_count(); ++f) {
    append_all(out, surface.begin[f + 1] - surface.begin[f]);
    for (Index i = surface.begin[f]; i < surface.begin[f + 1]; ++i) append_all(out, ' ', surface.corners[i]);
    const VertexColor c = color_of_part(part_of_face[f]);
    append_all(out, ' ', Index{c.red}, ' ', Index{c.green}, ' ', Index{c.blue}, ' ', part_of_face[f], '\n');
  }
  return out;
}

}  // namespace

SegmentFormat segment_format_of(const std::string& path) {
  if (path == "-") return SegmentFormat::kSeg;
  const std::string extension = detail::extension_of(path);
  if (extension == "seg") return SegmentFormat::kSeg;
  if (extension == "ply") return SegmentFormat::kPly;
  throw unknown_extension("parts' format", path, {".seg", ".ply"});
}

VertexColor color_of_part(Index part) {
  // Hues a golden angle apart; the body, which is part 0, is grey.
  if (part == 0) return {176, 190, 210};
  const double hue = std::fmod(0.61803398875 * part, 1.0);
  const double light = part % 3 == 0 ? 0.62 : part % 3 == 1 ? 0.95 : 0.8;
  const auto channel = [&](double shift) {
    const double x = std::fmod(hue + shift, 1.0) * 6;
    const double full = std::fmin(1.0, std::fmax(0.0, std::fabs(x - 3) - 1));
    return static_cast<std::uint8_t>(std::lround(255 * light * (0.3 + 0.7 * full)));
  };
  return {channel(0.0), channel(2.0 / 3), channel(1.0 / 3)};
}

std::string format_segments(const PolygonSoup& surface, const std::vector<Index>& part_of_face,
                            SegmentFormat format) {
  if (part_of_face.size() != surface.polygon_count())
    throw UsageError("there are parts for " + std::to_string(part_of_face.size()) + " faces, but " +
                     std::to_string(surface.polygon_count()) + " faces");
  for (std::size_t v = 0; v < surface.points.size(); ++v)
    if (!surface.points[v].allFinite())
      throw MeshError("vertex " + std::to_string(v) + " of the surface to write is not finite");
  return format == SegmentFormat::kSeg ? seg_text(part_of_face) : ply_text(surface, part_of_face);
}

void write_segments(const std::string& path, const PolygonSoup& surface,
                    const std::vector<Index>& part_of_face) {
  write_file_atomically(path, format_segments(surface, part_of_face, segment_format_of(path)));
}

}  // namespace mspskel
