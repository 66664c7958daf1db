#pragma once

#include <Eigen/Sparse>
#include <numeric>

#include "mspskel/base/linkage.h"
#include "mspskel/base/sparse_solvers.h"

namespace mspskel {
namespace detail {

// Confidence of a skeletal point: (1 − E_s)², less where the neighbours' points scatter over more than the
// slice's radius MSP / 2π.
inline double point_confidence(const SurfaceSnapshot& surface, const SkeletonMesh& mesh, Index v) {
  if (!mesh.valid[v]) return 0.0;
  double spread = 0, count = 0;
  const Index first = surface.vertex_halfedge[v];
  Index h = first;
  do {
    spread += (mesh.position[surface.target(h)] - mesh.position[v]).norm();
    ++count;
    h = surface.next_outgoing(h);
  } while (h != first);
  const double radius = mesh.perimeter[v] / (2 * kPi), ratio = radius > 0 ? spread / count / radius : 1e3;
  const double agreement = 1 - mesh.error[v];
  return agreement * agreement / (1 + ratio * ratio);
}

}  // namespace detail

MSPSKEL_INLINE void apply_spatial_coherence(const SurfaceSnapshot& surface, const CoherenceOptions& options,
                                            SkeletonMesh& mesh) {
  validate(options);
  if (!options.enabled || options.strength == 0) return;
  const Index n = surface.vertex_count();
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(surface.halfedge_count()) / 2 + static_cast<std::size_t>(n));
  std::vector<double> valence(n, 0.0);
  for (Index h = 0; h < surface.halfedge_count(); ++h) ++valence[surface.origin[h]];
  std::vector<double> diagonal(n, 0.0);
  // Symmetric edge weights α · (1/valence_a + 1/valence_b) / 2 keep the matrix positive definite.
  for (Index h = 0; h < surface.halfedge_count(); ++h) {
    const Index a = surface.origin[h], b = surface.target(h);
    const double w = options.strength * 0.5 * (1 / valence[a] + 1 / valence[b]);
    diagonal[a] += w;
    entries.emplace_back(a, b, -w);
  }
  Eigen::MatrixX3d right(n, 3);
  for (Index v = 0; v < n; ++v) {
    const double c =
        surface.vertex_halfedge[v] == kNone ? 1.0 : 1e-6 + detail::point_confidence(surface, mesh, v);
    entries.emplace_back(v, v, diagonal[v] + c);
    right.row(v) = c * mesh.position[v].transpose();
  }
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  // More rows than that take longer to eliminate than to approach, and so do those of many handles, which
  // leave no small cuts to divide the surface at.
  constexpr Index kFew = 20000, kFewHandles = 128;
  const std::vector<Index> handles = handles_of_components(surface);
  const bool large = n > kFew || std::accumulate(handles.begin(), handles.end(), 0) > kFewHandles;
  Eigen::MatrixX3d guess(n, 3);
  for (Index v = 0; v < n; ++v) guess.row(v) = mesh.position[v].transpose();
  const auto solution = large ? solve_large(matrix, right, guess) : solve_by_elimination(matrix, right);
  if (!solution) return;  // the matrix is positive definite, so only rounding could do this
  for (Index v = 0; v < n; ++v) mesh.position[v] = solution->row(v).transpose();
}

}  // namespace mspskel
