#include "mspskel/arcs/sharpen_corners.h"

#include "mspskel/arcs/detail/sharpen_corners_impl.h"
