#include "mspskel/collapse/small_handles.h"

#include "mspskel/collapse/detail/small_handles_impl.h"
