// Symmetric positive definite sparse systems: by elimination, or in steps where the factors would fill in.
#pragma once

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <optional>

namespace mspskel {

// The solution of matrix · x = right by its LDLᵀ factors; nothing if rounding leaves no factors.
// Only the lower triangle is read. Costs what the factors hold, which for a graph of many cycles grows with
// the square of its size.
inline std::optional<Eigen::MatrixX3d> solve_by_elimination(const Eigen::SparseMatrix<double>& matrix,
                                                            const Eigen::MatrixX3d& right) {
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
  if (solver.info() != Eigen::Success) return std::nullopt;
  return Eigen::MatrixX3d(solver.solve(right));
}

// Solves matrix · x = right for three right sides in steps from a guess, until what is left of the right
// sides is 1e-8 of what the guess leaves. Nothing if that takes more than 200 steps. For graphs with many
// cycles, whose exact factors grow with the square of their size: this costs O(entries) a step, and a few
// steps where the matrix is positive definite. The incomplete LU factors hold three times the matrix;
// incomplete Cholesky factors, which hold no more than the matrix, take a hundred times the steps where arcs
// are stiff, so the method is BiCGSTAB although the matrix is symmetric.
inline std::optional<Eigen::MatrixX3d> solve_by_steps(const Eigen::SparseMatrix<double>& matrix,
                                                      const Eigen::MatrixX3d& right,
                                                      const Eigen::MatrixX3d& guess) {
  Eigen::BiCGSTAB<Eigen::SparseMatrix<double>, Eigen::IncompleteLUT<double>> solver;
  solver.preconditioner().setDroptol(1e-4);
  solver.preconditioner().setFillfactor(3);
  solver.setTolerance(1e-8);
  solver.setMaxIterations(200);
  solver.compute(matrix);
  if (solver.info() != Eigen::Success) return std::nullopt;
  const Eigen::MatrixX3d left = right - matrix * guess;
  const Eigen::MatrixX3d way = solver.solve(left);
  if (solver.info() != Eigen::Success || !way.allFinite()) return std::nullopt;
  return guess + way;
}

// In steps, and by elimination where too many were needed.
inline std::optional<Eigen::MatrixX3d> solve_large(const Eigen::SparseMatrix<double>& matrix,
                                                   const Eigen::MatrixX3d& right,
                                                   const Eigen::MatrixX3d& guess) {
  if (auto solution = solve_by_steps(matrix, right, guess)) return solution;
  return solve_by_elimination(matrix, right);
}

namespace detail {

using RowsOfThree = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

// Incomplete LU factors that solve for three right sides in one pass over their entries, with the same result
// as one after the other.
class IncompleteFactors : public Eigen::IncompleteLUT<double> {
 public:
  RowsOfThree solve_rows(const RowsOfThree& right) const {
    RowsOfThree x(right.rows(), 3);
    const auto& order = m_Pinv.indices();
    for (Eigen::Index i = 0; i < right.rows(); ++i) x.row(order[i]) = right.row(i);
    // A row holds its entries left of the diagonal, the diagonal, and those right of it.
    const int *begin = m_lu.outerIndexPtr(), *column = m_lu.innerIndexPtr();
    const double* value = m_lu.valuePtr();
    const int rows = static_cast<int>(right.rows());
    for (int i = 0; i < rows; ++i) {
      Eigen::RowVector3d left = x.row(i);
      for (int k = begin[i]; column[k] != i; ++k) left -= value[k] * x.row(column[k]);
      x.row(i) = left;
    }
    for (int i = rows - 1; i >= 0; --i) {
      Eigen::RowVector3d left = x.row(i);
      int diagonal = begin[i];
      while (column[diagonal] != i) ++diagonal;
      for (int k = diagonal + 1; k < begin[i + 1]; ++k) left -= value[k] * x.row(column[k]);
      x.row(i) = left / value[diagonal];
    }
    RowsOfThree result(right.rows(), 3);
    for (Eigen::Index i = 0; i < right.rows(); ++i) result.row(m_P.indices()[i]) = x.row(i);
    return result;
  }
};

inline RowsOfThree solve_rows(const IncompleteFactors& factors, const RowsOfThree& right) {
  return factors.solve_rows(right);
}
using LineFactors =
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::NaturalOrdering<int>>;
// As the factors' own solve(), in one pass over their entries for all three right sides.
inline RowsOfThree solve_rows(const LineFactors& factors, const RowsOfThree& right) {
  RowsOfThree x = right;
  const auto& lower = factors.matrixL().nestedExpression();  // the diagonal, which is 1, is not stored
  const int *begin = lower.outerIndexPtr(), *row = lower.innerIndexPtr();
  const double* value = lower.valuePtr();
  const int rows = static_cast<int>(right.rows());
  for (int i = 0; i < rows; ++i) {
    const Eigen::RowVector3d known = x.row(i);
    for (int k = begin[i]; k < begin[i + 1]; ++k) x.row(row[k]) -= value[k] * known;
  }
  const Eigen::VectorXd diagonal = factors.vectorD();
  for (int i = 0; i < rows; ++i) x.row(i) *= 1 / diagonal[i];
  for (int i = rows - 1; i >= 0; --i) {
    Eigen::RowVector3d left = x.row(i);
    for (int k = begin[i]; k < begin[i + 1]; ++k) left -= value[k] * x.row(row[k]);
    x.row(i) = left;
  }
  return x;
}

// A preconditioner that solves for each of three coordinates, which lie side by side, by the same factors.
template <class Factors>
class EachCoordinate {
 public:
  void set(const Factors& factors) { factors_ = &factors; }

  template <class Matrix>
  EachCoordinate& analyzePattern(const Matrix&) {
    return *this;
  }
  template <class Matrix>
  EachCoordinate& factorize(const Matrix&) {
    return *this;
  }
  template <class Matrix>
  EachCoordinate& compute(const Matrix&) {
    return *this;
  }
  template <class Right>
  Eigen::VectorXd solve(const Eigen::MatrixBase<Right>& right) const {
    RowsOfThree rows(right.size() / 3, 3);
    Eigen::Map<Eigen::VectorXd>(rows.data(), rows.size()) = right;
    rows = solve_rows(*factors_, rows);
    return Eigen::Map<const Eigen::VectorXd>(rows.data(), rows.size());
  }
  Eigen::ComputationInfo info() const { return Eigen::Success; }

 private:
  const Factors* factors_ = nullptr;
};

template <class Factors>
std::optional<Eigen::VectorXd> solve_coupled_by_steps(const Eigen::SparseMatrix<double>& coupled,
                                                      const Eigen::VectorXd& right,
                                                      const Eigen::VectorXd& guess, const Factors& factors) {
  if (factors.info() != Eigen::Success) return std::nullopt;
  Eigen::BiCGSTAB<Eigen::SparseMatrix<double>, EachCoordinate<Factors>> solver;
  solver.preconditioner().set(factors);
  solver.setTolerance(1e-5);
  solver.setMaxIterations(200);
  solver.compute(coupled);
  const Eigen::VectorXd way = solver.solve(right - coupled * guess);
  if (solver.info() != Eigen::Success || !way.allFinite()) return std::nullopt;
  return guess + way;
}

}  // namespace detail

// Solves coupled · x = right, where three rows of `coupled`, one for each coordinate, stand for each row of
// `even`, which is nearly what `coupled` is, for each coordinate alike, in an order in which a line fills in
// nothing: in steps from the guess with factors of
// `even`, incomplete ones where it has many cycles, until what is left of the right side is 1e-5 of what the
// guess leaves. Factors of `coupled` would take nine times the room and more of the time. Elimination where
// too many steps were needed; nothing if rounding leaves no factors.
inline std::optional<Eigen::VectorXd> solve_coupled(const Eigen::SparseMatrix<double>& coupled,
                                                    const Eigen::SparseMatrix<double>& even,
                                                    const Eigen::VectorXd& right,
                                                    const Eigen::VectorXd& guess, bool has_many_cycles) {
  std::optional<Eigen::VectorXd> solution;
  if (has_many_cycles) {
    detail::IncompleteFactors factors;
    factors.setDroptol(1e-4);
    factors.setFillfactor(3);
    factors.compute(even);
    solution = detail::solve_coupled_by_steps(coupled, right, guess, factors);
  } else {
    const detail::LineFactors factors(even);
    solution = detail::solve_coupled_by_steps(coupled, right, guess, factors);
  }
  if (solution) return solution;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(coupled);
  if (factors.info() != Eigen::Success) return std::nullopt;
  return Eigen::VectorXd(factors.solve(right));
}

}  // namespace mspskel
