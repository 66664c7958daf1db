// What a certificate means to a user: warnings, and whether the skeleton may pass for one of the mesh. Both
// the default command and `check` ask here, so they agree.
#pragma once

#include <string>
#include <vector>

#include "certificate.h"
#include "mspskel/limbs/coverage.h"

namespace mspskel::cli {

struct Verdict {
  std::vector<std::string> warnings;
  std::string failure;  // a sentence; empty if the skeleton may pass
};

// `surface` is what was certified; places in the sentences are in model units. Fails what the certificate
// fails, and a skeleton of whose length a smaller share than `least_inside` is inside; of 1, any edge
// outside. Unless that is 0, as for skeletons that may lie outside, each handle needs a cycle, too, whatever
// excuses the proof.
Verdict judge(const SurfaceSnapshot& surface, const TopologyCertificate& certificate,
              const std::vector<UncoveredPart>& uncovered, double least_inside);

}  // namespace mspskel::cli
