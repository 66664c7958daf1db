#include "mspskel/arcs/tighten_walls.h"

#include "mspskel/arcs/detail/tighten_walls_impl.h"
