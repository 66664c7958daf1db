#include "mspskel/graph/lay_axes.h"

#include "mspskel/graph/detail/lay_axes_impl.h"
