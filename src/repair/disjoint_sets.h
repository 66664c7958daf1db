#pragma once

#include <numeric>
#include <utility>
#include <vector>

#include "mspskel/base/types.h"

namespace mspskel::detail {

// Union and find with path halving. The root of a set is its smallest member.
class DisjointSets {
 public:
  explicit DisjointSets(Index size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0); }
  Index root(Index i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  // False if they were one set already.
  bool unite(Index a, Index b) {
    a = root(a);
    b = root(b);
    if (a == b) return false;
    parent_[std::max(a, b)] = std::min(a, b);
    return true;
  }

 private:
  std::vector<Index> parent_;
};

// The same for members that are equal or opposite to each other.
class SignedSets {
 public:
  explicit SignedSets(Index size) : parent_(size), opposite_(size, 0) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  // The root, and whether the member is opposite to it.
  std::pair<Index, char> find(Index i) {
    Index root = i;
    char parity = 0;
    while (parent_[root] != root) {
      parity ^= opposite_[root];
      root = parent_[root];
    }
    for (char left = parity; parent_[i] != i;) {
      const Index above = parent_[i];
      const char own = opposite_[i];
      parent_[i] = root;
      opposite_[i] = left;
      left ^= own;
      i = above;
    }
    return {root, parity};
  }
  // False if they were in one set already and the other way.
  bool unite(Index a, Index b, char opposite) {
    const auto [ra, pa] = find(a);
    const auto [rb, pb] = find(b);
    const char between = static_cast<char>(pa ^ pb ^ opposite);
    if (ra == rb) return between == 0;
    parent_[std::max(ra, rb)] = std::min(ra, rb);
    opposite_[std::max(ra, rb)] = between;
    return true;
  }

 private:
  std::vector<Index> parent_;
  std::vector<char> opposite_;
};

}  // namespace mspskel::detail
