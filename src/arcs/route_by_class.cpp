#include "mspskel/arcs/route_by_class.h"

#include "mspskel/arcs/detail/route_by_class_impl.h"
