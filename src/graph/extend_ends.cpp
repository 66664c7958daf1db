#include "mspskel/graph/extend_ends.h"

#include "mspskel/graph/detail/extend_ends_impl.h"
