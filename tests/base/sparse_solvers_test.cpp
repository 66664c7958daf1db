// Systems solved in steps have the solution that elimination gives.
#include "mspskel/base/sparse_solvers.h"

#include <catch2/catch.hpp>

#include "support/meshes.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

// Of points that are drawn to places, hardly along one direction, and joined by lines that are stiff against
// bends: those on a line by `stiffness`.
CoupledMatrix stiff_against_bends(const std::vector<std::vector<int>>& next, double stiffness,
                                  Random& random) {
  const int n = static_cast<int>(next.size());
  CoupledMatrix matrix;
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i) {
    const Vector3 weak = random.in_ball().normalized();
    const Eigen::Matrix3d weight = Eigen::Matrix3d::Identity() - 0.99 * weak * weak.transpose();
    matrix.diagonal.push_back(weight);
    entries.emplace_back(i, i, weight.trace() / 3);
  }
  const auto add = [&](int i, int j, double value) {
    entries.emplace_back(i, j, value);
    if (i == j) matrix.diagonal[i].diagonal().array() += value;
  };
  for (int i = 0; i < n; ++i) {
    const auto k = static_cast<double>(next[i].size());
    add(i, i, stiffness);
    for (const int a : next[i]) {
      add(i, a, -stiffness / k);
      add(a, i, -stiffness / k);
      for (const int b : next[i]) add(a, b, stiffness / (k * k));
    }
  }
  matrix.even.resize(n, n);
  matrix.even.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

Eigen::VectorXd times(const CoupledMatrix& matrix, const Eigen::VectorXd& x) {
  Eigen::VectorXd product = Eigen::VectorXd::Zero(x.size());
  for (int i = 0; i < matrix.even.outerSize(); ++i)
    for (Eigen::SparseMatrix<double>::InnerIterator it(matrix.even, i); it; ++it) {
      if (it.row() != i)
        product.segment<3>(3 * it.row()) += it.value() * x.segment<3>(3 * i);
      else
        product.segment<3>(3 * i) += matrix.diagonal[i] * x.segment<3>(3 * i);
    }
  return product;
}

}  // namespace

TEST_CASE("Steps end where elimination does, on grids with springs of any stiffness") {
  constexpr int kSide = 9;
  const auto number = [](int x, int y, int z) { return (x * kSide + y) * kSide + z; };
  const int n = kSide * kSide * kSide;
  for (const double stiffest : {1.0, 1e3, 1e5}) {
    Random random(3);
    std::vector<Eigen::Triplet<double>> entries;
    const auto join = [&](int a, int b) {
      const double w = random.uniform(0.01, stiffest);
      for (const int i : {a, b}) entries.emplace_back(i, i, w);
      entries.emplace_back(a, b, -w);
      entries.emplace_back(b, a, -w);
    };
    for (int x = 0; x < kSide; ++x)
      for (int y = 0; y < kSide; ++y)
        for (int z = 0; z < kSide; ++z) {
          entries.emplace_back(number(x, y, z), number(x, y, z), random.uniform(0.01, 1.0));
          if (x + 1 < kSide) join(number(x, y, z), number(x + 1, y, z));
          if (y + 1 < kSide) join(number(x, y, z), number(x, y + 1, z));
          if (z + 1 < kSide) join(number(x, y, z), number(x, y, z + 1));
        }
    Eigen::SparseMatrix<double> matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    Eigen::MatrixX3d goal(n, 3), guess(n, 3);
    for (int i = 0; i < n; ++i) {
      goal.row(i) = random.in_ball().transpose();
      guess.row(i) = random.in_ball().transpose();
    }
    const auto stepped = solve_by_steps(matrix, goal, guess);
    REQUIRE(stepped);
    for (int k = 0; k < 3; ++k)
      CHECK((matrix * *stepped - goal).col(k).norm() <= 1.1e-8 * (matrix * guess - goal).col(k).norm());
    const auto eliminated = solve_by_elimination(matrix, goal);
    REQUIRE(eliminated);
    const Eigen::MatrixX3d exact = *eliminated;
    CHECK((matrix * exact - goal).norm() < 1e-9 * goal.norm());
    const auto from_nothing = solve_by_steps(matrix, goal, Eigen::MatrixX3d::Zero(n, 3));
    REQUIRE(from_nothing);
    CHECK((*from_nothing - exact).norm() < 1e-5 * exact.norm());
    CHECK(*solve_by_steps(matrix, goal, guess) == *stepped);
    CHECK(*solve_large(matrix, goal, guess) == *stepped);
    // Where steps find no end, as with a right side that is not finite, elimination answers.
    CHECK(solve_large(matrix, std::numeric_limits<double>::infinity() * goal, guess).has_value());
  }
}

TEST_CASE("Coupled coordinates are solved by elimination, or in steps where lines meet") {
  for (const bool has_many_cycles : {false, true}) {
    Random random(5);
    constexpr int kPoints = 200;
    std::vector<Eigen::Triplet<double>> coupled_entries, even_entries;
    CoupledMatrix matrix;
    matrix.diagonal.assign(kPoints, Eigen::Matrix3d::Zero());
    const auto add = [&](int i, int j, double value) {
      even_entries.emplace_back(i, j, value);
      for (int k = 0; k < 3; ++k) coupled_entries.emplace_back(3 * i + k, 3 * j + k, value);
      if (i == j) matrix.diagonal[i].diagonal().array() += value;
    };
    Eigen::VectorXd right(3 * kPoints), guess(3 * kPoints);
    for (int i = 0; i < kPoints; ++i) {
      const Vector3 weak = random.in_ball().normalized();
      const Eigen::Matrix3d weight =
          random.uniform(0.01, 1.0) * (Eigen::Matrix3d::Identity() - 0.99 * weak * weak.transpose());
      even_entries.emplace_back(i, i, weight.trace() / 3);
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l) coupled_entries.emplace_back(3 * i + k, 3 * i + l, weight(k, l));
      matrix.diagonal[i] += weight;
      right.segment<3>(3 * i) = weight * random.in_ball();
      guess.segment<3>(3 * i) = random.in_ball();
      for (const int j : {i + 1, has_many_cycles ? (i * 7) % kPoints : i}) {
        if (j >= kPoints || j == i) continue;
        const double spring = random.uniform(0.01, 100.0);
        add(i, i, spring);
        add(j, j, spring);
        add(i, j, -spring);
        add(j, i, -spring);
      }
    }
    Eigen::SparseMatrix<double> coupled(3 * kPoints, 3 * kPoints);
    coupled.setFromTriplets(coupled_entries.begin(), coupled_entries.end());
    matrix.even.resize(kPoints, kPoints);
    matrix.even.setFromTriplets(even_entries.begin(), even_entries.end());
    const auto solution = solve_coupled(matrix, right, guess, has_many_cycles);
    REQUIRE(solution);
    const double left = has_many_cycles ? 1e-3 : 1e-11;
    CHECK((right - coupled * *solution).norm() <= left * (right - coupled * guess).norm());
    CHECK(*solve_coupled(matrix, right, guess, has_many_cycles) == *solution);
    // Where steps find no end, as from a guess that is not finite, elimination answers.
    const auto exact =
        solve_coupled(matrix, right, std::numeric_limits<double>::infinity() * guess, has_many_cycles);
    REQUIRE(exact);
    CHECK((right - coupled * *exact).norm() < 1e-9 * right.norm());
  }
}

// A tree of a thousand arms of five edges, each from the end of one before, stiff against bends.
TEST_CASE("The factors of a stiff tree hold hardly more than its matrix") {
  Random random(8);
  constexpr int kArms = 1000, kEdges = 5;
  std::vector<std::vector<int>> next(1);
  std::vector<int> ends{0};
  for (int arm = 0; arm < kArms; ++arm) {
    int last = ends[random.below(static_cast<Index>(ends.size()))];
    for (int e = 0; e < kEdges; ++e) {
      const int point = static_cast<int>(next.size());
      next.emplace_back();
      next[point].push_back(last);
      next[last].push_back(point);
      last = point;
    }
    ends.push_back(last);
  }
  const CoupledMatrix matrix = stiff_against_bends(next, 1.0, random);
  const int n = static_cast<int>(next.size());
  detail::BlockFactors factors(matrix);
  CHECK(2 * factors.block_count() < 1.2 * static_cast<double>(matrix.even.nonZeros() - n));
  REQUIRE(factors.compute());
  Eigen::VectorXd right(3 * n), product;
  for (int i = 0; i < n; ++i) right.segment<3>(3 * i) = random.in_ball();
  product = times(matrix, factors.solve(right));
  CHECK((right - product).norm() < 1e-10 * right.norm());
}

TEST_CASE("A coupled matrix that is not positive definite has no solution") {
  CoupledMatrix matrix;
  matrix.even.resize(2, 2);
  const std::vector<Eigen::Triplet<double>> entries{{0, 0, 1}, {1, 1, 1}, {0, 1, -2}, {1, 0, -2}};
  matrix.even.setFromTriplets(entries.begin(), entries.end());
  matrix.diagonal.assign(2, Eigen::Matrix3d::Identity());
  const Eigen::VectorXd right = Eigen::VectorXd::Ones(6);
  CHECK(!solve_coupled(matrix, right, right, false));
}

// Joints in a cubic grid and lines of ten points between them. With stiff lines the whole matrix would take
// steps in proportion to their stiffness; what is left of it at the joints takes as many at any size.
TEST_CASE("Of lines that meet in many cycles only the joints are solved in steps, as many at any size") {
  constexpr int kInner = 10;
  int steps[2];
  for (const int large : {0, 1}) {
    const int side = large ? 12 : 4, joints = side * side * side;
    std::vector<std::vector<int>> next(joints);
    const auto line = [&](int a, int b) {
      for (int k = 0; k <= kInner; ++k) {
        const int to = k == kInner ? b : static_cast<int>(next.size());
        if (k < kInner) next.emplace_back();
        next[a].push_back(to);
        next[to].push_back(a);
        a = to;
      }
    };
    for (int i = 0; i < joints; ++i) {
      if (i % side + 1 < side) line(i, i + 1);
      if (i / side % side + 1 < side) line(i, i + side);
      if (i / side / side + 1 < side) line(i, i + side * side);
    }
    Random random(4);
    const CoupledMatrix matrix = stiff_against_bends(next, 1e4, random);
    const auto n = static_cast<Eigen::Index>(next.size());
    Eigen::VectorXd exact(3 * n);
    for (Eigen::Index i = 0; i < n; ++i) exact.segment<3>(3 * i) = random.in_ball();
    const Eigen::VectorXd right = times(matrix, exact);
    detail::CoreSolver core(matrix);
    REQUIRE(core.eliminate());
    CHECK(core.core_size() <= static_cast<std::size_t>(7 * joints));
    const auto solution = core.solve(right, Eigen::VectorXd::Zero(3 * n), 1e-8, 1000);
    REQUIRE(solution);
    CHECK((*solution - exact).norm() < 1e-4 * exact.norm());
    steps[large] = core.steps();
  }
  CHECK(steps[0] > 0);
  CHECK(steps[1] <= 1.5 * steps[0]);
  CHECK(steps[1] < 180);  // with the blocks of the diagonal as preconditioner 261
}
