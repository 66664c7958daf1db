// From a mesh made usable to a skeleton with its certificate: what every command that makes skeletons does.
#pragma once

#include <string>
#include <vector>

#include "certificate.h"
#include "mesh_input.h"
#include "mspskel/extract_skeleton.h"
#include "mspskel/limbs/coverage.h"
#include "report.h"

namespace mspskel::cli {

struct CheckedExtraction {
  MeshInput input;
  ExtractResult result;
  TopologyCertificate certificate;
  std::vector<UncoveredPart> uncovered;
  std::string failure;  // of the certificate, a sentence; empty: none
};

// The skeleton, which ends at the open ends of the input. The input's warnings come first among the result's.
// Throws as extract_skeleton does.
CheckedExtraction extract_from(MeshInput input, const ExtractOptions& options);

// Fills in certificate, uncovered parts and failure, adds what they warn of, and the seconds that it took.
// Throws Cancelled.
void certify(CheckedExtraction& made, CertificateDepth depth, const Execution& execution = {});

// make_report with what mending did.
Json facts_of(const std::string& file, const CheckedExtraction& made);

}  // namespace mspskel::cli
