#include "mspskel/collapse/skeleton_decimater.h"

#include "mspskel/collapse/detail/skeleton_decimater_impl.h"
