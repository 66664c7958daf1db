#include "mspskel/arcs/route_inside.h"

#include "mspskel/arcs/detail/route_inside_impl.h"
