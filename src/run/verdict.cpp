#include "verdict.h"

#include <cstdio>
#include <utility>

#include "mspskel/base/counted.h"

namespace mspskel::cli {
namespace {

std::string place(const Vector3& x) {
  char text[96];
  std::snprintf(text, sizeof text, "%.6g %.6g %.6g", x.x(), x.y(), x.z());
  return text;
}

std::string what_is_outside(const SurfaceSnapshot& surface, const TopologyCertificate& certificate) {
  char share[32];
  std::snprintf(share, sizeof share, "%.3g %%", 100 * (1 - certificate.inside));
  std::string text = share + std::string(" of the skeleton's length is outside the solid, on ") +
                     counted(certificate.edges_not_inside, "edge");
  if (certificate.outside_at) text += ", first at " + place(surface.frame.to_model(*certificate.outside_at));
  return text;
}

std::string what_is_uncovered(const std::vector<UncoveredPart>& parts) {
  char widths[32];
  std::snprintf(widths, sizeof widths, "%.2g", parts.front().widths);
  const std::string largest = std::string(parts.front().is_plate ? "a plate" : "a part") + " of " + widths +
                              " widths at " + place(parts.front().position);
  if (parts.size() == 1) return largest + " has no arc";
  return counted(static_cast<Index>(parts.size()), "part") + " have no arc, the longest " + largest;
}

// Of cycles that leave the solid, and so may pass beside a disc, the certificate does not say that they fail.
// Where a surface that crosses itself has a handle without a disc, nobody knows what goes round it.
bool misses_handles(const TopologyCertificate& c) {
  const Index known = c.crossing_rank + (c.self_intersecting ? 0 : c.completions);
  return c.clear && known < c.total_genus - c.small_handles;
}

}  // namespace

Verdict judge(const SurfaceSnapshot& surface, const TopologyCertificate& certificate,
              const std::vector<UncoveredPart>& uncovered, double least_inside) {
  Verdict verdict;
  if (certificate.edges_not_inside > 0) {
    const bool too_much = least_inside >= 1 || certificate.inside < least_inside;
    std::string outside = what_is_outside(surface, certificate);
    if (too_much)
      verdict.failure = std::move(outside);
    else
      verdict.warnings.push_back(std::move(outside));
  }
  if (!uncovered.empty()) verdict.warnings.push_back(what_is_uncovered(uncovered));
  const std::string wrong = "the skeleton's topology is not the solid's: ";
  if (certificate.verdict == TopologyVerdict::kFailed)
    verdict.failure = wrong + certificate.reason;
  else if (verdict.failure.empty() && least_inside > 0 && misses_handles(certificate))
    verdict.failure = wrong + "the cycles cross the discs with rank " +
                      std::to_string(certificate.crossing_rank) + ", not " +
                      std::to_string(certificate.total_genus - certificate.small_handles);
  return verdict;
}

}  // namespace mspskel::cli
