#include "checked_extraction.h"

#include "mspskel/base/stopwatch.h"
#include "mspskel/mesh/self_intersection.h"
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

double least_inside(const RunOptions& run) { return run.extract.refinement.enabled ? run.least_inside : 0.0; }

// Fills in certificate, uncovered parts and failure, adds what they warn of, and the seconds that it took.
void certify(const RunOptions& run, CertificateDepth depth, CheckedExtraction& made) {
  const Execution& execution = run.extract.execution;
  const Stopwatch checking;
  ExtractResult& result = made.result;
  if (!result.solid)
    result.solid = std::make_shared<const BoundingVolumeHierarchy>(result.surface, execution.progress);
  const SolidHierarchies solids(result.surface, *result.solid, execution.progress);
  made.certificate = certify(result.surface, result.cocycles, solids, result.skeleton, depth, execution);
  made.uncovered = find_uncovered_parts(result.surface, solids, result.skeleton, {}, execution);
  result.seconds.emplace_back("checks", checking.seconds());
  Verdict verdict = judge(result.surface, made.certificate, made.uncovered, least_inside(run));
  result.warnings.insert(result.warnings.end(), verdict.warnings.begin(), verdict.warnings.end());
  made.failure = std::move(verdict.failure);
}

// Of made.input.
void extract_from_input(const RunOptions& run, CertificateDepth depth, CheckedExtraction& made) {
  made.result = extract_skeleton(made.input.built.mesh, run.extract);
  end_at_open_ends(made.input, run.extract, made.result);
  std::vector<std::string>& warnings = made.result.warnings;
  warnings.insert(warnings.begin(), made.input.built.warnings.begin(), made.input.built.warnings.end());
  certify(run, depth, made);
}

bool crosses_itself(const CheckedExtraction& made, CertificateDepth depth, const Execution& execution) {
  if (depth == CertificateDepth::kFull) return made.certificate.self_intersecting;
  return count_self_intersections(made.result.surface, *made.result.solid, 1, execution) > 0;
}

// Where a surface that crosses itself, or that rounding has crushed, carries no skeleton. A wrap is no better
// than another wrap.
bool may_be_wrapped(const CheckedExtraction& made, const RunOptions& run, CertificateDepth depth) {
  return run.repair.wrap_mode == WrapMode::kAuto && !made.failure.empty() && !made.input.wrapped &&
         (made.certificate.inside < least_inside(run) || crosses_itself(made, depth, run.extract.execution));
}

}  // namespace

// OpenMesh's meshes are copied where they are moved, and a copy that runs out of memory cannot be destroyed:
// so as few moves as can be.
CheckedExtraction extract_checked(const PolygonSoup& soup, MeshInput&& input, const RunOptions& run,
                                  CertificateDepth depth) {
  CheckedExtraction made;
  made.input = std::move(input);
  extract_from_input(run, depth, made);
  if (!may_be_wrapped(made, run, depth)) return made;
  CheckedExtraction again;
  again.input = wrap_mesh(made.input, soup, run.repair, run.extract.execution);
  extract_from_input(run, depth, again);
  if (!again.failure.empty()) return made;
  std::vector<std::string>& warnings = again.result.warnings;
  warnings.insert(warnings.begin(), "of the mesh's own surface, " + made.failure);
  made = std::move(again);
  return made;
}

Json facts_of(const std::string& file, const CheckedExtraction& made) {
  Json facts = make_report(file, made.result, made.certificate, made.uncovered);
  facts["repair"] = repair_facts(made.input);
  return facts;
}

}  // namespace mspskel::cli
