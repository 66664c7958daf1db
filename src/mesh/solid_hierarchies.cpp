#include "mspskel/mesh/solid_hierarchies.h"

#include "mspskel/mesh/detail/solid_hierarchies_impl.h"
