// Symmetric positive definite sparse systems with one or more right sides: by elimination, or in steps where
// the factors would fill in.
#pragma once

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <optional>

namespace mspskel {

// The solution of matrix · x = right by its LDLᵀ factors in this ordering; nothing if rounding leaves no
// factors. Only the lower triangle is read. Costs what the factors hold, which for a graph of many cycles
// grows with the square of its size.
template <class Ordering = Eigen::AMDOrdering<int>>
std::optional<Eigen::MatrixXd> solve_by_elimination(const Eigen::SparseMatrix<double>& matrix,
                                                    const Eigen::MatrixXd& right) {
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower, Ordering> solver(matrix);
  if (solver.info() != Eigen::Success) return std::nullopt;
  return Eigen::MatrixXd(solver.solve(right));
}

// Solves matrix · x = right for each right side in steps from a guess, until what is left of the right
// sides is 1e-8 of what the guess leaves. Nothing if that takes more than 200 steps. For graphs with many
// cycles, whose exact factors grow with the square of their size: this costs O(entries) a step, and a few
// steps where the matrix is positive definite. The incomplete LU factors hold three times the matrix;
// incomplete Cholesky factors, which hold no more than the matrix, take a hundred times the steps where arcs
// are stiff, so the method is BiCGSTAB although the matrix is symmetric.
inline std::optional<Eigen::MatrixXd> solve_by_steps(const Eigen::SparseMatrix<double>& matrix,
                                                     const Eigen::MatrixXd& right,
                                                     const Eigen::MatrixXd& guess) {
  Eigen::BiCGSTAB<Eigen::SparseMatrix<double>, Eigen::IncompleteLUT<double>> solver;
  solver.preconditioner().setDroptol(1e-4);
  solver.preconditioner().setFillfactor(3);
  solver.setTolerance(1e-8);
  solver.setMaxIterations(200);
  solver.compute(matrix);
  if (solver.info() != Eigen::Success) return std::nullopt;
  const Eigen::MatrixXd left = right - matrix * guess;
  const Eigen::MatrixXd way = solver.solve(left);
  if (solver.info() != Eigen::Success || !way.allFinite()) return std::nullopt;
  return guess + way;
}

// In steps, and by elimination where too many were needed.
inline std::optional<Eigen::MatrixXd> solve_large(const Eigen::SparseMatrix<double>& matrix,
                                                  const Eigen::MatrixXd& right,
                                                  const Eigen::MatrixXd& guess) {
  if (auto solution = solve_by_steps(matrix, right, guess)) return solution;
  return solve_by_elimination(matrix, right);
}

}  // namespace mspskel
