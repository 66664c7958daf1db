// From a mesh made usable to a skeleton with its certificate: what every command that makes skeletons does.
#pragma once

#include <string>
#include <vector>

#include "certificate.h"
#include "mesh_input.h"
#include "mspskel/extract_skeleton.h"
#include "mspskel/limbs/coverage.h"
#include "report.h"
#include "run_options.h"

namespace mspskel::cli {

struct CheckedExtraction {
  MeshInput input;
  ExtractResult result;
  TopologyCertificate certificate;
  std::vector<UncoveredPart> uncovered;
  std::string failure;  // of the certificate, a sentence; empty: none
};

// The skeleton of an input that was prepared from the soup, with its certificate. It ends at the open ends of
// the input; the input's warnings come first among the result's. Where too much of it is outside
// (RunOptions::least_inside), or its topology fails on a surface that crosses itself, the surface does not
// say where its solid is: limbs that rounding has pressed flat, sheets folded through each other. Then the
// soup is wrapped, unless the settings decide otherwise, and the wrap's skeleton is taken if it passes.
// Throws as extract_skeleton and prepare_mesh do.
CheckedExtraction extract_checked(const PolygonSoup& soup, MeshInput&& input, const RunOptions& run,
                                  CertificateDepth depth);

// make_report with what mending did.
Json facts_of(const std::string& file, const CheckedExtraction& made);

}  // namespace mspskel::cli
