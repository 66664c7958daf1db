#include "camera.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

namespace mspskel::render_detail {
namespace {

// Exact second moment of the surface's area about its centroid.
Eigen::Matrix3d surface_covariance(const DrawSurface& surface, double& area) {
  area = 0.0;
  Vector3 mean = Vector3::Zero();
  Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
  for (const auto& t : surface.triangles) {
    const Vector3 a = surface.points[t[0]], b = surface.points[t[1]], c = surface.points[t[2]];
    const double w = 0.5 * (b - a).cross(c - a).norm();
    const Vector3 sum = a + b + c;
    area += w;
    mean += w / 3.0 * sum;
    moment += w / 12.0 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }
  if (area <= 0.0) return Eigen::Matrix3d::Zero();
  mean /= area;
  return moment / area - mean * mean.transpose();
}

Eigen::Matrix3d point_covariance(const std::vector<Vector3>& points) {
  Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
  if (points.empty()) return moment;
  Vector3 mean = Vector3::Zero();
  for (const Vector3& p : points) mean += p / static_cast<double>(points.size());
  for (const Vector3& p : points) moment += (p - mean) * (p - mean).transpose();
  return moment / static_cast<double>(points.size());
}

// Eigenvectors, largest eigenvalue first. Where eigenvalues agree within a few percent, as of a cube or a
// round vase, the axes in their plane are arbitrary, so they are turned to the coordinate axes as far as
// possible.
Eigen::Matrix3d principal_axes(const Eigen::Matrix3d& covariance, Vector3& values) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  values = solver.eigenvalues().reverse();
  Eigen::Matrix3d axes = solver.eigenvectors().rowwise().reverse();
  const double near = 0.04 * std::max(values[0], std::numeric_limits<double>::min());
  const bool first = values[0] - values[1] <= near, second = values[1] - values[2] <= near;
  if (first && second) return Eigen::Matrix3d::Identity();
  if (!first && !second) return axes;
  const int lone = first ? 2 : 0, u = first ? 0 : 1;
  const Vector3 n = axes.col(lone);
  int closest = 1;  // the coordinate axis that lies most in the plane; y if several do
  for (const int k : {0, 2}) {
    if (std::abs(n[k]) < std::abs(n[closest]) - 1e-6) closest = k;
  }
  const Vector3 e = Vector3::Unit(closest);
  axes.col(u) = (e - e.dot(n) * n).normalized();
  axes.col(u + 1) = n.cross(axes.col(u));
  return axes;
}

// An axis has no sign of its own; files mostly hold models with their front and top towards positive
// coordinates.
Vector3 towards_positive(const Vector3& axis) {
  int k = 0;
  axis.cwiseAbs().maxCoeff(&k);
  return axis[k] < 0 ? Vector3(-axis) : axis;
}

Eigen::Matrix3d camera_axes(const ModelFrame& frame, double azimuth, double elevation) {
  const double a = azimuth * kPi / 180.0, e = elevation * kPi / 180.0;
  const Vector3 level = std::cos(a) * frame.toward + std::sin(a) * frame.right;
  Eigen::Matrix3d axes;
  axes.row(0) = std::cos(a) * frame.right - std::sin(a) * frame.toward;
  axes.row(1) = std::cos(e) * frame.up - std::sin(e) * level;
  axes.row(2) = std::cos(e) * level + std::sin(e) * frame.up;
  return axes;
}

Camera fit(const Eigen::Matrix3d& axes, const std::vector<const std::vector<Vector3>*>& points,
           const RenderOptions& options) {
  Vector3 low = Vector3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const auto* list : points) {
    for (const Vector3& p : *list) {
      const Vector3 q = axes * p;
      low = low.cwiseMin(q);
      high = high.cwiseMax(q);
    }
  }
  const double margin = std::min(0.04 * std::min(options.width, options.height) + 1.5 * options.line_width,
                                 0.3 * std::min(options.width, options.height));
  const Vector3 size = high - low;
  const double sx = (options.width - 2 * margin) / std::max(size.x(), 1e-300);
  const double sy = (options.height - 2 * margin) / std::max(size.y(), 1e-300);
  const double largest = std::max(options.width, options.height) / std::max(size.maxCoeff(), 1e-300);
  Camera camera;
  camera.axes = axes;
  camera.focus = axes.transpose() * (0.5 * (low + high));
  // A model seen along its only extent, or a single point, is not blown up without end.
  camera.scale = options.samples * std::min({sx, sy, 1e6 * largest});
  camera.middle_x = 0.5 * options.width * options.samples;
  camera.middle_y = 0.5 * options.height * options.samples;
  return camera;
}

}  // namespace

ModelFrame make_model_frame(const DrawSurface& surface, const std::vector<Vector3>& other_points) {
  double area = 0.0;
  Eigen::Matrix3d covariance = surface_covariance(surface, area);
  if (area <= 0.0) covariance = point_covariance(other_points);
  Vector3 values;
  const Eigen::Matrix3d axes = principal_axes(covariance, values);
  constexpr double kUprightCosine = 0.866;  // 30 degrees
  int up = 1;
  for (const int k : {0, 1, 2}) {
    if (std::abs(axes.col(k).y()) > kUprightCosine) up = k;
  }
  ModelFrame frame;
  frame.up = towards_positive(axes.col(up));
  int nearest = 0;
  if (frame.up.maxCoeff(&nearest) > kUprightCosine) frame.up = Vector3::Unit(nearest);
  const Vector3 right = towards_positive(axes.col(up == 0 ? 1 : 0));
  frame.right = (right - right.dot(frame.up) * frame.up).normalized();
  frame.toward = frame.right.cross(frame.up);
  frame.tall = up == 0;
  return frame;
}

std::vector<Camera> make_cameras(const ModelFrame& frame,
                                 const std::vector<const std::vector<Vector3>*>& points,
                                 const RenderOptions& options) {
  std::vector<Camera> cameras;
  const auto add = [&](double azimuth, double elevation) {
    cameras.push_back(fit(camera_axes(frame, azimuth, elevation), points, options));
  };
  if (options.view_count >= 2) add(0, 0);
  if (options.view_count >= 3) frame.tall ? add(90, 0) : add(0, 90);
  const int rest = options.view_count - static_cast<int>(cameras.size());
  for (int k = 0; k < rest; ++k) add(options.azimuth + 360.0 * k / rest, options.elevation);
  return cameras;
}

}  // namespace mspskel::render_detail
