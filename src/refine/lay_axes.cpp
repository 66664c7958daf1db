#include "mspskel/refine/lay_axes.h"

#include "mspskel/refine/detail/lay_axes_impl.h"
