// Each file registers its benchmarks once for every model; names read "stage/model".
#pragma once

namespace mspskel::bench {

void register_mesh_benchmarks();      // reading, building, snapshot
void register_slice_benchmarks();     // on the input: MSP by sampling and by search, slice error, cone
                                      // refinement
void register_stage_benchmarks();     // the default mode's stages one by one, on one thread and on all
void register_pipeline_benchmarks();  // both modes, with the seconds of every stage

}  // namespace mspskel::bench
