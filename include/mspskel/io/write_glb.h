// Writes binary glTF 2.0: a surface with its skeleton as lines, or with joints that bend it.
#pragma once

#include <string>
#include <vector>

#include "mspskel/mesh/polygon_soup.h"
#include "mspskel/rig/rig.h"
#include "mspskel/skeleton/curve_skeleton.h"

namespace mspskel {

// Triangles in model coordinates. The skeleton's nodes carry their radius as the attribute _RADIUS. Positions
// are 32-bit floats. The same input gives the same bytes.
struct GlbScene {
  std::string name;        // of the surface; any text in UTF-8
  PolygonSoup surface;     // triangles
  CurveSkeleton skeleton;  // drawn as lines unless it has no edges
};

// Surface, half transparent, and skeleton as two meshes of one scene. Throws UsageError for a polygon that is
// no triangle, a corner out of range or a surface without triangles, MeshError for coordinates that are no
// finite 32-bit floats. O(faces + nodes).
std::string format_glb(const GlbScene& scene);

// The surface with a skin: each joint is a node under joint 0, which is a root of the scene, at rest moved
// only, so that turning it bends the surface; `turns` are written as the nodes' rotations. Throws as above,
// and UsageError for a rig of another number of vertices or a turn of no joint.
std::string format_rigged_glb(const GlbScene& scene, const Rig& rig,
                              const std::vector<JointTurn>& turns = {});

// RigNet's text form: `joints NAME x y z`, `root NAME`, `skin VERTEX NAME weight ...`, `hier PARENT CHILD`.
std::string format_rig_text(const Rig& rig);

// Whether the path ends in .glb; in .rig.txt. In any case.
bool is_glb(const std::string& path);
bool is_rig_text(const std::string& path);

}  // namespace mspskel
