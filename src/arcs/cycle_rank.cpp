#include "mspskel/arcs/cycle_rank.h"

#include "mspskel/arcs/detail/cycle_rank_impl.h"
