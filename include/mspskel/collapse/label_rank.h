// Rank of a growing set of cocycle labels, exact modulo a large prime.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "mspskel/collapse/cocycle_label.h"

namespace mspskel {

// Gaussian elimination modulo p = 2^31 − 1, one sparse row at a time. The rank modulo p is a lower bound of
// the rank over the rationals, so rows that are called independent are independent. Pivots are the largest
// indices: those of the generator loops go from the longest to the shortest, and as few labels have an entry
// for a short loop, few rows fill each other.
class LabelRank {
 public:
  // Adds the label to the rows if it is independent of them, and says whether it was. Cost: the entries of
  // the rows that it is reduced by; a label whose largest index is no row's pivot costs its own entries
  // alone.
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
  bool depends(const CocycleLabel& label) { return reduced(label).empty(); }
  Index rank() const { return static_cast<Index>(rows_.size()); }

 private:
  using Entry = std::pair<Index, std::uint64_t>;
  using Row = std::vector<Entry>;  // by descending index
  static constexpr std::uint64_t kPrime = 2147483647u;

  static std::uint64_t residue(std::int64_t value) {
    const std::int64_t r = value % static_cast<std::int64_t>(kPrime);
    return static_cast<std::uint64_t>(r < 0 ? r + static_cast<std::int64_t>(kPrime) : r);
  }

  void open(Index index) {
    const auto column = static_cast<std::size_t>(index);
    if (value_.size() <= column) {
      value_.resize(column + 1, 0);
      is_open_.resize(column + 1, 0);
    }
    if (is_open_[column]) return;
    is_open_[column] = 1;
    open_.push_back(index);
    std::push_heap(open_.begin(), open_.end(), std::less<>());
  }
  // The largest open index, which is no longer.
  Index close() {
    std::pop_heap(open_.begin(), open_.end(), std::less<>());
    const Index index = open_.back();
    open_.pop_back();
    is_open_[static_cast<std::size_t>(index)] = 0;
    return index;
  }

  // What is left of the label when the rows with its leading entries are taken off, one after the other. A
  // row begins with a 1 at its pivot, its largest index.
  Row reduced(const CocycleLabel& label) {
    for (const auto& [index, value] : label.entries()) {
      open(index);
      value_[static_cast<std::size_t>(index)] = residue(value);
    }
    Row left;
    while (!open_.empty()) {
      const Index index = close();
      const auto column = static_cast<std::size_t>(index);
      const std::uint64_t x = std::exchange(value_[column], 0);
      if (x == 0) continue;
      const Index r = left.empty() && column < row_of_.size() ? row_of_[column] : kNone;
      if (r == kNone) {
        left.push_back({index, x});
        continue;
      }
      const Row& row = rows_[static_cast<std::size_t>(r)];
      for (std::size_t i = 1; i < row.size(); ++i) {
        open(row[i].first);
        std::uint64_t& y = value_[static_cast<std::size_t>(row[i].first)];
        y = (y + (kPrime - x) * row[i].second) % kPrime;
      }
    }
    return left;
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
  // Of the label that is being reduced; all zero and empty between calls.
  std::vector<std::uint64_t> value_;   // per index
  std::vector<std::uint8_t> is_open_;  // per index whether it is in the heap
  std::vector<Index> open_;            // heap, the largest first
};

}  // namespace mspskel
