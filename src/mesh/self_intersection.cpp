#include "mspskel/mesh/self_intersection.h"

#include "mspskel/mesh/detail/self_intersection_impl.h"
