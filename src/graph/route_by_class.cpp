#include "mspskel/graph/route_by_class.h"

#include "mspskel/graph/detail/route_by_class_impl.h"
