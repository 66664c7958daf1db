#include "mspskel/skeleton/surface_map.h"

#include "mspskel/skeleton/detail/surface_map_impl.h"
