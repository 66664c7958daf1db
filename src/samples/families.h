// The table behind list_samples and make_sample: each file of families adds its own.
#pragma once

#include <functional>
#include <vector>

#include "mspskel/samples/samples.h"
#include "mspskel/samples/shapes.h"

namespace mspskel::detail {

struct Family {
  SampleInfo info;
  // Both get options whose zeros are replaced and whose ranges are checked.
  std::function<PolygonSoup(const SampleOptions&)> make;
  std::function<void(SampleInfo&, const SampleOptions&)> adapt =
      {};  // facts that depend on the count; may be empty
  // The skeleton that it is made round; empty where none is defined. May throw UsageError for some options.
  std::function<CurveSkeleton(const SampleOptions&)> truth = {};
};

std::vector<Family> ring_families();    // surfaces of revolution, prisms, single polyhedra
std::vector<Family> knot_families();    // tubes along closed curves: knots, links, chains
std::vector<Family> block_families();   // blocks and plates with holes and tunnels, thin walls
std::vector<Family> skin_families();    // skins of graphs: creatures, scaffolds
std::vector<Family> bar_families();     // straight bars along the axes: tools, furniture, frames
std::vector<Family> vessel_families();  // round bodies with handles and spouts
std::vector<Family> tree_families();    // trees of tubes

// The beginning of a family's facts. `least`: the fewest vertices that show the shape without
// self-intersections.
SampleInfo facts(const char* name, const char* description, Index genus, Index leaves, Index resolution,
                 Index least);
SampleInfo with_ratio(SampleInfo info, const char* of, double value, double least, double most);
SampleInfo with_sides(SampleInfo info, const Vector3& sides);
SampleInfo with_sections(SampleInfo info, Section section);
SampleInfo with_count(SampleInfo info, const char* of, Index value, Index least, Index most);

// The same with z upward where it is made, y in the model.
Family standing(const Family& family);

// The tessellation of a surface of that area at the wanted resolution.
Tessellation tessellation(double area, const SampleOptions& options);

}  // namespace mspskel::detail
