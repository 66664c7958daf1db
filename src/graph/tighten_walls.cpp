#include "mspskel/graph/tighten_walls.h"

#include "mspskel/graph/detail/tighten_walls_impl.h"
