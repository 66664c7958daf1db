#include "mspskel/refine/prune_branches.h"

#include "mspskel/refine/detail/prune_branches_impl.h"
