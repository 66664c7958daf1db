#include "mspskel/segment/border_costs.h"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "mspskel/base/error.h"

namespace mspskel {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

// Share of the normals that conjugate gradients may leave unsolved: far below the angles that count.
constexpr double kNormalError = 1e-3;

// Of the mean distance between faces' middles: across a crease between faces of one size the whole angle
// counts, but not what the narrow ends of long faces on a round wall turn by.
constexpr double kLeastWindow = 0.8;

// Some faces of a surface, or all, by their places in a list.
struct Faces {
  Faces(const SurfaceSnapshot& surface, const std::vector<char>& chosen)
      : place(surface.face_count(), kNone) {
    for (Index f = 0; f < surface.face_count(); ++f) {
      if (!chosen.empty() && !chosen[f]) continue;
      place[f] = static_cast<Index>(face.size());
      face.push_back(f);
      weighted_normal.push_back(0.5 * surface.face_normal_times_twice_area(f));
      area.push_back(weighted_normal.back().norm());
      mean += area.back();
      middle.push_back((surface.position[surface.origin[3 * f]] +
                        surface.position[surface.origin[3 * f + 1]] +
                        surface.position[surface.origin[3 * f + 2]]) /
                       3);
    }
    mean /= std::max<double>(1, static_cast<double>(face.size()));
  }
  Index count() const { return static_cast<Index>(face.size()); }

  std::vector<Index> face;   // of the surface
  std::vector<Index> place;  // per face of the surface; kNone: not here
  std::vector<Vector3> weighted_normal, middle;
  std::vector<double> area;
  double mean = 0;  // of the areas
};

// One implicit step of diffusion over the faces: (M + reach^2 L) x = M n. Reaches span few faces, so
// conjugate gradients from the faces' own normals take few rounds, where a factorisation would cost most of
// the stage.
std::vector<Vector3> diffused_normals(const SurfaceSnapshot& surface, const Faces& faces, double reach) {
  const Index count = faces.count();
  Matrix system(count, count);
  system.reserve(Eigen::VectorXi::Constant(count, 4));
  Eigen::MatrixXd given(count, 3), start(count, 3);
  for (Index i = 0; i < count; ++i) {
    // Faces without area follow their neighbours.
    const double area = faces.area[i] + 1e-9 * faces.mean;
    double own = area;
    for (Index h = 3 * faces.face[i]; h < 3 * faces.face[i] + 3; ++h) {
      const Index k = faces.place[surface.twin[h] / 3];
      if (k == kNone) continue;
      const double apart = std::max((faces.middle[i] - faces.middle[k]).norm(), 1e-3 * std::sqrt(faces.mean));
      const double flow = reach * reach * surface.edge_length(h) / apart;
      own += flow;
      system.coeffRef(k, i) -= flow;
    }
    system.coeffRef(i, i) += own;
    given.row(i) = faces.weighted_normal[i];
    start.row(i) = faces.weighted_normal[i] / area;
  }
  // Positive definite, since the faces have area.
  Eigen::ConjugateGradient<Matrix, Eigen::Lower | Eigen::Upper> solver(system);
  solver.setTolerance(kNormalError);
  const Eigen::MatrixXd solution = solver.solveWithGuess(given, start);
  std::vector<Vector3> normals(count);
  for (Index i = 0; i < count; ++i) normals[i] = solution.row(i);
  return normals;
}

// Between the middles of neighbours.
double mean_apart(const SurfaceSnapshot& surface, const Faces& faces) {
  double sum = 0, count = 0;
  for (Index i = 0; i < faces.count(); ++i)
    for (Index h = 3 * faces.face[i]; h < 3 * faces.face[i] + 3; ++h)
      if (const Index k = faces.place[surface.twin[h] / 3]; k != kNone) {
        sum += (faces.middle[i] - faces.middle[k]).norm();
        ++count;
      }
  return count > 0 ? sum / count : 0.0;
}

// By how much a surface with these normals, which are `across` from each other, turns within `window`; 0
// where it is convex. Radians.
double crease_angle(const Vector3& a, const Vector3& b, const Vector3& across, double window) {
  if (!((a.normalized() - b.normalized()).dot(across) > 0)) return 0;
  return std::min(kPi, std::atan2(a.cross(b).norm(), a.dot(b)) * window / across.norm());
}

}  // namespace

void validate(const CreaseOptions& options) {
  if (!(options.crease >= 0 && options.crease <= 100))
    throw UsageError("creases: crease must be from 0 to 100");
  if (!(options.width >= 0 && options.width <= 1)) throw UsageError("creases: width must be from 0 to 1");
}

std::vector<double> border_costs(const SurfaceSnapshot& surface, const CreaseOptions& options,
                                 const std::vector<char>& where) {
  validate(options);
  if (!where.empty() && static_cast<Index>(where.size()) != surface.face_count())
    throw UsageError("creases: there are not as many flags as faces");
  const Faces faces(surface, where);
  const double total = std::accumulate(surface.vertex_area.begin(), surface.vertex_area.end(), 0.0);
  const double reach = options.width * std::sqrt(total);
  const std::vector<Vector3> normals =
      reach > 0 && faces.count() > 0 ? diffused_normals(surface, faces, reach) : faces.weighted_normal;
  // Faces that are wider than the reach show no more than by how much they turn from one to the next.
  const double window = std::max(2 * reach, kLeastWindow * mean_apart(surface, faces));
  std::vector<double> costs(surface.halfedge_count());
  for (Index h = 0; h < surface.halfedge_count(); ++h) {
    const Index k = surface.twin[h];
    if (k < h) {
      costs[h] = costs[k];
      continue;
    }
    const Index a = faces.place[h / 3], b = faces.place[k / 3];
    const double angle = a == kNone || b == kNone ? 0.0
                                                  : crease_angle(normals[a], normals[b],
                                                                 faces.middle[b] - faces.middle[a], window);
    costs[h] = surface.edge_length(h) / (1 + options.crease * angle);
  }
  return costs;
}

}  // namespace mspskel
