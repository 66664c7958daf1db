#include "mspskel/graph/cycle_rank.h"

#include "mspskel/graph/detail/cycle_rank_impl.h"
