#include "mspskel/arcs/extend_ends.h"

#include "mspskel/arcs/detail/extend_ends_impl.h"
