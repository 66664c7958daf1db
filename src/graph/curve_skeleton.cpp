#include "mspskel/graph/curve_skeleton.h"

#include "mspskel/graph/detail/curve_skeleton_impl.h"
