#include "mspskel/collapse/volume_cocycles.h"

#include "mspskel/collapse/detail/volume_cocycles_impl.h"
