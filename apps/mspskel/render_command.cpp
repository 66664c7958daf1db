// mspskel render MESH [SKELETON] OUT.png: a picture without a window.
#include <filesystem>
#include <fstream>
#include <iterator>

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

class RenderCommand : public Command {
 public:
  RenderCommand();
  int run() override;

 private:
  std::vector<std::string> files_;
  std::string segments_;
  RenderOptions options_;
  Execution execution_;
};

RenderCommand::RenderCommand()
    : Command("render MESH [SKELETON] OUT.png [options]",
              "Draws a mesh, as a ghost round its skeleton if there is one. Where the skeleton leaves the "
              "solid it is red.") {
  CommandLine& table = line();
  table.arguments("FILES", files_,
                  "mesh (.off .obj .ply .stl .vtk .vtp .gltf .glb .3mf), skeleton (.skel .obj .ply .json "
                  ".swc .cgal .polylines.txt), picture (.png)");
  table.text("--segments", segments_, "FILE.seg", "colours the faces by their parts, one number a line");
  table.number("--views", options_.view_count, {1, 16}, "views side by side");
  table.number("--width", options_.width, {16, 8192}, "of one view, pixels");
  table.number("--height", options_.height, {16, 8192}, "of one view, pixels");
  table.number("--azimuth", options_.azimuth, {-360, 360}, "of the three-quarter view, degrees");
  table.number("--elevation", options_.elevation, {-90, 90}, "of the three-quarter view, degrees");
  table.number("--samples", options_.samples, {1, 4}, "along each side of a pixel");
  table.number("--opacity", options_.ghost_opacity, {0, 1}, "of the surface before a skeleton");
  table.number("--line-width", options_.line_width, {0.5, 100}, "of the skeleton, pixels");
  table.flag("--wireframe", options_.wireframe, "draw the edges of the triangles");
  table.number("-t,--threads", execution_.threads, {0, 4096}, "0: as many as the machine has");
}

int RenderCommand::run() {
  if (files_.size() < 2 || files_.size() > 3)
    throw UsageError("render takes a mesh, perhaps a skeleton, and a picture");
  if (files_.back() != "-" && std::filesystem::path(files_.back()).extension() != ".png")
    throw UsageError(files_.back() + ": pictures are .png files");
  std::vector<FileRole> read{{files_.front(), "the mesh"}};
  if (files_.size() == 3) read.push_back({files_[1], "the skeleton"});
  read.push_back({segments_, "the parts"});
  refuse_shared_files(read, {{files_.back(), "the picture"}});

  RenderScene scene;
  scene.surface = read_polygon_soup(files_.front());
  if (!segments_.empty()) color_by_part(scene, read_parts(segments_));
  if (files_.size() == 3) scene.skeleton = read_skeleton(files_[1]);
  write_file_atomically(files_.back(), encode_png(render(scene, options_, execution_)));
  return 0;
}

}  // namespace

std::unique_ptr<Command> make_render_command(const std::vector<std::string>&) {
  return std::make_unique<RenderCommand>();
}

}  // namespace mspskel::cli
