#include "mspskel/segment/segment_surface.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "mspskel/base/error.h"
#include "mspskel/segment/smooth_borders.h"
#include "mspskel/skeleton/check_surface_map.h"

namespace mspskel {
namespace {

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

std::vector<double> face_areas(const SurfaceSnapshot& surface) {
  std::vector<double> area;
  for (Index f = 0; f < surface.face_count(); ++f)
    area.push_back(0.5 * surface.face_normal_times_twice_area(f).norm());
  return area;
}

// Numbers the parts anew, from the largest area to the smallest.
void number_by_area(const std::vector<double>& area_of_face, Segmentation& segmentation) {
  std::vector<double> area(segmentation.count, 0.0);
  for (std::size_t f = 0; f < area_of_face.size(); ++f) area[segmentation.part_of_face[f]] += area_of_face[f];
  std::vector<Index> order(segmentation.count), number(segmentation.count);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return area[a] > area[b]; });
  for (Index i = 0; i < segmentation.count; ++i) number[order[i]] = i;
  for (Index& p : segmentation.part_of_face) p = number[p];
}

// Of each node the part with the most area of the faces whose corners map to it.
std::vector<Index> parts_of_nodes(const SurfaceSnapshot& surface, const CurveSkeleton& skeleton,
                                  const std::vector<double>& area_of_face,
                                  const std::vector<Index>& part_of_face) {
  std::vector<std::map<Index, double>> share(skeleton.nodes.size());
  for (Index h = 0; h < surface.halfedge_count(); ++h)
    share[skeleton.node_of_vertex[surface.origin[h]]][part_of_face[h / 3]] += area_of_face[h / 3];
  std::vector<Index> part(skeleton.nodes.size(), kNone);
  for (std::size_t n = 0; n < share.size(); ++n) {
    double most = -1;
    for (const auto& [p, area] : share[n])
      if (area > most) {
        most = area;
        part[n] = p;
      }
  }
  return part;
}

class Segmenter {
 public:
  Segmenter(const SurfaceSnapshot& surface, const CurveSkeleton& skeleton, const SegmentOptions& options)
      : surface_(surface),
        skeleton_(skeleton),
        options_(options),
        contacts_(node_contacts(surface, skeleton)),
        costs_(border_costs(surface, options.creases)) {}

  // The parts of creases come after those of the skeleton's clear cuts, and before the others.
  std::vector<Index> run() {
    const Index wanted = options_.parts.count;
    const SkeletonParts clear = cut_skeleton(0);
    if (wanted > 0 && clear.count >= wanted) return carried(cut_skeleton(wanted));
    std::vector<Index> part = carried(clear);
    split(part, 0);
    if (wanted == 0) return part;
    const Index found = 1 + *std::max_element(part.begin(), part.end());
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
    return find_parts(skeleton_, contacts_, options);
  }
  // With smooth borders, and connected.
  std::vector<Index> carried(const SkeletonParts& parts) const {
    std::vector<Index> part = carry_to_faces(surface_, skeleton_, parts.part_of_node);
    connect_parts(surface_, part);
    smooth_borders(surface_, costs_, part, options_.border_width);
    connect_parts(surface_, part);
    return part;
  }
  void split(std::vector<Index>& part, Index least) const {
    CreasePartOptions options = options_.crease_parts;
    options.most = options_.parts.count;
    options.least = least;
    split_at_creases(surface_, costs_, part, options);
  }

  const SurfaceSnapshot& surface_;
  const CurveSkeleton& skeleton_;
  const SegmentOptions& options_;
  const std::vector<NodeContact> contacts_;
  const std::vector<double> costs_;
};

}  // namespace

std::vector<NodeContact> node_contacts(const SurfaceSnapshot& surface, const CurveSkeleton& skeleton) {
  check_surface_map(surface, skeleton);
  std::map<std::array<Index, 2>, double> length;
  for (Index f = 0; f < surface.face_count(); ++f) {
    std::array<Index, 3> node{};
    std::array<Vector3, 3> x;
    for (int k = 0; k < 3; ++k) {
      node[k] = skeleton.node_of_vertex[surface.origin[3 * f + k]];
      x[k] = surface.position[surface.origin[3 * f + k]];
    }
    const bool three = node[0] != node[1] && node[1] != node[2] && node[2] != node[0];
    const Vector3 middle = (x[0] + x[1] + x[2]) / 3;
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      if (three)
        length[{std::min(node[i], node[j]), std::max(node[i], node[j])}] +=
            (middle - 0.5 * (x[i] + x[j])).norm();
      else if (node[i] == node[j] && node[k] != node[i])
        length[{std::min(node[i], node[k]), std::max(node[i], node[k])}] += 0.5 * (x[i] - x[j]).norm();
    }
  }
  std::vector<NodeContact> contacts;
  contacts.reserve(length.size());
  for (const auto& [nodes, sum] : length) contacts.push_back({nodes, surface.frame.scale * sum});
  return contacts;
}

Segmentation segment_surface(const SurfaceSnapshot& surface, const CurveSkeleton& skeleton,
                             const SegmentOptions& options) {
  validate(options.parts);
  validate(options.crease_parts);
  Segmentation segmentation;
  segmentation.part_of_face = Segmenter(surface, skeleton, options).run();
  segmentation.count =
      1 + *std::max_element(segmentation.part_of_face.begin(), segmentation.part_of_face.end());
  const std::vector<double> area = face_areas(surface);
  number_by_area(area, segmentation);
  segmentation.part_of_node = parts_of_nodes(surface, skeleton, area, segmentation.part_of_face);
  return segmentation;
}

}  // namespace mspskel
