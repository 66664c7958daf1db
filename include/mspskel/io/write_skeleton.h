// Writes a curve skeleton in the formats that other programs read.
#pragma once

#include <string>
#include <vector>

#include "mspskel/skeleton/curve_skeleton.h"
#include "mspskel/skeleton/spanning_forest.h"

namespace mspskel {

enum class SkeletonFormat {
  kSkel,       // .skel: a header line, the node count, then `id x y z radius n id...` a node (CinoLib, CGoGN)
  kObj,        // .obj: v and l
  kPly,        // .ply: text; vertices with radius, edges with vertex1 and vertex2
  kJson,       // .json: node-link form (networkx) with radii, branches, surface map and report
  kSwc,        // .swc: index type x y z radius parent, types 1 soma, 5 fork, 6 end, 0 else; loops are cut at
               // their thinnest edge, which is kept as a comment
  kVtp,        // .vtp: a polyline a branch, from the root outward, with VMTK's arrays (src/io/write_vtp.h)
  kGraphml,    // .graphml
  kPolylines,  // .cgal, .polylines.txt: `n x1 y1 z1 ...` a branch
};

// By extension, in any case; "-" is kSkel. Throws UsageError that lists the known extensions.
SkeletonFormat skeleton_format_of(const std::string& path);
// Those that it knows, with their dots.
std::vector<std::string> skeleton_extensions();

// Throws NoSkeletonError that names the node if one of its numbers is not finite.
void refuse_not_finite(const CurveSkeleton& skeleton);

// The bytes of a file, each number in the shortest form that reads back exactly (17 significant digits at
// most). `report` is the text of a JSON object that JSON files carry as "report"; empty: none. Throws
// UsageError if it is not JSON, NoSkeletonError as refuse_not_finite does. `root`: where the trees of SWC and
// the lines of VTP begin.
std::string format_skeleton(const CurveSkeleton& skeleton, SkeletonFormat format,
                            const std::string& report = "", const RootChoice& root = {});

// What the format cannot hold, a sentence each; empty for most.
std::vector<std::string> losses_of_format(const CurveSkeleton& skeleton, SkeletonFormat format);

// format_skeleton for the path's extension, written as write_file_atomically does.
void write_skeleton(const std::string& path, const CurveSkeleton& skeleton, const std::string& report = "",
                    const RootChoice& root = {});

}  // namespace mspskel
