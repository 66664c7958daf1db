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

namespace mspskel {

namespace detail {

// Three numbers a row, side by side in one vector.
inline auto row_of_three(Eigen::VectorXd& x, Eigen::Index i) { return x.segment<3>(3 * i); }
inline auto row_of_three(const Eigen::VectorXd& x, Eigen::Index i) { return x.segment<3>(3 * i); }

// Incomplete LU factors that hold three times the matrix, and solve for three right sides in one pass over
// their entries, with the same result as one after the other.
class IncompleteFactors : public Eigen::IncompleteLUT<double> {
 public:
  IncompleteFactors() {
    setDroptol(1e-4);
    setFillfactor(3);
  }

  // Kept from one solution to the next.
  struct Room {
    Eigen::VectorXd x;
    std::vector<int> diagonal;  // per row the entry on the diagonal
  };

  void solve_rows(const Eigen::VectorXd& right, Eigen::VectorXd& result, Room& room) const {
    const int rows = static_cast<int>(right.size() / 3);
    Eigen::VectorXd& x = room.x;
    x.resize(right.size());
    result.resize(right.size());
    room.diagonal.resize(static_cast<std::size_t>(rows));
    const auto& order = m_Pinv.indices();
    for (int i = 0; i < rows; ++i) row_of_three(x, order[i]) = row_of_three(right, i);
    // A row holds its entries left of the diagonal, the diagonal, and those right of it. The factors of any
    // matrix have each diagonal entry: where it comes out as zero, IncompleteLUT puts a small number.
    const int *begin = m_lu.outerIndexPtr(), *column = m_lu.innerIndexPtr();
    const double* value = m_lu.valuePtr();
    for (int i = 0; i < rows; ++i) {
      Eigen::Vector3d left = row_of_three(x, i);
      int k = begin[i];
      for (; column[k] != i; ++k) left -= value[k] * row_of_three(x, column[k]);
      room.diagonal[static_cast<std::size_t>(i)] = k;
      row_of_three(x, i) = left;
    }
    for (int i = rows - 1; i >= 0; --i) {
      Eigen::Vector3d left = row_of_three(x, i);
      const int diagonal = room.diagonal[static_cast<std::size_t>(i)];
      for (int k = diagonal + 1; k < begin[i + 1]; ++k) left -= value[k] * row_of_three(x, column[k]);
      row_of_three(x, i) = left / value[diagonal];
    }
    for (int i = 0; i < rows; ++i) row_of_three(result, m_P.indices()[i]) = row_of_three(x, i);
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

// A matrix for three coordinates side by side: three rows for each row of `even`. Off the diagonal an entry
// of `even` counts for each coordinate alike; on it stand the blocks, which couple the coordinates, in place
// of even's entries: `even` has an entry, be it 0, at each place of its diagonal, and as many blocks belong
// to it. Written out it would hold three times the entries of `even` and nine for each block.
struct CoupledMatrix {
  Eigen::SparseMatrix<double> even;
  std::vector<Eigen::Matrix3d> diagonal;
};

namespace detail {

// Adds matrix · x to vectors, row by row. Refers to the matrix's blocks.
class CoupledProduct {
 public:
  explicit CoupledProduct(const CoupledMatrix& matrix) : rows_(matrix.even), diagonal_(matrix.diagonal) {}

  void add(const Eigen::VectorXd& x, Eigen::VectorXd& sum) const {
    const int *begin = rows_.outerIndexPtr(), *column = rows_.innerIndexPtr();
    const double* value = rows_.valuePtr();
    const int rows = static_cast<int>(rows_.rows());
    for (int i = 0; i < rows; ++i) {
      Eigen::Vector3d s = row_of_three(sum, i);
      for (int k = begin[i]; k < begin[i + 1]; ++k) {
        const Eigen::Vector3d factor = row_of_three(x, column[k]);
        if (column[k] != i) {
          s += value[k] * factor;
          continue;
        }
        const Eigen::Matrix3d& block = diagonal_[static_cast<std::size_t>(i)];
        for (int l = 0; l < 3; ++l) s += factor[l] * block.col(l);
      }
      row_of_three(sum, i) = s;
    }
  }
  void set(const Eigen::VectorXd& x, Eigen::VectorXd& product) const {
    product.setZero(x.size());
    add(x, product);
  }

 private:
  Eigen::SparseMatrix<double, Eigen::RowMajor> rows_;
  const std::vector<Eigen::Matrix3d>& diagonal_;
};

// What matrix · way = right − matrix · guess adds to the guess, by preconditioned BiCGSTAB (van der Vorst
// 1992) from zero: Eigen's own wants the matrix written out, and makes room for each product anew.
template <class Factors>
std::optional<Eigen::VectorXd> solve_coupled_by_steps(const CoupledMatrix& matrix,
                                                      const Eigen::VectorXd& right,
                                                      const Eigen::VectorXd& guess, const Factors& factors) {
  // Enough for rounds that begin where the one before ended.
  constexpr double kTolerance = 1e-5, kEpsilon = std::numeric_limits<double>::epsilon();
  constexpr int kMostSteps = 200;
  if (factors.info() != Eigen::Success) return std::nullopt;
  const CoupledProduct product(matrix);
  typename Factors::Room room;
  const Eigen::Index n = right.size();
  Eigen::VectorXd way = Eigen::VectorXd::Zero(n), v = way, p = way, y(n), z(n), s(n), t(n);
  const auto what_is_left = [&] {
    Eigen::VectorXd left = right;
    product.add(-guess, left);
    product.add(-way, left);
    return left;
  };
  product.set(guess, t);
  const double goal = (right - t).squaredNorm();
  if (goal == 0) return guess;
  Eigen::VectorXd r = what_is_left(), r0 = r;
  double r0_square = r0.squaredNorm(), rho = 1, alpha = 1, w = 1;
  bool restarted = false;
  for (int step = 0; r.squaredNorm() > kTolerance * kTolerance * goal && step < kMostSteps; ++step) {
    const double rho_before = std::exchange(rho, r0.dot(r));
    if (std::abs(rho) < kEpsilon * kEpsilon * r0_square) {  // r has become orthogonal to r0
      r = r0 = what_is_left();
      rho = r0_square = r.squaredNorm();
      if (!std::exchange(restarted, true)) step = 0;
    }
    const double beta = (rho / rho_before) * (alpha / w);
    p = r + beta * (p - w * v);
    factors.solve_rows(p, y, room);
    product.set(y, v);
    alpha = rho / r0.dot(v);
    s = r - alpha * v;
    factors.solve_rows(s, z, room);
    product.set(z, t);
    const double t_square = t.squaredNorm();
    w = t_square > 0 ? t.dot(s) / t_square : 0.0;
    way += alpha * y + w * z;
    r = s - w * t;
  }
  if (!(std::sqrt(r.squaredNorm() / goal) <= kTolerance) || !way.allFinite()) return std::nullopt;
  return guess + way;
}

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

// Solves coupled · x = right by elimination. For graphs with many cycles, whose factors fill in, in steps
// from the guess until what is left of the right side is 1e-5 of what the guess leaves, with incomplete
// factors of coupled.even, which should be nearly what the matrix is for each coordinate; by elimination as
// well where too many steps were needed. Nothing if rounding leaves no factors.
inline std::optional<Eigen::VectorXd> solve_coupled(const CoupledMatrix& coupled,
                                                    const Eigen::VectorXd& right,
                                                    const Eigen::VectorXd& guess, bool has_many_cycles) {
  if (has_many_cycles) {
    detail::IncompleteFactors factors;
    factors.compute(coupled.even);
    if (auto solution = detail::solve_coupled_by_steps(coupled, right, guess, factors)) return solution;
  }
  detail::BlockFactors factors(coupled);
  if (!factors.compute()) return std::nullopt;
  return factors.solve(right);
}

}  // namespace mspskel
