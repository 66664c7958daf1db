#include "mspskel/mesh/subdivide_surface.h"

#include "mspskel/mesh/detail/subdivide_surface_impl.h"
