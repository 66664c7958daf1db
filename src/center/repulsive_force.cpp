#include "mspskel/center/repulsive_force.h"

#include "mspskel/center/detail/repulsive_force_impl.h"
