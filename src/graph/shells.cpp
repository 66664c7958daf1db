#include "mspskel/graph/shells.h"

#include "mspskel/graph/detail/shells_impl.h"
