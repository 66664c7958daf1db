// Writes the parts of a surface.
#pragma once

#include <string>
#include <vector>

#include "mspskel/io/write_mesh.h"

namespace mspskel {

enum class SegmentFormat {
  kSeg,  // .seg: the part of each face, a line each, as the Princeton benchmark has it
  kPly,  // .ply: the surface; faces with red, green, blue and part
};

// By extension, in any case; "-" is kSeg. Throws UsageError that lists the known extensions.
SegmentFormat segment_format_of(const std::string& path);

// A colour a part, neighbours in number far apart in hue; they repeat after some hundred.
VertexColor color_of_part(Index part);

// The bytes of a file. Throws UsageError if there is not one part a polygon, MeshError that names a point
// that is not finite.
std::string format_segments(const PolygonSoup& surface, const std::vector<Index>& part_of_face,
                            SegmentFormat format);

// format_segments for the path's extension, written as write_file_atomically does.
void write_segments(const std::string& path, const PolygonSoup& surface,
                    const std::vector<Index>& part_of_face);

}  // namespace mspskel
