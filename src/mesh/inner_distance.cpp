#include "mspskel/mesh/inner_distance.h"

#include "mspskel/mesh/detail/inner_distance_impl.h"
