#include "mspskel/segment/segment_surface.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "coarse_parts.h"
#include "mspskel/base/error.h"
#include "mspskel/segment/smooth_borders.h"
#include "mspskel/skeleton/check_surface_map.h"

namespace mspskel {
namespace {

constexpr const char* kPartsStage = "parts";

// Of each face: what two of its corners agree on, else its first corner's part.
std::vector<Index> carry_to_faces(const SurfaceSnapshot& surface, const CurveSkeleton& skeleton,
                                  const std::vector<Index>& part_of_node) {
  std::vector<Index> part(surface.face_count());
  for (Index f = 0; f < surface.face_count(); ++f) {
    const auto corner = [&](int k) {
      return part_of_node[skeleton.node_of_vertex[surface.origin[3 * f + k]]];
    };
    part[f] = corner(1) == corner(2) ? corner(1) : corner(0);
  }
  return part;
}

Index count_of(const std::vector<Index>& part) { return 1 + *std::max_element(part.begin(), part.end()); }

// Whether each part from 0 to `count` - 1 has a face.
bool has_all(const std::vector<Index>& part_of_face, Index count) {
  std::vector<char> has(count, 0);
  for (const Index p : part_of_face) has[p] = 1;
  return std::all_of(has.begin(), has.end(), [](char h) { return h != 0; });
}

std::vector<double> face_areas(const SurfaceSnapshot& surface) {
  std::vector<double> area;
  for (Index f = 0; f < surface.face_count(); ++f) area.push_back(surface.face_area(f));
  return area;
}

// Numbers the parts anew, from the largest area to the smallest; numbers without a face go.
void number_by_area(const std::vector<double>& area_of_face, Segmentation& segmentation) {
  std::vector<double> area(segmentation.count, -1.0);
  for (std::size_t f = 0; f < area_of_face.size(); ++f) {
    double& sum = area[segmentation.part_of_face[f]];
    sum = std::max(sum, 0.0) + area_of_face[f];
  }
  std::vector<Index> order(segmentation.count), number(segmentation.count);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return area[a] > area[b]; });
  for (Index i = 0; i < segmentation.count; ++i) number[order[i]] = i;
  for (Index& p : segmentation.part_of_face) p = number[p];
  segmentation.count =
      static_cast<Index>(std::count_if(area.begin(), area.end(), [](double a) { return a >= 0; }));
}

// Of each node the part with the most area of the faces whose corners map to it.
std::vector<Index> parts_of_nodes(const SurfaceSnapshot& surface, const CurveSkeleton& skeleton,
                                  const std::vector<double>& area_of_face,
                                  const std::vector<Index>& part_of_face) {
  std::vector<std::vector<std::pair<Index, double>>> share(skeleton.nodes.size());
  for (Index h = 0; h < surface.halfedge_count(); ++h) {
    auto& shares = share[skeleton.node_of_vertex[surface.origin[h]]];
    const Index part = part_of_face[h / 3];
    auto at =
        std::find_if(shares.begin(), shares.end(), [&](const auto& entry) { return entry.first == part; });
    if (at == shares.end()) at = shares.insert(at, {part, 0.0});
    at->second += area_of_face[h / 3];
  }
  std::vector<Index> part(skeleton.nodes.size(), kNone);
  for (std::size_t n = 0; n < share.size(); ++n) {
    double most = -1;
    std::sort(share[n].begin(), share[n].end());
    for (const auto& [p, area] : share[n])
      if (area > most) {
        most = area;
        part[n] = p;
      }
  }
  return part;
}

// Where the cheapest border is that about a part's tip, all but the tip goes to its neighbour: the rest is no
// part either, unless so many are wanted.
double smallest_part(const SegmentOptions& options) {
  return options.parts.count == 0 ? options.parts.smallest : 0.0;
}

// The parts on one surface, whose map the skeleton has. The contacts are the input's.
class Segmenter {
 public:
  Segmenter(const SurfaceSnapshot& surface, const CurveSkeleton& skeleton,
            const std::vector<NodeContact>& contacts, const SegmentOptions& options,
            const ProgressCallback& progress)
      : surface_(surface),
        skeleton_(skeleton),
        options_(options),
        progress_(progress),
        contacts_(contacts),
        costs_(border_costs(surface, options.creases)) {}

  // Whether the surface was too coarse for some part of the skeleton.
  bool lost_part() const { return lost_; }

  // The parts of creases come after those of the skeleton's clear cuts, and before the others.
  std::vector<Index> run() {
    const Index wanted = options_.parts.count;
    const SkeletonParts clear = cut_skeleton(0);
    if (wanted > 0 && clear.count >= wanted) return carried(cut_skeleton(wanted));
    std::vector<Index> part = carried(clear);
    split(part, 0);
    if (wanted == 0) return part;
    const Index found = count_of(part);
    if (found < wanted) {
      part = carried(cut_skeleton(clear.count + wanted - found));
      split(part, wanted);
    }
    return part;
  }

 private:
  SkeletonParts cut_skeleton(Index count) const {
    PartOptions options = options_.parts;
    options.count = count;
    report_progress(progress_, kPartsStage, 0.2);
    return find_parts(skeleton_, contacts_, options, progress_);
  }
  // With smooth borders, and connected.
  std::vector<Index> carried(const SkeletonParts& parts) {
    report_progress(progress_, kPartsStage, 0.3);
    std::vector<Index> part = carry_to_faces(surface_, skeleton_, parts.part_of_node);
    lost_ = lost_ || !has_all(part, parts.count);
    connect_parts(surface_, part);
    smooth_borders(surface_, costs_, part, options_.border_width, std::numeric_limits<double>::infinity(),
                   progress_);
    connect_parts(surface_, part, smallest_part(options_));
    return part;
  }
  void split(std::vector<Index>& part, Index least) const {
    CreasePartOptions options = options_.crease_parts;
    options.most = options_.parts.count;
    options.least = least;
    report_progress(progress_, kPartsStage, 0.4);
    split_at_creases(surface_, costs_, part, options);
  }

  const SurfaceSnapshot& surface_;
  const CurveSkeleton& skeleton_;
  const SegmentOptions& options_;
  const ProgressCallback& progress_;
  const std::vector<NodeContact>& contacts_;
  const std::vector<double> costs_;
  bool lost_ = false;
};

// Of the coarse surface's mean edge: a border that runs along its edges is about half of one beside the
// smooth one.
constexpr double kSettling = 0.6;

double mean_edge_length(const SurfaceSnapshot& surface) {
  double sum = 0;
  for (Index h = 0; h < surface.halfedge_count(); ++h) sum += surface.edge_length(h);
  return sum / surface.halfedge_count();
}

// Empty where the coarse surface is too coarse for the parts.
std::vector<Index> parts_by_coarse_surface(const SurfaceSnapshot& surface, const CoarseSurface& coarse,
                                           const CurveSkeleton& skeleton,
                                           const std::vector<NodeContact>& contacts,
                                           const SegmentOptions& options, const ProgressCallback& progress) {
  const CurveSkeleton carried = detail::on_coarse_surface(surface, coarse, skeleton);
  Segmenter segmenter(coarse.surface, carried, contacts, options, progress);
  const std::vector<Index> found = segmenter.run();
  const Index count = count_of(found);
  if (segmenter.lost_part() || count < options.parts.count) return {};
  report_progress(progress, kPartsStage, 0.5);
  auto [part, near_border] = detail::carried_to_input(surface, coarse, found);
  if (!has_all(part, count)) return {};
  report_progress(progress, kPartsStage, 0.6);
  smooth_borders(surface, border_costs(surface, options.creases, near_border), part, options.border_width,
                 kSettling * mean_edge_length(coarse.surface), progress);
  report_progress(progress, kPartsStage, 0.8);
  connect_parts(surface, part, smallest_part(options));
  return part;
}

std::vector<Index> find_parts_of_faces(const SurfaceSnapshot& surface, const CoarseSurface* coarse,
                                       const CurveSkeleton& skeleton, const SegmentOptions& options,
                                       const ProgressCallback& progress) {
  report_progress(progress, kPartsStage, 0.0);
  const std::vector<NodeContact> contacts = node_contacts(surface, skeleton);
  std::optional<CoarseSurface> made;
  if (coarse == nullptr && surface.vertex_count() > options.coarsening.vertices)
    coarse = &made.emplace(coarsen_surface(surface, options.coarsening, {0, progress}));
  if (coarse != nullptr) {
    std::vector<Index> part =
        parts_by_coarse_surface(surface, *coarse, skeleton, contacts, options, progress);
    if (!part.empty()) return part;
  }
  return Segmenter(surface, skeleton, contacts, options, progress).run();
}

}  // namespace

std::vector<NodeContact> node_contacts(const SurfaceSnapshot& surface, const CurveSkeleton& skeleton) {
  check_surface_map(surface, skeleton);
  // Per node those with larger numbers that it touches; a node touches few.
  std::vector<std::vector<std::pair<Index, double>>> touched(skeleton.nodes.size());
  const auto add = [&](Index a, Index b, double length) {
    auto& those = touched[std::min(a, b)];
    const Index other = std::max(a, b);
    const auto at =
        std::find_if(those.begin(), those.end(), [&](const auto& entry) { return entry.first == other; });
    if (at == those.end())
      those.push_back({other, length});
    else
      at->second += length;
  };
  for (Index f = 0; f < surface.face_count(); ++f) {
    std::array<Index, 3> node{};
    std::array<Vector3, 3> x;
    for (int k = 0; k < 3; ++k) node[k] = skeleton.node_of_vertex[surface.origin[3 * f + k]];
    if (node[0] == node[1] && node[1] == node[2]) continue;
    for (int k = 0; k < 3; ++k) x[k] = surface.position[surface.origin[3 * f + k]];
    const bool three = node[0] != node[1] && node[1] != node[2] && node[2] != node[0];
    const Vector3 middle = (x[0] + x[1] + x[2]) / 3;
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      if (three)
        add(node[i], node[j], (middle - 0.5 * (x[i] + x[j])).norm());
      else if (node[i] == node[j])
        add(node[i], node[k], 0.5 * (x[i] - x[j]).norm());
    }
  }
  std::vector<NodeContact> contacts;
  for (Index n = 0; n < static_cast<Index>(touched.size()); ++n) {
    std::sort(touched[n].begin(), touched[n].end());
    for (const auto& [other, length] : touched[n])
      contacts.push_back({{n, other}, surface.frame.scale * length});
  }
  return contacts;
}

Segmentation segment_surface(const SurfaceSnapshot& surface, const CurveSkeleton& skeleton,
                             const SegmentOptions& options, const CoarseSurface* coarse,
                             const ProgressCallback& progress) {
  validate(options.parts);
  validate(options.crease_parts);
  if (coarse != nullptr && static_cast<Index>(coarse->coarse_vertex.size()) != surface.vertex_count())
    throw UsageError("parts: the coarse surface is another one's");
  Segmentation segmentation;
  segmentation.part_of_face = find_parts_of_faces(surface, coarse, skeleton, options, progress);
  report_progress(progress, kPartsStage, 0.9);
  segmentation.count = count_of(segmentation.part_of_face);
  const std::vector<double> area = face_areas(surface);
  number_by_area(area, segmentation);
  segmentation.part_of_node = parts_of_nodes(surface, skeleton, area, segmentation.part_of_face);
  return segmentation;
}

}  // namespace mspskel
