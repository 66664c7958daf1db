// Stiff lines that meet in many cycles: elimination along the lines, steps for what is left at the joints.
#pragma once

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "mspskel/base/coupled_matrix.h"

namespace mspskel {
namespace detail {

// A symmetric positive definite matrix of three by three blocks. Points that have few neighbours are
// eliminated, the fewest first; what eliminating couples counts as neighbours. Lines leave nothing but their
// ends, and trees nothing at all. Of a graph of many cycles a core remains, whose factors would fill in: that
// is solved by conjugate gradients, with the blocks of its diagonal as preconditioner. The stiffness along
// the lines, which makes steps many, is in the core no more.
class CoreSolver {
 public:
  static constexpr std::size_t kMostNeighbours = 8;

  explicit CoreSolver(const CoupledMatrix& matrix)
      : entries_(matrix.diagonal.size()),
        pivot_(matrix.diagonal),
        inverse_(pivot_.size()),
        is_eliminated_(pivot_.size(), 0) {
    for (int i = 0; i < static_cast<int>(pivot_.size()); ++i) {
      entries_[i].reserve(static_cast<std::size_t>(matrix.even.col(i).nonZeros()));
      for (Eigen::SparseMatrix<double>::InnerIterator it(matrix.even, i); it; ++it)
        if (it.row() != i)
          entries_[i].push_back({static_cast<int>(it.row()), it.value() * Eigen::Matrix3d::Identity()});
    }
  }

  std::size_t core_size() const { return core_.size(); }
  int steps() const { return steps_; }

  // False where rounding leaves a block that is not positive definite.
  bool eliminate() {
    std::vector<std::vector<int>> of_degree(kMostNeighbours + 1);
    const auto offer = [&](int i) {
      if (entries_[i].size() <= kMostNeighbours) of_degree[entries_[i].size()].push_back(i);
    };
    for (int i = static_cast<int>(entries_.size()) - 1; i >= 0; --i) offer(i);
    for (std::size_t degree = 0; degree <= kMostNeighbours;) {
      if (of_degree[degree].empty()) {
        ++degree;
        continue;
      }
      const int i = of_degree[degree].back();
      of_degree[degree].pop_back();
      if (is_eliminated_[i] || entries_[i].size() != degree) continue;
      if (!eliminate(i)) return false;
      for (const Entry& e : entries_[i]) {
        offer(e.column);
        degree = std::min(degree, entries_[e.column].size());
      }
    }
    for (int i = 0; i < static_cast<int>(entries_.size()); ++i) {
      if (is_eliminated_[i]) continue;
      core_.push_back(i);
      if (!invert(i)) return false;
    }
    return true;
  }

  // Steps of the core end where what is left of the right side is `tolerance` of what the guess leaves.
  // Nothing if that takes more than `most_steps`.
  std::optional<Eigen::VectorXd> solve(Eigen::VectorXd right, const Eigen::VectorXd& guess, double tolerance,
                                       int most_steps) {
    for (const int i : order_) {
      const Eigen::Vector3d known = inverse_[i] * row_of_three(right, i);
      for (const Entry& e : entries_[i]) row_of_three(right, e.column) -= e.block.transpose() * known;
    }
    Eigen::VectorXd x = guess;
    if (!solve_core(right, x, tolerance, most_steps)) return std::nullopt;
    for (auto i = order_.rbegin(); i != order_.rend(); ++i) {
      Eigen::Vector3d left = row_of_three(right, *i);
      for (const Entry& e : entries_[*i]) left -= e.block * row_of_three(x, e.column);
      row_of_three(x, *i) = inverse_[*i] * left;
    }
    if (!x.allFinite()) return std::nullopt;
    return x;
  }

 private:
  struct Entry {
    int column;
    Eigen::Matrix3d block;
  };

  bool invert(int i) {
    const Eigen::LLT<Eigen::Matrix3d> root(pivot_[i]);
    if (root.info() != Eigen::Success) return false;
    inverse_[i] = root.solve(Eigen::Matrix3d::Identity());
    return true;
  }

  void subtract(int row, int column, const Eigen::Matrix3d& block) {
    for (Entry& e : entries_[row])
      if (e.column == column) {
        e.block -= block;
        return;
      }
    entries_[row].push_back({column, -block});
  }

  bool eliminate(int i) {
    if (!invert(i)) return false;
    is_eliminated_[i] = 1;
    order_.push_back(i);
    const std::vector<Entry>& own = entries_[i];
    for (const Entry& e : own) {
      std::vector<Entry>& others = entries_[e.column];
      const auto back =
          std::find_if(others.begin(), others.end(), [&](const Entry& o) { return o.column == i; });
      *back = others.back();
      others.pop_back();
    }
    for (std::size_t a = 0; a < own.size(); ++a) {
      const Eigen::Matrix3d factor = own[a].block.transpose() * inverse_[i];
      pivot_[own[a].column].noalias() -= factor * own[a].block;
      for (std::size_t b = a + 1; b < own.size(); ++b) {
        const Eigen::Matrix3d change = factor * own[b].block;
        subtract(own[a].column, own[b].column, change);
        subtract(own[b].column, own[a].column, change.transpose());
      }
    }
    return true;
  }

  // Conjugate gradients from the core's part of x.
  bool solve_core(const Eigen::VectorXd& right, Eigen::VectorXd& x, double tolerance, int most_steps) {
    const auto rows = static_cast<Eigen::Index>(3 * core_.size());
    Eigen::VectorXd r(rows), z(rows), p(x.size()), product(rows);
    const auto multiply = [&](const Eigen::VectorXd& y) {
      for (int c = 0; c < static_cast<int>(core_.size()); ++c) {
        const int i = core_[c];
        Eigen::Vector3d sum = pivot_[i] * row_of_three(y, i);
        for (const Entry& e : entries_[i]) sum += e.block * row_of_three(y, e.column);
        row_of_three(product, c) = sum;
      }
    };
    const auto precondition = [&] {
      for (int c = 0; c < static_cast<int>(core_.size()); ++c)
        row_of_three(z, c) = inverse_[core_[c]] * row_of_three(r, c);
    };
    multiply(x);
    for (int c = 0; c < static_cast<int>(core_.size()); ++c) {
      row_of_three(r, c) = row_of_three(right, core_[c]) - row_of_three(product, c);
      row_of_three(p, core_[c]).setZero();
    }
    precondition();
    double rho = r.dot(z), rho_before = 1;
    const double goal = tolerance * tolerance * rho;
    for (steps_ = 0; rho > goal; ++steps_) {
      if (steps_ == most_steps) return false;
      const double beta = steps_ == 0 ? 0.0 : rho / rho_before;
      for (int c = 0; c < static_cast<int>(core_.size()); ++c)
        row_of_three(p, core_[c]) = row_of_three(z, c) + beta * row_of_three(p, core_[c]);
      multiply(p);
      double curvature = 0;
      for (int c = 0; c < static_cast<int>(core_.size()); ++c)
        curvature += row_of_three(p, core_[c]).dot(row_of_three(product, c));
      const double alpha = rho / curvature;
      for (int c = 0; c < static_cast<int>(core_.size()); ++c)
        row_of_three(x, core_[c]) += alpha * row_of_three(p, core_[c]);
      r -= alpha * product;
      precondition();
      rho_before = std::exchange(rho, r.dot(z));
    }
    return std::isfinite(rho);
  }

  std::vector<std::vector<Entry>> entries_;  // per row, off the diagonal; of an eliminated one as at its turn
  std::vector<Eigen::Matrix3d> pivot_;       // the diagonal, likewise
  std::vector<Eigen::Matrix3d> inverse_;     // of pivots
  std::vector<std::uint8_t> is_eliminated_;
  std::vector<int> order_, core_;
  int steps_ = 0;
};

}  // namespace detail
}  // namespace mspskel
