#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "mspskel/base/linkage.h"
#include "mspskel/collapse/detail/collapsed_edges.h"

namespace mspskel {

MSPSKEL_INLINE SkeletonDecimater::SkeletonDecimater(SkeletonComplex complex, std::vector<MergingSet> sets,
                                                    CollapseOptions options)
    : complex_(std::move(complex)), sets_(std::move(sets)), options_(std::move(options)) {
  validate(options_);
  if (!options_.keep_topology) complex_.forget_labels();
  if (static_cast<Index>(sets_.size()) != complex_.vertex_capacity())
    throw UsageError("merging sets: there must be one for every vertex");
  nodes_.resize(sets_.size());
  parent_.assign(sets_.size(), kNone);
  from_parent_.resize(sets_.size());
  state_.assign(static_cast<std::size_t>(complex_.edge_capacity()), State::kQueued);
  for (Index v = 0; v < complex_.vertex_capacity(); ++v) {
    refresh(v);
    if (complex_.is_vertex(v) && !nodes_[v].position.allFinite())
      throw UsageError("skeletal point " + std::to_string(v) + " is not finite");
  }
  const std::vector<Index> edges = detail::living_edges(complex_);
  for (const Index e : edges) longest_ = std::max(longest_, length(e));
  heap_.reserve(edges.size());
  for (const Index e : edges) heap_.push_back(key(e));
  std::make_heap(heap_.begin(), heap_.end(), std::greater<>());
}

MSPSKEL_INLINE Index SkeletonDecimater::node_of(Index v) const {
  while (parent_[v] != kNone) v = parent_[v];
  return v;
}

// ---- costs
// -----------------------------------------------------------------------------------------------------------

MSPSKEL_INLINE void SkeletonDecimater::refresh(Index node) {
  Node& n = nodes_[node];
  n.position = sets_[node].position();
  n.perimeter = sets_[node].perimeter();
  n.axis_known = false;
}

MSPSKEL_INLINE const Vector3& SkeletonDecimater::axis(Index node) {
  Node& n = nodes_[node];
  if (!n.axis_known) n.axis = sets_[node].axis();
  n.axis_known = true;
  return n.axis;
}

MSPSKEL_INLINE double SkeletonDecimater::length(Index e) const {
  const auto [u, v] = complex_.ends(e);
  return (nodes_[u].position - nodes_[v].position).norm();
}

// Grows with every change of either end: the kept end's revision becomes the sum of both and one more.
MSPSKEL_INLINE std::uint32_t SkeletonDecimater::revision(Index e) const {
  const auto [u, v] = complex_.ends(e);
  return nodes_[u].revision + nodes_[v].revision;
}

MSPSKEL_INLINE CostTerms SkeletonDecimater::cost_terms(Index e) {
  const auto [u, v] = complex_.ends(e);
  CostTerms terms;
  terms.perimeter_ratio = perimeter_ratio(nodes_[u].perimeter, nodes_[v].perimeter);
  terms.relative_length = longest_ > 0 ? length(e) / longest_ : 0.0;
  terms.angle = axis_angle(axis(u), axis(v));
  terms.slice_error = slice_error_metric(sets_[u], sets_[v]);
  return terms;
}

MSPSKEL_INLINE double SkeletonDecimater::cost(Index e) {
  if (options_.cost) {
    const double cost = options_.cost(cost_terms(e));
    return std::isnan(cost) ? std::numeric_limits<double>::infinity() : cost;
  }
  if (options_.order == CollapseOrder::kShortestFirst) return length(e);
  return total_cost(cost_terms(e), options_.lambda, options_.angle_floor);
}

MSPSKEL_INLINE float SkeletonDecimater::rounded_length(Index e) const {
  constexpr double kNothing = 1e-10;  // far below any length that matters, in the normalised frame
  return static_cast<float>(length(e) + kNothing);
}

MSPSKEL_INLINE SkeletonDecimater::Key SkeletonDecimater::key(Index e) {
  constexpr double kNothing = 1e-20;  // where points coincide, rounding is all
  return {static_cast<float>(cost(e) + kNothing), rounded_length(e), e, revision(e)};
}

// ---- the queue
// -------------------------------------------------------------------------------------------------------

MSPSKEL_INLINE void SkeletonDecimater::push(const Key& key) {
  state_[key.edge] = State::kQueued;
  heap_.push_back(key);
  std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
  ++counts_.queue_operations;
}

MSPSKEL_INLINE SkeletonDecimater::Key SkeletonDecimater::pop() {
  std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
  const Key top = heap_.back();
  heap_.pop_back();
  ++counts_.queue_operations;
  return top;
}

MSPSKEL_INLINE bool SkeletonDecimater::step() {
  while (!heap_.empty()) {
    const Key top = pop();
    if (!complex_.is_edge(top.edge)) continue;
    if (top.revision != revision(top.edge) && !heap_.empty()) {
      const Key current = key(top.edge);
      if (heap_.front() < current) {
        push(current);
        continue;
      }
    }
    if (process(top.edge)) return true;
  }
  return leave_dead_end();
}

MSPSKEL_INLINE void SkeletonDecimater::run(const Execution& execution) {
  constexpr Index kInterval = 256;
  const double vertices = std::max<Index>(complex_.vertex_count(), 1);
  Index steps = 0;
  do {
    if (steps++ % kInterval == 0)
      report_progress(execution.progress, "collapse", std::min(1.0, counts_.collapses / vertices));
  } while (step());
  report_progress(execution.progress, "collapse", 1.0);
}

// ---- one edge
// --------------------------------------------------------------------------------------------------------

MSPSKEL_INLINE bool SkeletonDecimater::is_noise(Index e) const {
  const auto [u, v] = complex_.ends(e);
  return edge_saturation(sets_[u], sets_[v]) < options_.saturation_threshold;
}

// Fig. 4.5: whether no adjacent edge can change the ends any more.
MSPSKEL_INLINE bool SkeletonDecimater::has_settled_neighbours(Index e) const {
  for (const Index node : complex_.ends(e))
    for (Index d = complex_.first_dart(node); d != kNone; d = complex_.next_dart(d))
      if (complex_.face_count(d / 2) > 0 || is_noise(d / 2)) return false;
  return true;
}

// Collapses the edge or sets it aside; returns whether it collapsed.
MSPSKEL_INLINE bool SkeletonDecimater::process(Index e) {
  if (complex_.face_count(e) > 0) return try_collapse(e, false);
  if (options_.one_dimensional == EdgePolicy::kSaturation && is_noise(e)) return try_collapse(e, false);
  const bool listed = options_.one_dimensional == EdgePolicy::kKeep || has_settled_neighbours(e);
  state_[e] = listed ? State::kListed : State::kParked;
  ++(listed ? counts_.listed : counts_.parked);
  return false;
}

// The end with fewer edges moves, since its edges are relinked one by one. Merged edges keep the kept end's
// place in the queue, so the choice matters and has to be one of geometry, not of numbering or rounding.
MSPSKEL_INLINE bool SkeletonDecimater::outranks(Index u, Index v) const {
  const Index more = complex_.degree(u) - complex_.degree(v);
  if (more != 0) return more > 0;
  // Errors and distances may vanish but for rounding, so they are seen beside 1.
  const auto rank = [&](Index node) {
    const MergingSet& set = sets_[node];
    return std::array<double, 4>{set.area(), set.perimeter(), 1 + set.error_sum(),
                                 1 + nodes_[node].position.norm()};
  };
  const std::array<double, 4> a = rank(u), b = rank(v);
  constexpr double kRounding = 1e-9;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::abs(a[i] - b[i]) > kRounding * std::max(a[i], b[i])) return a[i] > b[i];
  return true;
}

MSPSKEL_INLINE bool SkeletonDecimater::try_collapse(Index e, bool allow_parallel) {
  const auto [first, second] = complex_.ends(e);
  const bool keep_first = outranks(first, second);
  const Index kept = keep_first ? first : second, gone = keep_first ? second : first;
  const bool flat = complex_.face_count(e) == 0;
  CocycleLabel way = complex_.label(complex_.dart_from(e, kept));
  const CollapseRefusal refusal = complex_.collapse(e, kept, allow_parallel);
  if (refusal != CollapseRefusal::kAllowed) {
    ++(refusal == CollapseRefusal::kLoop ? counts_.refused_loop : counts_.refused_labels);
    state_[e] = State::kRefused;
    return false;
  }
  ++counts_.collapses;
  if (flat) ++counts_.one_dimensional_collapses;
  sets_[kept].merge(sets_[gone]);
  parent_[gone] = kept;
  from_parent_[gone] = std::move(way);
  nodes_[kept].revision += nodes_[gone].revision + 1;
  refresh(kept);
  sheets_.touch(kept);
  // A merged edge may have gained the faces that make it collapsible again.
  for (const Index m : complex_.merged_edges())
    if (complex_.is_edge(m) && complex_.face_count(m) > 0 &&
        (state_[m] == State::kParked || state_[m] == State::kListed)) {
      ++counts_.reopened;
      push(key(m));
    }
  if (options_.one_dimensional == EdgePolicy::kSaturation) reopen_noise(kept);
  return true;
}

// The saturation of an edge changes with its ends only: edges aside return if theirs fell below the
// threshold.
MSPSKEL_INLINE void SkeletonDecimater::reopen_noise(Index node) {
  for (Index d = complex_.first_dart(node); d != kNone; d = complex_.next_dart(d)) {
    const Index e = d / 2;
    if ((state_[e] == State::kParked || state_[e] == State::kListed) && is_noise(e)) {
      ++counts_.reopened;
      push(key(e));
    }
  }
}

// A loop of three edges round a handle blocks each of them for good, whatever else collapses; only the
// deletion of an edge at one of their ends can free them.
MSPSKEL_INLINE void SkeletonDecimater::reopen_refused(Index node) {
  for (Index d = complex_.first_dart(node); d != kNone; d = complex_.next_dart(d))
    if (state_[d / 2] == State::kRefused) push(key(d / 2));
}

// ---- dead ends
// -------------------------------------------------------------------------------------------------------

MSPSKEL_INLINE bool SkeletonDecimater::leave_dead_end() {
  if (complex_.face_count() == 0) return options_.keep_topology && cut_surplus_loops();
  if (options_.dead_end == DeadEnd::kParallelEdges && collapse_to_parallel_edges()) return true;
  sheets_.update(
      complex_, [&](Index e) { return rounded_length(e); }, [&](Index f) { return face_area(f); });
  if (!thin_sheet()) delete_largest_face();
  return true;
}

MSPSKEL_INLINE bool SkeletonDecimater::collapse_to_parallel_edges() {
  if (living_.empty()) living_ = detail::living_edges(complex_);
  living_.erase(std::remove_if(living_.begin(), living_.end(), [&](Index e) { return !complex_.is_edge(e); }),
                living_.end());
  std::vector<Key> candidates;
  for (const Index e : living_)
    if (complex_.face_count(e) > 0) candidates.push_back(key(e));
  std::sort(candidates.begin(), candidates.end());
  for (const Key& candidate : candidates) {
    if (!try_collapse(candidate.edge, true)) continue;
    ++counts_.parallel_collapses;
    return true;
  }
  return false;
}

MSPSKEL_INLINE double SkeletonDecimater::face_area(Index f) const {
  const auto darts = complex_.face_darts(f);
  const Vector3& p = nodes_[complex_.origin(darts[0])].position;
  const Vector3 a = nodes_[complex_.origin(darts[1])].position - p,
                b = nodes_[complex_.origin(darts[2])].position - p;
  return a.cross(b).norm();
}

MSPSKEL_INLINE void SkeletonDecimater::delete_face(Index f) {
  for (const Index d : complex_.face_darts(f)) sheets_.touch(complex_.origin(d));
  complex_.delete_face(f);
}

// Deletes the longest edge that has one face, with that face: an elementary collapse, which keeps the
// homotopy type.
MSPSKEL_INLINE bool SkeletonDecimater::thin_sheet() {
  const Index longest = sheets_.take_free_edge(complex_, [&](Index e) { return rounded_length(e); });
  if (longest == kNone) return false;
  const auto ends = complex_.ends(longest);
  delete_face(complex_.first_corner(longest) / 3);
  complex_.delete_edge(longest);
  ++counts_.thinned_faces;
  for (const Index node : ends) reopen_refused(node);
  return true;
}

MSPSKEL_INLINE void SkeletonDecimater::delete_largest_face() {
  delete_face(sheets_.take_face(complex_, [&](Index f) { return face_area(f); }));
  ++counts_.deleted_faces;
}

// Without faces, loops that depend on others by their labels are the traces of deleted faces: cut them,
// longest edges first. Loops without any label go too.
MSPSKEL_INLINE bool SkeletonDecimater::cut_surplus_loops() {
  const std::vector<Index> surplus = surplus_edges(complex_, [&](Index a, Index b) {
    return std::make_pair(rounded_length(a), a) < std::make_pair(rounded_length(b), b);
  });
  for (const Index e : surplus) {
    const auto ends = complex_.ends(e);
    complex_.delete_edge(e);
    ++counts_.deleted_edges;
    for (const Index node : ends) reopen_refused(node);
  }
  return !surplus.empty();
}

// ---- result
// ----------------------------------------------------------------------------------------------------------

MSPSKEL_INLINE CollapsedSkeleton SkeletonDecimater::result() const {
  CollapsedSkeleton skeleton;
  skeleton.counts = counts_;
  std::vector<Index> number(sets_.size(), kNone), parent(parent_);
  std::vector<CocycleLabel> way(from_parent_);
  // The vertices between v and its root become children of the root.
  std::vector<Index> path;
  const auto root = [&](Index v) {
    path.clear();
    for (; parent[v] != kNone; v = parent[v]) path.push_back(v);
    for (std::size_t i = path.size(); i-- > 1;) {
      parent[path[i - 1]] = v;
      if (!way[path[i]].is_zero()) way[path[i - 1]] = way[path[i]] + way[path[i - 1]];
    }
    return v;
  };
  skeleton.node_of_vertex.assign(sets_.size(), kNone);
  for (Index v = 0; v < complex_.vertex_capacity(); ++v) {
    const Index node = root(v);
    if (!complex_.is_vertex(node)) continue;
    if (number[node] == kNone) {
      number[node] = static_cast<Index>(skeleton.nodes.size());
      const MergingSet& set = sets_[node];
      skeleton.nodes.push_back({set.position(), set.area(), set.perimeter(), set.error(), set.axis(), set});
    }
    skeleton.node_of_vertex[v] = number[node];
  }
  skeleton.label_of_vertex = std::move(way);
  skeleton.edges = detail::collapsed_edges(complex_, number);
  return skeleton;
}

MSPSKEL_INLINE CollapsedSkeleton collapse_complex(SkeletonComplex complex, std::vector<MergingSet> sets,
                                                  const CollapseOptions& options,
                                                  const Execution& execution) {
  SkeletonDecimater decimater(std::move(complex), std::move(sets), options);
  decimater.run(execution);
  return decimater.result();
}

}  // namespace mspskel
