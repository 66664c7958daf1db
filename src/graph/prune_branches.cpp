#include "mspskel/graph/prune_branches.h"

#include "mspskel/graph/detail/prune_branches_impl.h"
