#include "stage_files.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <utility>
#include <vector>

#include "mspskel/base/error.h"
#include "mspskel/io/write_mesh.h"

namespace mspskel::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNames[] = {"msp.csv",           "msp_initial.ply", "msp.ply",
                                  "error_initial.ply", "error.ply",       "skeleton_mesh.ply"};

// Lines of comma-separated numbers, the shortest that read back the same.
class CsvText {
 public:
  explicit CsvText(const std::string& header) : text_(header + "\n") {}
  template <class Number>
  CsvText& operator<<(Number x) {
    if (!std::isfinite(static_cast<double>(x)))
      throw NoSkeletonError("a slice or skeletal point has a number that is not finite");
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof digits, x).ptr;
    if (!text_.empty() && text_.back() != '\n') text_ += ',';
    text_.append(digits, end);
    return *this;
  }
  CsvText& operator<<(const Vector3& x) { return *this << x.x() << x.y() << x.z(); }
  void end_line() { text_ += '\n'; }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

std::string msp_csv(const ExtractResult& result) {
  const VertexSlices &first = result.initial_slices, &last = result.slices;
  const NormalisedFrame& frame = result.surface.frame;
  CsvText csv(
      "vertex,msp_initial,msp,error_initial,error,normal_x,normal_y,normal_z,contour_points,refined,"
      "center_x,center_y,center_z");
  for (Index v = 0; v < result.surface.vertex_count(); ++v) {
    const Vector3 centre = last.valid[v] ? frame.to_model(last.centre[v]) : Vector3::Zero();
    csv << v << frame.scale * first.perimeter[v] << frame.scale * last.perimeter[v] << first.error[v]
        << last.error[v] << last.normal[v] << last.contour_points[v] << static_cast<int>(last.refined[v])
        << centre;
    csv.end_line();
  }
  return csv.text();
}

PolygonSoup moved_mesh(const SurfaceSnapshot& surface, const std::vector<Vector3>& positions) {
  PolygonSoup soup;
  for (const Vector3& x : positions) soup.points.push_back(surface.frame.to_model(x));
  for (Index h = 0; h < surface.halfedge_count(); h += 3)
    soup.add_triangle(surface.origin[h], surface.origin[h + 1], surface.origin[h + 2]);
  return soup;
}

}  // namespace

std::vector<std::string> stage_file_paths(const std::string& folder) {
  std::vector<std::string> paths;
  for (const char* name : kNames) paths.push_back((fs::path(folder) / name).string());
  return paths;
}

void add_stage_files(const std::string& folder, const ExtractResult& result, OutputFiles& files) {
  files.make_folder(folder);
  const auto add = [&](const char* name, std::string bytes) {
    files.add((fs::path(folder) / name).string(), std::move(bytes));
  };
  add("msp.csv", msp_csv(result));

  const PolygonSoup mesh = moved_mesh(result.surface, result.surface.position);
  const auto add_coloured = [&](const char* name, const std::vector<double>& values, double low,
                                double high) {
    WriteMeshOptions options;
    options.vertex_colors = color_by_value(values, low, high);
    add(name, format_mesh(mesh, MeshFormat::kPly, options));
  };
  // One scale for both, so that the two pictures compare.
  const auto& msp = result.initial_slices.perimeter;
  const auto [low, high] = std::minmax_element(msp.begin(), msp.end());
  add_coloured("msp_initial.ply", msp, *low, *high);
  add_coloured("msp.ply", result.slices.perimeter, *low, *high);
  add_coloured("error_initial.ply", result.initial_slices.error, 0, 1);
  add_coloured("error.ply", result.slices.error, 0, 1);
  add("skeleton_mesh.ply",
      format_mesh(moved_mesh(result.surface, result.skeleton_mesh.position), MeshFormat::kPly));
}

}  // namespace mspskel::cli
