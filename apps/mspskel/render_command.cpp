// mspskel render MESH [SKELETON] OUT.png: a picture without a window.
#include <filesystem>
#include <fstream>
#include <iterator>

#include "command_line.h"
#include "commands.h"
#include "distinct_files.h"
#include "mspskel/base/error.h"
#include "mspskel/io/atomic_file.h"
#include "mspskel/io/read_mesh.h"
#include "mspskel/io/read_skeleton.h"
#include "mspskel/io/write_segments.h"
#include "mspskel/render/render.h"

namespace mspskel::cli {
namespace {

std::vector<Index> read_parts(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw ReadError("cannot read " + path);
  std::vector<Index> parts{std::istream_iterator<Index>(file), {}};
  if (!file.eof())
    throw ReadError(path + ": line " + std::to_string(parts.size() + 1) + " is not the number of a part");
  return parts;
}

// Each polygon with points of its own, since colours belong to points.
void color_by_part(RenderScene& scene, const std::vector<Index>& parts) {
  const PolygonSoup whole = std::move(scene.surface);
  if (parts.size() != whole.polygon_count())
    throw UsageError("there are parts for " + std::to_string(parts.size()) + " faces, but " +
                     std::to_string(whole.polygon_count()) + " faces");
  scene.surface = {};
  for (std::size_t f = 0; f < parts.size(); ++f) {
    const VertexColor color = color_of_part(parts[f]);
    for (Index i = whole.begin[f]; i < whole.begin[f + 1]; ++i) {
      scene.surface.corners.push_back(static_cast<Index>(scene.surface.points.size()));
      scene.surface.points.push_back(whole.points[whole.corners[i]]);
      scene.vertex_color.push_back({color.red, color.green, color.blue});
    }
    scene.surface.begin.push_back(static_cast<Index>(scene.surface.corners.size()));
  }
}

}  // namespace

int render_command(const std::vector<std::string>& arguments) {
  std::vector<std::string> files;
  RenderOptions options;
  Execution execution;
  CommandLine line("render MESH [SKELETON] OUT.png [options]",
                   "Draws a mesh, as a ghost round its skeleton if there is one. Where the skeleton leaves "
                   "the solid it is red.");
  line.arguments("FILES", files,
                 "mesh (.off .obj .ply .stl), skeleton (.skel .obj .ply .json), picture (.png)");
  std::string segments;
  line.text("--segments", segments, "FILE.seg", "colours the faces by their parts, one number a line");
  line.number("--views", options.view_count, {1, 16}, "views side by side");
  line.number("--width", options.width, {16, 8192}, "of one view, pixels");
  line.number("--height", options.height, {16, 8192}, "of one view, pixels");
  line.number("--azimuth", options.azimuth, {-360, 360}, "of the three-quarter view, degrees");
  line.number("--elevation", options.elevation, {-90, 90}, "of the three-quarter view, degrees");
  line.number("--samples", options.samples, {1, 4}, "along each side of a pixel");
  line.number("--opacity", options.ghost_opacity, {0, 1}, "of the surface before a skeleton");
  line.number("--line-width", options.line_width, {0.5, 100}, "of the skeleton, pixels");
  line.flag("--wireframe", options.wireframe, "draw the edges of the triangles");
  line.number("-t,--threads", execution.threads, {0, 4096}, "0: as many as the machine has");
  if (!line.parse(arguments)) return 0;
  if (files.size() < 2 || files.size() > 3)
    throw UsageError("render takes a mesh, perhaps a skeleton, and a picture");
  if (files.back() != "-" && std::filesystem::path(files.back()).extension() != ".png")
    throw UsageError(files.back() + ": pictures are .png files");
  std::vector<FileRole> read{{files.front(), "the mesh"}};
  if (files.size() == 3) read.push_back({files[1], "the skeleton"});
  read.push_back({segments, "the parts"});
  refuse_shared_files(read, {{files.back(), "the picture"}});

  RenderScene scene;
  scene.surface = read_polygon_soup(files.front());
  if (!segments.empty()) color_by_part(scene, read_parts(segments));
  if (files.size() == 3) scene.skeleton = read_skeleton(files[1]);
  write_file_atomically(files.back(), encode_png(render(scene, options, execution)));
  return 0;
}

}  // namespace mspskel::cli
