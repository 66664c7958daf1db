#include "mspskel/mesh/coarsen_surface.h"

#include "mspskel/mesh/detail/coarsen_surface_impl.h"
