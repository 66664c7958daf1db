#include "mspskel/mesh/component_solids.h"

#include "mspskel/mesh/detail/component_solids_impl.h"
