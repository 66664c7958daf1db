// Rank of a growing set of cocycle labels, exact modulo a large prime.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "mspskel/collapse/cocycle_label.h"

namespace mspskel {

// Gaussian elimination modulo p = 2^31 − 1, one sparse row at a time. The rank modulo p is a lower bound of
// the rank over the rationals, so rows that are called independent are independent.
class LabelRank {
 public:
  // Adds the label to the rows if it is independent of them, and says whether it was. Cost: the entries of
  // the rows that it is reduced by; a label with an entry that no row has costs that entry alone where it
  // comes first.
  bool insert(const CocycleLabel& label) {
    Row row = reduced(label);
    if (row.empty()) return false;
    const std::uint64_t scale = inverse(row.front().second);
    for (Entry& entry : row) entry.second = entry.second * scale % kPrime;
    const auto pivot = static_cast<std::size_t>(row.front().first);
    if (row_of_.size() <= pivot) row_of_.resize(pivot + 1, kNone);
    row_of_[pivot] = static_cast<Index>(rows_.size());
    rows_.push_back(std::move(row));
    return true;
  }
  // Whether insert() would return false. Cost: the same.
  bool depends(const CocycleLabel& label) const { return reduced(label).empty(); }
  Index rank() const { return static_cast<Index>(rows_.size()); }

 private:
  using Entry = std::pair<Index, std::uint64_t>;
  using Row = std::vector<Entry>;  // by ascending index
  static constexpr std::uint64_t kPrime = 2147483647u;

  static std::uint64_t residue(std::int64_t value) {
    const std::int64_t r = value % static_cast<std::int64_t>(kPrime);
    return static_cast<std::uint64_t>(r < 0 ? r + static_cast<std::int64_t>(kPrime) : r);
  }

  // What is left of the label when the rows with its leading entries are taken off, one after the other. A
  // row begins with a 1 at its pivot and has nothing before it.
  Row reduced(const CocycleLabel& label) const {
    std::map<Index, std::uint64_t> open;
    for (const auto& [index, value] : label.entries())
      if (const std::uint64_t r = residue(value); r != 0) open.emplace(index, r);
    for (auto at = open.begin(); at != open.end();) {
      const auto column = static_cast<std::size_t>(at->first);
      const Index r = column < row_of_.size() ? row_of_[column] : kNone;
      if (r == kNone) break;
      const std::uint64_t factor = kPrime - at->second;
      for (const auto& [index, value] : rows_[static_cast<std::size_t>(r)]) {
        std::uint64_t& x = open[index];
        x = (x + factor * value) % kPrime;
        if (x == 0 && index != at->first) open.erase(index);
      }
      at = open.erase(at);
    }
    return {open.begin(), open.end()};
  }
  // x^(p − 2), by Fermat.
  static std::uint64_t inverse(std::uint64_t x) {
    std::uint64_t result = 1;
    for (std::uint64_t e = kPrime - 2; e != 0; e >>= 1, x = x * x % kPrime)
      if (e & 1) result = result * x % kPrime;
    return result;
  }

  std::vector<Row> rows_;
  std::vector<Index> row_of_;  // per index the row whose pivot it is, or kNone
};

}  // namespace mspskel
