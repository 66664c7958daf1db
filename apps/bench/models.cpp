#include "models.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "mspskel/io/read_mesh.h"
#include "mspskel/mesh/build_mesh.h"
#include "mspskel/samples/samples.h"

namespace mspskel::bench {
namespace {

std::filesystem::path model_folder() {
  const char* meshes = std::getenv("MSPSKEL_MESHES");
  const std::filesystem::path root =
      meshes != nullptr ? meshes
                        : std::filesystem::path(MSPSKEL_SOURCE_DIR).parent_path() / "shared" / "meshes";
  return root / "models";
}

std::string off_text(const PolygonSoup& soup) {
  std::ostringstream out;
  out.precision(17);
  out << "OFF\n" << soup.points.size() << " " << soup.polygon_count() << " 0\n";
  for (const Vector3& p : soup.points) out << p.x() << " " << p.y() << " " << p.z() << "\n";
  for (std::size_t f = 0; f < soup.polygon_count(); ++f) {
    out << soup.begin[f + 1] - soup.begin[f];
    for (Index c = soup.begin[f]; c < soup.begin[f + 1]; ++c) out << " " << soup.corners[c];
    out << "\n";
  }
  return out.str();
}

Model make_model(const std::string& name, std::string bytes) {
  Model model{name, std::move(bytes), {}, {}};
  model.soup = read_polygon_soup(model.bytes, MeshFormat::kOff);
  model.surface = make_snapshot(build_mesh(model.soup));
  return model;
}

Model sample(const char* name, Index resolution) {
  SampleOptions options;
  options.resolution = resolution;
  return make_model("sample:" + std::string(name), off_text(make_sample(name, options)));
}

}  // namespace

const std::vector<Model>& models() {
  static const std::vector<Model> all = [] {
    std::vector<Model> list;
    list.push_back(sample("quadruped", 8000));
    list.push_back(sample("torus", 25000));
    for (const char* name : {"horse", "hand", "armadillo"}) {
      std::ifstream file(model_folder() / (std::string(name) + ".off"), std::ios::binary);
      if (file) list.push_back(make_model(name, {std::istreambuf_iterator<char>(file), {}}));
    }
    return list;
  }();
  return all;
}

}  // namespace mspskel::bench
