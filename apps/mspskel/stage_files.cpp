#include "stage_files.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <vector>

#include "files.h"
#include "mspskel/base/error.h"
#include "mspskel/render/image.h"

namespace mspskel::cli {
namespace {

// Text of comma- or blank-separated numbers, the shortest that read back the same.
class Lines {
 public:
  explicit Lines(char separator) : separator_(separator) {}
  template <class Number>
  Lines& operator<<(Number x) {
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof digits, x).ptr;
    if (!text_.empty() && text_.back() != '\n') text_ += separator_;
    text_.append(digits, end);
    return *this;
  }
  Lines& operator<<(const Vector3& x) { return *this << x.x() << x.y() << x.z(); }
  Lines& words(const std::string& text) {
    text_ += text;
    return *this;
  }
  void end_line() { text_ += '\n'; }
  const std::string& text() const { return text_; }

 private:
  char separator_;
  std::string text_;
};

std::string msp_csv(const ExtractResult& result) {
  const VertexSlices &first = result.initial_slices, &last = result.slices;
  const NormalisedFrame& frame = result.surface.frame;
  Lines csv(',');
  csv.words(
      "vertex,msp_initial,msp,error_initial,error,normal_x,normal_y,normal_z,contour_points,refined,"
      "center_x,center_y,center_z\n");
  for (Index v = 0; v < result.surface.vertex_count(); ++v) {
    const Vector3 centre = last.valid[v] ? frame.to_model(last.centre[v]) : Vector3::Zero();
    csv << v << frame.scale * first.perimeter[v] << frame.scale * last.perimeter[v] << first.error[v]
        << last.error[v] << last.normal[v] << last.contour_points[v] << static_cast<int>(last.refined[v])
        << centre;
    csv.end_line();
  }
  return csv.text();
}

// `color` may be empty.
std::string mesh_ply(const SurfaceSnapshot& surface, const std::vector<Vector3>& points,
                     const std::vector<Color>& color) {
  Lines ply(' ');
  ply.words("ply\nformat ascii 1.0\nelement vertex " + std::to_string(points.size()) +
            "\nproperty double x\nproperty double y\nproperty double z\n");
  if (!color.empty()) ply.words("property uchar red\nproperty uchar green\nproperty uchar blue\n");
  ply.words("element face " + std::to_string(surface.face_count()) +
            "\nproperty list uchar int vertex_indices\nend_header\n");
  for (std::size_t v = 0; v < points.size(); ++v) {
    ply << surface.frame.to_model(points[v]);
    if (!color.empty()) ply << int{color[v].red} << int{color[v].green} << int{color[v].blue};
    ply.end_line();
  }
  for (Index h = 0; h < surface.halfedge_count(); h += 3) {
    ply << 3 << surface.origin[h] << surface.origin[h + 1] << surface.origin[h + 2];
    ply.end_line();
  }
  return ply.text();
}

std::vector<Color> colors(const std::vector<double>& values, double low, double high) {
  std::vector<Color> result;
  result.reserve(values.size());
  for (const double x : values) result.push_back(blue_to_red(high > low ? (x - low) / (high - low) : 0.0));
  return result;
}

}  // namespace

void make_stage_folder(const std::string& folder) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure) throw WriteError(folder + ": " + failure.message());
}

void write_stage_files(const std::string& folder, const ExtractResult& result) {
  const auto write = [&](const char* name, const std::string& bytes) {
    write_file((std::filesystem::path(folder) / name).string(), bytes);
  };
  const SurfaceSnapshot& surface = result.surface;
  write("msp.csv", msp_csv(result));
  // One scale for both, so that the two pictures compare.
  const auto& msp = result.initial_slices.perimeter;
  const auto [low, high] = std::minmax_element(msp.begin(), msp.end());
  write("msp_initial.ply", mesh_ply(surface, surface.position, colors(msp, *low, *high)));
  write("msp.ply", mesh_ply(surface, surface.position, colors(result.slices.perimeter, *low, *high)));
  write("error_initial.ply", mesh_ply(surface, surface.position, colors(result.initial_slices.error, 0, 1)));
  write("error.ply", mesh_ply(surface, surface.position, colors(result.slices.error, 0, 1)));
  write("skeleton_mesh.ply", mesh_ply(surface, result.skeleton_mesh.position, {}));
}

}  // namespace mspskel::cli
