#include "mspskel/segment/border_costs.h"

#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "mspskel/base/error.h"

namespace mspskel {
namespace {

using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;
using Columns = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

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
    measure_apart(surface);
  }
  Index count() const { return static_cast<Index>(face.size()); }

  std::vector<Index> face;   // of the surface
  std::vector<Index> place;  // per face of the surface; kNone: not here
  std::vector<Vector3> weighted_normal, middle;
  std::vector<double> area;
  double mean = 0;                              // of the areas
  std::vector<std::array<Index, 3>> neighbour;  // per face and half-edge a place; kNone: not here
  std::vector<std::array<double, 3>> apart;     // per face and half-edge: between the middles
  double mean_apart = 0;

 private:
  void measure_apart(const SurfaceSnapshot& surface) {
    neighbour.resize(face.size());
    apart.resize(face.size());
    double sum = 0, pairs = 0;
    for (Index i = 0; i < count(); ++i)
      for (Index k = 0; k < 3; ++k) {
        const Index twin = surface.twin[3 * face[i] + k], j = neighbour[i][k] = place[twin / 3];
        if (j == kNone) continue;
        if (j < i) {
          apart[i][k] = apart[j][twin % 3];
          continue;
        }
        sum += apart[i][k] = (middle[i] - middle[j]).norm();
        ++pairs;
      }
    mean_apart = pairs > 0 ? sum / pairs : 0.0;
  }
};

// Solves system * x = given by conjugate gradients with the diagonal as preconditioner, from the x given,
// each column by itself: one pass over the matrix serves all three. The system is positive definite.
void solve(const Matrix& system, const Columns& given, Columns& x) {
  using Row = Eigen::Array<double, 1, 3>;
  const auto dots = [](const Columns& a, const Columns& b) -> Row {
    return a.cwiseProduct(b).colwise().sum().array();
  };
  const auto share = [](const Row& a, const Row& b) -> Row {
    return Row((b > 0).select(a / b, Row::Zero()));
  };
  const Eigen::VectorXd weight = system.diagonal().cwiseInverse();
  Columns left = given - system * x, way = weight.asDiagonal() * left, moved(given.rows(), 3);
  Row steep = dots(left, way);
  const Row enough = kNormalError * kNormalError * dots(given, given);
  for (Eigen::Index round = 0; round < given.rows() && (dots(left, left) > enough).any(); ++round) {
    moved.noalias() = system * way;
    const Row step = share(steep, dots(way, moved));
    x.array() += way.array().rowwise() * step;
    left.array() -= moved.array().rowwise() * step;
    moved.noalias() = weight.asDiagonal() * left;
    const Row next = dots(left, moved);
    way.array().rowwise() *= share(next, steep);
    way += moved;
    steep = next;
  }
}

// After one implicit step of diffusion over the faces: (M + reach^2 L) x = M n. Reaches span few faces, so
// conjugate gradients from the faces' own normals take few rounds, where a factorisation would cost most of
// the stage.
std::vector<Vector3> unit_normals(const SurfaceSnapshot& surface, const Faces& faces, double reach) {
  const Index count = faces.count();
  std::vector<Vector3> normals(count);
  if (!(reach > 0) || count == 0) {
    for (Index i = 0; i < count; ++i) normals[i] = faces.weighted_normal[i].normalized();
    return normals;
  }
  Matrix system(count, count);
  system.reserve(Eigen::VectorXi::Constant(count, 4));
  Columns given(count, 3), solution(count, 3);
  const double least_apart = 1e-3 * std::sqrt(faces.mean);
  for (Index i = 0; i < count; ++i) {
    // Faces without area follow their neighbours.
    const double area = faces.area[i] + 1e-9 * faces.mean;
    double own = area;
    for (Index k = 0; k < 3; ++k) {
      const Index j = faces.neighbour[i][k];
      if (j == kNone) continue;
      const double flow = reach * reach * surface.edge_length(3 * faces.face[i] + k) /
                          std::max(faces.apart[i][k], least_apart);
      own += flow;
      system.coeffRef(i, j) -= flow;
    }
    system.coeffRef(i, i) += own;
    given.row(i) = faces.weighted_normal[i];
    solution.row(i) = faces.weighted_normal[i] / area;
  }
  system.makeCompressed();
  solve(system, given, solution);
  for (Index i = 0; i < count; ++i) normals[i] = solution.row(i).normalized();
  return normals;
}

// By how much a surface with these unit normals, whose faces are `across` from each other and `apart`, turns
// within `window`; 0 where it is convex. Radians.
double crease_angle(const Vector3& a, const Vector3& b, const Vector3& across, double apart, double window) {
  if (!((a - b).dot(across) > 0)) return 0;
  return std::min(kPi, std::atan2(a.cross(b).norm(), a.dot(b)) * window / apart);
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
  const std::vector<Vector3> normals = unit_normals(surface, faces, reach);
  // Faces that are wider than the reach show no more than by how much they turn from one to the next.
  const double window = std::max(2 * reach, kLeastWindow * faces.mean_apart);
  std::vector<double> costs(surface.halfedge_count());
  for (Index h = 0; h < surface.halfedge_count(); ++h) {
    const Index k = surface.twin[h];
    if (k < h) {
      costs[h] = costs[k];
      continue;
    }
    costs[h] = surface.edge_length(h);
    const Index a = faces.place[h / 3], b = faces.place[k / 3];
    if (a == kNone || b == kNone) continue;
    costs[h] /= 1 + options.crease * crease_angle(normals[a], normals[b], faces.middle[b] - faces.middle[a],
                                                  faces.apart[a][h % 3], window);
  }
  return costs;
}

}  // namespace mspskel
