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
// is solved by conjugate gradients, with a symmetric Gauss-Seidel sweep of blocks as preconditioner. In
// Eisenstat's form (SIAM J. Sci. Stat. Comput. 1981) a step costs what one product with the core does. The
// stiffness along the lines, which makes steps many, is in the core no more.
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
    gather_core();
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

  // Moves the core's rows side by side, which are read once a step.
  void gather_core() {
    std::vector<int> place(pivot_.size(), -1);
    for (int c = 0; c < static_cast<int>(core_.size()); ++c) {
      const int i = core_[c];
      place[i] = c;
      core_pivot_.push_back(pivot_[i]);
      core_inverse_.push_back(inverse_[i]);
    }
    core_begin_.assign(1, 0);
    for (int c = 0; c < static_cast<int>(core_.size()); ++c) {
      for (const Entry& e : entries_[core_[c]])
        if (place[e.column] < c) below_.push_back({place[e.column], e.block});
      core_begin_.push_back(static_cast<int>(below_.size()));
      entries_[core_[c]] = {};
    }
  }

  // With the core L + D + Lᵀ: (D + L)⁻¹ y and (D + L)⁻ᵀ y, in place.
  void sweep_down(Eigen::VectorXd& y) const {
    for (int c = 0; c < static_cast<int>(core_.size()); ++c) {
      Eigen::Vector3d left = row_of_three(y, c);
      for (int k = core_begin_[c]; k < core_begin_[c + 1]; ++k)
        left -= below_[k].block * row_of_three(y, below_[k].column);
      row_of_three(y, c) = core_inverse_[c] * left;
    }
  }
  void sweep_up(Eigen::VectorXd& y) const {
    for (int c = static_cast<int>(core_.size()) - 1; c >= 0; --c) {
      const Eigen::Vector3d known = core_inverse_[c] * row_of_three(y, c);
      row_of_three(y, c) = known;
      for (int k = core_begin_[c]; k < core_begin_[c + 1]; ++k)
        row_of_three(y, below_[k].column) -= below_[k].block.transpose() * known;
    }
  }

  // What x leaves of the right side.
  Eigen::VectorXd rest(const Eigen::VectorXd& right, const Eigen::VectorXd& x) const {
    Eigen::VectorXd r(right.size());
    for (int c = 0; c < static_cast<int>(core_.size()); ++c) {
      const Eigen::Vector3d own = row_of_three(x, c);
      Eigen::Vector3d left = row_of_three(right, c) - core_pivot_[c] * own;
      for (int k = core_begin_[c]; k < core_begin_[c + 1]; ++k) {
        left -= below_[k].block * row_of_three(x, below_[k].column);
        row_of_three(r, below_[k].column) -= below_[k].block.transpose() * own;
      }
      row_of_three(r, c) = left;
    }
    return r;
  }

  // Conjugate gradients from the core's part of x.
  bool solve_core(const Eigen::VectorXd& right, Eigen::VectorXd& x, double tolerance, int most_steps) {
    const auto size = static_cast<int>(core_.size());
    const auto rows = static_cast<Eigen::Index>(3 * core_.size());
    Eigen::VectorXd goal(rows), y(rows), z(rows), way(rows), change(rows);
    for (int c = 0; c < size; ++c) {
      row_of_three(goal, c) = row_of_three(right, core_[c]);
      row_of_three(y, c) = row_of_three(x, core_[c]);
    }
    // Of what is left of the right side, swept down.
    Eigen::VectorXd r = rest(goal, y);
    sweep_down(r);
    const auto weigh = [&] {
      for (int c = 0; c < size; ++c) row_of_three(z, c) = core_pivot_[c] * row_of_three(r, c);
      return r.dot(z);
    };
    double rho = weigh();
    const double least = tolerance * tolerance * rho;
    Eigen::VectorXd p = z;
    for (steps_ = 0; rho > least; ++steps_) {
      if (steps_ == most_steps) return false;
      way = p;
      sweep_up(way);
      for (int c = 0; c < size; ++c)
        row_of_three(change, c) = row_of_three(p, c) - core_pivot_[c] * row_of_three(way, c);
      sweep_down(change);
      change += way;
      const double alpha = rho / p.dot(change);
      y += alpha * way;
      r -= alpha * change;
      const double before = std::exchange(rho, weigh());
      p = z + rho / before * p;
    }
    for (int c = 0; c < size; ++c) row_of_three(x, core_[c]) = row_of_three(y, c);
    return std::isfinite(rho);
  }

  std::vector<std::vector<Entry>>
      entries_;  // per row, off the diagonal; of an eliminated one as at its turn, of the core none
  std::vector<Eigen::Matrix3d> pivot_;    // the diagonal, likewise
  std::vector<Eigen::Matrix3d> inverse_;  // of pivots
  std::vector<std::uint8_t> is_eliminated_;
  std::vector<int> order_, core_;
  // Of the core, by its own numbers: the diagonal, its inverse, and the blocks of each row before it.
  std::vector<Eigen::Matrix3d> core_pivot_, core_inverse_;
  std::vector<int> core_begin_;
  std::vector<Entry> below_;
  int steps_ = 0;
};

}  // namespace detail
}  // namespace mspskel
