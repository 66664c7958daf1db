#include "mspskel/segment/border_costs.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>

#include "mspskel/base/error.h"

namespace mspskel {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

struct Faces {
  explicit Faces(const SurfaceSnapshot& surface) {
    for (Index f = 0; f < surface.face_count(); ++f) {
      const Vector3 normal = 0.5 * surface.face_normal_times_twice_area(f);
      weighted_normal.push_back(normal);
      area.push_back(normal.norm());
      total += area.back();
      middle.push_back((surface.position[surface.origin[3 * f]] +
                        surface.position[surface.origin[3 * f + 1]] +
                        surface.position[surface.origin[3 * f + 2]]) /
                       3);
    }
  }
  std::vector<Vector3> weighted_normal, middle;
  std::vector<double> area;
  double total = 0;
};

double edge_length(const SurfaceSnapshot& s, Index h) {
  return (s.position[s.target(h)] - s.position[s.origin[h]]).norm();
}

// One implicit step of diffusion over the faces: (M + reach^2 L) x = M n.
std::vector<Vector3> diffused_normals(const SurfaceSnapshot& surface, const Faces& faces, double reach) {
  const Index count = surface.face_count();
  const double mean = faces.total / count;
  std::vector<Eigen::Triplet<double>> entries;
  for (Index f = 0; f < count; ++f) {
    // Faces without area follow their neighbours.
    entries.emplace_back(f, f, faces.area[f] + 1e-9 * mean);
    for (Index h = 3 * f; h < 3 * f + 3; ++h) {
      const Index g = surface.twin[h] / 3;
      const double apart = std::max((faces.middle[f] - faces.middle[g]).norm(), 1e-3 * std::sqrt(mean));
      const double flow = reach * reach * edge_length(surface, h) / apart;
      entries.emplace_back(f, f, flow);
      entries.emplace_back(f, g, -flow);
    }
  }
  Matrix system(count, count);
  system.setFromTriplets(entries.begin(), entries.end());
  // Positive definite, since the faces have area.
  const Eigen::SimplicialLDLT<Matrix> solver(system);
  Eigen::MatrixXd given(count, 3);
  for (Index f = 0; f < count; ++f) given.row(f) = faces.weighted_normal[f];
  const Eigen::MatrixXd solution = solver.solve(given);
  std::vector<Vector3> normals(count);
  for (Index f = 0; f < count; ++f) normals[f] = solution.row(f);
  return normals;
}

}  // namespace

void validate(const CreaseOptions& options) {
  if (!(options.crease >= 0 && options.crease <= 100))
    throw UsageError("creases: crease must be from 0 to 100");
  if (!(options.width >= 0 && options.width <= 1)) throw UsageError("creases: width must be from 0 to 1");
}

std::vector<double> border_costs(const SurfaceSnapshot& surface, const CreaseOptions& options) {
  validate(options);
  const Faces faces(surface);
  const double reach = options.width * std::sqrt(faces.total);
  const std::vector<Vector3> normals =
      reach > 0 ? diffused_normals(surface, faces, reach) : faces.weighted_normal;
  std::vector<double> costs(surface.halfedge_count());
  for (Index h = 0; h < surface.halfedge_count(); ++h) {
    const Index k = surface.twin[h];
    if (k < h) {
      costs[h] = costs[k];
      continue;
    }
    const Vector3 &a = normals[h / 3], &b = normals[k / 3];
    const Vector3 across = faces.middle[k / 3] - faces.middle[h / 3];
    const double apart = across.norm();
    // Across a sharp crease diffused normals turn by apart / (2 reach) of its angle between two faces.
    const double spread = apart > 0 ? std::max(1.0, 2 * reach / apart) : 1.0;
    const bool concave = (a.normalized() - b.normalized()).dot(across) > 0;
    const double angle = concave ? std::min(kPi, spread * std::atan2(a.cross(b).norm(), a.dot(b))) : 0.0;
    costs[h] = edge_length(surface, h) / (1 + options.crease * angle);
  }
  return costs;
}

}  // namespace mspskel
