#include "mspskel/refine/aim_ends.h"

#include "mspskel/refine/detail/aim_ends_impl.h"
