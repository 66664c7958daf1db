#include "mspskel/graph/route_inside.h"

#include "mspskel/graph/detail/route_inside_impl.h"
