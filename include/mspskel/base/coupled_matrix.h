// Symmetric sparse matrices for three coordinates that are coupled in each row.
#pragma once

#include <Eigen/Core>
#include <Eigen/Sparse>
#include <vector>

namespace mspskel {

// A matrix for three coordinates side by side: three rows for each row of `even`. Off the diagonal an entry
// of `even` counts for each coordinate alike; on it stand the blocks, which couple the coordinates, in place
// of even's entries: `even` has an entry, be it 0, at each place of its diagonal, and as many blocks belong
// to it. Written out it would hold three times the entries of `even` and nine for each block.
struct CoupledMatrix {
  Eigen::SparseMatrix<double> even;
  std::vector<Eigen::Matrix3d> diagonal;
};

namespace detail {

// Three numbers a row, side by side in one vector.
inline Eigen::VectorBlock<Eigen::VectorXd, 3> row_of_three(Eigen::VectorXd& x, Eigen::Index i) {
  return x.segment<3>(3 * i);
}
inline Eigen::VectorBlock<const Eigen::VectorXd, 3> row_of_three(const Eigen::VectorXd& x, Eigen::Index i) {
  return x.segment<3>(3 * i);
}

}  // namespace detail
}  // namespace mspskel
