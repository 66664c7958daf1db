#include "checked_extraction.h"

#include "mspskel/base/stopwatch.h"
#include "mspskel/skeleton/end_at_openings.h"
#include "verdict.h"

namespace mspskel::cli {
namespace {

void end_at_open_ends(const MeshInput& input, const ExtractOptions& options, ExtractResult& result) {
  if (input.repair.openings.empty()) return;
  const BoundingVolumeHierarchy solid(result.surface);
  const OpeningEnds ends = end_at_openings(result.skeleton, result.surface, solid, input.repair.openings,
                                           options.refinement.centering.step);
  if (ends.missing > 0)
    result.warnings.push_back("the skeleton does not end at " + std::to_string(ends.missing) +
                              " of the open ends: no way there is straight");
}

}  // namespace

CheckedExtraction extract_from(MeshInput input, const ExtractOptions& options) {
  CheckedExtraction made;
  made.input = std::move(input);
  made.result = extract_skeleton(made.input.built.mesh, options);
  end_at_open_ends(made.input, options, made.result);
  std::vector<std::string>& warnings = made.result.warnings;
  warnings.insert(warnings.begin(), made.input.built.warnings.begin(), made.input.built.warnings.end());
  return made;
}

void certify(CheckedExtraction& made, CertificateDepth depth, const Execution& execution) {
  const Stopwatch checking;
  ExtractResult& result = made.result;
  if (!result.solid)
    result.solid = std::make_shared<const BoundingVolumeHierarchy>(result.surface, execution.progress);
  made.certificate =
      certify(result.surface, result.cocycles, *result.solid, result.skeleton, depth, execution);
  made.uncovered = find_uncovered_parts(result.surface, *result.solid, result.skeleton, {}, execution);
  result.seconds.emplace_back("checks", checking.seconds());
  Verdict verdict = judge(result.surface, made.certificate, made.uncovered);
  result.warnings.insert(result.warnings.end(), verdict.warnings.begin(), verdict.warnings.end());
  made.failure = std::move(verdict.failure);
}

Json facts_of(const std::string& file, const CheckedExtraction& made) {
  Json facts = make_report(file, made.result, made.certificate, made.uncovered);
  facts["repair"] = repair_facts(made.input);
  return facts;
}

}  // namespace mspskel::cli
