// mspskel render MESH [SKELETON] OUT.png: a picture without a window.
#include <filesystem>

#include "command_line.h"
#include "commands.h"
#include "distinct_files.h"
#include "mspskel/base/error.h"
#include "mspskel/io/atomic_file.h"
#include "mspskel/io/read_mesh.h"
#include "mspskel/io/read_skeleton.h"
#include "mspskel/render/render.h"

namespace mspskel::cli {

int render_command(const std::vector<std::string>& arguments) {
  std::vector<std::string> files;
  RenderOptions options;
  Execution execution;
  CommandLine line("render MESH [SKELETON] OUT.png [options]",
                   "Draws a mesh, as a ghost round its skeleton if there is one. Where the skeleton leaves "
                   "the solid it is red.");
  line.arguments("FILES", files,
                 "mesh (.off .obj .ply .stl), skeleton (.skel .obj .ply .json), picture (.png)");
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
  refuse_shared_files(read, {{files.back(), "the picture"}});

  RenderScene scene;
  scene.surface = read_polygon_soup(files.front());
  if (files.size() == 3) scene.skeleton = read_skeleton(files[1]);
  write_file_atomically(files.back(), encode_png(render(scene, options, execution)));
  return 0;
}

}  // namespace mspskel::cli
