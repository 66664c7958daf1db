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
  std::function<void(SampleInfo&, const SampleOptions&)>
      adapt;  // facts that depend on the count; may be empty
};

std::vector<Family> ring_families();  // surfaces of revolution, prisms, tubes along curves, single polyhedra

// The tessellation of a surface of that area at the wanted resolution.
Tessellation tessellation(double area, const SampleOptions& options);

}  // namespace mspskel::detail
