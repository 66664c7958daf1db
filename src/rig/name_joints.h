// Names of joints, and which of them mirror each other.
#pragma once

#include "mspskel/rig/rig.h"

namespace mspskel::detail {

// Fills in twin, then name. `extent` is the model's, model units.
void name_joints(Rig& rig, double extent);

}  // namespace mspskel::detail
