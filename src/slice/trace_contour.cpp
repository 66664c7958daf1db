#include "mspskel/slice/trace_contour.h"

#include "mspskel/slice/detail/trace_contour_impl.h"
