#include "mspskel/samples/samples.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "families.h"
#include "mspskel/base/error.h"
#include "mspskel/base/near_name.h"
#include "noise.h"
#include "sparse.h"
#include "truth.h"

namespace mspskel {

namespace detail {
Tessellation tessellation(double area, const SampleOptions& options) {
  Tessellation t;
  t.edge = edge_for_vertices(area, options.resolution);
  t.seed = options.seed;
  return t;
}

SampleInfo facts(const char* name, const char* description, Index genus, Index leaves, Index resolution,
                 Index least) {
  SampleInfo info;
  info.name = name;
  info.description = description;
  info.genus = genus;
  info.leaves = leaves;
  info.resolution = resolution;
  info.least_resolution = least;
  return info;
}

SampleInfo with_ratio(SampleInfo info, const char* of, double value, double least, double most) {
  info.ratio_of = of;
  info.ratio = value;
  info.least_ratio = least;
  info.most_ratio = most;
  return info;
}

SampleInfo with_sides(SampleInfo info, const Vector3& sides) {
  info.has_sides = true;
  info.sides = sides;
  return info;
}

SampleInfo with_sections(SampleInfo info, Section section) {
  info.has_sections = true;
  info.section = section;
  return info;
}

Family standing(const Family& family) {
  return {family.info, [make = family.make](const SampleOptions& o) { return y_upward(make(o)); },
          family.adapt, [truth = family.truth](const SampleOptions& o) { return y_upward(truth(o)); }};
}

SampleInfo with_count(SampleInfo info, const char* of, Index value, Index least, Index most) {
  info.count_of = of;
  info.count = value;
  info.least_count = least;
  info.most_count = most;
  return info;
}
}  // namespace detail

namespace {
using detail::Family;

const std::vector<Family>& families() {
  static const std::vector<Family> all = [] {
    std::vector<Family> list;
    for (const auto& part :
         {detail::ring_families(), detail::knot_families(), detail::block_families(), detail::skin_families(),
          detail::bar_families(), detail::tree_families(), detail::vessel_families()})
      list.insert(list.end(), part.begin(), part.end());
    std::sort(list.begin(), list.end(),
              [](const Family& a, const Family& b) { return a.info.name < b.info.name; });
    return list;
  }();
  return all;
}

const Family& find_family(const std::string& name) {
  std::vector<std::string> names;
  for (const Family& family : families()) {
    if (family.info.name == name) return family;
    names.push_back(family.info.name);
  }
  const std::string near = did_you_mean(name, names);
  throw UsageError("no sample is called '" + name + "'" +
                   (near.empty() ? "; mspskel sample --help lists them" : near));
}

std::string number(double x) {
  std::string text = std::to_string(x);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

// One sample with its facts for the given count, and the options with defaults in place of zeros.
struct Order {
  const Family* family;
  SampleInfo info;
  SampleOptions options;
};

[[noreturn]] void out_of_range(const SampleInfo& info, const std::string& option, const std::string& least,
                               const std::string& most) {
  throw UsageError(option + " of sample " + info.name + " must lie in [" + least + ", " + most + "]");
}

void complete_count(const SampleInfo& info, SampleOptions& options) {
  if (options.count != kNone && info.count_of.empty())
    throw UsageError("sample " + info.name + " has no count");
  if (options.count == kNone) options.count = info.count;
  if (options.count < info.least_count || options.count > info.most_count)
    out_of_range(info, "count (" + info.count_of + ")", std::to_string(info.least_count),
                 std::to_string(info.most_count));
}

void complete_ratio(const SampleInfo& info, SampleOptions& options) {
  if (options.ratio != 0 && info.ratio_of.empty()) throw UsageError("sample " + info.name + " has no ratio");
  if (options.ratio == 0) options.ratio = info.ratio;
  if (!(options.ratio >= info.least_ratio && options.ratio <= info.most_ratio))
    out_of_range(info, "ratio (" + info.ratio_of + ")", number(info.least_ratio), number(info.most_ratio));
}

void complete_sides(const SampleInfo& info, SampleOptions& options) {
  if (!info.has_sides && !options.sides.isZero(0)) throw UsageError("sample " + info.name + " has no sides");
  if (!info.has_sides) return;
  for (Eigen::Index k = 0; k < 3; ++k)
    if (options.sides[k] == 0) options.sides[k] = info.sides[k];
  const double least = options.sides.minCoeff(), most = options.sides.maxCoeff();
  if (!(least > 0) || !std::isfinite(most) || most > 10 * least)
    throw UsageError("sides of sample " + info.name +
                     " must be positive, the longest at most 10 times the shortest");
}

void complete_section(const SampleInfo& info, SampleOptions& options) {
  if (options.section != Section::kOwn && !info.has_sections)
    throw UsageError("sample " + info.name + " has no choice of section");
  if (options.section == Section::kOwn) options.section = info.section;
}

Order complete(const Family& family, const SampleOptions& options) {
  constexpr Index kMostVertices = 10'000'000;
  Order order{&family, family.info, options};
  order.info.has_truth = static_cast<bool>(family.truth);
  complete_count(order.info, order.options);
  complete_ratio(order.info, order.options);
  complete_sides(order.info, order.options);
  complete_section(order.info, order.options);
  if (family.adapt) family.adapt(order.info, order.options);
  Index& resolution = order.options.resolution;
  if (resolution == 0) resolution = order.info.resolution;
  if (resolution < order.info.least_resolution || resolution > kMostVertices)
    out_of_range(order.info, "resolution", std::to_string(order.info.least_resolution),
                 std::to_string(kMostVertices));
  if (!(options.jitter >= 0 && options.jitter <= 0.3)) throw UsageError("jitter must lie in [0, 0.3]");
  return order;
}

double mean_edge(const PolygonSoup& soup) {
  double sum = 0;
  for (std::size_t c = 0; c < soup.corners.size(); c += 3)
    for (std::size_t k = 0; k < 3; ++k)
      sum += (soup.points[soup.corners[c + k]] - soup.points[soup.corners[c + (k + 1) % 3]]).norm();
  return sum / static_cast<double>(soup.corners.size());
}

// By up to `reach`, model units.
void jitter(PolygonSoup& soup, double reach, std::uint64_t seed) {
  for (std::size_t v = 0; v < soup.points.size(); ++v) {
    Vector3 shift;
    for (std::uint64_t axis = 0; axis < 3; ++axis)
      shift[static_cast<Eigen::Index>(axis)] = detail::noise(seed + 77, v, axis);
    soup.points[v] += reach * shift / std::max(1.0, shift.norm());
  }
}

Index find_root(std::vector<Index>& parent, Index v) {
  while (parent[v] != v) v = parent[v] = parent[parent[v]];
  return v;
}

// Closed, manifold along edges, and of the expected Euler characteristic and number of pieces.
bool has_topology(const PolygonSoup& soup, const SampleInfo& info) {
  std::vector<std::pair<Index, Index>> half_edges;
  std::vector<Index> parent(soup.points.size());
  std::iota(parent.begin(), parent.end(), 0);
  for (std::size_t c = 0; c < soup.corners.size(); ++c) {
    const Index a = soup.corners[c], b = soup.corners[c % 3 == 2 ? c - 2 : c + 1];
    half_edges.emplace_back(a, b);
    parent[find_root(parent, a)] = find_root(parent, b);
  }
  std::sort(half_edges.begin(), half_edges.end());
  if (std::adjacent_find(half_edges.begin(), half_edges.end()) != half_edges.end()) return false;
  for (const auto& [a, b] : half_edges)
    if (!std::binary_search(half_edges.begin(), half_edges.end(), std::make_pair(b, a))) return false;
  Index pieces = 0;
  for (Index v = 0; v < static_cast<Index>(parent.size()); ++v) pieces += parent[v] == v;
  const auto euler = static_cast<std::ptrdiff_t>(soup.points.size()) -
                     static_cast<std::ptrdiff_t>(half_edges.size() / 2) +
                     static_cast<std::ptrdiff_t>(soup.polygon_count());
  return pieces == info.components && euler == 2 * (info.components - info.genus);
}
}  // namespace

std::vector<SampleInfo> list_samples() {
  std::vector<SampleInfo> result;
  for (const Family& family : families()) result.push_back(complete(family, {}).info);
  return result;
}

SampleInfo describe_sample(const std::string& name, const SampleOptions& options) {
  return complete(find_family(name), options).info;
}

PolygonSoup make_sample(const std::string& name, const SampleOptions& options) {
  constexpr double kSparseError = 0.05;  // of an edge: chords of the curved parts
  const Order order = complete(find_family(name), options);
  PolygonSoup soup = order.family->make(order.options);
  const double edge = mean_edge(soup);
  if (order.options.sparse) soup = detail::with_long_triangles(soup, kSparseError * edge);
  if (!has_topology(soup, order.info))
    throw UsageError("a resolution of " + std::to_string(order.options.resolution) +
                     " is too low for sample " + name + "; use a larger --resolution");
  if (order.options.jitter > 0) jitter(soup, order.options.jitter * edge, order.options.seed);
  return soup;
}

CurveSkeleton sample_truth(const std::string& name, const SampleOptions& options) {
  const Order order = complete(find_family(name), options);
  if (!order.family->truth)
    throw UsageError("sample " + name + " has no defined skeleton; mspskel sample --help says which have");
  return order.family->truth(order.options);
}

}  // namespace mspskel
