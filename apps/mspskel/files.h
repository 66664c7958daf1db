// Skeleton and mesh files.
#pragma once

#include <string>

#include "mspskel/graph/curve_skeleton.h"
#include "mspskel/mesh/polygon_soup.h"

namespace mspskel::cli {

// Writes under a temporary name and renames; "-" is stdout. Throws WriteError.
void write_file(const std::string& path, const std::string& bytes);
// Throws UsageError for an extension that cannot be written.
void skeleton_format_of(const std::string& path);
void write_skeleton(const std::string& path, const CurveSkeleton& skeleton);  // .skel .obj
CurveSkeleton read_skeleton(const std::string& path);                         // .skel
void write_mesh(const std::string& path, const PolygonSoup& soup);            // .off

}  // namespace mspskel::cli
