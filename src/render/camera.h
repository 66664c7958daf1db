// Where the pictures are taken from.
#pragma once

#include <vector>

#include "mspskel/render/render.h"
#include "surface.h"

namespace mspskel::render_detail {

// Upright frame of the model: orthonormal and right-handed.
struct ModelFrame {
  Vector3 right = Vector3::UnitX(), up = Vector3::UnitY(), toward = Vector3::UnitZ();
  bool tall = false;  // the longest axis is `up`, else `right`
};

// From the area-weighted covariance of the surface, or of the skeleton's nodes and the lines without a
// surface.
ModelFrame make_model_frame(const DrawSurface& surface, const std::vector<Vector3>& other_points);

// Orthographic camera that maps into the samples of one cell: x to the right, y downwards, depth away from
// the viewer, all three in samples.
struct Camera {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  // rows: right, up, toward the viewer
  Vector3 focus = Vector3::Zero();                     // drawn in the middle
  double scale = 1.0;                                  // samples a unit of length
  double middle_x = 0.0, middle_y = 0.0;               // samples

  Vector3 project(const Vector3& p) const {
    const Vector3 q = scale * (axes * (p - focus));
    return {middle_x + q.x(), middle_y - q.y(), -q.z()};
  }
  Eigen::Vector3f turn(const Eigen::Vector3f& normal) const { return axes.cast<float>() * normal; }
};

std::vector<Camera> make_cameras(const ModelFrame& frame,
                                 const std::vector<const std::vector<Vector3>*>& points,
                                 const RenderOptions& options);

}  // namespace mspskel::render_detail
