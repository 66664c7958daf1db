#include "mspskel/arcs/cut_returns.h"

#include "mspskel/arcs/detail/cut_returns_impl.h"
