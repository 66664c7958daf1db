// Shares that turn no face over.
#pragma once

#include "share_spread.h"

namespace mspskel::detail {

// Lowers shares until each vertex follows four joints or fewer and no face turns over: of the joints that a
// vertex has more, the one with the shortest bone has nothing of its own; the edges of a face that turns over
// keep half of their changes.
void keep_sides(const SurfaceSnapshot& surface, ShareSpread& spread);

}  // namespace mspskel::detail
