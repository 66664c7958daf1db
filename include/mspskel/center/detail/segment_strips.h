// Segments of polygons by the levels that they span.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "mspskel/base/types.h"

namespace mspskel {
namespace detail::slice_centre {

// Segment i runs from level y[i] to y[i + 1]. The levels are cut into strips of even height, as many as make
// of n segments at most 3n entries: a query then comes by few more segments than its level meets.
class SegmentStrips {
 public:
  bool empty() const { return head_.empty(); }
  void clear() {
    head_.clear();
    range_.clear();
    segments_ = built_for_ = 0;
    climb_ = built_climb_ = 0.0;
  }

  // Takes in the segments from begin to before end. Below kPlain segments in all, and where a level is not
  // finite, there are no strips. Amortised cost: O(end - begin), since all strips are made anew where there
  // are more than twice as many segments or they climb more than four times as much.
  void add(const std::vector<double>& y, Index begin, Index end) {
    const Range range{begin, end};
    range_.push_back(range);
    segments_ += end - begin;
    for (Index i = begin; i < end; ++i) climb_ += std::abs(y[i + 1] - y[i]);
    if (segments_ < kPlain) return;
    if (segments_ > 2 * built_for_ || !(climb_ <= 4 * built_climb_))
      build(y);
    else if (!empty())
      enter(y, range);
  }

  // Calls visit(i) once for every segment with one end above the level and one not above it, and for those
  // that share a strip with it. Precondition: not empty.
  template <class Visit>
  void for_each_at(double level, Visit visit) const {
    for (Index e = head_[strip(level)]; e != kNone; e = entry_[e].next) visit(entry_[e].segment);
  }

 private:
  static constexpr Index kPlain = 64;
  struct Entry {
    Index segment, next;
  };
  struct Range {
    Index begin, end;
  };

  // Never falls where the level rises, rounded or not: what lies between two levels is in a strip between
  // theirs.
  Index strip(double level) const {
    return static_cast<Index>(std::clamp((level - low_) * per_height_, 0.0, last_));
  }

  void build(const std::vector<double>& y) {
    head_.clear();
    entry_.clear();
    built_for_ = segments_;
    built_climb_ = climb_;
    double high = low_ = y[range_.front().begin];
    for (const Range& range : range_)
      for (Index i = range.begin; i < range.end; ++i) {
        low_ = std::min(low_, y[i + 1]);
        high = std::max(high, y[i + 1]);
      }
    const double strips = std::max(1.0, std::floor(segments_ * (high - low_) / climb_));
    per_height_ = strips / (high - low_);
    if (!std::isfinite(climb_) || !std::isfinite(per_height_)) return;
    last_ = strips - 1;
    head_.assign(static_cast<std::size_t>(strips), kNone);
    for (const Range& range : range_) enter(y, range);
  }

  void enter(const std::vector<double>& y, const Range& range) {
    for (Index i = range.begin; i < range.end; ++i) {
      if (y[i] == y[i + 1]) continue;  // no level is between its ends
      const Index last = strip(std::max(y[i], y[i + 1]));
      for (Index s = strip(std::min(y[i], y[i + 1])); s <= last; ++s) {
        entry_.push_back({i, head_[s]});
        head_[s] = static_cast<Index>(entry_.size()) - 1;
      }
    }
  }

  double low_ = 0.0, per_height_ = 0.0, last_ = 0.0;  // strips a unit of height; the last strip's number
  Index segments_ = 0, built_for_ = 0;                // all, and when the strips were made
  double climb_ = 0.0, built_climb_ = 0.0;            // sums of their heights
  std::vector<Index> head_;                           // per strip its first entry
  std::vector<Entry> entry_;
  std::vector<Range> range_;
};

}  // namespace detail::slice_centre
}  // namespace mspskel
