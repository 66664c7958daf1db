// Plates that stand on something else: the back of a chair, a flange, a fin of sheet metal.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "mspskel/limbs/detail/plate_growth.h"
#include "mspskel/limbs/detail/sharp_turn.h"

namespace mspskel {
namespace detail {

// Levels of a distance from afar cut a plate aslant: its corners are farthest, and those look like the
// corners of any slab. Its root tells it from them. There the surface turns in sharply, so plates grow from
// such edges; where their roots are rounded they grow from those corners.
class PlateSearch {
 public:
  PlateSearch(const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
              const LimbOptions& options, const ProgressCallback& progress)
      : surface_(surface), growth_(surface, solid, options, progress) {}

  // `distance`: from the middle of the shape. Throws Cancelled. Cost: up to two rays a face that a plate
  // comes by, and a few where the distance is greatest.
  std::vector<Plate> run(const std::vector<double>& distance) {
    constexpr double kThin = 0.5;  // thickness over the length of the crease, or over the distance
    std::vector<Plate> plates;
    for (const auto& [h, length] : creases())
      if (std::optional<Plate> plate = growth_.grow(SurfaceSnapshot::face(h), kThin * length)) {
        plate->from_crease = true;
        plates.push_back(std::move(*plate));
      }
    for (const Index v : greatest_of_neighbours(surface_, distance, 0.0)) {
      std::optional<Plate> plate = growth_.grow_at(v, kThin * distance[v]);
      if (plate && plate->stands_out && !plate->is_bow) plates.push_back(std::move(*plate));
    }
    return plates;
  }

 private:
  bool is_sharp_inward(Index h) const {
    return sharp_turn(surface_, h, growth_.normal(SurfaceSnapshot::face(h)),
                      growth_.normal(SurfaceSnapshot::face(surface_.twin[h]))) < 0;
  }

  // The half-edges of sharp inward edges, each with the length of the crease that it is a part of: of all
  // that hang together with it.
  std::vector<std::pair<Index, double>> creases() {
    std::vector<std::pair<Index, double>> edges;
    std::vector<bool> walked(static_cast<std::size_t>(surface_.halfedge_count()), false);
    for (Index first = 0; first < surface_.halfedge_count(); ++first) {
      if (walked[first] || !is_sharp_inward(first)) continue;
      const std::size_t begin = edges.size();
      double length = 0;
      const auto add = [&](Index h) {
        if (walked[h] || !is_sharp_inward(h)) return;
        walked[h] = walked[surface_.twin[h]] = true;
        length += surface_.edge_length(h);
        edges.emplace_back(h, 0.0);
        edges.emplace_back(surface_.twin[h], 0.0);
      };
      add(first);
      for (std::size_t i = begin; i < edges.size(); ++i) {
        const Index from = edges[i].first;
        for (Index h = surface_.next_outgoing(from); h != from; h = surface_.next_outgoing(h)) add(h);
      }
      for (std::size_t i = begin; i < edges.size(); ++i) edges[i].second = length;
    }
    return edges;
  }

  const SurfaceSnapshot& surface_;
  PlateGrowth growth_;
};

}  // namespace detail
}  // namespace mspskel
