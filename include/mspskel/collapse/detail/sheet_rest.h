// What is left of sheets where no edge collapses: its free edges and its faces, the greatest first.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "mspskel/collapse/skeleton_complex.h"

namespace mspskel {
namespace detail {

// Two heaps whose entries count while they are true: an edge with one face and its length, a face and its
// area. Length is that of an edge, area that of a face of the complex, by functions that depend on their
// vertices' places.
class SheetRest {
 public:
  // The vertex moved, or lost or gained faces; all vertices of a deleted face have.
  void touch(Index vertex) {
    if (started_) touched_.push_back(vertex);
  }

  // Takes in what was touched; the whole complex the first time. Cost: O(log faces) for each face of what was
  // touched.
  template <class Length, class Area>
  void update(const SkeletonComplex& complex, Length length, Area area) {
    const auto offer_face = [&](Index f) {
      push(faces_, {area(f), -f});
      for (const Index d : complex.face_darts(f))
        if (complex.face_count(d / 2) == 1) push(free_edges_, {length(d / 2), -(d / 2)});
    };
    if (!started_) {
      started_ = true;
      for (Index f = 0; f < complex.face_capacity(); ++f)
        if (complex.is_face(f)) offer_face(f);
      return;
    }
    std::sort(touched_.begin(), touched_.end());
    touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
    std::vector<Index> faces;
    for (const Index v : touched_)
      for (Index d = complex.first_dart(v); d != kNone; d = complex.next_dart(d))
        for (Index c = complex.first_corner(d / 2); c != kNone; c = complex.next_corner(c))
          faces.push_back(c / 3);
    touched_.clear();
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    for (const Index f : faces) offer_face(f);
  }

  // The longest edge with one face, the first of equal ones; kNone if there is none. After an update, with
  // the same functions. It is to be deleted, as is the face.
  template <class Length>
  Index take_free_edge(const SkeletonComplex& complex, Length length) {
    return take(free_edges_, [&](double value, Index e) {
      return complex.is_edge(e) && complex.face_count(e) == 1 && length(e) == value;
    });
  }
  // The largest face, the first of equal ones.
  template <class Area>
  Index take_face(const SkeletonComplex& complex, Area area) {
    return take(faces_, [&](double value, Index f) { return complex.is_face(f) && area(f) == value; });
  }

 private:
  using Entry = std::pair<double, Index>;  // the element's number negated: of equal values the least

  static void push(std::vector<Entry>& heap, const Entry& entry) {
    heap.push_back(entry);
    std::push_heap(heap.begin(), heap.end());
  }
  template <class Holds>
  static Index take(std::vector<Entry>& heap, Holds holds) {
    while (!heap.empty()) {
      const auto [value, element] = heap.front();
      std::pop_heap(heap.begin(), heap.end());
      heap.pop_back();
      if (holds(value, -element)) return -element;
    }
    return kNone;
  }

  bool started_ = false;
  std::vector<Index> touched_;
  std::vector<Entry> free_edges_, faces_;
};

}  // namespace detail
}  // namespace mspskel
