// What lies between the stages, for people who study them: --stages DIR.
#pragma once

#include <string>
#include <vector>

#include "mspskel/extract_skeleton.h"
#include "mspskel/io/atomic_file.h"

namespace mspskel::cli {

// The files that add_stage_files makes.
std::vector<std::string> stage_file_paths(const std::string& folder);

// Adds those of the folder, which is made where absent:
//   msp.csv            one line a vertex; lengths and positions in model units, errors normalised to [0, 1].
//                      A vertex without a slice has MSP 0, error 1, and zeros for the rest
//   msp_initial.ply    the mesh coloured by MSP before cone refinement, blue (least) to red (most)
//   msp.ply            by MSP after it
//   error_initial.ply  by slice error before, blue (0) to red (1)
//   error.ply          by slice error after
//   skeleton_mesh.ply  the mesh with every vertex at its skeletal point
// Throws as OutputFiles does.
void add_stage_files(const std::string& folder, const ExtractResult& result, OutputFiles& files);

}  // namespace mspskel::cli
