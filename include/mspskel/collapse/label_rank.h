// Rank of a growing set of cocycle labels, exact modulo a large prime.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "mspskel/collapse/cocycle_label.h"

namespace mspskel {

// Gaussian elimination modulo p = 2^31 − 1, one row at a time. The rank modulo p is a lower bound of the rank
// over the rationals, so rows that are called independent are independent.
class LabelRank {
 public:
  // Adds the label to the rows if it is independent of them, and says whether it was. Cost: O(rank · g).
  bool insert(const CocycleLabel& label) {
    std::vector<std::uint64_t> row = dense(label);
    reduce(row);
    const auto pivot = std::find_if(row.begin(), row.end(), [](std::uint64_t x) { return x != 0; });
    if (pivot == row.end()) return false;
    const std::uint64_t scale = inverse(*pivot);
    pivots_.push_back(static_cast<std::size_t>(pivot - row.begin()));
    for (std::uint64_t& x : row) x = x * scale % kPrime;
    rows_.push_back(std::move(row));
    return true;
  }
  // Whether insert() would return false. Cost: O(rank · g).
  bool depends(const CocycleLabel& label) const {
    std::vector<std::uint64_t> row = dense(label);
    reduce(row);
    return std::all_of(row.begin(), row.end(), [](std::uint64_t x) { return x == 0; });
  }
  Index rank() const { return static_cast<Index>(rows_.size()); }

 private:
  static constexpr std::uint64_t kPrime = 2147483647u;

  static std::vector<std::uint64_t> dense(const CocycleLabel& label) {
    std::vector<std::uint64_t> row;
    if (label.is_zero()) return row;
    row.assign(static_cast<std::size_t>(label.entries().back().index) + 1, 0);
    for (const auto& [index, value] : label.entries()) {
      const std::int64_t residue = std::int64_t{value} % static_cast<std::int64_t>(kPrime);
      row[static_cast<std::size_t>(index)] =
          static_cast<std::uint64_t>(residue < 0 ? residue + static_cast<std::int64_t>(kPrime) : residue);
    }
    return row;
  }
  // Rows are scaled to have 1 at their pivot; a later row is zero at the pivots of the earlier ones.
  void reduce(std::vector<std::uint64_t>& row) const {
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      if (pivots_[r] >= row.size() || row[pivots_[r]] == 0) continue;
      const std::uint64_t factor = kPrime - row[pivots_[r]];
      if (row.size() < rows_[r].size()) row.resize(rows_[r].size(), 0);
      for (std::size_t i = 0; i < rows_[r].size(); ++i) row[i] = (row[i] + factor * rows_[r][i]) % kPrime;
    }
  }
  // x^(p − 2), by Fermat.
  static std::uint64_t inverse(std::uint64_t x) {
    std::uint64_t result = 1;
    for (std::uint64_t e = kPrime - 2; e != 0; e >>= 1, x = x * x % kPrime)
      if (e & 1) result = result * x % kPrime;
    return result;
  }

  std::vector<std::vector<std::uint64_t>> rows_;
  std::vector<std::size_t> pivots_;
};

}  // namespace mspskel
