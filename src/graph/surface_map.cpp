#include "mspskel/graph/surface_map.h"

#include "mspskel/graph/detail/surface_map_impl.h"
