#include "find_openings.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace mspskel::detail {
namespace {

// The faces near a loop, by how they lie.
class Wall {
 public:
  Wall(const std::vector<Vector3>& points, const FaceSet& faces, const std::vector<Index>& twin,
       const std::vector<Index>& loop, const LoopShape& shape, std::vector<char>& visited) {
    double reach = 0;
    for (const Index h : loop) reach = std::max(reach, (points[faces.origin(h)] - shape.centre).norm());
    reach += loop_radius(shape);
    const auto to_middle = [&](Index f) {
      const Index* c = &faces.corners[3 * f];
      return Vector3((points[c[0]] + points[c[1]] + points[c[2]]) / 3 - shape.centre);
    };
    std::vector<Index> reached;
    const auto visit = [&](Index f) {
      if (f >= static_cast<Index>(visited.size()) || visited[f]) return;
      visited[f] = 1;
      reached.push_back(f);
    };
    for (const Index h : loop) visit(h / 3);
    for (std::size_t i = 0; i < reached.size(); ++i) {
      const Index f = reached[i];
      const Vector3 area = area_vector(points, faces, f);
      if (area.norm() > 0) normals_ += area * area.transpose() / area.norm();
      facing_ += area.dot(to_middle(f));
      for (Index h = 3 * f; h < 3 * f + 3; ++h)
        if (twin[h] != kNone && to_middle(twin[h] / 3).norm() <= reach) visit(twin[h] / 3);
    }
    for (const Index f : reached) visited[f] = 0;
    find_axis(shape.area.normalized());
  }

  bool is_tube() const {
    constexpr double kMostAcross = 0.25;
    return axis_.dot(normals_ * axis_) < kMostAcross * normals_.trace();
  }
  const Vector3& axis() const { return axis_; }
  bool faces_outward() const { return facing_ > 0; }

 private:
  // Along what the faces run best, turned back to within 30 degrees of the hole's normal.
  void find_axis(const Vector3& normal) {
    constexpr double kMostAside = kPi / 6;
    axis_ = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(normals_).eigenvectors().col(0);
    if (axis_.dot(normal) < 0) axis_ = -axis_;
    if (axis_.dot(normal) >= std::cos(kMostAside)) return;
    const Vector3 aside = (axis_ - axis_.dot(normal) * normal).normalized();
    axis_ = std::cos(kMostAside) * normal + std::sin(kMostAside) * aside;
  }

  Eigen::Matrix3d normals_ = Eigen::Matrix3d::Zero();  // sum of n nᵀ by area
  double facing_ = 0;                                  // away from the loop's centre, by area
  Vector3 axis_;
};

bool is_mouth(const std::vector<Vector3>& loop, const LoopShape& shape) {
  constexpr double kLeastRoundness = 0.25;
  return 4 * kPi * shape.area.norm() >= kLeastRoundness * shape.length * shape.length &&
         is_star_shaped(loop, shape);
}

}  // namespace

std::optional<TubeEnd> tube_end(const std::vector<Vector3>& points, const FaceSet& faces,
                                const std::vector<Index>& twin, const std::vector<Index>& loop,
                                const std::vector<Vector3>& rim, std::vector<char>& visited) {
  const LoopShape ragged = loop_shape(rim);
  if (!(ragged.area.norm() > 0)) return std::nullopt;
  const Wall wall(points, faces, twin, loop, ragged, visited);
  if (!wall.is_tube()) return std::nullopt;
  TubeEnd end;
  const std::vector<Index> left =
      fill_notches(rim, {ragged.centre, wall.axis(), wall.faces_outward()}, end.closing);
  std::vector<Vector3> taut;
  for (const Index i : left) taut.push_back(rim[i]);
  end.shape = loop_shape(taut);
  if (left.size() <= 3 || !is_mouth(taut, end.shape)) return std::nullopt;
  add_fan(left, static_cast<Index>(rim.size()), end.closing);
  return end;
}

double loop_radius(const LoopShape& shape) {
  return shape.length > 0 ? 2 * shape.area.norm() / shape.length : 0.0;
}

}  // namespace mspskel::detail
