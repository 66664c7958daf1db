#include "verdict.h"

#include <cstdio>

#include "mspskel/base/counted.h"

namespace mspskel::cli {
namespace {

std::string place(const SurfaceSnapshot& surface, const Vector3& normalised) {
  const Vector3 x = surface.frame.to_model(normalised);
  char text[96];
  std::snprintf(text, sizeof text, "%.6g %.6g %.6g", x.x(), x.y(), x.z());
  return text;
}

std::string what_is_outside(const SurfaceSnapshot& surface, const TopologyCertificate& certificate) {
  char share[32];
  std::snprintf(share, sizeof share, "%.2g %%", 100 * (1 - certificate.inside));
  std::string text = share + std::string(" of the skeleton's length is outside the solid, on ") +
                     counted(certificate.edges_not_inside, "edge");
  if (certificate.outside_at) text += ", first at " + place(surface, *certificate.outside_at);
  return text;
}

}  // namespace

Verdict judge(const SurfaceSnapshot& surface, const TopologyCertificate& certificate) {
  Verdict verdict;
  if (certificate.edges_not_inside > 0) verdict.warnings.push_back(what_is_outside(surface, certificate));
  if (certificate.verdict == TopologyVerdict::kFailed)
    verdict.failure = "the skeleton's topology is not the solid's: " + certificate.reason;
  return verdict;
}

}  // namespace mspskel::cli
