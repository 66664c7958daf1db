#include "mspskel/center/planar_region.h"

#include "mspskel/center/detail/planar_region_impl.h"
