// Each file registers its benchmarks once for every model; names read "stage/model".
#pragma once

namespace mspskel::bench {

void register_mesh_benchmarks();   // reading, building, snapshot
void register_slice_benchmarks();  // MSP, slice error, cone refinement

}  // namespace mspskel::bench
