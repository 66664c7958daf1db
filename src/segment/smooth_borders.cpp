#include "mspskel/segment/smooth_borders.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <queue>
#include <utility>

#include "max_flow.h"
#include "mspskel/base/error.h"

namespace mspskel {
namespace {

class BorderSmoother {
 public:
  BorderSmoother(const SurfaceSnapshot& surface, const std::vector<double>& costs,
                 std::vector<Index>& part_of_face, double width, double most)
      : surface_(surface),
        costs_(costs),
        part_(part_of_face),
        width_(width),
        most_(most),
        place_(part_of_face.size(), kNone) {}

  void run(const ProgressCallback& progress) {
    for (Index h = 0; h < surface_.halfedge_count(); ++h)
      if (h < surface_.twin[h]) note(h);
    for (auto& [parts, border] : borders_) {
      const auto [a, b] = parts;
      report_progress(progress, "parts", 0.7);
      std::sort(border.begin(), border.end());
      border.erase(std::unique(border.begin(), border.end()), border.end());
      border.erase(
          std::remove_if(border.begin(), border.end(), [&](Index h) { return !is_border(h, parts); }),
          border.end());
      smooth(a, b, border);
    }
  }

 private:
  using Parts = std::pair<Index, Index>;

  bool is_border(Index h, const Parts& parts) const {
    return Parts(part_[h / 3], part_[surface_.twin[h] / 3]) == parts;
  }
  // Keeps the half-edge, or its twin, with the border that it is on.
  void note(Index h) {
    const Index a = part_[h / 3], b = part_[surface_.twin[h] / 3];
    if (a < b)
      borders_[{a, b}].push_back(h);
    else if (b < a)
      borders_[{b, a}].push_back(surface_.twin[h]);
  }
  // Faces of both parts within `width` of their border, along the surface.
  std::vector<Index> band(Index a, Index b, const std::vector<Index>& border, double width) {
    using Item = std::pair<double, Index>;
    std::priority_queue<Item, std::vector<Item>, std::greater<Item>> queue;
    for (const Index h : border) {
      queue.push({0.0, h / 3});
      queue.push({0.0, surface_.twin[h] / 3});
    }
    std::vector<Index> faces;
    while (!queue.empty()) {
      const auto [distance, f] = queue.top();
      queue.pop();
      if (place_[f] != kNone) continue;
      place_[f] = static_cast<Index>(faces.size());
      faces.push_back(f);
      const Vector3 middle = surface_.face_centroid(f);
      for (Index h = 3 * f; h < 3 * f + 3; ++h) {
        const Index g = surface_.twin[h] / 3;
        if (place_[g] != kNone || (part_[g] != a && part_[g] != b)) continue;
        const double there = distance + (middle - surface_.face_centroid(g)).norm();
        if (there <= width) queue.push({there, g});
      }
    }
    return faces;
  }

  void assign(Index f, Index part) {
    if (part_[f] == part) return;
    part_[f] = part;
    // Its borders with third parts become those of another pair. Pairs whose turn is over stay as they are.
    for (Index h = 3 * f; h < 3 * f + 3; ++h) note(h);
  }

  void smooth(Index a, Index b, const std::vector<Index>& border) {
    double length = 0;
    for (const Index h : border) length += surface_.edge_length(h);
    const std::vector<Index> faces = band(a, b, border, std::min(most_, width_ * length / (2 * kPi)));
    const Index source = static_cast<Index>(faces.size()), sink = source + 1;
    detail::MaxFlow flow(sink + 1);
    bool from_a = false, from_b = false;
    for (const Index f : faces)
      for (Index h = 3 * f; h < 3 * f + 3; ++h) {
        const Index g = surface_.twin[h] / 3;
        if (place_[g] != kNone) {
          if (f < g) flow.add_edge(place_[f], place_[g], costs_[h]);
        } else if (part_[g] == a) {
          flow.add_edge(source, place_[f], costs_[h]);
          from_a = true;
        } else if (part_[g] == b) {
          flow.add_edge(place_[f], sink, costs_[h]);
          from_b = true;
        }
      }
    if (from_a && from_b) {
      const std::vector<char> side = flow.cut(source, sink);
      for (std::size_t i = 0; i < faces.size(); ++i) assign(faces[i], side[i] ? a : b);
    }
    for (const Index f : faces) place_[f] = kNone;
  }

  const SurfaceSnapshot& surface_;
  const std::vector<double>& costs_;  // per half-edge
  std::vector<Index>& part_;
  const double width_, most_;
  std::map<Parts, std::vector<Index>> borders_;  // half-edges that are, or were, from the first to the second
  std::vector<Index> place_;                     // per face: in the present band
};

// Maximal sets of faces of one part that hang together across edges.
struct Pieces {
  std::vector<Index> of_face;
  std::vector<Index> part;  // per piece

  Index count() const { return static_cast<Index>(part.size()); }
};

Pieces find_pieces(const SurfaceSnapshot& surface, const std::vector<Index>& part_of_face) {
  Pieces pieces;
  pieces.of_face.assign(part_of_face.size(), kNone);
  std::vector<Index> stack;
  for (Index start = 0; start < surface.face_count(); ++start) {
    if (pieces.of_face[start] != kNone) continue;
    const Index piece = pieces.count();
    pieces.part.push_back(part_of_face[start]);
    pieces.of_face[start] = piece;
    stack.assign(1, start);
    while (!stack.empty()) {
      const Index f = stack.back();
      stack.pop_back();
      for (Index h = 3 * f; h < 3 * f + 3; ++h) {
        const Index g = surface.twin[h] / 3;
        if (pieces.of_face[g] != kNone || part_of_face[g] != part_of_face[f]) continue;
        pieces.of_face[g] = piece;
        stack.push_back(g);
      }
    }
  }
  return pieces;
}

// Per piece: whether it is the largest of its part, and no smaller than this share of the surface. Areas tell
// where a part has several pieces, or some may be too small.
std::vector<char> lasting_pieces(const SurfaceSnapshot& surface, const Pieces& pieces, double smallest) {
  std::map<Index, Index> largest;
  for (Index i = 0; i < pieces.count(); ++i) largest.emplace(pieces.part[i], i);
  if (!(smallest > 0) && static_cast<Index>(largest.size()) == pieces.count())
    return std::vector<char>(pieces.part.size(), 1);
  std::vector<double> area(pieces.part.size(), 0.0);
  for (Index f = 0; f < surface.face_count(); ++f)
    area[pieces.of_face[f]] += surface.face_normal_times_twice_area(f).norm();
  for (Index i = 0; i < pieces.count(); ++i) {
    Index& most = largest[pieces.part[i]];
    if (area[i] > area[most]) most = i;
  }
  const double least = std::min(smallest * std::accumulate(area.begin(), area.end(), 0.0),
                                *std::max_element(area.begin(), area.end()));
  std::vector<char> lasts(pieces.part.size(), 0);
  for (const auto& entry : largest) lasts[entry.second] = area[entry.second] >= least ? 1 : 0;
  return lasts;
}

}  // namespace

void smooth_borders(const SurfaceSnapshot& surface, const std::vector<double>& costs,
                    std::vector<Index>& part_of_face, double width, double most,
                    const ProgressCallback& progress) {
  if (!(width >= 0 && width <= 10)) throw UsageError("borders: width must be from 0 to 10");
  if (!(most >= 0)) throw UsageError("borders: most must not be negative");
  if (width > 0 && most > 0) BorderSmoother(surface, costs, part_of_face, width, most).run(progress);
}

void connect_parts(const SurfaceSnapshot& surface, std::vector<Index>& part_of_face, double smallest) {
  for (bool moved = true; moved;) {
    moved = false;
    const Pieces pieces = find_pieces(surface, part_of_face);
    const std::vector<char> stays = lasting_pieces(surface, pieces, smallest);
    if (std::all_of(stays.begin(), stays.end(), [](char s) { return s != 0; })) return;
    // Only pieces that stay take others in, so that each round settles all that touch one.
    std::vector<std::map<Index, double>> shared(pieces.part.size());
    for (Index h = 0; h < surface.halfedge_count(); ++h) {
      const Index i = pieces.of_face[h / 3], j = pieces.of_face[surface.twin[h] / 3];
      if (i != j && !stays[i] && stays[j]) shared[i][pieces.part[j]] += surface.edge_length(h);
    }
    std::vector<Index> part = pieces.part;
    for (std::size_t i = 0; i < shared.size(); ++i) {
      double longest = -1;
      for (const auto& [p, length] : shared[i])
        if (length > longest) {
          longest = length;
          part[i] = p;
          moved = true;
        }
    }
    for (Index f = 0; f < surface.face_count(); ++f) part_of_face[f] = part[pieces.of_face[f]];
  }
}

}  // namespace mspskel
