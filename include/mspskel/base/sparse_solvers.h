// Symmetric positive definite sparse systems: by elimination, or in steps where the factors would fill in.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/OrderingMethods>
#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "mspskel/base/core_solver.h"

namespace mspskel {

namespace detail {

// Incomplete LU factors that hold three times the matrix.
class IncompleteFactors : public Eigen::IncompleteLUT<double> {
 public:
  IncompleteFactors() {
    setDroptol(1e-4);
    setFillfactor(3);
  }
};

}  // namespace detail

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
// steps where the matrix is positive definite. With incomplete Cholesky factors, which hold no more than the
// matrix, it would take a hundred times the steps where arcs are stiff, so the method is BiCGSTAB although
// the matrix is symmetric.
inline std::optional<Eigen::MatrixX3d> solve_by_steps(const Eigen::SparseMatrix<double>& matrix,
                                                      const Eigen::MatrixX3d& right,
                                                      const Eigen::MatrixX3d& guess) {
  Eigen::BiCGSTAB<Eigen::SparseMatrix<double>, detail::IncompleteFactors> solver;
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

// Exact factors L·D·Lᵀ of a coupled matrix in blocks of three by three, in an order of least fill: a tree of
// lines fills in nothing but what a line does. Up-looking elimination (Davis 2005). Refers to the matrix.
class BlockFactors {
 public:
  explicit BlockFactors(const CoupledMatrix& matrix)
      : matrix_(matrix), size_(static_cast<int>(matrix.even.rows())) {
    Eigen::AMDOrdering<int>()(matrix.even, order_);
    place_ = order_.inverse();
    begin_.assign(static_cast<std::size_t>(size_) + 1, 0);
    parent_.assign(static_cast<std::size_t>(size_), -1);
    std::vector<int> seen(parent_.size(), -1), count(parent_.size(), 0);
    for (int k = 0; k < size_; ++k) {
      seen[k] = k;
      for_each_above(k, [&](int i, double) {
        for (; seen[i] != k; i = parent_[i]) {
          if (parent_[i] < 0) parent_[i] = k;
          ++count[i];
          seen[i] = k;
        }
      });
    }
    for (int k = 0; k < size_; ++k) begin_[k + 1] = begin_[k] + count[k];
  }

  // Below the diagonal.
  int block_count() const { return begin_[size_]; }

  // False where rounding leaves a block that is not positive definite.
  bool compute() {
    row_.resize(static_cast<std::size_t>(begin_[size_]));
    lower_.resize(row_.size());
    inverse_.resize(parent_.size());
    std::vector<Eigen::Matrix3d> column(parent_.size(), Eigen::Matrix3d::Zero());
    std::vector<int> end(begin_.begin(), begin_.end() - 1), seen(parent_.size(), -1), way,
        pattern(parent_.size());
    for (int k = 0; k < size_; ++k) {
      int top = size_;
      seen[k] = k;
      for_each_above(k, [&](int i, double value) {
        column[i].diagonal().array() += value;
        way.clear();
        for (; seen[i] != k; i = parent_[i]) {
          way.push_back(i);
          seen[i] = k;
        }
        for (; !way.empty(); way.pop_back()) pattern[--top] = way.back();
      });
      Eigen::Matrix3d diagonal = matrix_.diagonal[order_.indices()[k]];
      for (; top < size_; ++top) {
        const int i = pattern[top];
        const Eigen::Matrix3d block = std::exchange(column[i], Eigen::Matrix3d::Zero());
        for (int p = begin_[i]; p < end[i]; ++p) column[row_[p]].noalias() -= lower_[p] * block;
        const Eigen::Matrix3d factor = block.transpose() * inverse_[i];
        diagonal.noalias() -= factor * block;
        row_[end[i]] = k;
        lower_[end[i]++] = factor;
      }
      const Eigen::LLT<Eigen::Matrix3d> root(diagonal);
      if (root.info() != Eigen::Success) return false;
      inverse_[k] = root.solve(Eigen::Matrix3d::Identity());
    }
    return true;
  }

  Eigen::VectorXd solve(const Eigen::VectorXd& right) const {
    Eigen::VectorXd x(right.size()), result(right.size());
    for (int k = 0; k < size_; ++k) row_of_three(x, k) = row_of_three(right, order_.indices()[k]);
    for (int k = 0; k < size_; ++k) {
      const Eigen::Vector3d known = row_of_three(x, k);
      for (int p = begin_[k]; p < begin_[k + 1]; ++p) row_of_three(x, row_[p]) -= lower_[p] * known;
    }
    for (int k = size_ - 1; k >= 0; --k) {
      Eigen::Vector3d left = inverse_[k] * row_of_three(x, k);
      for (int p = begin_[k]; p < begin_[k + 1]; ++p)
        left -= lower_[p].transpose() * row_of_three(x, row_[p]);
      row_of_three(x, k) = left;
    }
    for (int k = 0; k < size_; ++k) row_of_three(result, order_.indices()[k]) = row_of_three(x, k);
    return result;
  }

 private:
  // visit(row, value) for the entries above the diagonal in a column of the reordered matrix.
  template <class Visit>
  void for_each_above(int k, Visit visit) const {
    for (Eigen::SparseMatrix<double>::InnerIterator it(matrix_.even, order_.indices()[k]); it; ++it)
      if (const int i = place_.indices()[it.row()]; i < k) visit(i, it.value());
  }

  const CoupledMatrix& matrix_;
  const int size_;
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order_,
      place_;                     // the row at a place, and back
  std::vector<int> parent_;       // of the elimination tree
  std::vector<int> begin_, row_;  // of the columns of L, below its diagonal
  std::vector<Eigen::Matrix3d> lower_;
  std::vector<Eigen::Matrix3d> inverse_;  // of the blocks of D
};

}  // namespace detail

// Solves coupled · x = right by elimination. For graphs with many cycles, whose factors fill in, only along
// their lines, and in steps from the guess where these meet; by elimination as well where too many steps were
// needed. Nothing if rounding leaves no factors.
inline std::optional<Eigen::VectorXd> solve_coupled(const CoupledMatrix& coupled,
                                                    const Eigen::VectorXd& right,
                                                    const Eigen::VectorXd& guess, bool has_many_cycles) {
  // Enough for rounds that begin where the one before ended and go part of the way.
  constexpr double kTolerance = 1e-3;
  constexpr int kMostSteps = 1000;
  if (has_many_cycles) {
    detail::CoreSolver core(coupled);
    if (core.eliminate())
      if (auto solution = core.solve(right, guess, kTolerance, kMostSteps)) return solution;
  }
  detail::BlockFactors factors(coupled);
  if (!factors.compute()) return std::nullopt;
  return factors.solve(right);
}

}  // namespace mspskel
