#include "mspskel/graph/restore_cycles.h"

#include "mspskel/graph/detail/restore_cycles_impl.h"
