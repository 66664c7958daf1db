// Where a tube ends because the model was cut there: an end of the solid, and of its skeleton.
#pragma once

#include "mspskel/base/types.h"

namespace mspskel {

// Of the boundary loop, without the notches between its teeth where it is ragged.
struct Opening {
  Vector3 centre = Vector3::Zero();  // weighted by length; model coordinates
  Vector3 normal = Vector3::Zero();  // unit, out of the solid
  double radius = 0.0;               // twice the loop's area by its length, model units: that of a round loop
  Index vertex = kNone;              // of the closed surface: the cap's centre
};

}  // namespace mspskel
