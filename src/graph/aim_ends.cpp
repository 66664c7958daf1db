#include "mspskel/graph/aim_ends.h"

#include "mspskel/graph/detail/aim_ends_impl.h"
