#include "mspskel/mesh/bounding_volume_hierarchy.h"

#include "mspskel/mesh/detail/bounding_volume_hierarchy_impl.h"
