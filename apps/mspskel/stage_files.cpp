#include "stage_files.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <vector>

#include "mspskel/base/error.h"
#include "mspskel/io/atomic_file.h"
#include "mspskel/io/write_mesh.h"

namespace mspskel::cli {
namespace {

// Lines of comma-separated numbers, the shortest that read back the same.
class CsvText {
 public:
  explicit CsvText(const std::string& header) : text_(header + "\n") {}
  template <class Number>
  CsvText& operator<<(Number x) {
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

void make_stage_folder(const std::string& folder) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure) throw WriteError(folder + ": " + failure.message());
}

void write_stage_files(const std::string& folder, const ExtractResult& result) {
  const auto path = [&](const char* name) { return (std::filesystem::path(folder) / name).string(); };
  write_file_atomically(path("msp.csv"), msp_csv(result));

  const PolygonSoup mesh = moved_mesh(result.surface, result.surface.position);
  const auto write_coloured = [&](const char* name, const std::vector<double>& values, double low,
                                  double high) {
    WriteMeshOptions options;
    options.vertex_colors = color_by_value(values, low, high);
    write_mesh(path(name), mesh, options);
  };
  // One scale for both, so that the two pictures compare.
  const auto& msp = result.initial_slices.perimeter;
  const auto [low, high] = std::minmax_element(msp.begin(), msp.end());
  write_coloured("msp_initial.ply", msp, *low, *high);
  write_coloured("msp.ply", result.slices.perimeter, *low, *high);
  write_coloured("error_initial.ply", result.initial_slices.error, 0, 1);
  write_coloured("error.ply", result.slices.error, 0, 1);
  write_mesh(path("skeleton_mesh.ply"), moved_mesh(result.surface, result.skeleton_mesh.position));
}

}  // namespace mspskel::cli
