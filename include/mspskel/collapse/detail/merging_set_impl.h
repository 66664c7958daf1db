#pragma once

#include <Eigen/Eigenvalues>

#include "mspskel/base/linkage.h"

namespace mspskel {

MSPSKEL_INLINE Vector3 MergingSet::axis() const {
  const auto& [xx, yy, zz, xy, xz, yz] = axis_;
  if (!(xx + yy + zz > 0)) return Vector3::Zero();
  Eigen::Matrix3d sum;
  sum << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(sum);
  return solver.eigenvectors().col(2);
}

}  // namespace mspskel
