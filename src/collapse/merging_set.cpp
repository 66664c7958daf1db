#include "mspskel/collapse/merging_set.h"

#include "mspskel/collapse/detail/merging_set_impl.h"
