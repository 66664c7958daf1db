// The label of a directed edge: an integer vector in Z^g, nearly always zero, that tells loops apart.
#pragma once

#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "mspskel/base/error.h"
#include "mspskel/base/types.h"

namespace mspskel {

// A sparse vector in Z^g, g open-ended: component i counts the signed crossings of a path with the i-th cut
// of the solid. Labels of the edges of a path add up; the reversed edge has the negated label. The zero label
// owns no memory, and adding zero costs one comparison.
class CocycleLabel {
 public:
  struct Entry {
    Index index;         // component, from 0
    std::int32_t value;  // never 0
    bool operator==(const Entry& other) const { return index == other.index && value == other.value; }
  };

  CocycleLabel() = default;
  // value times the unit vector of component `index`.
  static CocycleLabel unit(Index index, std::int32_t value = 1) {
    CocycleLabel label;
    if (value != 0) label.entries_.push_back({index, value});
    return label;
  }

  // By ascending index, no value 0.
  static CocycleLabel from_entries(std::vector<Entry> entries) {
    CocycleLabel label;
    label.entries_ = std::move(entries);
    return label;
  }

  bool is_zero() const noexcept { return entries_.empty(); }
  // Nonzero components by ascending index.
  const std::vector<Entry>& entries() const noexcept { return entries_; }
  std::int32_t operator[](Index index) const noexcept {
    for (const Entry& e : entries_)
      if (e.index == index) return e.value;
    return 0;
  }

  bool operator==(const CocycleLabel& other) const { return entries_ == other.entries_; }
  bool operator!=(const CocycleLabel& other) const { return !(*this == other); }

  // Throws UsageError if a component leaves 32 bits. Along a simple path over n edges with labels of at most
  // m no component exceeds n·m, and a collapse never makes other labels than those of such paths.
  CocycleLabel& operator+=(const CocycleLabel& other) { return add(other, 1); }
  CocycleLabel& operator-=(const CocycleLabel& other) { return add(other, -1); }
  CocycleLabel operator-() const {
    CocycleLabel result(*this);
    for (Entry& e : result.entries_) e.value = narrow(-std::int64_t{e.value});
    return result;
  }
  friend CocycleLabel operator+(CocycleLabel a, const CocycleLabel& b) { return std::move(a += b); }
  friend CocycleLabel operator-(CocycleLabel a, const CocycleLabel& b) { return std::move(a -= b); }
  friend CocycleLabel operator*(CocycleLabel a, std::int32_t factor) {
    if (factor == 0) return {};
    for (Entry& e : a.entries_) e.value = narrow(std::int64_t{e.value} * factor);
    return a;
  }

 private:
  static std::int32_t narrow(std::int64_t value) {
    if (value > std::numeric_limits<std::int32_t>::max() || value < std::numeric_limits<std::int32_t>::min())
      throw UsageError("a cocycle label leaves the range of 32-bit integers");
    return static_cast<std::int32_t>(value);
  }

  CocycleLabel& add(const CocycleLabel& other, int sign) {
    if (other.is_zero()) return *this;
    std::vector<Entry> sum;
    sum.reserve(entries_.size() + other.entries_.size());
    auto a = entries_.begin();
    auto b = other.entries_.begin();
    while (a != entries_.end() || b != other.entries_.end()) {
      const bool from_a = b == other.entries_.end() || (a != entries_.end() && a->index <= b->index);
      const bool from_b = a == entries_.end() || (b != other.entries_.end() && b->index <= a->index);
      const Index index = from_a ? a->index : b->index;
      const std::int64_t value =
          (from_a ? std::int64_t{a->value} : 0) + (from_b ? std::int64_t{sign} * b->value : 0);
      if (value != 0) sum.push_back({index, narrow(value)});
      if (from_a) ++a;
      if (from_b) ++b;
    }
    entries_ = std::move(sum);
    return *this;
  }

  std::vector<Entry> entries_;
};

// The label under the linear map that takes the i-th unit vector to image[i].
inline CocycleLabel mapped(const CocycleLabel& label, const std::vector<CocycleLabel>& image) {
  CocycleLabel result;
  for (const auto& [index, value] : label.entries()) result += image[static_cast<std::size_t>(index)] * value;
  return result;
}

}  // namespace mspskel
